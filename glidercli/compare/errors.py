"""How far is each simulated channel from the measured one? Statistics of what is left when one is taken from the other.

The measured samples set the times; see residuals.py.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from glidercli.residuals import Residuals, on_circle

__all__ = ["Errors", "statistics"]

Array = NDArray[np.float64]
CIRCLE = 360.0
"""deg; turns added up are no range that an error on the circle could have."""


@dataclasses.dataclass(frozen=True)
class Errors:
    """Statistics of n errors e = simulated - measured, in ``unit``; None where n is too small for one.

    rmse = sqrt(mean e^2); mae = mean |e|; bias = mean e; std = sqrt(mean (e - bias)^2): rmse^2 = bias^2 + std^2;
    max = largest |e|, first met at max_time_ns (UTC); correlation : Pearson's, of angles after each was unwrapped in
    time, None for fewer than 2 samples or a constant side; nrmse = rmse / (largest - smallest measured; of angles 360
    deg at most), None where the measured is constant. outside, gap : measured samples left out.
    """

    unit: str
    n: int
    rmse: float | None
    mae: float | None
    bias: float | None
    std: float | None
    max: float | None
    max_time_ns: int | None
    correlation: float | None
    nrmse: float | None
    outside: int
    gap: int


def statistics(errors: Residuals) -> Errors:
    """The statistics of residuals; see Errors for each formula."""
    e = errors.error
    if not len(e):
        return Errors(errors.unit, 0, *(None,) * 8, outside=errors.outside, gap=errors.gap)
    rmse = math.sqrt(float(np.mean(e * e)))
    worst = int(np.argmax(np.abs(e)))
    spread = _spread(errors.measured)
    if on_circle(errors.name):
        spread = min(spread, CIRCLE)
    return Errors(
        unit=errors.unit,
        n=len(e),
        rmse=rmse,
        mae=float(np.mean(np.abs(e))),
        bias=float(np.mean(e)),
        std=float(np.std(e)),
        max=float(abs(e[worst])),
        max_time_ns=int(errors.time_ns[worst]),
        correlation=_pearson(errors.measured, errors.simulated),
        nrmse=rmse / spread if spread > 0.0 else None,
        outside=errors.outside,
        gap=errors.gap,
    )


def _spread(values: Array) -> float:
    """Largest less smallest value; what differs by rounding alone is constant: 0. No channel is known to 1e-12 SI."""
    spread = float(np.ptp(values))
    return spread if spread > 1e-12 * max(1.0, float(np.max(np.abs(values)))) else 0.0


def _pearson(a: Array, b: Array) -> float | None:
    """Pearson's correlation of two (n,) arrays; None for n < 2 or where one of them is constant."""
    if len(a) < 2 or _spread(a) == 0.0 or _spread(b) == 0.0:
        return None
    a, b = (a - a.mean()) / _spread(a), (b - b.mean()) / _spread(b)
    return float(np.clip(np.sum(a * b) / math.sqrt(float(np.sum(a * a)) * float(np.sum(b * b))), -1.0, 1.0))
