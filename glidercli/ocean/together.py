"""What is to be said of several profiles at once? Gaps, and water that would overturn, in a line each."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from glidercli.ocean.doubts import overturn
from glidercli.ocean.profile import wide_gaps

__all__ = ["gaps_of", "overturns_of"]

Array = NDArray[np.float64]


def gaps_of(depths: Sequence[Array], what: str) -> tuple[str, ...]:
    """The wide gaps of the first profile that has any, and how many others have. what : "bin", "sample"."""
    gaps = [line for depth in depths for line in wide_gaps(depth, what)]
    if not gaps:
        return ()
    return (gaps[0] + (f"; gaps also in {len(gaps) - 1} of the other profiles" if len(gaps) > 1 else ""),)


def overturns_of(densities: Sequence[Array]) -> tuple[str, ...]:
    """How far density falls with depth at the most, kg/m3, and in how many profiles."""
    falls = [fall for density in densities if (fall := overturn(density)) > 0.0]
    if not falls:
        return ()
    where = f" in {len(falls)} of {len(densities)} profiles" if len(densities) > 1 else ""
    return (f"density falls with depth by up to {max(falls):.2f} kg/m3{where}: such water would overturn",)
