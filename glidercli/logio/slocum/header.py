"""What does the head of a Slocum file say? Its tags, its sensors, the byte order, and where the cycles begin.

Format facts: Dinkum binary data as Webb Research published it (dbd_file_format, dbdfrmat.h, encoding versions 2 to 5):
lines ``key: value``, as many as num_ascii_tags says; the list of sensors, or, where sensor_list_factored is 1, a cache
file that holds it, named by sensor_list_crc; then one cycle of known values that shows the byte order.
"""

from __future__ import annotations

import dataclasses
import re
import struct
from collections.abc import Callable
from pathlib import Path

from glidercli.errors import InputError
from glidercli.logio.slocum.sensor_lists import SensorList, check_lines, checksum, sensor_list

__all__ = ["Header", "header_of"]

MOST_TAGS = 100
LONGEST_LINE = 1000
ENCODINGS = range(2, 6)
LIST = re.compile(rb"(?:s:[^\n]*(?:\n|\Z))*")
"""The lines of a sensor list, or nothing."""
NEEDED = (
    "dbd_label", "encoding_ver", "num_ascii_tags", "full_filename", "filename_extension", "total_num_sensors",
    "sensors_per_cycle", "state_bytes_per_cycle",
)  # fmt: skip
KNOWN = {order: b"sa" + struct.pack(f"{order}hfd", 0x1234, 123.456, 123456789.12345) for order in "><"}
"""The cycle of known values, big-endian and little-endian."""


@dataclasses.dataclass(frozen=True)
class Header:
    """The head of a file.

    tags : by key. listed : its sensors. order : ">" or "<", the byte order as numpy names it. begin : where the first
    data cycle begins.
    """

    tags: dict[str, str]
    listed: SensorList
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
    crc = tags.get("sensor_list_crc", "").lower()
    if tags.get("sensor_list_factored", "0") == "1":
        text = cache(crc)
    else:
        text = LIST.match(data, at)[0]  # type: ignore[index]
        at += len(text)
        if crc and checksum(text) != crc:
            what = f"its sensor list has the checksum {checksum(text)}, sensor_list_crc is {crc}"
            raise InputError(path, f"header: {what}: the list is cut or damaged")
    try:
        if not crc:
            check_lines(text)
        listed = sensor_list(text)
    except ValueError as error:
        raise InputError(path, f"sensor list: {error}") from None
    if len(listed) != used or listed.listed not in (total, used):
        what = f"{len(listed)} of {listed.listed} sensors are listed as in the cycles"
        raise InputError(path, f"header: {what}; sensors_per_cycle is {used}, total_num_sensors {total}")
    for order, known in KNOWN.items():
        if data.startswith(known, at):
            return Header(tags, listed, order, at + len(known))
    raise InputError(path, f"byte {at}: the cycle of known values that follows the header is cut or damaged")


def _tags(path: Path, data: bytes) -> tuple[dict[str, str], int]:
    """The ASCII tags by key, and where they end."""
    tags: dict[str, str] = {}
    at, count = 0, 3  # the third says how many there are
    while len(tags) < count:
        end = data.find(b"\n", at, at + LONGEST_LINE)
        key, colon, value = data[at : max(end, at)].decode("latin-1").partition(":")
        if not colon or not key.isidentifier() or key in tags:
            raise InputError(path, f"header: line {len(tags) + 1} at byte {at} is cut or damaged; {count} tags are due")
        tags[key] = value.strip()
        at = end + 1
        if key == "num_ascii_tags":
            count = _count(path, tags, key)
            if count > MOST_TAGS:
                raise InputError(path, f"header: num_ascii_tags is {count}; at most {MOST_TAGS} are allowed")
    missing = [key for key in NEEDED if key not in tags]
    if missing:
        raise InputError(path, f"header: {', '.join(missing)} missing among its {count} tags")
    if _count(path, tags, "encoding_ver") not in ENCODINGS:
        raise InputError(path, f"header: encoding_ver is {tags['encoding_ver']}; 2 to 5 can be read")
    return tags, at


def _count(path: Path, tags: dict[str, str], key: str) -> int:
    text = tags[key]
    if not (text.isascii() and text.isdigit() and len(text) < 10 and int(text) > 0):
        raise InputError(path, f"header: {key} is {text!r}; a whole number from 1 to 999999999 is needed")
    return int(text)
