"""What is the value at a depth and a time, and its slope? Piecewise cubic profiles, plain Python or compiled.

Between samples a profile is the monotone cubic of Fritsch and Carlson (1980, SIAM J. Numer. Anal. 17, 238-246): it
passes through every sample, has a continuous slope and never overshoots. Beyond its first and last sample it is held
constant. Several profiles, each of a time, are linear in time between them and held before the first and after the
last.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from glidercli.errors import InputError
from glidercli.kernel import kernel
from glidercli.ocean.source import listed

__all__ = [
    "Profile", "cubic", "cubic_slope", "in_time", "interval", "locate", "moment", "next_moment", "pchip", "wide_gaps",
]  # fmt: skip


_GAP_RATIO, _GAP_LEAST = 5.0, 5.0  # standard depths grow by less from step to step; m, below it little can hide
_GAP_REACH = 5  # intervals to either side that tell what is usual


class Profile(NamedTuple):
    """Quantities by depth, one column each; the profiles of several times stand one after the other."""

    depth: NDArray[np.float64]
    """(n,), m, positive down, strictly increasing within each profile."""
    coefficients: NDArray[np.float64]
    """(4, n, k), highest power first, in the local coordinate z - depth[i]; the last row of each profile is its end."""
    times: NDArray[np.float64]
    """(m,), s, strictly increasing."""
    first: NDArray[np.int64]
    """(m + 1,), where each profile begins in depth, and n."""
    bends: NDArray[np.float64]
    """(b + 2,), m, increasing: depths of samples at which any of the profiles goes from one cubic to another, between
    minus infinity and infinity."""


def pchip(depth: ArrayLike, values: ArrayLike) -> Profile:
    """The monotone cubic profile through samples; a single sample gives a constant profile.

    Parameters
    ----------
    depth : (n,), m, positive down, finite and strictly increasing.
    values : (n,) or (n, k), one column for each quantity. A column that is NaN throughout is unknown and stays so.

    Raises
    ------
    InputError
        There is no sample, shapes differ, depths do not increase, or a value is missing in a column that has others.
    """
    z = np.ascontiguousarray(depth, dtype=np.float64)
    y = np.asarray(values, dtype=np.float64)
    if y.ndim == 1:
        y = y[:, np.newaxis]
    if z.ndim != 1 or y.ndim != 2 or len(z) == 0 or len(z) != len(y):
        raise InputError(
            "profile", f"{z.shape} depths for {y.shape} values; one row of values for each depth is needed"
        )
    known = ~np.isnan(y).all(axis=0)
    if not (np.isfinite(z).all() and np.isfinite(y[:, known]).all()):
        raise InputError("profile", "holds a depth or value that is not finite; samples that lack one must be left out")
    if (np.diff(z) <= 0.0).any():
        raise InputError("profile", "has depths that do not increase; each must be greater than the one before")
    coefficients = np.zeros((4, len(z), y.shape[1]))
    coefficients[:, :, ~known] = np.nan
    coefficients[3, -1] = y[-1]
    if len(z) > 1:
        coefficients[:, :-1, known] = _cubics(z, y[:, known])
    varies = (coefficients[:3] != 0.0).any(axis=(0, 2))  # the last row is of no interval
    bends = z[varies | np.concatenate([[False], varies[:-1]])]
    bends = np.concatenate([[-np.inf], bends, [np.inf]])
    return Profile(z, coefficients, np.zeros(1), np.array([0, len(z)]), bends)


def _cubics(z: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Coefficients (4, n - 1, k) of the monotone cubics through samples y (n, k) at z (n,).

    Slopes by Fritsch and Butland (1984, SIAM J. Sci. Stat. Comput. 5, 300-304): the weighted harmonic mean of the two
    secants where they agree in sign, else zero; at the ends by three points, kept monotone (Moler 2004, Numerical
    Computing with MATLAB, section 3.6).
    """
    h = np.diff(z)[:, np.newaxis]
    secant = np.diff(y, axis=0) / h
    slope = np.zeros_like(y)
    if len(z) == 2:
        slope[:] = secant
    else:
        before, after = secant[:-1], secant[1:]
        w1, w2 = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
        agree = before * after > 0.0
        a, b = np.where(agree, before, 1.0), np.where(agree, after, 1.0)
        slope[1:-1] = np.where(agree, (w1 + w2) / (w1 / a + w2 / b), 0.0)
        slope[0] = _end_slope(h[0], h[1], secant[0], secant[1])
        slope[-1] = _end_slope(h[-1], h[-2], secant[-1], secant[-2])
    bend = (slope[:-1] + slope[1:] - 2.0 * secant) / h
    return np.stack([bend / h, (secant - slope[:-1]) / h - bend, slope[:-1], y[:-1]])


