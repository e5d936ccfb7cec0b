"""What drag does the wetted surface make? Flat plates at each part's own Reynolds number, and form factors.

Turbulent: the ITTC line of 1957, Cf = 0.075 / (log10 Re - 2)^2. Laminar: Blasius (1908), Cf = 1.328 / sqrt(Re).
Form factors: Hoerner, Fluid-Dynamic Drag (1965), chapter 6: 1 + 1.5 (d/l)^1.5 + 7 (d/l)^3 of a streamline body, and
1 + 2 t/c + 60 (t/c)^4 of a profile.
"""

from __future__ import annotations

import math

import numpy as np

from glidercli.coefficients.handbook.bounds import Bounds
from glidercli.coefficients.shape.geometry import HullShape

__all__ = [
    "LAMINAR_TO", "REYNOLDS", "TURBULENT_FROM", "friction", "hull_form", "laminar", "profile_form", "turbulent",
    "wetted_area",
]  # fmt: skip

REYNOLDS = (1e3, 1e9)
"""Between which a Reynolds number gets a coefficient without a warning."""
TURBULENT_FROM = 2e5
"""Nominally turbulent from here up: joints, sensors and growth trip the boundary layer of a hull; below, laminar."""
LAMINAR_TO = 3e6
"""No plate stays laminar beyond; the lower bound is then a tenth under the turbulent line."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(48)


def turbulent(reynolds: float) -> float:
    """Friction coefficient on the wetted area of a plate turbulent from its edge, ITTC (1957); meant for Re > 1e5."""
    return 0.075 / float((math.log10(max(reynolds, 1e3)) - 2.0) ** 2)


def laminar(reynolds: float) -> float:
    """Friction coefficient on the wetted area of a laminar plate, Blasius; meant for 1e3 < Re < 3e6."""
    return 1.328 / math.sqrt(reynolds)


def friction(reynolds: float) -> Bounds:
    """Friction coefficient with the interval from laminar to turbulent; turbulent from ``TURBULENT_FROM`` up."""
    above = turbulent(reynolds)
    if reynolds > LAMINAR_TO:
        return Bounds(above, 0.9 * above, 1.1 * above)
    ends = sorted((laminar(reynolds), above))
    return Bounds(above if reynolds >= TURBULENT_FROM else laminar(reynolds), *ends)


def hull_form(diameter: float, length: float) -> float:
    """Drag of a streamline body over that of its friction alone: Hoerner (1965), chapter 6."""
    ratio = diameter / length
    return 1.0 + 1.5 * ratio * math.sqrt(ratio) + 7.0 * ratio**3


def profile_form(thickness: float) -> float:
    """Drag of a profile over that of its friction alone, by thickness over chord: Hoerner (1965), chapter 6."""
    return 1.0 + 2.0 * thickness + 60.0 * thickness**4


def wetted_area(hull: HullShape) -> float:
    """Surface of the hull, m2: the integral of 2 pi r along its outline."""
    if hull.stations is not None:
        x, r = np.array(hull.stations), np.array(hull.radii)
        return float(
            np.sum(np.pi * (r[1:] + r[:-1]) * np.hypot(np.diff(x), np.diff(r))) + np.pi * (r[0] ** 2 + r[-1] ** 2)
        )
    a, b = hull.length_overall / 2.0, hull.thickest / 2.0
    angle = np.pi / 2.0 * _NODES  # x = a sin, r = b cos
    along = np.sqrt((a * np.cos(angle)) ** 2 + (b * np.sin(angle)) ** 2)
    return float(np.sum(_WEIGHTS * 2.0 * np.pi * b * np.cos(angle) * along) * np.pi / 2.0)
