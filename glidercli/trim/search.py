"""Which trims have these three pinned values? Every tetrahedron of the atlas that holds them, refined by Newton.

Where none does, the nearest trims of the atlas are followed to the values. Everything here is a kernel: it runs plain
for one question and compiled for a map of them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import cross, dot
from glidercli.kernel import kernel
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.trim.atlas import Chart
from glidercli.trim.forward import MOST_FOUND, is_new
from glidercli.trim.newton import EXACT, MOST_ITERATIONS, Values, as_unknowns, follow, newton, ordinary
from glidercli.trim.steady import Pins, Unknowns

__all__ = ["search", "search_all"]

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

_BEYOND = 0.15
"""Share of its size by which a tetrahedron's box is searched beyond its corners: its faces are really curved."""
_WITHIN, _OUTSIDE = -1e-9, -0.35
"""Least barycentric weight of a start, in the first pass and in the second: trims bend between corners."""


@kernel
def weights(values: Values, a: Array, b: Array, c: Array, d: Array) -> tuple[float, float, float, float]:
    """Barycentric weights of a point in the tetrahedron a, b, c, d (3,), by Cramer's rule; -inf where it is flat."""
    u = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    v = (c[0] - a[0], c[1] - a[1], c[2] - a[2])
    w = (d[0] - a[0], d[1] - a[1], d[2] - a[2])
    q = (values[0] - a[0], values[1] - a[1], values[2] - a[2])
    volume = dot(u, cross(v, w))
    if volume == 0.0:
        return -np.inf, -np.inf, -np.inf, -np.inf
    s = dot(q, cross(v, w)) / volume
    t = dot(u, cross(q, w)) / volume
    r = dot(u, cross(v, q)) / volume
    return 1.0 - s - t - r, s, t, r


@kernel
def beside(m: int, places: Integers, taken: Integers, count: int) -> bool:
    """Whether the cell of tetrahedron m is one, or a neighbour of one, that has given a trim already."""
    for i in range(count):
        n = taken[i]
        if n < 0 or places[n, 0] != places[m, 0]:
            continue
        if (
            abs(places[n, 1] - places[m, 1]) <= 1 and abs(places[n, 2] - places[m, 2]) <= 1
            and abs(places[n, 3] - places[m, 3]) <= 1
        ):  # fmt: skip
            return True
    return False


@kernel
def boxed(values: Values, known: Chart, m: int) -> bool:
    """Whether the box of tetrahedron m, a little enlarged, holds the values."""
    for k in range(3):
        margin = _BEYOND * (known.high[m, k] - known.low[m, k]) + 1e-12
        if values[k] < known.low[m, k] - margin or values[k] > known.high[m, k] + margin:
            return False
    return True


@kernel
def start_in(values: Values, known: Chart, m: int) -> tuple[Unknowns, float]:
    """The trim at the values by linear interpolation in tetrahedron m, and its least weight, negative outside."""
    i, j, k, n = known.corners[m, 0], known.corners[m, 1], known.corners[m, 2], known.corners[m, 3]
    a, b, c, d = weights(values, known.pinned[i], known.pinned[j], known.pinned[k], known.pinned[n])
    least = min(a, b, c, d)
    if least < _OUTSIDE:
        return as_unknowns(known.trims[i]), least
    return as_unknowns(a * known.trims[i] + b * known.trims[j] + c * known.trims[k] + d * known.trims[n]), least


@kernel
def search(
    values: Values, pins: Pins, known: Chart, nearest: int, thorough: bool, printed: bool, water: Water, p: Parameters
) -> tuple[Array, Integers, int]:
    """(trims (MOST_FOUND, 9), iterations (MOST_FOUND,), how many) at the pinned values.

    First the tetrahedra that hold the values, then those that hold them nearly and lie apart from the first; if none
    leads anywhere, or in a thorough search, continuation from as many of the nearest trims as ``nearest`` says.
    """
    found, iterations = np.zeros((MOST_FOUND, 9)), np.zeros(MOST_FOUND, np.int64)
    taken = np.full(MOST_FOUND, -1)
    count = 0
    for allowed in (_WITHIN, _OUTSIDE):
        for m in range(len(known.corners)):
            if count == MOST_FOUND or not boxed(values, known, m):
                continue
            if allowed == _OUTSIDE and beside(m, known.places, taken, count):
                continue
            start, least = start_in(values, known, m)
            if least < allowed:
                continue
            x, used, there = newton(start, pins, values, printed, water, p, EXACT, MOST_ITERATIONS)
            if there and ordinary(x) and is_new(x, found, count):
                found[count], iterations[count], taken[count] = np.array(x), used, m
                count += 1
    if count == 0 or thorough:
        far = np.zeros(len(known.pinned))
        for k in range(3):
            far += ((known.pinned[:, k] - values[k]) / known.size[k]) ** 2
        for m in np.argsort(far)[:nearest]:
            x, used, there = follow(as_unknowns(known.trims[m]), pins, values, printed, water, p, EXACT)
            if there and count < MOST_FOUND and is_new(x, found, count):
                found[count], iterations[count] = np.array(x), used
                count += 1
    return found, iterations, count


@kernel
def search_all(
    values: Array,
    pins: Pins,
    known: Chart,
    nearest: int,
    thorough: bool,
    printed: bool,
    water: Water,
    p: Parameters,
) -> tuple[Array, Integers, Integers]:
    """``search`` at every row of values (n, 3): trims (n, MOST_FOUND, 9), iterations (n, MOST_FOUND), counts (n,)."""
    n = len(values)
    found, iterations = np.zeros((n, MOST_FOUND, 9)), np.zeros((n, MOST_FOUND), np.int64)
    counts = np.zeros(n, np.int64)
    for i in range(n):
        v = (values[i, 0], values[i, 1], values[i, 2])
        found[i], iterations[i], counts[i] = search(v, pins, known, nearest, thorough, printed, water, p)
    return found, iterations, counts
