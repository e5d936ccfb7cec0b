"""What does one strip of a hull with fins add? Exact potential flow across a circle with flat fins, by conformal map.

The section is a circle of radius a with two fins in one plane through its centre, tips at s = t1 and s = -t2; either
may be missing. With Z = s + i n (n across the plane) the water around it becomes that around a circle |w| = r:

    Z + a^2 / Z = (T1 - T2)/2 + w + r^2 / w,    T = t + a^2 / t,  r = (T1 + T2)/4

Far away Z = w + const + (r^2 - a^2)/w, from which the added mass across the plane is rho pi (4 r^2 - 3 a^2): for like
fins the rho pi (t^2 - a^2 + a^4/t^2) of Nielsen, Missile Aerodynamics (1960), chapter 10. Along the plane a flat fin
adds nothing. That of a rotation is a sum over the Fourier coefficients of the stream function on the circle.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Section", "section"]

Array = NDArray[np.float64]

_POINTS = 2048
"""on the circle. Where a fin meets the circle the stream function has a corner and the sum converges slowly: rotation
and its coupling are right to 0.3 %, without a circle to rounding (tests/unit/coefficients/test_section.py)."""


class Section(NamedTuple):
    """Added mass of sections per length, for unit density, about the circle's centre."""

    across: Array
    """m2: of moving across the fins' plane."""
    turning: Array
    """m4: of turning about the centre."""
    coupling: Array
    """m3: between them, positive where the first fin is the longer: moving towards +n, turning from s to n."""


def section(radius: ArrayLike, one: ArrayLike, other: ArrayLike) -> Section:
    """Added mass of circles with fins.

    radius : of the circle, m, not negative. one, other : distance of the fins' tips from its centre, m; one that is not
    above the radius is no fin. All are broadcast together, to (n,).
    """
    a, t1, t2 = np.broadcast_arrays(*(np.atleast_1d(np.asarray(item, dtype=float)) for item in (radius, one, other)))
    T1, T2 = _opened(a, np.maximum(a, t1)), _opened(a, np.maximum(a, t2))
    r = (T1 + T2) / 4.0
    theta = 2.0 * np.pi * (np.arange(_POINTS) + 0.5) / _POINTS
    x = ((T1 - T2) / 2.0)[:, None] + 2.0 * r[:, None] * np.cos(theta)  # Z + a^2/Z on the surface
    on_fin = np.abs(x) > 2.0 * a[:, None]
    beyond = np.sqrt(np.maximum(x * x - 4.0 * a[:, None] ** 2, 0.0))
    distance = np.where(on_fin, (np.abs(x) + beyond) / 2.0, a[:, None])
    along = np.where(on_fin, np.sign(x) * distance, x / 2.0)
    # a body that moves with v across the plane and turns with p has psi = -v s - p (s^2 + n^2)/2 on its surface
    of_turn, of_move = (
        np.fft.rfft(psi, axis=-1)[:, 1 : _POINTS // 2] * (2.0 / _POINTS) for psi in (distance**2 / 2.0, along)
    )
    order = np.arange(1, _POINTS // 2)
    return Section(
        np.pi * (4.0 * r * r - 3.0 * a * a),
        np.pi * np.sum(order * np.abs(of_turn) ** 2, axis=-1),
        np.pi * np.sum(order * (of_turn * of_move.conj()).real, axis=-1),
    )


def _opened(a: Array, t: Array) -> Array:
    """t + a^2 / t, where there is anything."""
    return t + np.divide(a * a, t, out=np.zeros_like(t), where=t > 0.0)
