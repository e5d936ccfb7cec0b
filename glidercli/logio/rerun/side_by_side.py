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
from glidercli.logio.rerun.titles import LEFT, MIDDLE, RIGHT, fitting, hull_room
from glidercli.residuals import on_circle

__all__ = ["Pair", "Side", "side_by_side"]

FIRST = ("depth", "pitch", "roll", "heading", "vertical_speed", "speed_through_water")
"""Channels that are seen at once."""
MOST = 4
"""Of these; more leave none the height of two marks in a window of 800 px."""
TABS = {
    "Flight": FIRST[:4],
    "Speed": ("vertical_speed", "speed_through_water", "angle_of_attack", "sideslip"),
    "Actuators": ("mass_position", "mass_rotation", "net_buoyancy", "ballast_volume", "rudder_angle"),
    "CTD": (
        "temperature", "conservative_temperature", "salinity", "absolute_salinity", "density", "conductivity",
        "pressure",
    ),
    "Current": ("current_east", "current_north", "current_up"),
    "Motion": ("u", "v", "w", "p", "q", "r"),
    "Place": ("north", "east", "down", "latitude", "longitude"),
}  # fmt: skip
"""Channels by tab. All these tabs side by side take 508 px, of 526 px in a window of 1400 x 800."""
SHARES = (4.4, 3.5, 4.9)
"""Of the columns in the width."""
ABREAST = 3
"""Hulls in a row: with more their titles have no room for a colour."""


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
    """How far a log is from the first. other, reference : which less which. place : entity above its differences."""

    other: Side
    reference: Side
    place: str
    colour: look.Colour
    differences: list[Difference]

    @property
    def title(self) -> str:
        """Which less which."""
        return f"{self.other.short} less {self.reference.short}"

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
    own_starts: str,
) -> Any:
    """The rerun Blueprint: 3-D on the left, overlaid flight plots in the middle, differences and the rest on the right.

    sea : surroundings of the tracks, zoom : of the map; None without one. span_ns : length of the whole.
    extents : of the values of each channel in all logs. own_starts : words for tracks that are not drawn where
    they were, or "".
    """
    import rerun.blueprint as rrb

    left: list[Any] = [] if sea is None else [_overview(sides, sea, own_starts)]
    hulls = _hulls([side for side in sides if side.has_hull])
    if hulls:
        left.append(rrb.Vertical(*hulls) if len(hulls) > 1 else hulls[0])
    shown = [name for name in FIRST if any(name in side.log for side in sides)][:MOST]
    flight = [
        _overlaid(name, sides, axis([name], extents, len(shown) - (name == "depth") or 1), MIDDLE, name == shown[0])
        for name in shown
    ]
    tabs = {"Differences": _in_tabs(_differences(pairs)), "Values": _in_tabs(_values(sides, shown, extents))}
    if zoom is not None:
        tabs["Map"] = [rrb.MapView(origin="/map", zoom=zoom, name="tracks and fixes; map from the network")]
    tabs |= panels.told([f"{side.place}/events" for side in sides if side.log.events])
    rows = [1.25, 0.75 + 0.25 * len(hulls)]
    columns: list[Any] = [rrb.Vertical(*left, row_shares=rows[: len(left)])] if left else []
    columns += [rrb.Vertical(*flight, row_shares=[1.4, 1.0, 1.0, 1.0][: len(flight)])] if flight else []
    columns.append(rrb.Tabs(*(rrb.Vertical(*views, name=tab) for tab, views in tabs.items() if views), active_tab=0))
    shares = [*SHARES[: len(left) > 0], *SHARES[1 : 1 + bool(flight)], SHARES[2]]
    whole = rrb.Horizontal(*columns, column_shares=shares)
    return rrb.Blueprint(whole, panels.clock(sides[0].log, span_ns), *panels.hidden())


def _hulls(sides: Sequence[Side]) -> list[Any]:
    """The hulls, some abreast; titles tell the colour, and which it is where there is room."""
    import rerun.blueprint as rrb

    rows = []
    for first in range(0, len(sides), ABREAST):
        row = sides[first : first + ABREAST]
        views = []
        for side in row:
            colour = look.NAMES[side.colour]
            title = fitting(hull_room(len(row)), [f"{colour}: {side.label}", side.legend, colour])
            views.append(panels.hull_view(title, side.vehicle, hull_size(side.log)[0], abreast=len(row)))
        rows.append(rrb.Horizontal(*views))
    return rows


