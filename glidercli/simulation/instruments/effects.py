"""What becomes of a true value on its way through a sensor? Lag, then bias, noise and rounding, in this order."""

from __future__ import annotations

import math
import zlib

import numpy as np
from numpy.typing import NDArray

from glidercli.kernel import compiled, kernel

__all__ = ["Chain", "Lag", "Unwrapped", "generator"]

Array = NDArray[np.float64]


def generator(seed: int, key: str) -> np.random.Generator:
    """The random numbers of one seed and one key, such as "compass/heading/noise": no other key changes them."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(zlib.crc32(key.encode()),)))


class Lag:
    """A first-order lag tau dy/dt = x - y, in equilibrium at the first sample; goes on from call to call.

    time : tau, s; 0 for none. The input is taken as linear between its samples, for which the solution is exact:
    y(t + h) = y(t) + a (x(t) - y(t)) + (1 - a tau / h) (x(t + h) - x(t)), a = 1 - exp(-h / tau).
    """

    def __init__(self, time: float) -> None:
        self._time = time
        self._state: Array | None = None

    def __call__(self, times: Array, values: Array) -> Array:
        """The lagged values (n,) at increasing times (n,), s, that go on where the last ones ended."""
        if self._time == 0.0 or not len(times):
            return values
        if self._state is None:
            self._state = np.array([times[0], values[0], values[0]])
        lagged = np.empty(len(times))
        compiled(follow)(np.ascontiguousarray(times), np.ascontiguousarray(values), self._time, self._state, lagged)
        return lagged


@kernel
def follow(times: Array, values: Array, tau: float, state: Array, out: Array) -> None:
    """The recursion of ``Lag``. state : time, input and output at the last sample, (3,), carried on."""
    for i in range(len(times)):
        h = times[i] - state[0]
        if h > 0.0:
            a = -math.expm1(-h / tau)
            state[2] += a * (state[1] - state[2]) + (1.0 - a * tau / h) * (values[i] - state[1])
        state[0], state[1] = times[i], values[i]
        out[i] = state[2]


class Unwrapped:
    """Angles without the jumps of a full circle, rad; goes on from call to call. Turns are counted whole."""

    def __init__(self) -> None:
        self._last: float | None = None
        self._turns = 0.0

    def __call__(self, angles: Array) -> Array:
        """The angles (n,), rad, that go on where the last ones ended."""
        if not len(angles):
            return angles
        before = angles[0] if self._last is None else self._last
        jumps = np.diff(angles, prepend=before)
        turns = self._turns - np.cumsum(np.round(jumps / (2.0 * np.pi)))
        self._last, self._turns = float(angles[-1]), float(turns[-1])
        return angles + 2.0 * np.pi * turns


class Chain:
    """The way of one quantity through a sensor.

    lag : s. bias, bias_sigma, noise, resolution : in the unit of the sensor's keys, of which ``unit`` is the SI value.
    bias_sigma : standard deviation of a bias that is drawn once. noise : standard deviation, white. resolution : 0 for
    none. seed, key : of the random numbers.
    """

    def __init__(
        self, seed: int, key: str, *, unit: float = 1.0, lag: float = 0.0, bias: float = 0.0, bias_sigma: float = 0.0,
        noise: float = 0.0, resolution: float = 0.0,
    ) -> None:  # fmt: skip
        self.drawn = bias_sigma * float(generator(seed, f"{key}/bias").standard_normal())
        """The bias that was drawn, in the unit of the keys."""
        self._bias, self._noise, self._resolution = (bias + self.drawn) * unit, noise * unit, resolution * unit
        self._random = generator(seed, f"{key}/noise")
        self._lag = Lag(lag)

    def __call__(self, times: Array, truth: Array, taken: NDArray[np.intp]) -> Array:
        """Readings (k,), SI, at those of the times (n,), s, that are taken (k,); truth : (n,), SI."""
        return self.reading(self._lag(times, truth)[taken])

    def reading(self, values: Array) -> Array:
        """Readings of lagged values (k,), SI, at times that the sensor samples."""
        values = values + self._bias + self._noise * self._random.standard_normal(len(values))
        if self._resolution:
            values = np.round(values / self._resolution) * self._resolution + 0.0  # no -0.0
        return values
