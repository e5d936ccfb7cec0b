"""What of a Log's metadata can a viewer draw? Numbers, and the size of the hull."""

from __future__ import annotations

import math

from glidercli.log import Log

__all__ = ["hull_size", "number"]

STAND_IN = (2.0, 0.22)  # m, length and diameter of a usual glider


def number(log: Log, key: str) -> float | None:
    """A number told by the log's metadata, or None where it is missing, not finite or no number."""
    try:
        value = float(log.metadata[key])
    except (KeyError, ValueError):
        return None
    return value if math.isfinite(value) else None


def hull_size(log: Log) -> tuple[float, float, bool]:
    """Length and diameter of the hull, m, and whether they are the vehicle's own (metadata) or only a stand-in."""
    length, diameter = number(log, "hull_length_m"), number(log, "hull_diameter_m")
    if length is None or diameter is None or not length > diameter > 0.0:
        return *STAND_IN, False
    return length, diameter, True
