"""What is a trim? The ten parameters of a steady flight and what follows from them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import NoSolutionError
from glidercli.frames import Vector, dot, down_in_body
from glidercli.kernel import kernel, warmed
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.parameters import Parameters, symmetric
from glidercli.ocean.water import Water
from glidercli.trim.pins import QUANTITIES, STALL_RATIO
from glidercli.trim.stability import Mode, growth_rate, linearised, modes
from glidercli.trim.steady import Unknowns, radius_speed, six
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["Trim", "answered", "no_glide", "ranked", "speeds", "table_4", "trim_of"]

ROTATION, LATERAL = 7, [2, 3, 4]
"""Places in x of gamma, and of beta, omega_3 and phi, which are zero by symmetry in a straight glide."""
ROUNDED = 1e-9
"""rad, rad/s: what Newton leaves of those zeros at most."""
VERTICAL = math.radians(1.0)
"""A path so near to the vertical is called vertical; its horizontal speed is below 2 % of the whole."""

_DEG = 180.0 / math.pi


@dataclasses.dataclass(frozen=True)
class Trim:
    """A steady flight: a straight glide or a spiral about the vertical. SI and radians.

    The first nine and the turning radius are the paper's ten parameters (section 4). residual is the largest of the
    six equations (28), (29), N or N m.
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
    growth_rate: float
    """Rate at which the worst small deviation grows, 1/s; negative where all decay."""
    linear_model: NDArray[np.float64] = dataclasses.field(repr=False, compare=False)
    """(8, 8), of the deviations from this trim: stability.py."""
    warnings: tuple[str, ...] = ()

    @property
    def stable(self) -> bool:
        """Whether small deviations decay."""
        return self.growth_rate < 0.0

    def modes(self) -> list[Mode]:
        """The modes in which small deviations decay or grow, slowest decay first."""
        return modes(self.linear_model)

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
            "growth_rate_1_s": self.growth_rate,
            "within_limits": self.within_limits,
        }


def answered(
    found: Sequence[tuple[Unknowns, int]], craft: Vehicle, water: Water, p: Parameters, *, equations: str, method: str
) -> list[Trim]:
    """Solutions x, each with its iterations, as trims: each once, ranked, without flights that are no glides.

    Raises NoSolutionError where nothing but vertical or stalled flights is left.
    """
    kept, refused = [], []
    for x, iterations in found:
        why = no_glide(x, craft)
        if why:
            refused.append(why)
        else:
            kept.append(trim_of(x, craft, water, p, equations=equations, method=method, iterations=iterations))
    if not kept:
        raise NoSolutionError(refused[0])
    return ranked(kept, craft.actuators.mass_position.nominal)


def no_glide(x: Unknowns, craft: Vehicle) -> str:
    """Why a solution x is no glide: stalled or vertical; empty where it is one."""
    fitted = craft.hydrodynamics.fitted_angle
    if abs(x[1]) > STALL_RATIO * fitted:
        return (
            f"stalled flight: the only one found has an angle of attack of {x[1] * _DEG:.1f} deg, beyond "
            f"{STALL_RATIO * fitted * _DEG:g} deg, {STALL_RATIO:g} times the fitted range; eq. (20) knows no stall and "
            "says nothing there"
        )
    _, horizontal = speeds(*x[:3], x[4], x[5])
    if horizontal < math.sin(VERTICAL) * x[0]:
        return (
            f"vertical flight: the only one found has its path within {VERTICAL * _DEG:g} deg of the vertical, where "
            "heading and turning radius lose their meaning"
        )
    return ""


