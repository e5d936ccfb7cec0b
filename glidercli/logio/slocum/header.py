"""What does the head of a Slocum file say? Its tags, its sensors, the byte order, and where the cycles begin.

Format facts: Dinkum binary data as Webb Research published it (dbd_file_format, dbdfrmat.h, encoding versions 2 to 5):
lines ``key: value``, as many as num_ascii_tags says; a line ``s: T index place bytes name unit`` for each sensor, or a
cache file that holds these lines, named by sensor_list_crc; then one cycle of known values that shows the byte order.
sensor_list_crc is the complement of the CRC-32 of these lines (so in all caches and lists at hand, 2008 to 2019).
"""

from __future__ import annotations

import dataclasses
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

from glidercli.errors import InputError
from glidercli.logio.slocum.packing import LABEL

__all__ = ["Header", "Sensor", "checksum", "header_of", "sensor_list"]

MOST_TAGS = 100
ENCODINGS = range(2, 6)
SIZES = (1, 2, 4, 8)
NEEDED = (
    "encoding_ver", "num_ascii_tags", "full_filename", "filename_extension", "total_num_sensors", "sensors_per_cycle",
    "state_bytes_per_cycle",
)  # fmt: skip
KNOWN = {order: b"sa" + struct.pack(f"{order}hfd", 0x1234, 123.456, 123456789.12345) for order in "><"}
"""The cycle of known values, big-endian and little-endian."""


@dataclasses.dataclass(frozen=True)
class Sensor:
    """One sensor of a file: its name and unit, and the bytes that a value takes (8, 4: floating; 2, 1: integer)."""

    name: str
    unit: str
    size: int


@dataclasses.dataclass(frozen=True)
class Header:
    """The head of a file.

    tags : by key. sensors : those in the cycles, in their order. state_bytes : bytes of state that open a cycle.
    order : ">" or "<", the byte order as numpy names it. begin : where the first data cycle begins.
    """

    tags: dict[str, str]
    sensors: tuple[Sensor, ...]
    state_bytes: int
    order: str
    begin: int


def header_of(path: Path, data: bytes, cache: Callable[[str], bytes]) -> Header:
    """The head of a file. data : its bytes, unpacked. cache : gives the lines of a factored list by its checksum.

    Raises InputError where the head is cut, contradicts itself or names what cannot be.
    """
    tags, at = _tags(path, data)
    total, used, state_bytes = (
        _count(path, tags, key) for key in ("total_num_sensors", "sensors_per_cycle", "state_bytes_per_cycle")
    )
    if state_bytes != -(-used // 4):
        what = f"state_bytes_per_cycle is {state_bytes}; {used} sensors_per_cycle need {-(-used // 4)}"
        raise InputError(path, f"header: {what}, 2 bits each")
    if tags.get("sensor_list_factored", "0") == "1":
        if "sensor_list_crc" not in tags:
            raise InputError(path, "header: sensor_list_crc is missing, which names the cache of its sensors")
        sensors, listed = sensor_list(path, cache(tags["sensor_list_crc"].lower()))
    else:
        end = at
        while data.startswith(b"s:", end):
            end = data.find(b"\n", end) + 1 or len(data)
        text, at = data[at:end], end
        crc = tags.get("sensor_list_crc", "").lower()
        if crc and checksum(text) != crc:
            what = f"its sensor list has the checksum {checksum(text)}, sensor_list_crc is {crc}"
            raise InputError(path, f"header: {what}: the list is cut or damaged")
        sensors, listed = sensor_list(path, text)
    if len(sensors) != used or listed not in (total, used):
        what = f"{len(sensors)} of {listed} sensors are listed as in the cycles"
        raise InputError(path, f"header: {what}, sensors_per_cycle is {used}, total_num_sensors {total}")
    for order, known in KNOWN.items():
        if data.startswith(known, at):
            return Header(tags, sensors, state_bytes, order, at + len(known))
    raise InputError(path, f"byte {at}: the cycle of known values that follows the header is cut or damaged")


def _tags(path: Path, data: bytes) -> tuple[dict[str, str], int]:
    """The ASCII tags by key, and where they end."""
    tags: dict[str, str] = {}
    at, count = 0, 3
    while len(tags) < count:
        end = data.find(b"\n", at, at + 1000)
        key, colon, value = data[at:end].decode("latin-1").partition(":")
        if end < 0 or not colon or not key.isidentifier():
            raise InputError(path, f"header: line {len(tags) + 1} at byte {at} is no tag; {count} lines key: value are")
        if key in tags:
            raise InputError(path, f"header: {key} stands twice")
        tags[key] = value.strip()
        at = end + 1
        if key == "num_ascii_tags":
            count = _count(path, tags, key, MOST_TAGS)
    missing = [key for key in NEEDED if key not in tags]
    if missing or LABEL.decode()[:-1] not in tags:
        raise InputError(path, f"header: {', '.join(missing) or 'dbd_label'} missing among its {count} tags")
    if _count(path, tags, "encoding_ver") not in ENCODINGS:
        raise InputError(path, f"header: encoding_ver is {tags['encoding_ver']}; 2 to 5 can be read")
    return tags, at


def _count(path: Path, tags: dict[str, str], key: str, most: int | None = None) -> int:
    text = tags[key]
    if not (text.isascii() and text.isdigit() and 0 < len(text) < 10 and int(text) > 0):
        raise InputError(path, f"header: {key} is {text!r}; a whole number from 1 is needed")
    if most is not None and int(text) > most:
        raise InputError(path, f"header: {key} is {text}; at most {most} are allowed")
    return int(text)


def checksum(text: bytes) -> str:
    """The checksum of a sensor list, 8 hexadecimal digits, however its lines end."""
    crc = zlib.crc32(text.replace(b"\r\n", b"\n"))
    return f"{crc ^ 0xFFFFFFFF:08x}"


def sensor_list(path: Path, text: bytes) -> tuple[tuple[Sensor, ...], int]:
    """The sensors in the cycles, in their order, and how many the list has. Raises InputError naming the line."""
    placed: dict[int, Sensor] = {}
    lines = text.decode("latin-1").splitlines()
    for number, line in enumerate(lines):
        words = line.split()
        if len(words) != 7 or words[0] != "s:" or words[1] not in "TF":
            raise InputError(
                path, f"sensor list, line {number + 1}: {line[:60]!r} is not s: T index place bytes name unit"
            )
        if words[1] == "F":
            continue
        if not words[3].isdigit() or words[4] not in [str(size) for size in SIZES]:
            what = f"{words[5]} has place {words[3]} and {words[4]} bytes"
            raise InputError(
                path, f"sensor list, line {number + 1}: {what}; a place from 0, 1, 2, 4 or 8 bytes are allowed"
            )
        placed[int(words[3])] = Sensor(words[5], words[6], int(words[4]))
    if sorted(placed) != list(range(sum(line.startswith("s: T") for line in lines))):
        raise InputError(path, "sensor list: the places of its sensors are not 0, 1, 2 ... each once")
    return tuple(placed[place] for place in range(len(placed))), len(lines)
