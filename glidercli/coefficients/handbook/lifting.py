"""What lift does a surface make on its hull? Slope by aspect ratio and sweep, with the hull's flow around it.

Slope: Helmbold (1942) with sweep, as in DATCOM (1978), section 4.1.3.2, at low speed:

    a = 2 pi A / (2 + sqrt(4 + A^2 (1 + tan^2 L) / k^2)),   L sweep of the middle of the chord, k section slope / 2 pi

On a hull of radius r with tips at s, wing and hull together lift (1 + r/s)^2 times what the exposed panels would as a
wing of their own: Pitts, Nielsen & Kaattari, NACA TR 1307 (1957), K_W + K_B of slender bodies. A panel on one side
lacks its mirror image in part; slender-body theory (section.py) says how much, and the aspect ratio is cut by that
share. TR 1307 is for cylinders. On a hull that tapers off, and behind it, no factor is nominal: the planes of SUBOFF
have 0.7 of the lift that their exposed panels would have alone, 0.4 of that with the factor (docs/estimates.md).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from glidercli.coefficients.added.section import section
from glidercli.coefficients.handbook.bounds import Bounds
from glidercli.coefficients.shape.geometry import HullShape, Surface
from glidercli.coefficients.shape.planform import root

__all__ = ["Lifting", "lift_slope", "lifting", "one_sided"]

SECTION = (0.9, 0.75, 1.0)
"""Section slope over 2 pi. Hoerner's 0.9 (Fluid-Dynamic Lift, 1975, chapter II; Prestero 2001 takes it for REMUS); at
chord Reynolds numbers of 3e4 to 1e5 bubbles cost up to a quarter of it, and no section has more than theory."""
INTERFERENCE = 0.10
"""Of the hull's factors: TR 1307 states that lifts came out within 10 %."""
WAKE = 0.7
"""Of the lift of a surface on a tapering afterbody or behind it, lower bound: the hull's boundary layer is thick."""
_CYLINDER = 0.9
"""Radius at the root's trailing edge over the largest from which on a hull counts as a cylinder."""
SHIFT = 0.1
"""Of the chord, by which the centre of pressure may be off a quarter of it: low Reynolds number, low aspect ratio."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)


class Lifting(NamedTuple):
    """A surface on its hull; areas are exposed ones."""

    area: float
    """m2, of all panels, one face."""
    chord: float
    """m, mean of the exposed panel."""
    aspect: float
    """Of the exposed panel and its image."""
    lift: Bounds
    """m2: lift over dynamic pressure and angle, hull's share with it."""
    centre: float
    """m along the hull: a quarter of the chord, mean over the panel's area."""
    middle: float
    """m along the hull: half of the chord, likewise."""
    height: float
    """m: mean distance of the panel's area from the axis."""
    rolling: Bounds
    """m4: roll moment over dynamic pressure and p/V, positive."""
    span: float
    """m, over all, hull with it."""


def lift_slope(aspect: float, tan_sweep: float = 0.0, section_share: float = 1.0) -> float:
    """Lift slope per rad on the area: 2 pi for an endless straight wing, pi A / 2 for a very short one.

    aspect : A. tan_sweep : of the middle of the chord. section_share : section slope over 2 pi.
    """
    beta = math.sqrt(1.0 + tan_sweep**2) / section_share
    return 2.0 * math.pi * aspect / (2.0 + math.sqrt(4.0 + (aspect * beta) ** 2))


def one_sided(radius: float, tip: float) -> float:
    """How far a hull stands in for the mirror image of a panel on one side of it: 1/2 without hull, 1 for a wall.

    Slender-body theory. radius : of the hull, m. tip : of the panel from the axis, m.
    """
    if radius == 0.0:
        return 0.5
    added = float(section(radius, tip, radius).across[0]) - math.pi * radius**2
    both = float(section(radius, tip, tip).across[0]) - math.pi * radius**2
    return 2.0 * added / both


def lifting(surface: Surface, hull: HullShape) -> Lifting:
    """A surface's lift, about the hull's axis."""
    inner = root(surface, hull) or 0.0
    height = surface.semi_span - inner
    s = inner + height / 2.0 * (1.0 + _NODES)
    ds = _WEIGHTS * height / 2.0
    chord, lead = surface.chord(s), surface.leading_edge(s)
    panel = float((chord * ds).sum())
    mid_root, mid_tip = (
        float((surface.leading_edge(np.array([at])) - surface.chord(np.array([at])) / 2.0)[0])
        for at in (inner, surface.semi_span)
    )
    radius = float(hull.radius(np.array([mid_root]))[0])
    if inner > radius + 0.005:  # on a mast, or off the hull: nothing around it
        radius = 0.0
    joined = surface.sides == "both" and (radius > 0.0 or inner < 0.05 * surface.semi_span)
    image = 1.0 if joined else one_sided(radius, surface.semi_span)
    aspect = 2.0 * height**2 / panel
    tan_sweep = (mid_root - mid_tip) / height
    ends = _factors(surface, hull, inner, radius)
    slopes = [lift_slope(aspect * image, tan_sweep, share) * end for share, end in zip(SECTION, ends, strict=True)]
    # rolling, port and starboard lift against each other: to the wake each half is a wing of its own
    turning = [lift_slope(aspect / 2.0, tan_sweep, share) for share in SECTION]
    area = panel * surface.panels
    second = float((chord * s * s * ds).sum()) * surface.panels
    return Lifting(
        area=area, chord=panel / height, aspect=aspect, lift=Bounds(*slopes).times(area),
        centre=float(((lead - chord / 4.0) * chord * ds).sum()) / panel,
        middle=float(((lead - chord / 2.0) * chord * ds).sum()) / panel,
        height=float((s * chord * ds).sum()) / panel, rolling=Bounds(*turning).times(second),
        span=surface.semi_span * surface.panels,
    )  # fmt: skip


def _factors(surface: Surface, hull: HullShape, inner: float, radius: float) -> tuple[float, float, float]:
    """What the hull makes of a surface's lift: nominal, lower, upper. inner : its root; radius : of the hull, m."""
    at = np.array([inner])
    trailing = float((surface.leading_edge(at) - surface.chord(at))[0])
    factor = (1.0 + radius / surface.semi_span) ** 2
    if trailing < 0.5 * sum(hull.ends) and 2.0 * hull.radius(np.array([trailing]))[0] < _CYLINDER * hull.thickest:
        return 1.0, WAKE, max(factor, 1.0 + INTERFERENCE)
    return factor, factor * (1.0 - INTERFERENCE), factor * (1.0 + INTERFERENCE)
