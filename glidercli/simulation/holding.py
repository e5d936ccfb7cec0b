"""What holds a vehicle at the surface or on the bottom, and until when? Its net buoyancy; meanwhile it lies level."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import rotation_ned_body, scale, times, transposed
from glidercli.kernel import kernel
from glidercli.model.buoyancy import hull_excess, pumped_excess
from glidercli.model.mass import momentum
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Sea, Water, at_depth
from glidercli.simulation.actuators import drive_pressure
from glidercli.simulation.memory import (
    AT_SURFACE,
    HELD,
    ON_BOTTOM,
    ROW,
    T,
)
from glidercli.simulation.sampling import record
from glidercli.simulation.stepper import PUMP_WORK, SIZE, TRACK, Segment, controls_at, state_of

__all__ = ["SURFACE", "Walls", "drift", "held_until", "net_excess", "rest", "walls"]

Array = NDArray[np.float64]

SURFACE = 0.0
_CLEARANCE = 0.1  # m, a hull's radius
_NEUTRAL = 1e-12  # kg; rounding of a net buoyancy that has just become zero


class Walls(NamedTuple):
    """Depths, m, at which surface and bottom stop a vehicle."""

    surface: float
    bottom: float


@kernel
def walls(bottom: float, excess: float) -> Walls:
    """Where surface and bottom stop a vehicle of this net buoyancy in the water, kg, over a bottom at this depth, m.

    Only what is light surfaces, and only what is heavy grounds. While a heavy vehicle at the surface turns over, its
    centre of mass sinks but its origin may rise by as much as they are apart; it comes down again by itself. Water that
    moves upward is another matter: it lifts it no further than a hull's radius. A light one on the bottom likewise.
    """
    return Walls(
        SURFACE if excess < -_NEUTRAL else SURFACE - _CLEARANCE, bottom if excess > _NEUTRAL else bottom + _CLEARANCE
    )


@kernel
def net_excess(mb: float, water: Water, p: Parameters) -> float:
    """Net buoyancy in the water, kg, sinking positive: what is pumped and what the hull displaces."""
    return pumped_excess(mb, water.density, p) + hull_excess(water.density, water.pressure, water.temperature, p)


@kernel
def rest(y: Array, c: Controls, water: Water, p: Parameters, drifts: bool) -> None:
    """Lay the vehicle level and at rest at its heading: in the water, if it drifts with it, else over ground."""
    R = rotation_ned_body(state_of(y).q_wxyz)
    heading = math.atan2(R[1][0], R[0][0])
    y[3], y[4], y[5], y[6] = math.cos(0.5 * heading), 0.0, 0.0, math.sin(0.5 * heading)
    V = (0.0, 0.0, 0.0)
    if not drifts:
        V = scale(-1.0, times(transposed(rotation_ned_body((y[3], y[4], y[5], y[6]))), water.current))
    P, Pi = momentum(V, (0.0, 0.0, 0.0), c, water.density / p.rho_ref, p)
    y[7], y[8], y[9] = P
    y[10], y[11], y[12] = Pi


@kernel
def held_until(y: Array, m: Array, segment: Segment, stop: float, water: Water, p: Parameters) -> float:
    """When the vehicle leaves surface or bottom: now, when a steady pump makes it neutral, or at ``stop``.

    A neutral one leaves only if the pump goes on to carry it off.
    """
    down = 1.0 if m[HELD] == AT_SURFACE else -1.0
    mb = controls_at(segment, m[T]).mb
    excess = down * net_excess(mb, water, p)
    if excess > _NEUTRAL or (excess > -_NEUTRAL and down * segment.mb_rate > 0.0):
        return float(m[T])
    neutral = -hull_excess(water.density, water.pressure, water.temperature, p) * p.rho_0 / water.density
    if down * segment.mb_rate > 0.0:
        return min(stop, float(m[T]) + (neutral - mb) / segment.mb_rate)
    return stop


@kernel
def drift(
    y: Array, m: Array, segment: Segment, stop: float, sea: Sea, every: float, out: Array, first: float, work: Array
) -> None:
    """Hold the vehicle until ``stop``, s: at the surface it goes with the current there, on the bottom nowhere."""
    start = m[T]
    for j in range(SIZE):
        work[j] = y[j]
    while m[ROW] * every <= stop:
        t = m[ROW] * every
        _carry(work, y, m[HELD], start, t, sea)
        record(out[int(m[ROW] - first)], work, controls_at(segment, t))
        m[ROW] += 1.0
    _carry(work, y, m[HELD], start, stop, sea)
    y[0], y[1], y[TRACK] = work[0], work[1], work[TRACK]
    y[PUMP_WORK] += segment.oil_rate * drive_pressure(at_depth(sea, y[2], start), y[2]) * (stop - start)


@kernel
def _carry(out: Array, y: Array, held: float, start: float, t: float, sea: Sea) -> None:
    """Where the current, linear in time, has carried the vehicle since ``start``, s; on the bottom nowhere."""
    if held == ON_BOTTOM:
        return
    before, after = at_depth(sea, y[2], start).current, at_depth(sea, y[2], t).current
    north, east = 0.5 * (before[0] + after[0]) * (t - start), 0.5 * (before[1] + after[1]) * (t - start)
    out[0], out[1] = y[0] + north, y[1] + east
    out[TRACK] = y[TRACK] + math.sqrt(north * north + east * east)
