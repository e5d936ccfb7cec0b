"""What is left of one log's channel when another's is taken from it?

The first log's samples set the times. The second is interpolated linearly to them, angles the short way round the
circle; never across a gap in its samples longer than ``max_gap`` and never beyond their ends: such samples are left
out and counted. Values are in the unit of tables, angles in degrees, since they are for people. The error is second
less first (simulated less measured); for angles on the circle it is brought to (-180, 180] deg.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.frames import wrapped
from glidercli.log import Channel
from glidercli.units import NANOSECOND

__all__ = ["Residuals", "on_circle", "residuals", "table_values", "usual_gap"]

Array = NDArray[np.float64]

MANY = 5.0
LEAST_GAP = 60.0  # s


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

    def with_gaps(self) -> tuple[NDArray[np.int64], Array]:
        """Times of all samples in order, compared or skipped, and the errors there; NaN where one was skipped."""
        times = np.concatenate([self.time_ns, self.skipped_ns])
        values = np.concatenate([self.error, np.full(len(self.skipped_ns), np.nan)])
        order = np.argsort(times)
        return times[order], values[order]

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


def usual_gap(channel: Channel) -> float:
    """Time between two samples, s, from which on it is a gap: MANY times the usual one (median), a minute at least."""
    steps = np.diff(channel.time_ns) * NANOSECOND
    return max(MANY * float(np.median(steps)), LEAST_GAP) if len(steps) else LEAST_GAP
