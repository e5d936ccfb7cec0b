"""What does a flight look like? One figure: depth, attitude and controls by time, the track, and the water by depth.

What the instruments of a flight do not record is left out; the track is then that of the fixes.
"""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.channels import CHANNELS
from glidercli.errors import OutputError
from glidercli.log import Log
from glidercli.pictures import COLOURS, WIDTH
from glidercli.places import track_of_geodetic

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["draw_flight"]

_HEIGHT = 8.2  # inch
_SPANS = ((300.0, 1.0, "s"), (3 * 3600.0, 60.0, "min"), (4 * 86400.0, 3600.0, "h"), (np.inf, 86400.0, "d"))
"""Unit of the time axis up to a duration, s."""
_MOST_SWINGS = 200  # of a line through its middle that a panel of this width still shows one by one
_BANDS = 400  # steps of a band
_ROWS: tuple[tuple[str, float, tuple[tuple[str, str, float], ...]], ...] = (
    ("depth, m", 1.0, (("depth", "", 1.0),)),
    ("deg", 2.0, (("pitch", "pitch", 1.0), ("roll", "roll", 1.0))),
    ("heading, deg", 2.0, (("heading", "", 1.0),)),
    ("mass position, mm", 1.0, (("mass_position", "", 1e3),)),
    ("mass rotation, deg", 2.0, (("mass_rotation", "", 1.0),)),
    ("net buoyancy, kg", 0.02, (("net_buoyancy", "", 1.0),)),
)
"""Panels by time: label and least span of the axis; its channels, with their name in the legend and a factor."""


def draw_flight(log: Log) -> Figure:
    """The figure of a simulated flight; OutputError for a log of less than two samples."""
    from matplotlib.figure import Figure

    if len(log["phase"]) < 2:
        raise OutputError("figure", "not drawn: the flight has less than two samples")
    figure = Figure(figsize=(WIDTH, _HEIGHT), layout="constrained")
    figure.suptitle("\n".join(textwrap.wrap(f"{log.kind}: {log.metadata.get('title', 'flight')}", 100)), fontsize=8.5)
    halves: Any = figure.subfigures(1, 2, width_ratios=[1.45, 1.0])
    left, right = halves
    shown = [row for row in _ROWS if all(name in log and len(log[name]) for name, _, _ in row[2])]
    rows = left.subplots(len(shown), 1, sharex=True)
    duration = (log.end_ns - log.start_ns) / 1e9
    _, unit, word = next(span for span in _SPANS if duration <= span[0])
    for axes, (label, least, lines) in zip(rows, shown, strict=True):
        for (name, legend, factor), colour in zip(lines, COLOURS[1:], strict=False):
            seconds, values = _series(log, name)
            _line(axes, seconds / unit, _broken(name, values * factor), least, color=colour, label=legend)
        axes.set_ylabel(label)
        _widen(axes, least)
        if len(lines) > 1:
            _legend_above(axes)
    deep = shown[0][2][0][0] == "depth"
    if deep:
        rows[0].invert_yaxis()
    rows[-1].set_xlabel(f"time, {word}")
    left.align_ylabels()
    if deep:
        _mark(rows[0], log, unit)
    track, water = right.subplots(2, 1)
    _track(track, log)
    _water(water, log)
    return figure


def _series(log: Log, name: str) -> tuple[Any, Any]:
    """Seconds since the start, and values in the table's unit."""
    channel = log[name]
    return (channel.time_ns - log.start_ns) / 1e9, channel.values * CHANNELS[name].factor


def _broken(name: str, values: Any) -> Any:
    """The values, parted with NaN where an angle passes from one end of its circle to the other."""
    if not CHANNELS[name].circular:
        return values
    broken = np.array(values)
    broken[1:][np.abs(np.diff(values)) > 180.0] = np.nan
    return broken


def _line(axes: Axes, seconds: Any, values: Any, least: float, *, color: str, label: str) -> None:
    """A line by time; what goes to and fro too often to be told apart, by more than ``least``, is the band it fills."""
    low, high = np.nanmin(values), np.nanmax(values)
    swings = np.count_nonzero(np.diff(values > 0.5 * (low + high)))
    if high - low < least or swings < _MOST_SWINGS or np.isnan(values).any():
        axes.plot(seconds, values, color=color, linewidth=0.9, label=label)
        return
    edges = np.unique(np.linspace(0, len(values), _BANDS + 1).astype(int))[:-1]
    low, high = np.minimum.reduceat(values, edges), np.maximum.reduceat(values, edges)
    axes.fill_between(seconds[edges], low, high, color=color, alpha=0.35, linewidth=0.6, label=label)


