"""How does a Log stand in a CSV table? The contract's column names; provenance beside it in FILE.csv-metadata.json."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TextIO

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import by_column
from glidercli.errors import InputError
from glidercli.files import metadata_path
from glidercli.log import Log
from glidercli.logio.own.cells import has_decimal_comma, numbers, phases, times_of_seconds, times_of_texts
from glidercli.logio.own.csv_metadata import origin_word, read_metadata
from glidercli.logio.own.csv_text import TIMES, CsvText, read_cells, separator_of
from glidercli.logio.own.rules import Shown
from glidercli.logio.own.table_back import OwnTable, part_of
from glidercli.logio.reader import Aids, Part
from glidercli.origins import BOTH, origins
from glidercli.provenance import file_hash

__all__ = ["CsvTable", "is_csv", "read_csv"]

Times = NDArray[np.int64]


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
        return separator_of(stream.readline(1 << 20)) is not None


def read_csv(path: Path, aids: Aids = Aids()) -> Part:
    """A log from a CSV table with time_utc (or elapsed_s) and columns in the contract's names.

    Where its values come from is told by the metadata beside it and by a column named origin, which must not
    contradict each other; without both they are taken as measured, and the log's metadata say so. Rows and cells that
    cannot be used are dropped, left out and counted by the rules of ``rules.py``. Raises InputError where the text is
    no table, an origin is not known, or the metadata beside it are of another table.
    """
    text = read_cells(path)
    cells = text.cells
    warnings = [text.remark] if text.remark else []
    columns = {}
    unknown = []
    for name in cells.columns:
        spec = by_column(name)
        if spec is None:
            unknown += [] if name in (*TIMES, "origin") else [name]
        else:
            told = phases(cells[name]) if spec.name == "phase" else numbers(cells[name], text.decimal)
            columns[spec.name] = told / spec.factor
    warnings += [f"columns not known and not used: {', '.join(unknown)}"] if unknown else []
    metadata = read_metadata(path)
    word = _origin_of_rows(path, cells, warnings)
    beside = metadata_path(path).name
    changed = ""
    if metadata:
        expected = origin_word(metadata["origin"], metadata["metadata"], set(metadata["channels"].values()))
        no_sample = (
            word == BOTH and expected == "measured"
        )  # of its derived channels, which the metadata then leave out
        if word not in (None, expected) and not no_sample:
            raise InputError(path, f"its rows say {word}, {beside} says {expected}; one belongs to another table")
        if metadata.get("table_sha256") not in (None, file_hash(path)):
            changed = beside
            warnings.append(f"has changed since {beside} was written; what that says of origins is kept")
    elif word == BOTH:
        warnings.append(f"{beside} is missing: which channels are derived is not known, all are taken as derived")
    table = OwnTable(
        path, _times(text), columns, "time_utc" in cells, word,
        tuple(name for name in unknown if cells[name].str.strip().any()), _shower(cells), text.cut,
    )  # fmt: skip
    return part_of(table, "glider-csv", metadata, warnings, changed=changed)


def _shower(cells: Any) -> Shown:
    """Shows a cell with its line, and says of a number with a decimal comma that it has one."""

    def shown(column: str, row: int) -> str:
        cell = str(cells[column].iloc[row])
        comma = " (a decimal comma; a point is needed)" if column not in TIMES and has_decimal_comma(cell) else ""
        return f"line {cells.index[row]}: {cell[:40]!r}{comma}"

    return shown


def _origin_of_rows(path: Path, text: Any, warnings: list[str]) -> str | None:
    """The least that a row says in the column named origin; None without it."""
    if "origin" not in text or not len(text):
        return None
    found = origins(path, zip(text.index, text["origin"], strict=True))
    if len(found) > 1:
        warnings.append(f"origins {', '.join(found)} in one table: all of it is taken as {found[0]}")
    return found[0]


def _times(text: CsvText) -> Times:
    """Times of the rows, UTC ns."""
    if "time_utc" in text.cells:
        return times_of_texts(text.cells["time_utc"])
    return times_of_seconds(numbers(text.cells["elapsed_s"], text.decimal))
