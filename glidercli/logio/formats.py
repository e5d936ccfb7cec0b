"""Which reader does a file need? The formats by name, each recognised by content."""

from __future__ import annotations

from pathlib import Path

from glidercli.errors import InputError, UsageError
from glidercli.files import readable_file
from glidercli.gzipped import beginning, is_gzip
from glidercli.logio.netcdf.ioos import is_ioos, read_ioos
from glidercli.logio.netcdf.og1 import is_og1, read_og1
from glidercli.logio.own.csv_log import is_csv, read_csv
from glidercli.logio.own.netcdf_back import is_own_netcdf, read_own_netcdf
from glidercli.logio.own.parquet_back import is_own_parquet, read_own_parquet
from glidercli.logio.reader import Aids, Format, Part
from glidercli.logio.seaexplorer import is_seaexplorer, read_seaexplorer
from glidercli.logio.seaglider import is_seaglider, read_seaglider
from glidercli.logio.slocum import is_slocum, read_slocum
from glidercli.logio.tables import ENDINGS, is_table, read_table
from glidercli.netcdf_opening import is_netcdf, opened

__all__ = ["FORMATS", "check_format", "format_of", "read_file", "recognised"]


def _is_mcap(path: Path) -> bool:
    from glidercli.logio.mcap.reader import is_mcap

    return is_mcap(path)


def _read_mcap(path: Path, aids: Aids) -> Part:
    from glidercli.logio.mcap.reader import read_mcap

    return read_mcap(path)


FORMATS: dict[str, Format] = {
    "glider-mcap": Format(_is_mcap, _read_mcap, own=True),
    "seaglider": Format(is_seaglider, read_seaglider),  # first of those in NetCDF: it need not open a file
    "glider-nc": Format(is_own_netcdf, read_own_netcdf, own=True),
    "glider-parquet": Format(is_own_parquet, read_own_parquet, own=True),
    "og1": Format(is_og1, read_og1),
    "ioos": Format(is_ioos, read_ioos),
    "seaexplorer": Format(is_seaexplorer, read_seaexplorer),
    "slocum": Format(is_slocum, read_slocum),
    "glider-csv": Format(is_csv, read_csv, own=True),
    "table": Format(is_table, read_table),
}
"""Formats by name, asked in this order."""

_HEAD = 65536
_NOT_PACKED = {b"\x89MCAP": "MCAP", b"PAR1": "Parquet", b"\x89HDF": "NetCDF", b"CDF": "NetCDF"}
"""How files begin that are read unpacked alone."""


def check_format(name: str | None) -> None:
    """Raise UsageError for a name that is no format."""
    if name is not None and name not in FORMATS:
        raise UsageError(f"--format: {name} is no format; allowed: {', '.join(FORMATS)}")


def format_of(path: Path, aids: Aids) -> str | None:
    """The name of a file's format, or None where it is none of them or cannot be read.

    Where a mapping of columns is given, tables of no other format are of format table.
    """
    try:
        found = next((name for name, format in FORMATS.items() if format.recognises(path)), None)
    except OSError:
        return None
    return "table" if found is None and aids.columns and path.suffix.lower() in ENDINGS else found


def recognised(path: Path, format: str | None, aids: Aids) -> str:
    """The format that a file is read as: the one given, or by its content. Raises InputError where it can be no log."""
    name = format or format_of(readable_file(path), aids)
    if name is None:
        raise _unrecognised(path)
    return name


def read_file(path: Path, format: str | None, aids: Aids) -> Part:
    """What one file gives. format : its name, or None to go by content."""
    return FORMATS[recognised(path, format, aids)].read(readable_file(path), aids)


def _packed(unpacked: bytes) -> str:
    """What is wrong with gzip data of no format. unpacked : their beginning."""
    kind = next((kind for start, kind in _NOT_PACKED.items() if unpacked.startswith(start)), "")
    if not kind and any(column in unpacked.split(b"\n", 1)[0].split(b",") for column in (b"time_utc", b"elapsed_s")):
        kind = "a table"
    if kind:
        return f"is {kind} in gzip, which is read unpacked alone: gunzip it first"
    return "is gzip data that unpack to no log: damaged, or not one"


def _unrecognised(path: Path) -> InputError:
    """What is wrong with a file that is of no format."""
    kinds = ", ".join(FORMATS)
    if is_netcdf(path):
        try:
            with opened(path):
                what = "is NetCDF, but none of the kinds that can be read"
        except InputError as damaged:
            return damaged
    else:
        with path.open("rb") as stream:
            data = stream.read(_HEAD)
        what = _packed(beginning(data, _HEAD)) if is_gzip(data) else "is not a log that can be read"
    if path.suffix.lower() in ENDINGS:
        what += f"; if it is a table, --columns FILE.toml or {path.stem}.toml beside it says what its columns are "
        what += "(docs/columns.md)"
    return InputError(path, f"{what}; readable are {kinds}")