def _legend_above(axes: Axes) -> None:
    """The legend on top of the panel's right end, clear of what it shows."""
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        borderaxespad=0.1,
        borderpad=0.1,
        frameon=False,
        ncols=3,
        handlelength=1.2,
        handletextpad=0.4,
        columnspacing=1.0,
    )


def _widen(axes: Axes, least: float) -> None:
    """Open the axis to a span, so that what does not change is not drawn by its rounding."""
    low, high = axes.get_ylim()
    if high - low < least:
        axes.set_ylim(0.5 * (low + high - least), 0.5 * (low + high + least))


def _mark(axes: Axes, log: Log, unit: float) -> None:
    """Where dives turn and where the vehicle surfaces or grounds, unless that is too often to be told apart."""
    for name, marker in (("apogee", "v"), ("surfacing", "^"), ("grounding", "x")):
        at = [(event.time_ns - log.start_ns, event.depth) for event in log.events if event.name == name]
        if 0 < len(at) < _MOST_SWINGS / 2:
            times, depths = zip(*at, strict=True)
            axes.plot(
                np.array(times) / 1e9 / unit, depths, marker, color="black", markersize=3.5, label=name, linestyle=""
            )
    if axes.get_legend_handles_labels()[1]:
        _legend_above(axes)


def _track(axes: Axes, log: Log) -> None:
    """The track over ground from above, in m or km."""
    if "north" not in log:
        _fixes(axes, log)
        return
    (_, north), (_, east) = _series(log, "north"), _series(log, "east")
    far = max(np.ptp(north), np.ptp(east)) > 5000.0
    scale, unit = (1e-3, "km") if far else (1.0, "m")
    axes.plot(east * scale, north * scale, color=COLOURS[1], linewidth=0.9)
    axes.plot(east[0] * scale, north[0] * scale, "o", color="black", markersize=4, label="start")
    axes.plot(east[-1] * scale, north[-1] * scale, "s", color=COLOURS[0], markersize=4, label="end")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(f"east, {unit}")
    axes.set_ylabel(f"north, {unit}")
    axes.set_title("track over ground", loc="left")
    axes.locator_params(axis="x", nbins=5)
    _legend_above(axes)


def _fixes(axes: Axes, log: Log) -> None:
    """Where the GPS saw the vehicle, in m north and east of the log's origin."""
    _, (latitude, longitude) = log.together("latitude", "longitude")
    if not len(latitude) or log.place is None:
        axes.set_axis_off()
        axes.set_title("no fix", loc="left")
        return
    north, east = track_of_geodetic(latitude, longitude, *log.place)
    axes.plot(east, north, ".", color=COLOURS[1], markersize=3)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("east, m")
    axes.set_ylabel("north, m")
    axes.set_title(f"{len(latitude):,} fix{'es' if len(latitude) > 1 else ''}", loc="left")
    axes.locator_params(axis="x", nbins=5)


def _water(axes: Axes, log: Log) -> None:
    """Current or density that the vehicle met, by depth; its speed where the water is all the same."""
    axes.invert_yaxis()
    axes.locator_params(axis="x", nbins=5)
    axes.set_ylabel("depth, m")
    if "current_east" in log:
        for name, colour in (("current_east", COLOURS[0]), ("current_north", COLOURS[1])):
            _by_depth(axes, log, name, colour, name[8:])
        axes.set_xlabel("current, m/s")
        axes.set_title("current met", loc="left")
        _legend_above(axes)
    elif "pressure" in log and "density" in log:
        _by_depth(axes, log, "density", COLOURS[2])
        axes.set_xlabel("density, kg/m$^3$")
        axes.set_title("water met", loc="left")
    elif "speed_through_water" in log:
        _by_depth(axes, log, "speed_through_water", COLOURS[2])
        axes.set_xlabel("speed through water, m/s")
        axes.set_title("speed by depth", loc="left")
    else:
        axes.set_axis_off()
        axes.set_title("water: not recorded", loc="left")


def _by_depth(axes: Axes, log: Log, name: str, colour: str, label: str = "") -> None:
    """A channel by depth, where both have a sample."""
    _, (values, depth) = log.together(name, "depth")
    axes.plot(values, depth, color=colour, linewidth=0.9, label=label)
