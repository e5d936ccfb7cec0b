"""What panels can a recording have in Rerun? Lines over time with their units, flights in three dimensions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.axes import Extent

__all__ = [
    "ASPECT", "COLOURS", "LEFT", "PLOTS", "clock", "events", "hidden", "hull_view", "over_time", "series_name", "space",
    "told", "unit_of", "with_unit",
]  # fmt: skip

Array = NDArray[np.float64]
PLOTS: tuple[tuple[str, str, str, tuple[str, ...]], ...] = (
    ("Flight", "depth", "m (negative down)", ("depth",)),
    ("Flight", "", "deg", ("pitch", "roll")),
    ("Flight", "heading", "deg clockwise from true north", ("heading",)),
    ("Flight", "", "m/s", ("speed_through_water", "vertical_speed")),
    ("Actuators", "movable mass, position", "m forward", ("mass_position",)),
    ("Actuators", "movable mass, rotation", "deg", ("mass_rotation",)),
    ("Actuators", "net buoyancy", "kg (sinking positive)", ("net_buoyancy",)),
    ("Actuators", "ballast volume", "cm3 (floating positive)", ("ballast_volume",)),
    ("Actuators", "rudder angle", "deg (to starboard positive)", ("rudder_angle",)),
    ("CTD", "", "degC", ("temperature", "conservative_temperature")),
    ("CTD", "salinity", "PSS-78", ("salinity",)),
    ("CTD", "absolute salinity", "g/kg", ("absolute_salinity",)),
    ("CTD", "density", "kg/m3", ("density",)),
    ("CTD", "conductivity", "S/m", ("conductivity",)),
    ("CTD", "pressure", "dbar", ("pressure",)),
    ("Current", "current:", "m/s", ("current_east", "current_north", "current_up")),
    ("Motion", "velocity through water in body axes:", "m/s", ("u", "v", "w")),
    ("Motion", "", "deg", ("angle_of_attack", "sideslip")),
    ("Motion", "turn rates about body axes:", "deg/s", ("p", "q", "r")),
    ("Motion", "", "m from the origin", ("north", "east", "down")),
    ("Motion", "latitude", "deg", ("latitude",)),
    ("Motion", "longitude", "deg", ("longitude",)),
)
"""Tab, title, unit and channels; a panel whose channels the log lacks is left out, and so is a tab without panels.

Where the title is empty, or ends in a colon, the channels are named in it, each with the colour of its line.
"""

COLOURS = {
    name: colour
    for *_, names in PLOTS
    for name, colour in zip(names, (look.BLUE, look.ORANGE, look.GREEN), strict=False)
}
"""Of each channel's line."""
LEFT: tuple[list[float], ...] = ([], [6.0], [4.6])
ASPECT = (0.0, 0.8, 1.0)
"""Share in the width of as many panels in three dimensions, and the width to height of the upper one."""
WORDS = {"vertical_speed": "sinking", "speed_through_water": "speed in water"}
"""What channels are called where their own name is long."""


def series_name(channel: str) -> str:
    """Name of a channel's line in a plot, with the unit that it is drawn in."""
    unit = "m (negative down)" if channel == "depth" else unit_of(channel)
    return f"{_word(channel)}, {unit}"


def unit_of(name: str) -> str:
    """Unit that a channel is drawn in; of practical salinity, which has none, its scale."""
    unit = CHANNELS[name].column_unit
    return "PSS-78" if unit == "1" else unit


def _word(channel: str) -> str:
    return WORDS.get(channel, channel.replace("_", " "))


def with_unit(title: str, unit: str, names: Sequence[str], log: Log) -> str:
    """Title of a plot: what is drawn, in which colour, derived or not, in which unit."""
    derived = [name for name in names if log[name].origin == "derived" != log.origin]
    whole = len(derived) == len(names)
    words = title
    if not title or title.endswith(":"):
        each = []
        for name in names:
            notes = [look.NAMES[COLOURS[name]]] if len(names) > 1 else []
            notes += ["derived"] if name in derived and not whole else []
            word = _word(name).removeprefix(title.replace(":", " "))
            each.append(f"{word} ({', '.join(notes)})" if notes else word)
        words = f"{title} {', '.join(each)}".strip()
    return f"{words}, {unit}" + (", derived" if whole else "")


def over_time(title: str, contents: Sequence[str], values: Extent | None, legend: bool = False) -> Any:
    """A time-series panel over the whole recording. values : ends of its axis; None where they change with time."""
    import rerun as rr
    import rerun.blueprint as rrb

    edge = rrb.TimeRangeBoundary.infinite()
    axis = rrb.TimeAxis(view_range=rr.TimeRange(start=edge, end=edge))
    corner = rrb.PlotLegend(rrb.Corner2D.RightBottom, visible=legend)
    style = dict[str, Any](axis_x=axis, plot_legend=corner)
    if values is not None:
        style["axis_y"] = rrb.ScalarAxis(range=values)
    return rrb.TimeSeriesView(origin="/", contents=[*contents], name=title, **style)


def space(title: str, origin: str, contents: Sequence[str], eye: Array, target: Array) -> Any:
    """A panel in three dimensions."""
    import rerun.blueprint as rrb

    controls = rrb.EyeControls3D(position=eye, look_target=target, eye_up=(0, 0, -1))
    style = dict[str, Any](line_grid=False, background=look.BACKGROUND, eye_controls=controls)
    return rrb.Spatial3DView(origin=origin, contents=[*contents], name=title, **style)


def hull_view(title: str, vehicle: str, length: float, path: str | None = None, abreast: int = 1) -> Any:
    """The hull from its port side; the camera goes with it and turns with its heading.

    path : entity of a thin line along the track. abreast : how many such panels share the width of one.
    """
    contents = [f"+ {vehicle}/**", f"- {vehicle}/marker", f"- {vehicle}/plumb"]
    contents += [f"+ {path}"] if path else []
    eye = length * (0.2 + 0.8 * abreast) * np.array([-0.3, -1.12, -0.42])
    return space(title, f"{vehicle}/course", contents, eye, np.array([0.0, 0.0, 0.04 * length]))


def events(contents: Sequence[str]) -> Any:
    """Events with their times."""
    import rerun.blueprint as rrb

    columns = rrb.TextLogColumns(text_log_columns=[rrb.encodings.TextLogColumn(kind="body", visible=True)])
    return rrb.TextLogView(origin="/", contents=[*contents], name="events", columns=columns)


def told(events_of: Sequence[str]) -> dict[str, list[Any]]:
    """The tab of texts: the page about the recording, and the events of entities."""
    import rerun.blueprint as rrb

    page = rrb.TextDocumentView(origin="/about", name="about this recording")
    return {"About": [page, events(events_of)] if events_of else [page]}


def clock(log: Log, span_ns: int) -> Any:
    """The time panel: the whole plays in a minute."""
    import rerun.blueprint as rrb

    pace = dict[str, Any](playback_speed=max(1.0, span_ns / 60e9), play_state="paused")
    return rrb.TimePanel(state="collapsed", timeline="elapsed" if log.origin == "simulated" else "utc", **pace)


def hidden() -> tuple[Any, Any]:
    """The panels of the viewer that are not opened."""
    import rerun.blueprint as rrb

    return rrb.BlueprintPanel(state="hidden"), rrb.SelectionPanel(state="hidden")
