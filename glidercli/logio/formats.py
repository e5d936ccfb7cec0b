"""Which reader does a file need? The formats by name, each recognised by content."""

from __future__ import annotations

from pathlib import Path

from glidercli.errors import InputError, UsageError
from glidercli.files import readable_file
from glidercli.logio.csv_log import is_csv, read_csv
from glidercli.logio.reader import Aids, Format, Part
from glidercli.logio.seaexplorer import is_seaexplorer, read_seaexplorer
from glidercli.logio.slocum import is_slocum, read_slocum

__all__ = ["FORMATS", "check_format", "format_of", "read_file"]


def _is_mcap(path: Path) -> bool:
    from glidercli.logio.mcap_reader import is_mcap

    return is_mcap(path)


def _read_mcap(path: Path, aids: Aids) -> Part:
    from glidercli.logio.mcap_reader import read_mcap

    return read_mcap(path)


FORMATS: dict[str, Format] = {
    "glider-mcap": Format(_is_mcap, _read_mcap, own=True),
    "seaexplorer": Format(is_seaexplorer, read_seaexplorer),
    "slocum": Format(is_slocum, read_slocum),
    "glider-csv": Format(is_csv, read_csv, own=True),
}
"""Formats by name, asked in this order."""


def check_format(name: str | None) -> None:
    """Raise UsageError for a name that is no format."""
    if name is not None and name not in FORMATS:
        raise UsageError(f"--format: {name} is no format; allowed: {', '.join(FORMATS)}")


def format_of(path: Path) -> str | None:
    """The name of a file's format, or None where it is none of them or cannot be read."""
    try:
        return next((name for name, format in FORMATS.items() if format.recognises(path)), None)
    except OSError:
        return None


def read_file(path: Path, format: str | None, aids: Aids) -> Part:
    """What one file gives. format : its name, or None to go by content."""
    readable_file(path)
    name = format or format_of(path)
    if name is None:
        with path.open("rb") as stream:
            packed = stream.read(2) == b"\x1f\x8b"
        what = "is gzip data that unpack to no log: damaged, or not one" if packed else "is not a log that can be read"
        raise InputError(path, f"{what}; readable are {', '.join(FORMATS)}")
    return FORMATS[name].read(path, aids)
