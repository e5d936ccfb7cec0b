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
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["FLOATING", "Sensor", "SensorList", "checksum", "sensor_list"]

FLOATING, INTEGER = (4, 8), (1, 2)
"""Bytes of a value, by its kind."""
LINE = re.compile(r"s: ([TF]) +(\d+) +(-?\d+) ([1248]) (\S+) (\S+)\n")


class Sensor(NamedTuple):
    """One sensor of a file: its name and unit, and the bytes that a value takes (8, 4: floating; 2, 1: integer)."""

    name: str
    unit: str
    size: int


@dataclasses.dataclass(frozen=True, eq=False)
class SensorList:
    """A list of sensors. sensors : those in the cycles, in their order. listed : how many the list has in all."""

    sensors: tuple[Sensor, ...]
    listed: int

    @functools.cached_property
    def places(self) -> dict[str, int]:
        """The place in a cycle by the sensor's name."""
        return {sensor.name: place for place, sensor in enumerate(self.sensors)}

    @functools.cached_property
    def state_bytes(self) -> int:
        """Bytes of state that open a cycle: 2 bits a sensor."""
        return -(-len(self.sensors) // 4)

    @functools.cached_property
    def sizes(self) -> NDArray[np.int64]:
        """Bytes of a value by state byte and slot, (state bytes, 4); 0 in slots that are left over."""
        sizes = np.zeros(4 * self.state_bytes, dtype=np.int64)
        sizes[: len(self.sensors)] = [sensor.size for sensor in self.sensors]
        return sizes.reshape(-1, 4)

    @functools.cached_property
    def new_bits(self) -> list[tuple[int, int]]:
        """The bits of all state bytes, as one big-endian integer, that say new value, by the size of a value."""
        masks = []
        for size in FLOATING + INTEGER:
            slots = np.where(self.sizes == size, 2, 0) @ np.array([64, 16, 4, 1])
            masks.append((size, int.from_bytes(slots.astype(np.uint8).tobytes(), "big")))
        return [(size, mask) for size, mask in masks if mask]


def checksum(text: bytes) -> str:
    """The checksum of a sensor list, 8 hexadecimal digits, however its lines end."""
    crc = zlib.crc32(text.replace(b"\r\n", b"\n"))
    return f"{crc ^ 0xFFFFFFFF:08x}"


@functools.lru_cache(maxsize=16)
def sensor_list(text: bytes) -> SensorList:
    """The list that a text holds. The files of a mission share one. Raises ValueError naming the line at fault."""
    lines = text.decode("latin-1").replace("\r\n", "\n")
    found = LINE.findall(lines)
    if len(found) != lines.count("\n") or not lines.endswith("\n"):
        for number, line in enumerate(lines.splitlines(keepends=True)):
            if not LINE.fullmatch(line):
                shown = line[:60].rstrip()
                raise ValueError(
                    f"line {number + 1} is {shown!r}; s: T index place bytes name unit is needed, bytes 1248"
                )
    used = [(int(place), Sensor(name, unit, int(size))) for told, _, place, size, name, unit in found if told == "T"]
    used.sort(key=lambda item: item[0])
    if [place for place, _ in used] != list(range(len(used))):
        raise ValueError("the places of its sensors are not 0, 1, 2 ... each once")
    return SensorList(tuple(sensor for _, sensor in used), len(found))
