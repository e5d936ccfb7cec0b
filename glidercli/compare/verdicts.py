"""Does a simulated log agree with published values? Each fact gets its simulated value and one of three verdicts."""

from __future__ import annotations

import dataclasses
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from glidercli.compare.facts import FLIGHT, OTHER, Fact, Facts
from glidercli.dives import Interval, phases
from glidercli.log import Log
from glidercli.residuals import on_circle, table_values
from glidercli.units import NANOSECOND

__all__ = ["FactVerdict", "Verdict", "judged", "quantity"]

Verdict = Literal["agrees", "disagrees", "not simulated"]

Array = NDArray[np.float64]
Series = tuple[NDArray[np.int64], Array]


@dataclasses.dataclass(frozen=True)
class FactVerdict:
    """A fact, the same quantity of the simulated log, and whether |difference| <= tolerance.

    simulated, difference : in the fact's unit; None when not simulated, and ``reason`` says why. difference is
        simulated - published; for angles on the circle in (-180, 180] deg, simulated then being published + difference.
    """

    fact: Fact
    simulated: float | None
    difference: float | None
    verdict: Verdict
    reason: str = ""


class _NotSimulated(Exception):
    """The log does not hold what the quantity needs."""


def judged(facts: Facts, log: Log) -> tuple[FactVerdict, ...]:
    """The verdict on every fact."""
    intervals = phases(log)
    return tuple(_judged(fact, log, intervals) for fact in facts.facts)


def _judged(fact: Fact, log: Log, intervals: tuple[Interval, ...]) -> FactVerdict:
    try:
        simulated = quantity(fact, log, intervals)
    except _NotSimulated as missing:
        return FactVerdict(fact, None, None, "not simulated", str(missing))
    difference = simulated - fact.value
    if fact.channel is not None and on_circle(fact.channel) and fact.quantity != "range":
        difference -= 360.0 * np.ceil(difference / 360.0 - 0.5)
        simulated = fact.value + float(difference)
    verdict: Verdict = "agrees" if abs(difference) <= fact.tolerance else "disagrees"
    return FactVerdict(fact, simulated, float(difference), verdict)


def quantity(fact: Fact, log: Log, intervals: tuple[Interval, ...]) -> float:
    """The value that a log gives for a fact's quantity, in the fact's unit; see facts.py for what each means."""
    if fact.quantity == OTHER:
        raise _NotSimulated("no log holds it")
    if fact.channel is not None:
        series = _series(log, fact.channel, fact.phase, intervals)
        return _statistic(fact.quantity, series)
    if fact.quantity == "density_change":
        return _density_change(log, fact.phase, intervals)
    if fact.quantity in ("heading_change", "turn_rate"):
        series = _series(log, "heading", fact.phase, intervals)
        turn = sum(float(part[-1] - part[0]) for _, part in series)
        return turn if fact.quantity == "heading_change" else turn / _lasting(series)
    series = _series(log, "depth", fact.phase, intervals)
    if fact.quantity == "duration":
        return _lasting(series)
    time_ns, depth = (np.concatenate(column) for column in zip(*series, strict=True))
    deepest = int(np.argmax(depth))
    if fact.quantity == "max_depth":
        return float(depth[deepest])
    return int(time_ns[deepest] - time_ns[0]) * NANOSECOND


def _series(log: Log, name: str, phase: str, intervals: tuple[Interval, ...]) -> list[Series]:
    """Samples of a channel, UTC ns and table unit, one entry for each interval of the phase that has any."""
    if name not in log or not len(log[name]):
        raise _NotSimulated(f"the log has no {name}")
    channel = log[name]
    values = table_values(channel)
    if phase == FLIGHT:
        return [(channel.time_ns, values)]
    named = [interval for interval in intervals if interval.name == phase]
    if not named:
        raise _NotSimulated(f"the log has no {phase}")
    inside = [(channel.time_ns >= one.start_ns) & (channel.time_ns < one.end_ns) for one in named]
    series = [(channel.time_ns[chosen], values[chosen]) for chosen in inside if chosen.any()]
    if not series:
        raise _NotSimulated(f"the log has no {name} on the {phase}")
    return series


def _lasting(series: list[Series]) -> float:
    """Time that the intervals cover together, s."""
    lasting = sum(int(time_ns[-1] - time_ns[0]) for time_ns, _ in series) * NANOSECOND
    if lasting <= 0.0:
        raise _NotSimulated("one sample lasts no time")
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
        raise _NotSimulated("the log has no depth")
    time_ns, density = (np.concatenate(column) for column in zip(*series, strict=True))
    depth = log["depth"]
    at = np.interp(time_ns, depth.time_ns, depth.values)
    return 100.0 * float(density[np.argmax(at)] / density[np.argmin(at)] - 1.0)
