"""Where was a cast taken, and how much does it matter if nobody knows?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from glidercli.ocean import seawater

__all__ = ["Place", "middle_of"]

Array = NDArray[np.float64]

_ELSEWHERE = 1.0  # deg between the latitude of a cast and that of a flight, worth a word


def middle_of(degrees: Array, name: str) -> float:
    """Median of latitudes or longitudes, (n,), n > 0; of longitudes on both sides of 180 deg it lies between them.

    name : "latitude" or "longitude".
    """
    if name != "longitude":
        return float(np.median(degrees))
    around = degrees[0] + (degrees - degrees[0] + 180.0) % 360.0 - 180.0
    middle = float(np.median(around))
    return middle if -180.0 <= middle <= 360.0 else middle % 360.0


@dataclass(frozen=True)
class Place:
    """Where a cast was taken; ``used`` is the latitude that formulas get when it is not known.

    given, given_longitude : what the caller gave, deg, for a cast that tells none of its own.
    """

    own_latitude: float | None
    own_longitude: float | None
    given: float | None
    given_longitude: float | None

    @property
    def longitude(self) -> float | None:
        """deg, or None where nobody knows."""
        return self.given_longitude if self.own_longitude is None else self.own_longitude

    @property
    def latitude(self) -> float | None:
        """deg, or None where nobody knows."""
        return self.given if self.own_latitude is None else self.own_latitude

    @property
    def used(self) -> float:
        """deg; 0 where nobody knows."""
        return 0.0 if self.latitude is None else self.latitude

    def warnings(self, missing: str | None, salinity_used: bool) -> tuple[str, ...]:
        """What is not known, and how much that matters. missing : "depth" or "pressure" where it had to be computed."""
        lines = []
        if None not in (self.own_latitude, self.given) and abs(self.used - (self.given or 0.0)) > _ELSEWHERE:
            lines.append(f"its own latitude, {self.used:g} deg, is used for it, not the {self.given:g} deg given")
        if self.latitude is None and missing == "depth":
            lines.append(
                "latitude unknown, 0 deg is used: depth for a pressure is too great by up to 0.53 % "
                "(5.2 m at 1000 dbar, at the poles)"
            )
        if self.latitude is None and missing == "pressure":
            lines.append(
                "latitude unknown, 0 deg is used: pressure for a depth is too small by up to 0.53 % "
                "(5.4 dbar at 1000 m, at the poles)"
            )
        told = (("latitude", self.latitude), ("longitude", self.longitude))
        unknown = " and ".join(name for name, value in told if value is None)
        if unknown and salinity_used:
            lines.append(
                f"without {unknown} absolute salinity is the reference salinity: density is too small by "
                "up to 0.02 kg/m3 in the open ocean"
            )
        return tuple(lines)

    def absolute_salinity(self, salinity: Array, pressure: Array) -> Array:
        """SA, g/kg, of a practical salinity at a pressure, dbar; the reference salinity where no place is known."""
        longitude = None if self.latitude is None else self.longitude
        return seawater.absolute_salinity(salinity, pressure, longitude, self.used)
