"""How far is each simulated channel from the measured one?

The measured samples set the times. The simulated channel is interpolated linearly to them, angles the short way round
the circle; never across a gap in the simulated samples longer than ``max_gap`` and never beyond their ends: such
measured samples are left out and counted. Values are in the unit of tables, angles in degrees, since they are reports.
The error is simulated less measured; for angles on the circle it is brought to (-180, 180] deg.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.frames import wrapped
from glidercli.log import Channel
from glidercli.units import NANOSECOND

__all__ = ["Errors", "Residuals", "on_circle", "residuals", "statistics", "table_values"]

Array = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Residuals:
    """One channel of two logs on the measured samples' times, in the table's unit.

    time_ns, measured, simulated, error : (n,), the samples compared; angles on the circle are unwrapped.
    outside : measured samples before the first or after the last simulated one.
    gap : measured samples inside a gap of the simulated ones.
    """

    name: str
    unit: str
    time_ns: NDArray[np.int64]
    measured: Array
    simulated: Array
    error: Array
    outside: int
    gap: int
    skipped_ns: NDArray[np.int64]
    """Times of the samples outside or in a gap."""
    skipped_outside: NDArray[np.bool_]
    """Which of those are outside."""

    def where(self, chosen: NDArray[np.bool_], skipped: NDArray[np.bool_]) -> Residuals:
        """The part of the samples compared and of those skipped that the masks choose."""
        outside = self.skipped_outside[skipped]
        return dataclasses.replace(
            self,
            time_ns=self.time_ns[chosen],
            measured=self.measured[chosen],
            simulated=self.simulated[chosen],
            error=self.error[chosen],
            outside=int(outside.sum()),
            gap=int((~outside).sum()),
            skipped_ns=self.skipped_ns[skipped],
            skipped_outside=outside,
        )


@dataclasses.dataclass(frozen=True)
class Errors:
    """Statistics of n errors e = simulated - measured, in ``unit``; None where n is too small for one.

    rmse = sqrt(mean e^2); mae = mean |e|; bias = mean e; std = sqrt(mean (e - bias)^2): rmse^2 = bias^2 + std^2;
    max = largest |e|, first met at max_time_ns (UTC); correlation : Pearson's, of angles after each was unwrapped in
    time, None for fewer than 2 samples or a constant side; nrmse = rmse / (largest - smallest measured), None where the
    measured is constant. outside, gap : measured samples left out.
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


def on_circle(name: str) -> bool:
    """Whether a channel's values are angles whose difference is taken on the circle; longitude too."""
    return CHANNELS[name].circular or name == "longitude"


def table_values(channel: Channel) -> Array:
    """Values in the table's unit, angles on the circle unwrapped in time, deg."""
    values = channel.values * CHANNELS[channel.name].factor
    return np.unwrap(values, period=360.0) if on_circle(channel.name) else values


def residuals(measured: Channel, simulated: Channel, max_gap: float = 60.0) -> Residuals:
    """The errors of one simulated channel on the measured samples' times; the clocks must have been aligned.

    max_gap : s, positive, may be infinite: longest time between two simulated samples to interpolate across.

    Raises InputError when max_gap is not positive.
    """
    if not max_gap > 0.0:
        raise InputError("max-gap", f"{max_gap} s; allowed: a positive time")
    spec = CHANNELS[measured.name]
    at, values = simulated.time_ns, table_values(simulated)
    time_ns, wanted = measured.time_ns, table_values(measured)
    if len(at):
        outside = (time_ns < at[0]) | (time_ns > at[-1])
        before = np.clip(np.searchsorted(at, time_ns, side="right") - 1, 0, len(at) - 1)
        after = np.minimum(before + 1, len(at) - 1)
        span = at[after] - at[before]  # int64 ns, exact
        into = time_ns - at[before]
        gap = ~outside & (into > 0) & (span * NANOSECOND > max_gap)
        part = np.where(span > 0, into / np.maximum(span, 1), 0.0)
        interpolated = values[before] + part * (values[after] - values[before])
    else:
        outside, gap = np.ones(len(time_ns), dtype=bool), np.zeros(len(time_ns), dtype=bool)
        interpolated = np.zeros(len(time_ns))
    kept = ~outside & ~gap
    error = interpolated[kept] - wanted[kept]
    if on_circle(measured.name):
        error = np.degrees(wrapped(np.radians(error)))
    return Residuals(
        measured.name, spec.column_unit, time_ns[kept], wanted[kept], interpolated[kept], error,
        int(outside.sum()), int(gap.sum()), time_ns[~kept], outside[~kept],
    )  # fmt: skip


def statistics(errors: Residuals) -> Errors:
    """The statistics of residuals; see Errors for each formula."""
    e = errors.error
    if not len(e):
        return Errors(errors.unit, 0, *(None,) * 8, outside=errors.outside, gap=errors.gap)
    rmse = math.sqrt(float(np.mean(e * e)))
    worst = int(np.argmax(np.abs(e)))
    spread = _spread(errors.measured)
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
    """Largest less smallest value; what differs by rounding alone is constant: 0."""
    spread = float(np.ptp(values))
    return spread if spread > 1e-12 * float(np.max(np.abs(values))) else 0.0


def _pearson(a: Array, b: Array) -> float | None:
    """Pearson's correlation of two (n,) arrays; None for n < 2 or where one of them is constant."""
    if len(a) < 2 or _spread(a) == 0.0 or _spread(b) == 0.0:
        return None
    a, b = (a - a.mean()) / _spread(a), (b - b.mean()) / _spread(b)
    return float(np.clip(np.sum(a * b) / math.sqrt(float(np.sum(a * a)) * float(np.sum(b * b))), -1.0, 1.0))
