"""When does a log dive and when does it climb?

The phase channel answers where a log has one that names a dive or a climb; otherwise depth alone does. A turning point
is a deepest or shallowest sample from which depth moves back by at least ``prominence``; between two turning points
lies one dive or one climb. What stays within a fifth of the prominence of a turning point is the turn itself (surface
drift, apogee, hover) and belongs to neither; where samples are so sparse that one alone is the turn, it ends the first.
The first and the last extreme of a log count as turning points, so that a log that only descends is one dive. A log
whose depth changes by less than 1 m has neither.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.errors import InputError
from glidercli.log import Channel, Log

__all__ = ["LEGS", "Interval", "mask", "phases", "turning_points"]

LEGS = ("dive", "climb")
"""Phases that errors are given for apart."""

PROMINENCE = 5.0
"""m; with less than 50 m of depth range a tenth of the range: waves, sensor noise and held depths stay below it."""

LEAST_RANGE = 1.0
"""m; a log that moves less has neither dive nor climb."""


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
    named = _from_channel(log["phase"]) if "phase" in log else ()
    if named:
        return named
    return _from_depth(log["depth"], prominence) if "depth" in log else ()


def mask(time_ns: NDArray[np.int64], intervals: tuple[Interval, ...], name: str) -> NDArray[np.bool_]:
    """Which of the times, (n,) UTC ns, lie in an interval of this name; (n,)."""
    inside = np.zeros(len(time_ns), dtype=bool)
    for interval in intervals:
        if interval.name == name:
            inside |= (time_ns >= interval.start_ns) & (time_ns < interval.end_ns)
    return inside


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


def _from_depth(channel: Channel, prominence: float | None) -> tuple[Interval, ...]:
    depth = channel.values
    if len(depth) < 2 or np.ptp(depth) < LEAST_RANGE:
        return ()
    least = prominence if prominence is not None else min(PROMINENCE, 0.1 * float(np.ptp(depth)))
    turns = turning_points(depth, least)
    intervals: list[Interval] = []
    for first, last in itertools.pairwise(turns):
        away = np.abs(depth[first : last + 1] - depth[first])
        ahead = np.abs(depth[first : last + 1] - depth[last])
        start = first + int(np.flatnonzero(away <= least / 5.0)[-1])
        end = start + int(np.flatnonzero(ahead[start - first :] <= least / 5.0)[0])
        name = "dive" if depth[last] > depth[first] else "climb"
        begin = max(int(channel.time_ns[start]), intervals[-1].end_ns if intervals else 0)
        intervals.append(Interval(name, begin, int(channel.time_ns[end]) + 1))
    return tuple(intervals)


def _from_channel(channel: Channel) -> tuple[Interval, ...]:
    """Runs of one phase; each sample holds until the next."""
    if not len(channel):
        return ()
    codes = channel.values.astype(int)
    starts = np.concatenate([[0], np.flatnonzero(np.diff(codes)) + 1])
    ends = [*channel.time_ns[starts[1:]].tolist(), int(channel.time_ns[-1]) + 1]
    return tuple(
        Interval(PHASES[codes[start]], int(channel.time_ns[start]), int(end))
        for start, end in zip(starts, ends, strict=True)
        if PHASES[codes[start]] in LEGS
    )
