"""What of a flight stands still in Rerun? The lines and points of its track, its ends, its fixes, its current.

Each gives its chunks, and notes for a reader of the pictures.
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.settling import row
from glidercli.logio.stretches import alone

__all__ = ["Drawn", "arrows", "fixes", "track"]

Array = NDArray[np.float64]
Drawn = tuple[list[Any], list[str]]
"""Chunks and notes."""

ARROWS = 60
"""Arrows of current along a track, at most."""
APART = 0.15
"""Part of a track's size between its ends for two names: one is some 60 px wide in a panel of 500 px."""


def track(rows: Array, world: str, gaps: str, colour: look.Colour | None = None) -> Drawn:
    """The track in the colours of its phases, or of depth, or in one; its ends; a marker at the vehicle's place.

    rows : (n, 5), north, east, down, m, the code of the phase, NaN where there is none, and the number of the stretch;
    the line is broken between stretches, and one of a single row is a point. world : entity above all. gaps : those
    between stretches in words, "" without one.
    """
    import rerun as rr

    places, stretches = rows[:, :3], rows[:, 4]
    if colour is None:
        codes, colours, note = _track_colours(rows)
    else:
        codes, colours, note = np.zeros(len(rows), np.int64), [colour], ""
    breaks = np.flatnonzero(np.diff(stretches)) + 1
    edges = [0, *np.flatnonzero((np.diff(codes) != 0) | (np.diff(stretches) != 0)) + 1, len(codes)]
    lasts = {*breaks.tolist(), len(codes)}  # of stretches; elsewhere a piece goes on to the first row of the next
    pieces = [(a, b if b in lasts else b + 1) for a, b in itertools.pairwise(edges)]
    pieces = [(a, b) for a, b in pieces if b > a + 1]
    strips, paint = [places[a:b] for a, b in pieces], [colours[codes[a]] for a, _ in pieces]
    whole = [stretch for stretch in np.split(places, breaks) if len(stretch) > 1]
    single = alone(stretches)
    dots = rr.Points3D(places[single], colors=[colours[codes[i]] for i in single], radii=rr.Radius.ui_points(2.0))
    extent = float(np.linalg.norm(np.ptp(places, axis=0)))
    thin = rr.LineStrips3D(whole, colors=look.PATH, radii=rr.Radius.ui_points(0.7))
    chunks = [
        row(f"{world}/track", rr.LineStrips3D(strips, colors=paint, radii=rr.Radius.ui_points(1.5)), dots),
        row(f"{world}/path", thin),  # beside the hull, where the track would hide it
    ]
    marker: dict[str, Any] = {"radii": rr.Radius.ui_points(7), "colors": colour or look.GOLD}
    chunks.append(row(f"{world}/vehicle/marker", rr.Points3D([[0, 0, 0]], **marker)))
    if colour is None:
        near = float(np.linalg.norm(places[0] - places[-1])) < APART * extent
        both, words = places[[0, -1]], ["start and end", ""] if near else ["start", "end"]
        balls = rr.Points3D(both, colors=[look.GREEN, look.RED], radii=rr.Radius.ui_points(5))
        chunks.append(row(f"{world}/ends", balls))
        chunks.append(row(f"{world}/ends/names", rr.Points3D(both, labels=words, **look.NAMED)))
        note += " It starts at the green point and ends at the red one; the gold one is the vehicle."
    notes = [note] if note else []
    return chunks, [*notes, f"The track is broken at {gaps}."] if gaps else notes


def _track_colours(rows: Array) -> tuple[NDArray[np.int64], list[look.Colour], str]:
    """A colour code for each point of the track, the colours, and what they mean."""
    if np.isfinite(rows[:, 3]).all():
        meaning = ", ".join(f"{name} {look.NAMES[colour]}" for name, colour in look.PHASE_COLOURS.items())
        return rows[:, 3].astype(np.int64), [*look.PHASE_COLOURS.values()], f"Track: {meaning}."
    deepest = max(float(rows[:, 2].max()), 1.0)
    colours = [(200 - 4 * i, 240 - 6 * i, 245 - 2 * i) for i in range(32)]
    meaning = f"Track coloured by depth, light at the surface, dark at {deepest:.0f} m."
    return np.clip(rows[:, 2] / deepest * 31, 0, 31).astype(np.int64), colours, meaning


def fixes(places: Array, count: int, world: str) -> Drawn:
    """Recorded positions at the surface. places : (n, 3), NED, m. count : how many there are in all."""
    import rerun as rr

    if not len(places):
        return [], []
    points = rr.Points3D(places, radii=rr.Radius.ui_points(3.5), colors=look.VIOLET)
    return [row(f"{world}/fixes", points)], [f"Violet points at the surface: {count} recorded positions."]


def arrows(rows: Array, extent: float, world: str) -> Drawn:
    """Arrows of current along the track, level. rows : (n, 5), place and current, north and east, m, m/s."""
    import rerun as rr

    if not len(rows):
        return [], []
    rows = rows[np.unique(np.linspace(0, len(rows) - 1, ARROWS).round().astype(np.int64))]
    vectors = np.column_stack([rows[:, 3:5], np.zeros(len(rows))])
    fastest = float(np.linalg.norm(vectors, axis=1).max())
    if not fastest > 0.0:
        return [], []
    vectors *= 0.11 * extent / fastest
    style = dict[str, Any](colors=look.TEAL, radii=rr.Radius.ui_points(1.1))
    note = f"Teal arrows: current; the longest is {fastest:.2f} m/s."
    return [row(f"{world}/current", rr.Arrows3D(vectors=vectors, origins=rows[:, :3], **style))], [note]
