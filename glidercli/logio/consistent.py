"""What of a file cannot be beside its neighbours in time? Fixes that jump, depths that spike: left out, counted.

The rules stand in jumps.py. They are for recordings; what was simulated, and files of this program, stay as they are.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel
from glidercli.logio.jumps import CIRCLE, DRIFT, NOISE, RATE, agreeing, spikes
from glidercli.logio.reader import Part
from glidercli.units import DBAR
from glidercli.utc import to_second

__all__ = ["consistent"]

Times = NDArray[np.int64]
Mask = NDArray[np.bool_]

FIX = ("latitude", "longitude")
IN_METRES = {"depth": 1.0, "pressure": DBAR}
"""SI value of a metre of water, to within 3 %."""
NAMED = 5
"""Times that are told one by one."""


def consistent(part: Part) -> Part:
    """The file without fixes that its other fixes rule out, and without spikes of depth and pressure."""
    if part.log.origin != "measured":
        return part
    for name, metre in IN_METRES.items():
        if name in part.log:
            channel = part.log[name]
            spiky = spikes(channel.time_ns, channel.values / metre)
            told = f"leave the others by more than {RATE:g} m/s and {NOISE:g} m and come back"
            if 2 * spiky.sum() < len(spiky):
                bad = channel.time_ns[spiky]
                part = _without(part, (name,), bad, f"{name}: {{}} values left out that {told}", "spike")
            elif len(spiky):  # such as two sensors that take turns
                part = _with_note(part, f"{name}: half or more of its values {told}; nothing tells which, all are kept")
    if not set(FIX) <= part.log.channels.keys():
        return part
    times, (latitude, longitude) = part.log.together(*FIX)
    kept = agreeing(times, latitude, longitude)
    allowed = f"({DRIFT:g} m/s and {CIRCLE:g} m are allowed)"
    if 2 * kept.sum() > len(kept):
        told = f"GPS: {{}} fixes left out, too far from the others {allowed}"
        return _without(part, FIX, times[~kept], told, "fix too far from the others for its time")
    note = f"GPS: {len(kept)} fixes, half or more too far from one another {allowed}; nothing tells which, all are kept"
    return _with_note(part, note) if len(kept) else part


def _without(part: Part, names: tuple[str, ...], bad: Times, told: str, reason: str) -> Part:
    """The file without the samples of channels at some times. told : the warning, with a place for their number."""
    if not len(bad):
        return part
    channels = dict(part.log.channels)
    for name in names:
        channel = channels[name]
        good = ~np.isin(channel.time_ns, bad)
        channels[name] = Channel(name, channel.time_ns[good], channel.values[good], channel.origin)
    left = [channel.time_ns for channel in channels.values()]
    gone = np.isin(part.record_ns, bad) & ~np.isin(part.record_ns, np.concatenate(left))
    note = f"{told.format(len(bad))}: {', '.join(map(to_second, bad[:NAMED]))}{' ...' if len(bad) > NAMED else ''}"
    report = part.report
    if count := int(gone.sum()):
        dropped = (*report.dropped, (reason, count))
        report = dataclasses.replace(report, kept=report.kept - count, dropped=dropped)
    part = dataclasses.replace(
        part,
        log=dataclasses.replace(part.log, channels={n: c for n, c in channels.items() if len(c)}),
        report=report,
        record_ns=part.record_ns[~gone],
    )
    return _with_note(part, note)


def _with_note(part: Part, note: str) -> Part:
    report = dataclasses.replace(part.report, warnings=(*part.report.warnings, note))
    return dataclasses.replace(part, report=report)
