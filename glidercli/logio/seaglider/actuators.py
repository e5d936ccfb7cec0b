"""When did each motor run, and where did it bring its mass? From the events of guidance and control (GC).

An event tells when it starts, for how long each motor ran, and the A/D counts before and after. The motors run one
after the other: pitch, VBD (buoyancy pump or valve), roll. What shows the order (times since the start of the dive):

    sg561 dive 3, event at 89 s, pitch 10.88 s, roll 2.03 s: the row at 101.7 s has pitchCtl at its end and rollCtl at
        half of its way; dive 4, event at 67 s: the row at 72.7 s has pitchCtl at half of its way.
    sg561 dive 3, event at 794 s, pitch 0.88 s, VBD 80.32 s, roll 2.20 s: at 795.0 s pitchCtl moves, at 821.7 and
        851.7 s vbdCC moves and rollCtl does not yet.
    sg249 dive 10, event at 6239.5 s, pitch 2.74 s, VBD 96.06 s, roll 4.18 s: roll jumps between 6338.4 and 6343.4 s.

Pauses between motors are not recorded: rows within events of sg561 fit to within 2 s, and the power record of sg171's
microstructure sensors has motors on 0.7 s after the start of an event and 2 s longer than the motors' times add up to.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel, Event
from glidercli.logio.quantities import Quantity, channel_of
from glidercli.logio.seaglider.columns import CONTROLS

__all__ = ["Moves", "clear_of_motors", "counts_of_vbd", "moves", "surface_pump"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

SLACK = 2.0
"""s; an event's start and end are whole seconds in older software."""
LONGEST_DIVE = 1e6
"""s; a dive lasts hours."""
MOTORS = {"pitch": "pitchCtl", "vbd": "vbdCC", "roll": "rollCtl"}
"""In the order in which they run, with the column that tells the same."""
UNRECORDED = {"pitch": 0.1, "vbd": 10.0, "roll": 5.0}
"""cm, cm3, deg; less between two events is the noise of the potentiometers, and oil that yields to pressure."""
NAMES = {
    "mass_position": ("pitch motor",),
    "ballast_volume": ("VBD pump", "VBD valve"),
    "mass_rotation": ("roll motor",),
}
"""How the events of a channel's motor begin."""


class Moves(NamedTuple):
    """What the events gave.

    channels : positions at the events' starts, and at the motors' starts and stops. events : the latter. first_ns :
    (n,), time of the first sample of each event; gave : (n,), whether there is one.
    """

    channels: list[Channel]
    events: list[Event]
    first_ns: Times
    gave: NDArray[np.bool_]


def counts_of_vbd(table: Mapping[str, Array], ignore: float | None) -> dict[str, Array]:
    """The table with vbd_ad_start, the mean of the two potentiometers, where only these are told.

    ignore : VBD_LP_IGNORE; not zero where the vehicle leaves one of them out.
    """
    pots = [f"vbd_pot{number}_ad_start" for number in (1, 2)]
    if "vbd_ad_start" in table or ignore or not set(pots) <= table.keys():
        return dict(table)
    return {**table, "vbd_ad_start": 0.5 * (table[pots[0]] + table[pots[1]])}


def moves(
    time_ns: Times, table: Mapping[str, Array], settings: Mapping[str, float], climb_ns: int | None, warnings: list[str]
) -> Moves:
    """Where the motors stood when an event started, and when they started and stopped themselves.

    Between events a mass may move without a record, as the roll motor does when a dive of sg561 ends: so what stood
    still in an event has its sample too, at the event's start.

    time_ns : (n,), UTC ns, start of each event, increasing. table : columns of events by name, (n,), NaN where blank;
    end_secs counts from the start of the event. settings : centres and conversions of the .log by name.
    climb_ns : when the dive ended, from when on C_ROLL_CLIMB is the centre; None where it is not known.
    """
    blank = np.full(len(time_ns), np.nan)
    duration = table.get("end_secs", blank)
    begin = np.zeros(len(time_ns))
    first = np.full(len(time_ns), np.iinfo(np.int64).max)
    channels, events = [], []
    for motor, column in MOTORS.items():
        run = np.abs(np.nan_to_num(table.get(f"{motor}_secs", blank)))
        end = begin + run
        late = (run > 0.0) & (end > np.where(np.isnan(duration), LONGEST_DIVE, duration) + SLACK)
        if late.any():
            warnings.append(f"{motor}_secs: {int(late.sum())} runs left out that outlast their event")
        ran = (run > 0.0) & ~late
        if told := _unrecorded(motor, column, table, settings):
            warnings.append(told)
        times = [time_ns + np.round(np.where(late, 0.0, seconds) * 1e9).astype(np.int64) for seconds in (begin, end)]
        before, after = (_position(motor, table.get(f"{motor}_ad{at}", blank), time_ns, settings, climb_ns)
                         for at in ("_start", ""))  # fmt: skip
        runs = ran & np.isfinite(before), ran & np.isfinite(after)
        samples = ((time_ns, before, np.isfinite(before)), (times[0], before, runs[0]), (times[1], after, runs[1]))
        both, values = (np.concatenate([sample[i][sample[2]] for sample in samples]) for i in (0, 1))
        order = np.argsort(both, kind="stable")
        channels.append(_increasing(column, both[order], values[order], CONTROLS[column], warnings))
        low, high = CONTROLS[column].low, CONTROLS[column].high
        for at, position, there in samples:
            first = np.minimum(first, np.where(there & (position >= low) & (position <= high), at, first))
        names = _names(motor, table.get("vbd_secs", blank), before, after)
        depth = table.get("depth", blank)
        events += [
            Event(f"{name} {word}", int(t), float(z) if word == "starts" and np.isfinite(z) else None)
            for at, word in zip(times, ("starts", "stops"), strict=True)
            for name, t, z in zip(names[ran], at[ran], depth[ran], strict=True)
        ]
        begin = np.where(late, begin, end)
    gave = first < np.iinfo(np.int64).max
    return Moves(channels, events, np.where(gave, first, time_ns), gave)


