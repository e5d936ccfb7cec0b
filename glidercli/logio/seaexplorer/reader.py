"""What does a SeaExplorer text file hold? Navigation (gli) and payload (pld) files, sub or raw, gzip or not.

One line is one record. A record is dropped, and counted by its reason, when it cannot be used as a whole: cut lines,
times that cannot be read, repeat, go back or come from a clock that was not set, lines without a value. Single cells
that cannot be used are counted in warnings (channels.py, where units and signs stand too). Where files were put one
behind the other the header stands there again: it is dropped by name, and one with other columns ends the reading.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.gzipped import DAMAGED, beginning, unpacked
from glidercli.log import Log
from glidercli.logio.cut_text import CUT, ends_open
from glidercli.logio.number_cells import numbers
from glidercli.logio.reader import Aids, Part
from glidercli.logio.records import sampled, to_ns, usable
from glidercli.logio.report import FileReport
from glidercli.logio.seaexplorer.channels import NOTES, SENTINELS, USED, channels_of, impossible_places, near_of

__all__ = ["is_seaexplorer", "read_seaexplorer"]

Times = NDArray[np.int64]

MOST_COLUMNS = 2000
"""Real files have 10 to 60."""
IMPOSSIBLE = "impossible value: no such position"
HEAD = 65536
"""Bytes that the first line stands in."""
NAVIGATION, PAYLOAD = "Timestamp", "PLD_REALTIMECLOCK"
NAME = re.compile(r"(sea\d+)\.", re.IGNORECASE)
"""How a file's name begins; nothing inside the file tells the vehicle."""
RECORDING = re.compile(
    r"(?P<mission>sea\d+\.\d+)\.(?P<unit>gli|pld\d+)\.(?P<kind>sub|raw)\.(?P<dive>\d+)(\.gz)?$", re.IGNORECASE
)
"""A whole name. A raw file holds all that the sub file of the same unit and dive does, and more."""


def is_seaexplorer(path: Path) -> bool:
    """Whether the first line is that of a SeaExplorer file."""
    with path.open("rb") as stream:
        text = beginning(stream.read(HEAD), HEAD).decode("latin-1")
    first = text.split("\n", 1)[0].lstrip("\ufeff\xef\xbb\xbf ")
    return first.split(";", 1)[0].strip() in (NAVIGATION, PAYLOAD) and ";" in first


def read_seaexplorer(path: Path, aids: Aids = Aids()) -> Part:
    """One navigation or payload file."""
    data, whole = unpacked(path, path.read_bytes())
    text = data.decode("latin-1")
    lines = text.lstrip("\ufeff\xef\xbb\xbf ").split("\n")
    names = _names(path, lines[0])
    dropped: Counter[str] = Counter()
    rows, foreign = _rows(lines, names, dropped)
    records = len(rows) + dropped.total()
    time_ns = _times([row[0] for row in rows])
    table = {name: numbers([row[i] for row in rows]) for i, name in enumerate(names) if i > 0 and name}
    known = {name: np.where(np.isin(values, SENTINELS), np.nan, values) for name, values in table.items()}
    good = usable(time_ns, known, dropped)
    unread = tuple(name for name, values in known.items() if name not in USED and not np.isnan(values[good]).all())
    table = {name: values[good] for name, values in table.items()}
    channels, warnings = channels_of(time_ns[good], table)
    named = NAME.match(path.name)
    whose = {"platform": f"SeaExplorer {named[1].lower()}"} if named else {}
    whose["title"] = f"{whose.get('platform', 'SeaExplorer')} log"
    log = Log({channel.name: channel for channel in channels if len(channel)}, "measured", whose | NOTES)
    kept = sampled(time_ns[good], log.channels)
    lost = impossible_places(table) & ~kept
    for reason, which in ((IMPOSSIBLE, lost), ("no usable value", ~kept & ~lost)):
        if count := int(which.sum()):
            dropped[reason] += count
    damaged = "" if whole else DAMAGED
    cut = CUT if whole and ends_open(data) and _lacks_fields(lines[-1], names) else ""
    error = "; ".join(fault for fault in (damaged, foreign, cut) if fault) or None
    report = FileReport(
        path, "seaexplorer", records, int(kept.sum()), tuple(sorted(dropped.items())), tuple(warnings), error
    )
    recording = RECORDING.match(path.name)
    return Part(
        log,
        report,
        time_ns[good][kept],
        dive=f"{recording['mission']}.{recording['dive']}".lower() if recording else "",
        holds=(f"{recording['mission']}.{recording['unit']}.{recording['dive']}".lower(),) if recording else (),
        fullness=int(recording is not None and recording["kind"].lower() == "raw"),
        partner=_partner(recording),
        unread=unread,
        near=near_of(time_ns[good], table),
    )


def _names(path: Path, header: str) -> list[str]:
    """The columns of a header; the last is "" where it ends in a semicolon."""
    if (count := header.count(";") + 1) > MOST_COLUMNS:
        raise InputError(path, f"line 1: names {count} columns; at most {MOST_COLUMNS} are allowed")
    names = [name.strip() for name in header.split(";")]
    twice = [name for name, count in Counter(names).items() if name and count > 1]
    if twice:
        raise InputError(path, f"line 1: column {twice[0]} stands there twice; each may once")
    return names


def _rows(lines: list[str], names: list[str], dropped: Counter[str]) -> tuple[list[list[str]], str]:
    """The cells of each line that has as many as the header, and what is wrong where another header stands, or "".

    The other lines are counted in ``dropped``; so is all from a header with other columns on.
    """
    rows: list[list[str]] = []
    for number, line in enumerate(lines[1:], 2):
        if not line.strip():
            continue
        if line.count(";") > MOST_COLUMNS:  # no line of a million cells is taken apart
            dropped["wrong number of fields"] += 1
            continue
        cells = [cell.strip() for cell in line.split(";")]
        if cells[0] in (NAVIGATION, PAYLOAD):
            if [cell for cell in cells if cell] != [name for name in names if name]:
                left = sum(bool(other.strip()) for other in lines[number - 1 :])
                dropped["behind a header with other columns"] += left
                return rows, f"line {number}: a header with other columns; only what stands before it was read"
            dropped["repeated header"] += 1
            continue
        if len(cells) == len(names) + 1 and names[-1] and not cells[-1]:
            cells.pop()  # lines may end in a semicolon where the header does not; a cut line lacks what the header has
        if len(cells) != len(names):
            dropped["wrong number of fields"] += 1
        else:
            rows.append(cells)
    return rows, ""


def _lacks_fields(line: str, names: list[str]) -> bool:
    """Whether a line that is not blank has fewer fields than the header."""
    return bool(line.strip()) and line.count(";") < len(names) - 1


def _partner(recording: re.Match[str] | None) -> str:
    """The payload recording beside a navigation one, and the other way round."""
    if recording is None:
        return ""
    unit = "pld1" if recording["unit"].lower() == "gli" else "gli"
    return f"{recording['mission']}.{unit}.{recording['dive']}".lower()


def _times(texts: list[str]) -> Times:
    """Times in UTC ns; NO_TIME where a text is no time."""
    import pandas as pd

    parsed = pd.to_datetime(pd.Series(texts, dtype=object), format="%d/%m/%Y %H:%M:%S.%f", errors="coerce")
    whole = pd.to_datetime(pd.Series(texts, dtype=object), format="%d/%m/%Y %H:%M:%S", errors="coerce")
    return to_ns(parsed.fillna(whole))
