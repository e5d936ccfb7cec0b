"""How is a stretch of a leg flown? From segment to segment of the actuators, step by step, events located in each.

A stretch ends at a time that the caller sets, or where the leg ends: at a depth, after turns, at the surface, on the
bottom. Whoever flies a long mission takes it stretch by stretch, at times that do not depend on what is recorded: the
flight is then the same however often it is looked at.

At the surface and on the bottom the vehicle is held, level and at its heading, until its net buoyancy carries it off;
at the surface it drifts with the current there.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import Vector, dot, rotation_ned_body, scale, times, transposed
from glidercli.kernel import kernel
from glidercli.model.buoyancy import hull_excess, pumped_excess
from glidercli.model.mass import momentum, placement
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Sea, Water, at_depth
from glidercli.simulation.actuators import Drives, drive_pressure, moving_controls, time_to_move
from glidercli.simulation.autopilot import Order, commands
from glidercli.simulation.reach import Range, note_angles, note_depth
from glidercli.simulation.stepper import (
    DRIFT,
    PUMP_WORK,
    SIZE,
    TRACK,
    WIDTH,
    Segment,
    controls_at,
    dense,
    error_norm,
    segment_of,
    slope_into,
    stages,
    state_of,
)

__all__ = ["EVENTS", "Ends", "fly_stretch", "net_excess", "new_memory"]

Array = NDArray[np.float64]

GOING_ON, AT_DEPTH, AT_TIME, TURNED, SURFACED, GROUNDED, STEP_TOO_SMALL = range(7)
"""How a stretch ended."""

FREE, AT_SURFACE, ON_BOTTOM = 0.0, 1.0, 2.0
"""What holds the vehicle."""

(
    T, STEP, ERROR, RRX, GAMMA, MB, COMMAND_RRX, COMMAND_GAMMA, COMMAND_MB, LEG_START, SAMPLES, HEADING, TURN, HELD,
    RESTED, ROW, SLIDING, ROTATING, PUMPING, BLEEDING, PUMPED, EVALUATIONS, LOGGED, LIMITS,
) = range(24)  # fmt: skip
"""What a flight remembers beside its state: time (s), next step (s), last error; actuators and commands (SI); start of
the leg (s), samples of the controllers in it; heading at the last step and turn since the leg began (rad); what holds
it, and whether it has come to rest there; next row to record; seconds that each motor ran, and m3 pumped out; calls of
the right-hand side; events logged, and which limits were met in this leg (a sum of 1, 2, 4)."""

EVENTS = (
    "apogee", "surfacing", "grounding", "dive begins", "lift-off", "mass position at its limit",
    "mass rotation at its limit", "oil at its limit",
)  # fmt: skip
APOGEE, SURFACING, GROUNDING, DIVES, LIFTS, SLIDE_LIMIT, ROTATION_LIMIT, OIL_LIMIT = range(8)

SURFACE = 0.0
FIRST_STEP = 0.05  # s; a fraction of the roll mode's period, the fastest there is
_SMALLEST_STEP = 1e-9  # s
_LARGEST_STEP = 30.0  # s: a tenth of the shortest leg that anybody flies
_STABLE = 2.5  # time constants; the pair allows 3.3, coupling and density take some of the difference
_NEUTRAL = 1e-12  # kg; rounding of a net buoyancy that has just become zero


class Ends(NamedTuple):
    """Where a leg ends; infinite where it does not."""

    floor: float
    """Depth reached going down, m."""
    ceiling: float
    """Depth reached going up, m."""
    bottom: float
    """m."""
    time: float
    """s from the start of the flight."""
    turn: float
    """rad, of heading, either way."""
    surface_ends: bool
    """Whether surfacing ends the leg; else the surface holds the vehicle and the leg goes on."""


def new_memory(controls: tuple[float, float, float], heading: float) -> Array:
    """The memory of a flight that begins with these actuators (SI) and heading, rad."""
    m = np.zeros(24)
    m[STEP], m[ERROR] = FIRST_STEP, 1e-4
    m[RRX], m[GAMMA], m[MB] = m[COMMAND_RRX], m[COMMAND_GAMMA], m[COMMAND_MB] = controls
    m[HEADING], m[ROW] = heading, 1.0
    return m


@kernel
def net_excess(mb: float, water: Water, p: Parameters) -> float:
    """Net buoyancy in the water, kg, sinking positive: what is pumped and what the hull displaces."""
    return pumped_excess(mb, water.density, p) + hull_excess(water.density, water.pressure, water.temperature, p)


@kernel
def note_event(log: Array, m: Array, kind: int, t: float, depth: float) -> None:
    """Add an event to the log (n, 3), unless it is full."""
    n = int(m[LOGGED])
    if n < log.shape[0]:
        log[n, 0], log[n, 1], log[n, 2] = kind, t, depth
    m[LOGGED] += 1.0


@kernel
def tabled(times_: Array, values: Array, m: Array, p: Parameters, full: bool) -> tuple[Segment, float]:
    """The segment of a table of controls at the present time, and when it ends; held before the first and after the
    last knot."""
    since = m[T] - m[LEG_START]
    low, high = -1, len(times_)
    while high - low > 1:
        middle = (low + high) // 2
        if times_[middle] <= since:
            low = middle
        else:
            high = middle
    if low < 0 or low == len(times_) - 1:
        i = max(low, 0)
        stop = m[LEG_START] + times_[0] if low < 0 else math.inf
        return segment_of(m[T], Controls(values[i, 0], values[i, 1], values[i, 2], 0.0, 0.0), 0.0, p, full), stop
    span = times_[low + 1] - times_[low]
    c = Controls(
        values[low, 0],
        values[low, 1],
        values[low, 2],
        (values[low + 1, 0] - values[low, 0]) / span,
        (values[low + 1, 1] - values[low, 1]) / span,
    )
    mb_rate = (values[low + 1, 2] - values[low, 2]) / span
    return segment_of(m[LEG_START] + times_[low], c, mb_rate, p, full), m[LEG_START] + times_[low + 1]


@kernel
def steered(
    y: Array, m: Array, order: Order, drives: Drives, water: Water, p: Parameters, full: bool, log: Array
) -> tuple[Segment, float]:
    """The segment that the controllers and the motors make of the present time, and when it ends."""
    t = m[T]
    before = Controls(m[RRX], m[GAMMA], m[MB], 0.0, 0.0)
    last = (m[COMMAND_RRX], m[COMMAND_GAMMA], m[COMMAND_MB])
    tick = m[LEG_START] + m[SAMPLES] * order.period
    if t >= tick or m[SAMPLES] == 0.0:
        at = placement(before, p, False)
        last = commands(order, drives, state_of(y), at, water, p, t - m[LEG_START], last)
        m[COMMAND_RRX], m[COMMAND_GAMMA], m[COMMAND_MB] = last
        m[SAMPLES] += 1.0
        tick = m[LEG_START] + m[SAMPLES] * order.period
        note_limits(y, m, order, drives, log)
    c, mb_rate = moving_controls(m[RRX], m[GAMMA], m[MB], last, drive_pressure(water, y[2]), drives, p)
    stop = tick
    stop = min(stop, t + time_to_move(m[RRX], last[0], c.rrx_rate))
    stop = min(stop, t + time_to_move(m[GAMMA], last[1], c.gamma_rate))
    stop = min(stop, t + time_to_move(m[MB], last[2], mb_rate))
    if mb_rate < 0.0:
        stop = min(stop, t + drives.refresh)
    return segment_of(t, c, mb_rate, p, full), stop


@kernel
def note_limits(y: Array, m: Array, order: Order, drives: Drives, log: Array) -> None:
    """Log, once in a leg, that what is held asks for more than an actuator can give."""
    met = int(m[LIMITS])
    if order.holds_pitch and met % 2 == 0 and not drives.rrx_min < m[COMMAND_RRX] < drives.rrx_max:
        note_event(log, m, SLIDE_LIMIT, m[T], y[2])
        m[LIMITS] += 1.0
    if order.holds_turn and met // 2 % 2 == 0 and not drives.gamma_min < m[COMMAND_GAMMA] < drives.gamma_max:
        note_event(log, m, ROTATION_LIMIT, m[T], y[2])
        m[LIMITS] += 2.0
    if order.holds_buoyancy and met // 4 % 2 == 0 and not drives.mb_min < m[COMMAND_MB] < drives.mb_max:
        note_event(log, m, OIL_LIMIT, m[T], y[2])
        m[LIMITS] += 4.0


@kernel
def move_actuators(m: Array, segment: Segment, t: float, p: Parameters) -> None:
    """Put the actuators where a segment has brought them by time t, s, and count what the motors ran."""
    c, since = segment.controls, t - m[T]
    now = controls_at(segment, t)
    m[RRX] = settled(now.rrx, m[COMMAND_RRX])
    m[GAMMA] = settled(now.gamma, m[COMMAND_GAMMA])
    m[MB] = settled(now.mb, m[COMMAND_MB])
    if c.rrx_rate != 0.0:
        m[SLIDING] += since
    if c.gamma_rate != 0.0:
        m[ROTATING] += since
    if segment.mb_rate < 0.0:
        m[PUMPING] += since
        m[PUMPED] -= segment.mb_rate * since / p.rho_0
    elif segment.mb_rate > 0.0:
        m[BLEEDING] += since


@kernel
def settled(value: float, command: float) -> float:
    """The command where a value has reached it but for rounding."""
    return command if abs(value - command) < 1e-12 else value


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
    """When the vehicle leaves surface or bottom: now, when a steady pump makes it neutral, or at ``stop``."""
    down = 1.0 if m[HELD] == AT_SURFACE else -1.0
    mb = controls_at(segment, m[T]).mb
    if down * net_excess(mb, water, p) > -_NEUTRAL:
        return float(m[T])
    neutral = -hull_excess(water.density, water.pressure, water.temperature, p) * p.rho_0 / water.density
    if down * segment.mb_rate > 0.0:
        return min(stop, float(m[T]) + (neutral - mb) / segment.mb_rate)
    return stop


@kernel
def record(row: Array, y: Array, c: Controls) -> None:
    """One row of output: the state and the controls with their rates."""
    for j in range(SIZE):
        row[j] = y[j]
    row[SIZE], row[SIZE + 1], row[SIZE + 2], row[SIZE + 3], row[SIZE + 4] = c


@kernel
def drift(
    y: Array, m: Array, segment: Segment, stop: float, sea: Sea, every: float, out: Array, first: float, work: Array
) -> None:
    """Hold the vehicle until ``stop``, s: at the surface it goes with the current there, on the bottom nowhere."""
    start = m[T]
    U = at_depth(sea, y[2]).current
    if m[HELD] == ON_BOTTOM:
        U = (0.0, 0.0, 0.0)
    length = math.sqrt(U[0] * U[0] + U[1] * U[1])
    for j in range(SIZE):
        work[j] = y[j]
    while m[ROW] * every <= stop:
        t = m[ROW] * every
        work[0], work[1] = y[0] + U[0] * (t - start), y[1] + U[1] * (t - start)
        work[TRACK] = y[TRACK] + length * (t - start)
        record(out[int(m[ROW] - first)], work, controls_at(segment, t))
        m[ROW] += 1.0
    for j in range(2):
        y[j] += U[j] * (stop - start)
        y[DRIFT + j] += U[j] * (stop - start)
    y[TRACK] += length * (stop - start)
    y[PUMP_WORK] += segment.oil_rate * drive_pressure(at_depth(sea, y[2]), y[2]) * (stop - start)


@kernel
def depth_share(y: Array, new: Array, h: float, k: Array, depth: float, low: float, high: float, work: Array) -> float:
    """Share of the step, between two shares, at which the depth passes a value, by bisection to rounding."""
    dense(work, y, new, h, k, low)
    below = work[2] < depth
    for _ in range(60):
        middle = 0.5 * (low + high)
        dense(work, y, new, h, k, middle)
        if (work[2] < depth) == below:
            low = middle
        else:
            high = middle
    return high


@kernel
def turning_point(y: Array, new: Array, h: float, k: Array, work: Array) -> tuple[float, float]:
    """Share of a step at which the vehicle turns up or down, and the depth there, m, by ternary search.

    The vertical velocity must change its sign over the step.
    """
    low, high = 0.0, 1.0
    down = k[0, 2] > 0.0
    for _ in range(40):
        third = (high - low) / 3.0
        dense(work, y, new, h, k, low + third)
        before = work[2]
        dense(work, y, new, h, k, high - third)
        if (work[2] > before) == down:
            low += third
        else:
            high -= third
    dense(work, y, new, h, k, high)
    return high, float(work[2])


@kernel
def turned(y: Array, before: float) -> float:
    """Change of heading, rad, from ``before``, rad, the short way round."""
    R = rotation_ned_body(state_of(y).q_wxyz)
    change = math.atan2(R[1][0], R[0][0]) - before
    return change - 2.0 * math.pi * math.floor(change / (2.0 * math.pi) + 0.5)


@kernel
def turn_share(y: Array, new: Array, h: float, k: Array, m: Array, turn: float, work: Array) -> float:
    """Share of the step at which the heading has turned by so much, rad, since the leg began, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        dense(work, y, new, h, k, middle)
        if abs(m[TURN] + turned(work, m[HEADING])) < turn:
            low = middle
        else:
            high = middle
    return high


