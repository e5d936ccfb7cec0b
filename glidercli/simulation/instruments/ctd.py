"""What does the CTD read, and what does it make of it? Temperature, conductivity, pressure; salinity and density."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean import seawater
from glidercli.simulation.instruments.effects import Chain, Lag
from glidercli.simulation.instruments.pressure import depth_of
from glidercli.simulation.instruments.sensor import Readings, Sensor
from glidercli.simulation.instruments.settings import Ctd
from glidercli.simulation.instruments.truth import Truth
from glidercli.units import DBAR

__all__ = ["CtdSensor"]

Array = NDArray[np.float64]


class CtdSensor(Sensor):
    """A CTD in the water that the simulator flies in; where its intake is out of the water it has no reading.

    The simulated water is density, temperature and pressure; its salinity is the one that gives this density (TEOS-10),
    so that a CTD without errors reads the density that the vehicle flies in. Conductivity is that of the water as the
    cell's wall has warmed or cooled it: T_cell = T - a (T - T_slow), with T_slow the temperature after a first-order
    lag, a the cell's share (Lueck 1990, J. Atmos. Oceanic Technol. 7, 741). Salinity and density come from the three
    readings of one time, so that a lag of temperature behind conductivity makes spikes of salinity.
    """

    def __init__(self, settings: Ctd, seed: int, place: tuple[float, float | None], *, gauge: bool) -> None:
        """place : latitude and longitude, deg, of the formulas. gauge : whether its pressure is the log's."""
        self._settings, self._place = settings, place
        self.channels = (
            *(("depth", "pressure") if gauge else ()),
            "temperature",
            "conductivity",
            "salinity",
            "density",
        )
        s = settings
        self.chains = {
            "temperature": Chain(
                seed, "ctd/temperature", lag=s.temperature_lag_s, bias=s.temperature_bias_degC,
                bias_sigma=s.temperature_bias_sigma_degC, noise=s.temperature_noise_degC,
                resolution=s.temperature_resolution_degC,
            ),
            "conductivity": Chain(
                seed, "ctd/conductivity", lag=s.conductivity_lag_s, bias=s.conductivity_bias_S_m,
                bias_sigma=s.conductivity_bias_sigma_S_m, noise=s.conductivity_noise_S_m,
                resolution=s.conductivity_resolution_S_m,
            ),
            "pressure": Chain(
                seed, "ctd/pressure", unit=DBAR, bias=s.pressure_bias_dbar, bias_sigma=s.pressure_bias_sigma_dbar,
                noise=s.pressure_noise_dbar, resolution=s.pressure_resolution_dbar,
            ),
        }  # fmt: skip
        self._wall = Lag(s.cell_time_s if s.cell_share else 0.0)

    def read(self, truth: Truth, taken: NDArray[np.intp]) -> Readings:
        """Readings of a piece at the rows that are sampled."""
        s, (latitude, longitude) = self._settings, self._place
        water = truth.water(s.position_m)
        cell = water.temperature
        if s.cell_share:
            cell = cell - s.cell_share * (cell - self._wall(truth.times, cell))
        rows = slice(None) if s.conductivity_lag_s else taken  # all that the lag remembers, else what is read
        pressure = water.pressure[rows] / DBAR
        salt = seawater.salinity_of_density(water.density[rows], water.temperature[rows], pressure)
        if not np.isfinite(salt).all():
            i = int(np.flatnonzero(~np.isfinite(salt))[0])
            raise InputError(
                "instruments.ctd",
                f"the water at {water.depth[rows][i]:.1f} m has {water.density[rows][i]:.2f} kg/m3 at "
                f"{water.temperature[rows][i]:.2f} degC, which no salinity gives; needed is a cast with salinity",
            )
        practical = seawater.practical_of_absolute(salt, pressure, longitude, latitude)
        conductivity = seawater.conductivity(practical, cell[rows], pressure)
        C = self.chains["conductivity"]
        read = {
            "temperature": self.chains["temperature"](truth.times, water.temperature, taken),
            "conductivity": C(truth.times, conductivity, taken) if s.conductivity_lag_s else C.reading(conductivity),
            "pressure": self.chains["pressure"].reading(water.pressure[taken]),
        }
        wet = water.wet[taken]
        read = {name: values[wet] for name, values in read.items()}
        dbar = read["pressure"] / DBAR
        read["salinity"] = seawater.practical_salinity(np.maximum(read["conductivity"], 0.0), read["temperature"], dbar)
        absolute = seawater.absolute_salinity(read["salinity"], dbar, longitude, latitude)
        read["density"] = seawater.density(absolute, read["temperature"], dbar)
        read["depth"] = depth_of(read["pressure"], truth.ocean, latitude)
        good = np.isfinite(read["salinity"]) & np.isfinite(read["density"])
        rows_read = taken[wet]
        return {
            name: (rows_read[good], read[name][good]) if name in ("salinity", "density") else (rows_read, read[name])
            for name in self.channels
        }
