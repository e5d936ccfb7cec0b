"""What kind of file holds water or current? Told by content; and whether it holds profiles or is a record in time."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from glidercli.errors import InputError
from glidercli.gzipped import is_gzip, unpacked
from glidercli.ocean.cnv import is_cnv
from glidercli.origins import column_name

__all__ = ["AD2CP", "NETCDF", "PD0", "TEXT", "holds_profiles", "kind_of"]

TEXT, NETCDF, PD0, AD2CP = "text", "NetCDF", "RDI PD0", "Nortek .ad2cp"
_MAGIC = (  # NetCDF-3 in its three sizes, HDF5; the header identifiers of the makers' format descriptions
    (b"CDF\x01", NETCDF), (b"CDF\x02", NETCDF), (b"CDF\x05", NETCDF), (b"\x89HDF\r\n\x1a\n", NETCDF),
    (b"\x7f\x7f", PD0), (b"\x7f\x79", PD0), (b"\xa5\x0a", AD2CP),
)  # fmt: skip
_HEAD = 65536  # bytes that tell a header
_REACH = 100  # rows that are looked at once depth fell: profiles of a single sample may stand before one of several
_TIMES, _DEPTHS = ("time_utc", "elapsed_s"), ("depth_m", "pressure_dbar")


def kind_of(path: Path) -> str:
    """NETCDF, PD0 or AD2CP by the first bytes of a file; else TEXT, which reading then has to prove."""
    with path.open("rb") as stream:
        head = stream.read(16)
    return next((kind for magic, kind in _MAGIC if head.startswith(magic)), TEXT)


def holds_profiles(path: Path) -> bool:
    """Whether a file is one of water or current by depth, not a log.

    It is, if it is a .cnv file or an ADCP's binary; a table, if its depth grows from row to row, or rows that follow
    one another share a time; a NetCDF file, if its temperature or current has a dimension of depth. A table or NetCDF
    file with a time for every row whose depth goes up and down is a log.
    """
    kind = kind_of(path)
    if kind == NETCDF:
        from glidercli.ocean.netcdf_layout import has_profiles

        return has_profiles(path)
    if kind != TEXT:
        return True
    try:
        with _opened(path) as stream:
            if is_cnv(stream.read(_HEAD).decode("latin-1")):
                return True
            stream.seek(0)
            with io.TextIOWrapper(stream, encoding="latin-1", newline="") as text:
                return _is_table(text)
    except (InputError, OSError, csv.Error):
        return False


def _opened(path: Path) -> BinaryIO:
    """A file's bytes, unpacked where they are gzip."""
    with path.open("rb") as stream:
        packed = is_gzip(stream.read(2))
    return io.BytesIO(unpacked(path, path.read_bytes())[0]) if packed else path.open("rb")


def _is_table(stream: io.TextIOWrapper) -> bool:
    """Whether text is a table with a column of depth that holds profiles."""
    heading = stream.readline(_HEAD).removeprefix("\xef\xbb\xbf")  # the byte-order mark, as Latin-1
    marks = [mark for mark in ",;\t" if mark in heading]
    names = [column_name(name) for name in heading.split(marks[0])] if marks else []
    times = [names.index(name) for name in _TIMES if name in names]
    depth = next((names.index(name) for name in _DEPTHS if name in names), None)
    if depth is None:
        return False
    return not times or _grows(csv.reader(stream, delimiter=marks[0]), times, depth)


def _grows(rows: Iterator[list[str]], times: list[int], depth: int) -> bool:
    """Whether depth grows from row to row, or two rows share a time; rows without a depth say nothing."""
    last_time, last = None, -float("inf")
    left: int | None = None
    for row in rows:
        if len(row) <= max(*times, depth) or not row[depth].strip():
            continue
        time = [row[i].strip() for i in times]
        try:
            z = float(row[depth])
        except ValueError:
            return True  # the reader of tables names the line
        if time == last_time:
            return True
        if left is None and z <= last:
            left = _REACH
        elif left is not None:
            left -= 1
        if left == 0:
            return False
        last_time, last = time, z
    return left is None
