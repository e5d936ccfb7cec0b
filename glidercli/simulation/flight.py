"""How is a flight flown? Leg after leg, stretch after stretch, the samples and events collected on the way."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError, NoSolutionError
from glidercli.frames import dot, quaternion_from_euler, rotation_ned_body
from glidercli.kernel import compiled, kernel
from glidercli.model.mass import momentum, placement, velocity
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Sea, at_depth
from glidercli.simulation.actuators import Drives
from glidercli.simulation.legs import Leg, Situation
from glidercli.simulation.reach import range_of_none
from glidercli.simulation.stepper import DRIFT, PUMP_WORK, SIZE, TRACK, state_of
from glidercli.simulation.stretch import (
    APOGEE,
    AT_DEPTH,
    AT_SURFACE,
    BLEEDING,
    COMMAND_MB,
    COMMAND_RRX,
    EVALUATIONS,
    EVENTS,
    GAMMA,
    GOING_ON,
    GROUNDED,
    HELD,
    LEG_START,
    LIMITS,
    LOGGED,
    MB,
    PUMPED,
    PUMPING,
    ROTATING,
    ROW,
    RRX,
    SAMPLES,
    SLIDING,
    STEP_TOO_SMALL,
    SURFACE,
    SURFACED,
    TURN,
    Ends,
    T,
    fly_stretch,
    net_excess,
    new_memory,
)

__all__ = ["Excursion", "Flight", "FlightEvent", "Start", "Tallies", "fly"]

Array = NDArray[np.float64]

STRETCH = 600.0  # s; steps end at its multiples, so that a flight is the same however it is looked at
_MOST_EVENTS = 1000  # in a stretch
IDEAL = Drives(
    -math.inf, math.inf, math.inf, -math.inf, math.inf, math.inf, -math.inf, math.inf, math.inf, 0.0, math.inf, math.inf
)
"""Actuators of flights whose controls stand in a table; nothing commands them."""

COLUMNS = (
    "north", "east", "down", "q_w", "q_x", "q_y", "q_z", "u", "v", "w", "p", "q", "r", "energy", "mass_position",
    "mass_rotation", "net_buoyancy", "density", "pressure", "temperature", "current_north", "current_east",
    "current_down", "vertical_speed",
)  # fmt: skip
"""Columns of ``Flight.samples``; SI, rad."""


@dataclasses.dataclass(frozen=True)
class FlightEvent:
    """What happened: the apogee of a dive, the end of a leg, a limit that was met. Time in s, depth in m."""

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
class Tallies:
    """What the motors did: seconds that slide, rotation and pump ran, m3 pumped out, work against the sea in J."""

    sliding: float
    rotating: float
    pumping: float
    letting_in: float
    pumped: float
    pump_work: float


@dataclasses.dataclass(frozen=True)
class Start:
    """How a flight begins: m, rad, m/s through water in the body frame, rad/s; by default at rest, level, northward."""

    depth: float = 0.0
    north: float = 0.0
    east: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    heading: float = 0.0
    V: tuple[float, float, float] = (0.0, 0.0, 0.0)
    Omega: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclasses.dataclass(frozen=True)
class Flight:
    """What came of it.

    times : (n,) s from the start. samples : (n, len(COLUMNS)); both only what was not handed to a sink.
    last : the last sample. depths : least and greatest, m, between samples too.
    distance : m, length of the horizontal track over ground. excess : kg, net buoyancy in the water at the end.
    wall : seconds of integration alone.
    """

    times: Array
    samples: Array
    duration: float
    last: Array
    events: tuple[FlightEvent, ...]
    excursions: tuple[Excursion, ...]
    depths: tuple[float, float]
    distance: float
    excess: float
    tallies: Tallies
    evaluations: int
    wall: float

    def column(self, name: str) -> Array:
        """One column of the samples, (n,)."""
        return self.samples[:, COLUMNS.index(name)]

    def final(self, name: str) -> float:
        """One column of the last sample."""
        return float(self.last[COLUMNS.index(name)])


@kernel
def observe(rows: Array, sea: Sea, p: Parameters, full: bool, out: Array) -> None:
    """Fill ``out`` (n, len(COLUMNS)) with what rows (n, 23) of states and controls mean: velocities, water."""
    for i in range(len(rows)):
        y = rows[i]
        c = Controls(y[SIZE], y[SIZE + 1], y[SIZE + 2], y[SIZE + 3], y[SIZE + 4])
        water = at_depth(sea, y[2])
        s = state_of(y)
        V, Omega = velocity(s.P, s.Pi, placement(c, p, full), water.density / p.rho_ref, p)
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
    """Sizes below which an error in a state does not matter, (18,): 1 m, 1, 0.1 m/s and 0.1 rad/s as momentum."""
    mass, roll, pitch, yaw = (
        0.1 * (p.ms + p.mr),
        *(0.1 * (rigid + water) for rigid, water in zip(p.Is, p.IA, strict=True)),
    )
    none = [math.inf] * 5
    return np.array([*none[:2], 1.0, 1.0, 1.0, 1.0, 1.0, mass, mass, mass, roll, pitch, yaw, *none])


class _Collected:
    """The samples of a flight that nobody takes away."""

    def __init__(self) -> None:
        self.times: list[Array] = []
        self.samples: list[Array] = []

    def add(self, times: Array, samples: Array) -> None:
        self.times.append(times)
        self.samples.append(samples)


def fly(
    legs: Iterable[Leg],
    sea: Sea,
    p: Parameters,
    *,
    duration: float = math.inf,
    start: Start | None = None,
    controls: tuple[float, float, float] | None = None,
    drives: Drives = IDEAL,
    bottom: float = math.inf,
    every: float = 1.0,
    rtol: float = 1e-6,
    full: bool = True,
    fitted_angle: float = math.inf,
    floats: bool = False,
    plain: bool = False,
    sink: Callable[[Array, Array], None] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Flight:
    """Fly the legs until the last ends or time is up.

    duration, every : s. start : default at rest at the surface, level, heading north.
    controls : of the start (m, rad, kg); default what the table of the first leg begins with.
    drives : limits and rates of the actuators, for legs that are steered. bottom : m.
    rtol : relative tolerance of the integrator.
    full : the whole model; False leaves out the water's own acceleration and the momentum of the moving actuator.
    fitted_angle : rad, beyond which angle of attack and sideslip are noted as excursions.
    floats : whether a vehicle that is too light to leave the surface is held there; else that is an error.
    plain : run the same source without numba, some hundred times slower; for tests.
    sink : is given times (n,) and samples (n, len(COLUMNS)) as they come, in place of Flight.times and samples.
    progress : is told the time of the flight, s, from stretch to stretch.

    Raises
    ------
    InputError
        The vehicle would only float: at the surface its net buoyancy lifts it.
    NoSolutionError
        The step size fell below its limit: the motion cannot be integrated.
    """
    start, duration, rtol, every = start or Start(), float(duration), float(rtol), float(every)
    run: Any = fly_stretch if plain else compiled(fly_stretch)
    look: Any = observe if plain else compiled(observe)
    collected = _Collected()
    take = sink or collected.add
    queue = iter(legs)
    leg: Leg | None = next(queue)
    assert leg is not None
    y, m = _begin(start, controls or _first_controls(leg), sea, p, floats)
    reached, log = range_of_none(float(y[2]), float(fitted_angle)), np.zeros((_MOST_EVENTS, 3))
    events: list[FlightEvent] = []
    dive, wall, last_time = _Dive(y), 0.0, 0.0

    def seen(rows: Array, times: Array) -> Array:
        samples = np.empty((len(rows), len(COLUMNS)))
        look(rows, sea, p, full, samples)
        take(times, samples)
        return np.array(samples[-1])

    last = seen(_row(y, m), np.zeros(1))
    while leg is not None:
        following = next(queue, None)
        order = leg.order(dive.situation(y, m)) if callable(leg.order) else leg.order
        ends = _ends(leg, y, m, following is None, duration, bottom)
        m[LEG_START], m[SAMPLES], m[TURN], m[LIMITS] = m[T], 0.0, 0.0, 0.0
        commands = (order.mass_position, order.mass_rotation, order.net_buoyancy) if leg.steered else math.nan
        m[COMMAND_RRX : COMMAND_MB + 1] = commands
        given = (order, drives, leg.times, leg.values, ends, sea, p, full, every)
        common = (rtol, scales_of(p), reached, log)
        run(y, m, -math.inf, *given, np.empty((0, SIZE + 5)), *common)  # compiles, if it must
        there = (leg.goes == "down" and y[2] >= ends.floor) or (leg.goes == "up" and y[2] <= ends.ceiling)
        status, apogee = AT_DEPTH if there else GOING_ON, None
        while status == GOING_ON:
            out = np.empty((int(STRETCH / every) + 2, SIZE + 5))
            first, began = int(m[ROW]), time.perf_counter()
            status = run(y, m, (math.floor(m[T] / STRETCH) + 1.0) * STRETCH, *given, out, *common)
            wall += time.perf_counter() - began
            if status == STEP_TOO_SMALL:
                raise NoSolutionError(f"the motion cannot be integrated beyond {m[T]:.3f} s at {y[2]:.2f} m")
            rows = int(m[ROW]) - first
            if rows:
                times = every * np.arange(first, first + rows, dtype=np.float64)
                last, last_time = seen(out[:rows], times), float(times[-1])
            for kind, at, depth in log[: int(m[LOGGED])].tolist():
                event = FlightEvent(EVENTS[int(kind)], at, depth)
                if int(kind) != APOGEE:
                    events.append(event)
                elif apogee is None or depth > apogee.depth:
                    apogee = event
            m[LOGGED] = 0.0
            if progress:
                progress(float(m[T]))
        if m[T] > last_time:
            last, last_time = seen(_row(y, m), np.full(1, float(m[T]))), float(m[T])
        events += [apogee] if apogee else []
        dive.note(y, m)
        over = following is None or m[T] >= duration
        if status not in (SURFACED, GROUNDED):
            events.append(FlightEvent("end of flight" if over else f"end of {leg.name}", float(m[T]), float(y[2])))
        leg = None if over else following
    names = ("angle of attack", "sideslip", "roll")
    angles = zip(names, reached.limits.tolist(), reached.angles.tolist(), strict=True)
    return Flight(
        times=np.concatenate(collected.times) if collected.times else np.empty(0),
        samples=np.vstack(collected.samples) if collected.samples else np.empty((0, len(COLUMNS))),
        duration=float(m[T]),
        last=last,
        events=tuple(sorted(events, key=lambda event: event.time)),
        excursions=tuple(Excursion(name, limit, *row) for name, limit, row in angles if row[0] > 0.0),
        depths=(float(reached.depths[0, 0]), float(reached.depths[1, 0])),
        distance=float(y[TRACK]),
        excess=net_excess(float(last[COLUMNS.index("net_buoyancy")]), at_depth(sea, float(y[2])), p),
        tallies=Tallies(
            sliding=float(m[SLIDING]),
            rotating=float(m[ROTATING]),
            pumping=float(m[PUMPING]),
            letting_in=float(m[BLEEDING]),
            pumped=float(m[PUMPED]),
            pump_work=float(y[PUMP_WORK]),
        ),
        evaluations=int(m[EVALUATIONS]),
        wall=wall,
    )


class _Dive:
    """What the vehicle can know of the current: how far it was carried since it last left the surface."""

    def __init__(self, y: Array) -> None:
        self.since, self.drift, self.current = 0.0, y[DRIFT : DRIFT + 2].copy(), (0.0, 0.0)

    def note(self, y: Array, m: Array) -> None:
        """At the end of a leg: at the surface a fix tells what the current was."""
        if m[HELD] == AT_SURFACE and m[T] > self.since:
            carried = (y[DRIFT : DRIFT + 2] - self.drift) / (m[T] - self.since)
            self.current = (float(carried[0]), float(carried[1]))
            self.since, self.drift = float(m[T]), y[DRIFT : DRIFT + 2].copy()

    def situation(self, y: Array, m: Array) -> Situation:
        controls = (float(m[RRX]), float(m[GAMMA]), float(m[MB]))
        return Situation(float(m[T]), float(y[0]), float(y[1]), float(y[2]), controls, self.current)


def _first_controls(leg: Leg) -> tuple[float, float, float]:
    return float(leg.values[0, 0]), float(leg.values[0, 1]), float(leg.values[0, 2])


def _begin(
    start: Start, controls: tuple[float, float, float], sea: Sea, p: Parameters, floats: bool
) -> tuple[Array, Array]:
    """State and memory of the start; a vehicle too light for the surface is held there, or refused."""
    y = np.zeros(SIZE)
    y[:3] = start.north, start.east, start.depth
    y[3:7] = quaternion_from_euler(start.roll, start.pitch, start.heading)
    c, water = Controls(*controls), at_depth(sea, start.depth)
    P, Pi = momentum(start.V, start.Omega, c, water.density / p.rho_ref, p)
    y[7:10], y[10:13] = P, Pi
    m = new_memory(controls, start.heading)
    excess = net_excess(c.mb, water, p)
    if start.depth <= SURFACE and excess <= 0.0:
        if not floats:
            raise InputError(
                "net buoyancy",
                f"{c.mb:g} kg leaves {excess:.3g} kg in this water: the vehicle would only float at the surface; give "
                "--start-depth in m, more than 0, or a net buoyancy that sinks it",
            )
        m[HELD] = AT_SURFACE
    return y, m


def _row(y: Array, m: Array) -> Array:
    """The present as one row for ``observe``, the actuators at rest."""
    return np.array([[*y, m[RRX], m[GAMMA], m[MB], 0.0, 0.0]])


def _ends(leg: Leg, y: Array, m: Array, last: bool, duration: float, bottom: float) -> Ends:
    """The ends of a leg that begins now."""
    depth, until = float(y[2]), leg.until_depth
    goes = leg.goes or ("down" if depth < until else "up")
    floor = until if goes == "down" and not math.isnan(until) else math.inf
    if not math.isnan(leg.until_altitude):
        floor = min(floor, bottom - leg.until_altitude)
    stop = min(duration, float(m[T]) + leg.duration)
    if not leg.steered and math.isnan(until) and not last:
        stop = min(stop, float(m[T] + leg.times[-1]))
    return Ends(
        floor=floor,
        ceiling=until if goes == "up" and not math.isnan(until) else SURFACE,
        bottom=float(bottom),
        time=stop,
        turn=2.0 * math.pi * float(leg.turns),
        surface_ends=leg.surface_ends,
    )
