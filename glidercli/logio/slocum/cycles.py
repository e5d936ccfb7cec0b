"""Where do the data cycles of a Slocum file stand, where is it damaged, and what did its sensors tell?

A cycle is the letter d, two bits of state for each sensor (the first in the highest bits: 0 not updated, 1 updated
with the same value, 2 with a new value; 3 is not used, nor are the bits left over), and the new values. The letter X
ends a file; gliders of 2023 and later leave it out. Source: dbd_file_format and dbdfrmat.h of Webb Research.

A cycle's length follows from its state bits alone: taken as one large integer, the bits of all sensors of a size are
counted in one step. So 2000 sensors a cycle are scanned in 2 us in plain Python, and nothing has to be compiled.
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

__all__ = ["Cycles", "Samples", "scan"]

CYCLE, END = b"dX"
PADDING = b"\x00\x1a\r\n"
"""What transfers leave after the end of a file."""
CUT = "cycle cut short"
DAMAGED = "cycle damaged"
UNCONFIRMED = "cycle before a damage: where it ends is not confirmed"
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
        """The last value known in each of ``count`` cycles, (count,); NaN before the first."""
        return np.concatenate([BEFORE, self.values])[np.searchsorted(self.rows, np.arange(count), side="right")]


@dataclasses.dataclass(frozen=True)
class Cycles:
    """The cycles of a file that can be relied on.

    data : the file's bytes, unpacked. begins : (n,), where each cycle's states begin. dump : (n,), whether a cycle
    tells of every sensor, most of them unchanged: what is unchanged there is the last value known, however old, and no
    sample; so begin a mission, and a recording after a pause. torn : further cycles, of which nothing can be used, by
    reason. error : where and how the file is damaged, or None. remark : what else is to be said of its end, or None.
    """

    header: Header
    data: bytes
    begins: NDArray[np.int64]
    dump: NDArray[np.bool_]
    torn: dict[str, int]
    error: str | None = None
    remark: str | None = None

    def __len__(self) -> int:
        return len(self.begins)

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
            yield Samples(rows, new, values[new.cumsum()])

    def _starts(self, width: int, wanted: set[int]) -> dict[int, NDArray[np.int64]]:
        """Where the values begin that a state byte tells of, by state byte, of the first ``width``.

        In each cycle, (n,), or in the first alone, (1,), where no other tells of its sensors; so it is for most.
        """
        if not len(self):
            return dict.fromkeys(wanted, self.begins)
        listed, states = self.header.listed, self._states[:, :width]
        lengths = listed.lengths[np.arange(width), states[0]]
        before = self.begins[0] + listed.state_bytes + np.cumsum(lengths) - lengths
        start = self.begins + listed.state_bytes
        found = {}
        for byte, used in enumerate(self._used[:width].tolist()):
            if byte in wanted:
                start[0] = before[byte]
                found[byte] = start.copy() if used else start[:1].copy()
            if used:
                start += listed.lengths[byte][states[:, byte]]
        return found


def scan(header: Header, data: bytes) -> Cycles:
    """The cycles of a file, up to its end or to the first damage."""
    width, end = header.listed.state_bytes, len(data)
    lengths: dict[bytes, int] = {}  # by state: most repeat
    dumps: list[bytes] = []
    begins: list[int] = []
    at, fault = header.begin, ""
    while at < end and data[at] == CYCLE:
        state = data[at + 1 : at + 1 + width]
        length = lengths.get(state, 0)
        if not length:
            if len(state) < width:
                break
            length, full = _length(header, state)
            if not length:
                fault = "states that do not occur"
                break
            lengths[state] = length
            if full:
                dumps.append(state)
        if at + length > end:
            break
        begins.append(at + 1)
        at += length
    torn, error, remark = _ending(data, at, len(begins), fault)
    begins = begins[: len(begins) - torn.get(UNCONFIRMED, 0)]
    dump = [data[begin : begin + width] in dumps for begin in begins] if dumps else [False] * len(begins)
    return Cycles(header, data, np.array(begins, dtype=np.int64), np.array(dump, dtype=bool), torn, error, remark)


def _length(header: Header, state: bytes) -> tuple[int, bool]:
    """Bytes of a cycle by its states, 0 where they cannot be, and whether it is a dump (see Cycles)."""
    count = len(header.listed)
    number = int.from_bytes(state, "big")
    slots = int.from_bytes(b"\x55" * len(state), "big")  # the low bit of every slot
    spare = 8 * len(state) - 2 * count
    if number & (number >> 1) & slots or number & ((1 << spare) - 1):
        return 0, False
    length = 1 + len(state) + sum(size * (number & new).bit_count() for size, new in header.listed.new_bits)
    same = (number & slots).bit_count()
    return length, 2 * same > count and ((number | number >> 1) & slots).bit_count() == count


def _ending(data: bytes, at: int, count: int, fault: str) -> tuple[dict[str, int], str | None, str | None]:
    """What stands after the last whole cycle: cycles that are lost by reason, the damage, and what else to say."""
    rest = data[at:]
    if not rest:
        what = f"ends after {count} whole cycles without the end mark X"
        return {}, None, f"{what}: newer gliders leave it out, or the file was cut just there"
    if rest[0] == END and not rest[1:].strip(PADDING):
        return {}, None, f"{len(rest) - 1} bytes of padding after the end mark X" if rest[1:] else None
    if rest[0] == CYCLE and not fault:
        return {CUT: 1}, f"cut short after {count} cycles: the file ends inside the next, at byte {len(data)}", None
    if rest[0] == END:
        what = f"an end mark with {len(rest) - 1} bytes after it"
    else:
        what = fault or f"a cycle should begin, byte {rest[0]:#04x} stands"
    error = f"damaged at byte {at}, after {count} cycles: {what}; nothing after it was read"
    return ({UNCONFIRMED: 1} if count else {}) | {DAMAGED: 1}, error, None
