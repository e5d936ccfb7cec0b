"""Statistics of errors against closed forms and against numpy."""

import math

import numpy as np
import pytest
from analytic_flights import channel, ns
from hypothesis import given
from hypothesis import strategies as st

from glidercli.compare.errors import statistics
from glidercli.errors import InputError
from glidercli.residuals import residuals

T = np.arange(0.0, 1000.0, 7.0)
ROUNDING = 1e-9  # values below 1e3 through one unit conversion and one interpolation


def test_a_known_offset_is_the_bias() -> None:
    found = statistics(residuals(channel("depth", T, 0.3 * T), channel("depth", T, 0.3 * T + 4.0)))
    assert (found.unit, found.n, found.outside, found.gap) == ("m", len(T), 0, 0)
    assert found.bias == pytest.approx(4.0, abs=ROUNDING)
    assert found.rmse == pytest.approx(4.0, abs=ROUNDING)
    assert found.mae == pytest.approx(4.0, abs=ROUNDING)
    assert found.max == pytest.approx(4.0, abs=ROUNDING)
    assert found.std == pytest.approx(0.0, abs=ROUNDING)
    assert found.correlation == pytest.approx(1.0, abs=ROUNDING)
    assert found.nrmse == pytest.approx(4.0 / (0.3 * 994.0), abs=ROUNDING)


def test_a_sine_against_a_shifted_sine() -> None:
    """Over whole periods: sin(x + d) - sin(x) is a sine again, and the correlation is cos d."""
    t = np.arange(0.0, 1000.0)
    x, d = 2.0 * np.pi * t / 100.0, 0.4
    found = statistics(residuals(channel("pitch", t, 20.0 * np.sin(x)), channel("pitch", t, 20.0 * np.sin(x + d))))
    # the difference is a sine of amplitude 2 sin(d/2), whose rms is amplitude / sqrt(2)
    assert found.rmse == pytest.approx(20.0 * 2.0 * math.sin(d / 2.0) / math.sqrt(2.0), rel=ROUNDING)
    assert found.correlation == pytest.approx(math.cos(d), abs=ROUNDING)
    assert found.bias == pytest.approx(0.0, abs=ROUNDING)
    assert found.unit == "deg"


def test_interpolation_to_the_measured_times_is_linear_and_exact_on_a_line() -> None:
    at = np.arange(0.0, 1001.0, 50.0)
    found = residuals(channel("depth", T, 0.3 * T), channel("depth", at, 0.3 * at))
    assert (found.time_ns == ns(T)).all()
    assert found.error == pytest.approx(0.0, abs=ROUNDING)


def test_against_numpy() -> None:
    rng = np.random.default_rng(3)
    a, b = rng.normal(size=len(T)), rng.normal(size=len(T))
    found = statistics(residuals(channel("temperature", T, a), channel("temperature", T, b)))
    assert found.correlation == pytest.approx(np.corrcoef(a, b)[0, 1], abs=ROUNDING)
    assert found.std == pytest.approx(np.std(b - a), abs=ROUNDING)
    assert found.rmse == pytest.approx(np.linalg.norm(b - a) / np.sqrt(len(a)), abs=ROUNDING)
    assert found.mae == pytest.approx(np.linalg.norm(b - a, 1) / len(a), abs=ROUNDING)
    assert found.max_time_ns == ns(T)[np.argmax(np.abs(b - a))]


@pytest.mark.parametrize("name", ["heading", "longitude"])
def test_angles_are_differenced_the_short_way(name: str) -> None:
    t = np.arange(3.0)
    found = residuals(channel(name, t, np.array([359.0, 1.0, 180.0])), channel(name, t, np.array([1.0, 359.0, 179.0])))
    assert found.error == pytest.approx([2.0, -2.0, -1.0], abs=ROUNDING)


def test_angles_are_interpolated_the_short_way() -> None:
    simulated = channel("heading", np.array([0.0, 10.0]), np.array([350.0, 10.0]))
    found = residuals(channel("heading", np.array([5.0]), np.array([0.0])), simulated)
    assert found.error == pytest.approx([0.0], abs=ROUNDING)  # not 180 - 0