@kernel
def ended(y: Array, new: Array, h: float, k: Array, m: Array, ends: Ends, work: Array) -> tuple[int, float]:
    """Whether the leg ends within a step, and at which share of it; the first of what ends it."""
    status, share = GOING_ON, 1.0
    top, bend = (1.0, new[2]) if k[0, 2] * k[6, 2] >= 0.0 else turning_point(y, new, h, k, work)
    lowest, highest = max(new[2], bend), min(new[2], bend)
    floor, ceiling = min(ends.floor, ends.bottom), max(ends.ceiling, SURFACE)
    if lowest >= floor and y[2] < floor:
        share = depth_share(y, new, h, k, floor, 0.0, top if bend >= floor else 1.0, work)
        status = GROUNDED if ends.bottom <= ends.floor else AT_DEPTH
    elif highest <= ceiling and y[2] > ceiling:
        share = depth_share(y, new, h, k, ceiling, 0.0, top if bend <= ceiling else 1.0, work)
        status = SURFACED if ceiling == SURFACE else AT_DEPTH
    if ends.turn < math.inf and abs(m[TURN] + turned(new, m[HEADING])) >= ends.turn:
        at = turn_share(y, new, h, k, m, ends.turn, work)
        if at < share:
            status, share = TURNED, at
    return status, share


