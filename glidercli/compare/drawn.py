"""What of a comparison is drawn, in a figure or on a page? Its channels, its time axis, and where lines are broken."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.compare.facts import Facts
from glidercli.log import Channel, Log
from glidercli.residuals import on_circle
from glidercli.units import HOUR, NANOSECOND

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison

__all__ = ["PANELS", "TURNED", "breaks", "clock", "drawn_values", "panels", "span", "unit_of"]

PANELS = ("depth", "pitch", "roll", "heading", "mass_position", "mass_rotation")
"""Channels shown first where present, unless others were asked for."""

TURNED = ("depth", "down", "pressure")
"""Channels whose axis grows downward."""


def panels(comparison: Comparison, every: bool = False) -> list[str]:
    """Names of the channels to show.

    every : all that were compared, the usual ones first; else the others only where none of the usual ones was.
    """
    if isinstance(comparison.against, Facts):
        concerned = [one.fact.channel for one in comparison.runs[0].facts if one.fact.channel]
        concerned += ["density" for one in comparison.runs[0].facts if one.fact.quantity == "density_change"]
        wanted = list(dict.fromkeys([*PANELS, *concerned]))
        logs = [run.log for run in comparison.runs]
    else:
        compared = {name for run in comparison.runs for name in run.residuals}
        wanted = [*PANELS, *(name for name in CHANNELS if name in compared and name not in PANELS)]
        if compared.intersection(PANELS) and not every:
            wanted = list(PANELS)
        logs = [comparison.against, *(run.log for run in comparison.runs)]
    if comparison.chosen is not None:
        wanted = list(comparison.chosen)
    return [name for name in wanted if any(name in log and len(log[name]) for log in logs)]


def clock(comparison: Comparison) -> tuple[int, str, float]:
    """Zero of the time axis, UTC ns; its unit; and that unit per ns."""
    logs = [run.log for run in comparison.runs]
    if isinstance(comparison.against, Log):
        logs = [comparison.against]
    zero = min(log.start_ns for log in logs)
    long = max(log.end_ns for log in logs) - zero > 4 * HOUR / NANOSECOND
    return zero, "h" if long else "s", NANOSECOND / (HOUR if long else 1.0)


def span(comparison: Comparison, measured: Log, names: list[str], zero: int, scale: float) -> tuple[float, float]:
    """Ends of the time axis: those of the samples compared, else of the measured or the simulated channels shown."""
    runs = comparison.runs
    compared = [run.residuals[name].time_ns for run in runs for name in names if name in run.residuals]
    shown = [times for times in compared if len(times)]
    for logs in ([measured], [run.log for run in runs]):
        shown = shown or [log[name].time_ns for log in logs for name in names if name in log and len(log[name])]
    first, last = min(int(t[0]) for t in shown), max(int(t[-1]) for t in shown)
    margin = max(last - first, round(1.0 / NANOSECOND)) * 0.02
    return (first - zero - margin) * scale, (last - zero + margin) * scale


def drawn_values(channel: Channel) -> NDArray[np.float64]:
    """Values in the table's unit; a heading from 0 to 360 deg, whatever its log's custom."""
    values = channel.values * CHANNELS[channel.name].factor
    return values % 360.0 if channel.name == "heading" else values


def breaks(channel: Channel, values: NDArray[np.float64], max_gap: float) -> NDArray[np.int64]:
    """Where the line through samples is broken: indices of the first sample of each part but the first.

    It is broken where they are further apart than max_gap, s, and than usual, and where an angle goes round.
    """
    steps = np.diff(channel.time_ns) * NANOSECOND
    usual = float(np.median(steps)) if len(steps) else 0.0
    apart = steps > max(max_gap, 3.0 * usual)
    if on_circle(channel.name):
        apart |= np.abs(np.diff(values)) > 180.0
    return np.flatnonzero(apart) + 1


def unit_of(name: str) -> str:
    """The table's unit of a channel; "" where it has none."""
    unit = CHANNELS[name].column_unit
    return "" if unit == "1" else unit
