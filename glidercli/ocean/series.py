"""Which profiles does a table hold? One; or one for each time, where rows that follow one another share it."""

from __future__ import annotations

import datetime
import itertools
from typing import NamedTuple

import numpy as np

from glidercli.errors import InputError
from glidercli.ocean.table import Table

__all__ = ["Moment", "parts"]


class Moment(NamedTuple):
    """When a profile holds: seconds since the start of the flight, or a time in UTC."""

    seconds: float
    """s since the start; of a time in UTC, since 1970."""
    is_utc: bool

    def since(self, start_ns: int | None) -> float | None:
        """s since the start of a flight, ns UTC; None where that start is not known and the time is in UTC."""
        if not self.is_utc:
            return self.seconds
        return None if start_ns is None else self.seconds - start_ns / 1e9


def parts(table: Table) -> list[tuple[Moment | None, Table]]:
    """The profiles of a table with their times, in the table's order; one without a time where it holds one only.

    A time for every row is that of a sample within one profile. Raises InputError where a time cannot be read or does
    not come after the one before, naming the line.
    """
    column = next((name for name in ("elapsed_s", "time_utc") if name in table), None)
    if column is None:
        return [(None, table)]
    cells = table.cells[column]
    runs = [list(rows) for _, rows in itertools.groupby(range(len(table)), key=lambda row: cells[row])]
    if len(runs) == 1 or max(map(len, runs)) == 1:
        return [(None, table)]
    found: list[tuple[Moment | None, Table]] = []
    before = None
    for rows in runs:
        line, cell = table.lines[rows[0]], cells[rows[0]]
        moment = Moment(_seconds(table, column, line, cell), column == "time_utc")
        if before is not None and moment.seconds <= before.seconds:
            raise InputError(
                table.path, f"line {line}: {column} = {cell} does not come after the time before; profiles in time "
                "must stand one after the other"
            )  # fmt: skip
        found.append((moment, table.rows(np.isin(np.arange(len(table)), rows))))
        before = moment
    return found


def _seconds(table: Table, column: str, line: int, cell: str) -> float:
    """A cell as seconds: since the start, or since 1970."""
    try:
        if column == "elapsed_s":
            return float(cell)
        told = datetime.datetime.fromisoformat(cell)
    except ValueError:
        needed = "a number of seconds" if column == "elapsed_s" else "ISO 8601, as 2011-07-20T04:28:00Z,"
        raise InputError(table.path, f"line {line}: {column} = {cell or 'empty'}; {needed} is needed") from None
    return (told if told.tzinfo else told.replace(tzinfo=datetime.UTC)).timestamp()
