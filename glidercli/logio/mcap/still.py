"""What stands still in the scene of a flight? Track, sea surface, bottom, position fixes, and the current by depth.

Each is one message at the start of the flight, which a viewer restores on every seek. All are in `map_ned`.
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.logio.mcap.messages import Array, Messages
from glidercli.logio.mcap.primitives import (
    NED,
    Colour,
    colour,
    line,
    point,
    points,
    pose,
    scene,
    single,
    text,
)  # fmt: skip
from glidercli.logio.mcap.side import ALONE, Side
from glidercli.logio.round_steps import nice
from glidercli.logio.stretches import alone

__all__ = ["bottom", "current_average", "current_profile", "fix_marks", "surface", "track"]

ARROWS = 40
"""Arrows of current in the scene at most, one in each of so many bins of depth."""
MARKS = 500
"""Position fixes in the scene at most; /glider/fix has all."""
MOST_LINES = 60
"""Lines of the surface's grid in each direction at most."""
_SHAPE = {"shaft": 0.75, "head": 0.25, "thin": 0.015, "thick": 0.06}
"""Parts of an arrow's length."""

GREEN: Colour = (0.43, 0.8, 0.51, 1.0)
ORANGE: Colour = (1.0, 0.62, 0.29, 1.0)
TEAL: Colour = (0.35, 0.88, 0.8, 1.0)
VIOLET: Colour = (0.72, 0.55, 1.0, 1.0)
WHITE: Colour = (1.0, 1.0, 1.0, 1.0)
SEA: Colour = (0.27, 0.59, 0.82, 0.12)
SEA_LINES: Colour = (0.43, 0.71, 0.9, 0.4)
GROUND: Colour = (0.55, 0.43, 0.3, 0.25)
GROUND_LINES: Colour = (0.72, 0.58, 0.42, 0.5)
PHASE_COLOURS: dict[str, Colour] = {
    "surface": GREEN, "dive": (0.34, 0.64, 1.0, 1.0), "climb": ORANGE, "hover": VIOLET,
    "inflection": (0.94, 0.82, 0.35, 1.0),
}  # fmt: skip


def track(rows: Array, count: int, origin: str, gaps: str, time_ns: int, side: Side = ALONE) -> Messages:
    """/viz/track: the whole way, a line for each stretch, in the colours of its phases, else of depth; ends are named.

    rows : (n, 6) of the ``count`` samples: north, east, down, m, the phase's code, NaN where there is none, UTC ns, and
    the number of the stretch; one of a single row is a ball. gaps : those between stretches in words, "" without one.
    """
    places, codes, stretches = rows[:, :3], rows[:, 3], rows[:, 5]
    if side.colour is not None:
        palette, chosen, meaning = [colour(side.colour)], np.zeros(len(rows), np.int64), f"one for {side.name}"
    elif np.isin(codes, np.arange(len(PHASES))).all():
        palette = [colour(PHASE_COLOURS[name]) for name in PHASES]
        chosen, meaning = (
            codes.astype(np.int64),
            "dive blue, climb orange, surface green, hover violet, inflection gold",
        )
    else:
        palette = [colour((0.75 - 0.02 * i, 0.9 - 0.023 * i, 0.95 - 0.01 * i, 1.0)) for i in range(32)]
        deepest = max(float(places[:, 2].max()), 1.0)
        chosen = np.clip(places[:, 2] / deepest * 31.0, 0.0, 31.0).astype(np.int64)
        meaning = f"by depth, light at the surface, dark at {deepest:.0f} m"
    painted = [palette[i] for i in chosen.tolist()]
    edges = [0, *np.flatnonzero(np.diff(stretches)) + 1, len(rows)]
    ways = [{**line(places[a:b], WHITE), "colors": painted[a:b]} for a, b in itertools.pairwise(edges) if b > a + 1]
    size = point(*[max(0.003 * float(np.linalg.norm(np.ptp(places, axis=0))), 0.5)] * 3)
    balls = [{"pose": pose(*places[i].tolist()), "size": size, "color": painted[i]} for i in alone(stretches).tolist()]
    inks, whose = (side.colour or GREEN, side.colour or ORANGE), f" {side.name}" if side.name else ""
    ends: list[Any] = [
        text(word + whose, ink, *place.tolist())
        for word, ink, place in zip(("start", "end"), inks, places[[0, -1]], strict=True)
    ]
    notes = {"points": f"{len(places)} of {count}", "origin": origin, "colours": meaning, "broken at": gaps or "no gap"}
    content = scene(time_ns, NED, "track", notes, lines=ways, spheres=balls, texts=ends[: len(places)])
    return single("/viz/track", time_ns, content)


