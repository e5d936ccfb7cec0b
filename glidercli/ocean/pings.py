"""What current do the pings of an ADCP show? Means in time of bins by depth, over ground, in the earth frame.

Facts: an ADCP measures the velocity of the water relative to itself; bottom track is that of the bottom, in the same
frame and sign, so that the difference is over ground (Teledyne RD Instruments, "ADCP Coordinate Transformation",
"Principles of Operation"). Side lobes of the beams meet surface or bottom first, so that bins beyond the distance times
the cosine of the beam angle are not of the water (the same, section "Measurement near the surface or bottom").
Names of variables are those of mhkit's dolfyn.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections import Counter
from collections.abc import Container, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean.counting import counted
from glidercli.ocean.current import BAD_VELOCITY, DEEPEST, GREATEST_SPEED, CurrentProfile, profile_of
from glidercli.ocean.seawater import depth_from_pressure
from glidercli.ocean.series import Moment
from glidercli.ocean.source import left_out
from glidercli.ocean.together import gaps_of

__all__ = ["PING_VARIABLES", "Pings", "currents_of_pings", "is_pings", "pings_of"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

PING_VARIABLES = ("vel", "range", "time", "pressure", "depth", "vel_bt", "dist_bt", "latitude_gps")
"""What is used, by name; with the ending _avg where a Nortek instrument averages."""

WINDOW = 600.0
"""s; ensembles within it are averaged."""
MOST_PROFILES = 1000
"""Longer records are averaged over longer windows."""
_ENOUGH = 0.25  # share of good ensembles that a mean needs
_STILL = 0.05  # m/s that an instrument on a mooring sinks or rises at most, blown down by a current


class Pings(NamedTuple):
    """Ensembles of an ADCP.

    time : (n,), s since 1970. range : (m,), m along the vertical, from the instrument to the middle of each bin.
    velocity : (3, m, n), m/s, in the frame ``frame``, NaN where bad. depth : (n,), m, of the instrument, NaN where not
    known. bottom_velocity : (3, n), m/s, and bottom_range : (n,), m, by bottom track; None without it. looks : "up",
    "down", or another word. beam_angle : rad. declination : deg that is in the velocities; NaN where not told.
    underway : whether the file has GPS positions of a vessel.
    """

    time: Array
    range: Array
    velocity: Array
    depth: Array
    bottom_velocity: Array | None
    bottom_range: Array | None
    frame: str
    looks: str
    beam_angle: float
    declination: float
    underway: bool


def is_pings(names: Container[str]) -> bool:
    """Whether variables are those of an ADCP's ensembles as mhkit's dolfyn names them."""
    return ("vel" in names and "range" in names) or ("vel_avg" in names and "range_avg" in names)


def pings_of(
    variables: Mapping[str, NDArray[Any]], attributes: Mapping[str, Any], latitude: float | None = None
) -> Pings:
    """Ensembles from variables that mhkit's dolfyn names. Times are in s since 1970.

    latitude : deg, for the depth of a pressure; 0 without it, which makes depth too great by 0.53 % at the poles.
    """
    end = "" if "vel" in variables else "_avg"

    def get(name: str) -> Array | None:
        found = variables.get(name + end, variables.get(name))
        return None if found is None else np.asarray(found, dtype=np.float64)

    velocity, time = _clean(get("vel")), get("time")
    assert velocity is not None
    assert time is not None
    depth, pressure = get("depth"), get("pressure")
    if depth is None:
        known = np.full(len(time), np.nan) if pressure is None else np.where(pressure < DEEPEST, pressure, np.nan)
        depth = depth_from_pressure(np.maximum(known, 0.0), latitude or 0.0)
    bottom, distance = _clean(variables.get("vel_bt")), variables.get("dist_bt")
    if bottom is not None and bottom.shape[-1] != len(time):
        bottom = None  # of another clock
    nearest = None
    if bottom is not None and distance is not None:
        each = np.where(np.asarray(distance, dtype=np.float64) > 0.0, distance, np.nan)
        nearest = np.where(np.isfinite(each).any(axis=0), np.nanmin(np.nan_to_num(each, nan=np.inf), axis=0), np.nan)
    return Pings(
        time=time,
        range=np.asarray(get("range"), dtype=np.float64),
        velocity=velocity[:3],
        depth=np.where((depth >= 0.0) & (depth < DEEPEST), depth, np.nan),
        bottom_velocity=None if bottom is None or not np.isfinite(bottom[:3]).any() else bottom[:3],
        bottom_range=nearest,
        frame=str(attributes.get("coord_sys", "not told")),
        looks=str(attributes.get("orientation", "not told")),
        beam_angle=math.radians(float(attributes.get("beam_angle", 20.0))),
        declination=float(attributes.get("magnetic_var_deg", attributes.get("declination", math.nan))),
        underway="latitude_gps" in variables,
    )


def _clean(velocity: NDArray[Any] | None) -> Array | None:
    """Velocities as numbers, NaN where they carry the mark of a bad one."""
    if velocity is None:
        return None
    v = np.asarray(velocity, dtype=np.float64)
    return np.where(np.isclose(v, BAD_VELOCITY, rtol=0.0, atol=5e-4), np.nan, v)


def currents_of_pings(path: Path, pings: Pings) -> tuple[CurrentProfile, ...]:
    """Profiles of the current, each the mean of the ensembles within ten minutes (longer, if they were over 1000).

    A bin is a mean of the ensembles that are good there, if they are a quarter of the window's or more; else a gap.

    Raises
    ------
    InputError
        The frame is not earth, the direction of the beams is not known, a vessel moves without bottom track, or nothing
        is left.
    """
    if pings.frame.lower() != "earth":
        raise InputError(
            path, f"its velocities are in the frame {pings.frame!r}; earth is needed: have the maker's or mhkit's "
            "software turn them"
        )  # fmt: skip
    if pings.looks not in ("up", "down"):
        raise InputError(path, f"its beams look {pings.looks!r}; up or down is needed to tell the depths of its bins")
    tracked = pings.bottom_velocity is not None
    if pings.underway and not tracked:
        raise InputError(
            path, "is of a vessel with GPS and without bottom track: its velocities are relative to the vessel; needed "
            "is bottom track, or the current over ground as NetCDF or CSV"
        )  # fmt: skip
    velocity, kept, dropped = _over_ground(pings)
    first, last = (float(pick(pings.time[kept])) if kept.any() else 0.0 for pick in (np.min, np.max))
    width = max(WINDOW, (last - first) / (MOST_PROFILES - 1))
    number = np.floor((pings.time - first) / width)
    profiles: list[CurrentProfile] = []
    lost: list[tuple[tuple[str, int], ...]] = []
    for window in np.unique(number[kept]):
        inside = kept & (number == window)
        found = _mean(path, pings, velocity, inside)
        if isinstance(found, CurrentProfile):
            profiles.append(found)
        else:
            lost.append(found)
    gone: Counter[str] = Counter()
    whole: Counter[str] = Counter()
    for reason, count in itertools.chain(*lost):
        gone[reason] += count
    for reason, count in itertools.chain(*lost, *(profile.dropped for profile in profiles)):
        whole[reason] += count
    if not profiles:
        why = (*dropped, *whole.items())
        told = ", ".join(f"{count} {reason}" for reason, count in why) or "no values at all"
        raise InputError(path, f"has no profile of two usable bins among {len(pings.time)} ensembles: {told}")
    total = sum(profile.records for profile in profiles) + gone.total()
    told_depth = pings.depth[kept]
    many = "1 profile" if len(profiles) == 1 else f"{len(profiles)} profiles"
    lines = [
        f"{int(kept.sum())} ensembles averaged over {width / 60.0:g} min to {many}; instrument at "
        f"{told_depth.min():.1f} to {told_depth.max():.1f} m, looking {pings.looks}",
        *left_out(dropped, len(pings.time), "ensembles"),
        *left_out(tuple(whole.items()), total, "bins"),
    ]
    if not tracked:
        lines.append("no bottom track: the velocities are over ground only if the instrument stood still")
    if not pings.declination:
        lines.append("its magnetic declination is 0 deg: if that was not set, east and north are magnetic")
    lines += gaps_of([profile.depth for profile in profiles], "bin")
    profiles[0] = dataclasses.replace(profiles[0], dropped=(*gone.items(), *profiles[0].dropped), warnings=tuple(lines))
    return tuple(profiles)


def _over_ground(pings: Pings) -> tuple[Array, Mask, tuple[tuple[str, int], ...]]:
    """Velocities over ground, (3, m, n), which ensembles can be used, and what is left out of them."""
    velocity = pings.velocity
    faults: list[tuple[str, Mask]] = [
        ("without a time", ~np.isfinite(pings.time)),
        ("without the depth of the instrument", ~np.isfinite(pings.depth)),
        ("without a good bin", np.asarray(~np.isfinite(velocity).all(axis=0).any(axis=0))),
    ]
    if pings.bottom_velocity is not None:
        faults.append(("without bottom track", np.asarray(~np.isfinite(pings.bottom_velocity).all(axis=0))))
        velocity = velocity - pings.bottom_velocity[:, np.newaxis, :]
    else:
        faults.append((f"while the instrument sinks or rises by more than {_STILL:g} m/s", _sinking(pings)))
    kept = np.ones(len(pings.time), dtype=bool)
    dropped = counted(faults, kept)
    return velocity, kept, dropped


def _sinking(pings: Pings) -> Mask:
    """Where the instrument changes its depth faster than a mooring, seen over a minute or from ensemble to ensemble."""
    good = np.flatnonzero(np.isfinite(pings.time) & np.isfinite(pings.depth))
    out = np.zeros(len(pings.time), dtype=bool)
    if len(good) < 2:
        return out
    time, depth = pings.time[good], pings.depth[good]
    after = np.minimum(np.searchsorted(time, time + 60.0), len(good) - 1)
    span = time[after] - time
    with np.errstate(invalid="ignore", divide="ignore"):
        fast = (np.abs(depth[after] - depth) > _STILL * span) & (np.abs(depth[after] - depth) > 1.0) & (span > 0.0)
    touched = np.zeros(len(good) + 1, dtype=np.int64)  # both ends of a fast change, and all between
    np.add.at(touched, np.flatnonzero(fast), 1)
    np.add.at(touched, after[fast] + 1, -1)
    out[good] = np.cumsum(touched[:-1]) > 0
    return out


def _mean(path: Path, pings: Pings, velocity: Array, inside: Mask) -> CurrentProfile | tuple[tuple[str, int], ...]:
    """The profile of one window."""
    v = velocity[:, :, inside]
    with np.errstate(invalid="ignore"):
        good = np.isfinite(v).all(axis=0) & (np.linalg.norm(v, axis=0) <= GREATEST_SPEED)
    count = good.sum(axis=1)
    enough = count >= max(1.0, _ENOUGH * good.shape[1])
    sums = np.where(good, v, 0.0).sum(axis=2)
    mean = np.where(enough, sums / np.maximum(count, 1), np.nan)
    at = float(pings.depth[inside].mean())
    down = pings.looks == "down"
    depth = at + pings.range if down else at - pings.range
    reach = math.cos(pings.beam_angle)
    faults: list[tuple[str, Mask]] = [("above the surface", depth < 0.0)]
    if not down:
        faults.append(("in the side lobe of the surface", pings.range > at * reach))
    elif pings.bottom_range is not None and np.isfinite(pings.bottom_range[inside]).any():
        nearest = float(np.nanmedian(pings.bottom_range[inside]))
        faults.append(("below the bottom or in its side lobe", pings.range > nearest * reach))
    found = profile_of(path, depth, mean, np.ones(len(depth), dtype=bool), faults)
    if isinstance(found, CurrentProfile):
        return dataclasses.replace(found, moment=Moment(float(pings.time[inside].mean()), True))
    return found
