"""Where does a record of depth turn, and what does one descent or ascent look like by depth? Turns; medians in bins."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from glidercli.dives import turning_points

__all__ = ["BIN", "TURN", "by_bins", "depth_at", "turns"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

TURN = 5.0
"""m; a glider that has gone back by so much has turned. Swell and a slow flare at the apogee stay below."""
BIN = 1.0
"""m; samples within it are one: at 0.1 to 0.2 m/s a glider needs five to ten seconds for it."""
_LONGEST = 120.0  # s; between two samples of depth that far apart a glider goes some 20 m, and may turn


def turns(depth: ArrayLike) -> NDArray[np.intp]:
    """Samples at which a descent or ascent begins, from 0 on, and the number of samples. depth : (n,), m, in time."""
    z = np.asarray(depth, dtype=np.float64)
    return np.array([0, *turning_points(z, TURN)[1:-1], len(z)], dtype=np.intp)


def depth_at(times: Times, known: Times, depth: Array) -> Array:
    """Depth, m, at some times, ns: linear between samples of depth that stand no more than 120 s apart, else NaN."""
    seconds, knots = (times - known[0]) / 1e9, (known - known[0]) / 1e9
    after = np.clip(np.searchsorted(known, times), 0, len(known) - 1)
    before = np.clip(np.searchsorted(known, times, side="right") - 1, 0, len(known) - 1)
    found = np.interp(seconds, knots, depth)
    outside = (times < known[0]) | (times > known[-1])
    return np.where(outside | (knots[after] - knots[before] > _LONGEST), np.nan, found)


def by_bins(depth: Array, columns: Array) -> tuple[Array, Array]:
    """Medians of depth, (m,), and of columns, (k, m), in bins of 1 m that begin at whole metres, by increasing depth.

    depth : (n,), m. columns : (k, n). A bin without a sample is not there; one with a single sample is that sample.
    """
    bins = np.floor(depth / BIN)
    _, number, count = np.unique(bins, return_inverse=True, return_counts=True)
    start = np.concatenate([[0], np.cumsum(count)[:-1]])
    low, high = start + (count - 1) // 2, start + count // 2

    def median(values: Array) -> Array:
        ordered = values[np.lexsort((values, number))]
        return np.asarray(0.5 * (ordered[low] + ordered[high]))

    return median(depth), np.array([median(column) for column in columns]).reshape(len(columns), len(count))
