"""Which cells does a CSV table in the contract's names hold? Text, between commas, semicolons or tabs."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any, NamedTuple

from glidercli.channels import by_column
from glidercli.errors import InputError
from glidercli.logio.own.cells import has_decimal_comma
from glidercli.origins import WORDS, column_name

__all__ = ["TIMES", "CsvText", "read_cells", "separator_of"]

TIMES = ("time_utc", "elapsed_s")
_SEPARATORS = {",": ",", ";": ";", "\t": "tab"}
"""As they stand, and as a message has them."""


class CsvText(NamedTuple):
    """cells : pandas table of text, with the line of the file as index. cut : rows with too few or too many fields.

    decimal : the decimal mark. remark : how the table differs from the ones that this program writes, or "".
    """

    cells: Any
    cut: int
    decimal: str
    remark: str


def separator_of(first: bytes) -> str | None:
    """What separates the names of the first line, if columns of the contract are among them, a time too; else None."""
    try:
        line = first.decode("utf-8-sig").replace("\r", "\n").split("\n", 1)[0]
    except UnicodeDecodeError:
        return None
    for mark in _SEPARATORS:
        names = [name.strip().strip('"').strip() for name in line.split(mark)]
        if set(TIMES) & set(names) and any(by_column(name) for name in names):
            return mark
    return None


def read_cells(path: Path) -> CsvText:
    """The cells of a table. Raises InputError where it is no CSV, has a column twice, or none of times."""
    import pandas as pd

    with path.open("rb") as head:
        mark = separator_of(head.readline(1 << 20)) or ","
    try:
        with path.open(encoding="utf-8-sig", newline="") as stream:
            reader = csv.reader(stream, strict=True, delimiter=mark)
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
    if not set(TIMES) & set(names):
        raise InputError(path, "line 1: no column of times; time_utc or elapsed_s is needed")
    if rows and "origin" in names and _is_cut(path, rows[-1][names.index("origin")]):
        rows, lines, cut = rows[:-1], lines[:-1], cut + 1
    cells = pd.DataFrame(rows, columns=names, index=lines, dtype=str)
    if mark == ",":
        return CsvText(cells, cut, ".", "")
    decimal = _decimal(cells)
    written = f"separated by {_SEPARATORS[mark]}" + (", numbers with a decimal comma" if decimal == "," else "")
    return CsvText(cells, cut, decimal, f"{written}: read so; this program writes commas and decimal points")


def _is_cut(path: Path, origin: str) -> bool:
    """Whether the text ends within the last cell of its last row, the word of its origin."""
    word = origin.strip().lower()
    if word in WORDS or not any(known.startswith(word) for known in WORDS):
        return False
    with path.open("rb") as stream:
        stream.seek(-1, 2)
        return stream.read(1) not in b"\r\n"


def _decimal(cells: Any) -> str:
    """The decimal mark of a table that is not separated by commas; a table that has both is read with points."""
    told = [name for name in cells.columns if name == "elapsed_s" or (by_column(name) and name != "phase")]
    texts = [text for name in told for text in cells[name]]
    commas = any(map(has_decimal_comma, texts))
    return "," if commas and not any("." in text for text in texts) else "."
