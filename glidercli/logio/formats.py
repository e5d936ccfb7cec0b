"""Which reader does a file need? The formats by name, each recognised by content."""

from __future__ import annotations

from pathlib import Path

from glidercli.errors import UsageError
from glidercli.files import readable_file
from glidercli.logio.netcdf.ioos import is_ioos, read_ioos
from glidercli.logio.netcdf.og1 import is_og1, read_og1
from glidercli.logio.own.csv_log import is_csv, read_csv
from glidercli.logio.own.netcdf_back import is_own_netcdf, read_own_netcdf
from glidercli.logio.own.parquet_back import is_own_parquet, read_own_parquet
from glidercli.logio.reader import Aids, Format, Part
from glidercli.logio.seaexplorer import is_seaexplorer, read_seaexplorer
from glidercli.logio.seaglider import is_seaglider, read_seaglider
from glidercli.logio.slocum import is_slocum, read_slocum
from glidercli.logio.strangers import check_text, stranger
from glidercli.logio.tables import ENDINGS, is_table, read_table

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
        raise stranger(path, tuple(FORMATS))
    check_text(path, name)
    return name


def read_file(path: Path, format: str | None, aids: Aids) -> Part:
    """What one file gives. format : its name, or None to go by content."""
    return FORMATS[recognised(path, format, aids)].read(readable_file(path), aids)
