"""What lies about a track in Rerun? The sea surface with a grid, walls with depths, the bottom if known; a camera."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.settling import row
from glidercli.logio.round_steps import nice

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Camera", "Sea", "in_words"]

Array = NDArray[np.float64]
Camera = tuple[Array, Array]
"""An eye, and the point that it looks at, as drawn: north, east, exaggerated depth, m."""

FLAT = 0.45
"""Depth is drawn at least so large beside the longer side of the track; otherwise it is exaggerated."""
NAME_INSIDE = 0.2
"""Part of the bottom's diagonal from the corner by the eye to its name, so that the name is in the picture."""
VIEW, BESIDE_BAR = np.radians(55.0), 0.85
"""Height of Rerun's field of view, rad; how much of a panel's width a colour bar beside it leaves."""


def in_words(length: float) -> str:
    """A length in m or km."""
    return f"{length:g} m" if length < 1000.0 else f"{length / 1000.0:g} km"


class Sea(NamedTuple):
    """Surroundings of a track."""

    chunks: list[Chunk]
    notes: list[str]
    exaggeration: float
    """By how much depth is drawn too large: 1, or a round number."""
    spacing: float
    """Of the grid on the surface, m."""
    extent: float
    """The longer side of the track, m; lengths of arrows go by it."""
    camera: Camera
    beside_bar: Camera
    """For a panel with a colour bar beside it."""

    @classmethod
    def about(cls, places: Array, bottom: float | None, fixes: Array, aspect: float) -> Sea:
        """The sea about a track.

        places : (n, 3), NED, m. bottom : depth of the bottom, m, None where it is unknown. fixes : (m, 3), NED, m; the
        surface reaches those that are not far off. aspect : width to height of the panel.
        """
        low, high = places.min(axis=0), places.max(axis=0)
        extent = max(float((high - low)[:2].max()), 1.0)
        reach = 0.5 * extent
        by = fixes[((fixes > low - reach) & (fixes < high + reach))[:, :2].all(axis=1)]
        low, high = (np.minimum(low, by.min(axis=0)), np.maximum(high, by.max(axis=0))) if len(by) else (low, high)
        deepest = max(float(high[2]), bottom or 0.0, 1.0)
        ratio = FLAT * extent / deepest
        exaggeration = max(nice(ratio), 2.0) if ratio >= 1.5 else 1.0
        tall = deepest * exaggeration
        margin = max(0.06 * extent, 0.12 * tall if extent < tall else 0.0)
        side = 0.5 * (high - low)[:2] + margin
        spacing = nice(2 * float(side.max()) / 8)
        middle = 0.5 * (low + high)[:2]
        south, west = np.floor((middle - side) / spacing) * spacing
        north, east = np.ceil((middle + side) / spacing) * spacing
        box = _Box(south, west, north, east, deepest * 1.03, _sight(places, extent))
        chunks = [*_surface(box, spacing), *_walls(box, deepest, exaggeration, places), *_bottom(box, bottom)]
        notes = [f"The sea surface carries a grid of {in_words(spacing)}."]
        if exaggeration != 1.0:
            notes.append(f"Depth is drawn {exaggeration:g} times too large in the overview; the hull is not.")
        if bottom is not None:
            notes.append(f"Brown: the bottom that the log tells, {bottom:g} m deep.")
        cameras = [_camera(box, places, bottom, exaggeration, width) for width in (aspect, BESIDE_BAR * aspect)]
        return cls(chunks, notes, exaggeration, spacing, extent, *cameras)


class _Box(NamedTuple):
    """What is drawn of the sea, NED, m; sight : unit vector from the middle to the eye."""

    south: float
    west: float
    north: float
    east: float
    floor: float
    sight: Array

    @property
    def near(self) -> tuple[float, float]:
        """North and east of the corner by the eye."""
        return (
            self.north if self.sight[0] > 0 else self.south,
            self.east if self.sight[1] > 0 else self.west,
        )

    @property
    def far(self) -> tuple[float, float]:
        """North and east of the corner away from the eye."""
        return (
            self.south if self.sight[0] > 0 else self.north,
            self.west if self.sight[1] > 0 else self.east,
        )

    @property
    def across(self) -> tuple[Array, Array]:
        """Unit vectors to the right and up in the picture."""
        right = np.cross(-self.sight, [0.0, 0.0, -1.0])
        right /= np.linalg.norm(right)
        return right, np.cross(right, -self.sight)

    @property
    def surface(self) -> list[tuple[float, float]]:
        """North and east of the corners, once around."""
        return [(self.south, self.west), (self.north, self.west), (self.north, self.east), (self.south, self.east)]


def _sight(places: Array, extent: float) -> Array:
    """From the middle towards the eye: across a long track, from its southern side, from above; else from the SSW."""
    level = places[:, :2] - places[:, :2].mean(axis=0)
    spread, axes = np.linalg.eigh(level.T @ level)
    direction = np.array([-0.88, -0.475])
    if spread[0] < 0.3 * spread[1]:
        along = axes[:, 1] if axes[1, 1] > 0 else -axes[:, 1]  # eastward
        across = np.array([-abs(along[1]), np.sign(along[1] or 1.0) * along[0]])  # southward
        direction = 0.88 * across - 0.475 * along
    direction /= np.linalg.norm(direction)
    steep = 0.45 if extent > 0.3 * float(np.ptp(places[:, 2])) else 0.3
    sight = np.array([*((1.0 - steep**2) ** 0.5 * direction), -steep])
    return np.asarray(sight / np.linalg.norm(sight))


