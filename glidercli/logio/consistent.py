"""What of a log cannot be beside its neighbours in time? Fixes that jump, depths that spike: left out, counted.

The rules stand in jumps.py. They are for recordings; what was simulated, and files of this program, stay as they are.
Spikes are looked for in each file, since its end may cut one; fixes are judged over all files of a log together.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel
from glidercli.logio.alike import with_note
from glidercli.logio.jumps import CIRCLE, DRIFT, NOISE, RATE, agreeing, spikes
from glidercli.logio.reader import Part
from glidercli.units import DBAR
from glidercli.utc import to_second

__all__ = ["with_agreeing_fixes", "without_spikes"]

Times = NDArray[np.int64]
Mask = NDArray[np.bool_]

FIX = ("latitude", "longitude")
IN_METRES = {"depth": 1.0, "pressure": DBAR}
"""SI value of a metre of water, to within 3 %."""
NAMED = 5
"""Times that are told one by one."""


def without_spikes(part: Part) -> Part:
    """The file without spikes of depth and pressure."""
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
                part = with_note(part, f"{name}: half or more of its values {told}; nothing tells which, all are kept")
    return part


def with_agreeing_fixes(parts: Sequence[Part]) -> list[Part]:
    """The files of a log without the fixes that those of all rule out, in their order.

    Of fixes at one time the first file's counts. Where half or more disagree all are kept, and the first file with a
    fix says so.
    """
    held = [i for i, part in enumerate(parts) if part.log.origin == "measured" and set(FIX) <= part.log.channels.keys()]
    left = list(parts)
    if not held:
        return left
    fixes = [parts[i].log.together(*FIX) for i in held]
    time_ns, first = np.unique(np.concatenate([times for times, _ in fixes]), return_index=True)
    latitude, longitude = (np.concatenate([places[k] for _, places in fixes])[first] for k in (0, 1))
    kept = agreeing(time_ns, latitude, longitude)
    allowed = f"({DRIFT:g} m/s and {CIRCLE:g} m are allowed)"
    if 2 * kept.sum() > len(kept):
        told = f"GPS: {{}} fixes left out, too far from the others {allowed}"
        for i, (times, _) in zip(held, fixes, strict=True):
            bad = times[np.isin(times, time_ns[~kept])]
            left[i] = _without(parts[i], FIX, bad, told, "fix too far from the others for its time")
    elif len(kept):
        what = f"{len(kept)} fixes{f' of {len(held)} files' if len(held) > 1 else ''}, half or more too far from"
        note = f"GPS: {what} one another {allowed}; nothing tells which, all are kept"
        left[held[0]] = with_note(parts[held[0]], note)
    return left


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
    return with_note(part, note)
