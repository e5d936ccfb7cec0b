"""What does a Sea-Bird .cnv file say? Its columns, place and time, and its rows of numbers.

The format is described in the manual of SBE Data Processing (Sea-Bird Scientific, "Data File Formats"): a header of
lines that begin with * or #, the line *END*, then rows of numbers, each in a field of eleven characters. Fields may
touch (``223.542-4129.20488``), so that blanks alone do not separate them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean.place import middle_of

__all__ = ["CnvColumn", "CnvFile", "is_cnv", "parse_cnv"]

Array = NDArray[np.float64]

_FIELD = 11  # characters
_NAME = re.compile(r"#\s*name\s+\d+\s*=\s*([^:]*):?(.*)", re.IGNORECASE)
_SETTING = re.compile(r"[#*]\s*([^=]+?)\s*=\s*(.*)")
_NMEA_ANGLE = re.compile(r"(\d+)\s+(\d+(?:\.\d*)?)\s*([NSEW])", re.IGNORECASE)
_OPERATOR_ANGLE = re.compile(
    r"\*\*\s*(?:lat\w*|lon\w*)?\s*[:=]?\s*(\d+)[\s°]+(\d+\.\d*)'?\s*([NSEW])\s*", re.IGNORECASE
)
_TIME = re.compile(r"([A-Z][a-z]{2})\s+(\d{1,2})\s+(\d{4})\s+(\d{2}:\d{2}:\d{2})")
_MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")


@dataclass(frozen=True)
class CnvColumn:
    """Head of one column: Sea-Bird's name, the words after it, and the text in its brackets, each perhaps empty."""

    name: str
    meaning: str
    unit: str


@dataclass(frozen=True)
class CnvFile:
    """A .cnv file.

    columns : heads, in the file's order; a name may stand more than once.
    rows : (n, columns), in the file's units, NaN where the file has its bad flag or no number.
    unreadable : rows that are cut short or hold text, not among ``rows``.
    latitude, longitude : degrees, north and east positive, or None.
    time_utc : start of the cast by the file's clock, ISO 8601, or None.
    announced : rows that the header promises, or None.
    """

    path: Path
    columns: tuple[CnvColumn, ...]
    rows: Array
    unreadable: int
    latitude: float | None
    longitude: float | None
    time_utc: str | None
    announced: int | None

    def first(self, *names: str) -> tuple[CnvColumn, Array] | None:
        """Head and values, (n,), of the first of these names that the file has, or None."""
        for name in names:
            for i, column in enumerate(self.columns):
                if column.name == name:
                    return column, self.rows[:, i]
        return None


def is_cnv(text: str) -> bool:
    """Whether text is a .cnv file: its first line is a comment of Sea-Bird's, or it has *END* and column heads."""
    return text.startswith("* Sea-Bird") or (text[:1] in "*#" and "# name 0" in text)


def parse_cnv(path: Path, text: str) -> CnvFile:
    """A .cnv file from its text.

    The place is that of the lines "NMEA Latitude" and "NMEA Longitude", else of operator lines such as
    ``** 04 06.34 N``, else the median of the columns latitude and longitude.

    Raises
    ------
    InputError
        The header has no end, no columns or an impossible place, the data are binary, or no row can be read.
    """
    lines = text.splitlines()
    end = next((i for i, line in enumerate(lines) if line.startswith("*END*")), None)
    if end is None:
        raise InputError(path, "has no line *END*: the header of the .cnv file is cut off")
    header = lines[:end]
    settings = {m[1].lower(): m[2].strip() for line in header if (m := _SETTING.match(line))}
    if settings.get("file_type", "ascii").lower() == "binary":
        raise InputError(path, "is a binary .cnv file; only ASCII ones can be read")
    columns = tuple(_column(m[1], m[2]) for line in header if (m := _NAME.match(line)))
    if not columns:
        raise InputError(path, 'has no lines "# name 0 = ..." that name the columns of a .cnv file')
    data = [line for line in lines[end + 1 :] if line.strip(" \x1a")]
    rows = [row for line in data if (row := _row(line, len(columns))) is not None]
    if not rows:
        raise InputError(path, f"has no row of {len(columns)} numbers after *END*")
    flag = settings.get("bad_flag", "-9.99e-29")
    try:
        bad_flag = float(flag)
    except ValueError:
        raise InputError(path, f"bad_flag = {flag!r} in the header, a number is needed") from None
    array = np.array(rows)
    array[np.isclose(array, bad_flag, rtol=1e-6, atol=0.0)] = np.nan
    array[~np.isfinite(array)] = np.nan
    announced = settings.get("nvalues", "")
    place = {
        "latitude": _place(header, settings.get("nmea latitude"), "NS", columns, array, "latitude"),
        "longitude": _place(header, settings.get("nmea longitude"), "EW", columns, array, "longitude"),
    }
    for (name, degrees), limit in zip(place.items(), (90.0, 360.0), strict=True):
        if degrees is not None and abs(degrees) > limit:
            raise InputError(path, f"{name} = {degrees:g} deg, allowed {-limit:g} to {limit:g}")
    return CnvFile(
        path,
        columns,
        array,
        len(data) - len(rows),
        place["latitude"],
        place["longitude"],
        _time(settings),
        int(announced) if announced.isdecimal() else None,
    )


def _column(name: str, meaning: str) -> CnvColumn:
    """Head of a column from the two sides of its colon."""
    brackets = re.search(r"\[([^\]]*)\]", meaning)
    return CnvColumn(name.strip(), meaning.strip(), brackets[1].strip() if brackets else "")


def _row(line: str, count: int) -> list[float] | None:
    """The numbers of one row, or None if it does not hold so many."""
    cells = line.split()
    if len(cells) != count:
        if len(line.rstrip()) != count * _FIELD:
            return None
        cells = [line[i * _FIELD : (i + 1) * _FIELD] for i in range(count)]
    try:
        return [float(cell) for cell in cells]
    except ValueError:
        return None


def _degrees(match: re.Match[str]) -> float:
    """Degrees, north and east positive, of degrees, minutes and hemisphere."""
    magnitude = float(match[1]) + float(match[2]) / 60.0
    return -magnitude if match[3].upper() in "SW" else magnitude


def _place(
    header: list[str], nmea: str | None, letters: str, columns: tuple[CnvColumn, ...], rows: Array, name: str
) -> float | None:
    """Latitude (letters "NS") or longitude ("EW") in degrees, or None if the file has none."""
    if nmea is not None and (match := _NMEA_ANGLE.search(nmea)) and match[3].upper() in letters:
        return _degrees(match)
    for line in header:
        if (match := _OPERATOR_ANGLE.fullmatch(line)) and match[3].upper() in letters:
            return _degrees(match)
    for i, column in enumerate(columns):
        if column.name == name and np.isfinite(rows[:, i]).any():
            return middle_of(rows[np.isfinite(rows[:, i]), i], name)
    return None


def _time(settings: dict[str, str]) -> str | None:
    """Start of the cast, ISO 8601: start_time, else the NMEA clock; None where neither holds a time ("none")."""
    for key in ("start_time", "nmea utc (time)"):
        match = _TIME.match(settings.get(key, ""))
        if match and match[1] in _MONTHS:
            return f"{match[3]}-{_MONTHS.index(match[1]) + 1:02d}-{int(match[2]):02d}T{match[4]}Z"
    return None
