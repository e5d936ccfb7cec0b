"""What does the vehicle look like in MCAP? A see-through hull, wings, fin and rudder, and the mass that moves in it.

All in the body frame `base_link_fsd`. Length and diameter of the hull are the vehicle's own where the log tells them;
no vehicle file tells the shape of wings, fin and rudder: they are a sketch, and the scene says so.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from glidercli.logio.drawable import drawn_eccentricity
from glidercli.logio.mcap.messages import MARKED_TIME, Array, Messages, Table, Times, slot
from glidercli.logio.mcap.primitives import (
    AFT,
    FORWARD,
    HULL,
    Colour,
    colour,
    line,
    marked_pose,
    point,
    points,
    pose,
    scene,
    single,
    text,
)  # fmt: skip
from glidercli.logio.mcap.side import ALONE, Side

__all__ = ["movable_mass", "rudder", "vehicle"]

Size = tuple[float, float, bool]
"""Length and diameter, m, and whether they are the vehicle's own: as ``hull_size`` gives them."""

YELLOW: Colour = (1.0, 0.8, 0.1, 0.3)
DARK: Colour = (0.85, 0.4, 0.1, 1.0)
RED: Colour = (0.9, 0.1, 0.1, 1.0)
WHITE: Colour = (1.0, 1.0, 1.0, 1.0)
HINGE = -0.48
"""Where the rudder turns, in lengths of the hull from its middle."""


def vehicle(size: Size, kind: str, time_ns: int, side: Side = ALONE) -> Messages:
    """/viz/vehicle: what of the vehicle never changes. kind : what the log is, which is written beside the hull."""
    ink = side.colour or WHITE
    length, diameter, to_scale = size
    radius = 0.5 * diameter
    shoulder, tail = 0.5 * length - radius, -0.25 * length
    paint = colour(YELLOW if side.colour is None else (*side.colour[:3], YELLOW[3]))
    skin: dict[str, Any] = {"color": paint, "bottom_scale": 1.0}
    barrel = {
        "pose": pose(0.5 * (shoulder + tail), 0.0, 0.0, FORWARD), "size": point(diameter, diameter, shoulder - tail),
        "top_scale": 1.0, **skin,
    }  # fmt: skip
    cone = {
        "pose": pose(0.5 * (tail - 0.5 * length), 0.0, 0.0, AFT),
        "size": point(diameter, diameter, 0.5 * length + tail), "top_scale": 0.3, **skin,
    }  # fmt: skip
    nose = {"pose": pose(shoulder), "size": point(diameter, diameter, diameter), "color": paint}
    notes = {
        "log": kind,
        "hull": f"{length:g} m x {diameter:g} m, {'to scale' if to_scale else 'not to scale: its size is unknown'}",
        "wings, fin, rudder": "a sketch",
    }
    content = scene(
        time_ns, side.frame(HULL), "vehicle", notes, cylinders=[barrel, cone], spheres=[nose],
        triangles=[_fins(length, diameter, side.colour or DARK)],
        lines=[line(_edges(length, diameter), side.colour or DARK, 1.5, 2)],
        texts=[text(side.name or kind, ink, z=-0.8 * length)],
    )  # fmt: skip
    return single("/viz/vehicle", time_ns, content)


def movable_mass(times: Times, position: Array, rotation: Array, size: Size, side: Side = ALONE) -> Table:
    """/viz/movable_mass: a cylinder at (r_rx, -Rr sin gamma, Rr cos gamma), and its arm from the axis.

    position : along the body x axis, as drawn, m. rotation : gamma, rad. Rr is exaggerated: see ``drawn_eccentricity``.
    """
    length, diameter, _ = size
    arm = drawn_eccentricity(diameter)
    y, z = -arm * np.sin(rotation), arm * np.cos(rotation)
    half_sin, half_cos = np.sqrt(0.5) * np.sin(0.5 * rotation), np.sqrt(0.5) * np.cos(0.5 * rotation)
    q_xyzw = [half_sin, half_cos, half_sin, half_cos]  # turned about x, after it was laid along x
    mass = {
        "pose": marked_pose(), "size": point(0.34 * diameter, 0.34 * diameter, 0.16 * length),
        "bottom_scale": 1.0, "top_scale": 1.0, "color": colour(RED),
    }  # fmt: skip
    ends = [point(slot(7), 0.0, 0.0), point(slot(8), slot(9), slot(10))]
    rod = {**line(np.empty((0, 3)), RED, 3.0), "points": ends}
    axis = line(np.array([[-0.4 * length, 0.0, 0.0], [0.45 * length, 0.0, 0.0]]), (0.5, 0.5, 0.5, 0.8), 1.0)
    notes = {"distance from the axis": "exaggerated"}
    template = scene(MARKED_TIME, side.frame(HULL), "movable_mass", notes, cylinders=[mass], lines=[rod, axis])
    return Table("/viz/movable_mass", times, template, [position, y, z, *q_xyzw, position, position, y, z])


def rudder(times: Times, angle: Array, size: Size, side: Side = ALONE) -> Table:
    """/viz/rudder: its blade, turned about the body z axis. angle : rad, turning to starboard positive."""
    length, diameter, _ = size
    zero, half = np.zeros(len(times)), -0.5 * angle  # the trailing edge goes to starboard
    corners = np.array([[0.0, 0.0, -0.1], [-0.09, 0.0, -0.1], [-0.05, 0.0, -1.3], [0.0, 0.0, -1.3]])
    blade = {
        "pose": marked_pose(), "points": points(corners * [length, 1.0, diameter]), "color": colour(RED),
        "indices": [0, 1, 2, 0, 2, 3],
    }  # fmt: skip
    template = scene(MARKED_TIME, side.frame(HULL), "rudder", {"shape": "a sketch"}, triangles=[blade])
    hinge = np.full(len(times), HINGE * length)
    return Table("/viz/rudder", times, template, [hinge, zero, zero, zero, zero, np.sin(half), np.cos(half)])


def _outlines(length: float, diameter: float) -> Array:
    """The corners of the starboard wing, the port wing and the fin, (3, 4, 3), m."""
    root, tip, top = 0.5 * diameter, 0.5 * diameter + 0.3 * length, -1.3 * diameter
    wing = np.array([[-0.10, root, 0.0], [-0.23, root, 0.0], [-0.31, tip, 0.0], [-0.26, tip, 0.0]])
    fin = np.array([[-0.34, 0.0, 0.0], [HINGE, 0.0, 0.0], [HINGE, 0.0, top], [-0.45, 0.0, top]])
    return np.array([wing, wing * [1.0, -1.0, 1.0], fin]) * [length, 1.0, 1.0]


def _fins(length: float, diameter: float, paint: Colour) -> dict[str, Any]:
    corners = _outlines(length, diameter).reshape(-1, 3)
    indices = [i for first in (0, 4, 8) for i in (first, first + 1, first + 2, first, first + 2, first + 3)]
    return {"pose": pose(), "points": points(corners), "color": colour(paint), "indices": indices}


def _edges(length: float, diameter: float) -> Array:
    """The outlines as pairs of points, (24, 3): they show where a fin is seen edge on."""
    outlines = _outlines(length, diameter)
    return np.stack([outlines, np.roll(outlines, -1, axis=1)], axis=2).reshape(-1, 3)
