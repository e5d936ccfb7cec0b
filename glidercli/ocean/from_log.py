"""What water and what current did a glider measure? Of a Log a profile for each descent and each ascent.

The log is parted where its depth turns by 5 m (bins.py). The samples of a descent or ascent, in order of depth, become
medians in bins of 1 m: computed, so "derived". The profile holds at the mean time of its bins. Nothing is interpolated
but the depth of a sample that was not taken together with one of depth or pressure.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.ocean.bins import BIN, by_bins, depth_at, turns
from glidercli.ocean.cast import Cast
from glidercli.ocean.counting import counted
from glidercli.ocean.current import GREATEST_SPEED, CurrentProfile
from glidercli.ocean.measured import Measured, cast_of, usable
from glidercli.ocean.place import Place, middle_of
from glidercli.ocean.seawater import checked_latitude, depth_from_pressure
from glidercli.ocean.series import Moment
from glidercli.ocean.source import left_out
from glidercli.ocean.together import gaps_of, overturns_of
from glidercli.units import DBAR

__all__ = ["casts_of_log", "currents_of_log", "source_of"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
Dropped = tuple[tuple[str, int], ...]

_FEW = "in a descent or ascent of a single bin"
_MERGED = f"merged into the medians of bins of {BIN:g} m"


class _Axis(NamedTuple):
    """Depth in time: (n,) ns and m; and what it comes from."""

    time_ns: Times
    depth: Array
    origin: str


class _Part(NamedTuple):
    """One descent or ascent. samples : indices. depth : (m,). columns : (k, m), medians. time_ns : when it holds."""

    samples: NDArray[np.intp]
    depth: Array
    columns: Array
    time_ns: float


def source_of(log: Log) -> Path:
    """What a log is called in messages: the file or folder that it came from, if that is known."""
    return Path(log.metadata.get("source", "log"))


def casts_of_log(log: Log, latitude: float | None = None, longitude: float | None = None) -> tuple[Cast, ...]:
    """The water of a log, a cast for each descent and ascent, in time order.

    Used are temperature with salinity (or conductivity), or density where there is no salinity. latitude, longitude :
    deg, for a log that has none of its own.

    Raises
    ------
    InputError
        The log has no such channels or neither depth nor pressure, or no descent or ascent gives two bins.
    """
    source = source_of(log)
    if latitude is not None:
        checked_latitude(latitude)
    names = ("temperature", "salinity", "absolute_salinity", "conductivity", "density")
    have = {name: log[name] for name in names if len(log.channels.get(name, ()))}
    times = _union([have[name].time_ns for name in have])
    columns = {name: _on(times, channel.time_ns, channel.values) for name, channel in have.items()}
    place = Place(_middle(log, "latitude", None), _middle(log, "longitude", None), latitude, longitude)
    axis = _axis(log, times, place.used)
    depth = None if axis is None else depth_at(times, axis.time_ns, axis.depth)
    water = Measured(depth=depth, pressure_dbar=None, **columns).checked(source, ", ".join(log.channels))
    assert axis is not None
    assert water.depth is not None
    kept, dropped = usable(water)
    kinds = [name for name, values in zip(Measured._fields, water, strict=True) if values is not None]
    matrix = np.array([values for values in water if values is not None])[1:]  # depth comes first
    parts, few = _parts(axis, times, water.depth, matrix, kept)
    dropped += ((_FEW, few),) if few else ()
    casts = []
    for part in parts:
        window = (int(times[part.samples].min()), int(times[part.samples].max()))
        here = Place(_middle(log, "latitude", window), _middle(log, "longitude", window), latitude, longitude)
        medians = Measured(part.depth, None, **dict(zip(kinds[1:], part.columns, strict=True)))
        casts.append(
            cast_of(
                medians,
                here,
                source,
                moment=_moment(log, part.time_ns),
                dropped=_merged(part),
                reconstructed=log.origin == "reconstruction" or "reconstruction" in log.metadata,
            )
        )
    if not casts:
        raise InputError(source, _none_of(len(times), dropped))
    by_place = water.temperature is not None and water.absolute_salinity is None
    told = left_out(dropped, len(times), "samples") + _told(axis, casts, int(kept.sum()) - few)
    told += place.warnings("pressure" if axis.origin == "depth" else "depth", by_place) + overturns_of(
        [cast.density for cast in casts]
    )
    first = dataclasses.replace(casts[0], dropped=dropped + casts[0].dropped, warnings=told)
    return (first, *casts[1:])


def currents_of_log(log: Log) -> tuple[CurrentProfile, ...]:
    """The current of a log, a profile for each descent and ascent, in time order.

    Used are current_east and current_north, and current_up where every such sample has it, else zero.

    Raises
    ------
    InputError
        The log lacks one of them, or depth and pressure, or no descent or ascent gives two bins.
    """
    source = source_of(log)
    names = ["current_east", "current_north", "current_up"]
    missing = [name for name in names[:2] if not len(log.channels.get(name, ()))]
    if missing:
        raise InputError(
            source, f"has no {' and no '.join(missing)}; needed are both, by depth; it has {', '.join(log.channels)}"
        )
    have = [log[name] for name in names if len(log.channels.get(name, ()))]
    times = _union([channel.time_ns for channel in have[:2]])
    velocity = np.array([_on(times, channel.time_ns, channel.values) for channel in have])
    both = np.isfinite(velocity[:2]).all(axis=0)
    with_up = len(have) > 2 and bool(np.isfinite(velocity[2, both]).all())
    velocity = velocity if with_up else velocity[:2]
    axis = _axis(log, times, _middle(log, "latitude", None) or 0.0)
    if axis is None:
        raise InputError(source, f"has neither depth nor pressure; it has {', '.join(log.channels)}")
    depth = depth_at(times, axis.time_ns, axis.depth)
    kept = np.ones(len(times), dtype=bool)
    dropped = counted(
        [
            ("without east or north", ~both),
            ("without depth", ~np.isfinite(depth)),
            (f"faster than {GREATEST_SPEED:g} m/s", np.linalg.norm(velocity, axis=0) > GREATEST_SPEED),
        ],
        kept,
    )
    parts, few = _parts(axis, times, depth, velocity, kept)
    dropped += ((_FEW, few),) if few else ()
    if not parts:
        raise InputError(source, _none_of(len(times), dropped))
    remade = log.origin == "reconstruction" or "reconstruction" in log.metadata
    found = [
        CurrentProfile(
            part.depth, part.columns[0], part.columns[1], part.columns[2] if with_up else np.zeros(len(part.depth)),
            source, _merged(part), (), remade, _moment(log, part.time_ns),
        )
        for part in parts
    ]  # fmt: skip
    told = left_out(dropped, len(times), "samples") + _told(axis, found, int(kept.sum()) - few)
    if len(have) > 2 and not with_up:
        told += ("current_up is not there for every sample, and not used",)
    return (dataclasses.replace(found[0], dropped=dropped + found[0].dropped, warnings=told), *found[1:])


def _union(times: list[Times]) -> Times:
    """Times that any of several channels has; most often they share them."""
    if not times:
        return np.zeros(0, dtype=np.int64)
    if all(np.array_equal(times[0], other) for other in times[1:]):
        return times[0]
    return np.unique(np.concatenate(times))


def _on(times: Times, own: Times, values: Array) -> Array:
    """A channel on more times than its own, NaN where it has no sample."""
    column = np.full(len(times), np.nan)
    column[np.searchsorted(times, own)] = values
    return column


def _middle(log: Log, name: str, window: tuple[int, int] | None) -> float | None:
    """Median of a channel of positions within a window of times, else of all of it; of a log without fixes the place
    that its metadata tell; None where there is none."""
    channel = log.channels.get(name)
    if channel is None or not len(channel):
        return _near(log, name)
    inside = channel.values if window is None else channel.sliced(window[0], window[1] + 1).values
    return middle_of(inside if len(inside) else channel.values, name)


def _near(log: Log, name: str) -> float | None:
    """Roughly where a log without fixes was, deg, by its metadata; None where they do not tell."""
    try:
        degrees = float(log.metadata[f"near_{name}_deg"])
    except (KeyError, ValueError):
        return None
    return degrees if abs(degrees) <= (90.0 if name == "latitude" else 360.0) else None


def _axis(log: Log, times: Times, latitude: float) -> _Axis | None:
    """Depth in time: of depth or pressure the one that stands beside more of the samples; of equals depth."""
    found = []
    for name in ("depth", "pressure"):
        channel = log.channels.get(name)
        if channel is not None and len(channel):
            nearest = np.minimum(np.searchsorted(times, channel.time_ns), max(len(times) - 1, 0))
            found.append((int((times[nearest] == channel.time_ns).sum()) if len(times) else 0, channel))
    if not found:
        return None
    _, channel = max(found, key=lambda item: item[0])
    values = channel.values
    if channel.name == "pressure":
        values = depth_from_pressure(np.maximum(values / DBAR, 0.0), latitude)
    return _Axis(channel.time_ns, values, channel.name)


def _parts(axis: _Axis, times: Times, depth: Array, columns: Array, kept: NDArray[np.bool_]) -> tuple[list[_Part], int]:
    """The descents and ascents of two bins or more, and how many samples the others have."""
    bounds = turns(axis.depth)
    starts = axis.time_ns[bounds[:-1]]
    number = np.searchsorted(starts, times, side="right") - 1
    parts, few = [], 0
    for _, samples in _groups(number, kept):
        z, medians = by_bins(depth[samples], np.vstack([columns[:, samples], times[samples] - times[0]]))
        if len(z) < 2:
            few += len(samples)
        else:
            parts.append(_Part(samples, z, medians[:-1], float(times[0]) + float(medians[-1].mean())))
    return parts, few


def _groups(number: NDArray[np.intp], kept: NDArray[np.bool_]) -> Iterator[tuple[int, NDArray[np.intp]]]:
    """Each number with its kept samples; numbers do not decrease."""
    samples = np.flatnonzero(kept)
    values, first = np.unique(number[samples], return_index=True)
    yield from zip(values.tolist(), np.split(samples, first[1:]) if len(samples) else [], strict=False)


def _merged(part: _Part) -> Dropped:
    """Samples that their bins have beyond one each."""
    more = len(part.samples) - len(part.depth)
    return ((_MERGED, more),) if more else ()


def _moment(log: Log, time_ns: float) -> Moment:
    """When a profile holds: in UTC; of a log without dates, since its first depth sample."""
    if "time_note" not in log.metadata:
        return Moment(time_ns / 1e9, True)
    zero = log["depth"].time_ns[0] if len(log.channels.get("depth", ())) else log.start_ns
    return Moment((time_ns - float(zero)) / 1e9, False)


def _told(axis: _Axis, profiles: list[Cast] | list[CurrentProfile], samples: int) -> tuple[str, ...]:
    """What was made of the samples, in a line; and the gaps of the profiles."""
    bins = sum(len(profile.depth) for profile in profiles)
    many = f"{len(profiles)} descents and ascents" if len(profiles) > 1 else "one descent or ascent"
    lines = (f"{many} by {axis.origin}: {samples} samples in {bins} bins of {BIN:g} m, medians, derived",)
    return (*lines, *gaps_of([profile.depth for profile in profiles], "sample"))


def _none_of(total: int, dropped: Dropped) -> str:
    reasons = ", ".join(f"{count} {reason}" for reason, count in dropped) or "nothing left out"
    return f"has no descent or ascent of two bins among {total} samples: {reasons}"
