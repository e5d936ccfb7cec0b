"""What does a reader take, and what does it give? One file in; a Log and the account of every record out."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Log
from glidercli.logio.report import FileReport
from glidercli.logio.whereabouts import Whereabouts

__all__ = ["Aids", "Format", "Part"]


@dataclasses.dataclass(frozen=True)
class Aids:
    """What a reader may need beside the file.

    cache : folder of Slocum caches, asked after those beside the file. columns : TOML that maps the columns of plain
    tables.
    """

    cache: Path | None = None
    columns: Path | None = None


@dataclasses.dataclass(frozen=True)
class Part:
    """What one file gave.

    log : its channels, events and metadata. report : its account.
    record_ns : (kept,), time of each record that was kept, UTC ns, not decreasing.
    dive : what files of one dive share, such as "sea035.12.36"; "" where nothing tells. They may interleave.
    holds : names of the recordings that the file holds, such as "sea035.12.gli.36"; a file whose recordings are all in
    others is left out in favour of the fullest.
    fullness : of several files that hold the same, the one with the most counts.
    partner : name of the recording that a file beside this one usually holds, or "".
    yields : channels that are given up where another file of the dive has them.
    unread : names of columns with data that no channel is taken from.
    near : positions that need be no fixes, for what is derived from them; None where the file tells none.
    """

    log: Log
    report: FileReport
    record_ns: NDArray[np.int64]
    dive: str = ""
    holds: tuple[str, ...] = ()
    fullness: int = 0
    yields: frozenset[str] = frozenset()
    partner: str = ""
    unread: tuple[str, ...] = ()
    near: Whereabouts | None = None


@dataclasses.dataclass(frozen=True)
class Format:
    """A family of files.

    recognises : whether a file is one, by its content. read : its reader.
    own : whether it is one of the program's own, which come back as they were written, with nothing derived anew.
    """

    recognises: Callable[[Path], bool]
    read: Callable[[Path, Aids], Part]
    own: bool = False
