"""What does the pressure sensor read, and how deep does the vehicle think that it is?"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.ocean import seawater
from glidercli.ocean.ocean import Ocean
from glidercli.simulation.instruments.effects import Chain
from glidercli.simulation.instruments.sensor import Readings, Sensor
from glidercli.simulation.instruments.settings import Pressure
from glidercli.simulation.instruments.truth import Truth
from glidercli.units import DBAR

__all__ = ["PressureSensor", "depth_of"]

Array = NDArray[np.float64]


class PressureSensor(Sensor):
    """Pressure at the port, and depth from the reading; a port out of the water reads the pressure of the surface."""

    channels = ("depth", "pressure")

    def __init__(self, settings: Pressure, seed: int, latitude: float) -> None:
        """latitude : deg, of the formula for depth."""
        self._position, self._latitude = settings.position_m, latitude
        self.chains = {
            "pressure": Chain(
                seed, "pressure/pressure", unit=DBAR, lag=settings.lag_s, bias=settings.bias_dbar,
                bias_sigma=settings.bias_sigma_dbar, noise=settings.noise_dbar, resolution=settings.resolution_dbar,
            )
        }  # fmt: skip

    def read(self, truth: Truth, taken: NDArray[np.intp]) -> Readings:
        """Readings of a piece at the rows that are sampled."""
        pressure = self.chains["pressure"](truth.times, truth.water(self._position).pressure, taken)
        return {"depth": (taken, depth_of(pressure, truth.ocean, self._latitude)), "pressure": (taken, pressure)}


def depth_of(pressure: Array, ocean: Ocean, latitude: float) -> Array:
    """Depth, m, that a pressure reading, Pa, stands for.

    By TEOS-10 in standard water at a latitude, deg, as for recorded logs; in uniform water by its own weight.
    """
    if ocean.stratified:
        return seawater.depth_from_pressure(pressure / DBAR, latitude)
    return np.asarray(pressure / (ocean.at(0.0).density * ocean.gravity))
