"""What carried it along? The drift at the surface and the depth-averaged current that make a track meet its fixes.

Between two fixes with a dive between them the reckoned way through water misses the second fix. Two things carried the
vehicle: at the surface, before it dived and after it came up, the surface drift, where fixes at least two minutes apart
of one surfacing tell it; under water the rest, as a current that is constant over the dive: the depth-averaged current.
Where no drift is known that current is taken to act at the surface, too. Where nothing was recorded for more than a
TENTH of the time under water, as where the files of a dive are missing, the rest is no current, and none is told; the
track passes through the fixes all the same.
"""

from __future__ import annotations

import json
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.derived.motion import AFLOAT, LONGEST_GAP
from glidercli.utc import iso, to_second

__all__ = ["Closure", "Fixes", "close", "closures_in"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

LEAST_DIVE = 10.0
"""m, depth between two fixes that makes a dive."""
LEAST_DRIFT = 120.0
"""s between fixes of one surfacing that tell its drift: 5 m of error of each fix then make 0.06 m/s."""
LONGEST_SURFACING = 3600 * 10**9
"""ns between fixes without a sample, beyond which a dive may be missing: at the surface a glider calls more often."""
TENTH = 0.1
"""Part of the time under water without a sample: at 0.3 m/s through water a current is off by 0.03 m/s then."""


class Fixes(NamedTuple):
    """GPS fixes: UTC ns, strictly increasing, and m north and east of the log's origin; (n,) each."""

    time_ns: Times
    north: Array
    east: Array


class Drift(NamedTuple):
    """Motion at the surface, m/s over ground."""

    north: float
    east: float


class Closure(NamedTuple):
    """One dive between two fixes."""

    start_ns: int
    """UTC of the fix before."""
    end_ns: int
    """UTC of the fix after."""
    submerged: float
    """s under water."""
    way: float
    """m made through water, from start to end, as reckoned."""
    current_north: float
    current_east: float
    """Depth-averaged current, m/s."""
    before: Drift | None
    after: Drift | None
    """Surface drift before and after the dive, None where no two fixes tell it."""
    silent: float
    """s of it without a sample for longer than LONGEST_GAP."""

    @property
    def tells_current(self) -> bool:
        """Whether enough of the way through water was recorded for what it misses to be a current."""
        return self.silent <= TENTH * self.submerged

    @property
    def error(self) -> float:
        """What the reckoning misses, m: way of the depth-averaged current while submerged."""
        return math.hypot(self.current_north, self.current_east) * self.submerged

    def told(self) -> str:
        """In words."""
        lasts = (self.end_ns - self.start_ns) * 1e-9
        span = f"closure over {lasts:.0f} s from {to_second(self.start_ns)}: {self.error:.0f} m"
        if not self.tells_current:
            return f"{span}, and no current, since for {self.silent:.0f} s of it nothing was recorded"
        unknown = [name for name, drift in (("before", self.before), ("after", self.after)) if drift is None]
        drift = f", taken to act at the surface {' and '.join(unknown)} it, too" if unknown else ""
        return (
            f"{span}, after {self.way:.0f} m through water, a depth-averaged current of "
            f"{self.current_east:.3f} m/s east, {self.current_north:.3f} m/s north{drift}"
        )

    def document(self) -> dict[str, Any]:
        """As JSON."""
        drifts = {
            f"drift_{name}_m_s": None if drift is None else {"north": drift.north, "east": drift.east}
            for name, drift in (("before", self.before), ("after", self.after))
        }
        return {
            "start": iso(self.start_ns),
            "end": iso(self.end_ns),
            "submerged_s": self.submerged,
            "way_m": self.way,
            "closure_error_m": self.error,
            "silent_s": self.silent,
            "current_north_m_s": self.current_north if self.tells_current else None,
            "current_east_m_s": self.current_east if self.tells_current else None,
            **drifts,
        }


def closures_in(text: str) -> list[Any]:
    """The closures that the metadata of a log tell; none where the text is no list of them."""
    try:
        found = json.loads(text)
    except ValueError:
        return []
    return found if isinstance(found, list) else []


def close(fixes: Fixes, times: Times, z: Array, north: Array, east: Array) -> tuple[Times, Array, Array, list[Closure]]:
    """The track moved so that it passes through every fix.

    times, z, north, east : (n,), the reckoned track, UTC ns and m. Gives the times of samples and fixes together, north
    and east there, and what closed each dive.
    """
    n, e = (np.interp(fixes.time_ns, times, way) for way in (north, east))
    miss = np.stack([fixes.north - n, fixes.east - e], axis=1)
    dived = [_dives(times, z, *pair) for pair in zip(fixes.time_ns[:-1], fixes.time_ns[1:], strict=True)]
    drifts = _drifts(fixes, dived, times)
    knots: list[tuple[int, Array]] = [(int(fixes.time_ns[0]), miss[0])]
    closures = []
    for i, dive in enumerate(dived):
        start, end = int(fixes.time_ns[i]), int(fixes.time_ns[i + 1])
        if dive is not None:
            down = start if drifts[i] is None else dive[0]
            up = end if drifts[i + 1] is None else dive[1]
            first = miss[i] + _way(drifts[i], down - start)
            last = miss[i + 1] - _way(drifts[i + 1], end - up)
            current = (last - first) / ((up - down) * 1e-9)
            way = math.hypot(n[i + 1] - n[i], e[i + 1] - e[i])
            u_north, u_east = map(float, current)
            submerged = (up - down) * 1e-9
            silent = _silent(times, z, start, end)
            closures.append(Closure(start, end, submerged, way, u_north, u_east, drifts[i], drifts[i + 1], silent))
            knots += [(down, first), (up, last)]
        knots.append((end, miss[i + 1]))
    every = np.union1d(times, fixes.time_ns)
    at = np.array([time for time, _ in knots])
    shift = np.array([value for _, value in knots])
    moved = (np.interp(every, times, way) + np.interp(every, at, shift[:, k]) for k, way in enumerate((north, east)))
    return every, *moved, closures


def _way(drift: Drift | None, span_ns: int) -> Array:
    return np.zeros(2) if drift is None else np.array(drift) * span_ns * 1e-9


def _silent(times: Times, z: Array, start: int, end: int) -> float:
    """How long between two fixes no sample tells that it was at the surface, s, in gaps longer than LONGEST_GAP."""
    first, last = np.searchsorted(times, start), np.searchsorted(times, end, side="right")
    inside = times[first:last]
    edges = [[t] for t, edge in ((start, first), (end, last - 1)) if z[edge] >= LEAST_DIVE]
    steps = np.diff(np.unique(np.concatenate([inside, *edges]))) * 1e-9
    return float(steps[steps > LONGEST_GAP].sum())


def _dives(times: Times, z: Array, start: int, end: int) -> tuple[int, int] | None:
    """When it left the surface and when it came back, ns, between two fixes; None where it did not dive."""
    first, last = np.searchsorted(times, start), np.searchsorted(times, end, side="right")
    depth = z[first:last]
    if not len(depth) or depth.max() < LEAST_DIVE:
        return None
    deep = first + np.flatnonzero(depth >= AFLOAT)
    down = int(times[deep[0] - 1]) if deep[0] > first else start
    up = int(times[deep[-1] + 1]) if deep[-1] + 1 < last else end
    return max(down, start), min(up, end)


def _drifts(fixes: Fixes, dived: list[tuple[int, int] | None], times: Times) -> list[Drift | None]:
    """The surface drift of the surfacing that each fix belongs to; an hour without a fix or a sample is of none."""
    drifts: list[Drift | None] = []
    between = np.searchsorted(times, fixes.time_ns[1:]) - np.searchsorted(times, fixes.time_ns[:-1], side="right")
    parted = (np.diff(fixes.time_ns) > LONGEST_SURFACING) & (between == 0)
    first = 0
    for last in [*(i for i, dive in enumerate(dived) if dive is not None or parted[i]), len(fixes.time_ns) - 1]:
        span = (fixes.time_ns[last] - fixes.time_ns[first]) * 1e-9
        drift = None
        if span >= LEAST_DRIFT:
            drift = Drift(*(float((way[last] - way[first]) / span) for way in (fixes.north, fixes.east)))
        drifts += [drift] * (last + 1 - first)
        first = last + 1
    return drifts
