"""Which of several profiles in time tell of a depth? Those that reach it: beyond the end of one its neighbours hold.

A shallow dive between two deep ones says nothing of deep water. Were its last value held downward, it would be mixed
into what the others measured there, and between their times as well.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["completed"]

Array = NDArray[np.float64]
Knots = tuple[Array, Array]
"""Depths, (n,), m, strictly increasing, and values there, (n, columns)."""

PASSAGE = 5.0
"""m beyond its end in which a profile goes over into what its neighbours hold."""
MOST = 20_000_000
"""Numbers in the table of all profiles at all depths; beyond, depths are thinned out."""


def completed(times: Sequence[float], profiles: Sequence[Knots]) -> list[Knots]:
    """The profiles, each continued above and below by those that reach there, linear between them in time.

    times : s, strictly increasing. Before the first and after the last that reach a depth, that one holds.
    """
    if len(profiles) < 2:
        return list(profiles)
    ends = np.array([(depth[0] - PASSAGE, depth[-1] + PASSAGE) for depth, _ in profiles]).ravel()
    grid = np.unique(np.concatenate([*(depth for depth, _ in profiles), ends]))
    columns = profiles[0][1].shape[1]
    grid = grid[:: max(1, len(grid) * len(profiles) * columns // MOST + 1)]
    table = np.stack([_on(grid, *profile) for profile in profiles])
    at = np.asarray(times, dtype=np.float64)
    for level in range(len(grid)):
        known = np.isfinite(table[:, level, 0])
        if known.any() and not known.all():
            for column in range(columns):
                table[~known, level, column] = np.interp(at[~known], at[known], table[known, level, column])
    return [_continued(profile, grid, row) for profile, row in zip(profiles, table, strict=True)]


def _on(grid: Array, depth: Array, values: Array) -> Array:
    """A profile at the depths of the grid, (n, columns), NaN beyond its ends."""
    found = np.stack([np.interp(grid, depth, values[:, k]) for k in range(values.shape[1])], axis=1)
    found[(grid < depth[0]) | (grid > depth[-1])] = np.nan
    return found


def _continued(profile: Knots, grid: Array, row: Array) -> Knots:
    """A profile with what the table has above and below it."""
    depth, values = profile
    above, below = (np.isfinite(row[:, 0]) & beyond for beyond in (grid < depth[0], grid > depth[-1]))
    return np.concatenate([grid[above], depth, grid[below]]), np.concatenate([row[above], values, row[below]])
