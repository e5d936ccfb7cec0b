"""How does a Parquet table in the contract's names become a Log? One that glider wrote, or one of another program."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast, get_args

import numpy as np

from glidercli.channels import CHANNELS, PHASES, by_column
from glidercli.errors import InputError
from glidercli.log import Channel, Log, Origin
from glidercli.logio.own.csv_metadata import parsed_metadata
from glidercli.logio.own.parquet_log import METADATA_KEY
from glidercli.logio.own.table_back import log_of, part_of, without_impossible
from glidercli.logio.reader import Aids, Part
from glidercli.origins import BOTH, column_name, origins

__all__ = ["DAMAGED", "is_own_parquet", "is_parquet", "opened", "read_own_parquet"]

MAGIC = b"PAR1"
DAMAGED = "is Parquet data that cannot be read: damaged or cut short; a whole file is needed"
_TIMES = ("time_utc", "elapsed_s")
_EPOCH = "2000-01-01T00:00:00"
"""Start of a table that has elapsed_s alone, as of a CSV."""


def is_parquet(path: Path) -> bool:
    """Whether the file starts as a Parquet file does."""
    with path.open("rb") as stream:
        return stream.read(4) == MAGIC


@contextlib.contextmanager
def opened(path: Path) -> Iterator[Any]:
    """The pyarrow ParquetFile; InputError for whatever fails while it is open. Checksums of pages are verified."""
    import pyarrow as pa
    from pyarrow import parquet

    try:
        with parquet.ParquetFile(path, page_checksum_verification=True) as file:
            yield file
    except (pa.ArrowException, OSError, ValueError, LookupError, MemoryError) as fault:
        raise InputError(path, DAMAGED) from fault


def is_own_parquet(path: Path) -> bool:
    """Whether the columns have names of the contract, a time among them."""
    if not is_parquet(path):
        return False
    try:
        with opened(path) as file:
            names = [column_name(name) for name in file.schema_arrow.names]
    except InputError:
        return False
    return bool(set(_TIMES) & set(names)) and any(by_column(name) for name in names)


def read_own_parquet(path: Path, aids: Aids = Aids()) -> Part:
    """The Log of a Parquet table.

    Of a table that glider wrote times, origins, metadata and events come back exactly, values within the rounding of
    degrees. Another program's is taken as measured, unless a column named origin says otherwise, with a warning.
    Raises InputError for times that cannot be read or do not increase, cells that are no number and unknown phases,
    naming the row (counted from 1).
    """
    columns, metadata, of_fields = _columns(path)
    table, unknown = _table(path, columns)
    warnings = [f"columns not known and not used: {', '.join(unknown)}"] if unknown else []
    word = None
    if not metadata and "origin" in columns and len(table):
        cells = enumerate((str(cell or "") for cell in columns["origin"].to_pylist()), 1)
        found = origins(path, cells)
        word = found[0]
        if len(found) > 1:
            warnings.append(f"origins {', '.join(found)} in one table: all of it is taken as {word}")
        if word == BOTH:
            warnings.append("the table does not say which channels are derived: all are taken as derived")
    without_impossible(table, metadata, word, warnings)
    log = log_of(table, metadata, word, "time_utc" in columns, warnings)
    if not metadata:
        sampled = {name: channel for name, channel in log.channels.items() if len(channel)}
        return part_of(path, "glider-parquet", Log(sampled, log.origin, log.metadata), table, {}, warnings)
    channels = {name: _with_origin(c, of_fields[CHANNELS[name].column]) for name, c in log.channels.items()}
    log = Log(channels, log.origin, log.metadata, log.events)
    return part_of(path, "glider-parquet", log, table, {}, warnings)


def _with_origin(channel: Channel, told: str) -> Channel:
    """A channel without a sample has its origin in the schema alone."""
    if len(channel) or told not in get_args(Origin):
        return channel
    return Channel(channel.name, channel.time_ns, channel.values, cast(Origin, told))


def _columns(path: Path) -> tuple[dict[str, Any], dict[str, Any], dict[str, str]]:
    """The columns by name; the metadata that glider wrote, or nothing; the origin that the schema tells by column."""
    with opened(path) as file:
        schema = file.schema_arrow
        names = [column_name(name) for name in schema.names]
        twice = [name for name in dict.fromkeys(names) if names.count(name) > 1]
        if twice:
            raise InputError(path, f"column {twice[0]} stands there twice; each may once")
        if not set(_TIMES) & set(names):
            raise InputError(path, "has no column of times; time_utc or elapsed_s is needed")
        told = (file.metadata.metadata or {}).get(METADATA_KEY.encode())
        what = f"its entry {METADATA_KEY} is not the metadata of a log"
        metadata = parsed_metadata(path, what, told) if told is not None else {}
        used = [f for f, n in zip(schema.names, names, strict=True) if by_column(n) or n in (*_TIMES, "origin")]
        read = file.read(columns=used)
    of_fields = {column_name(f.name): (f.metadata or {}).get(b"origin", b"").decode("utf-8", "replace") for f in schema}
    columns = {column_name(name): read.column(name) for name in used}
    return columns | {name: None for name in names if name not in columns}, metadata, of_fields


def _table(path: Path, columns: dict[str, Any]) -> tuple[Any, list[str]]:
    """The table that a Log is made of, and the names of columns that are not known."""
    import pandas as pd

    table = pd.DataFrame({"time_utc": _times(path, columns)})
    unknown = []
    for name, column in columns.items():
        spec = by_column(name)
        if spec is None:
            unknown += [] if name in (*_TIMES, "origin") else [name]
        else:
            table[name] = _phases(path, column) if spec.name == "phase" else _numbers(path, name, column)
    return table, unknown


def _numbers(path: Path, name: str, column: Any) -> Any:
    """A column of numbers, NaN where it is null."""
    import pyarrow as pa

    try:
        values = column.cast(pa.float64()).to_numpy()
    except (pa.ArrowException, ValueError):
        raise InputError(path, f"{name} is a column of {column.type}; numbers are needed") from None
    endless = np.flatnonzero(np.isinf(values))
    if len(endless):
        raise InputError(path, f"row {endless[0] + 1}: {name} = {values[endless[0]]}; a finite number is needed")
    return values


def _phases(path: Path, column: Any) -> Any:
    """A column of phases, None where it is null."""
    words = np.array(column.to_pylist(), dtype=object)
    bad = np.flatnonzero([word is not None and word not in PHASES for word in words])
    if len(bad):
        raise InputError(path, f"row {bad[0] + 1}: phase = {words[bad[0]]!r}; allowed: {', '.join(PHASES)}")
    return words


def _times(path: Path, columns: dict[str, Any]) -> Any:
    """Times of the rows, datetime64[ns], UTC."""
    import pandas as pd
    import pyarrow as pa

    dated = "time_utc" in columns
    column = columns["time_utc" if dated else "elapsed_s"]
    try:
        if not dated:
            elapsed = column.cast(pa.float64()).to_numpy()
            elapsed = np.where(np.abs(elapsed) < 5e9, elapsed, np.nan)  # 158 years
            steps = np.rint(np.where(np.isfinite(elapsed), elapsed, 0.0) * 1e9).astype("timedelta64[ns]")
            moments = np.datetime64(_EPOCH, "ns") + steps
            times = np.where(np.isfinite(elapsed), moments, np.datetime64("NaT", "ns"))
        elif pa.types.is_timestamp(column.type):
            whole = column.cast(pa.timestamp("ns", column.type.tz)).cast(pa.int64())
            times = whole.fill_null(np.iinfo(np.int64).min).to_numpy().astype("datetime64[ns]")
        else:
            texts = pd.Series(column.cast(pa.string()).to_pylist(), dtype=object)
            parsed = pd.to_datetime(texts, utc=True, errors="coerce", format="ISO8601").dt.tz_localize(None)
            told = parsed.between(pd.Timestamp("1700-01-01"), pd.Timestamp("2200-01-01"))  # what 64 bits of ns hold
            times = parsed.where(told).to_numpy().astype("datetime64[ns]")
    except (pa.ArrowException, ValueError, OverflowError):
        raise InputError(path, f"its times are a column of {column.type}; timestamps or seconds are needed") from None
    bad = np.flatnonzero(np.isnat(times))
    if len(bad):
        raise InputError(path, f"row {bad[0] + 1}: the time cannot be read; a time or seconds are needed")
    back = np.flatnonzero(np.diff(times) <= np.timedelta64(0, "ns"))
    if len(back):
        raise InputError(path, f"row {back[0] + 2}: the time does not increase; rows must be in time order")
    return times
