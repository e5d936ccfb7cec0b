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
MOST = 4
"""Panels above one another, which leaves each the height of two marks in a window of 800 px."""
LONGEST = 36
"""Signs of a legend that a title has room for."""


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
    own_starts: bool,
) -> Any:
    """The rerun Blueprint: 3-D on the left, overlaid flight plots in the middle, differences and the rest on the right.

    sea : surroundings of the tracks, zoom : of the map; None without one. span_ns : length of the whole.
    extents : of the values of each channel in all logs. own_starts : whether tracks far apart are drawn from one place.
    """
    import rerun.blueprint as rrb

    left: list[Any] = [] if sea is None else [_overview(sides, sea, own_starts)]
    hulls = [
        panels.hull_view(f"{side.legend}, attitude", side.vehicle, hull_size(side.log)[0])
        for side in sides
        if side.has_hull
    ]
    if hulls:
        left.append(rrb.Vertical(*hulls))
    present = [name for name in FIRST if any(name in side.log for side in sides)]
    shown, others = present[:MOST], present[MOST:]
    flight = [_overlaid(name, sides, axis([name], extents, len(shown)), name == shown[0]) for name in shown]
    differences = _differences(pairs)
    tabs: dict[str, list[Any]] = {"Differences": [rrb.Tabs(*differences, active_tab=0)]} if differences else {}
    tabs["Speed"] = [_overlaid(name, sides, axis([name], extents, len(others)), name == others[0]) for name in others]
    for tab, *_, names in panels.PLOTS:
        if tab != "Flight":
            present = [name for name in names if any(name in side.log for side in sides)]
            views = tabs.setdefault(tab, [])
            views += [
                _overlaid(one, sides, axis([one], extents, len(present)), not views and one == present[0])
                for one in present
            ]
    if zoom is not None:
        tabs["Map"] = [rrb.MapView(origin="/map", zoom=zoom, name="tracks and fixes; map from the network")]
    tabs |= panels.told([f"{side.place}/events" for side in sides if side.log.events])
    rows = [1.25, 0.75 + 0.25 * len(hulls)]
    columns: list[Any] = [rrb.Vertical(*left, row_shares=rows[: len(left)])] if left else []
    columns += [rrb.Vertical(*flight, row_shares=[1.4, 1.0, 1.0, 1.0][: len(flight)])] if flight else []
    columns.append(rrb.Tabs(*(rrb.Vertical(*views, name=tab) for tab, views in tabs.items() if views), active_tab=0))
    shares = panels.LEFT[len(left)] + [3.8] * bool(flight) + [4.1]
    whole = rrb.Horizontal(*columns, column_shares=shares)
    return rrb.Blueprint(whole, panels.clock(sides[0].log, span_ns), *panels.hidden())


def _overview(sides: Sequence[Side], sea: Sea, own_starts: bool) -> Any:
    """All tracks in one scene; where a title has no room for what each is, the legend of depth tells it."""
    sights = ["+ /world/**"]
    for side in sides:
        sights += [f"- {side.vehicle}/**", f"+ {side.vehicle}", f"+ {side.vehicle}/marker", f"+ {side.vehicle}/plumb"]
        sights.append(f"- /world{side.place}/path")
    drawn = "" if sea.exaggeration == 1.0 else f", depth drawn x {sea.exaggeration:g}"
    drawn += ", FROM ONE START" if own_starts else ""
    legend = ", ".join(side.legend for side in sides)
    legend = legend if len(legend) <= LONGEST else "tracks"
    return panels.space(f"{legend}{drawn}, grid {in_words(sea.spacing)}", "/", sights, *sea.camera)


def _overlaid(name: str, sides: Sequence[Side], values: Extent | None, legend: bool) -> Any:
    """A channel of all logs that have it."""
    contents = [f"{side.place}/{CHANNELS[name].group}/{name}" for side in sides if name in side.log]
    only = [side for side in sides if name in side.log]
    words = panels.series_name(name) + (f", {only[0].short} only" if len(only) == 1 else "")
    return panels.over_time(words, contents, values, legend)


def _differences(pairs: Sequence[Pair]) -> list[Any]:
    """Tabs of differences, as the channels themselves are arranged."""
    import rerun.blueprint as rrb

    found: dict[str, list[tuple[Pair, Difference]]] = {}
    for pair in pairs:
        for one in pair.differences:
            found.setdefault(one.name, []).append((pair, one))
    groups: dict[str, list[str]] = {}
    for tab, *_, names in panels.PLOTS:
        groups.setdefault(tab, []).extend(name for name in names if name in found)
    tabs = []
    for tab, members in groups.items():
        for first in range(0, len(members), MOST):
            part = members[first : first + MOST]
            views = [_difference(name, found[name], pairs, name == part[0]) for name in part]
            tabs.append(rrb.Vertical(*views, name=f"{tab} {first // MOST + 1}" if first else tab))
    return tabs


def _difference(name: str, found: Sequence[tuple[Pair, Difference]], pairs: Sequence[Pair], first: bool) -> Any:
    """The differences of a channel; the first of a tab tells which less which."""
    contents = [f"{pair.place}/{name}" for pair, _ in found]
    rms = ", ".join(f"{one.rms:.3g}" for _, one in found)
    zero = "" if all(one.same_zero for _, one in found) else ", other zeros"
    which = pairs[0].title if len(pairs) == 1 and first else "difference"
    sign = " (deeper +)" if name in ("depth", "down") else ""
    title = f"{name.replace('_', ' ')}: {which}{sign}, {panels.unit_of(name)} (rms {rms}){zero}"
    values = axis([name], {name: joined(extent(one.values) for _, one in found)}, MOST)
    return panels.over_time(title, contents, values, len(pairs) > 1 and first)
