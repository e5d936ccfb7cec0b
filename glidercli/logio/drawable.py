"""What of a Log can a viewer draw? Channels sampled together, numbers told by the metadata, the size of the hull."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Log

__all__ = ["hull_size", "number", "together"]

Times = NDArray[np.int64]
Array = NDArray[np.float64]

STAND_IN = (2.0, 0.22)  # m, length and diameter of a usual glider


def together(log: Log, *names: str) -> tuple[Times, list[Array]]:
    """The times at which all these channels have a sample, and the values there; empty where there is no such time."""
    if not all(name in log for name in names):
        return np.array([], np.int64), [np.array([]) for _ in names]
    times = log[names[0]].time_ns
    for name in names[1:]:
        if not np.array_equal(times, log[name].time_ns):
            times = np.intersect1d(times, log[name].time_ns, assume_unique=True)
    return times, [log[name].values[np.searchsorted(log[name].time_ns, times)] for name in names]


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