def _end_slope(h0: Any, h1: Any, first: Any, second: Any) -> Any:
    """Slope at an end from three points, (k,): h0, first the interval and secant there, h1, second the next."""
    slope = ((2.0 * h0 + h1) * first - h0 * second) / (h0 + h1)
    slope = np.where(slope * first <= 0.0, 0.0, slope)
    return np.where((first * second <= 0.0) & (np.abs(slope) > 3.0 * np.abs(first)), 3.0 * first, slope)


def in_time(times: ArrayLike, profiles: Sequence[Profile]) -> Profile:
    """Profiles of the same columns, each of a time, s, strictly increasing, as one."""
    lengths = [len(profile.depth) for profile in profiles]
    return Profile(
        np.concatenate([profile.depth for profile in profiles]),
        np.concatenate([profile.coefficients for profile in profiles], axis=1),
        np.ascontiguousarray(times, dtype=np.float64),
        np.concatenate([[0], np.cumsum(lengths)]).astype(np.int64),
        np.unique(np.concatenate([profile.bends for profile in profiles])),
    )


def wide_gaps(depth: NDArray[np.float64], what: str) -> tuple[str, ...]:
    """One line that names the gaps far wider than the intervals around them; none if there are none.

    depth : (n,), m, increasing. what : "bin", "sample".
    """
    if len(depth) < 2:
        return ()
    steps = np.diff(depth)
    padded = np.pad(steps, _GAP_REACH, constant_values=np.nan)
    around = np.sort(np.lib.stride_tricks.sliding_window_view(padded, 2 * _GAP_REACH + 1), axis=1)  # NaN come last
    middle = (np.isfinite(around).sum(axis=1) - 1) // 2
    usual = np.take_along_axis(around, middle[:, np.newaxis], axis=1)[:, 0]
    wide = np.flatnonzero((steps > _GAP_RATIO * usual) & (steps > _GAP_LEAST))
    spans = tuple(f"{depth[i]:.1f} to {depth[i + 1]:.1f} m" for i in wide)
    return (f"no {what} between {listed(spans, 5)}: interpolated over gaps far wider than usual",) if spans else ()


@kernel
def interval(knots: NDArray[np.float64], x: float) -> int:
    """Index of the last knot that is not beyond x, by bisection; -1 where every knot is. Knots increase."""
    return interval_between(knots, x, -1, len(knots))


@kernel
def interval_between(knots: NDArray[np.float64], x: float, low: int, high: int) -> int:
    """The same where it is known to lie from ``low`` on and before ``high``."""
    while high - low > 1:
        middle = (low + high) // 2
        if knots[middle] <= x:
            low = middle
        else:
            high = middle
    return low


@kernel
def moment(profile: Profile, t: float) -> tuple[int, float]:
    """Number of the profile that holds at time t, s, and the share of the one after it; 0 where there is none."""
    times = profile.times
    last = times.shape[0] - 1
    if last == 0 or t <= times[0]:
        return 0, 0.0
    if t >= times[last]:
        return last, 0.0
    low = interval(times, t)
    return low, (t - times[low]) / (times[low + 1] - times[low])


@kernel
def next_moment(profile: Profile, t: float) -> float:
    """The next time, s, at which the change in time changes; infinite after the last."""
    low = interval(profile.times, t)
    return profile.times[low + 1] if low + 1 < len(profile.times) else np.inf


@kernel
def locate(profile: Profile, number: int, z: float) -> tuple[int, float, bool]:
    """The interval of a profile that holds depth z, m, the coordinate z - depth[i] in it, and whether z is beyond the
    ends, where the value is that of the end.

    number : of the profile, 0 where there is one only.
    """
    depth = profile.depth
    top, bottom = profile.first[number], profile.first[number + 1] - 1
    if z >= depth[bottom]:
        return bottom, 0.0, True
    if z <= depth[top]:
        return top, 0.0, True
    low = interval_between(depth, z, top, bottom)
    return low, z - depth[low], False


@kernel
def cubic(profile: Profile, interval: int, x: float, column: int) -> float:
    """Value of one column at the coordinate x in an interval, both from ``locate``."""
    c = profile.coefficients
    a3, a2, a1, a0 = c[0, interval, column], c[1, interval, column], c[2, interval, column], c[3, interval, column]
    return float(((a3 * x + a2) * x + a1) * x + a0)


@kernel
def cubic_slope(profile: Profile, interval: int, x: float, column: int) -> float:
    """Derivative of ``cubic`` by x, per m."""
    c = profile.coefficients
    a3, a2, a1 = c[0, interval, column], c[1, interval, column], c[2, interval, column]
    return float((3.0 * a3 * x + 2.0 * a2) * x + a1)
