"""What a sensor does to a true value: lag, bias, noise and rounding, each against a formula."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from glidercli.simulation.instruments.effects import Chain, Lag, Unwrapped, generator


def every(n: int) -> np.ndarray:
    return np.arange(n)


def test_a_ramp_comes_late_by_the_time_constant() -> None:
    times, tau = np.arange(0.0, 60.0, 0.5), 3.0
    lagged = Lag(tau)(times, 2.0 * times)
    late = times > 14.0 * tau  # e^-14: 1e-6 of the start's error of 6
    np.testing.assert_allclose(lagged[late], 2.0 * (times[late] - tau), rtol=0, atol=1e-5)
    np.testing.assert_allclose(lagged, 2.0 * (times - tau + tau * np.exp(-times / tau)), rtol=0, atol=1e-12)  # rounding


def test_a_step_is_approached_exponentially() -> None:
    tau, rise = 2.0, 1e-9
    times = np.array([0.0, 1.0, 1.0 + rise, *np.arange(1.25, 20.0, 0.25)])
    lagged = Lag(tau)(times, np.where(times <= 1.0, 0.0, 5.0))
    after = times > 1.1
    expected = 5.0 * (1.0 - np.exp(-(times[after] - 1.0) / tau))
    np.testing.assert_allclose(lagged[after], expected, rtol=0, atol=5.0 * rise)  # the step takes 1 ns


def test_any_input_agrees_with_an_integrator() -> None:
    """Linear between samples is what is promised; an independent integrator gets the same input."""
    times = np.arange(0.0, 30.0, 0.7)
    values = np.sin(0.9 * times) + generator(1, "x").standard_normal(len(times))
    found = solve_ivp(
        lambda t, y: (np.interp(t, times, values) - y) / 1.3, (0.0, times[-1]), [values[0]], t_eval=times,
        rtol=1e-10, atol=1e-12, max_step=0.05,
    )  # fmt: skip
    np.testing.assert_allclose(Lag(1.3)(times, values), found.y[0], rtol=0, atol=2e-6)  # corners within a step


def test_a_sensor_goes_on_where_it_left_off() -> None:
    times, values = np.arange(0.0, 100.0, 0.3), np.cumsum(generator(2, "walk").standard_normal(334))
    settings = {"lag": 4.0, "bias": 0.3, "bias_sigma": 1.0, "noise": 0.5, "resolution": 0.125}
    whole = Chain(5, "a", **settings)(times, values, every(334))
    chain = Chain(5, "a", **settings)
    pieces = [chain(times[i:j], values[i:j], every(j - i)) for i, j in ((0, 1), (1, 2), (2, 200), (200, 334))]
    assert np.concatenate(pieces).tobytes() == whole.tobytes()
    angles = np.mod(values, 2.0 * math.pi)
    unwrapped = Unwrapped()
    pieces = [unwrapped(angles[i:j]) for i, j in ((0, 100), (100, 101), (101, 334))]
    assert np.concatenate(pieces).tobytes() == Unwrapped()(angles).tobytes()
    np.testing.assert_allclose(Unwrapped()(angles), np.unwrap(angles), rtol=0, atol=1e-12)  # rounding


def test_the_noise_has_the_deviation_of_its_setting_and_is_white() -> None:
    n, sigma = 100_000, 0.3
    noise = Chain(0, "a", noise=sigma)(np.arange(n * 1.0), np.zeros(n), every(n))
    # five standard errors of mean, deviation and correlation of n normal numbers
    assert abs(noise.mean()) < 5.0 * sigma / math.sqrt(n)
    assert abs(noise.std() - sigma) < 5.0 * sigma / math.sqrt(2.0 * n)
    assert abs(np.corrcoef(noise[1:], noise[:-1])[0, 1]) < 5.0 / math.sqrt(n)


def test_biases_are_drawn_once_with_their_deviation() -> None:
    drawn = np.array([Chain(seed, "a", bias_sigma=2.0).drawn for seed in range(4000)])
    assert abs(drawn.mean()) < 5.0 * 2.0 / math.sqrt(4000)  # five standard errors, as above
    assert abs(drawn.std() - 2.0) < 5.0 * 2.0 / math.sqrt(8000)
    chain = Chain(7, "a", unit=1e4, bias=0.5, bias_sigma=2.0)
    read = chain(np.arange(3.0), np.full(3, 1e6), every(3))
    np.testing.assert_allclose(read, 1e6 + (0.5 + chain.drawn) * 1e4, rtol=1e-15)


def test_noise_depends_on_seed_and_key_alone() -> None:
    def read(seed: int, key: str) -> bytes:
        return Chain(seed, key, noise=1.0)(np.arange(50.0), np.zeros(50), every(50)).tobytes()

    assert read(3, "compass/heading") == read(3, "compass/heading")
    others = [(4, "compass/heading"), (3, "compass/pitch"), (3, "ctd/pressure"), (2**63 - 1, "compass/heading")]
    assert len({read(*each) for each in [(3, "compass/heading"), *others]}) == 5


def test_readings_are_multiples_of_the_resolution() -> None:
    values = np.linspace(-3.0, 3.0, 1001)
    read = Chain(0, "a", resolution=0.02)(np.arange(1001.0), values, every(1001))
    np.testing.assert_allclose(read / 0.02, np.round(read / 0.02), rtol=0, atol=1e-12)  # rounding of the product
    assert np.abs(read - values).max() <= 0.01 + 1e-12
    assert not np.signbit(read[read == 0.0]).any()


def test_a_sensor_without_errors_changes_no_bit() -> None:
    values = generator(0, "v").standard_normal(100)
    assert Chain(0, "a")(np.arange(100.0), values, every(100)).tobytes() == values.tobytes()


@pytest.mark.parametrize("tau", [1e-4, 1e6])
def test_lags_far_from_the_sampling_are_finite(tau: float) -> None:
    times = np.arange(0.0, 100.0)
    lagged = Lag(tau)(times, times)
    expected = times - tau * -np.expm1(-times / tau)
    np.testing.assert_allclose(lagged, expected, rtol=1e-9, atol=1e-9)  # rounding of tau 1e6 beside 1
