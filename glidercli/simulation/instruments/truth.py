"""What is true at a sensor's place? The flight on the sampling grid, and the water where the sensor sits."""

from __future__ import annotations

import dataclasses
import functools

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import Matrix, rotation_ned_body
from glidercli.kernel import compiled, kernel
from glidercli.ocean.ocean import Ocean
from glidercli.ocean.water import Sea, at_depth
from glidercli.simulation.sampling import COLUMNS

__all__ = ["Truth", "Waters", "observe_water"]

Array = NDArray[np.float64]
Position = tuple[float, float, float]


@dataclasses.dataclass(frozen=True)
class Waters:
    """The water around a sensor, each (n,): depth, m, 0 out of the water; density, kg/m3; pressure, Pa; temperature,
    degC; whether the sensor is in the water."""

    depth: Array
    density: Array
    pressure: Array
    temperature: Array
    wet: NDArray[np.bool_]


@dataclasses.dataclass(frozen=True)
class Truth:
    """A piece of the flight on the grid that holds every sampling time.

    steps : (n,), number of each row on the grid. times : (n,), s from the start. samples : (n, len(COLUMNS)).
    """

    steps: NDArray[np.int64]
    times: Array
    samples: Array
    ocean: Ocean

    def column(self, name: str) -> Array:
        """One column of the samples, (n,)."""
        return self.samples[:, COLUMNS.index(name)]

    @property
    def q_wxyz(self) -> Array:
        """The attitude of the body, (n, 4)."""
        first = COLUMNS.index("q_w")
        return self.samples[:, first : first + 4]

    @functools.cached_property
    def R_ned_body(self) -> Matrix:
        """The attitude as a matrix whose entries are (n,)."""
        w, x, y, z = np.ascontiguousarray(self.q_wxyz.T)
        return rotation_ned_body((w, x, y, z))

    def along(self, name: str, position: Position) -> Array:
        """north, east or down, m, (n,), of a place in the body frame, m."""
        at, row = self.column(name), ("north", "east", "down").index(name)
        if not any(position):
            return at
        return at + sum(entry * arm for entry, arm in zip(self.R_ned_body[row], position, strict=True))

    def water(self, position: Position) -> Waters:
        """The water at a place in the body frame, m. Pressure in uniform water is density x gravity x depth."""
        down = self.along("down", position)
        depth, ocean = np.maximum(down, 0.0), self.ocean
        met = np.column_stack([self.column(name) for name in ("density", "pressure", "temperature")])
        elsewhere = np.flatnonzero(depth != self.column("down"))
        if len(elsewhere):
            found = np.empty((len(elsewhere), 3))
            compiled(observe_water)(self.times[elsewhere], depth[elsewhere], ocean.sea, found)
            met[elsewhere] = found
        density, pressure, temperature = np.ascontiguousarray(met.T)
        if not ocean.stratified:
            pressure = density * (ocean.gravity * depth)
        return Waters(depth, density, pressure, temperature, down >= 0.0)


@kernel
def observe_water(times: Array, depths: Array, sea: Sea, out: Array) -> None:
    """Density, kg/m3, pressure, Pa, and temperature, degC, (n, 3), at times, s, and depths, m, (n,)."""
    for i in range(len(times)):
        water = at_depth(sea, depths[i], times[i])
        out[i, 0], out[i, 1], out[i, 2] = water.density, water.pressure, water.temperature
