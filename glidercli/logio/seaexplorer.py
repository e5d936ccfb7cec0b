"""What does a SeaExplorer text file hold? Navigation (gli) and payload (pld) files, sub or raw, gzip or not.

One line is one record. A record is dropped, and counted by its reason, when it cannot be used as a whole: cut lines,
times that cannot be read, repeat, go back or come from a clock that was not set, lines without a value. Single cells
that cannot be used are counted in warnings (seaexplorer_channels.py, where units and signs stand too).
"""

from __future__ import annotations

import re
import zlib
from collections import Counter
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Log
from glidercli.logio.report import FileReport
from glidercli.logio.seaexplorer_channels import SENTINELS, channels_of

__all__ = ["is_seaexplorer", "read_seaexplorer"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

NAVIGATION, PAYLOAD = "Timestamp", "PLD_REALTIMECLOCK"
NAME = re.compile(r"(sea\d+)\.", re.IGNORECASE)
"""How a file's name begins; nothing inside the file tells the vehicle."""
PIECE = 4096
"""Bytes unpacked at a time, so that what stands before a damage is not lost."""
STRAY = 30 * 86400 * 10**9
"""Times of one file that stand further apart than this are of two clocks, ns."""
HELD = 3
"""So many records show that a clock was set; fewer may be garbled."""


def _text(data: bytes) -> tuple[str, bool]:
    """The text, unpacked where it is gzip as far as that goes, and whether it is whole."""
    pieces, whole = [], True
    while whole and data[:2] == b"\x1f\x8b":  # members of a gzip file follow one another
        member, at = zlib.decompressobj(wbits=31), 0
        try:
            while at < len(data) and not member.eof:
                pieces.append(member.decompress(data[at : at + PIECE]))
                at += PIECE
        except zlib.error:
            whole = False
        whole, data = whole and member.eof, member.unused_data + data[at:]
    text = b"".join(pieces)
    return (text if text or not whole else data).decode("latin-1"), whole


def is_seaexplorer(path: Path) -> bool:
    """Whether the first line is that of a SeaExplorer file."""
    with path.open("rb") as stream:
        text, _ = _text(stream.read(16 * PIECE))
    first = text.split("\n", 1)[0].lstrip("\ufeff\xef\xbb\xbf ")
    return first.split(";", 1)[0].strip() in (NAVIGATION, PAYLOAD) and ";" in first


def read_seaexplorer(path: Path) -> tuple[Log, FileReport]:
    """One navigation or payload file: its Log, and what was kept and dropped."""
    text, whole = _text(path.read_bytes())
    lines = text.lstrip("\ufeff\xef\xbb\xbf ").split("\n")
    names = [name.strip() for name in lines[0].split(";")]
    dropped: Counter[str] = Counter()
    rows: list[list[str]] = []
    records = 0
    for line in lines[1:]:
        if not line.strip():
            continue
        records += 1
        cells = [cell.strip() for cell in line.split(";")]
        if len(cells) == len(names) + 1 and names[-1] and not cells[-1]:
            cells.pop()  # lines may end in a semicolon where the header does not; a cut line lacks what the header has
        if len(cells) != len(names):
            dropped["wrong number of fields"] += 1
        else:
            rows.append(cells)
    time_ns = _times([row[0] for row in rows])
    table = {name: _numbers([row[i] for row in rows]) for i, name in enumerate(names) if i > 0 and name}
    good = _usable(time_ns, table, dropped)
    table = {name: values[good] for name, values in table.items()}
    channels, warnings = channels_of(time_ns[good], table)
    named = NAME.match(path.name)
    whose = {"platform": f"SeaExplorer {named[1]}"} if named else {}
    log = Log({channel.name: channel for channel in channels if len(channel)}, "measured", whose)
    kept = int(np.isin(time_ns[good], np.concatenate([c.time_ns for c in channels] or [time_ns[:0]])).sum())
    if kept < good.sum():
        dropped["no usable value"] += int(good.sum()) - kept
    error = None if whole else "gzip data cut short or damaged: only what could be unpacked was read"
    report = FileReport(path, "seaexplorer", records, kept, tuple(sorted(dropped.items())), tuple(warnings), error)
    return log, report


def _times(texts: list[str]) -> Times:
    """Times in UTC ns; the smallest integer where a text is no time."""
    import pandas as pd

    parsed = pd.to_datetime(pd.Series(texts, dtype=object), format="%d/%m/%Y %H:%M:%S.%f", errors="coerce")
    whole = pd.to_datetime(pd.Series(texts, dtype=object), format="%d/%m/%Y %H:%M:%S", errors="coerce")
    return parsed.fillna(whole).to_numpy().astype("datetime64[ns]").astype(np.int64)


def _numbers(texts: list[str]) -> Array:
    """Numbers; NaN where a cell is blank, infinite where it is no number."""
    import pandas as pd

    values = pd.to_numeric(pd.Series(texts, dtype=object), errors="coerce").to_numpy(dtype=float, copy=True)
    told = np.array([text.lower() not in ("", "nan") for text in texts], dtype=bool)
    values[told & np.isnan(values)] = np.inf
    return values


def _usable(time_ns: Times, table: dict[str, Array], dropped: Counter[str]) -> NDArray[np.bool_]:
    """Which records can be used; the others are counted by their reason."""
    good: NDArray[np.bool_] = time_ns != np.iinfo(np.int64).min
    dropped["time cannot be read"] += int((~good).sum())
    if good.any():
        first, last = _set_clock(time_ns[good])
        before, after = good & (time_ns < first), good & (time_ns > last)
        dropped["clock not set: more than 30 days before the file's other times"] += int(before.sum())
        dropped["time more than 30 days after the file's other times"] += int(after.sum())
        good &= ~(before | after)
    cells = np.array(list(table.values())) if table else np.empty((0, len(time_ns)))
    told = np.isfinite(cells) & ~np.isin(cells, SENTINELS)
    blank = good & ~told.any(axis=0)
    zero = good & ~blank & ((cells == 0.0) | ~told).all(axis=0)
    dropped["no value"] += int(blank.sum())
    dropped["all values zero"] += int(zero.sum())
    good &= ~(blank | zero)
    latest = np.iinfo(np.int64).min
    for i in np.flatnonzero(good):
        if time_ns[i] <= latest:
            dropped["time repeats" if time_ns[i] == latest else "time goes back"] += 1
            good[i] = False
        latest = max(latest, int(time_ns[i]))
    for reason in [reason for reason, count in dropped.items() if count == 0]:
        del dropped[reason]
    return good


def _set_clock(time_ns: Times) -> tuple[int, int]:
    """First and last time by the clock as it was set, ns.

    A clock that is not set runs behind, and may do so for most of a file: of the groups of times that lie STRAY apart
    the latest with HELD records counts; where none has as many, the largest.
    """
    ordered = np.sort(time_ns)
    groups = np.split(ordered, np.flatnonzero(np.diff(ordered) > STRAY) + 1)[::-1]
    group = next((g for g in groups if len(g) >= HELD), max(groups, key=len))
    return int(group[0]), int(group[-1])
