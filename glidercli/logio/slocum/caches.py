"""Where is the list of a Slocum file's sensors? In a cache, a file named by the list's checksum, ending cac or ccc."""

from __future__ import annotations

import os
from pathlib import Path

from glidercli.errors import InputError
from glidercli.logio.slocum.packing import is_packed, unpacked
from glidercli.logio.slocum.sensor_lists import checksum

__all__ = ["cached_list"]

ENDINGS = (".cac", ".ccc")


def cached_list(path: Path, crc: str, folder: Path | None) -> tuple[bytes, Path]:
    """The lines of a factored sensor list, and the file that they stand in.

    Sought in the folder of ``path``, then in ``cache`` beside it, then in ``folder``; capitals do not matter. Raises
    InputError naming what is wanted and where it was sought, or what is wrong with what was found.
    """
    if len(crc) != 8 or not set(crc) <= set("0123456789abcdef"):
        raise InputError(path, f"header: sensor_list_crc is {crc!r}; 8 hexadecimal digits are needed")
    wanted = [crc + ending for ending in ENDINGS]
    wrong = []
    places = [path.parent, path.parent / "cache", *([folder] if folder is not None else [])]
    for place in places:
        for name in sorted(name for name in os.listdir(place) if name.lower() in wanted) if place.is_dir() else []:
            file = place / name
            text, damaged = file.read_bytes(), None
            if is_packed(text[:16], b"s:"):
                text, damaged = unpacked(text)
            if damaged is None and checksum(text) == crc:
                return text.replace(b"\r\n", b"\n"), file
            wrong.append(str(file))
    if wrong:
        raise InputError(path, f"its cache {', '.join(wrong)} is cut or damaged: the checksum of its text is not {crc}")
    looked = ", ".join(str(place) for place in places)
    more = "" if folder is not None else "; --cache DIR names another folder"
    raise InputError(path, f"its cache {wanted[0]} (or {wanted[1]}) is missing; looked in {looked}{more}")