def surface(bounds: Array, level: float, time_ns: int) -> list[Messages]:
    """/viz/surface: the sea surface over the flight, see-through, with a grid; none where the way is beyond reason.

    bounds : (2, 3), least and greatest north, east, down of the flight, m. level : of the surface in `map_ned`, m.
    """
    return _sheet("surface", "sea surface", bounds, level, (SEA, SEA_LINES), time_ns)


def bottom(bounds: Array, level: float, depth: float, time_ns: int) -> list[Messages]:
    """/viz/bottom: the bottom, level, at the depth that the log tells, m; as for ``surface``."""
    return _sheet("bottom", f"bottom, {depth:g} m", bounds, level + depth, (GROUND, GROUND_LINES), time_ns)


def _sheet(
    name: str, words: str, bounds: Array, level: float, colours: tuple[Colour, Colour], time_ns: int
) -> list[Messages]:
    """A level sheet over the flight with a grid; colours of the sheet and of the lines."""
    fill, ink = colours
    extent = bounds[1] - bounds[0]
    if not np.isfinite([*bounds.flat, *extent, level]).all() or np.abs(bounds).max() > 1e9:
        return []
    middle = bounds.mean(axis=0)[:2]
    side = np.maximum(np.maximum(1.1 * extent[:2], 0.4 * extent.max()) / 2.0, 1.0)
    spacing = nice(float(side.max()) / 3.0)
    (south, west), (north, east) = (f((middle + s * side) / spacing) for f, s in ((np.floor, -1.0), (np.ceil, 1.0)))
    rows = [np.linspace(a, b, min(round(b - a), MOST_LINES) + 1) * spacing for a, b in ((south, north), (west, east))]
    (south, north), (west, east) = rows[0][[0, -1]], rows[1][[0, -1]]
    grid = [[(n, west, level), (n, east, level)] for n in rows[0]]
    grid += [[(south, e, level), (north, e, level)] for e in rows[1]]
    corners = np.array([(south, west), (north, west), (north, east), (south, east)])
    sheet = {
        "pose": pose(), "points": points(np.column_stack([corners, np.full(4, level)])), "color": colour(fill),
        "indices": [0, 1, 2, 0, 2, 3],
    }  # fmt: skip
    lines = line(np.array(list(itertools.chain(*grid)), np.float64), ink, 1.0, 2)
    told = text(f"{words}, grid {spacing:g} m", (*ink[:3], 1.0), float(south), float(east), level)
    content = scene(time_ns, NED, name, {"grid": f"{spacing:g} m"}, triangles=[sheet], lines=[lines], texts=[told])
    return [single(f"/viz/{name}", time_ns, content)]


def fix_marks(places: Array, count: int, size: float, time_ns: int) -> Messages:
    """/viz/fixes: balls at the positions that were fixed.

    places : (n, 2), north and east, m. size : of the flight, m.
    """
    chosen = places[_spread(len(places), MARKS)]
    radius = max(0.006 * size, 1.0)
    balls = [
        {"pose": pose(n, e, 0.0), "size": point(radius, radius, radius), "color": colour(ORANGE)}
        for n, e in chosen.tolist()
    ]
    notes = {"fixes": f"{len(chosen)} of {count}", "diameter": f"{radius:.3g} m, not to scale"}
    return single("/viz/fixes", time_ns, scene(time_ns, NED, "fixes", notes, spheres=balls))


