"""What does an ellipsoidal hull add exactly? A prolate spheroid in unbounded water: Lamb (1932), art. 114 and 115.

Lamb, Hydrodynamics, 6th edition; the same closed forms as in Fossen (2011), section 6.3.
"""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["Spheroid", "spheroid"]


class Spheroid(NamedTuple):
    """Added mass of a prolate spheroid as shares of what it displaces."""

    k1: float
    """Surge, of the displaced mass."""
    k2: float
    """Sway and heave, of the displaced mass."""
    k_turn: float
    """Pitch and yaw, of the displaced water's moment of inertia m (a^2 + b^2) / 5."""


def spheroid(length: float, diameter: float) -> Spheroid:
    """Lamb's coefficients of a prolate spheroid about its centre.

        e^2 = 1 - (b/a)^2,  alpha0 = 2 (1 - e^2)/e^3 (artanh e - e),  beta0 = 1/e^2 - (1 - e^2)/e^3 artanh e
        k1 = alpha0/(2 - alpha0),  k2 = beta0/(2 - beta0)
        k' = e^4 (beta0 - alpha0) / ((2 - e^2) (2 e^2 - (2 - e^2) (beta0 - alpha0)))

    length : 2 a, m. diameter : 2 b, m, smaller than the length.
    """
    e2 = 1.0 - (diameter / length) ** 2
    e = math.sqrt(e2)
    if e < 0.05:  # the closed forms cancel there; a sphere has 1/2, 1/2, 0, and the error of the series is below 1e-8
        alpha0 = 2.0 * (1.0 - e2) * (1.0 / 3.0 + e2 / 5.0 + e2**2 / 7.0)
        beta0 = 1.0 - alpha0 / 2.0
    else:
        alpha0 = 2.0 * (1.0 - e2) / e**3 * (math.atanh(e) - e)
        beta0 = 1.0 / e2 - (1.0 - e2) / e**3 * math.atanh(e)
    difference = beta0 - alpha0
    k_turn = e2**2 * difference / ((2.0 - e2) * (2.0 * e2 - (2.0 - e2) * difference)) if e2 > 0.0 else 0.0
    return Spheroid(alpha0 / (2.0 - alpha0), beta0 / (2.0 - beta0), k_turn)
