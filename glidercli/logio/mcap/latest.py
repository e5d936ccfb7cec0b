"""What was a quantity's latest sample at any time? Of a log that comes in pieces, as a viewer holds it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from glidercli.log import Log
from glidercli.logio.mcap.messages import Array, Times, all_times
from glidercli.logio.mcap.shapes import Samples

__all__ = ["FOREVER", "Latest", "at_these", "moving"]

FOREVER = np.iinfo(np.int64).max
"""Start of what has not begun, UTC ns."""


class Latest:
    """The latest sample of a quantity at any time.

    known : whether the log has samples of it at all. start_ns, last_ns : times of the first and the last one so far.
    """

    def __init__(self, known: bool) -> None:
        self.known = known
        self.start_ns, self.last_ns = FOREVER, 0
        self._times: Times = np.array([], np.int64)
        self._columns: list[Array] = []

    def add(self, samples: Samples) -> None:
        """Take those of a piece; of those before the last is kept."""
        times, columns = samples
        if not times.size:
            return
        if self._times.size:
            times = np.concatenate([self._times[-1:], times])
            columns = [np.concatenate([old[-1:], new]) for old, new in zip(self._columns, columns, strict=True)]
        self.start_ns, self.last_ns = min(self.start_ns, int(times[0])), int(times[-1])
        self._times, self._columns = times, columns

    def at(self, times: Times, otherwise: Sequence[float] = ()) -> list[Array]:
        """The latest values at or before each of these times; ``otherwise`` where there is none yet, or ever."""
        if not self._times.size:
            return [np.full(len(times), value) for value in otherwise]
        rows = np.searchsorted(self._times, times, side="right") - 1
        found = [column[np.maximum(rows, 0)] for column in self._columns]
        if not otherwise:
            return found
        return [np.where(rows < 0, value, column) for value, column in zip(otherwise, found, strict=True)]


def moving(sides: Sequence[tuple[Latest, Samples]], start_ns: int = 0) -> Times:
    """Take a piece's samples of quantities that are drawn together: the times at which what is drawn changes.

    None before start_ns, nor before each quantity that the log has is known.
    """
    for side, samples in sides:
        side.add(samples)
    times = all_times([samples[0] for _, samples in sides])
    first = max((side.start_ns for side, _ in sides if side.known), default=FOREVER)
    return times[times >= max(first, start_ns)]


def at_these(log: Log, name: str, times: Times, otherwise: float) -> Array:
    """A channel's samples at these very times; ``otherwise`` where it has none."""
    values = np.full(len(times), otherwise)
    if name in log:
        _, rows, source = np.intersect1d(times, log[name].time_ns, assume_unique=True, return_indices=True)
        values[rows] = log[name].values[source]
    return values
