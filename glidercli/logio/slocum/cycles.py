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
SHIFTS = np.array([6, 4, 2, 0])
NEW = ((np.arange(256)[None, :] >> SHIFTS[:, None]) & 3 == 2).astype(np.int64)
"""Whether a slot of a state byte says new value, (4, 256)."""


class Samples(NamedTuple):
    """A sensor in every cycle, (n,) each.

    state : 0 not updated, 1 updated with the same value, 2 with a new one. values : the latest; NaN before the first.
    """

    state: NDArray[np.uint8]
    values: NDArray[np.float64]


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

    def samples(self, places: Iterable[int]) -> Iterator[Samples]:
        """The sensors at these places of a cycle, one after the other."""
        wanted = list(places)
        starts = self._starts({place // 4 for place in wanted}) if len(self) else {}
        for place in wanted:
            byte, slot = divmod(place, 4)
            column = np.ascontiguousarray(self._states[:, byte])
            state = (column >> SHIFTS[slot].astype(np.uint8)) & 3
            new = state == 2
            values = np.full(len(self), np.nan)
            if new.any():
                listed = self.header.listed
                ahead = listed.sizes[byte, :slot] @ NEW[:slot]
                at = (starts[byte] + ahead[column])[new]
                told = self._numbers(listed.sensors[place].size)[at].astype(np.float64)
                latest = np.cumsum(new) - 1
                values = np.where(latest >= 0, told[latest], np.nan)
            yield Samples(state, values)

    def _starts(self, wanted: set[int]) -> dict[int, NDArray[np.int64]]:
        """Where the values begin that a state byte tells of, (n,), by state byte.

        The first cycle tells every sensor, the others few: only state bytes that any of them uses are gone through.
        """
        sizes, states = self.header.listed.sizes, self._states[:, : max(wanted, default=0) + 1]
        first = ((states[0][:, None] >> SHIFTS) & 3 == 2) * sizes[: states.shape[1]]
        start = self.begins + sizes.shape[0]
        before = start[0] + np.concatenate([[0], first.sum(axis=1).cumsum()])
        used = np.bitwise_or.reduce(states[1:], axis=0) != 0
        found = {}
        for byte in np.flatnonzero(used | np.isin(np.arange(states.shape[1]), list(wanted))).tolist():
            start[0] = before[byte]
            if byte in wanted:
                found[byte] = start.copy()
            if used[byte]:
                start += (sizes[byte] @ NEW)[states[:, byte]]
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
    count = len(header.listed.sensors)
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
