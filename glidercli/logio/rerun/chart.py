"""Where on the globe was it? Track, fixes and vehicle on a map in Rerun.

Longitudes run on past 180 deg, so that a track across that meridian is one line.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.settling import row
from glidercli.places import geodetic_of_track

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Line", "chart", "on_chart"]

Array = NDArray[np.float64]
PIXELS, TILE = 430.0, 256.0
"""Width that a map usually has; that of a tile of the whole globe."""
LEAST = 5e-4
"""deg of latitude that a map shows at least."""


class Line(NamedTuple):
    """What one log shows on a map. track, fixes : (n, 2) and (m, 2), latitude and longitude, deg.

    stretches : (n,), which stretch of the track each place is in; the line is broken between them.
    """

    place: str
    track: Array
    stretches: Array
    fixes: Array
    colour: look.Colour
    fix_colour: look.Colour


def on_chart(north: Array, east: Array, about: tuple[float, float]) -> Array:
    """Latitude and longitude, deg, (n, 2), of places north and east of an origin, running on past 180 deg."""
    latitude, longitude = geodetic_of_track(north, east, *about)
    turned = about[1] + 180.0 - np.mod(180.0 - (longitude - about[1]), 360.0)
    return np.stack([latitude, turned], axis=-1)


def chart(lines: list[Line]) -> tuple[list[Chunk], float]:
    """What stands still on the map, and the zoom that shows all of it; at least one line has a point."""
    import rerun as rr

    chunks: list[Chunk] = []
    for line in lines:
        if len(line.track) > 1:
            parts = np.split(line.track, np.flatnonzero(np.diff(line.stretches)) + 1)
            parts = [part for part in parts if len(part) > 1]
            strips = rr.GeoLineStrings(lat_lon=parts, colors=line.colour, radii=rr.Radius.ui_points(1.5))
            chunks.append(row(f"{line.place}/track", strips))
        if len(line.fixes):
            points = rr.GeoPoints(lat_lon=line.fixes, colors=line.fix_colour, radii=rr.Radius.ui_points(4))
            chunks.append(row(f"{line.place}/fixes", points))
    shown = np.concatenate([points for line in lines for points in (line.track, line.fixes)])
    parallel = float(np.cos(np.radians(np.clip(shown[:, 0].mean(), -85.0, 85.0))))
    degrees = max(float(np.ptp(shown[:, 1])) * parallel, float(np.ptp(shown[:, 0])), LEAST)
    return chunks, float(np.log2(360.0 * parallel * PIXELS / TILE / (1.4 * degrees)))
