"""How is the motion integrated? Dormand-Prince 5(4) with step control and dense output, from one event to the next.

An event is a knot of the controls, where their rates change, or a depth that ends a leg. A step never crosses a knot.
The pair, its step control and its dense output are those of Dormand & Prince (1980) as given in Hairer, Norsett &
Wanner, Solving Ordinary Differential Equations I, section II.5-6.

The state is an array of 15: position (NED, m), attitude q_wxyz, momentum P and Pi through water, energy lost to the
water (J), length of the horizontal track over ground (m). Nothing depends on the horizontal position, the energy or the
track, so they stay out of the error norm: a uniform current then changes neither step nor motion.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.kernel import kernel
from glidercli.model.equations import State, rates, through_water
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Sea, at_depth
from glidercli.simulation.reach import Range, note_angles, note_depth

__all__ = ["Run", "controls_at", "integrate", "state_of"]

Array = NDArray[np.float64]

SIZE = 15
REACHED_END, REACHED_FLOOR, REACHED_CEILING, STEP_TOO_SMALL = 0, 1, 2, 3

_SMALLEST_STEP = 1e-9  # s
_LARGEST_STEP = 30.0  # s: a tenth of the shortest leg that anybody flies


class Run(NamedTuple):
    """Outcome of an integration.

    status : REACHED_END, REACHED_FLOOR, REACHED_CEILING or STEP_TOO_SMALL. time, state : where it ended.
    rows : output rows filled. step : next step size, s. evaluations : calls of the right-hand side.
    """

    status: int
    time: float
    state: Array
    rows: int
    step: float
    evaluations: int


@kernel
def controls_at(times: Array, values: Array, t: float, segment: int) -> Controls:
    """The controls at time t, linear between knots; segment -1 lies before the first knot, the last after the last.

    times : (n,) s. values : (n, 3) mass position (m), mass rotation (rad), net buoyancy (kg).
    """
    if segment < 0 or segment >= len(times) - 1:
        i = max(segment, 0)
        return Controls(values[i, 0], values[i, 1], values[i, 2], 0.0, 0.0)
    span = times[segment + 1] - times[segment]
    share = (t - times[segment]) / span
    d0 = values[segment + 1, 0] - values[segment, 0]
    d1 = values[segment + 1, 1] - values[segment, 1]
    d2 = values[segment + 1, 2] - values[segment, 2]
    return Controls(
        values[segment, 0] + share * d0,
        values[segment, 1] + share * d1,
        values[segment, 2] + share * d2,
        d0 / span,
        d1 / span,
    )


@kernel
def state_of(y: Array) -> State:
    """The state array as a State; the attitude is brought to unit length."""
    n = math.sqrt(y[3] * y[3] + y[4] * y[4] + y[5] * y[5] + y[6] * y[6])
    return State(
        (y[0], y[1], y[2]),
        (y[3] / n, y[4] / n, y[5] / n, y[6] / n),
        (y[7], y[8], y[9]),
        (y[10], y[11], y[12]),
    )


@kernel
def slope_into(
    out: Array, t: float, y: Array, segment: int, times: Array, values: Array, sea: Sea, p: Parameters, full: bool
) -> None:
    """Write the time derivative of the state array y into ``out``."""
    water = at_depth(sea, y[2])
    r = rates(state_of(y), controls_at(times, values, t, segment), water, p, full)
    out[0], out[1], out[2] = r.position
    out[3], out[4], out[5], out[6] = r.q_wxyz
    out[7], out[8], out[9] = r.P
    out[10], out[11], out[12] = r.Pi
    out[13] = r.power
    out[14] = math.hypot(r.position[0], r.position[1])


NODES = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
WEIGHTS = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
    [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
    [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
    [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
    [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
])  # fmt: skip
"""The pair's tableau; the last row makes the new state."""
ERROR = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
"""Fifth-order less fourth-order weights."""
DENSE = np.array([
    -12715105075 / 11282082432, 0.0, 87487479700 / 32700410799, -10690763975 / 1880347072,
    701980252875 / 199316789632, -1453857185 / 822651844, 69997945 / 29380423,
])  # fmt: skip
"""Last term of the continuous extension."""


@kernel
def stages(
    y: Array,
    t: float,
    h: float,
    k: Array,
    new: Array,
    segment: int,
    times: Array,
    values: Array,
    sea: Sea,
    p: Parameters,
    full: bool,
) -> None:
    """One step: k[0] given, k[1..6] and ``new`` filled."""
    for i in range(1, 7):
        for j in range(SIZE):
            total = 0.0
            for m in range(i):
                total += WEIGHTS[i, m] * k[m, j]
            new[j] = y[j] + h * total
        slope_into(k[i], t + NODES[i] * h, new, segment, times, values, sea, p, full)


