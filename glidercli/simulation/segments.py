"""How do the actuators go on from here? Along a table, or as controllers and motors have it, for one segment."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.kernel import kernel
from glidercli.model.mass import placement
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.profile import interval
from glidercli.ocean.water import Water
from glidercli.simulation.actuators import Drives, drive_pressure, moving_controls, time_to_move
from glidercli.simulation.autopilot import Order, commands
from glidercli.simulation.memory import (
    COMMAND_GAMMA,
    COMMAND_MB,
    COMMAND_RRX,
    GAMMA,
    GAMMA_RATE,
    LEG_START,
    LIMITS,
    MB,
    OIL_LIMIT,
    PUMPED,
    ROTATED,
    ROTATION_LIMIT,
    RRX,
    RRX_RATE,
    SAMPLES,
    SLID,
    SLIDE_LIMIT,
    T,
    note_event,
)
from glidercli.simulation.stepper import Segment, controls_at, segment_of, state_of

__all__ = ["move_actuators", "steered", "tabled"]

Array = NDArray[np.float64]

_CLOCK = 1e-7  # s; times up to 1e8 s, the longest mission, are kept to 1.5e-8 s


@kernel
def tabled(times_: Array, values: Array, m: Array, p: Parameters, full: bool) -> tuple[Segment, float]:
    """The segment of a table of controls at the present time, and when it ends; held before the first and after the
    last knot."""
    low = interval(times_, m[T] - m[LEG_START])
    if low + 1 < len(times_) and m[LEG_START] + times_[low + 1] <= m[T]:  # the difference rounds, the sum is the clock
        low += 1
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
    if m[SAMPLES] == 0.0 or t >= m[LEG_START] + m[SAMPLES] * order.period:
        at = placement(before, p, False)
        last = commands(order, drives, state_of(y), at, water, p, t - m[LEG_START], last)
        m[COMMAND_RRX], m[COMMAND_GAMMA], m[COMMAND_MB] = last
        m[SAMPLES] += 1.0
        note_limits(y, m, order, drives, log)
    c, mb_rate = moving_controls(m[RRX], m[GAMMA], m[MB], last, drive_pressure(water, y[2]), drives, p)
    stop = m[LEG_START] + m[SAMPLES] * order.period
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
    """Put the actuators where a segment has brought them by time t, s, and count their travel."""
    c, since = segment.controls, t - m[T]
    now = controls_at(segment, t)
    m[RRX] = settled(now.rrx, m[COMMAND_RRX], c.rrx_rate)
    m[GAMMA] = settled(now.gamma, m[COMMAND_GAMMA], c.gamma_rate)
    m[MB] = settled(now.mb, m[COMMAND_MB], segment.mb_rate)
    m[RRX_RATE], m[GAMMA_RATE] = c.rrx_rate, c.gamma_rate
    m[SLID] += abs(c.rrx_rate) * since
    m[ROTATED] += abs(c.gamma_rate) * since
    m[PUMPED] += segment.oil_rate * since


@kernel
def settled(value: float, command: float, rate: float) -> float:
    """The command where a motor has reached it but for the rounding of the clock; the value elsewhere."""
    return command if abs(value - command) <= abs(rate) * _CLOCK else value
