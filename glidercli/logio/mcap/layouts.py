"""What do Foxglove and Lichtblick show of a flight? A layout for each, which their "import from file" takes.

A layout is JSON: `configById` with the settings of each panel under TYPE!NAME, `layout`, a tree of rows and columns of
these names, and what else a viewer saves (`globalVariables`, `userNodes`, `playbackConfig`). Facts: the layout editor's
sources of Lichtblick (lichtblick-suite/lichtblick, packages/suite-base: panels/index.ts has the types, each panel's
types.ts its settings) and of the last open Foxglove Studio, from which it comes (npm @foxglove/studio-base 1.48.0,
MPL-2.0; facts only). The two differ in the key of a panel's title alone.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence, Set
from typing import Any, NamedTuple

import numpy as np

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.mcap.contents import Contents
from glidercli.logio.mcap.primitives import MAP, PLACE
from glidercli.logio.mcap.reader import Together
from glidercli.logio.mcap.topics import field_names
from glidercli.residuals import on_circle

__all__ = ["LAYOUTS", "Sight", "fields_of", "layout", "sight_of"]

LAYOUTS = {
    "foxglove": "Foxglove: 3-D, map, plots, events",
    "lichtblick": "Lichtblick, the open viewer: the same panels",
}
"""Names of the layouts, and what each is for."""
TITLE_KEYS = {"foxglove": "foxglovePanelTitle", "lichtblick": "lichtblickPanelTitle"}

NEAR = ("vehicle", "movable_mass", "rudder", "current", "track", "surface", "bottom")
FAR = ("vehicle", "movable_mass", "rudder", "track", "surface", "bottom", "fixes", "current_profile", "current_average")
"""The topics /viz/NAME that are drawn about the hull, and of the whole flight; a viewer draws none unless told to."""
ON_MAP = {"/map/track", "/glider/fix"}
"""Topics that the map's panel draws."""
MOST = 4
"""Plots above one another."""
COLOURS = ("#4e98e2", "#f5774d", "#5fc27e", "#b98cff", "#f0d05a")
MORE_COLOURS = ("#5ae1cd", "#f06262", "#ff9edb", "#aab2be")

Tree = str | dict[str, Any]


class Sight(NamedTuple):
    """What a camera looks at, in `map`: east, north, up, m; and from how far, m."""

    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    distance: float = 2000.0


def sight_of(log: Log) -> Sight:
    """The whole flight, from its track, else from depth alone; the usual sight where it has neither, or none to see."""
    place = ("north", "east", "down") if {"north", "east", "down"} <= log.channels.keys() else ("depth",)
    north, east, down = ([np.zeros(1), np.zeros(1), *log.together(*place)[1]])[-3:]
    if not len(down):
        return Sight()
    ends = [(float(way.min()), float(way.max())) for way in (east, north, -down)]
    size = math.sqrt(sum((high - low) ** 2 for low, high in ends))
    if not 0.0 < size < 1e7:
        return Sight()
    east_0, north_0, up_0 = (0.5 * (low + high) for low, high in ends)
    return Sight((east_0, north_0, up_0), 1.2 * max(size, 10.0))


def fields_of(log: Log) -> dict[str, set[str]]:
    """The topics that an MCAP of a log has messages of, and the names of their fields."""
    contents = Contents(log)
    topics = [topic for some in contents.samples(log) for topic in some] + contents.whole(log)
    return {
        topic.name: {field.name for field in topic.descriptor.fields} for topic in topics if len(topic.time_ns)
    }  # fmt: skip