@kernel
def error_norm(y: Array, new: Array, h: float, k: Array, rtol: float, scales: Array) -> float:
    """Largest estimated error over tolerance, rtol (scale + |y|); columns of infinite scale do not count."""
    worst = 0.0
    for j in range(SIZE):
        e = 0.0
        for i in range(7):
            e += h * ERROR[i] * k[i, j]
        ratio = abs(e) / (rtol * (scales[j] + max(abs(y[j]), abs(new[j]))))
        if not ratio < math.inf:  # a NaN or an overflow: the step is refused
            return math.inf
        worst = max(worst, ratio)
    return worst


@kernel
def dense(out: Array, y: Array, new: Array, h: float, k: Array, share: float) -> None:
    """The state a share of the step after its start: the pair's continuous extension of fourth order."""
    rest = 1.0 - share
    for j in range(SIZE):
        change = new[j] - y[j]
        bend = h * k[0, j] - change
        last = 0.0
        for i in range(7):
            last += h * DENSE[i] * k[i, j]
        out[j] = y[j] + share * (change + rest * (bend + share * (change - h * k[6, j] - bend + rest * last)))


@kernel
def crossing(y: Array, new: Array, h: float, k: Array, depth: float, work: Array) -> float:
    """Share of the step at which the depth passes a value that lies between its ends, by bisection to rounding."""
    low, high = 0.0, 1.0
    below = y[2] < depth
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
    return high, float(work[2])


@kernel
def integrate(
    start: Array, t: float, t_end: float, step: float, times: Array, values: Array, sea: Sea, p: Parameters, full: bool,
    floor: float, ceiling: float, grid: Array, out: Array, rtol: float, scales: Array, reached: Range,
) -> Run:  # fmt: skip
    """Integrate from time t until t_end, the floor (reached going down) or the ceiling (reached going up).

    start : (15,) state at t. step : first step to try, s. times, values : the controls (see ``controls_at``).
    floor, ceiling : depths in m that end the run; infinite where there is none.
    grid : (m,) increasing times in s at which ``out`` (m, 15) is filled, those in (t, end].
    rtol : tolerance relative to scales + |state|; scales (15,), infinite for columns that do not count.
    reached : widened at every step.
    """
    y, new, work, k = start.copy(), np.empty(SIZE), np.empty(SIZE), np.empty((7, SIZE))
    segment = -1
    while segment < len(times) - 1 and times[segment + 1] <= t:
        segment += 1
    slope_into(k[0], t, y, segment, times, values, sea, p, full)
    evaluations, row, status = 1, 0, REACHED_END
    while row < len(grid) and grid[row] <= t:
        row += 1
    first_row = row
    while t < t_end:
        knot = times[segment + 1] if segment + 1 < len(times) else math.inf
        stop = min(t_end, knot)
        h = min(step, _LARGEST_STEP, stop - t)
        last = h >= (stop - t) * (1.0 - 1e-12)
        stages(y, t, h, k, new, segment, times, values, sea, p, full)
        evaluations += 6
        error = error_norm(y, new, h, k, rtol, scales)
        if not error <= 1.0:
            step = h * max(0.1, 0.9 * error**-0.2) if error < math.inf else 0.1 * h
            if step < _SMALLEST_STEP:
                status = STEP_TOO_SMALL
                break
            continue
        grown = h * min(5.0, 0.9 * max(error, 1e-10) ** -0.2)
        step = max(step, grown) if last and h < step else grown
        t_new, share = (stop if last else t + h), 1.0
        if new[2] >= floor and y[2] < floor:
            share, status = crossing(y, new, h, k, floor, work), REACHED_FLOOR
        elif new[2] <= ceiling and y[2] > ceiling:
            share, status = crossing(y, new, h, k, ceiling, work), REACHED_CEILING
        if share < 1.0:
            t_new = t + share * h
        while row < len(grid) and grid[row] <= t_new:
            dense(out[row], y, new, h, k, (grid[row] - t) / h)
            row += 1
        if share == 1.0 and k[0, 2] * k[6, 2] < 0.0:
            at, depth = turning_point(y, new, h, k, work)
            note_depth(reached, t + at * h, depth)
        if status == REACHED_END:
            norm = math.sqrt(new[3] ** 2 + new[4] ** 2 + new[5] ** 2 + new[6] ** 2)
            y[:] = new
            for j in range(3, 7):
                y[j] = y[j] / norm
        else:
            dense(work, y, new, h, k, share)
            y[:] = work
            y[2] = floor if status == REACHED_FLOOR else ceiling
        note_depth(reached, t_new, y[2])
        x = state_of(y)
        V, _ = through_water(x, controls_at(times, values, t_new, segment), at_depth(sea, y[2]), p, full)
        note_angles(reached, t_new, t_new - t, V, x.q_wxyz)
        t = t_new
        if status != REACHED_END:
            break
        if t >= knot:
            segment += 1
            slope_into(k[0], t, y, segment, times, values, sea, p, full)
            evaluations += 1
        else:
            k[0] = k[6]
    return Run(status, t, y, row - first_row, step, evaluations)
