"""By how much must a simulated log's clock be shifted to lie on the measured one's?

``none`` leaves UTC as it is. Three events can be put at the same time: ``start``, each log's first depth sample;
``gps``, its first position; ``dive``, the begin of its first dive. ``xcorr`` lays the depth curves over each other. An
offset in seconds comes on top of each. The shift is added to the simulated log's times.

How certain a shift is: an event may lie anywhere between its sample and the next ones, in both logs; the shift of xcorr
has the standard error of a least-squares fit.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from glidercli.compare.first import First
from glidercli.dives import LEAST_RANGE, phases
from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.units import NANOSECOND

__all__ = ["MOST_OFFSET", "Alignment", "Method", "align", "shifted"]

Array = NDArray[np.float64]

Method = Literal["none", "start", "gps", "dive", "xcorr"]
"""Ways to align two clocks."""

MOST_OFFSET = 1e9
"""s, some 30 years either way; times in ns leave their 64 bits at ten times as much."""

MOST_STEPS = 2**18
"""Longest record, in common steps, that xcorr works on; the step grows with longer ones."""


EQUAL, NEXT_TO_NOTHING = 1.01, 0.002
"""Shifts at which the depths lie as close, so that the one with more samples counts: a hundredth further, and 0.2 % of
the depths' scatter, for curves that meet to rounding."""
AS_CLOSE, SMALL = 1.5, 0.02
"""A shift that is told beside the best: half again as far, and 2 % of the scatter."""


@dataclasses.dataclass(frozen=True)
class Alignment:
    """How a simulated log's clock was laid on the measured one's.

    shift : s, added to the simulated log's times; the offset is part of it.
    offset : s, as asked for.
    certainty : s, either way; of xcorr one standard error; None where nothing was estimated, or nothing tells.
    other : s, another shift at which the depths lie about as close (xcorr), offset included; None without one.
    """

    method: Method
    shift: float
    offset: float
    certainty: float | None = None
    other: float | None = None

    @property
    def note(self) -> str:
        """What the certainty is, in words; "" where nothing was estimated."""
        if self.method == "none":
            return ""
        other = "" if self.other is None else f"; the depths are about as close at a shift of {self.other:.0f} s"
        if self.certainty is None:
            why = "the last one tried" if self.method == "xcorr" else "of a log with a single sample"
            return f"its certainty is not known, for it is {why}{other}"
        told = {
            "start": "half the times between the first two depth samples of both",
            "gps": "half the times between the first two positions of both",
            "dive": "half the times between the depth samples where the dives begin, of both",
            "xcorr": "one standard error, residuals correlated in time counted as fewer",
        }[self.method]
        found = f"certain to {self.certainty:.2g} s, {told}{other}"
        if self.method == "xcorr" and abs(self.shift - self.offset) <= self.certainty:
            return f"{found}; that is no less than the shift, so that nothing asks for one"
        return found


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
    word = First(measured.origin).word
    if method == "xcorr":
        return _closest(_curve(measured, word), _curve(simulated, "simulated"), offset, max_gap)
    first, second = _event(measured, word, method), _event(simulated, "simulated", method)
    shift = (first.time_ns - second.time_ns) / 10**9  # division keeps whole seconds whole
    apart = None if first.apart is None or second.apart is None else first.apart + second.apart
    return Alignment(method, shift + offset, offset, None if apart is None else 0.5 * apart)


def shifted(log: Log, shift: float) -> Log:
    """The log with ``shift``, s, added to every time, rounded to 1 ns."""
    return log.shifted(round(shift / NANOSECOND))


class _Event(NamedTuple):
    """When something was first seen, UTC ns, and the time between samples there, s; None of a single sample."""

    time_ns: int
    apart: float | None


def _depth(log: Log, side: str, method: Method, least: int) -> Channel:
    """The depth of a log. Raises InputError where it has fewer samples."""
    samples = len(log["depth"]) if "depth" in log else 0
    if samples < least:
        raise InputError(
            f"align {method}", f"the {side} log has {samples} depth samples; at least {least} are needed, or align none"
        )
    return log["depth"]


def _curve(log: Log, side: str) -> Channel:
    """The depth of a log for xcorr. Raises InputError where it is too short, or does not move."""
    depth = _depth(log, side, "xcorr", 3)
    if np.ptp(depth.values) < LEAST_RANGE:
        raise InputError(
            "align xcorr",
            f"the {side} depth changes by less than {LEAST_RANGE:g} m, which tells no time; "
            "allowed: none, start, gps, dive",
        )
    return depth


def _event(log: Log, side: str, method: Method) -> _Event:
    """The event of a log that a method goes by. Raises InputError where the log has none."""
    if method == "gps":
        times = log.together("latitude", "longitude")[0]
        if not len(times):
            raise InputError("align gps", f"the {side} log has no position; allowed: none, start, dive, xcorr")
        return _seen(times, int(times[0]))
    times = _depth(log, side, method, 1).time_ns
    if method == "start":
        return _seen(times, int(times[0]))
    begun = next((leg.start_ns for leg in phases(log) if leg.name == "dive"), None)
    if begun is None:
        raise InputError("align dive", f"the {side} log has no dive; allowed: none, start, gps, xcorr")
    return _seen(times, begun)


