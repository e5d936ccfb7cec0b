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
from glidercli.ocean.table import Table, UnusableError, parse_table

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
    """The profiles of a table; of several those that nothing can be made of are left out, and told on the first one.

    Raises InputError where none is left.
    """
    given = parts(table)
    found: list[P] = []
    lost: list[tuple[UnusableError, str, int]] = []
    for moment, part in given:
        try:
            found.append(dataclasses.replace(profile(part), moment=moment))
        except UnusableError as fault:
            if len(given) == 1:
                raise
            when = "" if moment is None else f", {moment.text}"
            lost.append((fault, f"line {part.lines[0]}{when}", len(part)))
    if not found:
        raise InputError(table.path, f"none of its {len(given)} profiles can be used; the first: {lost[0][0].what}")
    for what in dict.fromkeys(fault.fault for fault, _, _ in reversed(lost)):
        same = [(where, rows) for fault, where, rows in lost if fault.fault == what]
        told = listed(tuple(where for where, _ in same), 5)
        line = f"{len(same)} of {len(given)} profiles left out, {what}: {told}"
        reason = (f"in a profile {what}", sum(rows for _, rows in same))
        found[0] = dataclasses.replace(
            found[0], dropped=(reason, *found[0].dropped), warnings=(line, *found[0].warnings)
        )
    return tuple(found)
