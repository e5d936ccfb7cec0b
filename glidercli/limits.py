"""Which values of a channel cannot be? Bounds in SI, wide enough for any ocean and any glider."""

from __future__ import annotations

import math

from glidercli.channels import CHANNELS, PHASES

__all__ = ["limits_of"]

_TURN = 2.0 * math.pi
_LIMITS: dict[str, tuple[float, float]] = {
    "depth": (-10.0, 12000.0),
    "pressure": (-1e5, 1.25e8),
    "latitude": (-90.0, 90.0),
    "longitude": (-180.0, 360.0),
    "north": (-1e9, 1e9),
    "east": (-1e9, 1e9),
    "down": (-10.0, 12000.0),
    "roll": (-math.pi, math.pi),
    "pitch": (-0.5 * math.pi, 0.5 * math.pi),
    "heading": (-math.pi, _TURN),
    "mass_rotation": (-_TURN, _TURN),
    "mass_position": (-5.0, 5.0),
    "net_buoyancy": (-100.0, 100.0),
    "ballast_volume": (-0.1, 0.1),
    "rudder_angle": (-0.5 * math.pi, 0.5 * math.pi),
    "angle_of_attack": (-math.pi, math.pi),
    "sideslip": (-math.pi, math.pi),
    "temperature": (-3.0, 45.0),
    "conservative_temperature": (-3.0, 45.0),
    "conductivity": (0.0, 8.0),
    "salinity": (0.0, 45.0),
    "absolute_salinity": (0.0, 45.0),
    "density": (900.0, 1200.0),
    "phase": (0.0, len(PHASES) - 1.0),
}
_OF_UNIT = {"m/s": (-10.0, 10.0), "rad/s": (-_TURN, _TURN)}


def limits_of(channel: str) -> tuple[float, float]:
    """The least and the largest value, SI, rad; a rounding at a bound is allowed for."""
    low, high = _LIMITS.get(channel) or _OF_UNIT[CHANNELS[channel].unit]
    slack = 1e-9 * max(abs(low), abs(high))
    return low - slack, high + slack
