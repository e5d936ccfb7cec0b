"""Where on the globe is a track? North and east as ways along the meridian and the parallel, on WGS-84.

A track of some thousand kilometres is no longer flat: on the plane that touches the globe where it starts, 1,400 km to
the east at 20 degrees north end 50 km too far south. North is therefore a way along the meridian and east one along
the parallel of the middle latitude (middle-latitude sailing), which needs no more than the end points.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["geodetic_of_track", "track_of_geodetic"]

Array = NDArray[np.float64]


def geodetic_of_track(north: ArrayLike, east: ArrayLike, latitude: float, longitude: float) -> tuple[Array, Array]:
    """Latitude and longitude (-180 to 180), deg, (n,), of places north and east, m, (n,), of a place, deg."""
    from pymap3d.rcurve import meridian

    north = np.asarray(north, dtype=np.float64)
    middle = latitude + 0.5 * np.degrees(north / meridian(latitude))
    found = latitude + np.degrees(north / meridian(middle))
    turned = longitude + np.degrees(np.asarray(east) / _parallel(0.5 * (latitude + found)))
    return found, 180.0 - np.mod(180.0 - turned, 360.0)


def track_of_geodetic(
    latitudes: ArrayLike, longitudes: ArrayLike, latitude: float, longitude: float
) -> tuple[Array, Array]:
    """Ways north and east, m, (n,), from a place to others, deg, (n,): the inverse of ``geodetic_of_track``."""
    from pymap3d.rcurve import meridian

    found = np.asarray(latitudes, dtype=np.float64)
    middle = 0.5 * (latitude + found)
    turned = 180.0 - np.mod(180.0 - (np.asarray(longitudes) - longitude), 360.0)
    return np.asarray(meridian(middle) * np.radians(found - latitude)), _parallel(middle) * np.radians(turned)


def _parallel(latitude: Array) -> Array:
    """Radius of a parallel, m; latitude in deg."""
    from pymap3d.rcurve import transverse

    return np.asarray(transverse(latitude) * np.cos(np.radians(latitude)))
