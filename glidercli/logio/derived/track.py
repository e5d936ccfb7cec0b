"""Where did it go under water? A track in three dimensions: dead-reckoned through the GPS fixes, else as positions say.

Between samples the horizontal speed through water is |depth rate| / tan|pitch|: the path is taken to lie along the
hull, the angle of attack (a few degrees) is left out. It is held at zero where pitch is below 5 deg or the depth rate
below 0.02 m/s, since the quotient then says nothing, and at the surface. Where the log has speed through water, such as
that of the flight model of a Seaglider's basestation, it is taken with the depth rate instead. What the integral along
the heading misses at each next fix is made up for by closure.py. All of it is derived, not measured.

Where pitch or heading is missing and the log has positions under water, interpolated or reckoned by whoever recorded
them, the track goes through these, and nothing is added. They are no fixes, and are told as what they are.
"""

from __future__ import annotations

import json

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.log import Channel, Log
from glidercli.logio.derived.closure import Closure, Fixes, close
from glidercli.logio.derived.motion import AFLOAT, LONGEST_GAP
from glidercli.logio.jumps import CIRCLE, DRIFT, beyond
from glidercli.logio.whereabouts import Whereabouts
from glidercli.places import track_of_geodetic
from glidercli.residuals import usual_gap
from glidercli.units import DEGREE
from glidercli.utc import to_second

