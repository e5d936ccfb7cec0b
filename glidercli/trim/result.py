"""What is a trim? The ten parameters of a steady flight and what follows from them."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from glidercli.frames import Vector, dot, down_in_body
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.parameters import Parameters

__all__ = ["Trim"]

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


def speeds(speed: float, alpha: float, beta: float, roll: float, pitch: float) -> tuple[float, float]:
    """Vertical speed V . k_b, positive down, and horizontal speed, m/s."""
    V: Vector = velocity_from_flow(speed, alpha, beta)
    vertical = dot(V, down_in_body(roll, pitch))
    return vertical, math.sqrt(max(0.0, speed * speed - vertical * vertical))


def lift_to_drag(alpha: float, p: Parameters) -> float:
    """L / D of eq. (20), signed as the lift."""
    return (p.KL0 + p.Kalpha * alpha) / (p.KD0 + p.KD * alpha * alpha)
