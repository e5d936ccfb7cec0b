"""A few lines of PD0 by the maker's description (WorkHorse Commands and Output Data Format), independent of mhkit."""

from __future__ import annotations

import struct
from typing import NamedTuple

import numpy as np

FRAME_BYTE = 25  # EX, coordinate transformation, in the fixed leader; bits 3 and 4 tell the frame


class Ensemble(NamedTuple):
    start: int
    length: int
    offsets: dict[int, int]  # identifier of a data type -> where it begins
    data: bytes

    def at(self, identifier: int, offset: int, form: str) -> int:
        return struct.unpack_from("<" + form, self.data, self.offsets[identifier] + offset)[0]

    @property
    def ranges(self) -> np.ndarray:
        """Middle of each bin, m from the instrument: bin 1 distance and cell length, cm, of the fixed leader."""
        first, cell, cells = self.at(0, 32, "H"), self.at(0, 12, "H"), self.at(0, 9, "B")
        return (first + cell * np.arange(cells)) / 100.0

    @property
    def depth(self) -> float:
        """Depth of the transducer, m; dm in the variable leader."""
        return self.at(0x80, 16, "H") / 10.0

    @property
    def velocity(self) -> np.ndarray:
        """(4, cells), m/s, NaN where it is -32768."""
        cells = self.at(0, 9, "B")
        mm = np.frombuffer(self.data, "<i2", 4 * cells, self.offsets[0x100] + 2).reshape(cells, 4).T
        return np.where(mm == -32768, np.nan, mm / 1000.0)

    @property
    def bottom_velocity(self) -> np.ndarray:
        """(4,), m/s, NaN where it is -32768."""
        mm = np.frombuffer(self.data, "<i2", 4, self.offsets[0x600] + 24)
        return np.where(mm == -32768, np.nan, mm / 1000.0)


def ensembles(data: bytes) -> list[Ensemble]:
    """Every ensemble whose checksum is right."""
    found, at = [], data.find(b"\x7f\x7f")
    while 0 <= at < len(data) - 6:
        length = struct.unpack_from("<H", data, at + 2)[0]
        body = data[at : at + length]
        if len(data) >= at + length + 2 and length > 6 and checksum(body) == data[at + length : at + length + 2]:
            starts = struct.unpack_from(f"<{data[at + 5]}H", data, at + 6)
            kinds = {struct.unpack_from("<H", body, start)[0]: start for start in starts}
            found.append(Ensemble(at, length, kinds, body))
            at += length
        at = data.find(b"\x7f\x7f", at + 1)
    return found


def checksum(body: bytes) -> bytes:
    return struct.pack("<H", sum(body) & 0xFFFF)


def in_frame(data: bytes, bits: int) -> bytes:
    """The same file with another frame: 0 beam, 1 instrument, 2 ship, 3 earth."""
    out = bytearray(data)
    for one in ensembles(data):
        place = one.start + one.offsets[0] + FRAME_BYTE
        out[place] = (out[place] & ~0x18) | (bits << 3)
        end = one.start + one.length
        out[end : end + 2] = checksum(bytes(out[one.start : end]))
    return bytes(out)
