"""How does a Log stand in a CSV table? The contract's column names; provenance beside it in FILE.csv-metadata.json."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, TextIO, get_args

import numpy as np

from glidercli.channels import by_column
from glidercli.errors import InputError
from glidercli.log import Channel, Event, Log, Origin
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

    Where its values come from is told by the metadata beside it, else by a column named origin; else they are taken as
    measured, and the log's metadata say so. Raises InputError where a cell is no number or a time cannot be read or
    does not increase, naming the line.
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
    beside = metadata_path(path)
    metadata = _metadata(beside) if beside.is_file() else {}
    warnings = [f"columns not known and not used: {', '.join(unknown)}"] if unknown else []
    told = {key: v if isinstance(v, str) else json.dumps(v) for key, v in metadata.get("metadata", {}).items()}
    if "time_utc" not in text:
        told["time_note"] = "the date is arbitrary: the table has elapsed_s alone"
    if "origin" not in metadata and "origin" not in text:
        told["origin_note"] = "taken as measured: the table does not say where its values come from"
    origin = metadata.get("origin") or _origin(path, text, warnings)
    log = Log.from_table(table, origin, told)
    origins = metadata.get("channels", {})
    channels = [Channel(c.name, c.time_ns, c.values, origins.get(c.name, origin)) for c in log.channels.values()]
    events = tuple(Event(e["name"], int(e["time_ns"]), e["depth_m"]) for e in metadata.get("events", []))
    log = Log({channel.name: channel for channel in channels if len(channel)}, origin, log.metadata, events)
    kept = int(table.drop(columns="time_utc").replace("", None).notna().any(axis=1).sum())
    dropped = (("no value", len(table) - kept),) if kept < len(table) else ()
    return log, FileReport(path, "glider-csv", len(table), kept, dropped, tuple(warnings))


def _metadata(path: Path) -> dict[str, Any]:
    """What `write_metadata` wrote; InputError where it is something else."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        origins = [found["origin"], *found["channels"].values()]
        told, events = found["metadata"], [(e["name"], int(e["time_ns"]), e["depth_m"]) for e in found["events"]]
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(path, f"is not the metadata of a log's CSV: {type(error).__name__} {error}") from None
    if not isinstance(told, dict) or not isinstance(events, list) or not set(origins) <= set(get_args(Origin)):
        raise InputError(path, f"is not the metadata of a log's CSV; origins are {', '.join(get_args(Origin))}")
    return dict(found)


def _origin(path: Path, text: Any, warnings: list[str]) -> Origin:
    """Where the values come from, by the column named origin: the least that a row says."""
    if "origin" not in text:
        return "measured"
    words = text["origin"].str.strip()
    known: tuple[Origin, ...] = ("reconstruction", "simulated", "derived", "measured")  # the least first
    bad = np.flatnonzero(~words.isin(known))
    if len(bad):
        row = int(bad[0])
        raise InputError(path, f"line {row + 2}: origin = {words.iloc[row]!r}; allowed: {', '.join(known)}")
    found = [word for word in known if (words == word).any()]
    if len(found) > 1:
        warnings.append(f"origins {', '.join(found)} in one table: all of it is taken as {found[0]}")
    return found[0] if found else "measured"


def _times(path: Path, text: Any) -> Any:
    """Times of the rows, datetime64[ns], UTC."""
    import pandas as pd

    if "time_utc" in text:
        parsed = pd.to_datetime(text["time_utc"], utc=True, errors="coerce", format="ISO8601").dt.tz_localize(None)
        times = parsed.to_numpy().astype("datetime64[ns]")
    else:
        elapsed = pd.to_numeric(text["elapsed_s"], errors="coerce").to_numpy(dtype=float)
        steps = np.round(np.where(np.isfinite(elapsed), elapsed, 0.0) * 1e9).astype(np.int64)
        times = (np.datetime64(_EPOCH, "ns").astype(np.int64) + steps).astype("datetime64[ns]")
        times[~np.isfinite(elapsed)] = np.datetime64("NaT", "ns")
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
