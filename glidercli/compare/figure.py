"""What does a comparison look like? A panel a channel, both sides overlaid, the error beneath; or published bands."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli import pictures
from glidercli.compare.bands import BAND, draw_facts
from glidercli.compare.drawn import TURNED, breaks, clock, drawn_values, panels, span, unit_of
from glidercli.compare.facts import Facts
from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.residuals import table_values

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from glidercli.compare.comparison import Comparison, Side

__all__ = ["figure", "save"]

MOST_PANELS = 8
"""Panels that stay legible on one page; a figure shows the first ones and says how many it leaves out."""

MEASURED = "#000000"
SIMULATED = pictures.COLOURS
STYLES: tuple[Any, ...] = ("-", (0, (4, 1.5)), "-.", ":")

_FOOT = 120
"""Characters of a line at the foot."""


def figure(comparison: Comparison) -> Figure:
    """The comparison as a matplotlib figure; drawn without a display."""
    with pictures.drawing():
        return _drawn(comparison)


def save(comparison: Comparison, path: Path, description: str) -> None:
    """Write the figure; the ending of ``path`` picks PNG, SVG or PDF; ``description`` is kept in its metadata."""
    pictures.save(lambda: _drawn(comparison), path, description)


def _drawn(comparison: Comparison) -> Figure:
    from matplotlib.figure import Figure

    names = panels(comparison)
    if not names:
        raise InputError(comparison.runs[0].side.name, "has none of the channels that the figure would show")
    left_out, names = len(names) - len(names[:MOST_PANELS]), names[:MOST_PANELS]
    measured = comparison.against if isinstance(comparison.against, Log) else None
    columns = 1 if len(names) == 1 else 2
    rows = -(-len(names) // columns)
    head = 0.3 + 0.16 * (len(comparison.runs) + 1)
    panel = 2.45 if measured is not None else 1.9
    remarks = _remarks(comparison, left_out)
    foot = 0.45 + 0.13 * (len(remarks) + (measured is None))  # facts may add a line on those not drawn
    height = head + rows * panel + foot
    drawing = Figure(figsize=(pictures.WIDTH, height))
    grid = drawing.add_gridspec(
        rows, columns, left=0.1, right=0.985, top=1.0 - head / height, bottom=foot / height,
        hspace=0.24 if measured is not None else 0.3, wspace=0.28,
    )  # fmt: skip
    zero, unit, scale = clock(comparison)
    main: dict[str, Axes] = {}
    lowest = []
    for number, name in enumerate(names):
        cell = grid[number // columns, number % columns]
        if any(name in run.residuals and len(run.residuals[name].error) for run in comparison.runs):
            inner = cell.subgridspec(2, 1, height_ratios=(2.2, 1.0), hspace=0.09)
            axes = drawing.add_subplot(inner[0])
            beneath = drawing.add_subplot(inner[1], sharex=axes)
            axes.tick_params(labelbottom=False)
            _errors(beneath, comparison, name, zero, scale)
            lowest.append(beneath)
        else:
            axes = drawing.add_subplot(cell)
            lowest.append(axes)
        _curves(axes, comparison, name, zero, scale)
        main[name] = axes
    since = "the first log's first sample" if measured is not None else "the first sample"
    if measured is not None:
        for axes in lowest:
            axes.set_xlim(span(comparison, measured, names, zero, scale))
    for axes in lowest[-columns:]:
        axes.set_xlabel(f"time, {unit}, from {since}")
    notes: list[str] = []
    if isinstance(comparison.against, Facts):
        notes += draw_facts(main, comparison.runs, zero, scale)
        ends = [axes.get_xlim() for axes in main.values()]  # a published time may lie beyond the simulated ones
        for axes in main.values():
            axes.set_xlim(min(left for left, _ in ends), max(right for _, right in ends))
    for column in range(columns):
        drawing.align_ylabels([*list(main.values())[column::columns], *lowest[column::columns]])
    _heading(drawing, comparison, height, [*remarks, *notes])
    return drawing


def _remarks(comparison: Comparison, left_out: int) -> list[str]:
    """Lines at the foot: what is reconstructed, what to know of the errors, how many channels are not shown."""
    sides = [comparison.measured, *(run.side for run in comparison.runs)]
    said = [f"Reconstruction: {side.reconstruction}" for side in sides if side.reconstruction]
    said += [f"{note}." for run in comparison.runs for note in run.notes]
    said += [f"{left_out} more channels are not shown."] if left_out else []
    return [line for text in dict.fromkeys(said) for line in textwrap.wrap(text, _FOOT)]


def _curves(axes: Axes, comparison: Comparison, name: str, zero: int, scale: float) -> None:
    """One channel of every log that has it."""
    added_up = isinstance(comparison.against, Facts)  # a published turn may be more than a circle
    if isinstance(comparison.against, Log) and name in comparison.against:
        channel = comparison.against[name]
        _line(axes, channel, drawn_values(channel), zero, scale, comparison.max_gap, MEASURED, "-", 1.6)
    for number, run in enumerate(comparison.runs):
        if name in run.log and len(run.log[name]):
            channel = run.log[name]
            values = table_values(channel) if added_up else drawn_values(channel)
            _line(axes, channel, values, zero, scale, comparison.max_gap, *_look(number), 1.1)
    axes.set_title(name.replace("_", " "), loc="left", pad=3)
    axes.set_ylabel("deg, turns added up" if added_up and name == "heading" else unit_of(name))
    if name in TURNED:
        axes.invert_yaxis()


def _line(
    axes: Axes, channel: Channel, values: NDArray[np.float64], zero: int, scale: float, max_gap: float, colour: str,
    style: Any, width: float,
) -> None:  # fmt: skip
    """A line through the samples, broken as ``breaks`` says; few get dots."""
    time = (channel.time_ns - zero) * scale
    broken = breaks(channel, values, max_gap)
    axes.plot(
        np.insert(time, broken, np.nan), np.insert(values, broken, np.nan), color=colour, linestyle=style,
        linewidth=width, marker="." if len(time) <= 60 else "", markersize=3.0,
    )  # fmt: skip


def _errors(axes: Axes, comparison: Comparison, name: str, zero: int, scale: float) -> None:
    """Simulated less measured, on the measured samples' times."""
    axes.axhline(0.0, color=MEASURED, linewidth=0.6)
    drawn = np.zeros(0)
    for number, run in enumerate(comparison.runs):
        if name in run.residuals and len(run.residuals[name].error):
            both = run.residuals[name]
            channel = Channel(name, both.time_ns, both.error)
            drawn = np.concatenate([drawn, both.measured])
            _line(axes, channel, both.error, zero, scale, comparison.max_gap, *_look(number), 0.9)
    low, high = axes.get_ylim()
    least = 1e-6 * float(np.ptp(drawn))
    axes.locator_params(axis="y", nbins=4)
    if high - low < least:  # rounding errors are no signal
        axes.set_ylim(-least, least)
        axes.set_yticks([0.0])
    axes.set_ylabel(f"error, {unit_of(name)}".rstrip(", "))
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:.4g}".replace("-", "−"))


