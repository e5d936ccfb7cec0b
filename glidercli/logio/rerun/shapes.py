"""What are the shapes of a flight in Rerun? Track, sea surface, arrows of current, hull and movable mass.

Each gives its chunks, and notes for a reader of the pictures.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Log
from glidercli.logio.drawable import hull_size, number
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.settling import row

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = [
    "BODY",
    "SLIDE",
    "Camera",
    "arrows",
    "camera",
    "hull",
    "hull_notes",
    "points",
    "slide_zero",
    "surface",
    "track",
]

Array = NDArray[np.float64]
Drawn = tuple[list[Any], list[str]]
"""Chunks and notes."""
Camera = tuple[Array, Array]
"""An eye, and the point that it looks at, NED, m."""

BODY = "/world/vehicle/body"
SLIDE = f"{BODY}/slide"
ARROWS = 30
"""Depth bins with one arrow of current each."""


def camera(places: Array, bounds: Array, size: float) -> Camera:
    """An eye above the water that sees a long track from its southern side, a compact one from the south-west."""
    level = places[:, :2] - places[:, :2].mean(axis=0)
    spread, axes = np.linalg.eigh(level.T @ level)
    eye = np.array([-0.6, -0.6, -0.71])
    if spread[0] < 0.3 * spread[1]:
        along = axes[:, 1] if axes[1, 1] > 0 else -axes[:, 1]  # eastward
        across = np.array([-abs(along[1]), np.sign(along[1]) * along[0]])  # southward
        eye = np.array([*(0.9 * across - 0.33 * along), -0.51])
    middle = bounds.mean(axis=0)
    return middle + size * eye, middle


def points(name: str, places: Array, **style: Any) -> list[Chunk]:
    """The same points in /world and, seen from above (east right, north up), in /plan."""
    import rerun as rr

    above = rr.Points2D(places[:, 1::-1] * [1, -1], **style)
    return [row(f"/world/{name}", rr.Points3D(places, **style)), row(f"/plan/{name}", above)]


def track(rows: Array, size: float) -> Drawn:
    """The track in the colours of its phases, or of depth; its ends; a marker at the vehicle's place.

    rows : (n, 4), north, east, down, m, and the code of the phase, NaN where there is none.
    """
    import rerun as rr

    places = rows[:, :3]
    codes, colours, note = _track_colours(rows)
    edges = [0, *(np.flatnonzero(np.diff(codes)) + 1), len(codes) - 1]
    pieces = [(a, b) for a, b in itertools.pairwise(edges) if b > a]
    strips, paint = [places[a : b + 1] for a, b in pieces], [colours[codes[a]] for a, _ in pieces]
    style: dict[str, Any] = {"colors": paint, "radii": rr.Radius.ui_points(1.2)}
    near = np.linalg.norm(places[0] - places[-1]) < 0.25 * size
    ends = {"labels": ["start", "" if near else "end"], "colors": [look.GREEN, look.RED]}
    marker: dict[str, Any] = {"radii": rr.Radius.ui_points(7), "colors": look.GOLD}
    chunks = [
        row("/world/track", rr.LineStrips3D(strips, **style)),
        row("/plan/track", rr.LineStrips2D([strip[:, 1::-1] * [1, -1] for strip in strips], **style)),
        *points("ends", places[[0, -1]], radii=rr.Radius.ui_points(5), **ends),
        row("/world/vehicle/marker", rr.Points3D([[0, 0, 0]], **marker)),
        row("/plan/vehicle", rr.Points2D.from_fields(**marker)),
    ]
    return chunks, [f"{note} It starts at the green point and ends at the red one."]


def _track_colours(rows: Array) -> tuple[NDArray[np.int64], list[look.Colour], str]:
    """A colour code for each point of the track, the colours, and what they mean."""
    if np.isfinite(rows[:, 3]).all():
        meaning = "Track: dive blue, climb orange, surface green, hover violet, inflection gold."
        return rows[:, 3].astype(np.int64), [*look.PHASE_COLOURS.values()], meaning
    deepest = max(float(rows[:, 2].max()), 1.0)
    colours = [(200 - 4 * i, 240 - 6 * i, 245 - 2 * i) for i in range(32)]
    meaning = f"Track coloured by depth, light at the surface, dark at {deepest:.0f} m."
    return np.clip(rows[:, 2] / deepest * 31, 0, 31).astype(np.int64), colours, meaning


def surface(bounds: Array) -> Drawn:
    """The sea surface over the track, translucent, with a grid. bounds : (2, 3), least and greatest corner, NED, m."""
    import rerun as rr

    middle, extent = bounds.mean(axis=0)[:2], bounds[1] - bounds[0]
    side = np.maximum(np.maximum(1.1 * extent[:2], 0.4 * extent.max()) / 2, 1.0)
    power = 10.0 ** np.floor(np.log10(side.max() / 3))
    spacing = float(power * max(step for step in (1, 2, 5) if step * power <= side.max() / 3))
    south, west = np.floor((middle - side) / spacing) * spacing
    north, east = np.ceil((middle + side) / spacing) * spacing
    corners = [(south, west, 0), (north, west, 0), (north, east, 0), (south, east, 0)]
    plane = dict[str, Any](vertex_positions=corners, triangle_indices=[[0, 1, 2], [0, 2, 3]])
    lines = [[(n, west, 0), (n, east, 0)] for n in np.arange(south, north + spacing / 2, spacing)]
    lines += [[(south, e, 0), (north, e, 0)] for e in np.arange(west, east + spacing / 2, spacing)]
    style = dict[str, Any](colors=look.SEA_LINES, radii=rr.Radius.ui_points(0.5))
    chunks = [
        row("/world/surface", rr.Mesh3D(albedo_factor=look.SEA, **plane)),
        row("/world/surface/grid", rr.LineStrips3D(lines, **style)),
    ]
    return chunks, [f"The sea surface carries a grid of {spacing:g} m."]


def arrows(rows: Array, size: float) -> Drawn:
    """One arrow of current in each of the depth bins. rows : (n, 6), place and current, north, east, down, m, m/s."""
    import rerun as rr

    if not len(rows):
        return [], []
    depth = rows[:, 2]
    _, kept = np.unique((depth / max(depth.max(), 1e-9) * ARROWS).astype(int), return_index=True)
    origins, vectors = rows[kept, :3], rows[kept, 3:]
    fastest = float(np.linalg.norm(vectors, axis=1).max())
    vectors = vectors * 0.13 * size / max(fastest, 1e-9)
    places = dict[str, Any](vectors=vectors, origins=origins, radii=rr.Radius.ui_points(1.5))
    note = f"Teal arrows: current, one in each of {ARROWS} depth bins; the longest is {fastest:.2f} m/s."
    return [row("/world/current", rr.Arrows3D(colors=look.TEAL, **places))], [note]


def hull(log: Log) -> Iterator[Chunk]:
    """Hull, wings, tail and movable mass in the body frame, and a compass that stays level."""
    import rerun as rr

    length, diameter, _ = hull_size(log)
    half = diameter / 2
    place: dict[str, Any] = {"translations": [[half - length / 2, 0, 0]], "fill_mode": "solid"}
    place["rotation_axis_angles"] = rr.RotationAxisAngle(axis=[0, 1, 0], degrees=90)
    yield row(f"{BODY}/hull", rr.Capsules3D(lengths=length - diameter, radii=half, colors=look.HULL, **place))
    tip, top = half + 0.3 * length, -1.3 * diameter
    wing = [(-0.10, half, 0), (-0.23, half, 0), (-0.31, tip, 0), (-0.26, tip, 0)]
    fin = [(-0.34, 0, 0), (-0.48, 0, 0), (-0.54, 0, top), (-0.46, 0, top)]
    corners = np.array([*wing, *((x, -y, z) for x, y, z in wing), *fin], dtype=float) * [length, 1, 1]
    triangles = [(base, base + i, base + i + 1) for base in (0, 4, 8) for i in (1, 2)]
    mesh = dict[str, Any](vertex_positions=corners, triangle_indices=triangles)
    yield row(f"{BODY}/fins", rr.Mesh3D(albedo_factor=look.FINS, **mesh))
    edges = [corners[[*range(base, base + 4), base]] for base in (0, 4, 8)]  # they show where a fin is seen edge on
    yield row(f"{BODY}/fins/edges", rr.LineStrips3D(edges, colors=look.FINS, radii=rr.Radius.ui_points(1.5)))
    angle = np.linspace(0.0, 2 * np.pi, 73)
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1) * 0.62 * length
    ticks = [np.stack([point, 1.06 * point]) for point in ring[:-1:6]]
    style = dict[str, Any](colors=look.GREY, radii=rr.Radius.ui_points(0.7))
    yield row("/world/vehicle/compass", rr.LineStrips3D([ring, *ticks], **style))
    yield row(
        "/world/vehicle/compass/names",
        rr.Points3D(1.15 * ring[:-1:18], labels=list("NESW"), show_labels=True, **style),
    )
    if _moves(log):
        size = dict[str, Any](half_sizes=[[0.08 * length, 0.17 * diameter, 0.17 * diameter]], fill_mode="solid")
        mass = rr.Ellipsoids3D(centers=[[0, 0, _drawn_eccentricity(diameter)]], colors=look.RED, **size)
        yield row(f"{SLIDE}/turn/mass", mass)


def hull_notes(log: Log) -> list[str]:
    """What a reader should know of the hull and of the movable mass, at (r_rx, -Rr sin gamma, Rr cos gamma)."""
    length, diameter, own = hull_size(log)
    doubt = "" if own else " NOT TO SCALE: the log does not say the vehicle's size."
    notes = [f"Hull drawn {length:g} m x {diameter:g} m; wings and tail are only a sketch.{doubt}"]
    if not _moves(log):
        return notes
    true, drawn = number(log, "movable_eccentricity_m"), _drawn_eccentricity(diameter)
    told = f"exaggerated: {drawn:.3f} m for a true {true:g} m" if true is not None else "not to scale: it is unknown"
    notes.append(f"Red: the movable mass. Its distance from the hull's axis is drawn {told}.")
    if "mass_position" in log and not _zero_known(log):
        notes.append("Where its zero lies in the hull is unknown: it is drawn about the middle of its range.")
    return notes


def slide_zero(log: Log) -> float:
    """What is taken from a mass position so that it can be drawn, m."""
    if _zero_known(log):
        return 0.0
    values = log["mass_position"].values
    return float(0.5 * (values.min() + values.max()))


def _zero_known(log: Log) -> bool:
    return "mass_position_zero" not in log.metadata and number(log, "movable_nominal_position_m") is not None


def _moves(log: Log) -> bool:
    return any(name in log and len(log[name]) for name in ("mass_position", "mass_rotation"))


def _drawn_eccentricity(diameter: float) -> float:
    return 0.32 * diameter
