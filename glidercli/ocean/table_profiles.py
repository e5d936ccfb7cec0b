"""Which profiles of water or current does a text file hold? One of a .cnv; of a table one for each time rows share."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from glidercli.errors import InputError
from glidercli.ocean import seawater
from glidercli.ocean.cast import EXPECTED, Cast, cast_of_table, read_ctd
from glidercli.ocean.cnv import is_cnv
from glidercli.ocean.current import EXPECTED_CURRENT, CurrentProfile, check_earth, current_of_table
from glidercli.ocean.series import parts
from glidercli.ocean.source import listed, read_text
from glidercli.ocean.table import Table, TooFewError, parse_table

__all__ = ["table_currents", "text_casts"]

P = TypeVar("P", Cast, CurrentProfile)


def text_casts(path: Path, latitude: float | None, longitude: float | None) -> tuple[Cast, ...]:
    """The casts of a text: of a .cnv one, of a table one for each time that several rows share; see ``read_ctd``."""
    text = read_text(path, EXPECTED)
    if is_cnv(text):
        return (read_ctd(path, latitude, longitude),)
    if latitude is not None:
        seawater.checked_latitude(latitude)
    return _of_parts(parse_table(path, text, EXPECTED), lambda part: cast_of_table(part, latitude, longitude))


def table_currents(path: Path) -> tuple[CurrentProfile, ...]:
    """The current profiles of a table, one for each time that several rows share; see ``read_adcp``."""
    table = parse_table(path, read_text(path, EXPECTED_CURRENT), EXPECTED_CURRENT)
    check_earth(table)
    return _of_parts(table, current_of_table)


def _of_parts(table: Table, profile: Callable[[Table], P]) -> tuple[P, ...]:
    """The profiles of a table; of several those of fewer than two usable rows are left out, and told on the first one.

    Raises InputError where none is left.
    """
    given = parts(table)
    found: list[P] = []
    few: list[tuple[str, int]] = []
    first: TooFewError | None = None
    for moment, part in given:
        try:
            found.append(dataclasses.replace(profile(part), moment=moment))
        except TooFewError as fault:
            first = first or fault
            when = "" if moment is None else f", {moment.text}"
            few.append((f"line {part.lines[0]}{when}", len(part)))
    if first is not None and len(given) == 1:
        raise first
    if first is not None and not found:
        raise InputError(table.path, f"none of its {len(given)} profiles has two usable rows; the first: {first.what}")
    if few:
        told = listed(tuple(where for where, _ in few), 5)
        line = f"{len(few)} of {len(given)} profiles left out, with fewer than two usable rows each: {told}"
        reason = ("in a profile of fewer than two usable rows", sum(rows for _, rows in few))
        found[0] = dataclasses.replace(
            found[0], dropped=(reason, *found[0].dropped), warnings=(line, *found[0].warnings)
        )
    return tuple(found)
