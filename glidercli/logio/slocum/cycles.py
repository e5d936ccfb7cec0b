"""What did the sensors of a Slocum file tell in its data cycles? Decoded for the sensors that are asked for.

A cycle is the letter d, two bits of state for each sensor (the first in the highest bits: 0 not updated, 1 updated
with the same value, 2 with a new value), and the new values, one after the other. Source: dbd_file_format and
dbdfrmat.h of Webb Research. Where the cycles stand is found out in scanning.py.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.slocum.header import Header
from glidercli.logio.slocum.sensor_lists import FLOATING

__all__ = ["Cycles", "Samples"]

SHIFTS = [np.uint8(shift) for shift in (6, 4, 2, 0)]
BEFORE = np.array([np.nan])
"""The value of a sensor that none has been told of."""


class Samples(NamedTuple):
    """The cycles that tell of a sensor, (k,) each.

    rows : their numbers, increasing. new : whether the value is a new one, or else the same as before. values : NaN
    where none is known yet.
    """

    rows: NDArray[np.intp]
    new: NDArray[np.bool_]
    values: NDArray[np.float64]

    def latest(self, count: int) -> NDArray[np.float64]:
        """The last number known in each of ``count`` cycles, (count,); NaN before the first."""
        known = ~np.isnan(self.values)
        numbers = np.concatenate([BEFORE, self.values[known]])
        return numbers[np.searchsorted(self.rows[known], np.arange(count), side="right")]


@dataclasses.dataclass(frozen=True)
class Cycles:
    """The cycles of a file that can be relied on.

    data : the file's bytes, unpacked. begins : (n,), where each cycle's states begin. dump : (n,), whether a cycle
    tells of every sensor, most of them unchanged: what is unchanged there is the last value known, however old, and no
    sample; so begin a mission, and a recording after a pause. torn : further cycles, of which nothing can be used, by
    reason. error : where and how the file is damaged, or None. remark : what else is to be said of its end, or None.
    resumed : the number of the first cycle behind a damage; a value unchanged since before it is not known, and left
    out.
    """

    header: Header
    data: bytes
    begins: NDArray[np.int64]
    dump: NDArray[np.bool_]
    torn: dict[str, int]
    error: str | None = None
    remark: str | None = None
    resumed: int | None = None

    def __len__(self) -> int:
        return len(self.begins)

    @property
    def stale(self) -> int:
        """Cycles at the beginning that tell old values of all sensors: the file's first, if it is there."""
        return 0 if self.resumed == 0 else 1

    @functools.cached_property
    def _states(self) -> NDArray[np.uint8]:
        """The state bytes, (n, state bytes)."""
        width = self.header.listed.state_bytes
        if not len(self):
            return np.zeros((0, width), dtype=np.uint8)
        every = np.ndarray((len(self.data) - width + 1, width), np.uint8, self.data, strides=(1, 1))
        return every[self.begins]

    def _numbers(self, size: int) -> NDArray[np.generic]:
        """The number of this size that begins at each byte of the file: a view, nothing is copied."""
        kind = np.dtype(f"{self.header.order}{'f' if size in FLOATING else 'i'}{size}")
        return np.ndarray((len(self.data) - size + 1,), kind, self.data, strides=(1,))

    def told(self) -> list[str]:
        """The names of the sensors that cycles tell of, apart from the first one and from dumps."""
        counted = ~self.dump
        counted[: self.stale] = False
        bits = np.bitwise_or.reduce(self._states if counted.all() else self._states[counted], axis=0)
        slots = (bits[:, None] >> np.array(SHIFTS)) & 3
        names = self.header.listed.names
        return [names[place] for place in np.flatnonzero(slots.ravel()) if place < len(names)]

    @functools.cached_property
    def _used(self) -> NDArray[np.bool_]:
        """Whether any cycle but the first tells of the sensors of a state byte, (state bytes,)."""
        return np.asarray(np.bitwise_or.reduce(self._states[1:], axis=0) != 0)

    def samples(self, places: Iterable[int]) -> Iterator[Samples]:
        """The sensors at these places of a cycle, one after the other."""
        wanted, listed = list(places), self.header.listed
        starts = self._starts(max(wanted, default=-1) // 4 + 1, {place // 4 for place in wanted})
        numbers = {size: self._numbers(size) for size in (1, 2, 4, 8)}
        for place in wanted:
            byte, slot = divmod(place, 4)
            told = self._states[: len(starts[byte]), byte]
            state = (told >> SHIFTS[slot]) & 3
            rows = state.nonzero()[0]
            new = state[rows] == 2
            at = rows[new]
            number = numbers[listed.sizes[place]]
            values = np.concatenate([BEFORE, number[starts[byte][at] + listed.ahead(place)[told[at]]]])
            latest = new.cumsum()
            if self.resumed is not None:
                known = (rows < self.resumed) | (latest > np.searchsorted(at, self.resumed))
                rows, new, latest = rows[known], new[known], latest[known]
            yield Samples(rows, new, values[latest])

    def _starts(self, width: int, wanted: set[int]) -> dict[int, NDArray[np.int64]]:
        """Where the values begin that a state byte tells of, by state byte, of the first ``width``.

        In each cycle, (n,), or in the first alone, (1,), where no other tells of its sensors; so it is for most.
        """
        if not len(self):
            return dict.fromkeys(wanted, self.begins)
        listed, states = self.header.listed, self._states[:, :width]
        first = zip(range(width), states[0].tolist(), strict=True)
        lengths = np.array([listed.lengths(byte)[state] for byte, state in first], dtype=np.int64)
        before = self.begins[0] + listed.state_bytes + np.cumsum(lengths) - lengths
        start = self.begins + listed.state_bytes
        found = {}
        for byte, used in enumerate(self._used[:width].tolist()):
            if byte in wanted:
                start[0] = before[byte]
                found[byte] = start.copy() if used else start[:1].copy()
            if used:
                start += listed.lengths(byte)[states[:, byte]]
        return found
