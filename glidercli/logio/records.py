"""Which records of a file can be used? The others are dropped, each by a named rule, and counted.

A record is a line, a row or a cycle: one time and the values noted at it. Rules, in this order: its time cannot be
read; its clock was not set; it holds no value, or zeros alone; its time breaks the order of the others.

Zeros alone are what is told of sensors that are not fitted, or did not sample: rows of .ebd with temperature,
conductivity and pressure 0, a first cycle with depth, pitch and fin 0 (comet 2019). A vehicle at the surface tells a
depth of 0, too, and an actuator rests at 0: where a record tells of nothing else, zeros are readings (six cycles of
unit_887-2021-321-3-0.sbd, three of electa-2023-143-00-050.sbd, with m_depth alone).
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Collection, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel
from glidercli.years import FIRST_YEAR, LAST_YEAR

__all__ = ["CHANNELS_AT_REST", "NO_TIME", "OUT_OF_ORDER", "YEARS", "in_order", "sampled", "to_ns", "usable"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
Mask = NDArray[np.bool_]

NO_TIME = np.iinfo(np.int64).min
"""Stands for a time that cannot be read."""
YEARS = (f"{FIRST_YEAR}-01-01", f"{LAST_YEAR}-01-01")
"""Times allowed: nanoseconds in 64 bits hold little more, and others would come back as times between."""
STRAY = 30 * 86400 * 10**9
"""Times of one file that stand further apart than this are of two clocks, ns."""
BORN = 631_152_000 * 10**9
"""1990-01-01, UTC ns: no glider flew before."""
CHANNELS_AT_REST = frozenset(
    ("depth", "pressure", "phase", "mass_position", "mass_rotation", "net_buoyancy", "ballast_volume", "rudder_angle")
)
"""Channels of which zero is a reading like others: at the surface, in phase 0, at an actuator's own zero."""
OUT_OF_ORDER = "time goes back", "time runs ahead of those after it"
"""Reasons for which records are dropped."""
HELD = 3
"""So many records show that a clock was set; fewer may be garbled."""
SHARE = 0.05
"""So large a part of a file's records is no accident in its middle."""


def to_ns(moments: Any) -> Times:
    """UTC ns of a pandas Series of times without a zone; NO_TIME where it has none, or one outside of YEARS."""
    import pandas as pd

    told = moments.between(*map(pd.Timestamp, YEARS))
    return np.asarray(np.where(told, moments.where(told).to_numpy().astype("datetime64[ns]").astype(np.int64), NO_TIME))


def usable(
    time_ns: Times, cells: Mapping[str, Array], dropped: Counter[str], at_rest: Collection[str] = CHANNELS_AT_REST
) -> Mask:
    """Which records can be used, (n,); the others are counted in ``dropped`` by their reason.

    time_ns : (n,), UTC ns, NO_TIME where it cannot be read. cells : (n,) by column, not finite where there is no value.
    at_rest : columns whose zeros are readings, where a record tells of no other.
    """
    good: Mask = time_ns != NO_TIME
    _count(dropped, "time cannot be read", ~good)
    unset = good & (time_ns < BORN)
    _count(dropped, "clock not set: before 1990", unset)
    good &= ~unset
    if good.any():
        first, last = _set_clock(time_ns[good])
        before, after = good & (time_ns < first), good & (time_ns > last)
        _count(dropped, "clock not set: more than 30 days before the file's other times", before)
        _count(dropped, "time more than 30 days after the file's other times", after)
        good &= ~(before | after)
    told = np.zeros(len(time_ns), dtype=bool)
    sized, resting = np.zeros(len(time_ns), dtype=bool), np.ones(len(time_ns), dtype=bool)
    for name, values in cells.items():
        finite = np.isfinite(values)
        told |= finite
        sized |= finite & (values != 0.0)
        if name not in at_rest:
            resting &= ~finite
    _count(dropped, "no value", good & ~told)
    _count(dropped, "all values zero", good & told & ~sized & ~resting)
    good &= told & (sized | resting)
    good[good] = in_order(time_ns[good], dropped)
    return good


def sampled(time_ns: Times, channels: Mapping[str, Channel]) -> Mask:
    """Which records gave a sample to a channel, (n,). time_ns : (n,) increasing; every sample is at one of them."""
    gave = np.zeros(len(time_ns), dtype=bool)
    for channel in channels.values():
        gave[np.searchsorted(time_ns, channel.time_ns)] = True
    return gave


def _count(dropped: Counter[str], reason: str, which: Mask) -> None:
    if count := int(which.sum()):
        dropped[reason] += count


def in_order(time_ns: Times, dropped: Counter[str]) -> Mask:
    """The most records whose times increase, (n,); the others are counted in ``dropped``.

    So a few records from a clock that jumped, ahead or back, do not take the rest with them. Of records with the same
    time the first is kept.
    """
    kept = np.ones(len(time_ns), dtype=bool)
    if (np.diff(time_ns) > 0).all():
        return kept
    kept = _longest_increasing(time_ns)
    latest = np.maximum.accumulate(np.where(kept, time_ns, NO_TIME))
    back, ahead = OUT_OF_ORDER
    for time, before in zip(time_ns[~kept], latest[~kept], strict=True):
        dropped["time repeats" if time == before else back if time < before else ahead] += 1
    return kept


def _longest_increasing(time_ns: Times) -> Mask:
    """The longest strictly increasing subsequence, by patience sorting; of equal times the first."""
    ends: list[int] = []  # the least last time of an increasing run of each length, and its place
    places: list[int] = []
    before = np.full(len(time_ns), -1)
    for i, time in enumerate(time_ns.tolist()):
        length = bisect_left(ends, time)
        before[i] = places[length - 1] if length else -1
        if length == len(ends):
            ends.append(time)
            places.append(i)
        elif time < ends[length]:
            ends[length], places[length] = time, i
    kept = np.zeros(len(time_ns), dtype=bool)
    i = places[-1]
    while i >= 0:
        kept[i] = True
        i = int(before[i])
    return kept


def _set_clock(time_ns: Times) -> tuple[int, int]:
    """First and last time by the clock as it was set, ns.

    A clock that is not set runs behind, and may do so for most of a file; once set it stays so. So of the groups of
    times that lie STRAY apart the latest with HELD records counts, if the file ends in it or it has a SHARE of the
    records; where there is none, the largest. time_ns : (n,), in the file's order.
    """
    ordered = np.sort(time_ns)
    groups = np.split(ordered, np.flatnonzero(np.diff(ordered) > STRAY) + 1)[::-1]
    held = (g for g in groups if len(g) >= HELD and (g[0] <= time_ns[-1] <= g[-1] or len(g) >= SHARE * len(ordered)))
    group = next(held, max(groups, key=len))
    return int(group[0]), int(group[-1])
