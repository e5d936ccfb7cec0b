"""Do the same things happen in both logs, and when?

Events are those that a log names, and from its depth: the deepest sample, and the begin and the end of each dive and
climb. Events of one name are paired in order of time, the k-th measured with the simulated one that comes closest
among those left; an event without a partner stands alone.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from glidercli.dives import Interval
from glidercli.log import Event, Log

__all__ = ["EventPair", "events_of", "paired"]


@dataclasses.dataclass(frozen=True)
class EventPair:
    """One event in both logs, or in one of them; times in UTC ns on the measured clock, depths in m."""

    name: str
    measured: Event | None
    simulated: Event | None


def events_of(log: Log, intervals: tuple[Interval, ...]) -> tuple[Event, ...]:
    """Named and derived events of a log, in time order.

    intervals : the log's phases. Derived names are deepest, dive begins, dive ends, climb begins and climb ends.
    """
    found = list(log.events)
    if "depth" in log and len(log["depth"]):
        depth = log["depth"]
        deepest = int(np.argmax(depth.values))
        found.append(Event("deepest", int(depth.time_ns[deepest]), float(depth.values[deepest])))
        for interval in intervals:
            for word, time_ns in (("begins", interval.start_ns), ("ends", interval.end_ns - 1)):
                at = float(np.interp(time_ns, depth.time_ns, depth.values))
                found.append(Event(f"{interval.name} {word}", time_ns, at))
    return tuple(sorted(found, key=lambda event: (event.time_ns, event.name)))


def paired(measured: tuple[Event, ...], simulated: tuple[Event, ...]) -> tuple[EventPair, ...]:
    """Events of both logs side by side, in time order."""
    left = list(simulated)
    pairs = []
    for event in measured:
        partners = [other for other in left if other.name == event.name]
        partner = min(partners, key=lambda other: abs(other.time_ns - event.time_ns), default=None)
        if partner is not None:
            left.remove(partner)
        pairs.append(EventPair(event.name, event, partner))
    pairs += [EventPair(event.name, None, event) for event in left]
    return tuple(sorted(pairs, key=lambda pair: (pair.measured or pair.simulated or Event("", 0)).time_ns))