def current_profile(rows: Array, size: float, time_ns: int) -> tuple[list[Messages], str]:
    """/viz/current_profile: where the current was sampled, one arrow in each bin of depth; and what it shows, in words.

    rows : (n, 6), place north, east, down, m, and current to the north, to the east and down, m/s. size : of the
    flight, m.
    """
    fastest = float(np.linalg.norm(rows[:, 3:], axis=1).max(initial=0.0))
    if not 0.0 < fastest < 1e3:
        return [], ""
    kept = rows
    if len(rows) > ARROWS:
        depth = rows[:, 2]
        shallow, span = depth.min(), max(float(np.ptp(depth)), 1e-9)
        kept = rows[np.unique(np.minimum((depth - shallow) / span * ARROWS, ARROWS - 1).astype(np.int64), True)[1]]
    scale = 0.13 * max(size, 10.0) / fastest
    arrows = [_arrow(place, velocity * scale) for place, velocity in zip(kept[:, :3], kept[:, 3:], strict=True)]
    told = f"teal arrows: current at {len(kept)} places, {scale:.4g} m for 1 m/s; the fastest is {fastest:.2f} m/s"
    notes = {"scale": f"{scale:.4g} m for 1 m/s", "fastest": f"{fastest:.3f} m/s", "arrows": f"{len(kept)}"}
    return [single("/viz/current_profile", time_ns, scene(time_ns, NED, "profile", notes, arrows=arrows))], told


def current_average(rows: Array, origin: str, size: float, time_ns: int) -> tuple[list[Messages], str]:
    """/viz/current_average: a depth-averaged current for each dive, above its middle, with its speed; and in words.

    rows : (n, 6), as for ``current_profile``. origin : where they come from. size : of the flight, m.
    """
    fastest = float(np.linalg.norm(rows[:, 3:], axis=1).max(initial=0.0))
    if not 0.0 < fastest < 1e3 or not np.isfinite(rows).all():
        return [], ""
    kept, scale = rows[_spread(len(rows), MARKS)], 0.13 * max(size, 10.0) / fastest
    arrows, labels = [], []
    for row in kept:
        arrows.append({**_arrow(row[:3], row[3:] * scale), "color": colour(VIOLET)})
        north, east, down = (row[:3] + row[3:] * scale).tolist()
        labels.append(text(f"{np.linalg.norm(row[3:]):.2f} m/s", VIOLET, north, east, down))
    told = f"violet arrows: depth-averaged current of {len(kept)} dives, {scale:.4g} m for 1 m/s ({origin})"
    notes = {"scale": f"{scale:.4g} m for 1 m/s", "origin": origin, "arrows": f"{len(kept)} of {len(rows)}"}
    content = scene(time_ns, NED, "average", notes, arrows=arrows, texts=labels if len(labels) <= ARROWS else [])
    return [single("/viz/current_average", time_ns, content)], told


def _arrow(place: Array, way: Array) -> dict[str, Any]:
    """An arrow from a place, (3,), along a way, (3,), m: the turn of the x axis about the down axis, then its rise."""
    x, y, z = place.tolist()
    north, east, down = way.tolist()
    length = float(np.linalg.norm(way))
    half_turn, half_rise = 0.5 * np.arctan2(east, north), -0.5 * np.arctan2(down, np.hypot(north, east))
    st, ct, sr, cr = np.sin(half_turn), np.cos(half_turn), np.sin(half_rise), np.cos(half_rise)
    return {
        "pose": pose(x, y, z, tuple(map(float, (-st * sr, ct * sr, st * cr, ct * cr)))),
        "shaft_length": _SHAPE["shaft"] * length, "head_length": _SHAPE["head"] * length,
        "shaft_diameter": _SHAPE["thin"] * length, "head_diameter": _SHAPE["thick"] * length, "color": colour(TEAL),
    }  # fmt: skip


def _spread(count: int, most: int) -> NDArray[np.int64]:
    """Rows of ``count``, at most so many, evenly spread."""
    return np.linspace(0, count - 1, min(count, most)).round().astype(np.int64)
