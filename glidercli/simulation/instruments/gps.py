"""Where does the GPS see the vehicle? Fixes while the antenna is out of the water, some time after it came up."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.places import geodetic_of_track
from glidercli.simulation.instruments.effects import Chain
from glidercli.simulation.instruments.sensor import Readings, Sensor
from glidercli.simulation.instruments.settings import Gps
from glidercli.simulation.instruments.truth import Truth

__all__ = ["GpsSensor"]

_ROUNDING = 1e-6  # s, of times on the grid


class GpsSensor(Sensor):
    """Latitude and longitude of the antenna.

    It sees the sky while its depth is at most antenna_depth_m, looked at on the sampling grid; the first fix comes
    first_fix_s after that began. A flight that begins at the surface begins with the receiver switched on.
    """

    channels = ("latitude", "longitude")

    def __init__(self, settings: Gps, seed: int, place: tuple[float, float]) -> None:
        """place : latitude and longitude, deg, that north and east count from."""
        self._settings, self._place = settings, place
        errors = {"bias_sigma": settings.bias_sigma_m, "noise": settings.noise_m}
        self.chains = {
            "north": Chain(seed, "gps/north", bias=settings.bias_north_m, **errors),
            "east": Chain(seed, "gps/east", bias=settings.bias_east_m, **errors),
        }
        self._up_since = np.inf  # s; infinite under water

    def read(self, truth: Truth, taken: NDArray[np.intp]) -> Readings:
        """Readings of a piece at the rows that are sampled and have a fix."""
        s, times = self._settings, truth.times
        up = truth.along("down", s.position_m) <= s.antenna_depth_m
        rises = up & ~np.concatenate([[np.isfinite(self._up_since)], up[:-1]])
        began = np.where(up, np.maximum.accumulate(np.where(rises, times, -np.inf)), np.inf)
        began[np.isneginf(began)] = self._up_since  # up since an earlier piece
        self._up_since = began[-1]
        track = [self.chains[name].reading(truth.along(name, s.position_m)[taken]) for name in ("north", "east")]
        fixed = (times - began >= s.first_fix_s - _ROUNDING)[taken]
        angles = geodetic_of_track(track[0][fixed], track[1][fixed], *self._place)
        if s.resolution_deg:
            angles = (
                np.round(angles[0] / s.resolution_deg) * s.resolution_deg,
                np.round(angles[1] / s.resolution_deg) * s.resolution_deg,
            )
        return {name: (taken[fixed], values) for name, values in zip(self.channels, angles, strict=True)}
