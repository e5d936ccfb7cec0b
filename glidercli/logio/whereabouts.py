"""Where was it, roughly, if nothing is a fix? Positions interpolated or reckoned, for what can be derived from them.

No sample of latitude or longitude comes from them. Absolute salinity needs a place no closer than the 4 degrees of its
atlas (McDougall et al. 2012), and a vehicle's own reckoning is within some kilometres. A track is drawn through them
where none can be reckoned (derived/track.py).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.records import NO_TIME

__all__ = ["Whereabouts", "joined_whereabouts", "whereabouts"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

EVERY = 600 * 10**9
"""ns; at 0.3 m/s a glider is 200 m further on."""


class Whereabouts(NamedTuple):
    """UTC ns, increasing, and deg north and deg east; (n,) each."""

    time_ns: Times
    latitude: Array
    longitude: Array

    def at(self, times: Times) -> tuple[Array, Array]:
        """Latitude and longitude, deg, at times, UTC ns: linear between positions, held beyond the first and last."""
        unwound = np.unwrap(self.longitude, period=360.0)
        return np.interp(times, self.time_ns, self.latitude), np.interp(times, self.time_ns, unwound)

    @property
    def sparse(self) -> Whereabouts:
        """One in ten minutes, which is enough for what TEOS-10 derives."""
        rows = np.unique(self.time_ns // EVERY, return_index=True)[1]
        return Whereabouts(self.time_ns[rows], self.latitude[rows], self.longitude[rows])

    @property
    def middle(self) -> tuple[float, float]:
        """Median latitude and longitude, deg; the longitude from -180 to 180."""
        longitude = float(np.median(np.unwrap(self.longitude, period=360.0)))
        return float(np.median(self.latitude)), 180.0 - (180.0 - longitude) % 360.0


def whereabouts(time_ns: Times, latitude: Array, longitude: Array) -> Whereabouts | None:
    """The positions that can be, of two at one time the first; None where there is none.

    time_ns : (n,), UTC ns, NO_TIME where there is none. latitude, longitude : (n,), deg, NaN where there is none.
    """
    placed = (np.abs(latitude) <= 90.0) & (np.abs(longitude) <= 360.0) & ((latitude != 0.0) | (longitude != 0.0))
    rows = np.flatnonzero(placed & (time_ns != NO_TIME))
    if not len(rows):
        return None
    rows = rows[np.argsort(time_ns[rows], kind="stable")]
    rows = rows[np.unique(time_ns[rows], return_index=True)[1]]
    return Whereabouts(time_ns[rows], latitude[rows], longitude[rows])


def joined_whereabouts(several: Sequence[Whereabouts | None]) -> Whereabouts | None:
    """Those of several files as one; of two at one time the first file's."""
    told = [one for one in several if one is not None]
    if not told:
        return None
    time_ns, first = np.unique(np.concatenate([one.time_ns for one in told]), return_index=True)
    latitude, longitude = (np.concatenate([one[i] for one in told])[first] for i in (1, 2))
    return Whereabouts(time_ns, latitude, longitude)