def _overview(sides: Sequence[Side], sea: Sea, own_starts: str) -> Any:
    """All tracks in one scene."""
    sights = ["+ /world/**"]
    for side in sides:
        sights += [f"- {side.vehicle}/**", f"+ {side.vehicle}", f"+ {side.vehicle}/marker", f"+ {side.vehicle}/plumb"]
        sights.append(f"- /world{side.place}/path")
    drawn = [own_starts] if own_starts else []
    drawn += [f"depth drawn x {sea.exaggeration:g}"] if sea.exaggeration != 1.0 else []
    whole, grid = ", ".join(side.legend for side in sides), f"grid {in_words(sea.spacing)}"
    wordings = [[whole, *drawn, grid], [whole, *drawn], ["tracks", *drawn, grid], [*drawn, grid], drawn or ["tracks"]]
    title = fitting(LEFT, [", ".join(words) for words in wordings])
    return panels.space(title, "/", sights, *sea.camera)


def _overlaid(name: str, sides: Sequence[Side], values: Extent | None, room: float, legend: bool) -> Any:
    """A channel of all logs that have it."""
    contents = [f"{side.place}/{CHANNELS[name].group}/{name}" for side in sides if name in side.log]
    only = [side for side in sides if name in side.log]
    words = panels.series_name(name)
    titles = [words]
    if len(only) == 1:
        titles = [f"{words}, {only[0].short} only", f"{words}, {look.NAMES[only[0].colour]} only"]
    return panels.over_time(fitting(room, titles), contents, values, legend)


def _in_tabs(views: Mapping[str, Sequence[Any]]) -> list[Any]:
    """Panels in tabs of their own; none without panels."""
    import rerun.blueprint as rrb

    tabs = [rrb.Vertical(*found, name=tab) for tab, found in views.items() if found]
    return [rrb.Tabs(*tabs, active_tab=0)] if tabs else []


def _values(sides: Sequence[Side], shown: Sequence[str], extents: Mapping[str, Extent]) -> dict[str, list[Any]]:
    """Overlaid plots of all but those shown beside them, by tab."""
    tabs: dict[str, list[Any]] = {}
    for tab, names in TABS.items():
        present = [name for name in names if name not in shown and any(name in side.log for side in sides)]
        tabs[tab] = [
            _overlaid(name, sides, axis([name], extents, len(present)), RIGHT, name == present[0]) for name in present
        ]
    return tabs


def _differences(pairs: Sequence[Pair]) -> dict[str, list[Any]]:
    """Panels of differences, by tab."""
    found: dict[str, list[tuple[Pair, Difference]]] = {}
    for pair in pairs:
        for one in pair.differences:
            found.setdefault(one.name, []).append((pair, one))
    tabs: dict[str, list[Any]] = {}
    for tab, names in TABS.items():
        present = [name for name in names if name in found]
        legend = len(pairs) > 1
        tabs[tab] = [_difference(n, found[n], legend and n == present[0], len(present)) for n in present]
    return tabs


def _difference(name: str, found: Sequence[tuple[Pair, Difference]], legend: bool, count: int) -> Any:
    """How far logs are apart in a channel; the title tells which less which by colours. count : of the tab's panels."""
    words = f"{name.replace('_', ' ')}, {panels.unit_of(name)}, {_which([pair for pair, _ in found])}"
    words += "; deeper positive" if name == "depth" else ""
    words += "" if all(one.same_zero for _, one in found) else "; other zeros"
    each = [one.rms for _, one in found]
    titles = [f"{words}; rms {', '.join(f'{rms:.3g}' for rms in each)}", f"{words}; rms to {max(each):.3g}", words]
    values = axis([name], {name: joined(extent(one.values) for _, one in found)}, count)
    return panels.over_time(fitting(RIGHT, titles), [f"{pair.place}/{name}" for pair, _ in found], values, legend)


def _which(pairs: Sequence[Pair]) -> str:
    """Which less which, by colours."""
    others, references = ({look.NAMES[s.colour] for s in side} for side in zip(*[p[:2] for p in pairs], strict=True))
    if len(references) == 1:
        return f"{others.pop()} less {references.pop()}" if len(pairs) == 1 else f"less {references.pop()}"
    return f"{others.pop()} less others" if len(others) == 1 else "simulated less measured"
