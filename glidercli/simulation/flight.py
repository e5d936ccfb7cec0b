"""How is a flight flown? Legs one after another, each integrated to its end, the samples and events collected."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError, NoSolutionError
from glidercli.frames import dot, quaternion_from_euler, rotation_ned_body
from glidercli.kernel import compiled, kernel
from glidercli.model.buoyancy import hull_excess, pumped_excess
from glidercli.model.equations import through_water
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Sea, Water, at_depth
from glidercli.simulation.integrator import (
    REACHED_CEILING,
    REACHED_END,
    SIZE,
    STEP_TOO_SMALL,
    controls_at,
    integrate,
    state_of,
)
from glidercli.simulation.reach import range_of_none
from glidercli.simulation.schedule import Schedule

__all__ = ["Excursion", "Flight", "FlightEvent", "fly"]

Array = NDArray[np.float64]

SURFACE = 0.0
FIRST_STEP = 0.05  # s; a fraction of the roll mode's period, the fastest there is

COLUMNS = (
    "north", "east", "down", "q_w", "q_x", "q_y", "q_z", "u", "v", "w", "p", "q", "r", "energy", "mass_position",
    "mass_rotation", "net_buoyancy", "density", "pressure", "temperature", "current_north", "current_east",
    "current_down", "vertical_speed",
)  # fmt: skip
"""Columns of ``Flight.samples``; SI, rad."""


@dataclasses.dataclass(frozen=True)
class FlightEvent:
    """The apogee, or what ended a leg or the flight: time in s, depth in m."""

    name: str
    time: float
    depth: float


@dataclasses.dataclass(frozen=True)
class Excursion:
    """An angle beyond a limit, counted at every step of the integrator.

    limit : rad. duration : s spent beyond it. first, last : s from the start. largest : rad, magnitude.
    """

    name: str
    limit: float
    duration: float
    first: float
    last: float
    largest: float


@dataclasses.dataclass(frozen=True)
class Flight:
    """What came of it.

    times : (n,) s from the start. samples : (n, len(COLUMNS)). depths : least and greatest, m, between samples too.
    distance : m, length of the horizontal track over ground. excess : kg, net buoyancy in the water at the end.
    wall : seconds of integration alone.
    """

    times: Array
    samples: Array
    events: tuple[FlightEvent, ...]
    excursions: tuple[Excursion, ...]
    depths: tuple[float, float]
    distance: float
    excess: float
    evaluations: int
    wall: float

    def column(self, name: str) -> Array:
        """One column of the samples, (n,)."""
        return self.samples[:, COLUMNS.index(name)]


@kernel
def observe(
    times: Array, states: Array, knots: Array, values: Array, sea: Sea, p: Parameters, full: bool, out: Array
) -> None:
    """Fill ``out`` (n, len(COLUMNS)) with what states (n, 15) at times (n,) mean: velocities, controls, water."""
    segment = -1
    for i in range(len(times)):
        while segment < len(knots) - 1 and knots[segment + 1] <= times[i]:
            segment += 1
        y = states[i]
        c = controls_at(knots, values, times[i], segment)
        water = at_depth(sea, y[2])
        s = state_of(y)
        V, Omega = through_water(s, c, water, p, full)
        out[i, 0], out[i, 1], out[i, 2] = s.position
        out[i, 3], out[i, 4], out[i, 5], out[i, 6] = s.q_wxyz
        out[i, 7], out[i, 8], out[i, 9] = V
        out[i, 10], out[i, 11], out[i, 12] = Omega
        out[i, 13] = y[13]
        out[i, 14], out[i, 15], out[i, 16] = c.rrx, c.gamma, c.mb
        out[i, 17], out[i, 18], out[i, 19] = water.density, water.pressure, water.temperature
        out[i, 20], out[i, 21], out[i, 22] = water.current
        out[i, 23] = dot(rotation_ned_body(s.q_wxyz)[2], V) + water.current[2]


def scales_of(p: Parameters) -> Array:
    """Sizes below which an error in a state does not matter, (15,): 1 m, 1, 0.1 m/s and 0.01 rad/s as momentum."""
    mass = 0.1 * (p.ms + p.mr)
    return np.array(
        [math.inf, math.inf, 1.0, 1.0, 1.0, 1.0, 1.0, mass, mass, mass, *(0.01 * i for i in p.Is), math.inf, math.inf]
    )


def _excess(mb: float, water: Water, p: Parameters) -> float:
    """Net buoyancy in the water, kg, sinking positive: what is pumped and what the hull displaces."""
    return pumped_excess(mb, water.density, p) + hull_excess(water.density, water.pressure, water.temperature, p)


def fly(
    legs: Sequence[Schedule],
    sea: Sea,
    p: Parameters,
    *,
    duration: float,
    start_depth: float = 0.0,
    heading: float = 0.0,
    every: float = 1.0,
    rtol: float = 1e-8,
    full: bool = True,
    fitted_angle: float = math.inf,
    plain: bool = False,
) -> Flight:
    """Fly the legs from rest in the water, level, until the last ends, the surface is reached or time is up.

    duration, every : s. start_depth : m. heading : rad. rtol : relative tolerance of the integrator.
    full : the whole model; False leaves out the shear's own term and the momentum of the moving actuator.
    fitted_angle : rad, beyond which angle of attack and sideslip are noted as excursions.
    plain : run the same source without numba, some hundred times slower; for tests.

    Raises
    ------
    InputError
        The vehicle would only float: at the surface its net buoyancy lifts it.
    NoSolutionError
        The step size fell below its limit: the motion cannot be integrated.
    """
    duration, start_depth, rtol = float(duration), float(start_depth), float(rtol)  # one signature, compiled once
    first = controls_at(legs[0].times, legs[0].values, 0.0, -1 if legs[0].times[0] > 0.0 else 0)
    excess = _excess(first.mb, at_depth(sea, start_depth), p)
    if start_depth <= SURFACE and excess <= 0.0:
        raise InputError(
            "net buoyancy",
            f"{first.mb:g} kg leaves {excess:.3g} kg in this water: the vehicle would only float at the surface; give "
            "--start-depth in m, more than 0, or a net buoyancy that sinks it",
        )
    run_leg: Any = integrate if plain else compiled(integrate)
    look: Any = observe if plain else compiled(observe)
    y = np.zeros(SIZE)
    y[2] = start_depth
    y[3:7] = quaternion_from_euler(0.0, 0.0, heading)
    grid = np.arange(1, math.floor(duration / every * (1.0 + 1e-12)) + 1) * every
    t, step, scales = 0.0, FIRST_STEP, scales_of(p)
    reached = range_of_none(start_depth, float(fitted_angle))
    common = (rtol, scales, reached)
    nowhere = (grid[:0], np.empty((0, SIZE)), *common)
    run_leg(y, 0.0, 0.0, step, legs[0].times, legs[0].values, sea, p, full, math.inf, SURFACE, *nowhere)  # compiles
    times, samples, events, evaluations, wall = [0.0], [], [], 0, 0.0
    for number, leg in enumerate(legs):
        knots = leg.times + t
        last_leg = number == len(legs) - 1
        floor = leg.until_depth if y[2] < leg.until_depth else math.inf
        ceiling = leg.until_depth if y[2] > leg.until_depth else SURFACE
        ends_with_controls = math.isnan(leg.until_depth) and not last_leg
        until = min(duration, knots[-1]) if ends_with_controls else duration
        out = np.empty((len(grid), SIZE))
        began = time.perf_counter()
        run = run_leg(y, t, until, step, knots, leg.values, sea, p, full, floor, ceiling, grid, out, *common)
        wall += time.perf_counter() - began
        evaluations += run.evaluations
        if run.status == STEP_TOO_SMALL:
            raise NoSolutionError(f"the motion cannot be integrated beyond {run.time:.3f} s at {run.state[2]:.2f} m")
        inside = grid[(grid > t) & (grid <= run.time)]
        leg_times, leg_states = inside, out[np.searchsorted(grid, inside)]
        if number == 0:
            leg_times, leg_states = np.append(0.0, leg_times), np.vstack([y, leg_states])
        if run.time > (leg_times[-1] if len(leg_times) else t):
            leg_times, leg_states = np.append(leg_times, run.time), np.vstack([leg_states, run.state])
        seen = np.empty((len(leg_times), len(COLUMNS)))
        look(leg_times, leg_states, knots, leg.values, sea, p, full, seen)
        samples.append(seen)
        times.extend(leg_times[1:] if number == 0 else leg_times)
        t, y, step = run.time, run.state, run.step
        surfaced = run.status == REACHED_CEILING and ceiling == SURFACE
        if surfaced:
            events.append(FlightEvent("surfacing", t, float(y[2])))
            break
        name = "end of flight" if last_leg or (t >= duration and run.status == REACHED_END) else f"end of {leg.name}"
        events.append(FlightEvent(name, t, float(y[2])))
        if t >= duration:
            break
    names = ("angle of attack", "sideslip", "roll")
    angles = zip(names, reached.limits.tolist(), reached.angles.tolist(), strict=True)
    (least, _), (greatest, deepest_at) = reached.depths.tolist()
    if deepest_at > 0.0 and greatest > y[2]:
        events.append(FlightEvent("apogee", deepest_at, greatest))
    return Flight(
        times=np.array(times),
        samples=np.vstack(samples),
        events=tuple(sorted(events, key=lambda event: event.time)),
        excursions=tuple(Excursion(name, limit, *row) for name, limit, row in angles if row[0] > 0.0),
        depths=(least, greatest),
        distance=float(y[14]),
        excess=_excess(samples[-1][-1, COLUMNS.index("net_buoyancy")], at_depth(sea, float(y[2])), p),
        evaluations=evaluations,
        wall=wall,
    )
