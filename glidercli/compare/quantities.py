"""What is a figure of a flight, such as its depth, its turn or its mean pitch? Of the whole log, or of its legs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.compare.facts import FLIGHT, OTHER
from glidercli.dives import Interval
from glidercli.log import Log
from glidercli.residuals import table_values
from glidercli.units import NANOSECOND

__all__ = ["Missing", "quantity"]

Array = NDArray[np.float64]
Series = tuple[NDArray[np.int64], Array]


class Missing(Exception):
    """The log does not hold what the quantity needs."""


def quantity(name: str, channel: str | None, phase: str, log: Log, intervals: tuple[Interval, ...]) -> float:
    """The value of a quantity, in its own unit; see facts.py for what each means.

    channel : of the quantities that are of one. phase : "flight", "dive" or "climb". intervals : the log's phases.

    Raises Missing where the log does not hold what it needs.
    """
    if name == OTHER:
        raise Missing("no log holds it")
    if channel is not None:
        series = _series(log, channel, phase, intervals)
        return _statistic(name, series)
    if name == "density_change":
        return _density_change(log, phase, intervals)
    if name in ("heading_change", "turn_rate"):
        series = _series(log, "heading", phase, intervals)
        turn = sum(float(part[-1] - part[0]) for _, part in series)
        return turn if name == "heading_change" else turn / _lasting(series)
    series = _series(log, "depth", phase, intervals)
    if name == "duration":
        return _lasting(series)
    time_ns, depth = (np.concatenate(column) for column in zip(*series, strict=True))
    deepest = int(np.argmax(depth))
    if name == "max_depth":
        return float(depth[deepest])
    return int(time_ns[deepest] - time_ns[0]) * NANOSECOND


def _series(log: Log, name: str, phase: str, intervals: tuple[Interval, ...]) -> list[Series]:
    """Samples of a channel, UTC ns and table unit, one entry for each interval of the phase that has any."""
    if name not in log or not len(log[name]):
        raise Missing(f"the log has no {name}")
    channel = log[name]
    values = table_values(channel)
    if phase == FLIGHT:
        return [(channel.time_ns, values)]
    named = [interval for interval in intervals if interval.name == phase]
    if not named:
        raise Missing(f"the log has no {phase}")
    inside = [(channel.time_ns >= one.start_ns) & (channel.time_ns < one.end_ns) for one in named]
    series = [(channel.time_ns[chosen], values[chosen]) for chosen in inside if chosen.any()]
    if not series:
        raise Missing(f"the log has no {name} on the {phase}")
    return series


def _lasting(series: list[Series]) -> float:
    """Time that the intervals cover together, s."""
    lasting = sum(int(time_ns[-1] - time_ns[0]) for time_ns, _ in series) * NANOSECOND
    if lasting <= 0.0:
        raise Missing("one sample lasts no time")
    return lasting


def _statistic(name: str, series: list[Series]) -> float:
    values = np.concatenate([part for _, part in series])
    if name == "mean":
        weights = np.concatenate([_weights(time_ns) for time_ns, _ in series])
        return float(np.average(values, weights=weights if weights.any() else None))
    if name == "range":
        return float(np.ptp(values))
    if name in ("first", "last"):
        return float(values[0 if name == "first" else -1])
    if name == "median":
        return float(np.median(values))
    return float(values.min() if name == "minimum" else values.max())


def _weights(time_ns: NDArray[np.int64]) -> Array:
    """Trapezoid weights of samples, s."""
    half: Array = 0.5 * NANOSECOND * np.diff(time_ns)
    weights = np.zeros(len(time_ns))
    weights[:-1] += half
    weights[1:] += half
    return weights


def _density_change(log: Log, phase: str, intervals: tuple[Interval, ...]) -> float:
    """100 (rho_deepest / rho_shallowest - 1), %, over density samples whose depth is known."""
    series = _series(log, "density", phase, intervals)
    if "depth" not in log or not len(log["depth"]):
        raise Missing("the log has no depth")
    time_ns, density = (np.concatenate(column) for column in zip(*series, strict=True))
    depth = log["depth"]
    at = np.interp(time_ns, depth.time_ns, depth.values)
    return 100.0 * float(density[np.argmax(at)] / density[np.argmin(at)] - 1.0)
