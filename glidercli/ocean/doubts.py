"""What of a cast is possible, but more likely somebody's slip? Nearly fresh water, and water that overturns."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["doubts", "overturn"]

Array = NDArray[np.float64]

_KG_PER_KG = (0.025, 0.045)  # ocean salinity in kg/kg, taken for practical
_OVERTURN = 0.2  # kg/m3; noise and overturns in the sea stay below


def doubts(salinity: Array | None, density: Array) -> tuple[str, ...]:
    """What is possible, but more likely a slip of whoever made the table."""
    lines = []
    if salinity is not None and _KG_PER_KG[0] < float(np.median(salinity)) < _KG_PER_KG[1]:
        middle = f"salinity is about {np.median(salinity):g}"
        lines.append(f"{middle}, nearly fresh; the ocean has about 35, which is 0.035 kg/kg")
    if (fall := overturn(density)) > 0.0:
        lines.append(f"density falls with depth by up to {fall:.2f} kg/m3: such water would overturn")
    return tuple(lines)


def overturn(density: Array) -> float:
    """How far density falls with depth, kg/m3, where that is more than noise; else 0. density : (n,), by depth."""
    fall = float((np.maximum.accumulate(density) - density).max())
    return fall if fall > _OVERTURN else 0.0
