"""What does a vehicle meet at a depth? Density, pressure, temperature and current there, as kernels read them."""

from __future__ import annotations

from typing import NamedTuple

from glidercli.frames import Vector
from glidercli.kernel import kernel
from glidercli.ocean.profile import Profile, cubic, cubic_slope, locate

__all__ = ["Sea", "Water", "at_depth"]

DENSITY, PRESSURE, TEMPERATURE = 0, 1, 2
"""Columns of the water profile: kg/m3 in situ, Pa, degC."""
NORTH, EAST, DOWN = 0, 1, 2
"""Columns of the current profile, m/s."""


class Water(NamedTuple):
    """The water at one place; SI."""

    density: float
    """kg/m3, in situ."""
    pressure: float
    """Pa, sea pressure; zero in uniform water, where nothing depends on depth."""
    temperature: float
    """degC, in situ; a reference temperature where none was measured."""
    current: Vector
    """m/s over ground, NED."""
    shear: Vector
    """Derivative of the current by depth, 1/s, NED."""
    gravity: float
    """m/s2."""


class Sea(NamedTuple):
    """An ocean as kernels read it: profiles (density, pressure, temperature) and (north, east, down); gravity, m/s2."""

    water: Profile
    current: Profile
    gravity: float


@kernel
def at_depth(sea: Sea, z: float) -> Water:
    """The water at depth z, m, positive down: monotone cubic between samples, end values held beyond them."""
    i, x, _ = locate(sea.water, z)
    j, y, beyond = locate(sea.current, z)
    shear = (0.0, 0.0, 0.0)
    if not beyond:
        shear = (
            cubic_slope(sea.current, j, y, NORTH),
            cubic_slope(sea.current, j, y, EAST),
            cubic_slope(sea.current, j, y, DOWN),
        )
    return Water(
        cubic(sea.water, i, x, DENSITY),
        cubic(sea.water, i, x, PRESSURE),
        cubic(sea.water, i, x, TEMPERATURE),
        (cubic(sea.current, j, y, NORTH), cubic(sea.current, j, y, EAST), cubic(sea.current, j, y, DOWN)),
        shear,
        sea.gravity,
    )
