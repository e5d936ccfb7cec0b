"""Where in a step does a leg end, or the vehicle turn up or down? Located on the dense output, not stepped over."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import rotation_ned_body
from glidercli.kernel import kernel
from glidercli.simulation.holding import SURFACE, Walls
from glidercli.simulation.memory import AT_DEPTH, GOING_ON, GROUNDED, HEADING, SURFACED, TURN, TURNED
from glidercli.simulation.stepper import dense, state_of

__all__ = ["Ends", "ended", "turned", "turning_point"]

Array = NDArray[np.float64]


class Ends(NamedTuple):
    """Where a leg ends; infinite where it does not."""

    floor: float
    """Depth reached going down, m."""
    ceiling: float
    """Depth reached going up, m; minus infinity where it does not."""
    bottom: float
    """m."""
    time: float
    """s from the start of the flight."""
    turn: float
    """rad, of heading, either way."""
    surface_ends: bool
    """Whether surfacing ends the leg; else the surface holds the vehicle and the leg goes on."""
    bottom_ends: bool
    """The same of grounding."""


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
def ended(
    y: Array, new: Array, h: float, k: Array, m: Array, ends: Ends, stops: Walls, work: Array
) -> tuple[int, float]:
    """Whether the leg ends within a step, and at which share of it; the first of what ends it."""
    status, share = GOING_ON, 1.0
    top, bend = (1.0, new[2]) if k[0, 2] * k[6, 2] >= 0.0 else turning_point(y, new, h, k, work)
    lowest, highest = max(new[2], bend), min(new[2], bend)
    sinks, rises = k[0, 2] > 0.0, k[0, 2] < 0.0
    to_floor = ends.floor if y[2] < ends.floor else math.inf  # one that is passed already ends nothing
    to_ceiling = ends.ceiling if y[2] > ends.ceiling or (y[2] == ends.ceiling and sinks) else -math.inf
    floor, ceiling = min(to_floor, stops.bottom), max(to_ceiling, stops.surface)
    if lowest >= floor and y[2] < floor:
        share = depth_share(y, new, h, k, floor, 0.0, top if bend >= floor else 1.0, work)
        status = GROUNDED if stops.bottom <= to_floor else AT_DEPTH
    elif highest <= ceiling and (y[2] > ceiling or (y[2] == ceiling and sinks)):
        share = depth_share(y, new, h, k, ceiling, top if sinks else 0.0, top if bend <= ceiling else 1.0, work)
        status = SURFACED if ceiling <= SURFACE else AT_DEPTH
    elif y[2] <= stops.surface and new[2] < stops.surface and not sinks:
        status, share = SURFACED, 0.0
    elif y[2] >= stops.bottom and new[2] > stops.bottom and not rises:
        status, share = GROUNDED, 0.0
    if ends.turn < math.inf and abs(m[TURN] + turned(new, m[HEADING])) >= ends.turn:
        at = turn_share(y, new, h, k, m, ends.turn, work)
        if at < share:
            status, share = TURNED, at
    return status, share
