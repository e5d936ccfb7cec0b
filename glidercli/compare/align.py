"""By how much must a simulated log's clock be shifted to lie on the measured one's?

``none`` leaves UTC as it is, ``start`` puts each log's first depth sample at the same time, ``xcorr`` lays the depth
curves over each other. An offset in seconds comes on top of each. The shift is added to the simulated log's times.
"""

from __future__ import annotations

import dataclasses
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.units import NANOSECOND

__all__ = ["MOST_OFFSET", "Alignment", "Method", "align", "shifted"]

Method = Literal["none", "start", "xcorr"]
"""Ways to align two clocks."""

MOST_OFFSET = 1e9
"""s, some 30 years either way; times in ns leave their 64 bits at ten times as much."""

MOST_STEPS = 2**18
"""Longest record, in common steps, that xcorr works on; the step grows with longer ones."""


@dataclasses.dataclass(frozen=True)
class Alignment:
    """How a simulated log's clock was laid on the measured one's.

    shift : s, added to the simulated log's times; the offset is part of it.
    offset : s, as asked for.
    """

    method: Method
    shift: float
    offset: float


def align(
    measured: Log, simulated: Log, method: Method = "none", offset: float = 0.0, max_gap: float = 60.0
) -> Alignment:
    """The alignment of a simulated log with a measured one.

    offset : s, at most MOST_OFFSET either way, added to the simulated log's times after the method.
    max_gap : s; xcorr leaves out stretches without depth samples longer than this.

    Raises InputError for an unknown method, an offset out of range, or a log without the depth samples needed.
    """
    if method not in get_args(Method):
        raise InputError("align", f"{method!r}; allowed: {', '.join(get_args(Method))}")
    if not abs(offset) <= MOST_OFFSET:
        raise InputError("offset", f"{offset:g} s; allowed: {-MOST_OFFSET:g} to {MOST_OFFSET:g}")
    if method == "none":
        return Alignment(method, offset, offset)
    least = 1 if method == "start" else 3
    for side, log in (("measured", measured), ("simulated", simulated)):
        samples = len(log["depth"]) if "depth" in log else 0
        if samples < least:
            raise InputError(
                f"align {method}",
                f"the {side} log has {samples} depth samples; at least {least} are needed, or align none",
            )
    first, second = measured["depth"], simulated["depth"]
    shift = int(first.time_ns[0] - second.time_ns[0]) / 10**9  # division keeps whole seconds whole
    if method == "xcorr":
        shift += _lag(first, second, max_gap)
    return Alignment(method, shift + offset, offset)


def shifted(log: Log, shift: float) -> Log:
    """The log with ``shift``, s, added to every time, rounded to 1 ns."""
    return log.shifted(round(shift / NANOSECOND))


def _lag(measured: Channel, simulated: Channel, max_gap: float) -> float:
    """Shift in s, beyond equal starts, at which the depth curves lie closest.

    The measure is the mean square difference over the samples that overlap, D(k) = [sum m^2 - 2 sum m s + sum s^2] / n,
    each sum a cross-correlation by FFT. Other than the product m s alone it has one answer on a straight descent too,
    and does not favour long overlaps. Lags that overlap by less than half of the shorter log are left out. A parabola
    through the smallest D(k) and its neighbours gives the peak between steps; D is a parabola for a straight descent.
    """
    step = max(_interval(measured), _interval(simulated))
    longest = max(int(c.time_ns[-1] - c.time_ns[0]) for c in (measured, simulated)) * NANOSECOND
    step = max(step, longest / MOST_STEPS)
    m, have_m = _resampled(measured, step, max_gap)
    s, have_s = _resampled(simulated, step, max_gap)
    middle = float(np.mean(m[have_m > 0])) if have_m.any() else 0.0  # sums about the middle lose fewer digits
    m, s = (m - middle) * have_m, (s - middle) * have_s
    overlap = np.round(_correlation(have_m, have_s))
    square = _correlation(m * m, have_s) - 2.0 * _correlation(m, s) + _correlation(have_m, s * s)
    enough = overlap >= 0.5 * min(have_m.sum(), have_s.sum())
    distance = np.where(enough, square / np.maximum(overlap, 1.0), np.inf)
    best = int(np.argmin(distance))
    between = 0.0
    if 0 < best < len(distance) - 1 and np.isfinite(distance[best - 1 : best + 2]).all():
        before, here, after = distance[best - 1 : best + 2]
        curvature = before - 2.0 * here + after
        between = 0.5 * float(before - after) / float(curvature) if curvature > 0.0 else 0.0
    return (best - (len(s) - 1) + between) * step


def _interval(channel: Channel) -> float:
    """Median time between samples, s."""
    return float(np.median(np.diff(channel.time_ns))) * NANOSECOND


def _resampled(channel: Channel, step: float, max_gap: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Depth every ``step`` s from the first sample, and 1 where it is known, 0 inside a gap."""
    time = (channel.time_ns - channel.time_ns[0]) * NANOSECOND
    grid = np.arange(int(time[-1] / step) + 1) * step
    following = np.clip(np.searchsorted(time, grid), 1, len(time) - 1)
    gap = time[following] - time[following - 1]
    return np.interp(grid, time, channel.values), (gap <= max(max_gap, step)).astype(float)


def _correlation(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sum over i of a[i + k] b[i] for k = -(len(b) - 1) ... len(a) - 1."""
    size = len(a) + len(b) - 1
    padded = 1 << (size - 1).bit_length()
    return np.fft.irfft(np.fft.rfft(a, padded) * np.fft.rfft(b[::-1], padded), padded)[:size]