@kernel
def damped_step(V: Vector, segment: Segment, gravity: float, p: Parameters) -> float:
    """Largest step, s, at which the fastest motions stay what they are: decay of the body rates, swing of the roll.

    Explicit steps of this pair are stable up to some 3.3 times the time constant of a decay. Step control by the error
    alone hovers at that bound, and a steady flight then trembles by more than its tolerance.
    """
    I, s = segment.at.I, segment.at.s  # noqa: E741
    roll, pitch, yaw = I[0][0] + p.IA[0], I[1][1] + p.IA[1], I[2][2] + p.IA[2]
    damping = max(-p.Kp / roll, -p.Kq / pitch, -p.Kr / yaw) * dot(V, V)
    swing = math.sqrt(gravity * math.sqrt(dot(s, s)) / roll)
    return _STABLE / max(damping, swing, 1e-9)


@kernel
def fly_segment(
    y: Array, m: Array, segment: Segment, stop: float, ends: Ends, sea: Sea, p: Parameters, full: bool, every: float,
    out: Array, first: float, rtol: float, scales: Array, reached: Range, log: Array, k: Array, new: Array, work: Array,
) -> int:  # fmt: skip
    """Integrate over one segment of the actuators, to its end or to that of the leg."""
    t = m[T]
    slope_into(k, 0, t, y, segment, sea, p, full)
    m[EVALUATIONS] += 1.0
    while t < stop:
        left = stop - t
        h = min(
            m[STEP], _LARGEST_STEP, damped_step((k[0, SIZE], k[0, SIZE + 1], k[0, SIZE + 2]), segment, sea.gravity, p)
        )
        last = h >= left * (1.0 - 1e-12)
        h = left if last else min(h, max(0.5 * left, _SMALLEST_STEP)) if h > 0.5 * left else h
        stages(y, t, h, k, new, segment, sea, p, full)
        m[EVALUATIONS] += 6.0
        error = error_norm(y, new, h, k, rtol, scales)
        if not error <= 1.0:
            m[STEP] = h * max(0.1, 0.9 * error**-0.2) if error < math.inf else 0.1 * h
            if m[STEP] < _SMALLEST_STEP:
                return STEP_TOO_SMALL
            continue
        grown = h * min(5.0, max(0.2, 0.9 * max(error, 1e-10) ** -0.17 * m[ERROR] ** 0.04))
        m[STEP] = max(m[STEP], grown) if h < m[STEP] else grown
        m[ERROR] = max(error, 1e-4)
        status, share = ended(y, new, h, k, m, ends, work)
        t_new = (stop if last else t + h) if share == 1.0 else t + share * h
        while m[ROW] * every <= t_new:
            dense(work, y, new, h, k, (m[ROW] * every - t) / h)
            record(out[int(m[ROW] - first)], work, controls_at(segment, m[ROW] * every))
            m[ROW] += 1.0
        if status == GOING_ON and k[0, 2] * k[6, 2] < 0.0:
            at, depth = turning_point(y, new, h, k, work)
            note_depth(reached, t + at * h, depth)
            if k[0, 2] > 0.0:
                note_event(log, m, APOGEE, t + at * h, depth)
        if share == 1.0:
            for j in range(SIZE):
                y[j] = new[j]
        else:
            dense(work, y, new, h, k, share)
            for j in range(SIZE):
                y[j] = work[j]
        if status == AT_DEPTH or status in (SURFACED, GROUNDED):
            floor, ceiling = min(ends.floor, ends.bottom), max(ends.ceiling, SURFACE)
            y[2] = floor if abs(y[2] - floor) < abs(y[2] - ceiling) else ceiling
        norm = math.sqrt(y[3] ** 2 + y[4] ** 2 + y[5] ** 2 + y[6] ** 2)
        for j in range(3, 7):
            y[j] /= norm
        q = (y[3], y[4], y[5], y[6])
        change = turned(y, m[HEADING])
        m[TURN] += change
        m[HEADING] += change
        note_depth(reached, t_new, y[2])
        note_angles(reached, t_new, t_new - t, (k[6, SIZE], k[6, SIZE + 1], k[6, SIZE + 2]), q)
        t = t_new
        if status != GOING_ON:
            move_actuators(m, segment, t, p)
            m[T] = t
            return status
        for j in range(WIDTH):
            k[0, j] = k[6, j]
    move_actuators(m, segment, t, p)
    m[T] = t
    return GOING_ON


