"""Why is there no such flight? The point nearest to one, and the equation that is furthest from zero there."""

from __future__ import annotations

import math

import numpy as np

from glidercli.model.equations import EQUATIONS
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.trim.atlas import Chart
from glidercli.trim.newton import as_unknowns
from glidercli.trim.pins import QUANTITIES, Question
from glidercli.trim.steady import CURVATURE, Array, Unknowns, radius_speed, six

__all__ = ["nearest_miss"]

_STARTS = 3
_BOUNDS = {  # of an ordinary flight; see newton.ordinary
    "speed": (1e-3, 10.0),
    "angle_of_attack": (-0.6, 0.6),
    "sideslip": (-0.6, 0.6),
    "yaw_rate": (-3.0, 3.0),
    "roll": (-0.75 * math.pi, 0.75 * math.pi),
    "pitch": (-1.57, 1.57),
    "mass_rotation": (-math.pi, math.pi),
}


def nearest_miss(asked: Question, known: Chart, printed: bool, water: Water, p: Parameters) -> str:
    """Where the six equations come nearest to zero, by least squares over what is not pinned, and what fails there.

    A pinned turning radius gives omega_3; with that pinned too it is a seventh equation, weighed as m V omega_3. The
    net buoyancy stays within that of the atlas, since every hull that hangs at rest with none fulfils all six.
    """
    far = (((known.pinned - np.array(asked.values)) / known.size) ** 2).sum(axis=1)
    nearest = [_least(known.trims[row], asked, known, printed, water, p) for row in np.argsort(far)[:_STARTS]]
    _, x = min(nearest, key=lambda one: one[0])
    r = six(x, water, p)
    worst = max(range(6), key=lambda i: abs(r[i]))
    unit = "N" if worst < 3 else "N m"
    return (
        f"the {EQUATIONS[worst]} stays furthest from zero, {r[worst]:.3g} {unit}, at the nearest point: "
        f"{_told(x, asked)}"
    )


def _least(
    start: Array, asked: Question, known: Chart, printed: bool, water: Water, p: Parameters
) -> tuple[float, Unknowns]:
    """(sum of squares, x) of the least-squares point that is reached from a trim of the atlas."""
    from scipy.optimize import least_squares

    x0 = start.copy()
    held = [(pin, value) for pin, value in zip(asked.pins, asked.values, strict=True) if pin != CURVATURE]
    curvatures = [value for pin, value in zip(asked.pins, asked.values, strict=True) if pin == CURVATURE]
    for pin, value in held:
        x0[pin] = value
    follows = bool(curvatures) and 3 not in dict(held)  # omega_3 follows from the radius
    free = [i for i in range(9) if i not in dict(held) and not (i == 3 and follows)]

    def whole(y: Array) -> Unknowns:
        x = x0.copy()
        x[free] = y
        if follows:
            x[3] = curvatures[0] * radius_speed(as_unknowns(x), printed)
        return as_unknowns(x)

    def misses(y: Array) -> list[float]:
        x = whole(y)
        weight = (p.ms + p.mr) * x[0]
        also = [] if follows else [weight * (x[3] - one * radius_speed(x, printed)) for one in curvatures]
        return [*six(x, water, p), *also]

    same_way = known.trims[known.trims[:, 8] * x0[8] > 0.0]
    low, high = same_way.min(axis=0), same_way.max(axis=0)
    for name, (least, most) in _BOUNDS.items():
        low[QUANTITIES[name].place], high[QUANTITIES[name].place] = least, most
    solved = least_squares(
        misses,
        np.clip(x0[free], low[free] + 1e-9, high[free] - 1e-9),
        bounds=(low[free], high[free]),
        x_scale=known.trims[:, free].std(axis=0) + 1e-9,
    )
    return float(solved.cost), whole(solved.x)


def _told(x: Unknowns, asked: Question) -> str:
    """What is not pinned, for people."""
    return ", ".join(
        f"{name.replace('_', ' ')} {round(x[q.place] / q.factor, 4) + 0.0:.4g} {q.unit}"
        for name, q in QUANTITIES.items()
        if q.place != CURVATURE and name not in asked.names
    )
