"""What is a file that is of no format of logs, and what can be done with it? One line, by its content."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from glidercli.errors import InputError
from glidercli.files import cr_alone, is_utf16
from glidercli.gzipped import beginning, is_gzip
from glidercli.logio.tables import ENDINGS
from glidercli.netcdf_opening import is_netcdf, opened

__all__ = ["NOT_PACKED", "check_text", "stranger"]

_HEAD = 65536
NOT_PACKED = {b"\x89MCAP": "MCAP", b"PAR1": "Parquet", b"\x89HDF": "NetCDF", b"CDF": "NetCDF"}
"""How files begin that are written as a whole, and read unpacked alone; and what they are."""
_GUNZIP = "gunzip it first"
_UTF16 = "is text in UTF-16, which is read in UTF-8 alone: iconv -f UTF-16 -t UTF-8 OLD > NEW makes it so"
_CR = r"has lines that end in CR alone, as on an old Macintosh: tr '\r' '\n' < OLD > NEW makes lines that can be read"
_CONSOLE = (
    "is the console log of a Slocum, text for people; give the .dbd and .ebd (or .mbd .nbd, .sbd .tbd, or compressed) "
    "of the mission, or their folder"
)


def check_text(path: Path, format: str) -> None:
    """Raise InputError for a text in an encoding, or with ends of lines, in which the format is not read."""
    head = _head(path)
    if is_utf16(head) and format != "table":  # its mapping may name an encoding
        raise InputError(path, _UTF16)
    if cr_alone(head) and format == "seaexplorer":
        raise InputError(path, _CR)


def stranger(path: Path, formats: Sequence[str]) -> InputError:
    """What is wrong with a file that is of none of the formats."""
    head = _head(path)
    kinds = ", ".join(formats)
    if is_netcdf(path):
        try:
            with opened(path):
                what = "is NetCDF, but none of the kinds that can be read"
        except InputError as damaged:
            return damaged
    elif told := _told(head):
        return InputError(path, told)
    else:
        with path.open("rb") as stream:
            packed = is_gzip(stream.read(2))
        what = _packed(head) if packed else "is not a log that can be read"
    if not what.endswith(_GUNZIP) and (water := _water(path, head)):
        return InputError(path, water)
    if path.suffix.lower() in ENDINGS:
        what += f"; if it is a table, --columns FILE.toml or {path.stem}.toml beside it says what its columns are "
        what += "(docs/columns.md)"
    return InputError(path, f"{what}; readable are {kinds}")


def _head(path: Path) -> bytes:
    """The first bytes, unpacked."""
    with path.open("rb") as stream:
        return beginning(stream.read(_HEAD), _HEAD)


def _told(head: bytes) -> str:
    """What the first bytes alone tell, or ""."""
    if is_utf16(head):
        return _UTF16
    if cr_alone(head):
        return _CR
    return _CONSOLE if b"the8x3_file" in head[:32] else ""


def _water(path: Path, head: bytes) -> str:
    """Where a file of water or current belongs, or "" of any other. head : its first bytes."""
    from glidercli.ocean.cnv import is_cnv
    from glidercli.ocean.kind import AD2CP, NETCDF, PD0, holds_profiles, kind_of

    kind = kind_of(path)
    if kind in (PD0, AD2CP):
        return f"is {kind} data of an ADCP, which holds current, not a log: glider simulate --adcp FILE takes it"
    if kind != NETCDF and is_cnv(head.decode("latin-1")):
        return "is a CTD cast of Sea-Bird, not a log: glider simulate --ctd FILE takes it"
    if not holds_profiles(path):
        return ""
    return "holds profiles by depth, not a log: glider simulate --ctd FILE takes water, --adcp FILE current"


def _packed(unpacked: bytes) -> str:
    """What is wrong with gzip data of no format. unpacked : their beginning."""
    kind = next((kind for start, kind in NOT_PACKED.items() if unpacked.startswith(start)), "")
    if not kind and any(column in unpacked.split(b"\n", 1)[0].split(b",") for column in (b"time_utc", b"elapsed_s")):
        kind = "a table"
    if kind:
        return f"is {kind} in gzip, which is read unpacked alone: {_GUNZIP}"
    return "is gzip data that unpack to no log: damaged, or not one"
