"""How do the .eng and .log texts of a Seaglider begin? With lines such as "dive: 3", up to "data:"; .eng have a "%"."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.logio.cut_text import ends_open
from glidercli.logio.records import NO_TIME
from glidercli.logio.seaglider.gathering import Dive

__all__ = ["TextFile", "is_text", "read_text", "since", "to_number", "utc_ns"]

LONGEST = 64 * 2**20
"""Bytes that a text may have; those of a dive have some 10 kB."""
EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
ENORMOUS = 1e301
"""A larger number is none: its product with a setting may be too large for one."""
FURTHEST = 1e8
"""s; three years."""


class TextFile(NamedTuple):
    """A text, taken apart.

    header : entries before "data:". lines : those after it, blank ones left out. start_ns : start of the dive, UTC ns.
    open : whether the last line has no line end.
    """

    header: dict[str, str]
    lines: list[str]
    start_ns: int
    open: bool

    @property
    def dive(self) -> Dive:
        """Which dive it is of."""
        return Dive(*(_integer(self.header.get(key, "")) for key in ("glider", "mission", "dive")))

    @property
    def about(self) -> dict[str, str]:
        """Metadata that the header tells."""
        return {"software_version": self.header["version"]} if self.header.get("version") else {}


def is_text(data: bytes) -> bool:
    """Whether a text begins as a .eng or .log does."""
    head = data[:4096].decode("latin-1")
    names = {line.lstrip("%").split(":", 1)[0].strip() for line in head.splitlines()[:20] if ":" in line}
    return head.lstrip("%").startswith("version:") and {"glider", "dive", "start", "data"} <= names


def read_text(path: Path, data: bytes) -> TextFile:
    """Take a text apart. Raises InputError where no start of the dive is told, or it is too long."""
    if len(data) > LONGEST:
        raise InputError(path, f"has {len(data) / 1e6:.0f} MB of text; at most {LONGEST / 1e6:.0f} MB are allowed")
    header: dict[str, str] = {}
    lines = [line.strip() for line in data.decode("latin-1").replace("\r", "\n").split("\n")]
    for number, line in enumerate(lines):
        key, _, value = line.lstrip("%").partition(":")
        if key.strip() == "data":
            kept = [text for text in lines[number + 1 :] if text]
            return TextFile(header, kept, _start(path, header), bool(kept) and bool(lines[-1]) and ends_open(data))
        header[key.strip()] = value.strip()
    raise InputError(path, 'is damaged: no line "data:" after its header')


def _start(path: Path, header: dict[str, str]) -> int:
    """Start of the dive, UTC ns: month, day, years since 1900, hour, minute, second."""
    parts = [_integer(text) for text in header.get("start", "").split()]
    if len(parts) == 6 and None not in parts:
        month, day, year, hour, minute, second = (part or 0 for part in parts)
        start = utc_ns(1900 + year if year > 69 else 2000 + year, month, day, hour, minute, second)
        if start != NO_TIME:
            return start
    raise InputError(
        path, f'start "{header.get("start", "")}" is no time; allowed: month day years-since-1900 hour minute second'
    )


def utc_ns(year: int, month: int, day: int, hour: int, minute: int, second: int) -> int:
    """A time as UTC ns, or NO_TIME where there is no such."""
    try:
        moment = datetime(year, month, day, hour, minute, second, tzinfo=UTC)
    except (ValueError, OverflowError):
        return NO_TIME
    return (moment - EPOCH) // timedelta(seconds=1) * 10**9 if 1970 <= year < 2200 else NO_TIME


def since(start_ns: int, seconds: Sequence[float] | NDArray[np.float64]) -> NDArray[np.int64]:
    """Times, UTC ns, of seconds since the start of the dive; NO_TIME where they are none, or years away."""
    elapsed = np.asarray(seconds, dtype=float)
    sane = np.abs(elapsed) < FURTHEST
    rounded = np.round(np.where(sane, elapsed, 0.0) * 1e6).astype(np.int64) * 1000
    return np.where(sane, start_ns + rounded, NO_TIME).astype(np.int64)


def _integer(text: str) -> int | None:
    return int(text) if text.strip().isascii() and text.strip().isdigit() and len(text) < 9 else None


def to_number(text: str) -> float:
    """A number, or NaN where a text is none, or one that no .log holds."""
    try:
        value = float(text)
    except ValueError:
        return float("nan")
    return value if abs(value) < ENORMOUS else float("nan")