def layout(
    name: str,
    sight: Sight | None = None,
    fields: Mapping[str, Set[str]] | None = None,
    together: Together | None = None,
) -> dict[str, Any]:
    """The layout of one of LAYOUTS.

    sight : of the panel that shows the whole flight. fields : topics that there are, with their fields; panels, lines
    and tabs without any are left out. None for all. together : what a file of several flights holds; all of them are
    then drawn and plotted, and their differences from the first.
    """
    panels: dict[str, dict[str, Any]] = {
        "3D!hull": _view(PLACE, "follow-pose", Sight(distance=4.0), NEAR),
        "3D!track": _view(MAP, "follow-none", sight or Sight(), FAR),
        "map!track": {
            "customTileUrl": "", "disabledTopics": [], "followTopic": "", "layer": "map", "topicColors": {},
            "zoomLevel": 11,
        },
        "StateTransitions!phase": {"paths": [_path("/viz/phase.value", "phase")], "isSynced": True},
        "RosOut!log": {"searchTerms": [], "minLogLevel": 1, "topicToRender": "/log"},
        "RawMessages!event": _raw("/glider/event"),
        "RawMessages!navigation": _raw("/glider/navigation"),
        "SourceInfo!topics": {},
        "Plot!depth": {**_plot("depth"), "paths": [_path("/glider/navigation.elevation_m", "-depth", COLOURS[0])]},
        "Plot!attitude": _plot("pitch", "roll"),
        "Plot!heading": _plot("heading"),
        "Plot!rates": _plot("p", "q", "r"),
        "Plot!mass_position": _plot("mass_position"),
        "Plot!angles": _plot("mass_rotation", "rudder_angle"),
        "Plot!buoyancy": _plot("net_buoyancy"),
        "Plot!ballast": _plot("ballast_volume"),
        "Plot!temperature": _plot("temperature", "conservative_temperature"),
        "Plot!salinity": _plot("salinity", "absolute_salinity"),
        "Plot!density": _plot("density"),
        "Plot!conductivity": _plot("conductivity"),
        "Plot!current": _plot("current_east", "current_north", "current_up"),
        "Plot!speed": _plot("speed_through_water", "vertical_speed"),
        "Plot!flow": _plot("angle_of_attack", "sideslip"),
    }  # fmt: skip
    titles = {
        "3D!hull": "hull and movable mass", "3D!track": "track, sea surface, current", "map!track": "map",
        "StateTransitions!phase": "flight phase", "RosOut!log": "log: what this is, events",
        "RawMessages!event": "events", "RawMessages!navigation": "navigation", "SourceInfo!topics": "topics",
        "Plot!depth": "depth, m, negative down", "Plot!attitude": "pitch (nose up), roll (starboard down), deg",
        "Plot!heading": "heading, deg clockwise from north", "Plot!rates": "turn rates about the body axes, deg/s",
        "Plot!mass_position": "movable mass along the hull, m forward", "Plot!angles": "mass rotation, rudder, deg",
        "Plot!buoyancy": "net buoyancy, kg, sinking positive", "Plot!ballast": "ballast volume, cm3",
        "Plot!temperature": "temperature, degC", "Plot!salinity": "practical salinity; absolute, g/kg",
        "Plot!density": "density, kg/m3", "Plot!conductivity": "conductivity, S/m",
        "Plot!current": "current to the east, north and up, m/s",
        "Plot!speed": "speed through water, vertical speed (down), m/s",
        "Plot!flow": "angle of attack, sideslip, deg",
    }  # fmt: skip
    for panel, settings in panels.items():
        settings[TITLE_KEYS[name]] = titles[panel]
    if fields is not None:
        panels = {panel: kept for panel, settings in panels.items() if (kept := _kept(settings, fields)) is not None}
        if not fields.keys() & ON_MAP:
            panels.pop("map!track")
    differences = {} if together is None else _add_others(panels, together, TITLE_KEYS[name])
    trees: dict[str, dict[str, Tree | None]] = {
        "Tab!where": {"track": _column(panels, "3D!track"), "map": _column(panels, "map!track")},
        "Tab!plots": {
            "attitude": _column(panels, "Plot!attitude", "Plot!heading", "Plot!rates"),
            "actuators": _column(panels, "Plot!mass_position", "Plot!angles", "Plot!buoyancy", "Plot!ballast"),
            "water": _column(panels, "Plot!temperature", "Plot!salinity", "Plot!density", "Plot!conductivity"),
            "current": _column(panels, "Plot!current"),
            "motion": _column(panels, "Plot!speed", "Plot!flow"),
            **differences,
        },
        "Tab!words": {
            "log": _column(panels, "RosOut!log"), "events": _column(panels, "RawMessages!event"),
            "navigation": _column(panels, "RawMessages!navigation"), "topics": _column(panels, "SourceInfo!topics"),
        },
    }  # fmt: skip
    for tab, titled in trees.items():
        if shown := {title: tree for title, tree in titled.items() if tree is not None}:
            panels[tab] = _tabs(shown)
    one = {panel: _column(panels, panel) for panel in ("3D!hull", "Plot!depth", "StateTransitions!phase", *trees)}
    left = _split("column", one["3D!hull"], _split("column", one["Tab!where"], one["Tab!words"], 68.0), 42.0)
    above = _split("column", one["Plot!depth"], one["StateTransitions!phase"], 74.0)
    return {
        "configById": panels, "globalVariables": {}, "userNodes": {}, "playbackConfig": {"speed": 5},
        "layout": _split("row", left, _split("column", above, one["Tab!plots"], 42.0), 52.0),
    }  # fmt: skip


def _kept(settings: dict[str, Any], fields: Mapping[str, Set[str]]) -> dict[str, Any] | None:
    """A panel with what there is alone; None without any of it."""
    if "paths" in settings:
        paths = [path for path in settings["paths"] if _is_there(path["value"], fields)]
        return {**settings, "paths": paths} if paths else None
    if "topics" in settings:
        topics = {topic: style for topic, style in settings["topics"].items() if topic in fields}
        return {**settings, "topics": topics} if topics else None
    topic = settings.get("topicPath", settings.get("topicToRender"))
    return settings if topic is None or topic in fields else None


def _is_there(path: str, fields: Mapping[str, Set[str]]) -> bool:
    topic, field = path.split(".")
    return field in fields.get(topic, ())


