"""How far apart are the lines of a grid, or the marks of a scale? A round number."""

from __future__ import annotations

import math

__all__ = ["nice"]


def nice(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is no greater than a positive value, but for rounding."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * max(step for step in (1, 2, 5) if step * power <= value * (1.0 + 1e-9))
