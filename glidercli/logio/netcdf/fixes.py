"""Which positions are GPS fixes? Those told anew, at the surface; nothing that was interpolated."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel
from glidercli.logio.records import NO_TIME

__all__ = ["fixes"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

SURFACED = 5.0
"""m; an antenna is under water below: a depth sensor's zero and the waves leave less than that."""
NEAR = 60 * 10**9
"""ns; a depth so near in time to a position tells whether it is a fix."""
DAY = 86400 * 10**9


def fixes(
    time_ns: Times, latitude: Array, longitude: Array, depth: Channel | None, span_ns: tuple[int, int] | None
) -> NDArray[np.int64]:
    """The rows that are fixes, in the order of their times, which increase.

    A row is none that has no time or place, lies more than a day outside the recording, repeats the time or the
    position of the one before, or is under water by the depth next to it in time.

    time_ns : (n,), NO_TIME where there is none. latitude, longitude : (n,), deg, NaN where there is none.
    span_ns : first and last time of the recording, or None.
    """
    placed = (np.abs(latitude) <= 90.0) & (np.abs(longitude) <= 360.0) & ((latitude != 0.0) | (longitude != 0.0))
    placed &= time_ns != NO_TIME
    if span_ns is not None:
        placed &= (time_ns >= span_ns[0] - DAY) & (time_ns <= span_ns[1] + DAY)
    rows = np.flatnonzero(placed)
    rows = rows[np.argsort(time_ns[rows], kind="stable")]
    if len(rows) == 0:
        return rows
    later = np.diff(time_ns[rows]) > 0
    moved = (np.diff(latitude[rows]) != 0.0) | (np.diff(longitude[rows]) != 0.0)
    rows = rows[np.concatenate([[True], later & moved])]
    afloat: NDArray[np.int64] = rows[~_under_water(time_ns[rows], depth)]
    return afloat


def _under_water(time_ns: Times, depth: Channel | None) -> NDArray[np.bool_]:
    """Whether the depth next in time, if there is one near, is below the surface."""
    if depth is None or len(depth) == 0:
        return np.zeros(len(time_ns), dtype=bool)
    after = np.clip(np.searchsorted(depth.time_ns, time_ns), 1, max(len(depth) - 1, 1))
    both = np.stack([after - 1, np.minimum(after, len(depth) - 1)])
    apart = np.abs(depth.time_ns[both] - time_ns)
    nearest = np.take_along_axis(both, apart.argmin(axis=0)[None], axis=0)[0]
    deep: NDArray[np.bool_] = (apart.min(axis=0) <= NEAR) & (depth.values[nearest] > SURFACED)
    return deep