def _seen(times: NDArray[np.int64], at: int) -> _Event:
    """An event at a time, with the time between the samples about it."""
    if len(times) == 1:
        return _Event(at, None)
    after = int(np.clip(np.searchsorted(times, at, side="right"), 1, len(times) - 1))
    return _Event(at, float(times[after] - times[after - 1]) * NANOSECOND)


def _closest(measured: Channel, simulated: Channel, offset: float, max_gap: float) -> Alignment:
    """The alignment at which the depth curves lie closest, by the shift beyond equal starts.

    The measure is the mean square difference over the samples that overlap, D(k) = [sum m^2 - 2 sum m s + sum s^2] / n,
    each sum a cross-correlation by FFT. Other than the product m s alone it has one answer on a straight descent too,
    and does not favour long overlaps. Lags that overlap by less than half of the shorter log are left out. A parabola
    through the smallest D(k) and its neighbours gives the peak between steps; D is a parabola for a straight descent.
    As of any least-squares estimate the variance of the shift is 2 D / (n D''), with D'' the curvature of that parabola
    and n the number of residuals that are independent: n (1 - r) / (1 + r), where neighbours are correlated by r.
    """
    equal_starts = int(measured.time_ns[0] - simulated.time_ns[0]) / 10**9
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
    zero = equal_starts - (len(s) - 1) * step + offset
    lows = _lows(distance)
    scatter = float(m.std())
    rms = np.sqrt(lows.distance)
    fits = np.flatnonzero(rms <= EQUAL * rms.min() + NEXT_TO_NOTHING * scatter)
    best = int(fits[np.argmax(overlap[lows.place[fits]])])
    curvature, certainty = float(lows.curvature[best]), None
    if curvature > 0.0:
        count = _independent(m, s, have_m, have_s, int(lows.place[best]))
        certainty = step * math.sqrt(2.0 * float(lows.distance[best]) / (count * curvature))
    others = np.delete(np.arange(len(rms)), best)
    near = others[rms[others] <= AS_CLOSE * rms[best] + SMALL * scatter]
    rival = None if not len(near) else zero + float(lows.lag[near[np.argmin(rms[near])]]) * step
    return Alignment("xcorr", zero + float(lows.lag[best]) * step, offset, certainty, rival)


class _Lows(NamedTuple):
    """Where the curves lie closest, (k,): the step, the shift between steps, the distance there, m2, its curvature."""

    place: NDArray[np.int64]
    lag: Array
    distance: Array
    curvature: Array


def _lows(distance: Array) -> _Lows:
    """The least distances, each at the vertex of the parabola through it and its neighbours.

    Unlike the least on the steps alone, these can be compared: how far a step misses the vertex is chance. An end of
    the shifts that were tried is one where it is lower than its neighbour; it has no vertex, and curvature 0.
    """
    beside = np.concatenate([[np.inf], distance, [np.inf]])
    place = np.flatnonzero((distance <= beside[:-2]) & (distance <= beside[2:]) & np.isfinite(distance))
    before, here, after = beside[place], distance[place], beside[place + 2]
    inside = np.isfinite(before) & np.isfinite(after)
    before, after = np.where(inside, before, here), np.where(inside, after, here)
    curvature = before - 2.0 * here + after
    slope, bent = before - after, np.where(curvature > 0.0, curvature, 1.0)
    between = np.where(curvature > 0.0, 0.5 * slope / bent, 0.0)
    vertex = np.where(curvature > 0.0, here - 0.125 * slope**2 / bent, here)
    return _Lows(
        place.astype(np.int64), place.astype(np.float64) + between, np.maximum(vertex, 0.0), np.maximum(curvature, 0.0)
    )


def _independent(m: Array, s: Array, have_m: Array, have_s: Array, lag: int) -> float:
    """Number of independent residuals of the curves at a lag, at least 1."""
    ahead = lag - (len(s) - 1)
    a, b = max(ahead, 0), max(-ahead, 0)
    n = min(len(m) - a, len(s) - b)
    known = (have_m[a : a + n] > 0) & (have_s[b : b + n] > 0)
    e = (m[a : a + n] - s[b : b + n])[known]
    e = e - e.mean()
    power = float(np.sum(e * e))
    r = float(np.sum(e[1:] * e[:-1])) / power if power > 0.0 else 0.0
    return max(len(e) * (1.0 - r) / (1.0 + r), 1.0)


def _interval(channel: Channel) -> float:
    """Median time between samples, s."""
    return float(np.median(np.diff(channel.time_ns))) * NANOSECOND


def _resampled(channel: Channel, step: float, max_gap: float) -> tuple[Array, Array]:
    """Depth every ``step`` s from the first sample, and 1 where it is known, 0 inside a gap."""
    time = (channel.time_ns - channel.time_ns[0]) * NANOSECOND
    grid = np.arange(int(time[-1] / step) + 1) * step
    following = np.clip(np.searchsorted(time, grid), 1, len(time) - 1)
    gap = time[following] - time[following - 1]
    return np.interp(grid, time, channel.values), (gap <= max(max_gap, step)).astype(float)


def _correlation(a: Array, b: Array) -> Array:
    """Sum over i of a[i + k] b[i] for k = -(len(b) - 1) ... len(a) - 1."""
    size = len(a) + len(b) - 1
    padded = 1 << (size - 1).bit_length()
    return np.fft.irfft(np.fft.rfft(a, padded) * np.fft.rfft(b[::-1], padded), padded)[:size]
