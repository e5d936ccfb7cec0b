"""Which samples of a record or a grid can be used, and how do they become a cast? Ranges, then TEOS-10.

A table is read strictly (table.py). A log or a NetCDF file is a machine's: what is missing or cannot be true there is
left out, and counted under the first reason that holds.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean import seawater
from glidercli.ocean.cast import Cast
from glidercli.ocean.counting import counted
from glidercli.ocean.downcast import CONDUCTIVITY, DEEPEST_DBAR, DENSITY, IN_AIR, SALINITY, TEMPERATURE
from glidercli.ocean.place import Place
from glidercli.ocean.series import Moment

__all__ = ["Measured", "cast_of", "usable"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


class Measured(NamedTuple):
    """What was measured, (n,) each with NaN where there is no value; None for what was not measured at all."""

    depth: Array | None
    """m, positive down; this or the pressure is needed."""
    pressure_dbar: Array | None
    temperature: Array | None = None
    """degC, in situ."""
    salinity: Array | None = None
    """Practical."""
    absolute_salinity: Array | None = None
    """g/kg."""
    conductivity: Array | None = None
    """S/m."""
    density: Array | None = None
    """kg/m3, in situ."""

    def checked(self, source: object, names: str) -> Measured:
        """These, less what is not needed, if they make a density; else InputError. names : what the source has."""
        if self.depth is None and self.pressure_dbar is None:
            raise InputError(source, f"has neither depth nor pressure; it has {names}")
        salty = self.salinity is not None or self.absolute_salinity is not None or self.conductivity is not None
        if self.temperature is not None and salty:
            known = self.salinity is not None or self.absolute_salinity is not None
            return self._replace(density=None, conductivity=None if known else self.conductivity)
        if self.density is not None:
            return self._replace(salinity=None, absolute_salinity=None, conductivity=None)
        needed = "temperature with salinity, absolute salinity or conductivity, or density"
        raise InputError(source, f"has no water that can be used: needed are {needed}; it has {names}")

    def rows(self, kept: Mask | NDArray[np.intp]) -> Measured:
        """Some of the samples."""
        return Measured(*(None if column is None else column[kept] for column in self))


def usable(water: Measured, inside: Mask | None = None) -> tuple[Mask, tuple[tuple[str, int], ...]]:
    """Which samples lack nothing and can be true, (n,), and what is left out as (reason, count).

    inside : (n,), the samples to look at; the others are neither kept nor counted.
    """
    ranges = (
        ("depth", "m", water.depth, (0.0, DEEPEST_DBAR)),
        ("pressure", "dbar", water.pressure_dbar, (0.0, DEEPEST_DBAR)),
        ("temperature", "degC", water.temperature, TEMPERATURE),
        ("salinity", "", water.salinity, SALINITY),
        ("absolute salinity", "g/kg", water.absolute_salinity, SALINITY),
        ("conductivity", "S/m", water.conductivity, CONDUCTIVITY),
        ("density", "kg/m3", water.density, DENSITY),
    )
    faults: list[tuple[str, Mask]] = []
    there = [(name, unit, values, limits) for name, unit, values, limits in ranges if values is not None]
    faults += [(f"without {name}", ~np.isfinite(values)) for name, _, values, _ in there]
    salts = (water.salinity, water.absolute_salinity, water.conductivity)
    idle = [values == 0.0 for values in (water.temperature, *salts) if values is not None]
    if water.temperature is not None and len(idle) > 1:
        faults.append(("temperature and salinity both zero", np.all(idle, axis=0)))
    if water.conductivity is not None:
        faults.append(("in air", water.conductivity < IN_AIR))
    for name, unit, values, (low, high) in there:
        low = -1.0 if values is water.depth or values is water.pressure_dbar else low  # swell, a drifting zero
        outside = (values < low) | (values > high)
        faults.append((f"{name} outside {low:g}..{high:g} {unit}".strip(), outside))
    kept = np.ones(len(there[0][2]), dtype=bool) if inside is None else inside.copy()
    dropped = counted(faults, kept)
    return kept, dropped


def cast_of(
    water: Measured,
    place: Place,
    source: Path,
    *,
    moment: Moment | None = None,
    time_utc: str | None = None,
    dropped: tuple[tuple[str, int], ...] = (),
    warnings: tuple[str, ...] = (),
    reconstructed: bool = False,
) -> Cast:
    """The cast of samples that are usable, by strictly increasing depth or pressure; density by TEOS-10 from salinity.

    Where the depth is known and the pressure not, or the other way round, one comes from the other at the place.
    """
    depth, pressure = water.depth, water.pressure_dbar
    if pressure is None:
        assert depth is not None
        pressure = seawater.pressure_from_depth(np.maximum(depth, 0.0), place.used)
    if depth is None:
        depth = seawater.depth_from_pressure(pressure, place.used)
    temperature, salinity, absolute = water.temperature, water.salinity, water.absolute_salinity
    density = water.density
    if temperature is not None and density is None:
        if salinity is None and water.conductivity is not None:
            salinity = seawater.practical_salinity(water.conductivity, temperature, pressure)
        if absolute is None:
            assert salinity is not None
            absolute = place.absolute_salinity(salinity, pressure)
        density = seawater.density(absolute, temperature, pressure)
    assert density is not None
    return Cast(
        depth, pressure, temperature, salinity, absolute, density, place.latitude, place.longitude, time_utc, source,
        dropped, warnings, reconstructed, moment,
    )  # fmt: skip