def _look(number: int) -> tuple[str, Any]:
    """Colour and line style of a simulated log, each other than its neighbour's."""
    return SIMULATED[number % len(SIMULATED)], STYLES[number % len(STYLES)]


def _heading(drawing: Figure, comparison: Comparison, height: float, notes: list[str]) -> None:
    """Legend with the origin of each side at the top, notes at the foot."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    entries: list[Any] = []
    if isinstance(comparison.against, Facts):
        label = _shortened(f"published, with tolerance: {comparison.against.source}")
        entries.append(Patch(color=BAND, alpha=0.45, linewidth=0, label=label))
    else:
        entries.append(Line2D([], [], color=MEASURED, linewidth=1.6, label=_label(comparison.measured)))
    for number, run in enumerate(comparison.runs):
        colour, style = _look(number)
        entries.append(Line2D([], [], color=colour, linestyle=style, linewidth=1.1, label=_label(run.side)))
    drawing.legend(
        handles=entries, loc="upper left", bbox_to_anchor=(0.09, 1.0 - 0.04 / height), frameon=False, ncols=1,
        borderaxespad=0.0, handlelength=2.2, labelspacing=0.35,
    )  # fmt: skip
    for number, line in enumerate(reversed(notes)):
        drawing.text(0.1, (0.05 + 0.13 * number) / height, _shortened(line, _FOOT), fontsize=6.5, va="bottom")


def _label(side: Side) -> str:
    """Origin first, since it matters more than the name; what was reconstructed stands at the foot."""
    return _shortened(f"{side.kind.partition(':')[0]}: {side.name}")


def _shortened(line: str, most: int = 95) -> str:
    return line if len(line) <= most else line[: most - 1] + "…"
