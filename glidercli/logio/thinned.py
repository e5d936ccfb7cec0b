"""Which points of a long line are drawn? Evenly spread ones of its rows, the first and the last among them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["Thinned"]

Array = NDArray[np.float64]


class Thinned:
    """Rows that come in pieces; never more than twice ``most`` of them are held.

    count : rows so far.
    """

    def __init__(self, most: int) -> None:
        self._most, self._every = most, 1
        self._kept: list[Array] = []
        self._last: Array | None = None
        self._columns = 0
        self.count = 0

    def add(self, rows: Array) -> None:
        """Add rows, (n, columns)."""
        self._columns = rows.shape[1]
        if not len(rows):
            return
        self._kept.append(rows[-self.count % self._every :: self._every].copy())
        self._last = rows[-1:].copy()
        self.count += len(rows)
        while sum(map(len, self._kept)) > 2 * self._most:
            self._kept = [np.concatenate(self._kept)[::2]]
            self._every *= 2

    def rows(self) -> Array:
        """At most ``most`` rows, (m, columns); all there are, if they are no more."""
        if self._last is None:
            return np.empty((0, self._columns))
        kept = np.concatenate(self._kept)
        if (self.count - 1) % self._every:
            kept = np.concatenate([kept, self._last])
        chosen = np.linspace(0, len(kept) - 1, min(len(kept), self._most)).round().astype(np.int64)
        return kept[chosen]