@kernel
def fly_stretch(
    y: Array, m: Array, until: float, order: Order, drives: Drives, times_: Array, values: Array, ends: Ends, sea: Sea,
    p: Parameters, full: bool, every: float, out: Array, rtol: float, scales: Array, reached: Range, log: Array,
) -> int:  # fmt: skip
    """Fly on until a time, s, or the end of the leg; says which of GOING_ON, AT_DEPTH, ... it was.

    y : (18,) state. m : (24,) memory; both go on from where they are. order, drives : what the leg asks of the steering
    and how fast the actuators are; times_ (n,), values (n, 3) : a table of controls instead, empty where there is none.
    every : s between rows; row i of the flight, at i every, goes into out (rows, 23), counted from the first of this
    stretch. rtol : tolerance relative to scales + |state|; scales (18,), infinite for columns that do not count.
    reached : widened at every step. log : (n, 3) kind, time, depth of events, m[LOGGED] of them.
    """
    k, new, work = np.zeros((7, WIDTH)), np.empty(SIZE), np.empty(SIZE)
    first = m[ROW]
    until = min(until, ends.time)
    while m[T] < until:
        water = at_depth(sea, y[2])
        if len(times_) > 0:
            segment, stop = tabled(times_, values, m, p, full)
        else:
            segment, stop = steered(y, m, order, drives, water, p, full, log)
        stop = min(stop, until)
        if m[HELD] != FREE:
            if m[RESTED] == 0.0:
                rest(y, controls_at(segment, m[T]), water, p, m[HELD] == AT_SURFACE)
                m[RESTED], m[STEP] = 1.0, FIRST_STEP
            leaves = held_until(y, m, segment, stop, water, p)
            if leaves > m[T]:
                drift(y, m, segment, leaves, sea, every, out, first, work)
                move_actuators(m, segment, leaves, p)
                m[T] = leaves
                continue
            note_event(log, m, DIVES if m[HELD] == AT_SURFACE else LIFTS, m[T], y[2])
            m[HELD] = FREE
        status = fly_segment(
            y, m, segment, stop, ends, sea, p, full, every, out, first, rtol, scales, reached, log, k, new, work
        )
        if status in (SURFACED, GROUNDED):
            surfaced = status == SURFACED
            note_event(log, m, SURFACING if surfaced else GROUNDING, m[T], y[2])
            m[HELD] = AT_SURFACE if surfaced else ON_BOTTOM
            m[RESTED] = 0.0
            if surfaced and not ends.surface_ends:
                continue
        if status != GOING_ON:
            return status
    return AT_TIME if m[T] >= ends.time else GOING_ON
