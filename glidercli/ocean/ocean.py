"""What does a vehicle meet at a depth? Water and current as profiles, ready for the compiled integrator."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from glidercli.errors import InputError
from glidercli.frames import Vector
from glidercli.kernel import kernel
from glidercli.ocean import seawater
from glidercli.ocean.cast import Cast
from glidercli.ocean.current import CurrentProfile
from glidercli.ocean.profile import Profile, cubic, cubic_slope, locate, pchip
from glidercli.units import STANDARD_GRAVITY

__all__ = ["Ocean", "Water", "at_depth"]

DENSITY, PRESSURE, TEMPERATURE = 0, 1, 2
"""Columns of the water profile: kg/m3 in situ, dbar, degC."""
NORTH, EAST, DOWN = 0, 1, 2
"""Columns of the current profile, m/s."""


class Water(NamedTuple):
    """The water at one depth."""

    density: float
    """kg/m3, in situ."""
    pressure_dbar: float
    """Sea pressure; zero in uniform water, where nothing depends on depth."""
    temperature: float
    """degC, in situ; the ocean's reference temperature where none was measured."""
    current_ned: Vector
    """m/s over ground."""
    current_shear_ned: Vector
    """Derivative of the current by depth, 1/s."""


@kernel
def at_depth(water: Profile, current: Profile, z: float) -> Water:
    """The water at depth z, m, positive down: monotone cubic between samples, end values held beyond them.

    water : columns density, pressure, temperature. current : columns north, east, down.
    """
    i, x, _ = locate(water, z)
    j, y, beyond = locate(current, z)
    shear = (0.0, 0.0, 0.0)
    if not beyond:
        shear = (
            cubic_slope(current, j, y, NORTH),
            cubic_slope(current, j, y, EAST),
            cubic_slope(current, j, y, DOWN),
        )
    return Water(
        cubic(water, i, x, DENSITY),
        cubic(water, i, x, PRESSURE),
        cubic(water, i, x, TEMPERATURE),
        (cubic(current, j, y, NORTH), cubic(current, j, y, EAST), cubic(current, j, y, DOWN)),
        shear,
    )


@dataclass(frozen=True)
class Ocean:
    """Water and current by depth, and gravity; neither varies with time or place.

    water : profile with the columns density (kg/m3), pressure (dbar), temperature (degC).
    current : profile with the columns north, east, down (m/s).
    gravity : m/s2.
    stratified : whether the water comes from a cast; else it is uniform and has no pressure.
    has_temperature : whether temperature was measured; else its column holds one reference value.
    moving : whether the current comes from a profile; else the water is still.
    warnings : what a reader of results should know, one line each.
    inputs : files that it was made from.
    """

    water: Profile
    current: Profile
    gravity: float
    stratified: bool
    has_temperature: bool
    moving: bool
    warnings: tuple[str, ...] = ()
    inputs: tuple[Path, ...] = ()

    @classmethod
    def uniform(
        cls, density: float, gravity: float = STANDARD_GRAVITY, temperature_reference: float = math.nan
    ) -> Ocean:
        """Still water of one density, kg/m3, at every depth.

        temperature_reference : degC, what ``Water.temperature`` then holds; NaN says that it is not known.
        """
        if not (math.isfinite(density) and density > 0.0):
            raise InputError("ocean", f"density = {density:g} kg/m3, a positive number is needed")
        return cls(
            water=pchip([0.0], [[density, 0.0, temperature_reference]]),
            current=pchip([0.0], [[0.0, 0.0, 0.0]]),
            gravity=gravity,
            stratified=False,
            has_temperature=False,
            moving=False,
        )

    @classmethod
    def build(
        cls,
        density_reference: float,
        cast: Cast | None = None,
        current: CurrentProfile | None = None,
        latitude: float | None = None,
        temperature_reference: float = math.nan,
    ) -> Ocean:
        """The ocean of a cast and a current profile, each of which may be missing.

        Parameters
        ----------
        density_reference : kg/m3, of the uniform water without a cast.
        latitude : degrees north, for gravity at the surface; 9.81 m/s2 without it, whatever the cast's place is.
        temperature_reference : degC, held where the cast has no temperature; NaN says that it is not known.
        """
        gravity = STANDARD_GRAVITY if latitude is None else seawater.gravity(latitude)
        still = cls.uniform(density_reference, gravity, temperature_reference)
        water, flow = still.water, still.current
        if cast is not None:
            unknown = np.full(len(cast.depth), temperature_reference)
            temperature = unknown if cast.temperature is None else cast.temperature
            water = pchip(cast.depth, np.stack([cast.density, cast.pressure_dbar, temperature], axis=1))
        if current is not None:
            flow = pchip(current.depth, np.stack([current.north, current.east, -current.up], axis=1))
        given = [item for item in (cast, current) if item is not None]
        return cls(
            water=water,
            current=flow,
            gravity=gravity,
            stratified=cast is not None,
            has_temperature=cast is not None and cast.temperature is not None,
            moving=current is not None,
            warnings=tuple(f"{item.source}: {line}" for item in given for line in item.warnings),
            inputs=tuple(item.source for item in given),
        )

    def at(self, depth: float) -> Water:
        """The water at one depth, m."""
        return at_depth(self.water, self.current, depth)

    def beyond(self, depth: ArrayLike) -> list[str]:
        """Warnings where depths flown, m, leave the cast or the current profile, whose end values are held there."""
        flown = np.asarray(depth, dtype=float)
        shallowest, deepest = float(flown.min()), float(flown.max())
        warnings = []
        for name, profile, given in (
            ("cast", self.water, self.stratified),
            ("current profile", self.current, self.moving),
        ):
            top, bottom = float(profile.depth[0]), float(profile.depth[-1])
            if given and (shallowest < top or deepest > bottom):
                warnings.append(
                    f"the flight spans {shallowest:.1f} to {deepest:.1f} m, the {name} {top:.1f} to {bottom:.1f} m; "
                    "its end values are held beyond"
                )
        return warnings
