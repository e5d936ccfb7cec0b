"""How far apart are two tracks? Absolute and relative errors, as those who evaluate trajectories define them.

The measured samples set the times; the simulated track is interpolated to them, see residuals.py. With p the measured
and s the simulated places, (n, 3), north, east, down, m, about one origin:

    absolute    |s_i - p_i|: the absolute trajectory error (Sturm et al. 2012)
    aligned     |R (s_i - mean s) - (p_i - mean p)|: the same after the one turn R about the vertical, and the one
                shift, that make its mean square least; down is known, so nothing else turns (Zhang & Scaramuzza 2018)
    relative    |(s_j - s_i) - (p_j - p_i)|, t_j a span after t_i: drift over a time, which is the translation of the
                relative pose error where attitude is left out

Sturm, Engelhard, Endres, Burgard & Cremers (2012), A benchmark for the evaluation of RGB-D SLAM systems, IROS.
Zhang & Scaramuzza (2018), A tutorial on quantitative trajectory evaluation for visual(-inertial) odometry, IROS.
"""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel, Log
from glidercli.places import track_of_geodetic
from glidercli.residuals import residuals
from glidercli.units import NANOSECOND

__all__ = ["Distances", "Relative", "TrackErrors", "Tracks", "Way", "tracks"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

SPANS = (60.0, 600.0, 3600.0)
"""s, times over which drift is told; those that fit twice into the time that both tracks cover."""
LATE = 0.1
"""Part of a span by which the sample that ends it may come late."""
AXES = ("north", "east", "down")


class Distances(NamedTuple):
    """Statistics of n distances, m; max_time_ns : UTC, where the largest is first met."""

    n: int
    rmse: float
    mean: float
    median: float
    std: float
    max: float
    max_time_ns: int


class Relative(NamedTuple):
    """Drift over ``over`` s, m, of n pairs of samples; of_way : rmse over the rms of the measured way in that time."""

    over: float
    n: int
    rmse: float
    mean: float
    max: float
    of_way: float | None


@dataclasses.dataclass(frozen=True)
class TrackErrors:
    """Errors of a simulated track.

    origin : how both were brought together, in words. level : whether down is left out, since a log lacks it.
    turn : rad, clockwise positive, by which the simulated track is turned for ``aligned``.
    way, simulated_way : m, level lengths of both tracks through the samples compared.
    outside, gap : measured samples left out.
    """

    origin: str
    level: bool
    absolute: Distances
    aligned: Distances
    turn: float
    relative: tuple[Relative, ...]
    way: float
    simulated_way: float
    outside: int
    gap: int


class Way(NamedTuple):
    """A track. places : (n, 3), north, east, down, m; or (n, 2)."""

    time_ns: Times
    places: Array

    def at(self, time_ns: int, max_gap: float) -> Array | None:
        """The place at a time, (3,) or (2,), linear between samples; None outside, or in a gap of more s."""
        after = int(np.searchsorted(self.time_ns, time_ns))
        if after == len(self.time_ns) or (after == 0 and self.time_ns[0] != time_ns):
            return None
        before = after if self.time_ns[after] == time_ns else after - 1
        span = int(self.time_ns[after] - self.time_ns[before])
        if span * NANOSECOND > max_gap:
            return None
        part = (time_ns - int(self.time_ns[before])) / span if span else 0.0
        return np.asarray(self.places[before] + part * (self.places[after] - self.places[before]))

    def length_until(self, time_ns: int) -> float:
        """Level length through the samples until a time, m."""
        until = int(np.searchsorted(self.time_ns, time_ns, side="right"))
        return _length(self.places[:until])


class Tracks(NamedTuple):
    """A measured and a simulated track about one origin; told : how they were brought together."""

    measured: Way
    simulated: Way
    told: str

    def errors(self, max_gap: float) -> TrackErrors | None:
        """Their errors at the measured samples; None where no sample can be compared."""
        left = [
            residuals(Channel(name, self.measured.time_ns, mine), Channel(name, self.simulated.time_ns, other), max_gap)
            for name, mine, other in zip(AXES, self.measured.places.T, self.simulated.places.T, strict=False)
        ]
        times = left[0].time_ns
        if not len(times):
            return None
        apart = np.column_stack([one.error for one in left])
        p, s = (np.column_stack([getattr(one, side) for one in left]) for side in ("measured", "simulated"))
        turn, aligned = _aligned(p, s)
        return TrackErrors(
            origin=self.told,
            level=len(left) == 2,
            absolute=_distances(apart, times),
            aligned=_distances(aligned, times),
            turn=turn,
            relative=_relative(p, s, times),
            way=_length(p),
            simulated_way=_length(s),
            outside=left[0].outside,
            gap=left[0].gap,
        )


def tracks(measured: Log, simulated: Log) -> Tracks | None:
    """The tracks of two logs on one clock, about one origin; None where one has none, or they have no common time.

    A track is north, east and down; else positions, about the first of them. Where both logs tell where on the globe
    their origin is, the simulated track is counted from the measured one's; else both from where they are at the first
    common time.
    """
    first, second = _way(measured), _way(simulated)
    if first is None or second is None:
        return None
    (mine, place), (other, its) = first, second
    width = min(mine.places.shape[1], other.places.shape[1])
    mine, other = (Way(way.time_ns, way.places[:, :width]) for way in (mine, other))
    if place is not None and its is not None:
        north, east = (float(way) for way in track_of_geodetic(*its, *place))
        shift = np.array([north, east, 0.0])[:width]
        return Tracks(mine, Way(other.time_ns, other.places + shift), "placed as their logs tell")
    begin = max(int(mine.time_ns[0]), int(other.time_ns[0]))
    here, there = mine.at(begin, math.inf), other.at(begin, math.inf)
    if here is None or there is None:
        return None
    shift = here - there
    shift[2:] = 0.0
    return Tracks(mine, Way(other.time_ns, other.places + shift), "put at one place at the first common time")


def _way(log: Log) -> tuple[Way, tuple[float, float] | None] | None:
    """The track of a log, and latitude and longitude of its origin, deg, where it tells them."""
    for names in (("north", "east", "down"), ("north", "east", "depth"), ("north", "east")):
        times, columns = log.together(*names)
        if len(times):
            return Way(times, np.column_stack(columns)), log.place
    times, columns = log.together("latitude", "longitude")
    if not len(times):
        return None
    latitude, longitude = columns
    place = float(latitude[0]), float(longitude[0])
    return Way(times, np.column_stack(track_of_geodetic(latitude, longitude, *place))), place


def _distances(apart: Array, times: Times) -> Distances:
    far = np.linalg.norm(apart, axis=1)
    worst = int(np.argmax(far))
    rmse = float(np.sqrt(np.mean(far**2)))
    middle = float(np.median(far))
    return Distances(len(far), rmse, float(far.mean()), middle, float(far.std()), float(far[worst]), int(times[worst]))


def _aligned(p: Array, s: Array) -> tuple[float, Array]:
    """The turn about the vertical, rad, that lays s on p, both about their middles; and what is left, as p."""
    p, s = p - p.mean(axis=0), s - s.mean(axis=0)
    turn = math.atan2(float(np.sum(s[:, 0] * p[:, 1] - s[:, 1] * p[:, 0])), float(np.sum(s[:, :2] * p[:, :2])))
    c, d = math.cos(turn), math.sin(turn)
    turned = s.copy()
    turned[:, 0], turned[:, 1] = c * s[:, 0] - d * s[:, 1], d * s[:, 0] + c * s[:, 1]
    return turn, turned - p


def _relative(p: Array, s: Array, times: Times) -> tuple[Relative, ...]:
    """Drift over each of SPANS that fits."""
    found = []
    covered = float(times[-1] - times[0]) * NANOSECOND
    for span in SPANS:
        if 2.0 * span > covered:
            break
        wanted = times + round(span / NANOSECOND)
        ends = np.searchsorted(times, wanted)
        known = ends < len(times)
        starts, ends = np.flatnonzero(known), ends[known]
        near = (times[ends] - wanted[starts]) * NANOSECOND <= LATE * span
        starts, ends = starts[near], ends[near]
        if not len(starts):
            continue
        way = p[ends] - p[starts]
        drift = np.linalg.norm((s[ends] - s[starts]) - way, axis=1)
        rms, gone = (float(np.sqrt(np.mean(np.square(x)))) for x in (drift, np.linalg.norm(way, axis=1)))
        found.append(
            Relative(span, len(drift), rms, float(drift.mean()), float(drift.max()), rms / gone if gone > 0.0 else None)
        )
    return tuple(found)


def _length(places: Array) -> float:
    return float(np.sum(np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1)))
