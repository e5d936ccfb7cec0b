"""What does a bare hull feel across the flow, beyond the Munk moment that the model has already?

In potential flow a strip of a slender hull feels f = V d(a w)/dx, with its added mass a = rho (k2 - k1) S(x) and the
speed across it, w = v + x r. Summed up this is the Munk moment and no force, and the model makes it by itself, from the
added mass, in P x V. A real boundary layer leaves the hull towards the tail; behind a station x0 the force is missing:

    x0 = 0.378 + 0.527 x1,  shares of the length from the nose, x1 where S falls most steeply: Hopkins, NACA RM A51C14
                            (1951); DATCOM (1978), section 4.2.1.1

The force that is missing is what the hull adds to the model, with S0 = S(x0) and sums over the hull behind x0:

    Y = -V a0 (v + x0 r),   N = -V [a0 x0 (v + x0 r) - sum a (v + x r)]

Crossflow drag comes on top: Allen & Perkins, NACA TR 1048 (1951), f = rho/2 eta Cdc d |w| w. It is quadratic; a line is
fitted up to an angle A by least squares, as section 3.3 of the paper fits its cases: |x| x becomes 3/4 A x, and
|x|^3 becomes 5/6 A x^2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.coefficients.added.spheroid import spheroid
from glidercli.coefficients.handbook.bounds import Bounds
from glidercli.coefficients.shape.geometry import HullShape

__all__ = ["Crosswise", "crossflow_drag", "crosswise", "separation"]

Array = NDArray[np.float64]

_FINENESS = (1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 40.0)
_CYLINDER = (0.64, 0.68, 0.72, 0.74, 0.82, 0.91, 0.98)
"""Drag coefficient of a circular cylinder across the flow by length over diameter, subcritical: White, Fluid Mechanics
(2011), table 7.3, after Hoerner (1965); 1.2 when endless."""

MISSING = (0.4, 1.3)
"""Of the missing force, interval: the bare hull of SUBOFF has 0.4 of its force and moment (docs/estimates.md)."""
CROSSFLOW = (0.0, 1.5)
"""Of the crossflow drag, interval: at a few degrees nothing has separated yet; it may begin earlier than assumed."""

_POINTS = 4001


class Crosswise(NamedTuple):
    """The hull's coefficients across the flow over rho/2 (speed in m/s, rad, rad/s)."""

    normal: Bounds
    """m2: normal force over V^2 and angle."""
    moment: Bounds
    """m3: of the normal force about the origin over V^2 and angle, positive where it acts ahead; no Munk moment."""
    damping: Bounds
    """m4: moment against turning over V and rate, positive."""
    drag: Bounds
    """m2: drag over V^2 and angle squared."""


def crossflow_drag(fineness: float) -> float:
    """eta Cdc of a hull by length over diameter."""
    return float(np.interp(fineness, _FINENESS, _CYLINDER))


def separation(hull: HullShape) -> float:
    """x0, m along the hull: where the potential force ends."""
    x, area = _sections(hull)
    nose, tail = hull.ends
    slope = np.diff(area) / np.diff(x)  # x runs from tail to nose; behind the thickest section the area grows with x
    steepest = (nose - 0.5 * (x[1:] + x[:-1])[int(np.argmax(slope))]) / (nose - tail)
    return float(nose - (0.378 + 0.527 * steepest) * (nose - tail))


def crosswise(hull: HullShape, volume: float, origin: float, angle: float) -> Crosswise:
    """What the hull adds across the flow.

    volume : of the hull, m3. origin : centre of buoyancy along the hull, m. angle : up to which lines are fitted, rad.
    """
    length = hull.length_overall
    k = spheroid(length, (6.0 * volume / (np.pi * length)) ** 0.5)
    x, area = _sections(hull)
    x0 = separation(hull)
    behind = x <= x0
    a = 2.0 * (k.k2 - k.k1) * np.append(area[behind], np.interp(x0, x, area))
    s = np.append(x[behind], x0) - origin
    missing = [a[-1], a[-1] * s[-1] - np.trapezoid(a, s), a[-1] * s[-1] ** 2 - np.trapezoid(a * s, s), a[-1]]
    width, arm = 2.0 * hull.radius(x), x - origin
    per_length = crossflow_drag(length / hull.thickest) * width
    fitted = 0.75 * angle * per_length
    reach = 2.0 / length  # turning, the range is that of the angles at the ends of the hull
    across = [
        np.trapezoid(fitted, x), np.trapezoid(fitted * arm, x), reach * np.trapezoid(fitted * np.abs(arm) ** 3, x),
        np.trapezoid(per_length, x) * angle * 5.0 / 6.0,
    ]  # fmt: skip
    return Crosswise(
        *(_spread(one, MISSING) + _spread(two, CROSSFLOW) for one, two in zip(missing, across, strict=True))
    )


def _spread(value: float, factors: tuple[float, float]) -> Bounds:
    ends = sorted(float(value) * factor for factor in factors)
    return Bounds(float(value), *ends)


def _sections(hull: HullShape) -> tuple[Array, Array]:
    """Stations from tail to nose, m, and areas there, m2."""
    x = np.linspace(hull.ends[1], hull.ends[0], _POINTS)
    return x, np.pi * hull.radius(x) ** 2
