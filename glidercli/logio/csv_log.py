"""How does a Log stand in a CSV table? The contract's column names; provenance beside it in FILE.csv-metadata.json."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from glidercli.channels import by_column
from glidercli.errors import InputError
from glidercli.log import Event, Log
from glidercli.logio.report import FileReport

__all__ = ["is_csv", "metadata_path", "read_csv", "write_csv", "write_csv_stream", "write_metadata"]

_EPOCH = "2000-01-01T00:00:00"
"""Start of a table that has elapsed_s alone; the same arbitrary date as for a flight without one."""


def metadata_path(path: Path) -> Path:
    """Where the provenance of a CSV file stands."""
    return path.with_name(path.name + "-metadata.json")


def write_csv_stream(log: Log, stream: TextIO) -> None:
    """The log as CSV: first line the column names, empty where a channel has no sample; numbers to the last digit."""
    table = log.table()
    table["time_utc"] = np.datetime_as_string(table["time_utc"].to_numpy(), unit="ns")
    table["time_utc"] += "Z"
    table.to_csv(stream, index=False, lineterminator="\n")


def write_csv(log: Log, path: Path) -> None:
    """The log as a CSV file."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        write_csv_stream(log, stream)


def write_metadata(log: Log, path: Path) -> None:
    """What the table cannot hold: origin, metadata with provenance, the channels' origins, events."""
    told: dict[str, Any] = dict(log.metadata)
    if "provenance" in told:
        told["provenance"] = json.loads(told["provenance"])
    document = {
        "origin": log.origin,
        "metadata": told,
        "channels": {name: channel.origin for name, channel in log.channels.items()},
        "events": [{"name": e.name, "time_ns": e.time_ns, "depth_m": e.depth} for e in log.events],
    }
    path.write_text(json.dumps(document, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


def is_csv(path: Path) -> bool:
    """Whether the first line names columns of the contract, a time among them."""
    try:
        with path.open(encoding="utf-8-sig") as stream:
            names = [name.strip() for name in stream.readline().split(",")]
    except UnicodeDecodeError:
        return False
    return bool({"time_utc", "elapsed_s"} & set(names)) and any(by_column(name) for name in names)


def read_csv(path: Path) -> tuple[Log, FileReport]:
    """A log from a CSV table with time_utc (or elapsed_s) and columns in the contract's names.

    Raises InputError where a cell is no number or a time cannot be read or does not increase, naming the line.
    """
    import pandas as pd

    try:
        text = pd.read_csv(path, dtype=str, encoding="utf-8-sig", keep_default_na=False)
    except (UnicodeDecodeError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise InputError(path, f"is not a CSV table: {error}") from None
    table = pd.DataFrame({"time_utc": _times(path, text)})
    unknown = []
    for name in text.columns:
        spec = by_column(str(name))
        if spec is None:
            unknown += [] if name in ("time_utc", "elapsed_s", "origin") else [str(name)]
        elif spec.name == "phase":
            table[name] = text[name]
        else:
            table[name] = _numbers(path, str(name), text[name])
    metadata: dict[str, Any] = {}
    beside = metadata_path(path)
    if beside.is_file():
        metadata = json.loads(beside.read_text(encoding="utf-8"))
    told = {key: v if isinstance(v, str) else json.dumps(v) for key, v in metadata.get("metadata", {}).items()}
    log = Log.from_table(table, metadata.get("origin", "measured"), told)
    events = tuple(Event(e["name"], int(e["time_ns"]), e["depth_m"]) for e in metadata.get("events", []))
    log = Log({n: c for n, c in log.channels.items() if len(c)}, log.origin, log.metadata, events)
    kept = int(table.drop(columns="time_utc").replace("", None).notna().any(axis=1).sum())
    dropped = (("no value", len(table) - kept),) if kept < len(table) else ()
    warnings = (f"columns not known and not used: {', '.join(unknown)}",) if unknown else ()
    return log, FileReport(path, "glider-csv", len(table), kept, dropped, warnings)


def _times(path: Path, text: Any) -> Any:
    """Times of the rows, datetime64[ns], UTC."""
    import pandas as pd

    if "time_utc" in text:
        parsed = pd.to_datetime(text["time_utc"], utc=True, errors="coerce", format="ISO8601").dt.tz_localize(None)
        times = parsed.to_numpy().astype("datetime64[ns]")
    else:
        elapsed = pd.to_numeric(text["elapsed_s"], errors="coerce").to_numpy(dtype=float)
        steps = np.where(np.isfinite(elapsed), np.round(elapsed * 1e9), np.iinfo(np.int64).min)
        times = np.where(
            np.isfinite(elapsed), np.datetime64(_EPOCH, "ns") + steps.astype("m8[ns]"), np.datetime64("NaT")
        )
    bad = np.flatnonzero(np.isnat(times))
    if len(bad):
        raise InputError(path, f"line {int(bad[0]) + 2}: the time cannot be read; ISO 8601 UTC or seconds are needed")
    back = np.flatnonzero(np.diff(times) <= np.timedelta64(0, "ns"))
    if len(back):
        raise InputError(path, f"line {int(back[0]) + 3}: the time does not increase; rows must be in time order")
    return times


def _numbers(path: Path, name: str, cells: Any) -> Any:
    """A column of numbers, NaN where a cell is empty or says NaN."""
    import pandas as pd

    stripped = cells.str.strip()
    empty = stripped.str.lower().isin(["", "nan"])
    values = pd.to_numeric(stripped.where(~empty, None), errors="coerce").to_numpy(dtype=float)
    bad = np.flatnonzero(~empty.to_numpy() & ~np.isfinite(values))
    if len(bad):
        row = int(bad[0])
        raise InputError(path, f"line {row + 2}: {name} = {cells.iloc[row]!r}; a number is needed")
    return values
