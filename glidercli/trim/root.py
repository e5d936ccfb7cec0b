"""Which steady flight do these controls give? Newton's method on the six equations (28), (29), led by continuation.

The unknowns are V, alpha, beta, omega_3, phi, theta. A straight glide is found first; the rotation of the movable mass
is then turned up to its value in steps that halve where Newton fails.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import NoSolutionError
from glidercli.frames import down_in_body
from glidercli.model.equations import EQUATIONS, equilibrium
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water
from glidercli.trim.straight import first_guess

__all__ = ["Solution", "residuals", "solve_forward"]

Array = NDArray[np.float64]

RELATIVE_TOLERANCE = 1e-11
"""Largest residual of a solution over the net weight that drives it."""
ROUNDING = 1e-14
"""Residual in N or N m that rounding leaves in static moments of some N m; no solution is asked to be better."""

_STEP = 1e-6  # central differences: truncation 1e-12 and rounding 1e-10, both far below what Newton needs


class Solution(NamedTuple):
    """Outcome of a solve.

    unknowns : V, alpha, beta, omega_3, phi, theta in SI, rad. residual : largest of the six equations.
    """

    unknowns: Array
    residual: float
    iterations: int
    converged: bool


def residuals(x: Array, c: Controls, water: Water, p: Parameters) -> Array:
    """The six equations at x = (V, alpha, beta, omega_3, phi, theta), N and N m."""
    V, alpha, beta, omega3, phi, theta = (float(item) for item in x)
    return np.array(equilibrium(velocity_from_flow(V, alpha, beta), down_in_body(phi, theta), omega3, c, water, p))


def tolerance(c: Controls, water: Water) -> float:
    """Largest residual, N or N m, that counts as zero for these controls."""
    return max(RELATIVE_TOLERANCE * abs(c.mb) * water.gravity, ROUNDING)


def newton(start: Array, c: Controls, water: Water, p: Parameters, limit: int = 30) -> Solution:
    """Damped Newton from a start: each step is halved until the residual shrinks."""
    x = np.array(start, dtype=float)
    r = residuals(x, c, water, p)
    enough = tolerance(c, water)
    for iteration in range(1, limit + 1):
        steps = np.eye(6) * _STEP
        columns = [(residuals(x + h, c, water, p) - residuals(x - h, c, water, p)) / (2.0 * _STEP) for h in steps]
        try:
            full = np.linalg.solve(np.array(columns).T, -r)
        except np.linalg.LinAlgError:
            break
        for shrink in range(12):
            trial = x + full * 0.5**shrink
            if trial[0] <= 0.0:
                continue
            new = residuals(trial, c, water, p)
            if np.abs(new).max() < np.abs(r).max():
                break
        else:
            break
        x, r = trial, new
        if np.abs(r).max() < enough:
            return Solution(x, float(np.abs(r).max()), iteration, True)
    residual = float(np.abs(r).max())
    return Solution(x, residual, limit, residual < enough)


def _glides(x: Array) -> bool:
    """Whether a solution is an ordinary one: flow from ahead, pitch short of the vertical, no flight on the back.

    Strong climbs with the mass turned far roll past 90 deg, and the simulator settles there; 135 deg leaves them in.
    """
    _, alpha, beta, _, phi, theta = x
    return bool(abs(alpha) < 0.6 and abs(beta) < 0.6 and abs(phi) < 0.75 * math.pi and abs(theta) < math.pi / 2)


def follow(x: Array, start: Controls, goal: Controls, water: Water, p: Parameters) -> Solution:
    """Continue a solution at ``start`` to the controls ``goal`` in steps that halve where Newton fails."""
    done, step, used = 0.0, 1.0, 0
    solution = Solution(x, math.inf, 0, False)
    while done < 1.0 and step > 1e-4:
        share = min(1.0, done + step)
        c = Controls(*(a + share * (b - a) for a, b in zip(start, goal, strict=True)))
        attempt = newton(x, c, water, p)
        used += attempt.iterations
        if attempt.converged and _glides(attempt.unknowns):
            x, done, solution = attempt.unknowns, share, attempt
        else:
            step /= 2.0
            if not solution.converged or attempt.residual < solution.residual:
                solution = attempt._replace(converged=False)
    return solution._replace(iterations=used, converged=done >= 1.0)


def solve_forward(goal: Controls, nominal_position: float, water: Water, p: Parameters) -> Solution:
    """The steady flight of given controls: the six unknowns from net buoyancy, mass position and rotation.

    nominal_position : position of the movable mass at which the vehicle is level, m; a second way starts 20 mm from it
    where the straight glide of the goal's own position cannot be had.

    Raises
    ------
    NoSolutionError
        No way leads there; the message names the equation that stays furthest from zero, and where.
    """
    if goal.mb == 0.0:
        raise NoSolutionError("net buoyancy 0 kg: a neutral glider has no steady flight; give a value other than 0")
    detour = goal._replace(rrx=nominal_position + math.copysign(0.02, goal.mb))
    used = 0
    for via in (goal, detour):
        c = via._replace(gamma=0.0)
        speed, alpha, theta = first_guess(c, water.gravity, p)
        reached = newton(np.array([speed, alpha, 0.0, 0.0, 0.0, theta]), c, water, p)
        used += reached.iterations
        for stop in (via, goal):
            if reached.converged and _glides(reached.unknowns) and stop != c:
                reached = follow(reached.unknowns, c, stop, water, p)
                used += reached.iterations
                c = stop
        if reached.converged and _glides(reached.unknowns) and c == goal:
            return reached._replace(iterations=used)
    r = residuals(reached.unknowns, goal, water, p)
    worst = int(np.abs(r).argmax())
    V, alpha, beta, _, phi, theta = reached.unknowns
    degrees = [f"{name} {math.degrees(value):.1f} deg" for name, value in (
        ("angle of attack", alpha), ("sideslip", beta), ("roll", phi), ("pitch", theta))]  # fmt: skip
    why = f"the {EQUATIONS[worst]} stays furthest from zero, {r[worst]:.3g}, at"
    if np.abs(r).max() < tolerance(goal, water):
        why = "the one found is no ordinary glide, with flow from ahead and the hull short of the vertical:"
    raise NoSolutionError(
        f"no steady glide found for net buoyancy {goal.mb:g} kg, mass position {goal.rrx:g} m, mass rotation "
        f"{math.degrees(goal.gamma):g} deg: {why} speed {V:.3f} m/s, {', '.join(degrees)}"
        f"{_usual_reason(goal, nominal_position)}"
    )


def _usual_reason(goal: Controls, level: float) -> str:
    """The usual reason: the mass lies on the wrong side of the position, m, that holds the hull level."""
    if (goal.rrx - level) * goal.mb >= 0.0:
        return ""
    way, needed = ("sinking", "forward") if goal.mb > 0.0 else ("rising", "aft")
    return f"; a {way} glider needs the mass {needed} of {level:g} m, where it holds the hull level"
