"""Which curves do the plots of a page show? Plain values for the page's script, thinned and bounded.

    zero       UTC of the time axis' zero, ISO 8601; unit: of the time axis, "s" or "h"
    logs       [{short, colour, measured}]: the logs in the order of ``log`` below; colour counts simulations from 0;
               measured: it is the first one, which the errors are against
    range      [first, last] of the time axis, or null
    legs       [{name, begin, end}], the dives and climbs of the first log
    panels     [{channel, title, unit, down, lines, errors, bands, events}]
               lines, errors: [{log, x, y, dots}], a null in y breaks the line
    tracks     {lines: [{log, x: east, y: north, z: depth}], exaggeration, ...}, or null

Texts in it come from logs: the page writes them as JSON that no markup can leave, see page.py.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli.compare.bands import bands
from glidercli.compare.drawn import TURNED, breaks, clock, drawn_values, panels, span, unit_of
from glidercli.compare.page.html import number as written
from glidercli.dives import phases
from glidercli.log import Channel, Log
from glidercli.residuals import table_values
from glidercli.utc import to_second

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison

__all__ = ["MOST_EVENTS", "MOST_LEGS", "MOST_PANELS", "MOST_POINTS", "Plots", "plots", "thinned"]

Array = NDArray[np.float64]

MOST_POINTS = 2000
"""Points of one line: twice as many as its pixels across; a line of more samples is thinned."""
ALL_POINTS = 100_000
"""Points of all lines together, some 16 bytes each; with many logs each line has fewer."""
LEAST_POINTS = 100
"""Points of one line, however many logs there are."""
MOST_PANELS = 24
MOST_EVENTS = 200
"""Events of one log that are marked."""
MOST_LEGS = 400
"""Dives and climbs that are shaded."""


@dataclasses.dataclass(frozen=True)
class Plots:
    """The plots of a page.

    data : for the script, see above. told : by panel's channel, what the plot shows in words.
    points : most points of a line. thinned : lines that have fewer points than samples. notes : what is not drawn.
    """

    data: dict[str, Any]
    told: dict[str, str]
    points: int
    thinned: int
    notes: tuple[str, ...]


def thinned(x: Array, y: Array, most: int) -> NDArray[np.int64]:
    """Indices of at most ``most`` samples that keep the ends and the extremes of a line, in order.

    Of each of most / 2 - 1 equal parts of the time axis its lowest and its highest sample stay.
    x : (n,), increasing; y : (n,); most : 4 at least.
    """
    n = len(x)
    if n <= most:
        return np.arange(n)
    parts = most // 2 - 1
    part = np.minimum(((x - x[0]) * (parts / (x[-1] - x[0]))).astype(np.int64), parts - 1)
    order = np.lexsort((y, part))  # by part, then from low to high
    first = np.flatnonzero(np.diff(part[order], prepend=-1))
    last = np.append(first[1:], n) - 1
    return np.unique(np.concatenate([[0, n - 1], order[first], order[last]]))


class _Lines:
    """Makes lines of a page on one clock, and counts those that it thins."""

    def __init__(self, comparison: Comparison, lines: int) -> None:
        self.zero, self.unit, self.scale = clock(comparison)
        self.most = int(np.clip(ALL_POINTS // max(lines, 1), LEAST_POINTS, MOST_POINTS))
        self.thinned = 0
        self._max_gap = comparison.max_gap

    def time(self, time_ns: Any) -> Any:
        """UTC ns as time on the axis, rounded to what nobody sees."""
        return np.round((np.asarray(time_ns) - self.zero) * self.scale, 2 if self.unit == "s" else 5)

    def line(self, log: int, channel: Channel, values: Array) -> dict[str, Any]:
        """A line through samples, broken at gaps."""
        broken = breaks(channel, values, self._max_gap)
        x = np.asarray((channel.time_ns - self.zero) * self.scale, np.float64)
        kept = thinned(x, values, self.most)
        self.thinned += len(kept) < len(x)
        at = np.unique(np.searchsorted(kept, broken))
        at = at[(at > 0) & (at < len(kept))]
        y = [None if not math.isfinite(v) else v for v in np.insert(_rounded(values[kept]), at, np.nan).tolist()]
        times = self.time(channel.time_ns[kept])
        return {"log": log, "x": np.insert(times, at, times[at]).tolist(), "y": y, "dots": len(x) <= 60}


def plots(comparison: Comparison, shorts: Sequence[str]) -> Plots:
    """The plots of a comparison.

    shorts : a short name of each log, that which the errors are against first where there is one.
    """
    from glidercli.compare.page.track import track

    measured = comparison.against if isinstance(comparison.against, Log) else None
    logs = [*([] if measured is None else [measured]), *(run.log for run in comparison.runs)]
    offset = len(logs) - len(comparison.runs)
    names = panels(comparison, every=True)
    left_out, names = names[MOST_PANELS:], names[:MOST_PANELS]
    lines = _Lines(comparison, len(names) * (len(logs) + len(comparison.runs)))
    found, told = [], {}
    placed, unplaced = (bands(names, comparison.runs)) if measured is None else ([], [])
    for name in names:
        drawn = {
            number: (log[name], table_values(log[name]) if measured is None else drawn_values(log[name]))
            for number, log in enumerate(logs)
            if name in log and len(log[name])
        }
        errors = {
            offset + number: run.residuals[name]
            for number, run in enumerate(comparison.runs)
            if name in run.residuals and len(run.residuals[name].error)
        }
        found.append(
            {
                "channel": name,
                "title": name.replace("_", " ").capitalize() if len(name) > 1 else name,
                "unit": "deg, turns added up" if measured is None and name == "heading" else unit_of(name),
                "down": name in TURNED,
                "lines": [lines.line(number, *one) for number, one in drawn.items()],
                "errors": [
                    lines.line(number, Channel(name, one.time_ns, one.error), one.error)
                    for number, one in errors.items()
                ],
                "bands": [
                    {
                        "fact": band.fact, "kind": band.kind, "low": band.low, "high": band.high,
                        "begin": float(lines.time(band.begin_ns)), "end": float(lines.time(band.end_ns)),
                    }
                    for band in placed
                    if band.channel == name
                ],
                "events": _events(logs, lines) if name == "depth" else [],
            }
        )  # fmt: skip
        told[name] = _told(name, shorts, {n: values for n, (_, values) in drawn.items()}, errors, placed)
    intervals = phases(logs[0])
    notes = []
    if left_out:
        notes.append(f"Not drawn, for the page's size: {', '.join(left_out).replace('_', ' ')}.")
    if unplaced:
        notes.append(f"Published, without a place in a plot: {', '.join(unplaced)}.")
    if len(intervals) > MOST_LEGS:
        notes.append(f"Dives and climbs are not shaded: there are {len(intervals)}, at most {MOST_LEGS} are shaded.")
    crowded = sum(_marked(log) > MOST_EVENTS for log in logs)
    if crowded:
        notes.append(f"Of {crowded} logs with more than {MOST_EVENTS} events of known depth none are marked.")
    data = {
        "zero": to_second(lines.zero),
        "unit": lines.unit,
        "logs": [
            {"short": short, "colour": number - offset, "measured": number < offset}
            for number, short in enumerate(shorts)
        ],
        "range": _range(comparison, names, found, lines),
        "legs": [
            {"name": one.name, "begin": float(lines.time(one.start_ns)), "end": float(lines.time(one.end_ns))}
            for one in intervals
            if len(intervals) <= MOST_LEGS
        ],
        "panels": found,
        "track": track(logs, lines.most),
    }
    return Plots(data, told, lines.most, lines.thinned, tuple(notes))


def _range(
    comparison: Comparison, names: list[str], drawn: Sequence[dict[str, Any]], lines: _Lines
) -> list[float] | None:
    """Ends of the time axis of all plots: of the samples compared; with published values of all that is drawn."""
    if not names:
        return None
    if isinstance(comparison.against, Log):
        first, last = span(comparison, comparison.against, names, lines.zero, lines.scale)
    else:
        ends = [x for panel in drawn for line in panel["lines"] for x in (line["x"][0], line["x"][-1])]
        ends += [band[end] for panel in drawn for band in panel["bands"] for end in ("begin", "end")]
        margin = 0.02 * max(max(ends) - min(ends), 1.0)
        first, last = min(ends) - margin, max(ends) + margin
    return [round(first, 4), round(last, 4)]


def _marked(log: Log) -> int:
    return sum(event.depth is not None and math.isfinite(event.depth) for event in log.events)


def _events(logs: Sequence[Log], lines: _Lines) -> list[dict[str, Any]]:
    """Events of known depth of each log that has not too many."""
    marks = []
    for number, log in enumerate(logs):
        known = [(e.time_ns, e.depth, e.name) for e in log.events if e.depth is not None and math.isfinite(e.depth)]
        if known and len(known) <= MOST_EVENTS:
            times, depths, names = zip(*known, strict=True)
            y = _rounded(np.array(depths)).tolist()
            marks.append({"log": number, "x": lines.time(times).tolist(), "y": y, "names": [n[:80] for n in names]})
    return marks


def _told(name: str, shorts: Sequence[str], drawn: dict[int, Array], errors: dict[int, Any], placed: Any) -> str:
    """The plot in one sentence, for those who do not see it; of all samples, before thinning."""
    unit = unit_of(name)
    parts = [f"{shorts[n]} {_ends(values)}" for n, values in drawn.items()]
    parts += [f"{shorts[n]} less {shorts[0]} {_ends(one.error)}" for n, one in errors.items()]
    parts += [f"published: {fact}" for fact in dict.fromkeys(band.fact for band in placed if band.channel == name)]
    return f"{name.replace('_', ' ')}{', ' + unit if unit else ''}, against time: {'; '.join(parts)}."


def _ends(values: Array) -> str:
    return f"{written(values.min(), 5)} to {written(values.max(), 5)}"


def _rounded(values: Array, digits: int = 6) -> Array:
    """Values with so many significant digits of the largest: finer than any pixel."""
    largest = float(np.max(np.abs(values), initial=0.0))
    spread = float(np.ptp(values)) if len(values) else 0.0
    scale = spread or largest
    if scale == 0.0:
        return values
    return np.asarray(np.round(values, max(min(digits - 1 - math.floor(math.log10(scale)), 300), -300)))
