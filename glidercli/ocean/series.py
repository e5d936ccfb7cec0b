"""Which profiles does a table hold? One; or one for each time, where rows that follow one another share it."""

from __future__ import annotations

import datetime
import itertools
import math
from typing import NamedTuple

import numpy as np

from glidercli.errors import InputError
from glidercli.ocean.table import Table

__all__ = ["Moment", "no_start", "parts", "utc_seconds"]


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

    @property
    def text(self) -> str:
        """The time for a message."""
        if not self.is_utc:
            return f"{self.seconds:g} s"
        return datetime.datetime.fromtimestamp(self.seconds, datetime.UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def utc_seconds(text: str) -> float | None:
    """Seconds since 1970 of a time in ISO 8601, in UTC where it names no zone; None of other text."""
    try:
        told = datetime.datetime.fromisoformat(text)
    except ValueError:
        return None
    return (told if told.tzinfo else told.replace(tzinfo=datetime.UTC)).timestamp()


def no_start(source: object, what: str, first: Moment) -> InputError:
    """Profiles have times in UTC and the flight has no start: what is to be done. what : as "cast". first : a time."""
    return InputError(
        source,
        f"its {what}s have times in UTC, from {first.text} on, and the flight has no start time to place them by: "
        f"write start_time = {first.text} (or when it starts) into a mission file; or fly --controls or --initial of a "
        f"recorded log; or give one {what} alone, which holds throughout",
    )


def parts(table: Table) -> list[tuple[Moment | None, Table]]:
    """The profiles of a table with their times, in the table's order; one without a time where it holds one only.

    A time for every row is that of a sample within one profile. Raises InputError where a time cannot be read, does not
    come after the one before, or elapsed_s and time_utc contradict each other, naming the line.
    """
    columns = [name for name in ("elapsed_s", "time_utc") if name in table and any(table.cells[name])]
    if not columns:
        return [(None, table)]
    cells = list(zip(*(table.cells[name] for name in columns), strict=True))
    runs = [list(rows) for _, rows in itertools.groupby(range(len(table)), key=lambda row: cells[row])]
    firsts = [rows[0] for rows in runs]
    seconds = [[_seconds(table, name, row) for row in firsts] for name in columns]
    _check_clocks(table, firsts, columns, seconds)
    if len(runs) == 1 or max(map(len, runs)) == 1:
        return [(None, table)]
    times = seconds[0]
    for i in range(1, len(times)):
        if times[i] <= times[i - 1]:
            raise InputError(
                table.path, f"line {table.lines[firsts[i]]}: {columns[0]} = {cells[firsts[i]][0]} does not come after "
                "the time before; profiles in time must stand one after the other"
            )  # fmt: skip
    return [
        (Moment(at, columns[0] == "time_utc"), table.rows(np.isin(np.arange(len(table)), rows)))
        for at, rows in zip(times, runs, strict=True)
    ]


def _check_clocks(table: Table, rows: list[int], columns: list[str], seconds: list[list[float]]) -> None:
    """Refuse two columns of times that do not go alike, to a second. rows : those that the seconds are of."""
    if len(columns) < 2:
        return
    for i, (elapsed, utc) in enumerate(zip(*seconds, strict=True)):
        if abs((utc - seconds[1][0]) - (elapsed - seconds[0][0])) > 1.0:
            raise InputError(
                table.path, f"line {table.lines[rows[i]]}: elapsed_s and time_utc contradict each other; they must go "
                "alike, or one be left out"
            )  # fmt: skip


def _seconds(table: Table, column: str, row: int) -> float:
    """A cell as seconds: since the start, or since 1970."""
    cell = table.cells[column][row]
    seconds: float | None
    if column == "elapsed_s":
        try:
            seconds = float(cell)
        except ValueError:
            seconds = None
    else:
        seconds = utc_seconds(cell)
    if seconds is None or not math.isfinite(seconds):
        needed = "a number of seconds" if column == "elapsed_s" else "ISO 8601, as 2011-07-20T04:28:00Z,"
        raise InputError(table.path, f"line {table.lines[row]}: {column} = {cell or 'empty'}; {needed} is needed")
    return seconds