def test_correlation_of_a_heading_that_turns_past_north() -> None:
    turned = 300.0 + 0.5 * T + 20.0 * np.sin(T / 50.0)  # more than one whole turn
    other = 310.0 + 0.4 * T
    found = statistics(residuals(channel("heading", T, turned % 360.0), channel("heading", T, other % 360.0)))
    assert found.correlation == pytest.approx(np.corrcoef(turned, other)[0, 1], abs=ROUNDING)


def test_a_pitch_is_not_on_the_circle() -> None:
    t = np.arange(2.0)
    found = residuals(
        channel("angle_of_attack", t, np.full(2, -170.0)), channel("angle_of_attack", t, np.full(2, 170.0))
    )
    assert found.error == pytest.approx([340.0, 340.0], abs=ROUNDING)


def test_no_value_across_a_gap_or_beyond_the_ends() -> None:
    at = np.array([10.0, 20.0, 100.0, 110.0])
    measured = np.array([5.0, 10.0, 15.0, 20.0, 50.0, 99.9, 100.0, 110.0, 110.1])
    found = residuals(channel("depth", measured, measured), channel("depth", at, at), max_gap=60.0)
    assert (found.time_ns == ns(np.array([10.0, 15.0, 20.0, 100.0, 110.0]))).all()  # samples beside a gap count
    assert (found.outside, found.gap) == (2, 2)
    wider = residuals(channel("depth", measured, measured), channel("depth", at, at), max_gap=80.0)
    assert (wider.outside, wider.gap) == (2, 0)  # a gap of exactly max_gap is crossed


def test_too_few_samples() -> None:
    simulated = channel("depth", T, T)
    none = statistics(residuals(channel("depth", T + 1e5, T), simulated))
    assert (none.n, none.rmse, none.correlation, none.max_time_ns, none.outside) == (0, None, None, None, len(T))
    one = statistics(residuals(channel("depth", T[:1], T[:1] + 2.0), simulated))
    assert (one.n, one.correlation, one.nrmse) == (1, None, None)
    assert one.bias == pytest.approx(-2.0, abs=ROUNDING)


def test_a_constant_has_no_correlation() -> None:
    found = statistics(residuals(channel("depth", T, np.full(len(T), 0.1)), channel("depth", T, T)))
    assert (found.correlation, found.nrmse) == (None, None)


@pytest.mark.parametrize("wrong", [0.0, -5.0, float("nan")])
def test_max_gap_must_be_positive(wrong: float) -> None:
    with pytest.raises(InputError, match="allowed: a positive time"):
        residuals(channel("depth", T, T), channel("depth", T, T), wrong)


@given(st.integers(-(10**15), 10**15), st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=30))
def test_a_common_shift_of_both_clocks_changes_nothing(shift: int, values: list[float]) -> None:
    t = np.arange(len(values)) * 10.0
    measured, simulated = channel("depth", t[:-1] + 3.0, np.array(values[1:])), channel("depth", t, np.array(values))
    here = residuals(measured, simulated)
    there = residuals(*(type(c)(c.name, c.time_ns + shift, c.values) for c in (measured, simulated)))
    assert np.array_equal(here.error, there.error)  # integer times: exactly


@given(st.lists(st.tuples(st.floats(-720.0, 720.0), st.floats(-720.0, 720.0)), min_size=1, max_size=20))
def test_errors_on_the_circle(pairs: list[tuple[float, float]]) -> None:
    t = np.arange(float(len(pairs)))
    a, b = np.array(pairs).T
    e = residuals(channel("roll", t, a), channel("roll", t, b)).error
    assert (np.abs(e) <= 180.0 + ROUNDING).all()
    # e and b - a are the same direction
    assert np.cos(np.radians(e - (b - a))) == pytest.approx(1.0, abs=ROUNDING)


@given(st.lists(st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)), min_size=2, max_size=20))
def test_rmse_is_bias_and_std_together(pairs: list[tuple[float, float]]) -> None:
    t = np.arange(float(len(pairs)))
    a, b = np.array(pairs).T
    s = statistics(residuals(channel("depth", t, a), channel("depth", t, b)))
    assert s.rmse is not None
    assert s.bias is not None
    assert s.std is not None
    assert s.mae is not None
    assert s.max is not None
    assert s.rmse**2 == pytest.approx(s.bias**2 + s.std**2, rel=1e-9, abs=1e-9)  # rounding of values up to 1e6
    assert abs(s.bias) <= s.mae + ROUNDING
    assert s.mae <= s.rmse + ROUNDING
    assert s.rmse <= s.max + ROUNDING