def clear_of_motors(channels: list[Channel], events: Sequence[Event], warnings: list[str]) -> list[Channel]:
    """The channels of rows, without positions that stand within SLACK of the start or stop of their own motor.

    Times of events are whole seconds in older software: a row just after a stop may still tell the position before it,
    and a line from there to the next row would move the mass for half a minute.
    """
    found = []
    for channel in channels:
        words = NAMES.get(channel.name, ())
        edges = np.array([e.time_ns for e in events if e.name.startswith(words)] if words else [], dtype=np.int64)
        near = np.zeros(len(channel), dtype=bool)
        for edge in edges:
            near |= np.abs(channel.time_ns - edge) <= SLACK * 1e9
        if near.any():
            warnings.append(
                f"{channel.name}: {int(near.sum())} values left out within {SLACK:g} s of its motor's start or stop, "
                "whose times are no better; the events tell the positions there"
            )
        found.append(dataclasses.replace(channel, time_ns=channel.time_ns[~near], values=channel.values[~near]))
    return found


def _unrecorded(motor: str, column: str, table: Mapping[str, Array], settings: Mapping[str, float]) -> str:
    """A line where a mass stands elsewhere at the start of an event than at the end of the one before; else nothing."""
    counts = table.get(f"{motor}_ad"), table.get(f"{motor}_ad_start")
    if counts[0] is None or counts[1] is None:
        return ""
    apart = np.abs((counts[1][1:] - counts[0][:-1]) * settings.get(f"{motor.upper()}_CNV", np.nan))
    moved = apart > UNRECORDED[motor]
    if not moved.any():
        return ""
    return (
        f"GC {column}: moved {int(moved.sum())} times between events without a record, by up to "
        f"{apart[moved].max():.3g} {CONTROLS[column].unit}; linear between the samples"
    )


def _position(motor: str, counts: Array, time_ns: Times, settings: Mapping[str, float], climb_ns: int | None) -> Array:
    """Positions by the vehicle's centres and conversions, in its own units and signs; NaN where these are not told."""
    nan = float("nan")
    centre = np.full(len(counts), settings.get("C_ROLL_DIVE" if motor == "roll" else f"C_{motor.upper()}", nan))
    if motor == "roll" and climb_ns is not None:
        centre[time_ns >= climb_ns] = settings.get("C_ROLL_CLIMB", nan)
    position: Array = (counts - centre) * settings.get(f"{motor.upper()}_CNV", nan)
    return position


def _increasing(column: str, time_ns: Times, values: Array, quantity: Quantity, warnings: list[str]) -> Channel:
    """The channel; of samples at one time, a stop and the next start, the last is kept."""
    last = np.append(np.diff(time_ns) > 0, True)[: len(time_ns)]
    return channel_of(f"GC {column}", time_ns[last], values[last], quantity, warnings)


def _names(motor: str, seconds: Array, before: Array, after: Array) -> NDArray[np.str_]:
    """What ran, for each event: oil bleeds in through the valve (older software: negative times) or is pumped out."""
    if motor != "vbd":
        return np.full(len(before), f"{motor} motor")
    return np.where((seconds < 0.0) | (after < before), "VBD valve", "VBD pump")


def surface_pump(fields: Sequence[float], start_ns: int) -> list[Event]:
    """Start and stop of the pump's run at the surface, $SM_CCo: start and duration come first, s; else none.

    fields : NaN where a field is no number. start_ns : start of the dive, UTC ns. There is no sample: the ballast
    before is not recorded, and a line from the last one to that at the end would run through minutes of the climb.
    In dive 3 of sg561 the run starts at 1654 s, after the state "begin surface" (1638 s); were it the end, it would
    have begun before it.
    """
    begin, run = (fields[0], abs(fields[1])) if len(fields) > 4 else (np.nan, np.nan)
    if not (0.0 <= begin < LONGEST_DIVE and 0.0 < run < LONGEST_DIVE):
        return []
    times = (start_ns + round(seconds * 1e6) * 1000 for seconds in (begin, begin + run))
    return [Event(f"VBD pump {word}", at) for at, word in zip(times, ("starts", "stops"), strict=True)]
