"""Which of the three files of a Seaglider's dive is it? The .nc, the .eng or the .log, told by content."""

from __future__ import annotations

import dataclasses
from pathlib import Path

from glidercli.errors import InputError
from glidercli.gzipped import DAMAGED, beginning, unpacked
from glidercli.logio.reader import Aids, Part
from glidercli.logio.seaglider.eng import read_eng
from glidercli.logio.seaglider.log_text import read_log
from glidercli.logio.seaglider.netcdf import read_nc
from glidercli.logio.seaglider.netcdf_file import LARGEST, is_netcdf
from glidercli.logio.seaglider.text_file import is_text

__all__ = ["is_seaglider", "read_seaglider"]

SMALLEST = 4096
"""Bytes that tell whether the rest is worth looking at."""
STARTS = (b"CDF", b"\x89HDF", b"version:", b"%version:")


def is_seaglider(path: Path) -> bool:
    """Whether a file is one of the three, by its content."""
    with path.open("rb") as stream:
        head = stream.read(SMALLEST)
    if path.stat().st_size > LARGEST or not beginning(head, SMALLEST).startswith(STARTS):
        return False
    data = beginning(path.read_bytes(), LARGEST)
    return is_netcdf(data) or is_text(data)


def read_seaglider(path: Path, aids: Aids = Aids()) -> Part:
    """One .nc, .eng or .log; any of them may be gzip."""
    data, whole = unpacked(path, path.read_bytes())
    if data.startswith((b"CDF", b"\x89HDF")):
        part = read_nc(path, data)
    elif is_text(data):
        part = read_eng(path, data) if data.startswith(b"%") else read_log(path, data)
    else:
        raise InputError(path, "is no file of a Seaglider: neither a basestation's .nc nor a .eng or .log text")
    if whole:
        return part
    return dataclasses.replace(part, report=dataclasses.replace(part.report, error=DAMAGED))
