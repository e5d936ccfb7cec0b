"""Which samples cannot follow one another? Fixes too far apart for the time between them, and spikes of depth.

One rule for the fixes of all families. A glider at the surface drifts with the water, and surface currents reach some
2.5 m/s (the Agulhas Current, one of the swiftest: peaks exceeding 2.5 m/s, AMS Glossary of Meteorology); under water it
makes less than 1 m/s of its own, in weaker currents. So two fixes that lie further apart than 3 m/s times the time
between, and 50 m more, cannot both be right. The 50 m are the errors of both:
GPS is within 15 m in 95 % of cases at the worst site (GPS Standard Positioning Service Performance Standard, 5th ed.,
2020), and an antenna that is awash does worse. All fixes of a log are judged as one way, whatever files they stand in:
a stale one at the end of a file is shown by those of the next.

The most fixes that agree, each with the next, are kept; of several such choices that with the smoothest way. Where
these are not more than half of the log's, the vehicle may have been carried (01600001.dbd of dbdreader drives at 17
m/s), or two receivers disagree: then nothing tells what is wrong, and all are kept.

A depth spike leaves the samples before it by more than 3 m/s and 2 m and comes back by such a step within five samples.
Gliders sink and rise at tenths of a metre per second, which leaves room for one that falls or shoots up; 2 m are noise
and waves. Up to five samples before the first step that does not come back, or after the last, are a spike that the
file's end cuts. Any other such step is no spike: the samples stay, and no speed is derived across it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["CIRCLE", "DRIFT", "NOISE", "RATE", "agreeing", "beyond", "spikes"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
Mask = NDArray[np.bool_]

DRIFT = 3.0
"""m/s over ground, beyond which no glider moves by itself."""
CIRCLE = 50.0
"""m, errors of two fixes together."""
BACK = 10_000
"""Fixes before one that it may agree with; bounds the time that a hopeless file takes."""
RATE = 3.0
"""m/s of depth, beyond which no glider moves."""
NOISE = 2.0
"""m, noise of a depth sensor and waves."""
LONGEST = 5
"""Samples of a spike."""
EARTH = 6_371_000.0
"""m, mean radius; distances by it are within 0.6 %."""


def agreeing(time_ns: Times, latitude: Array, longitude: Array) -> Mask:
    """The most fixes that one vehicle can have had, (n,), and of several choices the smoothest.

    time_ns : (n,), UTC ns, strictly increasing. latitude, longitude : (n,), deg.
    """
    time, place = np.asarray(time_ns * 1e-9, np.float64), _on_sphere(latitude, longitude)
    steps, pauses = _apart(place[1:], place[:-1]), np.diff(time)
    breaks = np.flatnonzero(steps > CIRCLE + DRIFT * pauses)
    if not len(breaks):
        return np.ones(len(time), dtype=bool)
    strains = steps**2 / pauses
    length, cost, before = np.ones(len(time), dtype=int), np.zeros(len(time)), np.full(len(time), -1)
    longest, alone = 1, True  # of the chains so far, and whether one fix alone ends such
    j = 1
    while j < len(time):
        best = alone and length[j - 1] == longest
        if best and (end := int(np.append(breaks, len(time) - 1)[np.searchsorted(breaks, j - 1)]) + 1) > j:
            # the one longest chain goes on, fix by fix, to the next break
            length[j:end] = longest + np.arange(1, end - j + 1)
            cost[j:end] = np.cumsum(np.append(cost[j - 1], strains[j - 1 : end - 1]))[1:]
            before[j:end] = np.arange(j - 1, end - 1)
            longest, j = int(length[end - 1]), end
            continue
        first = j - 1 if best else max(0, j - BACK)
        i = _link(time, place, length, cost, first, j)
        if i is None and first:
            first = max(0, j - BACK)
            i = _link(time, place, length, cost, first, j)
        if i is not None:
            before[j], length[j], cost[j] = i, length[i] + 1, cost[i] + _strain(time, place, i, j)[0]
        alone = length[j] > longest or (alone and length[j] < longest)
        longest = max(longest, int(length[j]))
        j += 1
    ends = np.flatnonzero(length == longest)
    kept = np.zeros(len(time), dtype=bool)
    i = int(ends[cost[ends].argmin()])
    while i >= 0:
        kept[i] = True
        i = int(before[i])
    return kept


def _link(time: Array, place: Array, length: NDArray[np.int_], cost: Array, first: int, j: int) -> int | None:
    """The fix from ``first`` on that ends the longest, then the smoothest, chain that fix j can go on; or None."""
    near = first + np.flatnonzero(_apart(place[first:j], place[j]) <= CIRCLE + DRIFT * (time[j] - time[first:j]))
    if not len(near):
        return None
    near = near[length[near] == length[near].max()]
    return int(near[(cost[near] + _strain(time, place, near, j)).argmin()])


def _strain(time: Array, place: Array, i: int | NDArray[np.int_], j: int) -> Array:
    """Squared distance by time, m2/s: least in sum where a way is walked at an even pace."""
    return np.atleast_1d(_apart(place[i], place[j]) ** 2 / (time[j] - time[i]))


def _on_sphere(latitude: Array, longitude: Array) -> Array:
    """Places on a sphere, (n, 3), m."""
    north, east = np.radians(latitude), np.radians(longitude)
    axes = np.cos(north) * np.cos(east), np.cos(north) * np.sin(east), np.sin(north)
    return np.asarray(EARTH * np.stack(axes, axis=-1))


def _apart(one: Array, other: Array) -> Array:
    """Distance through the sphere, m; over the ways of a day it is that along the surface."""
    return np.asarray(np.linalg.norm(one - other, axis=-1))


def beyond(time_ns: Times, depth: Array) -> Mask:
    """Whether each step from a sample to the next, (n - 1,), is more than a glider can sink or rise.

    time_ns : (n,), UTC ns, strictly increasing. depth : (n,), m.
    """
    return np.asarray(np.abs(np.diff(depth)) > NOISE + RATE * np.diff(time_ns) * 1e-9)


def spikes(time_ns: Times, depth: Array) -> Mask:
    """The samples that leave those before and come back, (n,), or do so where the file begins or ends."""
    found = np.zeros(len(depth), dtype=bool)
    steps, stays, back = beyond(time_ns, depth), [], 0
    for k in np.flatnonzero(steps).tolist():
        if k < back:
            continue
        after = slice(k + 2, k + 2 + LONGEST)
        room = NOISE + RATE * (time_ns[after] - time_ns[k]) * 1e-9
        home = np.abs(depth[after] - depth[k]) <= room
        home &= steps[k + 1 : k + 1 + LONGEST]
        if home.any():
            back = k + 2 + int(home.argmax())
            found[k + 1 : back] = True
        else:
            stays.append(k)
    if stays and len(depth) > 4 * LONGEST:  # so that most of the file is on the other side
        if stays[0] < LONGEST:
            found[: stays[0] + 1] = True
        if stays[-1] >= len(depth) - 1 - LONGEST:
            found[stays[-1] + 1 :] = True
    return found