__all__ = ["with_track"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

LEAST_PITCH = 5.0 * DEGREE
LEAST_DEPTH_RATE = 0.02  # m/s
SURFACE = float(PHASES.index("surface"))
MOST_TOLD = 4
"""Closures told one by one in the note; more stand in the metadata alone."""
HALF = 0.5
"""Part of the time under water that positions must tell of for a track through them to show how it went."""


def with_track(log: Log, near: Whereabouts | None = None) -> Log:
    """The log with derived north, east and down, m, and the metadata ``track_note``: how, or why there is none.

    A log without depth, or with a track of its own, stays as it is. near : positions that need be no fixes; a track
    goes through them, or else through those of the log, where pitch or heading is missing.
    """
    if "north" in log or "depth" not in log or not len(log["depth"]):
        return log
    if len(log.together("depth", "pitch", "heading")[0]) > 1:
        return _reckoned(log)
    return _through_positions(log, near)


def _reckoned(log: Log) -> Log:
    """The log with a track from depth, pitch and heading.

    The origin is the first fix (metadata origin_latitude_deg, origin_longitude_deg), or the first sample without one.
    North and east have a sample at every fix, too. The metadata ``closures`` holds a JSON list, an entry for each dive
    between two fixes.
    """
    times, (z, theta, psi) = log.together("depth", "pitch", "heading")
    steps = np.diff(times) * 1e-9
    rate = np.abs(np.diff(z)) / steps
    incline = np.abs(0.5 * (theta[1:] + theta[:-1]))
    gap = steps > LONGEST_GAP
    afloat = _at_surface(log, times)
    under = ~gap & ~(afloat[1:] | afloat[:-1]) & ~beyond(times, z)
    gliding = (incline >= LEAST_PITCH) & (rate >= LEAST_DEPTH_RATE) & under
    speed = np.where(gliding, rate / np.tan(np.maximum(incline, LEAST_PITCH)), 0.0)
    through = _speed(log, times[:-1] + (times[1:] - times[:-1]) // 2)
    told = np.isfinite(through) & under
    speed = np.where(told, np.sqrt(np.maximum(through**2 - rate**2, 0.0)), speed)
    held = under & ~gliding & ~told | ~under & ~gap
    middle = np.angle(np.exp(1j * psi[1:]) + np.exp(1j * psi[:-1]))
    north = np.concatenate([[0.0], np.cumsum(speed * np.cos(middle) * steps)])
    east = np.concatenate([[0.0], np.cumsum(speed * np.sin(middle) * steps)])
    notes = [
        "dead reckoned, not measured: horizontal speed = |depth rate| / tan|pitch| along the heading, angle of attack "
        f"left out, held at zero for {float(steps[held].sum()):.0f} s at the surface, at pitch below 5 deg "
        "or depth rate below 0.02 m/s"
    ]
    if told.any():
        notes.append(
            f"for {float(steps[told].sum()):.0f} s horizontal speed comes from the log's speed through water "
            f"({log['speed_through_water'].origin}) and depth rate instead"
        )
    if gap.any():
        notes.append(
            f"{int(gap.sum())} gaps longer than {LONGEST_GAP:.0f} s, {float(steps[gap].sum()):.0f} s in all, bridged "
            "by the closure alone"
        )
    fixes, place = _fixes(log)
    every = times
    if fixes is None:
        notes.append("no GPS fix: not corrected for current")
    else:
        every, north, east, closures = close(fixes, times, z, north, east)
        notes += _told(closures) + _uncorrected(fixes.time_ns, times)
        place["closures"] = json.dumps([closure.document() for closure in closures])
    track = (
        Channel("north", every, north, "derived"),
        Channel("east", every, east, "derived"),
        Channel("down", times, z, "derived"),
    )
    return log.with_channels(*track).with_metadata(**place, track_note="; ".join(notes))


def _through_positions(log: Log, near: Whereabouts | None) -> Log:
    """The log with a track through positions at samples of depth; without one where they tell too little."""
    lacking = [f"no {name}" for name in ("pitch", "heading") if name not in log]
    why = f"the log has {' and '.join(lacking)}"
    if not lacking:
        why = "depth, pitch and heading have no two samples at one time"
    depth = log["depth"]
    if near is None:
        fixed, (latitude, longitude) = log.together("latitude", "longitude")
        near = Whereabouts(fixed, latitude, longitude)
    times, rows, among = np.intersect1d(depth.time_ns, near.time_ns, assume_unique=True, return_indices=True)
    z, latitude, longitude = depth.values[rows], near.latitude[among], near.longitude[among]
    under = z >= AFLOAT
    gap = max(LONGEST_GAP, usual_gap(depth))
    whole = _lasts(depth.time_ns, depth.values >= AFLOAT, gap)
    moved = np.append(True, (np.diff(latitude) != 0.0) | (np.diff(longitude) != 0.0))[: len(times)]
    told = _lasts(times[moved], under[moved], gap)
    if not whole or told < HALF * whole:
        lack = "it has no position under water"
        if under.any():
            lack = (
                f"its positions, at {int(under.sum())} samples of depth, go on for {told:.0f} of {whole:.0f} s under "
                "water: too little to draw one through them"
            )
        return log.with_metadata(track_note=f"no track: {why}, and {lack}")
    north, east = track_of_geodetic(latitude, longitude, latitude[0], longitude[0])
    note = (
        f"drawn through {len(times)} {'recorded' if log.origin == 'measured' else log.origin} positions, since {why}; "
        "under water they are no GPS fixes, but interpolated or reckoned by whoever told them; nothing is interpolated "
        "between them"
    )
    if left := len(depth) - len(times):
        note += f", and {left} samples of depth without a position are left out"
    if far := int((np.hypot(np.diff(north), np.diff(east)) > CIRCLE + DRIFT * 1e-9 * np.diff(times)).sum()):
        note += f"; {far} steps between them are longer than {DRIFT:g} m/s and {CIRCLE:g} m allow"
    track = {"north": north, "east": east, "down": z}
    log = log.with_channels(*(Channel(name, times, values, "derived") for name, values in track.items()))
    return log.with_metadata(**_place(latitude[0], longitude[0]), track_note=note)


def _lasts(times: Times, under: NDArray[np.bool_], gap: float) -> float:
    """How long samples were under water, s, without the time between two of them that are more than gap s apart."""
    steps = np.diff(times) * 1e-9
    return float(steps[under[1:] & under[:-1] & (steps <= gap)].sum())


def _place(latitude: float, longitude: float) -> dict[str, str]:
    """The origin of north and east, as metadata."""
    return {"origin_latitude_deg": repr(float(latitude)), "origin_longitude_deg": repr(float(longitude))}


def _speed(log: Log, at: Times) -> Array:
    """Speed through water, m/s, at times, UTC ns: linear between samples that are near, NaN elsewhere."""
    if "speed_through_water" not in log:
        return np.full(len(at), np.nan)
    channel = log["speed_through_water"]
    known = channel.time_ns
    after = np.clip(np.searchsorted(known, at), 0, len(known) - 1)
    before = np.clip(after - 1, 0, None)
    far = (at < known[0]) | (at > known[-1]) | (known[after] - known[before] > LONGEST_GAP * 1e9)
    return np.where(far, np.nan, np.interp(at, known, channel.values))


def _fixes(log: Log) -> tuple[Fixes | None, dict[str, str]]:
    """The GPS fixes about the first one, and where that is."""
    if not {"latitude", "longitude"} <= log.channels.keys():
        return None, {}
    times, (lat, lon) = log.together("latitude", "longitude")
    if not len(times):
        return None, {}
    north, east = track_of_geodetic(lat, lon, lat[0], lon[0])
    return Fixes(times, north, east), _place(lat[0], lon[0])


def _told(closures: list[Closure]) -> list[str]:
    """The closures in words: each, or the largest of many."""
    if len(closures) <= MOST_TOLD:
        return [closure.told() for closure in closures]
    errors = np.array([closure.error for closure in closures])
    worst = closures[int(errors.argmax())]
    middle = f"{np.median(errors):.0f} m in the middle"
    return [f"{len(closures)} closures between fixes, {middle}; the largest: {worst.told()}"]


def _uncorrected(fixed: Times, times: Times) -> list[str]:
    """For how long before the first and after the last fix nothing corrects the track."""
    head, tail = (fixed[0] - times[0]) * 1e-9, (times[-1] - fixed[-1]) * 1e-9
    notes = []
    if head > 0.0:
        notes.append(f"not corrected for current in the {head:.0f} s before the first fix, {to_second(fixed[0])}")
    if tail > 0.0:
        notes.append(f"not corrected for current in the {tail:.0f} s after the last fix, {to_second(fixed[-1])}")
    return notes


def _at_surface(log: Log, times: Times) -> NDArray[np.bool_]:
    """Whether the phase sampled at each time is surface; False where none is sampled."""
    afloat = np.zeros(len(times), dtype=bool)
    if "phase" in log:
        _, rows, source = np.intersect1d(times, log["phase"].time_ns, assume_unique=True, return_indices=True)
        afloat[rows] = log["phase"].values[source] == SURFACE
    return afloat
