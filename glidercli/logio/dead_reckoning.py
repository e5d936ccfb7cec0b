"""Where did it go under water? A dead-reckoned track in three dimensions, drawn through the GPS fixes.

Between samples the horizontal speed through water is |depth rate| / tan|pitch|: the path is taken to lie along the
hull, the angle of attack (a few degrees) is left out. It is held at zero where pitch is below 5 deg or the depth rate
below 0.02 m/s, since the quotient then says nothing, and at the surface. The integral along the heading misses each
next fix; that closure is spread evenly over the time between the fixes, as a current would, drift at the surface
included. Before the first and after the last fix nothing corrects it, and the note says for how long. All of it is
derived, not measured.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.log import Channel, Log
from glidercli.logio.derived import LONGEST_GAP
from glidercli.places import track_of_geodetic
from glidercli.units import DEGREE

__all__ = ["with_track"]

Array = NDArray[np.float64]

LEAST_PITCH = 5.0 * DEGREE
LEAST_DEPTH_RATE = 0.02  # m/s
LEAST_DIVE = 10.0  # m, depth between two fixes that makes a closure worth telling
SURFACE = float(PHASES.index("surface"))


def with_track(log: Log) -> Log:
    """The log with derived north, east and down, m, where depth, pitch and heading are there; else as it is.

    The origin is the first fix (metadata origin_latitude_deg, origin_longitude_deg), or the first sample without one.
    """
    if not {"depth", "pitch", "heading"} <= log.channels.keys() or "north" in log:
        return log
    depth, pitch, heading = log["depth"], log["pitch"], log["heading"]
    times = np.intersect1d(np.intersect1d(depth.time_ns, pitch.time_ns), heading.time_ns)
    if len(times) < 2:
        return log
    z, theta, psi = (c.values[np.searchsorted(c.time_ns, times)] for c in (depth, pitch, heading))
    steps = np.diff(times) * 1e-9
    rate = np.abs(np.diff(z)) / steps
    incline = np.abs(0.5 * (theta[1:] + theta[:-1]))
    gap = steps > LONGEST_GAP
    afloat = _at_surface(log, times)
    gliding = (incline >= LEAST_PITCH) & (rate >= LEAST_DEPTH_RATE) & ~gap & ~(afloat[1:] | afloat[:-1])
    speed = np.where(gliding, rate / np.tan(np.maximum(incline, LEAST_PITCH)), 0.0)
    middle = np.angle(np.exp(1j * psi[1:]) + np.exp(1j * psi[:-1]))
    north = np.concatenate([[0.0], np.cumsum(speed * np.cos(middle) * steps)])
    east = np.concatenate([[0.0], np.cumsum(speed * np.sin(middle) * steps)])
    notes = [
        "dead reckoned, not measured: horizontal speed = |depth rate| / tan|pitch| along the heading, angle of attack "
        f"left out, held at zero for {float(steps[~gliding & ~gap].sum()):.0f} s at the surface, at pitch below 5 deg "
        "or depth rate below 0.02 m/s"
    ]
    if gap.any():
        notes.append(
            f"{int(gap.sum())} gaps longer than {LONGEST_GAP:.0f} s, {float(steps[gap].sum()):.0f} s in all, bridged "
            "by the closure alone"
        )
    told: dict[str, str] = {}
    if {"latitude", "longitude"} <= log.channels.keys():
        north, east, told = _closed(log, times, z, north, east, notes)
    else:
        notes.append("no GPS fix: not corrected for current")
    track = [Channel(n, times, v, "derived") for n, v in (("north", north), ("east", east), ("down", z))]
    return log.with_channels(*track).with_metadata(**told, track_note="; ".join(notes))


def _closed(
    log: Log, times: NDArray[np.int64], z: Array, north: Array, east: Array, notes: list[str]
) -> tuple[Array, Array, dict[str, str]]:
    """The track moved so that it passes through every fix, the closure spread linearly in time between fixes."""
    latitude, longitude = log["latitude"], log["longitude"]
    every = np.intersect1d(latitude.time_ns, longitude.time_ns)
    fixed = np.intersect1d(every, times)
    if len(fixed) < len(every):
        notes.append(f"{len(every) - len(fixed)} fixes not used: no depth, pitch and heading at their times")
    lat, lon = (c.values[np.searchsorted(c.time_ns, fixed)] for c in (latitude, longitude))
    if len(fixed) == 0:
        notes.append("no GPS fix at the times of the track: not corrected for current")
        return north, east, {}
    north_fix, east_fix = track_of_geodetic(lat, lon, lat[0], lon[0])
    at = np.searchsorted(times, fixed)
    miss_north, miss_east = north_fix - north[at], east_fix - east[at]
    for i in [i for i in range(len(at) - 1) if z[at[i] : at[i + 1]].max() >= LEAST_DIVE]:
        span = (fixed[i + 1] - fixed[i]) * 1e-9
        v_north, v_east = ((m[i + 1] - m[i]) / span for m in (miss_north, miss_east))
        notes.append(
            f"closure over {span:.0f} s from {_clock(fixed[i])}: "
            f"{math.hypot(v_north, v_east) * span:.0f} m, a depth-averaged current of {v_east:.3f} m/s east, "
            f"{v_north:.3f} m/s north"
        )
    head, tail = (fixed[0] - times[0]) * 1e-9, (times[-1] - fixed[-1]) * 1e-9
    if head > 0.0:
        notes.append(f"not corrected for current in the {head:.0f} s before the first fix, {_clock(fixed[0])}")
    if tail > 0.0:
        notes.append(f"not corrected for current in the {tail:.0f} s after the last fix, {_clock(fixed[-1])}")
    told = {"origin_latitude_deg": repr(float(lat[0])), "origin_longitude_deg": repr(float(lon[0]))}
    return north + np.interp(times, fixed, miss_north), east + np.interp(times, fixed, miss_east), told


def _at_surface(log: Log, times: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Whether the phase sampled at each time is surface; False where none is sampled."""
    afloat = np.zeros(len(times), dtype=bool)
    if "phase" in log:
        _, rows, source = np.intersect1d(times, log["phase"].time_ns, assume_unique=True, return_indices=True)
        afloat[rows] = log["phase"].values[source] == SURFACE
    return afloat


def _clock(time_ns: int) -> str:
    """A time as ISO 8601 UTC to the second."""
    return f"{np.datetime64(int(time_ns), 'ns').astype('datetime64[s]')}Z"
