"""Where do published values belong in a figure? Each is a band over the part of the flight that it speaks of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from glidercli.compare.facts import FLIGHT, OTHER, Fact
from glidercli.dives import Interval, phases
from glidercli.log import Log
from glidercli.residuals import table_values
from glidercli.units import NANOSECOND

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from glidercli.compare.comparison import Run

__all__ = ["BAND", "draw_facts"]

BAND = "#999999"
_LEVELS = ("mean", "median", "minimum", "maximum")
_ENDS = {"first": (0, 0), "last": (-1, 1)}
"""Which of the parts, and which end of it, a quantity speaks of."""


def draw_facts(panels: Mapping[str, Axes], runs: Sequence[Run], zero: int, scale: float) -> list[str]:
    """Draw each fact's value +- tolerance, and return a line that names those with no place in the figure.

    The time that a band spans is that of the first simulated log's phase. A level spans its phase, a time is a
    vertical band on the depth panel, a first or last value stands at that end of its phase, and a heading change at its
    phase's end, from the heading at its begin. What no log holds is not named.

    zero : UTC ns of the time axis' zero; scale : its unit per ns.
    """
    log = runs[0].log
    intervals = phases(log)
    undrawn = [
        one.fact.name
        for one in runs[0].facts
        if one.fact.quantity != OTHER
        and not _drawn(panels, one.fact, log, _during(one.fact, log, intervals), zero, scale)
    ]
    return [f"Published, not drawn: {', '.join(undrawn)}."] if undrawn else []


def _during(fact: Fact, log: Log, intervals: tuple[Interval, ...]) -> list[tuple[int, int]]:
    """Begin and end, UTC ns, of the parts that a fact speaks of."""
    if fact.phase == FLIGHT:
        return [(log.start_ns, log.end_ns)]
    return [(one.start_ns, one.end_ns) for one in intervals if one.name == fact.phase]


def _drawn(
    panels: Mapping[str, Axes], fact: Fact, log: Log, during: list[tuple[int, int]], zero: int, scale: float
) -> bool:
    low, high = fact.value - fact.tolerance, fact.value + fact.tolerance
    if not during:
        return False
    if fact.quantity == "max_depth" and "depth" in panels:
        _level(panels["depth"], during, low, high, zero, scale)
    elif fact.channel in panels and fact.quantity in _LEVELS and fact.channel is not None:
        _level(panels[fact.channel], during, low, high, zero, scale)
    elif fact.channel in panels and fact.quantity in _ENDS and fact.channel is not None:
        part, end = _ENDS[fact.quantity]
        _mark(panels[fact.channel], (during[part][end] - zero) * scale, fact.value, fact.tolerance)
    elif fact.quantity in ("time_to_max_depth", "duration") and "depth" in panels and len(during) == 1:
        begin = (during[0][0] - zero) * scale
        second = scale / NANOSECOND
        panels["depth"].axvspan(
            begin + low * second, begin + high * second, color=BAND, alpha=0.45, linewidth=0, zorder=1
        )
    elif fact.quantity == "heading_change" and "heading" in panels and "heading" in log and len(during) == 1:
        heading = log["heading"]
        start = float(np.interp(during[0][0], heading.time_ns, table_values(heading)))
        _mark(panels["heading"], (during[0][1] - zero) * scale, start + fact.value, fact.tolerance)
    else:
        return False
    return True


def _mark(axes: Axes, time: float, value: float, tolerance: float) -> None:
    axes.errorbar(time, value, yerr=tolerance, color=BAND, marker="o", markersize=4, capsize=4, linewidth=2, zorder=1.5)


def _level(axes: Axes, during: list[tuple[int, int]], low: float, high: float, zero: int, scale: float) -> None:
    for begin, end in during:
        axes.fill_between(
            [(begin - zero) * scale, (end - zero) * scale], low, high, color=BAND, alpha=0.45, linewidth=0, zorder=1
        )
        middle = 0.5 * (low + high)
        axes.plot(
            [(begin - zero) * scale, (end - zero) * scale], [middle, middle], color="#555555", linewidth=0.8, zorder=1.5
        )
