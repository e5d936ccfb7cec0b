"""Where do published values belong in a figure? Each is a band over the part of the flight that it speaks of."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from glidercli.compare.facts import FLIGHT, OTHER, Fact
from glidercli.dives import Interval, phases
from glidercli.log import Log
from glidercli.residuals import table_values
from glidercli.units import NANOSECOND

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from glidercli.compare.comparison import Run

__all__ = ["BAND", "Band", "bands", "draw_facts"]

BAND = "#999999"
_LEVELS = ("mean", "median", "minimum", "maximum")
_ENDS = {"first": (0, 0), "last": (-1, 1)}
"""Which of the parts, and which end of it, a quantity speaks of."""


class Band(NamedTuple):
    """Where one fact's value +- tolerance stands on a channel's panel.

    kind : "level", low to high from begin to end; "time", all levels from begin to end; "point", low to high at end.
    begin_ns, end_ns : UTC ns. low, high : in the unit of tables; of a time 0.
    """

    fact: str
    channel: str
    kind: Literal["level", "time", "point"]
    begin_ns: int
    end_ns: int
    low: float = 0.0
    high: float = 0.0


def bands(panels: Sequence[str], runs: Sequence[Run]) -> tuple[list[Band], list[str]]:
    """The bands of every fact that has a place on these panels, channels, and the names of the facts without one.

    The time that a band spans is that of the first simulated log's phase. A level spans its phase, a time is a
    vertical band on the depth panel, a first or last value stands at that end of its phase, and a heading change at its
    phase's end, from the heading at its begin. What no log holds is not named.
    """
    log = runs[0].log
    intervals = phases(log)
    found = [
        (one.fact.name, list(_of_fact(panels, one.fact, log, _during(one.fact, log, intervals))))
        for one in runs[0].facts
        if one.fact.quantity != OTHER
    ]
    return [band for _, some in found for band in some], [name for name, some in found if not some]


def draw_facts(panels: Mapping[str, Axes], runs: Sequence[Run], zero: int, scale: float) -> list[str]:
    """Draw each fact's band, see ``bands``, and return a line that names those with no place in the figure.

    zero : UTC ns of the time axis' zero; scale : its unit per ns.
    """
    drawn, undrawn = bands(list(panels), runs)
    for band in drawn:
        axes = panels[band.channel]
        begin, end = (band.begin_ns - zero) * scale, (band.end_ns - zero) * scale
        middle = 0.5 * (band.low + band.high)
        if band.kind == "time":
            axes.axvspan(begin, end, color=BAND, alpha=0.45, linewidth=0, zorder=1)
        elif band.kind == "point":
            axes.errorbar(
                end, middle, yerr=0.5 * (band.high - band.low), color=BAND, marker="o", markersize=4, capsize=4,
                linewidth=2, zorder=1.5,
            )  # fmt: skip
        else:
            axes.fill_between([begin, end], band.low, band.high, color=BAND, alpha=0.45, linewidth=0, zorder=1)
            axes.plot([begin, end], [middle, middle], color="#555555", linewidth=0.8, zorder=1.5)
    return [f"Published, not drawn: {', '.join(undrawn)}."] if undrawn else []


def _during(fact: Fact, log: Log, intervals: tuple[Interval, ...]) -> list[tuple[int, int]]:
    """Begin and end, UTC ns, of the parts that a fact speaks of."""
    if fact.phase == FLIGHT:
        return [(log.start_ns, log.end_ns)]
    return [(one.start_ns, one.end_ns) for one in intervals if one.name == fact.phase]


def _of_fact(panels: Sequence[str], fact: Fact, log: Log, during: list[tuple[int, int]]) -> Iterator[Band]:
    low, high = fact.value - fact.tolerance, fact.value + fact.tolerance
    level = "depth" if fact.quantity == "max_depth" else fact.channel if fact.quantity in _LEVELS else None
    if level in panels and level is not None:
        for begin, end in during:
            yield Band(fact.name, level, "level", begin, end, low, high)
    elif fact.channel in panels and fact.channel is not None and fact.quantity in _ENDS and during:
        part, end = _ENDS[fact.quantity]
        at = during[part][end]
        yield Band(fact.name, fact.channel, "point", at, at, low, high)
    elif fact.quantity in ("time_to_max_depth", "duration") and "depth" in panels and len(during) == 1:
        begin, end = (during[0][0] + round(seconds / NANOSECOND) for seconds in (low, high))
        yield Band(fact.name, "depth", "time", begin, end)
    elif fact.quantity == "heading_change" and "heading" in panels and "heading" in log and len(during) == 1:
        heading = log["heading"]
        start = float(np.interp(during[0][0], heading.time_ns, table_values(heading)))
        yield Band(fact.name, "heading", "point", *during[0], start + low, start + high)
