"""How do the variables of a trajectory file become a Part? Every row kept or dropped by a named rule, fixes apart."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel, Event, Log
from glidercli.logio.netcdf.fixes import fixes
from glidercli.logio.netcdf.variables import BAD_PLACE, COMPUTED, Values, attributes, fault_of, values_of
from glidercli.logio.plausible import quantity_of
from glidercli.logio.quantities import channel_of, submerged
from glidercli.logio.reader import Part
from glidercli.logio.records import sampled, usable
from glidercli.logio.report import FileReport
from glidercli.logio.whereabouts import Whereabouts, whereabouts

__all__ = ["Positions", "Rows", "faults_in", "found_in", "near_of", "part_of", "unread_in"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

NO_MEASUREMENT = ("depth", "phase")
"""Channels that publishers fill in at rows where only a position was recorded."""

TOLD_OF = (
    "TIME", "LATITUDE", "LONGITUDE", "TIME_GPS", "LATITUDE_GPS", "LONGITUDE_GPS", "PHASE",
    "time", "lat", "lon", "latitude", "longitude",
)  # fmt: skip
"""Variables that the readers of files read themselves, or say what becomes of them."""


@dataclasses.dataclass(frozen=True)
class Positions:
    """What may be GPS fixes: a time, deg north and deg east for each row, missing where there is none."""

    names: str
    time_ns: Times
    latitude: Array
    longitude: Array


@dataclasses.dataclass(frozen=True)
class Rows:
    """The rows of a file: their times, values by channel, positions, and what else is told of them.

    near : positions that need be no fixes. faults : variables that cannot be read, and why.
    """

    time_ns: Times
    found: Mapping[str, Values]
    positions: Positions | None
    metadata: Mapping[str, str]
    warnings: list[str]
    events: tuple[Event, ...] = ()
    near: Whereabouts | None = None
    unread: tuple[str, ...] = ()
    faults: tuple[str, ...] = ()


def found_in(
    file: Any,
    dimension: str,
    names: Mapping[str, Sequence[str]],
    standard: Mapping[str, str],
    warnings: list[str],
    besides: Collection[str] = (),
) -> dict[str, Values]:
    """The channels of a file's variables along a dimension, by name, else by standard name.

    names : variable names by channel, the first that is there is taken. standard : channel by standard name.
    besides : variables that the reader reads itself.
    """
    along, chosen = _along(file, dimension), _chosen(file, dimension, names, standard)
    found = {}
    for channel, variable in chosen.items():
        values = None if variable is None else values_of(file, variable, channel, warnings)
        if values is not None:
            found[channel] = values
    known = {*chosen.values(), *TOLD_OF, *besides}
    other = [name for name in along if name not in known and not _is_flag(name)]
    if other:
        warnings.append(f"variables not known and not used: {', '.join(other)}")
    return found


def faults_in(
    file: Any, dimension: str, names: Mapping[str, Sequence[str]], standard: Mapping[str, str]
) -> tuple[str, ...]:
    """Which variables ``found_in`` leaves out for their unit or packing, each with what is wrong and what is needed."""
    chosen = _chosen(file, dimension, names, standard)
    told = {c: (name, fault_of(attributes(file[name]), c)) for c, name in chosen.items() if name is not None}
    return tuple(f"{name}: {fault}" for name, fault in told.values() if fault)


def _chosen(
    file: Any, dimension: str, names: Mapping[str, Sequence[str]], standard: Mapping[str, str]
) -> dict[str, str | None]:
    """The variable along a dimension that each channel is taken from, by name, else by standard name."""
    along = _along(file, dimension)
    chosen = {channel: next((n for n in known if n in along), None) for channel, known in names.items()}
    for name, told in along.items():
        channel = standard.get(str(told.get("standard_name", "")))
        if channel is not None and chosen.get(channel) is None and name not in chosen.values():
            chosen[channel] = name
    return chosen


def unread_in(file: Any, dimension: str, found: Mapping[str, Values]) -> tuple[str, ...]:
    """The variables along a dimension that hold a number and that no channel is taken from."""
    used = {*TOLD_OF, *(values.name for values in found.values())}
    left = {name: told for name, told in _along(file, dimension).items() if name not in used and not _is_flag(name)}
    return tuple(name for name, told in left.items() if _holds_number(file[name][...], told))


def _along(file: Any, dimension: str) -> dict[str, dict[str, Any]]:
    """The attributes of the variables of numbers along a dimension, by name."""
    return {
        name: attributes(v)
        for name, v in file.variables.items()
        if v.dimensions == (dimension,) and v.dtype != str and v.dtype.kind in "iuf"
    }


def _is_flag(name: str) -> bool:
    return name.lower().endswith(("_qc", "_flag"))


def _holds_number(stored: NDArray[Any], told: Mapping[str, Any]) -> bool:
    missing = np.isnan(stored)
    for key in ("_FillValue", "missing_value"):
        missing |= np.isin(stored, np.atleast_1d(told.get(key, np.nan)))
    return not missing.all()


def near_of(file: Any, time_ns: Times, names: tuple[str, str]) -> Whereabouts | None:
    """Positions of two variables, latitude and longitude, that need be no fixes; None where they cannot be read.

    time_ns : (n,), of their rows.
    """
    if not set(names) <= file.variables.keys() or any(file[name].size != len(time_ns) for name in names):
        return None
    pair = zip(names, ("latitude", "longitude"), strict=True)
    latitude, longitude = (values_of(file, name, channel, [], BAD_PLACE) for name, channel in pair)
    if latitude is None or longitude is None:
        return None
    return whereabouts(time_ns, latitude.values, longitude.values)


def part_of(path: Path, format: str, rows: Rows, holds: tuple[str, ...] = ()) -> Part:
    """The Log of the rows, and the account. A row of a position alone is judged apart from rows of measurements."""
    warnings = list(rows.warnings)
    measured = [v.values for channel, v in rows.found.items() if channel not in NO_MEASUREMENT]
    measured = measured or [v.values for v in rows.found.values()]
    blank = np.all([np.isnan(v) for v in measured], axis=0) if measured else np.ones(len(rows.time_ns), dtype=bool)
    placed = np.zeros(len(rows.time_ns), dtype=bool)
    if rows.positions is not None:
        placed = np.isfinite(rows.positions.latitude) & np.isfinite(rows.positions.longitude)
    alone = blank & placed
    filled = sum(int(np.isfinite(v.values[alone]).sum()) for v in rows.found.values())
    if filled:
        warnings.append(f"{filled} values left out at {int(alone.sum())} rows that hold a position alone")
    dropped: Counter[str] = Counter()
    kept = np.zeros(len(rows.time_ns), dtype=bool)
    good = np.flatnonzero(~alone)
    good = good[usable(rows.time_ns[good], {c: v.values[good] for c, v in rows.found.items()}, dropped)]
    channels = {}
    for channel, v in rows.found.items():
        made = channel_of(v.name, rows.time_ns[good], v.values[good], quantity_of(channel), warnings, v.origin)
        if len(made):
            channels[channel] = made
    if {"conductivity", "pressure"} <= channels.keys():
        channels["conductivity"] = submerged(channels["conductivity"], channels["pressure"], warnings)
    if "conductivity" in rows.found:
        channels |= {name: _based(channels[name], channels, warnings) for name in COMPUTED if name in channels}
    kept[good] = sampled(rows.time_ns[good], channels)
    if unused := int((~kept[good]).sum()):
        dropped["no usable value"] += unused
    record_ns = rows.time_ns.copy()
    if rows.positions is not None:
        at = _add_fixes(rows.positions, placed & (kept | alone), channels, warnings)
        if missed := int(alone.sum() - alone[at].sum()):
            dropped["position that is no new fix at the surface"] += missed
        record_ns[at] = np.where(alone[at], rows.positions.time_ns[at], record_ns[at])
        kept[at] = True
    log = Log({n: c for n, c in channels.items() if len(c)}, "measured", dict(rows.metadata), rows.events)
    reasons = tuple(sorted((reason, count) for reason, count in dropped.items() if count))
    error = f"no usable record: {'; '.join(rows.faults)}" if rows.faults and not kept.any() else None
    report = FileReport(path, format, len(rows.time_ns), int(kept.sum()), reasons, tuple(warnings), error)
    near, unread = rows.near, rows.unread
    return Part(log, report, np.sort(record_ns[kept]), holds=holds, fullness=int(kept.sum()), near=near, unread=unread)


def _based(computed: Channel, channels: Mapping[str, Channel], warnings: list[str]) -> Channel:
    """The values that were computed from a conductivity that is used."""
    base = channels["conductivity"].time_ns if "conductivity" in channels else computed.time_ns[:0]
    sound = np.isin(computed.time_ns, base)
    if loose := int((~sound).sum()):
        warnings.append(f"{computed.name}: {loose} values left out, their conductivity is left out or missing")
    return Channel(computed.name, computed.time_ns[sound], computed.values[sound], computed.origin)


def _add_fixes(
    positions: Positions, among: NDArray[np.bool_], channels: dict[str, Channel], warnings: list[str]
) -> NDArray[np.int64]:
    """Add latitude and longitude to the channels; the rows that they are of."""
    times = [c.time_ns for c in channels.values() if len(c)]
    span = (min(int(t[0]) for t in times), max(int(t[-1]) for t in times)) if times else None
    rows = np.flatnonzero(among)
    time_ns, latitude, longitude = positions.time_ns[rows], positions.latitude[rows], positions.longitude[rows]
    at = fixes(time_ns, latitude, longitude, channels.get("depth"), span)
    if others := len(rows) - len(at):
        warnings.append(
            f"{positions.names}: {others} positions left out that are no new fix at the surface, {len(at)} kept"
        )
    channels["latitude"] = Channel("latitude", time_ns[at], latitude[at])
    channels["longitude"] = Channel("longitude", time_ns[at], longitude[at])
    return rows[at]
