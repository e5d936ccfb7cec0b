"""How does a Log look in the Rerun viewer? Panels, colours and cameras."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.drawable import hull_size
from glidercli.logio.rerun.colours import BLUE, GREEN, ORANGE

__all__ = ["COLOURS", "blueprint", "series_name"]

Array = NDArray[np.float64]
PLOTS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("Flight", "depth, m (negative down)", ("depth",)),
    ("Flight", "flight phase", ("phase",)),
    ("Flight", "attitude, deg", ("pitch", "roll")),
    ("Flight", "heading, deg clockwise from north", ("heading",)),
    ("Flight", "speed, m/s", ("speed_through_water", "vertical_speed")),
    ("Actuators", "movable mass position, m", ("mass_position",)),
    ("Actuators", "movable mass rotation, deg", ("mass_rotation",)),
    ("Actuators", "net buoyancy, kg (sinking positive)", ("net_buoyancy",)),
    ("Actuators", "ballast volume, cm3 (floating positive)", ("ballast_volume",)),
    ("Actuators", "rudder angle, deg", ("rudder_angle",)),
    ("Water", "temperature, degC", ("temperature", "conservative_temperature")),
    ("Water", "salinity", ("salinity", "absolute_salinity")),
    ("Water", "density, kg/m3", ("density",)),
    ("Water", "conductivity, S/m", ("conductivity",)),
    ("Water", "pressure, dbar", ("pressure",)),
    ("Current", "current, m/s", ("current_east", "current_north", "current_up")),
    ("Motion", "velocity through water in body axes, m/s", ("u", "v", "w")),
    ("Motion", "flow angles, deg", ("angle_of_attack", "sideslip")),
    ("Motion", "body rates, deg/s", ("p", "q", "r")),
    ("Map", "north, east, down of the origin, m", ("north", "east", "down")),
    ("Map", "latitude, deg", ("latitude",)),
    ("Map", "longitude, deg", ("longitude",)),
)
"""Tab, panel title and channels; a panel whose channels the log lacks is left out, and so is a tab without panels."""

COLOURS = {name: colour for *_, names in PLOTS for name, colour in zip(names, (BLUE, ORANGE, GREEN), strict=False)}


def series_name(channel: str) -> str:
    """Name of a channel's line in a plot, with the unit that it is drawn in."""
    unit = "m (negative down)" if channel == "depth" else CHANNELS[channel].column_unit
    return f"{channel.replace('_', ' ')}, {'practical, no unit' if unit == '1' else unit}"


def blueprint(log: Log, span_ns: int, camera: tuple[Array, Array] | None, has_hull: bool, has_plan: bool) -> Any:
    """The rerun Blueprint of a log: 3-D on the left, flight plots in the middle, tabs with the rest on the right.

    log : without empty channels; of one that came in pieces the first. span_ns : length of the whole. camera : where
    the whole track is seen from, None without one. has_hull : whether the attitude is known. has_plan : whether there
    is anything to show from above.
    """
    import rerun.blueprint as rrb

    def named(channel: str, title: str) -> str:
        derived = channel in log and log[channel].origin == "derived"
        return f"{'DERIVED' if derived else log.kind}: {title}"

    def space(name: str, contents: str, **eye: Any) -> Any:
        style = dict[str, Any](line_grid=False, eye_controls=rrb.EyeControls3D(eye_up=(0, 0, -1), **eye))
        return rrb.Spatial3DView(origin="/world", contents=contents.split(", "), name=name, **style)

    left: list[Any] = []
    if camera is not None:
        contents = "+ /world/**, - /world/vehicle/compass/**, - /world/vehicle/body/**"
        title = named("north", "track, north-east-down, m")
        left.append(space(title, contents, position=camera[0], look_target=camera[1]))
    if has_hull:
        length, _, own = hull_size(log)
        contents = "+ /world/vehicle/**, + /world/track, - /world/vehicle/marker"
        title = named("heading", "camera on the hull" + ("" if own else " (not to scale)"))
        eye, hull = (1.0 if left else 1.6) * length * np.array([-0.72, 0.74, -0.7]), "/world/vehicle/body/hull"
        left.append(space(title, contents, position=eye, look_target=(0, 0, 0), tracking_entity=hull))
    tabs: dict[str, list[Any]] = {}
    for tab, title, names in PLOTS:
        if present := [name for name in names if name in log]:
            alone = len(present) < min(len(names), 2)
            tabs.setdefault(tab, []).append(_plot(series_name(present[0]) if alone else title, present))
    if has_plan:
        plan = rrb.Spatial2DView(origin="/plan", name=named("north", "from above, north up, m"))
        tabs["Map"] = [plan, *tabs.get("Map", [])]
    tabs["About"] = [rrb.TextDocumentView(origin="/about", name="about this recording")]
    if log.events:
        tabs["About"].append(rrb.TextLogView(origin="/events", name="events"))
    columns: list[Any] = [rrb.Vertical(*left)] if left else []
    if flight := tabs.pop("Flight", None):
        heights = [0.45 if isinstance(view, rrb.StateTimelineView) else 1.0 for view in flight]
        columns.append(rrb.Vertical(*flight, row_shares=heights))
    shares = [5.0] * bool(left) + [4.0] * bool(flight) + [3.5]
    columns.append(rrb.Tabs(*(rrb.Vertical(*views, name=tab) for tab, views in tabs.items())))
    pace = dict[str, Any](playback_speed=max(1.0, span_ns / 60e9), play_state="paused")
    time = rrb.TimePanel(state="collapsed", timeline="elapsed" if log.origin == "simulated" else "utc", **pace)
    hidden = rrb.BlueprintPanel(state="hidden"), rrb.SelectionPanel(state="hidden")
    return rrb.Blueprint(rrb.Horizontal(*columns, column_shares=shares), time, *hidden)


def _plot(title: str, channels: list[str]) -> Any:
    """A time-series panel over the whole recording, or the band of phases."""
    import rerun as rr
    import rerun.blueprint as rrb

    boundary = rrb.TimeRangeBoundary.infinite()
    axis = rrb.TimeAxis(view_range=rr.TimeRange(start=boundary, end=boundary))
    contents = [f"/{CHANNELS[name].group}/{name}" for name in channels]
    if channels == ["phase"]:
        return rrb.StateTimelineView(origin="/", contents=contents, name=title, time_view=axis)
    legend = rrb.PlotLegend(visible=len(channels) > 1)
    return rrb.TimeSeriesView(origin="/", contents=contents, name=title, axis_x=axis, plot_legend=legend)
