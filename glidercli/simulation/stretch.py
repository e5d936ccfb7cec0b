"""How is a stretch of a leg flown? From segment to segment of the actuators, step by step, events located in each.

A stretch ends at a time that the caller sets, or where the leg ends: at a depth, after turns, at the surface, on the
bottom. Whoever flies a long mission takes it stretch by stretch, at times that do not depend on what is recorded: the
flight is then the same however often it is looked at.

At the surface and on the bottom the vehicle is held, level and at its heading, until its net buoyancy carries it off;
at the surface it drifts with the current there.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.kernel import kernel
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Sea, at_depth, next_change
from glidercli.simulation.actuators import Drives
from glidercli.simulation.autopilot import Order
from glidercli.simulation.holding import SURFACE, Walls, drift, held_until, net_excess, rest, walls
from glidercli.simulation.locating import Ends, ended, turned, turning_point
from glidercli.simulation.memory import (
    APOGEE,
    AT_DEPTH,
    AT_SURFACE,
    AT_TIME,
    DIVES,
    ERROR,
    EVALUATIONS,
    FIRST_STEP,
    FREE,
    GOING_ON,
    GROUNDED,
    GROUNDING,
    HEADING,
    HELD,
    LIFTS,
    LOGGED,
    ON_BOTTOM,
    RESTED,
    ROW,
    STEP,
    STEP_TOO_SMALL,
    SURFACED,
    SURFACING,
    TURN,
    T,
    note_event,
)
from glidercli.simulation.reach import Range, note_angles, note_depth
from glidercli.simulation.sampling import record
from glidercli.simulation.segments import move_actuators, steered, tabled
from glidercli.simulation.step_length import LARGEST_STEP, damped_step, smooth_depths
from glidercli.simulation.stepper import SIZE, WIDTH, Segment, controls_at, dense, error_norm, slope_into, stages

__all__ = ["fly_stretch"]

Array = NDArray[np.float64]

_SMALLEST_STEP = 1e-9  # s, or what a clock at time t can tell: 1e-15 t
_MOST_FORCED = 10_000  # steps of that length in a segment
_PASSED = 1e-3  # m: a bend of the water that near counts as passed; a step across it is of third order
_MOST_STALLS = 100  # segments without length, one after the other: motors that arrive together and events make some


@kernel
def fly_segment(
    y: Array, m: Array, segment: Segment, stop: float, ends: Ends, stops: Walls, sea: Sea, p: Parameters, full: bool,
    every: float, out: Array, first: float, rtol: float, scales: Array, reached: Range, log: Array, k: Array,
    new: Array, work: Array,
) -> int:  # fmt: skip
    """Integrate over one segment of the actuators, to its end or to that of the leg."""
    t = m[T]
    slope_into(k, 0, t, y, segment, sea, p, full)
    m[EVALUATIONS] += 1.0
    above, below = math.inf, -math.inf
    forced = 0
    while t < stop:
        left = stop - t
        smallest = max(_SMALLEST_STEP, 1e-15 * t)
        V = (k[0, SIZE], k[0, SIZE + 1], k[0, SIZE + 2])
        h = min(m[STEP], LARGEST_STEP, damped_step(V, segment, sea.gravity, p))
        way, ahead = h * k[0, 2], y[2] + math.copysign(_PASSED, k[0, 2])
        if not above <= ahead < below:
            above, below = smooth_depths(ahead, sea, full)
        left_smooth = below - y[2] if way > 0.0 else y[2] - above
        if left_smooth < abs(way) < below - above:  # else bends are closer than steps are long
            h *= left_smooth / abs(way)
        last = h >= left * (1.0 - 1e-12)
        h = left if last else min(h, max(0.5 * left, smallest)) if h > 0.5 * left else h
        stages(y, t, h, k, new, segment, sea, p, full)
        m[EVALUATIONS] += 6.0
        error = error_norm(y, new, h, k, rtol, scales)
        if not error <= 1.0:
            if h > smallest:
                m[STEP] = max(smallest, h * max(0.1, 0.9 * error**-0.2) if error < math.inf else 0.1 * h)
                continue
            forced += 1  # across a jump of the forces, as where a vehicle that moves backward sinks and then rises
            if error == math.inf or forced > _MOST_FORCED:
                return STEP_TOO_SMALL
        if h >= m[STEP]:  # else something shorter bound it, and its error says nothing of longer ones
            m[STEP] = max(smallest, h * min(5.0, max(0.2, 0.9 * max(error, 1e-10) ** -0.17 * m[ERROR] ** 0.04)))
            m[ERROR] = max(error, 1e-4)
        status, share = ended(y, new, h, k, m, ends, stops, work)
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
        if status == AT_DEPTH:
            y[2] = ends.floor if abs(y[2] - ends.floor) < abs(y[2] - ends.ceiling) else ends.ceiling
        elif status in (SURFACED, GROUNDED):
            y[2] = SURFACE if status == SURFACED else ends.bottom
        norm = math.sqrt(y[3] ** 2 + y[4] ** 2 + y[5] ** 2 + y[6] ** 2)
        for j in range(3, 7):
            y[j] /= norm
        q = (y[3], y[4], y[5], y[6])
        if ends.turn < math.inf:
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

    y : (SIZE,) state. m : memory (see memory.py); both go on from where they are.
    order, drives : what the leg asks of the steering and how fast the actuators are.
    times_ (n,), values (n, 3) : a table of controls instead, empty where there is none.
    every : s between rows; row i of the flight, at i every, goes into out (rows, ROW_WIDTH), counted from the first of
    this stretch. rtol : tolerance relative to scales + |state|; scales (SIZE,), infinite for columns that do not count.
    reached : widened at every step. log : (n, 3) kind, time, depth of events, m[LOGGED] of them.
    """
    k, new, work = np.zeros((7, WIDTH)), np.empty(SIZE), np.empty(SIZE)
    first = m[ROW]
    until = min(until, ends.time)
    thrown_back, before, stalled = False, -1.0, 0
    while m[T] < until:
        stalled = stalled + 1 if m[T] == before else 0
        if stalled > _MOST_STALLS:
            return STEP_TOO_SMALL
        before = m[T]
        water = at_depth(sea, y[2], m[T])
        if len(times_) > 0:
            segment, stop = tabled(times_, values, m, p, full)
        else:
            segment, stop = steered(y, m, order, drives, water, p, full, log)
        stop = min(stop, until, next_change(sea, m[T]))
        if m[HELD] != FREE:
            if m[RESTED] == 0.0:
                rest(y, controls_at(segment, m[T]), water, p, m[HELD] == AT_SURFACE)
                m[RESTED], m[STEP] = 1.0, FIRST_STEP
            leaves = stop if thrown_back else held_until(y, m, segment, stop, water, p)
            thrown_back = False
            if leaves > m[T]:
                drift(y, m, segment, leaves, sea, every, out, first, work)
                move_actuators(m, segment, leaves, p)
                m[T] = leaves
                continue
            note_event(log, m, DIVES if m[HELD] == AT_SURFACE else LIFTS, m[T], y[2])
            m[HELD] = FREE
        stops = walls(ends.bottom, net_excess(controls_at(segment, m[T]).mb, water, p))
        status = fly_segment(
            y, m, segment, stop, ends, stops, sea, p, full, every, out, first, rtol, scales, reached, log, k, new, work
        )
        if status in (SURFACED, GROUNDED):
            surfaced = status == SURFACED
            thrown_back = stops.surface < SURFACE if surfaced else stops.bottom > ends.bottom  # by water that moves
            if thrown_back and m[LOGGED] > 0.0 and log[int(m[LOGGED]) - 1, 0] == (DIVES if surfaced else LIFTS):
                m[LOGGED] -= 1.0
            else:
                note_event(log, m, SURFACING if surfaced else GROUNDING, m[T], y[2])
            m[HELD] = AT_SURFACE if surfaced else ON_BOTTOM
            m[RESTED] = 0.0
            if not (ends.surface_ends if surfaced else ends.bottom_ends):
                continue
        if status != GOING_ON:
            return status
    return AT_TIME if m[T] >= ends.time else GOING_ON
