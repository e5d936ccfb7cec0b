"""What came of both flights: how deep, how long, how often round, how far? Each figure of the two, side by side.

Both logs are taken over the time that both cover, each with its own samples and its own dives and climbs.
"""

from __future__ import annotations

from typing import NamedTuple

from glidercli.compare.facts import FLIGHT
from glidercli.compare.quantities import Missing, quantity
from glidercli.compare.tracks import TrackErrors
from glidercli.dives import Interval, phases
from glidercli.log import Log

__all__ = ["Outcome", "outcomes"]

FIGURES: tuple[tuple[str, str, str, str | None, str, float], ...] = (
    ("maximum depth", "m", "max_depth", None, FLIGHT, 1.0),
    ("time to maximum depth", "s", "time_to_max_depth", None, FLIGHT, 1.0),
    ("time on dives", "s", "duration", None, "dive", 1.0),
    ("time on climbs", "s", "duration", None, "climb", 1.0),
    ("mean pitch on dives", "deg", "mean", "pitch", "dive", 1.0),
    ("mean pitch on climbs", "deg", "mean", "pitch", "climb", 1.0),
    ("mean roll on dives", "deg", "mean", "roll", "dive", 1.0),
    ("mean roll on climbs", "deg", "mean", "roll", "climb", 1.0),
    ("turns to starboard", "turns", "heading_change", None, FLIGHT, 1.0 / 360.0),
    ("turns to starboard on dives", "turns", "heading_change", None, "dive", 1.0 / 360.0),
    ("turns to starboard on climbs", "turns", "heading_change", None, "climb", 1.0 / 360.0),
)
"""Name, unit; quantity, channel and phase as in facts.py; and the factor to the unit."""
ROUNDING = 1e-9
"""Of a figure, in its unit: less than any instrument tells."""


class Outcome(NamedTuple):
    """A figure of both flights, in one unit."""

    name: str
    unit: str
    measured: float
    simulated: float

    @property
    def difference(self) -> float:
        """Simulated less measured."""
        return self.simulated - self.measured

    @property
    def relative(self) -> float | None:
        """The difference over the measured figure's size; None where that is zero but for rounding."""
        return self.difference / abs(self.measured) if abs(self.measured) > ROUNDING else None


def outcomes(measured: Log, simulated: Log, track: TrackErrors | None) -> tuple[Outcome, ...]:
    """The figures that both logs have, on one clock; track : errors of their tracks, if both have one."""
    parts = _covered_by_both(measured, simulated)
    legs = [phases(log) for log in parts]
    found = []
    for name, unit, which, channel, phase, factor in FIGURES:
        values = [_value(which, channel, phase, log, own) for log, own in zip(parts, legs, strict=True)]
        if None not in values:
            mine, other = (factor * value for value in values if value is not None)
            found.append(Outcome(name, unit, mine, other))
    if track is not None:
        found.append(Outcome("way over ground", "m", track.way, track.simulated_way))
    return tuple(found)


def _covered_by_both(measured: Log, simulated: Log) -> tuple[Log, Log]:
    """Both logs in the time in which both have samples of depth; of any channel, where one has no depth."""
    logs = measured, simulated
    spans = [(log.start_ns, log.end_ns) for log in logs]
    if all("depth" in log and len(log["depth"]) for log in logs):
        spans = [(int(log["depth"].time_ns[0]), int(log["depth"].time_ns[-1])) for log in logs]
    start, end = max(first for first, _ in spans), min(last for _, last in spans) + 1
    return measured.sliced(start, end), simulated.sliced(start, end)


def _value(which: str, channel: str | None, phase: str, log: Log, intervals: tuple[Interval, ...]) -> float | None:
    try:
        return quantity(which, channel, phase, log, intervals)
    except Missing:
        return None
