"""When does a log dive and when does it climb?

The phase channel answers where a log has one that names a dive or a climb; otherwise depth alone does. A turning point
is a deepest or shallowest sample from which depth moves back by at least ``prominence``; between two turning points
lies one dive or one climb. What stays within a fifth of the prominence of a turning point is the turn itself (surface
drift, apogee, hover) and belongs to neither; where samples are so sparse that one alone is the turn, it ends the first.
The first and the last extreme of a log count as turning points, so that a log that only descends is one dive. A log
whose depth changes by less than 1 m has neither.

No dive or climb goes on across a cut: a time without a sample that is long enough for the vehicle to have been at the
surface in between, for all that is known. What stands on either side is found by itself.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.errors import InputError
from glidercli.log import Channel, Log

__all__ = [
    "LEAST_GAP", "LEAST_RANGE", "LEGS", "MANY", "Interval", "cuts", "long_gaps", "mask", "phases", "turning_points",
]  # fmt: skip

Times = NDArray[np.int64]

LEGS = ("dive", "climb")
"""Phases that errors are given for apart."""

PROMINENCE = 5.0
"""m; with less than 50 m of depth range a tenth of the range: waves, sensor noise and held depths stay below it."""

LEAST_RANGE = 1.0
"""m; a log that moves less has neither dive nor climb."""


LEAST_GAP, MANY = 300.0, 5.0
"""A time between samples of more than so many seconds, and of so many times the usual one, is a long gap: deep legs are
sampled every few minutes at most."""

FASTEST = 0.5
"""m/s, up or down: as fast as gliders go. In a gap that is shorter than the way up and down again takes at this speed
none was at the surface."""


class Interval(NamedTuple):
    """One phase: start_ns <= time < end_ns, UTC nanoseconds."""

    name: str
    start_ns: int
    end_ns: int


def phases(log: Log, prominence: float | None = None) -> tuple[Interval, ...]:
    """Dives and climbs of a log in time order.

    prominence : m, positive: depth that a turning point must stand out by; default: 5 m or a tenth of the depth range,
        whichever is smaller.

    Raises InputError when prominence is not positive.
    """
    if prominence is not None and not prominence > 0.0:
        raise InputError("prominence", f"{prominence} m; allowed: a positive depth")
    apart = cuts(log)
    named = _from_channel(log["phase"], apart) if "phase" in log else ()
    if named:
        return named
    return _from_depth(log["depth"], prominence, apart) if "depth" in log else ()


def long_gaps(time_ns: Times) -> Times:
    """Where samples are missing for long, (n, 2): the sample before and the one after each gap, UTC ns.

    time_ns : (m,), UTC ns, strictly increasing.
    """
    steps = np.diff(time_ns) * 1e-9
    if not len(steps):
        return np.empty((0, 2), np.int64)
    wide = np.flatnonzero(steps > max(LEAST_GAP, MANY * float(np.median(steps))))
    return np.stack([time_ns[wide], time_ns[wide + 1]], axis=1)


def cuts(log: Log) -> Times:
    """The long gaps in which the vehicle may have been at the surface, (n, 2) as ``long_gaps``.

    A gap is a time without a sample of depth and of phase: the phase of some recordings is told where it begins.
    """
    told = [log[name].time_ns for name in ("depth", "phase") if name in log]
    gaps = long_gaps(np.unique(np.concatenate(told))) if told else np.empty((0, 2), np.int64)
    if not len(gaps) or "depth" not in log or not len(log["depth"]):
        return gaps
    times, depth = log["depth"].time_ns, log["depth"].values
    before = np.clip(np.searchsorted(times, gaps[:, 0], side="right") - 1, 0, None)
    after = np.clip(np.searchsorted(times, gaps[:, 1]), None, len(times) - 1)
    way = np.maximum(depth[before], 0.0) + np.maximum(depth[after], 0.0)
    return gaps[(gaps[:, 1] - gaps[:, 0]) * 1e-9 * FASTEST > way]


def mask(time_ns: Times, intervals: tuple[Interval, ...], name: str) -> NDArray[np.bool_]:
    """Which of the times, (n,) UTC ns, lie in an interval of this name, (n,); intervals ordered by begin."""
    spans = np.array([(i.start_ns, i.end_ns) for i in intervals if i.name == name], np.int64).reshape(-1, 2)
    begun = np.searchsorted(spans[:, 0], time_ns, side="right")
    reach = np.concatenate([[np.iinfo(np.int64).min], np.maximum.accumulate(spans[:, 1])])
    return np.asarray(time_ns < reach[begun])


def turning_points(depth: NDArray[np.float64], prominence: float) -> list[int]:
    """Indices of the turning points of depth, m, alternately shallow and deep, the first and last extreme included.

    Empty when depth never moves by ``prominence``, m.
    """
    turns: list[int] = []
    deepening = None
    shallow = deep = 0
    values = depth.tolist()
    for index, value in enumerate(values):
        if value > values[deep]:
            deep = index
        if value < values[shallow]:
            shallow = index
        if deepening is not True and value - values[shallow] >= prominence:
            turns.append(shallow)
            deepening, deep = True, index
        elif deepening is not False and values[deep] - value >= prominence:
            turns.append(deep)
            deepening, shallow = False, index
    if deepening is not None:
        turns.append(deep if deepening else shallow)
    return turns


def _from_depth(channel: Channel, prominence: float | None, apart: Times) -> tuple[Interval, ...]:
    """Between the turning points of each piece of the log; what a turn is goes by the log as a whole."""
    depth = channel.values
    if len(depth) < 2 or np.ptp(depth) < LEAST_RANGE:
        return ()
    least = prominence if prominence is not None else min(PROMINENCE, 0.1 * float(np.ptp(depth)))
    bounds = [0, *np.searchsorted(channel.time_ns, apart[:, 1]).tolist(), len(depth)]
    return tuple(
        leg
        for first, last in itertools.pairwise(bounds)
        for leg in _of_piece(channel.time_ns[first:last], depth[first:last], least)
    )


def _of_piece(time_ns: Times, depth: NDArray[np.float64], least: float) -> list[Interval]:
    """Dives and climbs of samples without a cut; least : prominence, m."""
    turns = turning_points(depth, least)
    intervals: list[Interval] = []
    for first, last in itertools.pairwise(turns):
        away = np.abs(depth[first : last + 1] - depth[first])
        ahead = np.abs(depth[first : last + 1] - depth[last])
        start = first + int(np.flatnonzero(away <= least / 5.0)[-1])
        end = start + int(np.flatnonzero(ahead[start - first :] <= least / 5.0)[0])
        name = "dive" if depth[last] > depth[first] else "climb"
        begin = max(int(time_ns[start]), intervals[-1].end_ns if intervals else 0)
        intervals.append(Interval(name, begin, int(time_ns[end]) + 1))
    return intervals


def _from_channel(channel: Channel, apart: Times) -> tuple[Interval, ...]:
    """Runs of one phase; each sample holds until the next, but not across a cut."""
    if not len(channel):
        return ()
    codes, time_ns = channel.values.astype(int), channel.time_ns
    pieces = np.searchsorted(apart[:, 1], time_ns, side="right")
    starts = np.concatenate([[0], np.flatnonzero((np.diff(codes) != 0) | (np.diff(pieces) != 0)) + 1])
    ends = [*time_ns[starts[1:]].tolist(), int(time_ns[-1]) + 1]
    silent = dict(enumerate(apart[:, 0].tolist()))
    ends = [min(end, silent.get(int(pieces[start]), end) + 1) for start, end in zip(starts, ends, strict=True)]
    return tuple(
        Interval(PHASES[codes[start]], int(time_ns[start]), int(end))
        for start, end in zip(starts, ends, strict=True)
        if PHASES[codes[start]] in LEGS
    )
