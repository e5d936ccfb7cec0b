"""How do surfaces lie on the hull and beside one another? Where each leaves the hull, and whether two cross."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from glidercli.coefficients.shape.geometry import HullShape, Surface

__all__ = ["middle", "overlap", "root"]

Array = NDArray[np.float64]

_STEPS = 512  # of the search for where a surface leaves the hull, over its span


def middle(surface: Surface, s: Array) -> Array:
    """Middle of the chord at distances s from the hull's axis, m, forward."""
    return surface.leading_edge(s) - surface.chord(s) / 2.0


def root(surface: Surface, hull: HullShape) -> float | None:
    """Distance from the axis beyond which the surface is in the water, m; None if its tip is inside the hull.

    A strip is taken as out of the hull where its middle is.
    """
    s = np.linspace(surface.root_offset, surface.semi_span, _STEPS + 1)
    out = s - hull.radius(middle(surface, s))
    if out[-1] < 0.0:
        return None
    inside = np.flatnonzero(out < 0.0)
    if not len(inside):
        return float(s[0])
    at = inside[-1]
    return float(s[at] + (s[at + 1] - s[at]) * out[at] / (out[at] - out[at + 1]))


def overlap(one: Surface, other: Surface) -> bool:
    """Whether two surfaces of one plane and side lie over each other."""
    if one.plane != other.plane or ("both" not in (one.sides, other.sides) and one.sides != other.sides):
        return False
    inner, outer = max(one.root_offset, other.root_offset), min(one.semi_span, other.semi_span)
    if inner >= outer:
        return False
    s = np.linspace(inner, outer, _STEPS + 1)
    ahead = one.leading_edge(s) - (other.leading_edge(s) - other.chord(s))
    behind = other.leading_edge(s) - (one.leading_edge(s) - one.chord(s))
    return bool(np.any((ahead > 1e-9) & (behind > 1e-9)))
