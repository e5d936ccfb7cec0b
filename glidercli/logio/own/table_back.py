"""Which Log does a table in the contract's names make? What its metadata tell; without them, a measured one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, cast

import numpy as np

from glidercli.channels import by_column
from glidercli.log import Channel, Log, Origin
from glidercli.logio.own.csv_metadata import events_of, texts_of
from glidercli.logio.plausible import quantity_of
from glidercli.logio.reader import Part
from glidercli.logio.report import FileReport
from glidercli.origins import BOTH

__all__ = ["log_of", "part_of", "without_impossible"]


def log_of(table: Any, metadata: Mapping[str, Any], word: str | None, dated: bool, warnings: list[str]) -> Log:
    """The Log of a table; a channel may have no sample.

    table : time_utc (datetime64[ns], increasing) and columns in the contract's names, NaN where there is no sample.
    metadata : as ``metadata_of`` gave, or nothing where none came with the table. word : what its rows say of their
    origin, or None. dated : whether the dates are those of the table. warnings : what is assumed is added.
    """
    told = texts_of(metadata) if metadata else {}
    if not dated:
        told["time_note"] = "the date is arbitrary: the table has elapsed_s alone"
    if not metadata and word is None:
        told["origin_note"] = "taken as measured: the table does not say where its values come from"
        warnings.append(told["origin_note"])
    other = cast(Origin, "derived" if word == BOTH else word or "measured")
    origin: Origin = metadata.get("origin", other)
    of_channels = metadata.get("channels", {})
    rest = "derived" if word == BOTH else origin
    log = Log.from_table(table, origin, told)
    channels = {
        c.name: Channel(c.name, c.time_ns, c.values, of_channels.get(c.name, rest)) for c in log.channels.values()
    }
    return Log(channels, origin, told, events_of(metadata) if metadata else ())


def without_impossible(table: Any, metadata: Mapping[str, Any], word: str | None, warnings: list[str]) -> None:
    """Empty the cells of a measured table of another program that hold what the quantity cannot be, and count them.

    A table that glider wrote, and one that says it is simulated or rebuilt, is left as it is.
    """
    if metadata or word not in (None, "measured"):
        return
    for name in table.columns:
        spec = by_column(str(name))
        if spec is None or spec.name == "phase":
            continue
        values = table[name].to_numpy(dtype=float) / spec.factor
        bounds = quantity_of(spec.name)
        outside = (values < bounds.low) | (values > bounds.high)
        if outside.any():
            low, high = (bound * spec.factor for bound in (bounds.low, bounds.high))
            warnings.append(
                f"{name}: {int(outside.sum())} values outside {round(low, 6) + 0.0:g}..{round(high, 6):g} "
                f"{spec.column_unit} left out"
            )
            table.loc[outside, name] = np.nan


def part_of(
    path: Path,
    format: str,
    log: Log,
    table: Any,
    dropped: Mapping[str, int],
    warnings: list[str],
    unread: Sequence[str] = (),
) -> Part:
    """The Log of a table with its account: a record is a row; one without any value is dropped.

    dropped : rows that are not in the table, by reason. unread : columns that are not known.
    """
    kept = table.drop(columns="time_utc").notna().any(axis=1).to_numpy()
    every = {"no value": int((~kept).sum()), **dropped}
    reasons = tuple((reason, count) for reason, count in every.items() if count)
    records = len(table) + sum(dropped.values())
    report = FileReport(path, format, records, int(kept.sum()), reasons, tuple(warnings))
    time_ns = table["time_utc"].to_numpy().astype("datetime64[ns]").astype(np.int64)
    return Part(log, report, time_ns[kept], unread=tuple(unread))
