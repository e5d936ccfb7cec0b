"""How does a Log stand in a CSV table? The contract's column names; provenance beside it in FILE.csv-metadata.json."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from glidercli.channels import PHASES, by_column
from glidercli.errors import InputError
from glidercli.files import metadata_path
from glidercli.log import Log
from glidercli.logio.own.csv_metadata import origin_word, read_metadata, stranger
from glidercli.logio.own.table_back import log_of, part_of, without_impossible
from glidercli.logio.reader import Aids, Part
from glidercli.logio.records import YEARS, to_ns
from glidercli.origins import BOTH, column_name, origins
from glidercli.provenance import file_hash

__all__ = ["CsvTable", "is_csv", "read_csv"]

_EPOCH = "2000-01-01T00:00:00"
"""Start of a table that has elapsed_s alone; the same arbitrary date as for a flight without one."""


class CsvTable:
    """A log as CSV, piece by piece: first line the column names, empty where a channel has no sample; numbers to the
    last digit.

    The last column says of every row what the log is, so that a table parted from its metadata is not taken for more.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._zero_ns: int | None = None

    def add(self, log: Log) -> None:
        """Append a piece; all have the same channels."""
        import pyarrow as pa
        from pyarrow import csv as csv_of_arrow  # ten times as fast as pandas

        first = self._zero_ns is None
        if first and any(map(len, log.channels.values())):
            self._zero_ns = log.start_ns
        table = log.table(self._zero_ns)
        table["time_utc"] = np.datetime_as_string(table["time_utc"].to_numpy(), unit="ns")
        table["time_utc"] += "Z"
        table["origin"] = origin_word(log.origin, log.metadata, {c.origin for c in log.channels.values()})
        if first:
            self._stream.write(",".join(table.columns) + "\n")
        options = csv_of_arrow.WriteOptions(include_header=False, quoting_style="none")
        rows = io.BytesIO()
        csv_of_arrow.write_csv(pa.Table.from_pandas(table, preserve_index=False), rows, options)
        self._stream.write(rows.getvalue().decode())

    def close(self, metadata: Mapping[str, Any]) -> None:
        """Finish; the metadata stand beside the table, not in it."""
        self._stream.flush()


def is_csv(path: Path) -> bool:
    """Whether the first line names columns of the contract, a time among them."""
    with path.open("rb") as stream:
        first = stream.readline(1 << 20)
    try:
        names = [name.strip() for name in first.decode("utf-8-sig").split(",")]
    except UnicodeDecodeError:
        return False
    return bool({"time_utc", "elapsed_s"} & set(names)) and any(by_column(name) for name in names)


def read_csv(path: Path, aids: Aids = Aids()) -> Part:
    """A log from a CSV table with time_utc (or elapsed_s) and columns in the contract's names.

    Where its values come from is told by the metadata beside it and by a column named origin, which must not
    contradict each other; without both they are taken as measured, and the log's metadata say so. A row with another
    number of fields than the first line, such as a last one cut short, is dropped and counted. Raises InputError where
    a cell is no number, a phase is unknown, or a time cannot be read or does not increase, naming the line.
    """
    import pandas as pd

    text, cut = _text_table(path)
    table = pd.DataFrame({"time_utc": _times(path, text)}, index=text.index)
    unknown = []
    for name in text.columns:
        spec = by_column(name)
        if spec is None:
            unknown += [] if name in ("time_utc", "elapsed_s", "origin") else [name]
        else:
            table[name] = _phases(path, text[name]) if spec.name == "phase" else _numbers(path, name, text[name])
    metadata = read_metadata(path)
    warnings = [f"columns not known and not used: {', '.join(unknown)}"] if unknown else []
    unread = [name for name in unknown if text[name].str.strip().any()]
    word = _origin_of_rows(path, text, warnings)
    beside = metadata_path(path).name
    if metadata:
        expected = origin_word(metadata["origin"], metadata["metadata"], set(metadata["channels"].values()))
        if word not in (None, expected):
            raise InputError(path, f"its rows say {word}, {beside} says {expected}; one belongs to another table")
        if metadata.get("table_sha256") not in (None, file_hash(path)):
            _check_same(path, table, metadata, "time_utc" in text)
            warnings.append(f"has changed since {beside} was written; what that says of origins is kept")
    elif word == BOTH:
        warnings.append(f"{beside} is missing: which channels are derived is not known, all are taken as derived")
    without_impossible(table, metadata, word, warnings)
    log = log_of(table, metadata, word, "time_utc" in text, warnings)
    log = Log({c.name: c for c in log.channels.values() if len(c)}, log.origin, log.metadata, log.events)
    return part_of(path, "glider-csv", log, table, {"wrong number of fields": cut}, warnings, unread)


