"""Do the same things happen in both logs, and when?

Events are those that a log names, and from its depth: the deepest sample, the begin and the end of each dive and climb,
and, where it names none of its own, the apogee of each dive that a climb follows and the surfacing after each climb.
Events of one name are paired in order of time, the k-th measured with the simulated one that comes closest among those
left, not those further off than half of the shorter log lasts; an event without a partner stands alone.
"""

from __future__ import annotations

import bisect
import dataclasses
import itertools
import math

import numpy as np

from glidercli.compare.tracks import Tracks
from glidercli.dives import Interval
from glidercli.log import Channel, Event, Log
from glidercli.units import NANOSECOND

__all__ = ["EventPair", "events_of", "located", "paired"]

SURFACE = 2.0
"""m, of depth at the surface: a hull's length, for the pressure sensor is under water there, in waves."""


@dataclasses.dataclass(frozen=True)
class EventPair:
    """One event in both logs, or in one of them; times in UTC ns on the measured clock, depths in m.

    apart : where the simulated place is from the measured one, north and east, m, each at its own time; None where one
    is not known. way : m, of the measured track until then.
    """

    name: str
    measured: Event | None
    simulated: Event | None
    apart: tuple[float, float] | None = None
    way: float | None = None


def events_of(log: Log, intervals: tuple[Interval, ...]) -> tuple[Event, ...]:
    """Named and derived events of a log, in time order.

    intervals : the log's phases. Derived names are deepest, dive begins, dive ends, climb begins, climb ends, apogee
    and surfacing.
    """
    found = list(log.events)
    named = {event.name for event in log.events}
    if "depth" in log and len(log["depth"]):
        depth = log["depth"]
        deepest = int(np.argmax(depth.values))
        found.append(Event("deepest", int(depth.time_ns[deepest]), float(depth.values[deepest])))
        for interval in intervals:
            for word, time_ns in (("begins", interval.start_ns), ("ends", interval.end_ns - 1)):
                at = float(np.interp(time_ns, depth.time_ns, depth.values))
                found.append(Event(f"{interval.name} {word}", time_ns, at))
        if "apogee" not in named:
            found += _apogees(depth, intervals)
        if "surfacing" not in named:
            found += _surfacings(depth, intervals)
    return tuple(sorted(found, key=lambda event: (event.time_ns, event.name)))


def _apogees(depth: Channel, intervals: tuple[Interval, ...]) -> list[Event]:
    """The deepest sample of each dive and the climb after it."""
    found = []
    for dive, climb in itertools.pairwise(intervals):
        if (dive.name, climb.name) == ("dive", "climb"):
            part = depth.sliced(dive.start_ns, climb.end_ns)
            if len(part):
                deepest = int(np.argmax(part.values))
                found.append(Event("apogee", int(part.time_ns[deepest]), float(part.values[deepest])))
    return found


def _surfacings(depth: Channel, intervals: tuple[Interval, ...]) -> list[Event]:
    """The first sample at the surface after each climb, before the next dive."""
    found = []
    for number, climb in enumerate(intervals):
        if climb.name == "climb":
            after = intervals[number + 1].start_ns + 1 if number + 1 < len(intervals) else None
            part = depth.sliced(climb.start_ns, after)
            afloat = np.flatnonzero(part.values <= SURFACE)
            if len(afloat):
                found.append(Event("surfacing", int(part.time_ns[afloat[0]]), float(part.values[afloat[0]])))
    return found


def paired(
    measured: tuple[Event, ...], simulated: tuple[Event, ...], furthest: float = math.inf
) -> tuple[EventPair, ...]:
    """Events of both logs side by side, in time order. furthest : s, from which on two are not the same one."""
    left: dict[str, list[Event]] = {}
    for event in sorted(simulated, key=_when):
        left.setdefault(event.name, []).append(event)
    pairs = []
    for event in measured:
        others = left.get(event.name, [])
        near = _nearest(others, event.time_ns, furthest)
        pairs.append(EventPair(event.name, event, None if near is None else others.pop(near)))
    pairs += [EventPair(event.name, None, event) for others in left.values() for event in others]
    return tuple(sorted(pairs, key=lambda pair: (pair.measured or pair.simulated or Event("", 0)).time_ns))


def _nearest(events: list[Event], time_ns: int, furthest: float) -> int | None:
    """The place of the event nearest to a time, UTC ns, the earlier of two; None beyond so many s."""
    after = bisect.bisect_left(events, time_ns, key=_when)
    apart = [(abs(events[i].time_ns - time_ns) * NANOSECOND, i) for i in (after - 1, after) if 0 <= i < len(events)]
    return min((one for one in apart if one[0] <= furthest), default=(0.0, None))[1]


def _when(event: Event) -> int:
    return event.time_ns


def located(pairs: tuple[EventPair, ...], tracks: Tracks | None, max_gap: float) -> tuple[EventPair, ...]:
    """The pairs with how far apart their places are, where both tracks tell; max_gap : s, as for ``residuals``."""
    if tracks is None:
        return pairs
    return tuple(_located(pair, tracks, max_gap) for pair in pairs)


def _located(pair: EventPair, tracks: Tracks, max_gap: float) -> EventPair:
    if pair.measured is None or pair.simulated is None:
        return pair
    one = tracks.measured.at(pair.measured.time_ns, max_gap)
    other = tracks.simulated.at(pair.simulated.time_ns, max_gap)
    if one is None or other is None:
        return pair
    north, east = (other - one)[:2].tolist()
    return dataclasses.replace(pair, apart=(north, east), way=tracks.measured.length_until(pair.measured.time_ns))
