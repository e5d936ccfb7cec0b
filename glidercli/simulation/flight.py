"""How is a flight flown? Leg after leg, stretch after stretch, the samples and events collected on the way."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError, NoSolutionError
from glidercli.kernel import compiled
from glidercli.model.mass import momentum
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Sea, at_depth
from glidercli.simulation.actuators import Drives
from glidercli.simulation.autopilot import Order
from glidercli.simulation.carrying import check_reach
from glidercli.simulation.holding import SURFACE, net_excess
from glidercli.simulation.legs import Leg
from glidercli.simulation.locating import Ends, turned
from glidercli.simulation.memory import (
    APOGEE,
    AT_DEPTH,
    AT_SURFACE,
    COMMAND_MB,
    COMMAND_RRX,
    EVALUATIONS,
    EVENTS,
    GAMMA,
    GAMMA_RATE,
    GOING_ON,
    GROUNDED,
    HEADING,
    HELD,
    LEG_START,
    LIMITS,
    LOGGED,
    MB,
    PUMPED,
    ROTATED,
    ROW,
    RRX,
    RRX_RATE,
    SAMPLES,
    SLID,
    STEP_TOO_SMALL,
    SURFACED,
    TURN,
    T,
    new_memory,
)
from glidercli.simulation.reach import range_of_none
from glidercli.simulation.sampling import COLUMNS, ROW_WIDTH, observe
from glidercli.simulation.start import REST, Start
from glidercli.simulation.stepper import PUMP_WORK, SIZE, TRACK
from glidercli.simulation.stretch import fly_stretch

__all__ = ["Excursion", "Flight", "FlightEvent", "Tallies", "fly"]

Array = NDArray[np.float64]

STRETCH = 600.0  # s; steps end at its multiples, so that a flight is the same however it is looked at
MOST_SAMPLES = 10_000_000  # some 5 GB of log
LONGEST_LEG = 5 * 86400.0  # s; at 0.1 m/s the deepest trench is 30 hours away
_MOST_EVENTS = 1000  # in a stretch
_PIECE = 50_000  # samples given away at once, some 20 MB
IDEAL = Drives(
    -math.inf, math.inf, math.inf, -math.inf, math.inf, math.inf, -math.inf, math.inf, math.inf, 0.0, math.inf, math.inf
)
"""Actuators of flights whose controls stand in a table; nothing commands them."""


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
    """What the motors did: travel of slide (m) and rotation (rad), either way; oil pumped out, m3, and its work against
    the sea, J."""

    slid: float
    rotated: float
    pumped: float
    pump_work: float


@dataclasses.dataclass(frozen=True)
class Flight:
    """What came of it.

    times : (n,) s from the start. samples : (n, len(COLUMNS)). depths : least and greatest, m, between samples too.
    distance : m, length of the horizontal track over ground. excess : kg, net buoyancy in the water at the end.
    skipped : what is to be said of legs that began beyond their end. wall : seconds of integration alone.
    """

    times: Array
    samples: Array
    events: tuple[FlightEvent, ...]
    excursions: tuple[Excursion, ...]
    depths: tuple[float, float]
    start_depth: float
    distance: float
    excess: float
    tallies: Tallies
    skipped: tuple[str, ...]
    evaluations: int
    wall: float

    def column(self, name: str) -> Array:
        """One column of the samples, (n,)."""
        return self.samples[:, COLUMNS.index(name)]


def scales_of(p: Parameters) -> Array:
    """Sizes below which an error in a state does not matter, (SIZE,): 1 m, 1, 0.1 m/s and 0.1 rad/s as momentum."""
    P, Pi = [0.1 * (p.ms + p.mr)] * 3, 0.1 * (np.array(p.Is) + np.array(p.IA))
    return np.array([math.inf, math.inf, 1.0, 1.0, 1.0, 1.0, 1.0, *P, *Pi, math.inf, math.inf, math.inf])


def fly(
    legs: Sequence[Leg],
    sea: Sea,
    p: Parameters,
    *,
    duration: float = math.inf,
    start: Start = REST,
    controls: tuple[float, float, float] | None = None,
    drives: Drives = IDEAL,
    bottom: float = math.inf,
    every: float = 1.0,
    rtol: float = 1e-7,
    full: bool = True,
    fitted_angle: float = math.inf,
    floats: bool = False,
    give: Callable[[Array, Array], None] | None = None,
    progress: Callable[[float, float], None] | None = None,
    plain: bool = False,
) -> Flight:
    """Fly the legs until the last ends or time is up.

    duration, every : s. start : the motion that it begins with; default: from rest in the water, level.
    controls : of the start (m, rad, kg); default what the table of the first leg begins with.
    drives : limits and rates of the actuators, for legs that are steered. bottom : m.
    rtol : relative tolerance of the integrator.
    full : the whole model; False leaves out the water's own acceleration and the momentum of the moving actuator.
    fitted_angle : rad, beyond which angle of attack and sideslip are noted as excursions.
    floats : whether a vehicle that is too light to leave the surface is held there; else that is an error.
    give : gets times (n,) and samples (n, len(COLUMNS)) as they come, some ten thousand at a time; the Flight then
        keeps the last of them only. progress : is told the time flown and ``duration``, s, now and then.
    plain : run the same source without numba, some hundred times slower; for tests.

    Raises
    ------
    InputError
        The vehicle would only float: at the surface its net buoyancy lifts it; or a leg cannot end.
    NoSolutionError
        The step size fell below its limit: the motion cannot be integrated.
    """
    duration, rtol, every = float(duration), float(rtol), float(every)  # one signature, compiled once
    y, m = _begin(start, controls or _first_controls(legs[0]), sea, p, floats)
    look: Any = observe if plain else compiled(observe)
    reached, log = range_of_none(float(start.depth), float(fitted_angle)), np.zeros((_MOST_EVENTS, 3))
    common = (rtol, scales_of(p), reached, log)
    events: list[FlightEvent] = []
    skipped: list[str] = []
    times, rows, ended_at, wall = [np.zeros(1)], [_row(y, m)], 0.0, 0.0

    def seen(times: list[Array], rows: list[Array]) -> tuple[Array, Array]:
        when, states = np.concatenate(times), np.vstack(rows)
        samples = np.empty((len(states), len(COLUMNS)))
        look(when, states, sea, p, full, samples)
        return when, samples

    for number, leg in enumerate(legs):
        last_leg = number == len(legs) - 1
        ends = _ends(leg, y, m, last_leg, duration, bottom)
        m[LEG_START], m[SAMPLES], m[LIMITS] = m[T], 0.0, 0.0
        m[HEADING], m[TURN] = turned(y, 0.0), 0.0
        order = _as_they_are(leg.order, m) if leg.keeps else leg.order
        commands = (order.mass_position, order.mass_rotation, order.net_buoyancy) if leg.steered else math.nan
        m[COMMAND_RRX : COMMAND_MB + 1] = commands
        given = (order, drives, leg.times, leg.values, ends, sea, p, full, every)
        there = (leg.goes == "down" and y[2] >= ends.floor) or (leg.goes == "up" and y[2] <= ends.ceiling)
        there = there or (leg.steered and y[2] == leg.until_depth) or y[2] >= bottom - leg.until_altitude
        if leg.ends_by_depth_alone and not there:
            check_reach(leg, order, drives, y, float(m[T]), sea, p)
        run: Any = fly_stretch if plain else compiled(fly_stretch)  # not before: bad input needs no compiling
        run(y, m, -math.inf, *given, np.empty((0, ROW_WIDTH)), *common)  # compiles, if it must
        status, apogee, began_at = AT_DEPTH if there else GOING_ON, None, float(y[2])
        if there:
            skipped.append(f"{leg.place or leg.name} begins at {began_at:.1f} m, beyond its end, and ends at once")
        while status == GOING_ON:
            out = np.empty((int(STRETCH / every) + 2, ROW_WIDTH))
            first, began = int(m[ROW]), time.perf_counter()
            status = run(y, m, (math.floor(m[T] / STRETCH) + 1.0) * STRETCH, *given, out, *common)
            wall += time.perf_counter() - began
            if status == STEP_TOO_SMALL:
                raise NoSolutionError(f"the motion cannot be integrated beyond {m[T]:.3f} s at {y[2]:.2f} m")
            if math.isinf(duration) and m[T] - m[LEG_START] > LONGEST_LEG and math.isinf(leg.duration):
                raise InputError(
                    leg.place or f"leg {leg.name}",
                    f"has not ended {LONGEST_LEG / 86400:g} days after it began, at {y[2]:.1f} m; needed is an end "
                    "that it comes to, or duration_s",
                )
            if m[ROW] > MOST_SAMPLES:
                raise InputError(
                    "every", f"{every:g} s gives more than {MOST_SAMPLES:.0e} samples by {m[T]:.0f} s, the most allowed"
                )
            times.append(every * np.arange(first, int(m[ROW]), dtype=np.float64))
            rows.append(out[: int(m[ROW]) - first])
            for kind, at, depth in log[: int(m[LOGGED])].tolist():
                event = FlightEvent(EVENTS[int(kind)], at, depth)
                if int(kind) != APOGEE:
                    events.append(event)
                elif apogee is None or depth > apogee.depth:
                    apogee = event
            m[LOGGED] = 0.0
            if progress is not None:
                progress(float(m[T]), duration)
            if give is not None and sum(map(len, times)) > _PIECE:
                give(*seen(times, rows))
                times, rows = [], []
        if m[T] > max(every * (m[ROW] - 1.0), ended_at):
            ended_at = float(m[T])
            times.append(np.full(1, ended_at))
            rows.append(_row(y, m))
        if apogee is not None and apogee.depth >= max(float(y[2]), began_at):  # else a wobble on the way
            events.append(apogee)
        over = last_leg or m[T] >= duration
        if status not in (SURFACED, GROUNDED):
            events.append(FlightEvent("end of flight" if over else f"end of {leg.name}", float(m[T]), float(y[2])))
        if over:
            break
    if m[T] == 0.0:
        raise InputError("flight", f"ends where it begins: {'; '.join(skipped) or events[-1].name}; nothing is flown")
    if not times or not sum(map(len, times)):  # the last samples were given away
        times, rows = [np.full(1, ended_at)], [_row(y, m)]
    when, samples = seen(times, rows)
    if give is not None:
        give(when, samples)
    names = ("angle of attack", "sideslip", "roll")
    angles = zip(names, reached.limits.tolist(), reached.angles.tolist(), strict=True)
    return Flight(
        times=when,
        samples=samples,
        events=tuple(sorted(events, key=lambda event: event.time)),
        excursions=tuple(Excursion(name, limit, *row) for name, limit, row in angles if row[0] > 0.0),
        depths=(float(reached.depths[0, 0]), float(reached.depths[1, 0])),
        start_depth=start.depth,
        distance=float(y[TRACK]),
        excess=net_excess(
            float(samples[-1, COLUMNS.index("net_buoyancy")]), at_depth(sea, float(y[2]), float(m[T])), p
        ),
        tallies=Tallies(
            slid=float(m[SLID]),
            rotated=float(m[ROTATED]),
            pumped=float(m[PUMPED]),
            pump_work=float(y[PUMP_WORK]),
        ),
        skipped=tuple(dict.fromkeys(skipped)),
        evaluations=int(m[EVALUATIONS]),
        wall=wall,
    )


def _as_they_are(order: Order, m: Array) -> Order:
    """The order that leaves the actuators where they are."""
    return order._replace(mass_position=float(m[RRX]), mass_rotation=float(m[GAMMA]), net_buoyancy=float(m[MB]))


def _first_controls(leg: Leg) -> tuple[float, float, float]:
    return float(leg.values[0, 0]), float(leg.values[0, 1]), float(leg.values[0, 2])


def _begin(
    start: Start, controls: tuple[float, float, float], sea: Sea, p: Parameters, floats: bool
) -> tuple[Array, Array]:
    """State and memory of the start; a vehicle too light for the surface is held there, or refused."""
    y = np.zeros(SIZE)
    y[2] = start.depth
    y[3:7] = start.q_wxyz
    water = at_depth(sea, start.depth, 0.0)
    y[7:10], y[10:13] = momentum(start.V, start.Omega, Controls(*controls, 0.0, 0.0), water.density / p.rho_ref, p)
    m = new_memory(controls)
    mb = controls[2]
    excess = net_excess(mb, water, p)
    if start.depth <= SURFACE and excess <= 0.0:
        if not floats:
            raise InputError(
                "net buoyancy",
                f"{mb:g} kg leaves {excess:.3g} kg in this water: the vehicle would only float at the surface; give "
                "--start-depth in m, more than 0, or a net buoyancy that sinks it",
            )
        m[HELD] = AT_SURFACE
    return y, m


def _row(y: Array, m: Array) -> Array:
    """The present as one row for ``observe``; the actuators move as they did up to now."""
    return np.array([[*y, m[RRX], m[GAMMA], m[MB], m[RRX_RATE], m[GAMMA_RATE]]])


def _ends(leg: Leg, y: Array, m: Array, last: bool, duration: float, bottom: float) -> Ends:
    """The ends of a leg that begins now."""
    depth, until = float(y[2]), leg.until_depth
    goes = leg.goes or ("down" if depth < until else "up")
    floor = until if goes == "down" and not math.isnan(until) else math.inf
    if not math.isnan(leg.until_altitude):
        floor = min(floor, bottom - leg.until_altitude)
    stop = min(duration, float(m[T]) + leg.duration)
    if not leg.steered and math.isnan(until) and math.isinf(leg.duration) and not last:
        stop = min(stop, float(m[T] + leg.times[-1]))
    return Ends(
        floor=floor,
        ceiling=until if goes == "up" and not math.isnan(until) else -math.inf,
        bottom=float(bottom),
        time=stop,
        turn=2.0 * math.pi * float(leg.turns),
        surface_ends=leg.surface_ends,
        bottom_ends=leg.bottom_ends,
    )
