"""How do several Logs look side by side in the Rerun viewer? One scene, overlaid plots, and their differences."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.drawable import hull_size
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun import panels
from glidercli.logio.rerun.axes import Extent, axis, extent, joined
from glidercli.logio.rerun.differences import Difference
from glidercli.logio.rerun.sea import Sea, in_words
from glidercli.residuals import on_circle

__all__ = ["Pair", "Side", "side_by_side"]

FIRST = ("depth", "pitch", "roll", "heading", "vertical_speed", "speed_through_water")
"""Channels that are seen at once."""
MOST = 6
"""Panels in a tab of differences."""


class Side(NamedTuple):
    """One of the logs. place : entity above all of it. vehicle : entity of its vehicle."""

    log: Log
    label: str
    short: str
    """The shortest name that tells it from the others."""
    place: str
    colour: look.Colour
    vehicle: str
    has_hull: bool

    @property
    def legend(self) -> str:
        """Its colour, and which it is."""
        return f"{look.NAMES[self.colour]}: {self.short}"


class Pair(NamedTuple):
    """How far a log is from the first. title : which less which. place : entity above its differences."""

    title: str
    place: str
    colour: look.Colour
    differences: list[Difference]

    @staticmethod
    def drawn_as_lines(name: str) -> bool:
        """Whether a difference is a line; on the circle one would join 180 to -180 deg."""
        return not on_circle(name)


def side_by_side(
    sides: Sequence[Side],
    pairs: Sequence[Pair],
    sea: Sea | None,
    zoom: float | None,
    span_ns: int,
    extents: Mapping[str, Extent],
) -> Any:
    """The rerun Blueprint: 3-D on the left, overlaid flight plots in the middle, differences and the rest on the right.

    sea : surroundings of the tracks, zoom : of the map; None without one. span_ns : length of the whole.
    extents : of the values of each channel in all logs.
    """
    import rerun.blueprint as rrb

    left: list[Any] = [] if sea is None else [_overview(sides, sea)]
    abreast = sum(side.has_hull for side in sides)
    hulls = [
        panels.hull_view(f"{side.label}: attitude", side.vehicle, hull_size(side.log)[0], abreast=abreast)
        for side in sides
        if side.has_hull
    ]
    if hulls:
        left.append(rrb.Horizontal(*hulls))
    shown = [name for name in FIRST if any(name in side.log for side in sides)][:5]
    flight = [_overlaid(name, sides, axis([name], extents), name == shown[0]) for name in shown]
    tabs = _differences(pairs)
    for tab, _, _, names in panels.PLOTS:
        if tab != "Flight":
            present = [name for name in names if any(name in side.log for side in sides)]
            views = tabs.setdefault(tab, [])
            views += [
                _overlaid(name, sides, axis([name], extents), not views and i == 0) for i, name in enumerate(present)
            ]
    if zoom is not None:
        tabs["Map"] = [rrb.MapView(origin="/map", zoom=zoom, name="tracks and fixes; the map comes from the network")]
    if any(side.log.events for side in sides):
        contents = [f"{side.place}/events" for side in sides if side.log.events]
        tabs["Events"] = [panels.events(contents)]
    tabs["About"] = [rrb.TextDocumentView(origin="/about", name="about this recording")]
    columns: list[Any] = [rrb.Vertical(*left, row_shares=[1.25, 1.0][: len(left)])] if left else []
    columns += [rrb.Vertical(*flight, row_shares=[1.4, 1.0, 1.0, 1.0, 1.0][: len(flight)])] if flight else []
    columns.append(rrb.Tabs(*(rrb.Vertical(*views, name=tab) for tab, views in tabs.items() if views), active_tab=0))
    shares = panels.LEFT[len(left)] + [3.8] * bool(flight) + [4.1]
    whole = rrb.Horizontal(*columns, column_shares=shares)
    return rrb.Blueprint(whole, panels.clock(sides[0].log, span_ns), *panels.hidden())


def _overview(sides: Sequence[Side], sea: Sea) -> Any:
    """All tracks in one scene."""
    sights = ["+ /world/**"]
    for side in sides:
        sights += [f"- {side.vehicle}/**", f"+ {side.vehicle}", f"+ {side.vehicle}/marker", f"+ {side.vehicle}/plumb"]
        sights.append(f"- /world{side.place}/path")
    drawn = "" if sea.exaggeration == 1.0 else f", depth drawn x {sea.exaggeration:g}"
    legend = ", ".join(side.legend for side in sides)
    return panels.space(f"{legend}{drawn}, grid {in_words(sea.spacing)}", "/", sights, *sea.camera)


def _overlaid(name: str, sides: Sequence[Side], values: Extent | None, legend: bool) -> Any:
    """A channel of all logs that have it."""
    contents = [f"{side.place}/{CHANNELS[name].group}/{name}" for side in sides if name in side.log]
    only = [side for side in sides if name in side.log]
    words = panels.series_name(name) + (f", {only[0].short} only" if len(only) == 1 else "")
    return panels.over_time(words, contents, values, legend)


def _differences(pairs: Sequence[Pair]) -> dict[str, list[Any]]:
    """Tabs of differences, the usual ones first."""
    found: dict[str, list[tuple[Pair, Difference]]] = {}
    for pair in pairs:
        for one in pair.differences:
            found.setdefault(one.name, []).append((pair, one))
    order = [name for name in FIRST if name in found] + [name for name in found if name not in FIRST]
    tabs: dict[str, list[Any]] = {}
    for place, name in enumerate(order):
        contents = [f"{pair.place}/{name}" for pair, _ in found[name]]
        rms = ", ".join(f"{one.rms:.3g}" for _, one in found[name])
        zero = "" if all(one.same_zero for _, one in found[name]) else ", other zeros"
        which = pairs[0].title if len(pairs) == 1 and place % MOST == 0 else "difference"
        title = f"{name.replace('_', ' ')}: {which}, {panels.unit_of(name)} (rms {rms}){zero}"
        tab = "Differences" if place < MOST else f"Differences {place // MOST + 1}"
        legend = len(pairs) > 1 and place % MOST == 0
        values = axis([name], {name: joined(extent(one.values) for _, one in found[name])})
        tabs.setdefault(tab, []).append(panels.over_time(title, contents, values, legend))
    return tabs
