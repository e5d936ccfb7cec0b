"""What does a vehicle meet at a depth and a time? Density, pressure, temperature and current, as kernels read them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from glidercli.frames import Vector, add, scale
from glidercli.kernel import kernel
from glidercli.ocean.profile import Profile, cubic, cubic_slope, locate, moment, next_moment

__all__ = ["Sea", "Water", "at_depth", "next_change"]

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
    change: Vector = (0.0, 0.0, 0.0)
    """Derivative of the current by time at this depth, m/s2, NED."""


class Sea(NamedTuple):
    """An ocean as kernels read it: profiles (density, pressure, temperature) and (north, east, down); gravity, m/s2."""

    water: Profile
    current: Profile
    gravity: float


@kernel
def at_depth(sea: Sea, z: float, t: float) -> Water:
    """The water at depth z, m, positive down, and time t, s.

    Monotone cubic in depth between samples, linear in time between profiles, end values held beyond both, but for
    pressure, which goes on with the weight of the water.
    """
    number, share = moment(sea.water, t)
    density, pressure, temperature = _density(sea, number, z)
    if share > 0.0:
        later = _density(sea, number + 1, z)
        density += share * (later[0] - density)
        pressure += share * (later[1] - pressure)
        temperature += share * (later[2] - temperature)
    number, share = moment(sea.current, t)
    current, shear = _current(sea.current, number, z)
    change = (0.0, 0.0, 0.0)
    if number + 1 < len(sea.current.times) and t >= sea.current.times[0]:
        after, shear_after = _current(sea.current, number + 1, z)
        change = add(after, scale(-1.0, current))
        current = add(current, scale(share, change))
        shear = add(shear, scale(share, add(shear_after, scale(-1.0, shear))))
        change = scale(1.0 / (sea.current.times[number + 1] - sea.current.times[number]), change)
    return Water(density, pressure, temperature, current, shear, sea.gravity, change)


@kernel
def _density(sea: Sea, number: int, z: float) -> tuple[float, float, float]:
    """Density, pressure and temperature of one profile at a depth, m; beyond its ends pressure is hydrostatic."""
    water = sea.water
    i, x, beyond = locate(water, number, z)
    density, pressure = cubic(water, i, x, DENSITY), cubic(water, i, x, PRESSURE)
    if beyond and water.first[number + 1] - water.first[number] > 1:  # one sample alone is uniform water
        pressure += density * sea.gravity * (z - water.depth[i])
    return density, pressure, cubic(water, i, x, TEMPERATURE)


@kernel
def _current(current: Profile, number: int, z: float) -> tuple[Vector, Vector]:
    """Current, m/s, and its derivative by depth, 1/s, of one profile at a depth, m."""
    i, x, beyond = locate(current, number, z)
    U = (cubic(current, i, x, NORTH), cubic(current, i, x, EAST), cubic(current, i, x, DOWN))
    if beyond:
        return U, (0.0, 0.0, 0.0)
    return U, (
        cubic_slope(current, i, x, NORTH), cubic_slope(current, i, x, EAST), cubic_slope(current, i, x, DOWN),
    )  # fmt: skip


@kernel
def next_change(sea: Sea, t: float) -> float:
    """The next time, s, at which the water begins to change otherwise; infinite where it does not."""
    if len(sea.water.times) == 1 and len(sea.current.times) == 1:
        return np.inf
    return min(next_moment(sea.water, t), next_moment(sea.current, t))
