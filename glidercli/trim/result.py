"""What is a trim? The ten parameters of a steady flight and what follows from them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from glidercli.frames import Vector, dot, down_in_body
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water
from glidercli.trim.stability import growth_rate, linearised
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["Trim", "ranked", "trim_of"]

_DEG = 180.0 / math.pi


@dataclasses.dataclass(frozen=True)
class Trim:
    """A steady flight: a straight glide or a spiral about the vertical. SI and radians.

    The first nine and the turning radius are the paper's ten parameters (section 4). residual is the largest of the
    six equations (28), (29), N or N m. stable tells whether small deviations decay; None where it was not computed.
    """

    speed: float
    angle_of_attack: float
    sideslip: float
    yaw_rate: float
    """omega_3, rad/s about the vertical, to starboard positive."""
    roll: float
    pitch: float
    mass_position: float
    mass_rotation: float
    net_buoyancy: float
    turning_radius: float
    """m, signed as the yaw rate; infinite in a straight glide."""
    vertical_speed: float
    """m/s, positive down: V . k_b."""
    horizontal_speed: float
    lift_to_drag: float
    residual: float
    iterations: int
    method: str
    equations: str
    within_limits: bool
    stable: bool | None = None
    warnings: tuple[str, ...] = ()

    @property
    def glide_angle(self) -> float:
        """Angle of the path below the horizontal, rad, positive going down."""
        return math.atan2(self.vertical_speed, self.horizontal_speed)

    def document(self) -> dict[str, Any]:
        """The trim in the contract's names and units."""
        return {
            "speed_m_s": self.speed,
            "angle_of_attack_deg": self.angle_of_attack * _DEG,
            "sideslip_deg": self.sideslip * _DEG,
            "yaw_rate_rad_s": self.yaw_rate,
            "yaw_rate_deg_s": self.yaw_rate * _DEG,
            "roll_deg": self.roll * _DEG,
            "pitch_deg": self.pitch * _DEG,
            "mass_position_m": self.mass_position,
            "mass_rotation_deg": self.mass_rotation * _DEG,
            "net_buoyancy_kg": self.net_buoyancy,
            "turning_radius_m": self.turning_radius,
            "vertical_speed_m_s": self.vertical_speed,
            "horizontal_speed_m_s": self.horizontal_speed,
            "glide_angle_deg": self.glide_angle * _DEG,
            "lift_to_drag": self.lift_to_drag,
            "residual": self.residual,
            "iterations": self.iterations,
            "method": self.method,
            "equations": self.equations,
            "stable": self.stable,
            "within_limits": self.within_limits,
        }


def trim_of(
    x: Sequence[float], c: Controls, craft: Vehicle, water: Water, p: Parameters, *, equations: str, method: str,
    residual: float, iterations: int,
) -> Trim:  # fmt: skip
    """The trim of a solution x = (V, alpha, beta, omega_3, phi, theta), SI and rad, with what follows from it."""
    speed, alpha, beta, omega3, phi, theta = (float(item) for item in x)
    growth = growth_rate(linearised(np.array(x), c, water, p))
    vertical, horizontal = speeds(speed, alpha, beta, phi, theta)
    along = speed * math.cos(theta - alpha) if equations == "paper" else horizontal
    outside = craft.actuators.outside(c.rrx, c.gamma, c.mb)
    fitted = craft.hydrodynamics.fitted_angle
    warnings = [f"{name.replace('_', ' ')} is beyond the limits of {craft.name}" for name in outside]
    warnings += [
        f"{name} {math.degrees(angle):.1f} deg is beyond the fitted {math.degrees(fitted):g} deg"
        for name, angle in (("angle of attack", alpha), ("sideslip", beta))
        if abs(angle) > fitted
    ]
    if growth >= 0.0:
        time = 1.0 / max(growth, 1e-9)
        warnings.append(f"this trim is not stable: a deviation grows e-fold in {time:.3g} s, the flight ends elsewhere")
    return Trim(
        speed=speed,
        angle_of_attack=alpha,
        sideslip=beta,
        yaw_rate=omega3,
        roll=phi,
        pitch=theta,
        mass_position=c.rrx,
        mass_rotation=c.gamma,
        net_buoyancy=c.mb,
        turning_radius=along / omega3 if omega3 else math.inf,
        vertical_speed=vertical,
        horizontal_speed=horizontal,
        lift_to_drag=lift_to_drag(alpha, p),
        residual=residual,
        iterations=iterations,
        method=method,
        equations=equations,
        within_limits=not outside,
        stable=growth < 0.0,
        warnings=tuple(warnings),
    )


def speeds(speed: float, alpha: float, beta: float, roll: float, pitch: float) -> tuple[float, float]:
    """Vertical speed V . k_b, positive down, and horizontal speed, m/s."""
    V: Vector = velocity_from_flow(speed, alpha, beta)
    vertical = dot(V, down_in_body(roll, pitch))
    return vertical, math.sqrt(max(0.0, speed * speed - vertical * vertical))


def lift_to_drag(alpha: float, p: Parameters) -> float:
    """L / D of eq. (20), signed as the lift."""
    return (p.KL0 + p.Kalpha * alpha) / (p.KD0 + p.KD * alpha * alpha)


def ranked(trims: Sequence[Trim], nominal: float) -> list[Trim]:
    """The trims, each once: within the limits first, in a quadrant of Table 4 before others, stable before unstable.

    nominal : position of the movable mass that holds the hull level, m.
    """
    order = sorted(trims, key=lambda t: (not t.within_limits, not in_table_4(t, nominal), not t.stable))
    kept: list[Trim] = []
    for one in order:
        if not any(_same(one, other) for other in kept):
            kept.append(one)
    return kept


def in_table_4(t: Trim, nominal: float) -> bool:
    """Whether the signs are those of one of the four spirals of Table 4, or of a straight glide of their kind.

    A dive has m_b, alpha and r_rx - nominal positive and theta negative, a climb the other way round; omega_3 has the
    sign of gamma; beta and phi have it on a climb, and the other one on a dive.
    """
    way = math.copysign(1.0, t.net_buoyancy)
    glide = all(way * value > 0.0 for value in (t.angle_of_attack, t.mass_position - nominal, -t.pitch))
    turning = [t.mass_rotation, t.yaw_rate, -way * t.sideslip, -way * t.roll]
    return glide and (all(v > 0.0 for v in turning) or all(v < 0.0 for v in turning) or all(v == 0.0 for v in turning))


def _same(a: Trim, b: Trim) -> bool:
    """Whether two solutions are one: controls equal to a micrometre, a microradian and a milligram."""
    pairs = ((a.mass_position, b.mass_position), (a.mass_rotation, b.mass_rotation), (a.net_buoyancy, b.net_buoyancy))
    return all(abs(x - y) < 1e-6 for x, y in pairs)