def _add_others(panels: dict[str, dict[str, Any]], together: Together, title_key: str) -> dict[str, Tree | None]:
    """Draw and plot the flights beside the first, too; the tabs of their differences from it.

    panels : those of the first flight, which are added to. title_key : of a panel's title.
    """
    for panel, settings in panels.items():
        if panel.startswith("3D!"):
            topics = [f"/beside/{number}{topic}" for number in together.names for topic in settings["topics"]]
            settings["topics"] |= {topic: {"visible": True} for topic in topics if topic in together.topics}
        elif "paths" in settings:
            settings["paths"] += list(_of_others(settings["paths"], together))
    tabs: dict[str, Tree | None] = {}
    for group in dict.fromkeys(spec.group for spec in CHANNELS.values()):
        plots = []
        for spec in (spec for spec in CHANNELS.values() if spec.group == group):
            paths = [
                {
                    **_path(
                        f"/difference/{number}/{spec.name}.{spec.column}", f"{called} less the first", _shade(number)
                    ),
                    "showLine": not on_circle(spec.name),
                }
                for number, called in together.names.items()
                if f"/difference/{number}/{spec.name}" in together.topics
            ]
            if paths:
                title = f"difference: {spec.name.replace('_', ' ')}, {spec.column_unit}"
                panels[f"Plot!difference_{spec.name}"] = {**_drawn(paths), title_key: title}
                plots.append(f"Plot!difference_{spec.name}")
        for first in range(0, len(plots), MOST):
            title = f"{group} differences" + (f" {first // MOST + 1}" if first else "")
            tabs[title] = _column(panels, *plots[first : first + MOST])
    return tabs


def _of_others(paths: Sequence[dict[str, Any]], together: Together) -> Iterator[dict[str, Any]]:
    """The same message paths of the flights beside the first, where they have the topic; lines in other colours."""
    for number, called in together.names.items():
        for place, path in enumerate(paths):
            value = f"/beside/{number}{path['value']}"
            if value.split(".")[0] in together.topics:
                drawn = {"color": _shade(len(paths) * number + place)} if "color" in path else {}
                yield {**path, "value": value, "label": f"{path['label']}, {called}", **drawn}


def _shade(number: int) -> str:
    """A colour for the line of a flight beside the first."""
    shades = (*COLOURS, *MORE_COLOURS)
    return shades[number % len(shades)]


def _view(frame: str, follow: str, sight: Sight, shown: tuple[str, ...]) -> dict[str, Any]:
    """A 3-D panel with its third axis up, seen from the south-west and 24 deg above."""
    eye = {
        "perspective": True, "distance": sight.distance, "phi": 66.0, "thetaOffset": 40.0, "target": [0.0, 0.0, 0.0],
        "targetOffset": list(sight.centre), "targetOrientation": [0.0, 0.0, 0.0, 1.0], "fovy": 45.0,
        "near": 0.01 * sight.distance, "far": max(200_000.0, 10.0 * sight.distance),
    }  # fmt: skip
    return {
        "cameraState": eye, "followMode": follow, "followTf": frame, "layers": {}, "imageMode": {},
        "scene": {"transforms": {"showLabel": False, "axisScale": 0.0, "lineWidth": 0.0, "enablePreloading": True}},
        "transforms": {}, "topics": {f"/viz/{name}": {"visible": True} for name in shown},
    }  # fmt: skip


def _plot(*names: str) -> dict[str, Any]:
    """A plot of channels against time, in the units for people."""
    paths = []
    for name, shade in zip(names, COLOURS, strict=False):
        spec = CHANNELS[name]
        label = name.replace("_", " ")
        paths.append(_path(f"/glider/{spec.group}.{field_names(spec)[-1]}", label, shade))
    return _drawn(paths)


def _drawn(paths: list[dict[str, Any]]) -> dict[str, Any]:
    """A plot of message paths against time."""
    return {
        "paths": paths, "showXAxisLabels": True, "showYAxisLabels": True, "showLegend": True,
        "legendDisplay": "floating", "showPlotValuesInLegend": False, "isSynced": True, "xAxisVal": "timestamp",
        "sidebarDimension": 240,
    }  # fmt: skip


def _path(value: str, label: str, shade: str | None = None) -> dict[str, Any]:
    path: dict[str, Any] = {"value": value, "enabled": True, "timestampMethod": "receiveTime", "label": label}
    return path if shade is None else {**path, "color": shade, "showLine": True}


def _raw(topic: str) -> dict[str, Any]:
    return {
        "topicPath": topic, "diffEnabled": False, "diffMethod": "custom", "diffTopicPath": "",
        "showFullMessageForDiff": False,
    }  # fmt: skip


def _tabs(tabs: dict[str, Tree]) -> dict[str, Any]:
    return {"activeTabIdx": 0, "tabs": [{"title": title, "layout": tree} for title, tree in tabs.items()]}


def _split(direction: str, first: Tree | None, second: Tree | None, percentage: float) -> Tree | None:
    """Two panels or trees beside each other; one of them where the other is not there."""
    if first is None or second is None:
        return second if first is None else first
    return {"direction": direction, "first": first, "second": second, "splitPercentage": percentage}


def _column(panels: Collection[str], *names: str) -> Tree | None:
    """Those of some that are among the panels above each other, of equal height; None where none is."""
    present = [name for name in names if name in panels]
    if not present:
        return None
    return _split("column", present[0], _column(panels, *present[1:]), 100.0 / len(present))
