"""Which profiles do several files and logs make? All of them in the order of their times."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.ocean.cast import Cast
from glidercli.ocean.current import CurrentProfile
from glidercli.ocean.series import Moment, no_start, utc_seconds
from glidercli.ocean.water_file import read_casts, read_currents

if TYPE_CHECKING:
    import os

__all__ = ["Source", "gathered_casts", "gathered_currents", "sources"]

P = TypeVar("P", Cast, CurrentProfile)

Source = Path | Log
"""Where profiles come from: a file, or a log that was read."""


def sources(given: str | os.PathLike[str] | Log | Sequence[str | os.PathLike[str] | Log] | None) -> tuple[Source, ...]:
    """One source or several as a tuple; none of None."""
    if given is None:
        return ()
    several = (given,) if isinstance(given, (str, Path, Log)) or not isinstance(given, Sequence) else given
    return tuple(item if isinstance(item, Log) else Path(item) for item in several)


def gathered_casts(
    given: Sequence[Source],
    latitude: float | None = None,
    longitude: float | None = None,
    start_ns: int | None = None,
) -> tuple[Cast, ...]:
    """The casts of all sources, in time order.

    latitude, longitude : deg, for casts without their own. start_ns : UTC since 1970, of the flight.

    A single cast always holds. Of logs, and nothing else, in a flight without a start time the first descent or ascent
    that reaches nine tenths of the greatest depth holds throughout, with a warning.

    Raises InputError where a source cannot be used, one of several casts has no time, or two have the same.
    """

    def read(source: Source) -> tuple[Cast, ...]:
        if isinstance(source, Log):
            from glidercli.ocean.from_log import casts_of_log

            return casts_of_log(source, latitude, longitude)
        return read_casts(source, latitude, longitude)

    def own_time(cast: Cast) -> Moment | None:
        if cast.moment is not None or cast.time_utc is None:
            return cast.moment
        seconds = utc_seconds(cast.time_utc)
        return None if seconds is None else Moment(seconds, True)

    found = [cast for source in given for cast in read(source)]
    return _in_order(found, own_time, given, start_ns, "cast")


def gathered_currents(
    given: Sequence[Source], latitude: float | None = None, start_ns: int | None = None
) -> tuple[CurrentProfile, ...]:
    """The current profiles of all sources, in time order; as ``gathered_casts``."""

    def read(source: Source) -> tuple[CurrentProfile, ...]:
        if isinstance(source, Log):
            from glidercli.ocean.from_log import currents_of_log

            return currents_of_log(source)
        return read_currents(source, latitude)

    found = [profile for source in given for profile in read(source)]
    return _in_order(found, lambda profile: profile.moment or profile.own_moment, given, start_ns, "current profile")


def _in_order(
    found: list[P], own_time: Callable[[P], Moment | None], given: Sequence[Source], start_ns: int | None, what: str
) -> tuple[P, ...]:
    """Profiles by time; a single one without a time."""
    if len(found) < 2:
        return tuple(dataclasses.replace(profile, moment=None) for profile in found)
    moments = [own_time(profile) for profile in found]
    for profile, moment in zip(found, moments, strict=True):
        if moment is None:
            raise InputError(
                profile.source,
                f"has no time, and {len(found)} {what}s are given; needed is one file, or times: start_time in a .cnv, "
                "time_utc or elapsed_s in a table, time in NetCDF",
            )
    timed = [moment for moment in moments if moment is not None]
    undated = start_ns is None and any(moment.is_utc for moment in timed)
    if undated and all(isinstance(source, Log) for source in given):
        deep = 0.9 * max(profile.depth[-1] for profile in found)
        first = min((i for i in range(len(found)) if found[i].depth[-1] >= deep), key=lambda i: timed[i].seconds)
        word = (
            f"the flight has no start time: of its {len(found)} descents and ascents the first that goes near the "
            f"greatest depth, of {timed[first].text}, holds throughout; start_time in a mission, or --controls or "
            "--initial with this log, places them all"
        )
        warnings = (word, *found[0].warnings)
        return (dataclasses.replace(found[first], moment=None, warnings=warnings),)
    if undated:
        dated = min((i for i, moment in enumerate(timed) if moment.is_utc), key=lambda i: timed[i].seconds)
        raise no_start(found[dated].source, what, timed[dated])
    order = sorted(range(len(found)), key=lambda i: timed[i].since(start_ns) or 0.0)
    for one, other in itertools.pairwise(order):
        if timed[one].since(start_ns) == timed[other].since(start_ns):
            raise InputError(
                found[other].source,
                f"its {_numbered(found, other, what)} has the same time as {_numbered(found, one, what)} of "
                f"{found[one].source}, {timed[other].text}; {what}s in time must have times that differ",
            )
    return tuple(dataclasses.replace(found[i], moment=timed[i]) for i in order)


def _numbered(found: Sequence[P], place: int, what: str) -> str:
    """Which of the profiles of its source it is, and from which depth to which."""
    profile = found[place]
    number = sum(other.source == profile.source for other in found[: place + 1])
    return f"{what} {number} ({profile.depth[0]:.1f} to {profile.depth[-1]:.1f} m)"
