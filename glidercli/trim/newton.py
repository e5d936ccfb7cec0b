"""How is a trim reached from a start? Damped Newton on the nine unknowns, and continuation where one leap fails."""

from __future__ import annotations

import math

import numpy as np

from glidercli.kernel import compiled_as, kernel
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.trim.steady import CURVATURE, SLOWEST, Array, Pins, Unknowns, radius_speed, six, system

__all__ = ["follow", "newton", "ordinary", "tolerance", "worst"]

EXACT, ROUGH = 1e-11, 1e-4
"""Largest residual of a solution over the net weight that drives it: of an answer, and of a start for others."""
ROUNDING = 1e-14
"""Residual in N or N m that rounding leaves in static moments of some N m; no solution is asked to be better."""
MOST_ITERATIONS = 30
FEW_ITERATIONS = 9
"""A start that is near needs four to seven; one step of a continuation that needs more is better halved."""
_HALVINGS = 8
_SMALLEST_STEP = 1.0 / 128.0  # share of the way, at which a continuation gives up

Values = tuple[float, float, float]


@kernel
def tolerance(mb: float, water: Water, relative: float) -> float:
    """Largest residual, N or N m, that counts as zero at a net buoyancy, kg."""
    return max(relative * abs(mb) * water.gravity, ROUNDING)


@kernel
def worst(x: Unknowns, water: Water, p: Parameters) -> float:
    """Largest of the six equations, N or N m."""
    r = six(x, water, p)
    return max(abs(r[0]), abs(r[1]), abs(r[2]), abs(r[3]), abs(r[4]), abs(r[5]))


@kernel
def ordinary(x: Unknowns) -> bool:
    """Whether a flight is an ordinary one: flow from ahead, pitch short of the vertical, no flight on the back.

    Strong climbs with the mass turned far roll past 90 deg, and the simulator settles there; 135 deg leaves them in.
    """
    return (
        x[0] > 0.0 and abs(x[1]) < 0.6 and abs(x[2]) < 0.6 and abs(x[4]) < 0.75 * math.pi
        and abs(x[5]) < 0.5 * math.pi
    )  # fmt: skip


@kernel
def pinned(x: Unknowns, pins: Pins, values: Values) -> Unknowns:
    """x with the pinned unknowns at their values; a pinned curvature is left to the iteration."""
    y = np.array(x)
    for k in range(3):
        if pins[k] != CURVATURE:
            y[pins[k]] = values[k]
    return as_unknowns(y)


@kernel
def as_unknowns(y: Array) -> Unknowns:
    """An array (9,) as the nine unknowns."""
    return (
        float(y[0]), float(y[1]), float(y[2]), float(y[3]), float(y[4]), float(y[5]), float(y[6]), float(y[7]),
        float(y[8]),
    )  # fmt: skip


@kernel
def off(x: Unknowns, pins: Pins, values: Values, printed: bool, water: Water, p: Parameters) -> float:
    """How far x is from a trim: the largest of the six equations and of a missed curvature, weighed as m V omega_3."""
    far = worst(x, water, p)
    for k in range(3):
        if pins[k] == CURVATURE:
            missed = x[3] - values[k] * radius_speed(x, printed)
            far = max(far, abs(missed) * (p.ms + p.mr) * x[0])
    return far


@kernel
def eliminated(a: Array, b: Array) -> tuple[Array, bool]:
    """Solution of a x = b, (n,), by Gaussian elimination with partial pivoting, and whether a is regular."""
    A, x, n = a.copy(), b.copy(), len(b)
    for i in range(n):
        pivot = i + int(np.argmax(np.abs(A[i:, i])))
        if A[pivot, i] == 0.0:
            return x, False
        for j in range(n):
            A[i, j], A[pivot, j] = A[pivot, j], A[i, j]
        x[i], x[pivot] = x[pivot], x[i]
        for row in range(i + 1, n):
            factor = A[row, i] / A[i, i]
            for j in range(i, n):
                A[row, j] -= factor * A[i, j]
            x[row] -= factor * x[i]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            x[i] -= A[i, j] * x[j]
        x[i] /= A[i, i]
    return x, True


@compiled_as(eliminated)
def solve(a: Array, b: Array) -> tuple[Array, bool]:
    """The same by LAPACK, which numba takes 4.4 s to compile."""
    try:
        return np.asarray(np.linalg.solve(a, b)), True
    except np.linalg.LinAlgError:
        return b, False


@kernel
def newton(
    start: Unknowns,
    pins: Pins,
    values: Values,
    printed: bool,
    water: Water,
    p: Parameters,
    relative: float,
    most: int,
) -> tuple[Unknowns, int, bool]:
    """(x, iterations, whether it is a trim) by damped Newton: each step is halved until the equations come nearer zero.

    Steps that would stop the vehicle or turn its net buoyancy round are halved too: a glider that hangs at rest with no
    net buoyancy fulfils all six equations and is no answer.
    """
    x = pinned(start, pins, values)
    far = off(x, pins, values, printed, water, p)
    for iteration in range(1, most + 1):
        A, r = system(x, pins, values, printed, water, p)
        step, regular = solve(A, r)
        if not regular:
            return x, iteration, False
        share, nearer = 1.0, False
        for _ in range(_HALVINGS):
            trial = as_unknowns(np.array(x) - share * step)
            if trial[0] > 0.0 and trial[8] * x[8] > 0.0:
                new = off(trial, pins, values, printed, water, p)
                if new < far:
                    nearer = True
                    break
            share *= 0.5
        if not nearer:
            return x, iteration, far < tolerance(x[8], water, relative)
        x, far = trial, new
        if far < tolerance(x[8], water, relative):
            return x, iteration, True
    return x, most, False


@kernel
def follow(
    start: Unknowns, pins: Pins, values: Values, printed: bool, water: Water, p: Parameters, relative: float
) -> tuple[Unknowns, int, bool]:
    """(x, iterations, whether it got there): from a trim to other values of the pins, in steps that halve."""
    x, done, step, used = start, 0.0, 1.0, 0
    at = np.zeros(3)
    for k in range(3):
        at[k] = x[3] / max(radius_speed(x, printed), SLOWEST) if pins[k] == CURVATURE else x[pins[k]]
    while done < 1.0 and step > _SMALLEST_STEP:
        share = min(1.0, done + step)
        a = at[0] + share * (values[0] - at[0])
        b = at[1] + share * (values[1] - at[1])
        c = at[2] + share * (values[2] - at[2])
        if share == 1.0:
            a, b, c = values
        y, iterations, found = newton(x, pins, (a, b, c), printed, water, p, relative, FEW_ITERATIONS)
        used += iterations
        if found and ordinary(y):
            x, done = y, share
        else:
            step *= 0.5
    return x, used, done >= 1.0
