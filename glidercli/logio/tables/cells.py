"""What do the cells of a table hold? Columns of text or numbers, whole at a time, from CSV or Parquet."""

from __future__ import annotations

import csv
import io
import itertools
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.files import is_utf16
from glidercli.logio.own.parquet_back import is_parquet, opened
from glidercli.logio.tables.mapping import File, Missing

__all__ = ["Cells", "numbers", "place_of", "read_cells", "words"]

Array = NDArray[np.float64]
LONGEST_LINE = 1 << 20
"""bytes of the line of column names."""


class Cells(NamedTuple):
    """columns : pyarrow arrays by name. cut : rows with another number of fields than the line of names.

    others : names of further columns; whether they hold data is not looked at.
    """

    columns: dict[str, Any]
    cut: int
    others: tuple[str, ...]


def read_cells(path: Path, names: Sequence[str], how: File) -> Cells:
    """The columns of these names. Raises InputError where one is not there, naming those that are."""
    import pyarrow as pa

    if is_parquet(path):
        with opened(path) as file:
            stored = {name.strip(): name for name in file.schema_arrow.names}
            there = [name.strip() for name in file.schema_arrow.names]
            _check_there(path, names, there, "")
            table = file.read(columns=[stored[name] for name in names])
            columns = {name: table.column(stored[name]).combine_chunks() for name in names}
            return Cells(columns, 0, _others(names, there))
    from pyarrow import csv as csv_of_arrow

    there = _head(path, how)
    _check_there(path, names, there, how.separator)
    cut = 0

    def skip(row: Any) -> str:
        nonlocal cut
        cut += 1
        return "skip"

    numbered = [str(number) for number in range(len(there))]
    places = {name: str(there.index(name)) for name in names}
    read = csv_of_arrow.ReadOptions(
        column_names=numbered, skip_rows=how.skip_lines + 1, encoding=how.encoding, block_size=1 << 24
    )
    parse = csv_of_arrow.ParseOptions(delimiter=how.separator, invalid_row_handler=skip)
    convert = csv_of_arrow.ConvertOptions(
        column_types=dict.fromkeys(numbered, pa.string()),
        include_columns=list(places.values()),
        strings_can_be_null=False,
    )
    try:
        table = csv_of_arrow.read_csv(path, read, parse, convert)
    except pa.ArrowInvalid as fault:
        if "Empty CSV file" in str(fault):
            return Cells({name: pa.array([], pa.string()) for name in names}, 0, ())
        raise InputError(path, f"is no table of text in {how.encoding}: {str(fault).splitlines()[0]}") from None
    except (pa.ArrowException, OSError, ValueError, LookupError) as fault:
        raise InputError(path, f"is no table of text in {how.encoding}: {str(fault).splitlines()[0]}") from None
    columns = {name: table.column(place).combine_chunks() for name, place in places.items()}
    return Cells(columns, cut, _others(names, there))


def _others(names: Sequence[str], there: Sequence[str]) -> tuple[str, ...]:
    return tuple(name for name in dict.fromkeys(there) if name and name not in names)


def _head(path: Path, how: File) -> list[str]:
    """The names of the columns."""
    try:
        with path.open(encoding=how.encoding) as stream:  # lines may end in CR alone, too
            for _ in range(how.skip_lines):
                stream.readline(LONGEST_LINE)
            text = stream.readline(LONGEST_LINE).lstrip("\ufeff").strip("\n")
    except (UnicodeError, LookupError):
        with path.open("rb") as raw:
            told = 'UTF-16, which [file] encoding = "utf-16" reads' if is_utf16(raw.read(4096)) else ""
        raise InputError(
            path,
            f"is no text in {how.encoding}; " + (f"it is in {told}" if told else "[file] encoding may name another"),
        ) from None
    try:
        names = [name.strip() for name in next(csv.reader(io.StringIO(text), delimiter=how.separator), [])]
    except csv.Error as fault:
        raise InputError(path, f"line {how.skip_lines + 1} cannot be parted into names of columns: {fault}") from None
    if not any(names):
        raise InputError(path, f"line {how.skip_lines + 1} holds no names of columns")
    return names


def _check_there(path: Path, names: Sequence[str], there: Sequence[str], separator: str) -> None:
    """Refuse a mapping that names what the table does not have, or has twice. separator : of the mapping, if any."""
    missing = [name for name in names if name not in there]
    whole = separator.join(there)
    for mark, told in ((",", ","), (";", ";"), ("\t", "\\t")):
        if missing and separator and mark != separator and set(names) <= {name.strip() for name in whole.split(mark)}:
            raise InputError(path, f'has its columns separated by {told}: [file] separator = "{told}" is needed')
    if missing:
        raise InputError(path, f"has no column {', '.join(missing)}; its columns are {', '.join(there)}")
    twice = [name for name in names if list(there).count(name) > 1]
    if twice:
        raise InputError(path, f"has the column {twice[0]} twice; each that is used may stand there once")


def place_of(path: Path, how: File, row: int) -> str:
    """Where a row stands, for a message: the line of a text, the row of Parquet. row : from 0, among whole rows."""
    if is_parquet(path):
        return f"row {row + 1}"
    width = len(_head(path, how))
    with path.open(encoding=how.encoding, errors="replace", newline="") as stream:
        for _ in range(how.skip_lines):
            stream.readline()
        reader = csv.reader(stream, delimiter=how.separator)
        whole = (reader.line_num for fields in reader if len(fields) == width)
        try:
            line = next(itertools.islice(whole, row + 1, None), None)  # the first is that of the names
        except csv.Error:  # a field that is longer than this reader takes
            line = None
    return f"row {row + 1}" if line is None else f"line {line + how.skip_lines}"


def words(column: Any, missing: Missing) -> Any:
    """A column as trimmed text, null where a cell is empty or holds no value."""
    import pyarrow as pa
    from pyarrow import compute as pc

    text = pc.utf8_trim_whitespace(column.cast(pa.string()))
    blank = pa.array(["", "nan", "NaN", "NAN", *missing.words], pa.string())
    return pc.if_else(pc.is_in(text, blank), pa.scalar(None, pa.string()), text)


def numbers(column: Any, missing: Missing, decimal: str) -> Array:
    """A column as numbers; NaN where a cell is empty or a word for it, infinite where it is no number."""
    import pandas as pd
    import pyarrow as pa
    from pyarrow import compute as pc

    if not pa.types.is_string(column.type) and not pa.types.is_large_string(column.type):
        try:
            return np.array(column.cast(pa.float64()).to_numpy(zero_copy_only=False), dtype=float)
        except pa.ArrowException:
            pass
    text = words(column, missing)
    text = pc.replace_substring(text, ",", ".") if decimal == "," else text
    try:
        return np.array(text.cast(pa.float64()).to_numpy(zero_copy_only=False), dtype=float)
    except pa.ArrowInvalid:  # a cell is no number
        cells = pd.Series(text.to_numpy(zero_copy_only=False), dtype=object)
        values = pd.to_numeric(cells, errors="coerce").to_numpy(dtype=float, copy=True)
        values[cells.notna().to_numpy() & np.isnan(values)] = np.inf
        return values
