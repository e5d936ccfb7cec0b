"""What does the vehicle look like in Rerun? A hull, wings, a tail, and the movable mass that slides and turns.

Coordinates of the body: x forward, y starboard, z down, m.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Log
from glidercli.logio.drawable import drawn_eccentricity, hull_size, mass_notes, moves_mass, slide_zero
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.settling import row

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["hull", "hull_notes", "rail"]

Array = NDArray[np.float64]


def hull(log: Log, vehicle: str, colour: look.Colour | None = None) -> Iterator[Chunk]:
    """Hull, wings, tail and movable mass in the body frame, and a compass that stays level.

    vehicle : entity of the vehicle; under it stand course, turned by the heading, and course/body, pitched and rolled.
    colour : of a log that is drawn with others.
    """
    import rerun as rr

    length, diameter, _ = hull_size(log)
    half, body = diameter / 2, f"{vehicle}/course/body"
    skin, fins = (look.HULL, look.FINS) if colour is None else ((*colour, 50), (*colour, 150))
    place: dict[str, Any] = {"translations": [[half - length / 2, 0, 0]], "fill_mode": "solid"}
    place["rotation_axis_angles"] = rr.RotationAxisAngle(axis=[0, 1, 0], degrees=90)
    yield row(f"{body}/hull", rr.Capsules3D(lengths=length - diameter, radii=half, colors=skin, **place))
    yield _frames(body, length, half, look.GREY if colour is None else colour)
    tip, top = half + 0.3 * length, -1.3 * diameter
    wing = [(-0.10, half, 0), (-0.23, half, 0), (-0.31, tip, 0), (-0.26, tip, 0)]
    fin = [(-0.34, 0, 0), (-0.48, 0, 0), (-0.54, 0, top), (-0.46, 0, top)]
    corners = np.array([*wing, *((x, -y, z) for x, y, z in wing), *fin], dtype=float) * [length, 1, 1]
    triangles = [(base, base + i, base + i + 1) for base in (0, 4, 8) for i in (1, 2)]
    mesh = dict[str, Any](vertex_positions=corners, triangle_indices=triangles)
    yield row(f"{body}/fins", rr.Mesh3D(albedo_factor=fins, **mesh))
    edges = [corners[[*range(base, base + 4), base]] for base in (0, 4, 8)]  # they show where a fin is seen edge on
    yield row(f"{body}/fins/edges", rr.LineStrips3D(edges, colors=fins[:3], radii=rr.Radius.ui_points(1.2)))
    yield from _compass(vehicle, length)
    if moves_mass(log):
        size = dict[str, Any](half_sizes=[[0.08 * length, 0.28 * diameter, 0.16 * diameter]])
        size["centers"] = [[0, 0, drawn_eccentricity(diameter)]]
        yield row(f"{body}/slide/turn/mass", rr.Boxes3D(colors=look.MASS, fill_mode="solid", **size))
        edges_only = rr.Boxes3D(colors=look.MASS, radii=rr.Radius.ui_points(0.8), **size)
        yield row(f"{body}/slide/turn/mass/edges", edges_only)


def _frames(body: str, length: float, half: float, colour: look.Colour) -> Chunk:
    """Rings about the hull, and lines along it: it is seen through them."""
    import rerun as rr

    angle = np.linspace(0.0, 2 * np.pi, 49)
    circle = np.stack([np.zeros_like(angle), np.cos(angle), np.sin(angle)], axis=-1) * half
    ends = np.array([half - length / 2, length / 2 - half])
    rings = [circle + np.array([x, 0, 0]) for x in np.linspace(ends[0], ends[1], 6)]
    arc = np.linspace(0.0, np.pi / 2, 9)
    front = np.stack([ends[1] + half * np.sin(arc), half * np.cos(arc)], axis=-1)
    side = np.concatenate([(front * [-1, 1])[::-1], front])
    lines = [
        np.column_stack([side[:, 0], side[:, 1] * y, side[:, 1] * z]) for y, z in ((1, 0), (0, 1), (-1, 0), (0, -1))
    ]
    style = dict[str, Any](colors=(*colour, 130), radii=rr.Radius.ui_points(0.5))
    return row(f"{body}/hull/frames", rr.LineStrips3D([*rings, *lines], **style))


def _compass(vehicle: str, length: float) -> Iterator[Chunk]:
    """A ring about the hull with the names of the winds."""
    import rerun as rr

    angle = np.linspace(0.0, 2 * np.pi, 73)
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1) * 0.62 * length
    ticks = [np.stack([point, 1.06 * point]) for point in ring[:-1:6]]
    style = dict[str, Any](colors=look.GREY, radii=rr.Radius.ui_points(0.7))
    yield row(f"{vehicle}/compass", rr.LineStrips3D([ring, *ticks], **style))
    names = rr.Points3D(1.18 * ring[:-1:18], labels=list("NESW"), **look.NAMED)
    yield row(f"{vehicle}/compass/names", names)


def rail(log: Log, vehicle: str, extent: tuple[float, float]) -> Chunk:
    """The line that the movable mass slides on. extent : its least and greatest position so far, m."""
    import rerun as rr

    length, diameter, _ = hull_size(log)
    back, front = (place - slide_zero(log) for place in extent)
    ends = [[back - 0.08 * length, 0, 0], [front + 0.08 * length, 0, 0]]
    stops = [[[x, 0, -0.15 * diameter], [x, 0, 0.15 * diameter]] for x, _, _ in ends]
    lines = rr.LineStrips3D([ends, *stops], colors=look.TEXT, radii=rr.Radius.ui_points(0.8))
    return row(f"{vehicle}/course/body/rail", lines)


def hull_notes(log: Log) -> list[str]:
    """What a reader should know of the hull and of the movable mass, at (r_rx, -Rr sin gamma, Rr cos gamma)."""
    length, diameter, own = hull_size(log)
    name = log.metadata.get("vehicle") if own else None
    whose = f"Hull of {name}" if name else "Hull" if own else "A generic hull"
    doubt = "" if own else " NOT TO SCALE: the log does not say the vehicle's size."
    notes = [f"{whose}, drawn {length:g} m x {diameter:g} m; wings and tail are only a sketch.{doubt}"]
    return notes + [f"{note[0].upper()}{note[1:]}." for note in mass_notes(log)]