def _surface(box: _Box, spacing: float) -> list[Chunk]:
    import rerun as rr

    corners = [(n, e, 0.0) for n, e in box.surface]
    plane = rr.Mesh3D(vertex_positions=corners, triangle_indices=[[0, 1, 2], [0, 2, 3]], albedo_factor=look.SEA)
    lines = [[(n, box.west, 0), (n, box.east, 0)] for n in np.arange(box.south, box.north + spacing / 2, spacing)]
    lines += [[(box.south, e, 0), (box.north, e, 0)] for e in np.arange(box.west, box.east + spacing / 2, spacing)]
    grid = rr.LineStrips3D(lines, colors=look.SEA_LINES, radii=rr.Radius.ui_points(0.5))
    foot = (box.south, box.west, 0.0)
    way = (min(1.5 * spacing, box.north - box.south), 0.0, 0.0)
    arrow = rr.Arrows3D(origins=[foot], vectors=[way], colors=look.GREY, radii=rr.Radius.ui_points(1.5))
    name = rr.Points3D([(box.south + 0.5 * way[0], box.west, 0.0)], labels=["N"], **look.NAMED)
    entities = {"": plane, "/grid": grid, "/north": arrow, "/north/name": name}
    return [row(f"/world/surface{part}", drawn) for part, drawn in entities.items()]


def _walls(box: _Box, deepest: float, exaggeration: float, places: Array) -> list[Chunk]:
    """Lines of equal depth on the two walls away from the eye; named where a wall ends, clear of the track."""
    import rerun as rr

    (near_n, near_e), (far_n, far_e), floor = box.near, box.far, box.floor
    step = nice(deepest / 2.5)
    depths = np.arange(step, deepest * 1.001, step)
    edge = [(far_n, near_e), (far_n, far_e), (near_n, far_e)]
    rungs = [[(n, e, z) for n, e in edge] for z in (*depths, floor)]
    posts = [[(n, e, 0.0), (n, e, floor)] for n, e in edge]
    lines = rr.LineStrips3D(rungs + posts, colors=look.BOX, radii=rr.Radius.ui_points(0.5))
    right, up = box.across
    seen = np.stack([right, up * [1.0, 1.0, exaggeration]], axis=-1)
    track = np.concatenate([places[:: max(1, len(places) // 1000)], places[-1:]]) @ seen

    def clear(corner: tuple[float, float]) -> float:
        names = np.array([(*corner, z) for z in depths]) @ seen
        return float(np.linalg.norm(track[:, np.newaxis] - names, axis=-1).min())

    post = max((edge[0], edge[2]), key=clear)
    names = rr.Points3D([(*post, z) for z in depths], labels=[f"{z:g} m" for z in depths], **look.NAMED)
    return [row("/world/box", lines), row("/world/box/names", names)]


def _bottom(box: _Box, bottom: float | None) -> list[Chunk]:
    import rerun as rr

    if bottom is None:
        return []
    corners = [(n, e, bottom) for n, e in box.surface]
    plane = rr.Mesh3D(vertex_positions=corners, triangle_indices=[[0, 1, 2], [0, 2, 3]], albedo_factor=look.SEABED)
    near, far = np.array(box.near), np.array(box.far)
    label = rr.Points3D(
        [(*(near + NAME_INSIDE * (far - near)), bottom)], labels=[f"bottom, {bottom:g} m"], **look.NAMED
    )
    return [row("/world/bottom", plane), row("/world/bottom/name", label)]


def _camera(box: _Box, places: Array, bottom: float | None, exaggeration: float, aspect: float) -> Camera:
    """The closest eye in the box's line of sight that sees surface, walls, track, and the bottom if it is known."""
    surface = [(n, e, 0.0) for n, e in box.surface]
    foot = [(n, e, box.floor) for n, e in ((box.far[0], box.near[1]), box.far, (box.near[0], box.far[1]))]
    if bottom is not None:
        foot += [(*box.near, bottom)]
    some = places[:: max(1, len(places) // 300)]
    drawn = np.concatenate([np.array(surface + foot), some]) * [1.0, 1.0, exaggeration]
    forward = -box.sight
    right, up = box.across
    half = float(np.tan(VIEW / 2))

    def distance() -> float:
        away = drawn - middle
        sides = np.maximum(np.abs(away @ right) / (half * aspect), np.abs(away @ up) / half)
        return float((sides - away @ forward).max())

    middle = 0.5 * (drawn.min(axis=0) + drawn.max(axis=0))
    for axis in (right, up, right, up):  # to centre what is seen changes the distance, which changes what is seen
        away = distance()
        seen = ((drawn - middle) @ axis) / ((drawn - middle) @ forward + away)
        middle = middle + axis * 0.5 * (seen.min() + seen.max()) * away
    return middle + box.sight * distance() * 1.1, middle
