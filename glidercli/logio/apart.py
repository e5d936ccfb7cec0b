"""Are logs side by side so far apart that a scene of both would show two dots? Then each is drawn from its own start.

A scene is as wide as the tracks are apart. From TOO_FAR times the size of the larger track on that track is less than a
tenth of it, some 40 px of the 400 px that it has in a window of 1400 x 800: too little to tell its turns.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from glidercli.log import Log
from glidercli.places import geodetic_of_track

__all__ = ["TOO_FAR", "Apart", "apart", "in_km"]

TOO_FAR = 10.0


class Apart(NamedTuple):
    """How a log is drawn that began too far from another.

    distance : between the starts, m, on the globe. about : latitude and longitude, deg, that it is drawn about, within
    half a turn of the other's. moved : what brings its start to the other's, north and east, m.
    """

    distance: float
    about: tuple[float, float]
    moved: tuple[float, float]


class _Track(NamedTuple):
    """start : north and east of the first place, m, and its latitude and longitude, deg. size : m, its longest side."""

    start: tuple[float, float]
    place: tuple[float, float]
    size: float


def apart(log: Log, other: Log) -> Apart | None:
    """How the other is drawn beside the log; None where one scene holds both, or the place of either is unknown."""
    from pymap3d.vincenty import vdist

    first, second, about = _track(log), _track(other), other.place
    if first is None or second is None or about is None:
        return None
    distance = float(vdist(*first.place, *second.place)[0])
    if distance <= TOO_FAR * max(first.size, second.size):
        return None
    turns = np.round((first.place[1] - about[1]) / 360.0)
    moved = first.start[0] - second.start[0], first.start[1] - second.start[1]
    return Apart(distance, (about[0], about[1] + 360.0 * float(turns)), moved)


def in_km(distance: float) -> str:
    """A distance for a title, of three digits."""
    km = distance / 1000.0
    return f"{km:.2g} km" if km < 10.0 else f"{float(f'{km:.3g}'):,.0f} km"


def _track(log: Log) -> _Track | None:
    """Where a track begins, and how large it is; None where it is unknown."""
    about = log.place
    _, places = log.together("north", "east", "down" if "down" in log else "depth")
    if about is None or not len(places[0]):
        return None
    north, east = float(places[0][0]), float(places[1][0])
    latitude, longitude = geodetic_of_track(north, east, *about)
    return _Track((north, east), (float(latitude), float(longitude)), max(float(np.ptp(way)) for way in places))
