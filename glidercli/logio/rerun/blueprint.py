"""How does a Log look in the Rerun viewer? Panels for what it holds, and none for what it does not."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.drawable import hull_size, moves_mass
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun import panels
from glidercli.logio.rerun.axes import Extent, axis
from glidercli.logio.rerun.sea import Sea, in_words
from glidercli.logio.rerun.sections import TALL, Section

__all__ = ["Shown", "blueprint"]

LONGEST = 40
"""Signs of a vehicle's name that a title has room for."""


@dataclasses.dataclass(frozen=True)
class Shown:
    """What there is to show beside the channels.

    span_ns : length of the whole. sea : surroundings of the track, None without one. has_hull : whether the attitude is
    known. zoom : of the map, None without one. phases : names of those that depth is coloured by. extents : of the
    values of channels; none of a log that grows, whose axes grow with it.
    """

    span_ns: int
    sea: Sea | None
    has_hull: bool
    zoom: float | None
    phases: Sequence[str] = ()
    sections: Sequence[Section] = ()
    current: bool = False
    extents: Mapping[str, Extent] = dataclasses.field(default_factory=dict)


def blueprint(log: Log, shown: Shown) -> Any:
    """The rerun Blueprint of a log: 3-D on the left, flight plots in the middle, tabs with the rest on the right.

    log : without empty channels; of one that came in pieces the first.
    """
    import rerun.blueprint as rrb

    left: list[Any] = []
    if shown.sea is not None:
        left.append(_overview(log, shown, shown.sea))
    if shown.has_hull:
        path = "/world/path" if shown.sea is not None else None
        left.append(panels.hull_view(_hull_title(log), "/world/vehicle", hull_size(log)[0], path))
    plots = {tab: _plots(tab, log, shown) for tab in dict.fromkeys(tab for tab, *_ in panels.PLOTS)}
    flight = plots.pop("Flight", [])
    tabs = {tab: plots.pop(tab, []) for tab in ("Actuators", "Sections", "CTD", "Map", "Current", "Motion")}
    tabs["Sections"] = [
        _section(section, axis(["depth"], shown.extents, len(shown.sections))) for section in shown.sections
    ]
    if shown.zoom is not None:
        title = "track and fixes; map from the network"
        tabs["Map"] = [rrb.MapView(origin="/map", zoom=shown.zoom, name=title)]
    tabs |= panels.told(["/events"] if log.events else [])
    columns: list[Any] = [rrb.Vertical(*left, row_shares=[1.25, 1.0][: len(left)])] if left else []
    if flight:
        columns.append(rrb.Vertical(*flight, row_shares=[1.3, 1.0, 1.0, 1.0][: len(flight)]))
    columns.append(rrb.Tabs(*(rrb.Vertical(*views, name=tab) for tab, views in tabs.items() if views), active_tab=0))
    shares = panels.LEFT[len(left)] + [3.8] * bool(flight) + [4.1]
    whole = rrb.Horizontal(*columns, column_shares=shares)
    return rrb.Blueprint(whole, panels.clock(log, shown.span_ns), *panels.hidden())


def _plots(tab: str, log: Log, shown: Shown) -> list[Any]:
    """The plots over time of a tab that the log has channels for."""
    held = [
        (title, unit, [name for name in names if name in log]) for of, title, unit, names in panels.PLOTS if of == tab
    ]
    held = [one for one in held if one[2]]
    views = []
    for title, unit, present in held:
        words = panels.with_unit(title, unit, present, log)
        if present == ["depth"] and shown.phases:
            words = f"depth, m: {_words_of(shown.phases)}"
        contents = [f"/{CHANNELS[name].group}/{name}" for name in present]
        views.append(
            panels.over_time(words, contents, axis(present, shown.extents, len(held) - (present == ["depth"]) or 1))
        )
    return views


def _words_of(phases: Sequence[str]) -> str:
    """The colours of phases; of the short ones between dive and climb the page tells."""
    order = [name for name in ("dive", "climb", "surface", "hover") if name in phases] or [*phases]
    return ", ".join(f"{name} {look.NAMES[look.PHASE_COLOURS[name]]}" for name in order)


def _hull_title(log: Log) -> str:
    """Whose hull is drawn, and what moves in it."""
    own = hull_size(log)[2]
    name = "".join(sign for sign in log.metadata.get("vehicle", "its own") if sign.isprintable())
    whose = f"{name[:LONGEST]} hull" if own else "generic hull, not to scale"
    return f"{log.kind} attitude{'; red: mass' if moves_mass(log) else ''}; {whose}"


def _overview(log: Log, shown: Shown, sea: Sea) -> Any:
    """The whole track; where the water is known, in tabs, once for each quantity in its colours."""
    import rerun.blueprint as rrb

    kind = "DERIVED" if "north" in log and log["north"].origin == "derived" else log.kind
    drawn = "" if sea.exaggeration == 1.0 else f", depth drawn x {sea.exaggeration:g}"
    grid = f"grid {in_words(sea.spacing)}"
    sights = ["+ /world/**", "- /world/vehicle/**", "+ /world/vehicle", "+ /world/vehicle/marker"]
    sights += ["+ /world/vehicle/plumb", "- /world/water/**", "- /world/path"]
    arrows = ", arrows: current" if shown.current else ""

    track = panels.space(f"{kind} track{drawn}, {grid}{arrows}", "/", sights, *sea.camera)
    placed = [section for section in shown.sections if section.world is not None]
    if not placed:
        return track
    tabs: list[Any] = [rrb.Vertical(track, name="Track")]
    for section in placed:
        contents = [*sights, "- /world/track", "- /world/current", f"+ {section.world}"]
        view = panels.space(f"{section.title}{drawn}, {grid}", "/", contents, *sea.beside_bar)
        name = section.name.replace("_", " ").capitalize()
        tabs.append(rrb.Horizontal(view, _key(section), column_shares=[6.0, 1.0], name=name))
    return rrb.Tabs(*tabs, active_tab=0)


def _section(section: Section, depths: Extent | None) -> Any:
    """Depth over time in the colours of a quantity, and their bar."""
    import rerun.blueprint as rrb

    plot = panels.over_time(f"{section.title}, over depth, m", [section.over_time], depths)
    return rrb.Horizontal(plot, _key(section), column_shares=[5.0, 1.0])


def _key(section: Section) -> Any:
    import rerun.blueprint as rrb

    bounds = rrb.VisualBounds2D(x_range=(-6.0, 80.0), y_range=(-40.0, TALL + 12.0))
    style = dict[str, Any](visual_bounds=bounds, background=look.BACKGROUND, titlebar=False)
    return rrb.Spatial2DView(origin=section.key, name=panels.unit_of(section.name), **style)
