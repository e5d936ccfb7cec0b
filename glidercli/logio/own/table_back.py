"""Which Log does a table in the contract's names make? What its metadata tell; without them, a measured one."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.log import Channel, Log, Origin
from glidercli.logio.own.cells import ISO_NEEDED, SECONDS_NEEDED
from glidercli.logio.own.csv_metadata import events_of, stranger, texts_of
from glidercli.logio.own.rules import Shown, channels_of, unread_times, unusable
from glidercli.logio.reader import Part
from glidercli.logio.report import FileReport
from glidercli.origins import BOTH

__all__ = ["OwnTable", "part_of"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]


@dataclasses.dataclass(frozen=True)
class OwnTable:
    """A table as it was read.

    time_ns : (n,), UTC ns, NO_TIME where it cannot be read. columns : by channel, (n,), SI; NaN where there is no
    sample, infinite where a cell is no number. dated : whether the dates are those of the table. word : what its rows
    say of their origin, or None. cut : rows with another number of fields than there are columns. unknown : names of
    columns that are not known, with data. shown : a cell, and where it stands.
    """

    path: Path
    time_ns: Times
    columns: Mapping[str, Array]
    dated: bool
    word: str | None
    unknown: tuple[str, ...]
    shown: Shown
    cut: int = 0


def part_of(
    table: OwnTable,
    format: str,
    metadata: Mapping[str, Any],
    warnings: list[str],
    of_empty: Mapping[str, Origin] | None = None,
    changed: str = "",
) -> Part:
    """The Log of a table, with its account: a record is a row.

    metadata : as ``metadata_of`` gave, or nothing where none came with the table. of_empty : origins of channels
    without a sample, which are kept then; None leaves such channels out. changed : name of the metadata, where the
    table is not as it was when these were written. Raises InputError where they can only be of another table.
    """
    hints: list[str] = []
    column = "time_utc" if table.dated else "elapsed_s"
    if line := unread_times(column, table.time_ns, table.shown, ISO_NEEDED if table.dated else SECONDS_NEEDED):
        hints.append(line)
    other = cast(Origin, "derived" if table.word == BOTH else table.word or "measured")
    origin: Origin = metadata.get("origin", other)
    rest: Origin = "derived" if table.word == BOTH else origin
    of_channels = {name: metadata.get("channels", {}).get(name, rest) for name in table.columns}
    dropped: Counter[str] = Counter({"wrong number of fields": table.cut} if table.cut else {})
    channels, kept_ns = channels_of(table.time_ns, table.columns, of_channels, dropped, hints, table.shown)
    if changed:
        _check_same(table, changed, metadata, channels, kept_ns)
    empty = of_empty or {}
    channels = {
        name: channel if len(channel) else dataclasses.replace(channel, origin=empty.get(name, channel.origin))
        for name, channel in channels.items()
        if len(channel) or of_empty is not None
    }
    told = texts_of(metadata) if metadata else {}
    if not table.dated:
        told["time_note"] = "the date, from 2000-01-01 on, is arbitrary: the table has elapsed_s alone"
        warnings = [*warnings, told["time_note"]]
    if not metadata and table.word is None:
        told["origin_note"] = "taken as measured: the table does not say where its values come from"
        warnings = [*warnings, told["origin_note"]]
    log = Log(channels, origin, told, events_of(metadata) if metadata else ())
    error = None if len(kept_ns) or not len(table.time_ns) + table.cut else unusable(dropped, hints)
    report = FileReport(
        table.path, format, len(table.time_ns) + table.cut, len(kept_ns), tuple(sorted(dropped.items())),
        (*warnings, *hints), error,
    )  # fmt: skip
    return Part(log, report, kept_ns, unread=table.unknown)


def _check_same(
    table: OwnTable, beside: str, metadata: Mapping[str, Any], channels: Mapping[str, Channel], kept_ns: Times
) -> None:
    """Refuse metadata that can only be of another table."""
    told = [name for name in CHANNELS if name in channels and len(channels[name])]
    span = (int(kept_ns[0]), int(kept_ns[-1])) if table.dated and len(kept_ns) else None
    if why := stranger(metadata, told, span):
        raise InputError(table.path, f"{beside} is of another table: {why}; remove it to read the table")
