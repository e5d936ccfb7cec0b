"""Which sensors does a Slocum file hold, and in which order? The lines of its list, in the file or in a cache.

A line is ``s: T index place bytes name unit``: T for a sensor that is in the cycles, at this place, F for one that is
not. Source: dbd_file_format of Webb Research. The checksum of a list (sensor_list_crc) is the complement of the CRC-32
of its lines: so in all lists at hand, of 2008 to 2023.
"""

from __future__ import annotations

import dataclasses
import functools
import re
import zlib

import numpy as np
from numpy.typing import NDArray

__all__ = ["FLOATING", "NEW", "SensorList", "check_lines", "checksum", "sensor_list"]

FLOATING, INTEGER = (4, 8), (1, 2)
"""Bytes of a value, by its kind."""
NEW = ((np.arange(256)[None, :] >> np.array([[6], [4], [2], [0]])) & 3 == 2).astype(np.int64)
"""Whether a slot of a state byte says new value, (4, 256)."""
NEW_DIGIT = {size: bytes(ord("2") if byte == size else ord("0") for byte in range(256)) for size in FLOATING + INTEGER}
"""By the size of a value: its bytes as digits of base 4, which say new value where a sensor is of this size."""
WORDS = 7
"""Words of a line."""
LINE = re.compile(r"s: ([TF]) +\d+ +(-?\d+) ([1248]) (\S+) (\S+)\n")


@dataclasses.dataclass(frozen=True, eq=False)
class SensorList:
    """A list of sensors.

    names, units, sizes : of those in the cycles, in their order; the bytes that a value takes are 8 or 4 (floating), 2
    or 1 (integer). listed : how many sensors the list has in all.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    sizes: tuple[int, ...]
    listed: int

    def __len__(self) -> int:
        return len(self.names)

    @functools.cached_property
    def places(self) -> dict[str, int]:
        """The place in a cycle by the sensor's name."""
        return dict(zip(self.names, range(len(self)), strict=True))

    @functools.cached_property
    def state_bytes(self) -> int:
        """Bytes of state that open a cycle: 2 bits a sensor."""
        return -(-len(self) // 4)

    def ahead(self, place: int) -> NDArray[np.int64]:
        """Bytes of new values that stand before a sensor's among those of its state byte, (256,), by its value."""
        return _told(self.sizes[place - place % 4 : place])

    def lengths(self, byte: int) -> NDArray[np.int64]:
        """Bytes of the new values that a state byte tells of, (256,), by its value."""
        return _told(self.sizes[4 * byte : 4 * byte + 4])

    @functools.cached_property
    def new_bits(self) -> list[tuple[int, int]]:
        """The bits of all state bytes, as one big-endian integer, that say new value, by the size of a value."""
        sizes = bytes(self.sizes).ljust(4 * self.state_bytes, b"\0")
        return [(size, int(sizes.translate(NEW_DIGIT[size]), 4)) for size in set(self.sizes)]


@functools.lru_cache(maxsize=256)
def _told(sizes: tuple[int, ...]) -> NDArray[np.int64]:
    """Bytes of new values of sensors of these sizes, which begin a state byte, (256,), by its value."""
    return np.asarray(np.array(sizes, dtype=np.int64) @ NEW[: len(sizes)])


def checksum(text: bytes) -> str:
    """The checksum of a sensor list, 8 hexadecimal digits, however its lines end."""
    crc = zlib.crc32(text.replace(b"\r\n", b"\n") if b"\r" in text else text)
    return f"{crc ^ 0xFFFFFFFF:08x}"


@functools.lru_cache(maxsize=16)
def sensor_list(text: bytes) -> SensorList:
    """The list that a text holds. The files of a mission share one. Raises ValueError naming the line at fault.

    Of the many sensors that are not in the cycles only the number is taken: a checksum guards their lines, and where
    there is none ``check_lines`` does.
    """
    lines = text.split(b"\n")
    used = [line for line in lines if line.startswith(b"s: T ")]
    rest = sum(line.startswith(b"s: F ") for line in lines)
    words = b" ".join(used).decode("latin-1").split()
    marks, _, numbers, places, sizes, names, units = (tuple(words[column::WORDS]) for column in range(WORDS))
    whole = len(used) + rest == len(lines) - 1 and text.endswith(b"\n") and len(words) == WORDS * len(used)
    if not (whole and set(marks) <= {"s:"} and set(sizes) <= set("1248") and "".join(numbers).isdigit()):
        check_lines(text)
        raise ValueError("none of its sensors is in the cycles")
    if places != tuple(map(str, range(len(used)))):
        raise ValueError("the places of its sensors are not 0, 1, 2 ... in order")
    return SensorList(names, units, tuple(map(int, sizes)), len(used) + rest)


def check_lines(text: bytes) -> None:
    """Raise ValueError, naming the line, where one of a list is not as it should be."""
    lines = text.decode("latin-1").replace("\r\n", "\n").splitlines(keepends=True)
    for number, line in enumerate(lines, start=1):
        if not LINE.fullmatch(line):
            shown = line[:60].rstrip()
            raise ValueError(f"line {number} is {shown!r}; s: T index place bytes name unit is needed, bytes 1248")
