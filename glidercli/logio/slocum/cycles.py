"""What do the data cycles of a Slocum file hold? Where each stands, where the file is damaged, and any sensor's values.

A cycle is the letter d, two bits of state for each sensor (the first in the highest bits: 0 not updated, 1 updated
with the same value, 2 with a new value; 3 is not used, nor are the bits left over), and the new values. The letter X
ends a file; gliders of 2023 and later leave it out. Source: dbd_file_format, dbdfrmat.h (see header.py).

A cycle's length follows from its state bits alone: taken as one large integer, the bits of all sensors of a size are
counted in one step. That scans 2000 sensors a cycle in 1.5 us in plain Python, so nothing is compiled.
"""

from __future__ import annotations

import dataclasses
import functools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.slocum.header import Header

__all__ = ["Cycles", "Samples", "scan"]

CYCLE, END = b"dX"
PADDING = b"\x00\x1a\r\n"
"""What transfers leave after the end of a file."""
FLOATING, INTEGER = (4, 8), (1, 2)


class Samples(NamedTuple):
    """A sensor in every cycle, (n,) each.

    state : 0 not updated, 1 updated with the same value, 2 with a new one. values : the latest; NaN before the first.
    """

    state: NDArray[np.uint8]
    values: NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Cycles:
    """The cycles of a file that can be relied on.

    data : the file's bytes, unpacked. values_at : (n,), where the values of each cycle begin. states : (n, state
    bytes). dump : (n,), whether a cycle tells of every sensor, most of them unchanged: then what is unchanged is the last value
    known, however old, and no sample; so begin a mission, and a recording after a pause.
    torn : further cycles of which nothing can be used, by reason. error : where and how the file is damaged, or None.
    remark : what else is to be said of its end, or None.
    """

    header: Header
    data: bytes
    values_at: NDArray[np.int64]
    states: NDArray[np.uint8]
    dump: NDArray[np.bool_]
    torn: dict[str, int]
    error: str | None = None
    remark: str | None = None

    def __len__(self) -> int:
        return len(self.values_at)

    @functools.cached_property
    def _sizes(self) -> NDArray[np.int32]:
        """Bytes of a value by state byte and slot, (state bytes, 4); 0 in slots that are left over."""
        sizes = np.zeros(4 * self.header.state_bytes, dtype=np.int32)
        sizes[: len(self.header.sensors)] = [sensor.size for sensor in self.header.sensors]
        return sizes.reshape(-1, 4)

    @functools.cached_property
    def _columns(self) -> NDArray[np.uint8]:
        """The states by state byte, (state bytes, n)."""
        return np.ascontiguousarray(self.states.T)

    @functools.cached_property
    def _before(self) -> NDArray[np.int64]:
        """Where the values of a state byte's sensors begin, (state bytes, n)."""
        table = self._sizes @ NEW
        lengths: NDArray[np.int64] = np.take_along_axis(table, self._columns, axis=1).astype(np.int64)
        return np.asarray(lengths.cumsum(axis=0) - lengths + self.values_at)

    def _numbers(self, size: int) -> NDArray[np.generic]:
        """The number of this size that begins at each byte of the file: a view, nothing is copied."""
        kind = np.dtype(f"{self.header.order}{'f' if size in FLOATING else 'i'}{size}")
        return np.ndarray((len(self.data) - size + 1,), kind, self.data, strides=(1,))

    def samples(self, place: int) -> Samples:
        """The sensor at this place of the cycles."""
        byte, slot = divmod(place, 4)
        column = self._columns[byte]
        state = (column >> (6 - 2 * slot)) & 3
        values = np.full(len(self), np.nan)
        rows = np.flatnonzero(state == 2)
        if len(rows):
            ahead = self._sizes[byte, :slot] @ NEW[:slot]
            at = self._before[byte, rows] + ahead[column[rows]]
            told = self._numbers(self.header.sensors[place].size)[at].astype(np.float64)
            latest = np.cumsum(state == 2) - 1
            values = np.where(latest >= 0, told[latest], np.nan)
        return Samples(state, values)


NEW = ((np.arange(256)[None, :] >> (6 - 2 * np.arange(4)[:, None])) & 3 == 2).astype(np.int32)
"""Whether a slot of a state byte says new value, (4, 256)."""


def scan(header: Header, data: bytes) -> Cycles:
    """The cycles of a file, up to its end or to the first damage."""
    width = header.state_bytes
    bits = 8 * width
    low = int.from_bytes(b"\x55" * width, "big")
    spare = (1 << (bits - 2 * len(header.sensors))) - 1
    masks = []
    for size in FLOATING + INTEGER:
        new = sum(2 << (bits - 2 * (i + 1)) for i, sensor in enumerate(header.sensors) if sensor.size == size)
        masks += [(size, new)] if new else []
    every = low >> (bits - 2 * len(header.sensors)) << (bits - 2 * len(header.sensors))
    starts: list[int] = []
    dumps: list[int] = []
    states: list[bytes] = []
    at, end, fault = header.begin, len(data), ""
    while at < end and data[at] == CYCLE:
        state = data[at + 1 : at + 1 + width]
        number = int.from_bytes(state, "big")
        if len(state) < width:
            break
        if number & (number >> 1) & low or number & spare:
            fault = "states that do not occur"
            break
        length = 1 + width
        for size, new in masks:
            length += size * (number & new).bit_count()
        if at + length > end:
            break
        if (number | number >> 1) & low == every and 2 * (number & low).bit_count() > len(header.sensors):
            dumps.append(len(starts))
        starts.append(at + 1 + width)
        states.append(state)
        at += length
    torn, error, remark = _ending(data, at, len(starts), fault)
    sound = len(starts) - torn.get(UNCONFIRMED, 0)
    table = np.frombuffer(b"".join(states[:sound]), dtype=np.uint8).reshape(sound, width)
    dump = np.isin(np.arange(sound), dumps)
    return Cycles(header, data, np.array(starts[:sound], dtype=np.int64), table, dump, torn, error, remark)


CUT = "cycle cut short"
DAMAGED = "cycle damaged"
UNCONFIRMED = "cycle before a damage: where it ends is not confirmed"


def _ending(data: bytes, at: int, count: int, fault: str) -> tuple[dict[str, int], str | None, str | None]:
    """What stands after the last whole cycle: cycles that are lost, the damage, and what else to say."""
    rest = data[at:]
    if not rest:
        return {}, None, (
            f"ends after {count} whole cycles without the end mark X: newer gliders leave it out, or it was cut there"
        )  # fmt: skip
    if rest[0] == END and not rest[1:].strip(PADDING):
        return {}, None, f"{len(rest) - 1} bytes of padding after the end mark X" if rest[1:] else None
    if rest[0] == CYCLE and not fault:
        return {CUT: 1}, f"cut short after {count} cycles: the file ends inside the next, at byte {len(data)}", None
    if rest[0] == END:
        what = f"an end mark with {len(rest) - 1} bytes after it"
    else:
        what = fault or f"a cycle should begin and byte {rest[0]:#04x} stands"
    lost = {UNCONFIRMED: min(count, 1), DAMAGED: 1}
    error = f"damaged at byte {at}, after {count} cycles: {what}; nothing after it was read"
    return {reason: number for reason, number in lost.items() if number}, error, None
