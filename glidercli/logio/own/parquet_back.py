"""How does a Parquet table in the contract's names become a Log? One that glider wrote, or one of another program."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, cast, get_args

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS, by_column
from glidercli.errors import InputError
from glidercli.log import Origin
from glidercli.logio.own.cells import numbers, phases, times_of_seconds, times_of_texts, times_of_timestamps
from glidercli.logio.own.csv_metadata import parsed_metadata
from glidercli.logio.own.parquet_log import METADATA_KEY
from glidercli.logio.own.table_back import OwnTable, part_of
from glidercli.logio.reader import Aids, Part
from glidercli.origins import BOTH, column_name, origins

__all__ = ["DAMAGED", "is_own_parquet", "is_parquet", "opened", "read_own_parquet"]

MAGIC = b"PAR1"
DAMAGED = "is Parquet data that cannot be read: damaged or cut short; a whole file is needed"
_TIMES = ("time_utc", "elapsed_s")


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
    degrees. Another program's is taken as measured, unless a column named origin says otherwise, with a warning. Rows
    and cells that cannot be used are dropped, left out and counted by the rules of ``rules.py``. Raises InputError for
    columns of a type that holds no times or numbers, and for an unknown origin.
    """
    columns, metadata, of_fields = _columns(path)
    warnings: list[str] = []
    word = None
    if not metadata and columns.get("origin") is not None and len(columns["origin"]):
        cells = enumerate((str(cell or "") for cell in columns["origin"].to_pylist()), 1)
        found = origins(path, cells)
        word = found[0]
        if len(found) > 1:
            warnings.append(f"origins {', '.join(found)} in one table: all of it is taken as {word}")
        if word == BOTH:
            warnings.append("the table does not say which channels are derived: all are taken as derived")
    told = {}
    unknown = []
    for name, column in columns.items():
        spec = by_column(name)
        if spec is None:
            unknown += [] if name in (*_TIMES, "origin") else [name]
        else:
            values = phases(_series(column)) if spec.name == "phase" else _numbers(path, name, column)
            told[spec.name] = values / spec.factor
    if unknown:
        warnings.insert(0, f"columns not known and not used: {', '.join(unknown)}")
    table = OwnTable(
        path, _times(path, columns), told, "time_utc" in columns, word, tuple(unknown),
        lambda column, row: f"row {row + 1}: {str(columns[column][row].as_py())[:40]!r}",
    )  # fmt: skip
    return part_of(table, "glider-parquet", metadata, warnings, _of_empty(told, of_fields) if metadata else None)


def _of_empty(names: Iterable[str], told: Mapping[str, str]) -> dict[str, Origin]:
    """Origins by channel as the schema tells them; that of a channel without a sample stands nowhere else."""
    of_columns = {name: told.get(CHANNELS[name].column, "") for name in names}
    return {name: cast(Origin, word) for name, word in of_columns.items() if word in get_args(Origin)}


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


def _series(column: Any) -> Any:
    """An Arrow column of text as a pandas Series, None where it is null."""
    import pandas as pd

    return pd.Series(column.cast("string").to_pylist(), dtype=object)


def _numbers(path: Path, name: str, column: Any) -> NDArray[np.float64]:
    """A column of numbers, NaN where it is null, infinite where a text is no number."""
    import pyarrow as pa

    try:
        if pa.types.is_string(column.type) or pa.types.is_large_string(column.type):
            return numbers(_series(column))
        return np.array(column.cast(pa.float64()).to_numpy(), dtype=float)
    except (pa.ArrowException, ValueError):
        raise InputError(path, f"{name} is a column of {column.type}; numbers are needed") from None


def _times(path: Path, columns: dict[str, Any]) -> NDArray[np.int64]:
    """Times of the rows, UTC ns, NO_TIME where one cannot be read."""
    import pyarrow as pa

    dated = "time_utc" in columns
    column = columns["time_utc" if dated else "elapsed_s"]
    if not dated:
        return times_of_seconds(_numbers(path, "elapsed_s", column))
    try:
        if pa.types.is_timestamp(column.type):
            return times_of_timestamps(column)
        return times_of_texts(_series(column))
    except (pa.ArrowException, ValueError, OverflowError):
        raise InputError(path, f"its times are a column of {column.type}; timestamps or seconds are needed") from None