def trim_of(
    x: Unknowns, craft: Vehicle, water: Water, p: Parameters, *, equations: str, method: str, iterations: int
) -> Trim:
    """The trim of a solution x, SI and rad, with what follows from it."""
    if x[ROTATION] == 0.0 and symmetric(p) and max(abs(x[i]) for i in LATERAL) < ROUNDED:
        x = (x[0], x[1], 0.0, 0.0, 0.0, x[5], x[6], 0.0, x[8])
    speed, alpha, beta, omega3, phi, theta, rrx, gamma, mb = x
    linear = warmed(linearised)(x, water, p)
    growth = growth_rate(linear)
    vertical, horizontal = speeds(speed, alpha, beta, phi, theta)
    along = radius_speed(x, equations == "paper")
    outside = craft.actuators.outside(rrx, gamma, mb)
    return Trim(
        speed=speed,
        angle_of_attack=alpha,
        sideslip=beta,
        yaw_rate=omega3,
        roll=phi,
        pitch=theta,
        mass_position=rrx,
        mass_rotation=gamma,
        net_buoyancy=mb,
        turning_radius=along / omega3 if omega3 else math.inf,
        vertical_speed=vertical,
        horizontal_speed=horizontal,
        lift_to_drag=lift_to_drag(alpha, p),
        residual=max(map(abs, six(x, water, p))),
        iterations=iterations,
        method=method,
        equations=equations,
        within_limits=not outside,
        growth_rate=growth,
        linear_model=linear,
        warnings=tuple(_warnings(x, growth, outside, craft)),
    )


def _warnings(x: Unknowns, growth: float, outside: Sequence[str], craft: Vehicle) -> list[str]:
    """What a reader of a trim must know besides its numbers."""
    fitted = craft.hydrodynamics.fitted_angle
    limits, told = dict(craft.actuators.ranges()), []
    for name in outside:
        q, limit = QUANTITIES[name], limits[name]
        told.append(
            f"{name.replace('_', ' ')} {x[q.place] / q.factor:.4g} {q.unit} is beyond the limits of {craft.name}, "
            f"{limit.minimum / q.factor:.4g} to {limit.maximum / q.factor:.4g} {q.unit}"
        )
    told += [
        f"{name} {angle * _DEG:.1f} deg is beyond the fitted {fitted * _DEG:g} deg"
        for name, angle in (("angle of attack", x[1]), ("sideslip", x[2]))
        if abs(angle) > fitted
    ]
    if growth >= 0.0:
        time = 1.0 / max(growth, 1e-9)
        told.append(f"this trim is not stable: a deviation grows e-fold in {time:.3g} s, the flight ends elsewhere")
    return told


@kernel
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
    order = sorted(trims, key=lambda t: (not t.within_limits, not table_4(_unknowns(t), nominal), not t.stable))
    kept: list[Trim] = []
    for one in order:
        if not any(_same(one, other) for other in kept):
            kept.append(one)
    return kept


def table_4(x: Sequence[float], nominal: float) -> bool:
    """Whether the signs are those of one of the four spirals of Table 4, or of a straight glide of their kind.

    A dive has m_b, alpha and r_rx - nominal positive and theta negative, a climb the other way round; omega_3 has the
    sign of gamma; beta and phi have it on a climb, and the other one on a dive.
    """
    _, alpha, beta, omega3, phi, theta, rrx, gamma, mb = x
    way = math.copysign(1.0, mb)
    glide = all(way * value > 0.0 for value in (alpha, rrx - nominal, -theta))
    turning = [gamma, omega3, -way * beta, -way * phi]
    return glide and (all(v > 0.0 for v in turning) or all(v < 0.0 for v in turning) or all(v == 0.0 for v in turning))


def _same(a: Trim, b: Trim) -> bool:
    """Whether two solutions are one: speeds, angles and controls equal to 1e-6 in SI and rad."""
    return all(abs(x - y) < 1e-6 for x, y in zip(_unknowns(a), _unknowns(b), strict=True))


def _unknowns(t: Trim) -> tuple[float, ...]:
    """The nine unknowns of a trim."""
    return (
        t.speed, t.angle_of_attack, t.sideslip, t.yaw_rate, t.roll, t.pitch, t.mass_position, t.mass_rotation,
        t.net_buoyancy,
    )  # fmt: skip
