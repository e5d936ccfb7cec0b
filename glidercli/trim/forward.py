"""Which steady flights do these controls give? A straight glide first; then the mass is turned up to its rotation.

Strong climbs whose hull rolls far have a second flight, rolled to the other side; it is looked for from the first one,
mirrored. Everything here is a kernel.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.kernel import kernel
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.trim.newton import EXACT, MOST_ITERATIONS, follow, newton, ordinary
from glidercli.trim.steady import Unknowns
from glidercli.trim.straight import first_guess

__all__ = ["CONTROLS", "FAR_ROLL", "MOST_FOUND", "from_controls", "is_new", "mirrored_start", "straight_first"]

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

CONTROLS = (6, 7, 8)
"""The pins r_rx, gamma, m_b."""
MOST_FOUND = 6
"""Solutions that are kept for one question."""
FAR_ROLL = math.radians(40.0)
"""rad. No second flight was seen beside a smaller roll, but at the weakest net buoyancies."""
_OTHER_ITERATIONS = 14  # of 1090 second flights, nine tenths were reached in 7; each by at least one of three starts
_FAR_APART = math.radians(10.0)  # the two meet nowhere in the envelope
_SAME = 1e-7  # two solutions that differ by less in every unknown are one; Newton leaves 1e-10


@kernel
def is_new(x: Unknowns, found: Array, count: int) -> bool:
    """Whether x is none of the first ``count`` rows of ``found`` (m, 9)."""
    for i in range(count):
        far = 0.0
        for k in range(9):
            far = max(far, abs(x[k] - found[i, k]))
        if far < _SAME:
            return False
    return True


@kernel
def straight_first(
    rrx: float, gamma: float, mb: float, via: float, water: Water, p: Parameters, relative: float
) -> tuple[Unknowns, int, bool]:
    """(x, iterations, found) by way of the straight glide at the mass position ``via``, m."""
    V, alpha, theta = first_guess(via, mb, water.gravity, p)
    start = (V, alpha, 0.0, 0.0, 0.0, theta, via, 0.0, mb)
    x, used, found = newton(start, CONTROLS, (via, 0.0, mb), False, water, p, relative, MOST_ITERATIONS)
    found = found and ordinary(x)
    if found and via != rrx:
        x, more, found = follow(x, CONTROLS, (rrx, 0.0, mb), False, water, p, relative)
        used += more
    if found and gamma != 0.0:
        x, more, found = follow(x, CONTROLS, (rrx, gamma, mb), False, water, p, relative)
        used += more
    return x, used, found


@kernel
def mirrored_start(x: Unknowns, roll: float, share: float) -> Unknowns:
    """A start on the other side of a flight x: rolled to ``roll``, rad, at a share of its speed, with less pitch."""
    return (share * x[0], -0.2 * x[1], -x[2], -x[3], roll, share**4 * x[5], x[6], x[7], x[8])


@kernel
def other_side(x: Unknowns, water: Water, p: Parameters) -> tuple[Unknowns, int, bool]:
    """(y, iterations, found): the second flight of the controls of x, rolled to the other side."""
    used = 0
    if abs(x[4]) > FAR_ROLL:
        for roll, share in ((1.75, 1.0), (2.0, 0.8), (1.2, 1.0)):
            start = mirrored_start(x, -math.copysign(roll, x[4]), share)
            y, more, there = newton(start, CONTROLS, (x[6], x[7], x[8]), False, water, p, EXACT, _OTHER_ITERATIONS)
            used += more
            if there and ordinary(y) and abs(y[4] - x[4]) > _FAR_APART:
                return y, used, True
    return x, used, False


@kernel
def from_controls(
    rrx: float, gamma: float, mb: float, nominal: float, water: Water, p: Parameters
) -> tuple[Array, Integers, int, Unknowns]:
    """(solutions (m, 9), iterations (m,), how many, where the last attempt stands), SI and rad.

    nominal : mass position that holds the hull level, m; a second way starts 20 mm from it where the straight glide of
    the goal's own position cannot be had.
    """
    found, iterations, count = np.zeros((MOST_FOUND, 9)), np.zeros(MOST_FOUND, np.int64), 0
    x, used, there = straight_first(rrx, gamma, mb, rrx, water, p, EXACT)
    if not there:
        x, more, there = straight_first(rrx, gamma, mb, nominal + math.copysign(0.02, mb), water, p, EXACT)
        used += more
    if there:
        found[0], iterations[0], count = np.array(x), used, 1
        y, more, there = other_side(x, water, p)
        if there:
            found[1], iterations[1], count = np.array(y), more, 2
    return found, iterations, count, x
