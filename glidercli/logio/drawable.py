"""What of a Log's metadata can a viewer draw? Numbers, the size of the hull, where it was."""

from __future__ import annotations

import math

from glidercli.log import Log

__all__ = ["bottom", "hull_size", "number", "origin"]

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


def origin(log: Log) -> tuple[float, float] | None:
    """Latitude and longitude, deg, of what north and east are counted from; None where they are unknown."""
    latitude, longitude = number(log, "origin_latitude_deg"), number(log, "origin_longitude_deg")
    if latitude is None or longitude is None or not abs(latitude) <= 90.0 or not abs(longitude) <= 360.0:
        return None
    return latitude, longitude


def bottom(log: Log) -> float | None:
    """Depth of the bottom, m, where the log tells it."""
    depth = number(log, "bottom_depth_m")
    return depth if depth is not None and depth > 0.0 else None
