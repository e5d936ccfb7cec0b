"""What numbers stand in a plain table? CSV text read strictly: every fault is named with its line and column."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from glidercli.channels import by_column
from glidercli.errors import InputError
from glidercli.ocean.source import listed
from glidercli.origins import column_name, origins

__all__ = ["Table", "TooFewError", "UnusableError", "ZigzagError", "parse_table"]

Array = NDArray[np.float64]

_ASIDE = ("time_utc", "elapsed_s", "origin")  # columns of any table that hold no channel


class UnusableError(InputError):
    """Nothing can be made of a profile, which says nothing of others in the file.

    what : the message without the file's name. fault : what is the matter, said of a profile.
    """

    fault = ""

    def __init__(self, where: object, what: str) -> None:
        super().__init__(where, what)
        self.what = what


class TooFewError(UnusableError):
    """Fewer than two rows of a profile can be used."""

    fault = "with fewer than two usable rows"


class ZigzagError(UnusableError):
    """A profile does not grow deeper from row to row."""

    fault = "whose depth does not grow from row to row"


@dataclass(frozen=True)
class Table:
    """A table as text, cell by cell.

    lines : line of the file on which each row stands, from 1.
    cells : the rows' text by column, without the blanks around it.
    """

    path: Path
    lines: tuple[int, ...]
    cells: Mapping[str, tuple[str, ...]]

    def __len__(self) -> int:
        return len(self.lines)

    def __contains__(self, column: object) -> bool:
        return column in self.cells

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns, in the file's order."""
        return tuple(self.cells)

    @property
    def reconstructed(self) -> bool:
        """Whether a column named origin says of any row that it is a reconstruction; InputError for a word unknown."""
        said = zip(self.lines, self.cells["origin"], strict=True) if "origin" in self else ()
        return "reconstruction" in origins(self.path, said)

    def numbers(self, column: str, low: float, high: float) -> Array:
        """A column, (n,), whose every cell must be a number from low to high; else InputError."""
        values = self.measured(column)
        for line, cell, number in zip(self.lines, self.cells[column], values, strict=True):
            if not low <= number <= high:
                raise InputError(self.path, f"line {line}: {column} = {cell or 'empty'}, allowed {low:g} to {high:g}")
        return values

    def measured(self, column: str) -> Array:
        """A column, (n,), in which an empty cell or "NaN" is a gap, given as NaN; InputError for other text."""
        return np.array([self._number(column, *item) for item in zip(self.lines, self.cells[column], strict=True)])

    def _number(self, column: str, line: int, cell: str) -> float:
        try:
            return float(cell) if cell else math.nan
        except ValueError:
            what = f"line {line}: {column} = {cell!r}, a number with a decimal point is needed"
            raise InputError(self.path, what) from None

    def lacking(self, column: str) -> NDArray[np.bool_]:
        """Where a column's cells are empty or "NaN", (n,); InputError for other text that is no number."""
        return np.isnan(self.measured(column))

    def rows(self, kept: ArrayLike) -> Table:
        """The table of some of its rows. kept : (n,), whether to keep each."""
        chosen = np.flatnonzero(kept)
        cells = {name: tuple(column[i] for i in chosen) for name, column in self.cells.items()}
        return Table(self.path, tuple(self.lines[i] for i in chosen), cells)

    def increasing(self, column: str, low: float, high: float) -> Array:
        """A column, (n,), of numbers from low to high that grow from row to row; else InputError, or ZigzagError."""
        values = self.numbers(column, low, high)
        for i in np.flatnonzero(np.diff(values) <= 0.0):
            fault = "repeats" if values[i + 1] == values[i] else "comes after"
            raise ZigzagError(
                self.path,
                f"line {self.lines[i + 1]}: {column} = {values[i + 1]:g} {fault} {values[i]:g}; "
                "a profile must grow deeper from row to row",
            )
        return values

    def unknown(self, used: tuple[str, ...]) -> tuple[str, ...]:
        """Columns that are neither used nor any channel's name, most likely misspelt."""
        return tuple(n for n in self.columns if n not in (*used, *_ASIDE) and by_column(n) is None)


def parse_table(path: Path, text: str, expected: str) -> Table:
    """A table from text, not blank: a line of column names, then rows, separated by commas, semicolons or tabs.

    The separator is the one that the first line holds. Empty lines are skipped.

    expected : what the file should be, for the message when it is no table: "a CTD cast is ...".

    Raises
    ------
    InputError
        No separator or several in the first line, a repeated or nameless column, no rows, or a row of another length.
    """
    heading = text.lstrip().partition("\n")[0]
    separators = [mark for mark in ",;\t" if mark in heading]
    if not separators:
        raise InputError(path, f"line 1: holds no column names separated by comma, semicolon or tab; {expected}")
    if len(separators) > 1:
        raise InputError(
            path, "line 1: column names are separated in more than one way; allowed: comma, semicolon or tab"
        )
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separators[0])
    try:
        rows = [(reader.line_num, [cell.strip() for cell in row]) for row in reader if row and row != [""]]
    except csv.Error as error:
        raise InputError(path, f"line {reader.line_num}: is not a table: {error}") from None
    if len(rows) < 2:
        raise InputError(path, "has no rows below its column names")
    (line, heads), *rows = rows
    names = [column_name(" ".join(head.split())) for head in heads]  # a quoted name may hold a line break
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated or "" in names:
        fault = f"column {repeated[0]} stands twice" if repeated and repeated[0] else "a column has no name"
        raise InputError(path, f"line {line}: {fault}; its columns are {listed(tuple(names))}")
    for line, row in rows:
        if len(row) != len(names):
            raise InputError(path, f"line {line}: has {len(row)} cells for {len(names)} columns")
    cells = {name: tuple(row[i] for _, row in rows) for i, name in enumerate(names)}
    return Table(path, tuple(line for line, _ in rows), cells)
