"""Which sensors are aboard: those of a file, of the mission, or none? And what has the flight to offer them?"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path

from pydantic import ConfigDict, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from glidercli.errors import InputError
from glidercli.files import read_toml
from glidercli.ocean.cast import Cast
from glidercli.ocean.ocean import Ocean
from glidercli.simulation.instruments.settings import MOST_SEED, Instruments
from glidercli.simulation.instruments.suite import Suite
from glidercli.simulation.mission import Mission
from glidercli.simulation.mission_file import fault

__all__ = ["Aboard", "instruments_of", "suite_of"]

_NONE = "none"
"""In place of a file: fly without the instruments of the mission."""


@dataclass(frozen=True, config=ConfigDict(extra="forbid"), kw_only=True)
class _File:
    """A file of instruments alone."""

    instruments: Instruments


@dataclasses.dataclass(frozen=True)
class Aboard:
    """The sensors of a flight, if any; the file that names them; files read for them; the mission's seed."""

    instruments: Instruments | None
    source: Path | None = None
    files: tuple[Path, ...] = ()
    seed: int = 0


def instruments_of(given: Instruments | str | Path | None, plan: tuple[Mission, Path] | None) -> Aboard:
    """The sensors that were given, as settings or as a file, or "none"; else those of the mission.

    Raises InputError with every fault of the file at once.
    """
    seed = plan[0].seed if plan else 0
    if given is None:
        return Aboard(plan[0].instruments, plan[1], seed=seed) if plan else Aboard(None)
    if isinstance(given, Instruments):
        return Aboard(given, seed=seed)
    if str(given) == _NONE:
        return Aboard(None, seed=seed)
    path = Path(given)
    found = read_toml(path, "a file of instruments")
    try:
        return Aboard(TypeAdapter(_File).validate_python(found).instruments, path, (path,), seed)
    except ValidationError as error:
        raise InputError.of_all(path, [fault(item, _File) for item in error.errors(include_url=False)]) from None


def suite_of(
    aboard: Aboard, seed: int | None, *, every: float, ocean: Ocean, place: tuple[float, float] | None,
    casts: Sequence[Cast],
) -> Suite | None:  # fmt: skip
    """The sensors at work, or None without any.

    seed : in place of the mission's. every : s, of the vehicle's own channels. place : latitude and longitude of the
    start, deg. casts : of the water; its place is that of the first of them.

    Raises InputError where the flight lacks what a sensor needs.
    """
    seed = aboard.seed if seed is None else seed
    if isinstance(seed, bool) or not isinstance(seed, int) or not 0 <= seed <= MOST_SEED:
        raise InputError("seed", f"{seed!r} is not allowed; a whole number from 0 to {MOST_SEED} is")
    if aboard.instruments is None:
        return None
    where = (casts[0].latitude, casts[0].longitude) if casts else (place or (None, None))
    try:
        return Suite(aboard.instruments, seed, every=every, ocean=ocean, place=place, water_place=where)
    except InputError as error:
        raise InputError(aboard.source, str(error)) if aboard.source else error from None
