"""How did it move up and down? Depth where only pressure is recorded, vertical speed, and the phase of flight."""

from __future__ import annotations

import numpy as np

from glidercli.channels import PHASES
from glidercli.dives import LEGS, mask, phases
from glidercli.log import Channel, Log
from glidercli.logio.jumps import NOISE, RATE, beyond
from glidercli.logio.whereabouts import Whereabouts
from glidercli.units import DBAR

__all__ = ["AFLOAT", "LONGEST_GAP", "with_motion", "with_phase"]

LONGEST_GAP = 300.0
"""s; nothing is derived across a longer gap between samples."""
AFLOAT = 3.0
"""m; a turn shallower than this is at the surface: masts and antennas reach down 1 to 2 m, and waves 1 m more."""


def with_motion(log: Log, near: Whereabouts | None = None) -> Log:
    """The log with depth (from pressure), vertical speed and phase (from depth), where it lacks them.

    near : positions that are no fixes, for the depth of a log without fixes.
    """
    notes = {}
    if "depth" not in log and "pressure" in log:
        depth, notes["depth_note"] = _depth(log, near)
        log = log.with_channels(depth)
    if "depth" in log and "vertical_speed" not in log:
        speed, jumps = _vertical_speed(log["depth"])
        if len(speed):
            log = log.with_channels(speed)
            notes["vertical_speed_note"] = (
                f"derived: central difference of depth, none beside a gap of more than {LONGEST_GAP:.0f} s"
            )
            if jumps:
                notes["vertical_speed_note"] += (
                    f", nor at {jumps} samples beside a step of depth of more than {RATE:g} m/s and {NOISE:g} m"
                )
    return with_phase(log.with_metadata(**notes))


def with_phase(log: Log) -> Log:
    """The log with a phase from depth, where it lacks one and dives or climbs."""
    phase = _phase(log) if "depth" in log and "phase" not in log else None
    if not phase:
        return log
    note = (
        "derived from depth: dives and climbs lie between turns of at least 5 m, or a tenth of the depth range "
        f"if that is less; a turn above {AFLOAT:g} m is surface, a deeper one inflection"
    )
    return log.with_channels(phase).with_metadata(phase_note=note)


def _depth(log: Log, near: Whereabouts | None) -> tuple[Channel, str]:
    """Depth by TEOS-10 from pressure, m, and how."""
    import gsw

    pressure = log["pressure"]
    if "latitude" in log:
        latitude, place = float(np.median(log["latitude"].values)), "at the median latitude"
    elif near is not None:
        latitude, place = near.middle[0], "at the median latitude of positions that are no fixes"
    else:
        latitude, place = 45.0, "at latitude 45 deg, none is known: up to 0.27 % off at the poles"
    depth = Channel("depth", pressure.time_ns, -gsw.z_from_p(pressure.values / DBAR, latitude), "derived")
    return depth, f"derived from pressure by TEOS-10 {place}"


def _vertical_speed(depth: Channel) -> tuple[Channel, int]:
    """Central difference of depth by time, m/s, positive down; and at how many samples it is left out since a step
    beside them is more than a glider can sink or rise. It is left out beside a long gap, too."""
    time = (depth.time_ns - depth.time_ns[:1]) * 1e-9
    ahead, behind = np.diff(time)[1:], np.diff(time)[:-1]
    near = (ahead <= LONGEST_GAP) & (behind <= LONGEST_GAP)
    steps = beyond(depth.time_ns, depth.values)
    sound = ~(steps[1:] | steps[:-1])
    speed = (depth.values[2:] - depth.values[:-2]) / (ahead + behind) if len(depth) > 2 else np.array([])
    kept = near & sound
    times = depth.time_ns[1:-1][kept]
    return Channel("vertical_speed", times, speed[kept], "derived"), int((near & ~sound).sum())


def _phase(log: Log) -> Channel:
    """Phase at every depth sample; none where the log neither dives nor climbs."""
    depth = log["depth"]
    intervals = phases(log)
    if not intervals:
        return Channel("phase", depth.time_ns[:0], depth.values[:0], "derived")
    turning = np.where(depth.values < AFLOAT, PHASES.index("surface"), PHASES.index("inflection")).astype(float)
    for leg in LEGS:
        turning[mask(depth.time_ns, intervals, leg)] = PHASES.index(leg)
    return Channel("phase", depth.time_ns, turning, "derived")