def _check_same(path: Path, table: Any, metadata: dict[str, Any], dated: bool) -> None:
    """Refuse metadata that can only be of another table. dated : whether the table has dates, not elapsed_s alone."""
    values = table.drop(columns="time_utc")
    specs = [by_column(str(name)) for name in values.columns[values.notna().any()]]
    times = table["time_utc"].to_numpy().astype(np.int64)
    span = (int(times[0]), int(times[-1])) if dated and len(times) else None
    why = stranger(metadata, [spec.name for spec in specs if spec], span)
    if why:
        raise InputError(path, f"{metadata_path(path).name} is of another table: {why}; remove it to read the table")


def _text_table(path: Path) -> tuple[Any, int]:
    """The cells as text, the line in the file as index, and the number of rows with too few or too many of them."""
    import pandas as pd

    try:
        with path.open(encoding="utf-8-sig", newline="") as stream:
            reader = csv.reader(stream, strict=True)
            names = [column_name(name) for name in next(reader, [])]
            rows, lines, cut = [], [], 0
            for row in reader:
                if len(row) == len(names):
                    rows.append(row)
                    lines.append(reader.line_num)
                else:
                    cut += bool(row)  # an empty line is no row
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(path, f"is not a CSV table: {error}") from None
    twice = [name for name in dict.fromkeys(names) if names.count(name) > 1]
    if twice:
        raise InputError(path, f"line 1: column {twice[0]} stands there twice; each may once")
    if not {"time_utc", "elapsed_s"} & set(names):
        raise InputError(path, "line 1: no column of times; time_utc or elapsed_s is needed")
    return pd.DataFrame(rows, columns=names, index=lines, dtype=str), cut


def _origin_of_rows(path: Path, text: Any, warnings: list[str]) -> str | None:
    """The least that a row says in the column named origin; None without it."""
    if "origin" not in text or not len(text):
        return None
    found = origins(path, zip(text.index, text["origin"], strict=True))
    if len(found) > 1:
        warnings.append(f"origins {', '.join(found)} in one table: all of it is taken as {found[0]}")
    return found[0]


def _times(path: Path, text: Any) -> Any:
    """Times of the rows, datetime64[ns], UTC, of the years 1700 to 2200."""
    import pandas as pd

    if "time_utc" in text:
        parsed = pd.to_datetime(text["time_utc"], utc=True, errors="coerce", format="ISO8601").dt.tz_localize(None)
        times = to_ns(parsed).astype("datetime64[ns]")
        told = ~np.isnat(times)
    else:
        epoch, first, last = (np.datetime64(moment, "s") for moment in (_EPOCH, *YEARS))
        elapsed = pd.to_numeric(text["elapsed_s"], errors="coerce").to_numpy(dtype=float)
        low, high = ((moment - epoch).astype(float) for moment in (first, last))
        told = (elapsed >= low) & (elapsed <= high)
        steps = np.round(np.where(told, elapsed, 0.0) * 1e9).astype("timedelta64[ns]")
        times = np.where(told, epoch.astype("datetime64[ns]") + steps, np.datetime64("NaT", "ns"))
    bad = np.flatnonzero(~told)
    if len(bad):
        raise InputError(
            path, f"line {text.index[bad[0]]}: the time cannot be read; ISO 8601 UTC or seconds are needed"
        )
    back = np.flatnonzero(np.diff(times) <= np.timedelta64(0, "ns"))
    if len(back):
        raise InputError(
            path, f"line {text.index[back[0] + 1]}: the time does not increase; rows must be in time order"
        )
    return times


def _phases(path: Path, cells: Any) -> Any:
    """A column of phases, None where a cell is empty."""
    words = cells.str.strip()
    words = words.mask(words == "", None)
    bad = np.flatnonzero(words.notna() & ~words.isin(PHASES))
    if len(bad):
        row = int(bad[0])
        raise InputError(path, f"line {cells.index[row]}: phase = {cells.iloc[row]!r}; allowed: {', '.join(PHASES)}")
    return words


def _numbers(path: Path, name: str, cells: Any) -> Any:
    """A column of numbers, NaN where a cell is empty or says NaN."""
    import pandas as pd

    stripped = cells.str.strip()
    empty = stripped.str.lower().isin(["", "nan"])
    values = pd.to_numeric(stripped.where(~empty, None), errors="coerce").to_numpy(dtype=float)
    bad = np.flatnonzero(~empty.to_numpy() & ~np.isfinite(values))
    if len(bad):
        row = int(bad[0])
        raise InputError(path, f"line {cells.index[row]}: {name} = {cells.iloc[row]!r}; a number is needed")
    return values
