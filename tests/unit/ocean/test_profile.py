import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from glidercli.errors import InputError
from glidercli.kernel import compiled, kernel
from glidercli.ocean.profile import Profile, cubic, cubic_slope, in_time, locate, pchip, wide_gaps

ROUND_OFF = 1e-12  # a few operations in double precision on values of order ten


@kernel
def value_and_slope(profile: Profile, z: float, column: int) -> tuple[float, float]:
    interval, x, beyond = locate(profile, 0, z)
    return cubic(profile, interval, x, column), 0.0 if beyond else cubic_slope(profile, interval, x, column)


def value(profile, z, column):
    return value_and_slope(profile, z, column)[0]


def slope(profile, z, column):
    return value_and_slope(profile, z, column)[1]


def test_a_straight_line_is_reproduced_with_its_slope():
    depth = np.array([0.0, 3.0, 4.5, 20.0])
    profile = pchip(depth, np.stack([2.0 + 0.1 * depth, -depth], axis=1))
    for z in (0.5, 3.0, 4.0, 11.1, 19.9):
        assert value(profile, z, 0) == pytest.approx(2.0 + 0.1 * z, abs=ROUND_OFF)
        assert slope(profile, z, 0) == pytest.approx(0.1, abs=ROUND_OFF)
        assert slope(profile, z, 1) == pytest.approx(-1.0, abs=ROUND_OFF)


def test_beyond_the_ends_the_value_is_held_and_the_slope_is_zero():
    profile = pchip([1.0, 2.0, 4.0], [5.0, 6.0, 9.0])
    assert [value(profile, z, 0) for z in (-3.0, 1.0)] == [5.0, 5.0]
    assert [value(profile, z, 0) for z in (4.0, 1e4)] == pytest.approx([9.0, 9.0], abs=ROUND_OFF)
    assert [slope(profile, z, 0) for z in (-3.0, 1.0, 4.0, 1e4)] == [0.0] * 4


def test_a_single_sample_is_constant():
    profile = pchip([7.0], [[3.0, 4.0]])
    assert [value(profile, z, 1) for z in (0.0, 7.0, 50.0)] == [4.0, 4.0, 4.0]
    assert slope(profile, 7.0, 0) == 0.0


def test_an_unknown_column_stays_unknown_and_leaves_the_others_alone():
    profile = pchip([0.0, 1.0, 2.0], [[1.0, math.nan], [2.0, math.nan], [3.0, math.nan]])
    assert math.isnan(value(profile, 0.5, 1))
    assert value(profile, 0.5, 0) == pytest.approx(1.5, abs=ROUND_OFF)


samples = st.lists(
    st.tuples(st.floats(0.1, 50.0), st.integers(-40_000_000, 40_000_000).map(lambda n: n * 1e-6)),
    min_size=2,
    max_size=20,
)  # steps of depth and values; values to a millionth, as instruments give them: slopes of 1e-308 overflow in scipy


@given(samples, st.floats(0.0, 1.0))
def test_it_passes_through_samples_and_never_overshoots(pairs, fraction):
    depth = np.cumsum([step for step, _ in pairs])
    values = np.array([v for _, v in pairs])
    profile = pchip(depth, values)
    tolerance = 1e-9  # cubic terms cancel: coefficients reach 40 / 0.1**3, times 1e-16
    for i in range(len(depth) - 1):
        assert value(profile, depth[i], 0) == pytest.approx(values[i], abs=tolerance)
        between = value(profile, depth[i] + fraction * (depth[i + 1] - depth[i]), 0)
        low, high = sorted(values[i : i + 2])
        assert low - tolerance <= between <= high + tolerance


@given(st.floats(0.5, 19.5))
def test_slope_is_the_derivative_of_value(z):
    depth = np.array([0.0, 2.0, 5.0, 9.0, 20.0])
    profile = pchip(depth, [1.0, 4.0, 5.0, 5.5, 30.0])
    step = 1e-5
    difference = (value(profile, z + step, 0) - value(profile, z - step, 0)) / (2.0 * step)
    assert slope(profile, z, 0) == pytest.approx(difference, abs=1e-3)  # second derivative is below 10, jumps at knots


# the levels of the World Ocean Atlas 2013 and of Levitus (1982)
STANDARD = (*range(0, 100, 5), *range(100, 500, 25), *range(500, 2000, 50), *range(2000, 5501, 100))
CLASSIC = (0, 10, 20, 30, 50, 75, 100, 125, 150, 200, 250, *range(300, 1500, 100), 1500, 1750, *range(2000, 5501, 500))


@pytest.mark.parametrize(
    ("depth", "spans"),
    [
        (STANDARD, ()),
        (CLASSIC, ()),
        ([3.0], ()),
        ([0, 1000], ()),
        (range(0, 1000, 8), ()),
        ([0, 1, 1.2, 1.3, 5, 6], ()),  # under 5 m
        ([*range(0, 100, 10), *range(700, 800, 10)], ("90.0 to 700.0 m",)),
        ([0, 10, 20, 900], ("20.0 to 900.0 m",)),
        ([0, 200, *range(201, 230), 300, *range(301, 330)], ("0.0 to 200.0 m", "229.0 to 300.0 m")),
    ],
)
def test_gaps_far_wider_than_the_steps_around_them_are_named(depth, spans):
    lines = wide_gaps(np.array(depth, dtype=float), "bin")
    expected = f"no bin between {', '.join(spans)}: interpolated over gaps far wider than usual"
    assert lines == ((expected,) if spans else ())


def test_compiled_and_plain_agree():
    profile = pchip([0.0, 2.0, 5.0, 9.0], [[1.0, 0.0], [4.0, 1.0], [5.0, 0.0], [5.5, 2.0]])
    fast = compiled(value_and_slope)
    for z in (-1.0, 0.0, 1.3, 2.0, 8.999, 9.0, 12.0):
        for column in (0, 1):
            assert fast(profile, z, column) == pytest.approx(value_and_slope(profile, z, column), abs=ROUND_OFF)
    alone = pchip([0.0], [[1025.0, 0.0]])
    assert fast(alone, 3.0, 0) == (1025.0, 0.0)


@pytest.mark.parametrize(
    ("depth", "values"),
    [([], []), ([1.0, 1.0], [0.0, 1.0]), ([2.0, 1.0], [0.0, 1.0]), ([0.0, 1.0], [0.0, math.nan]), ([0.0], [1.0, 2.0])],
)
def test_what_is_no_profile_is_refused(depth, values):
    with pytest.raises(InputError, match="profile: "):
        pchip(depth, values)


@pytest.mark.parametrize("n", [2, 3, 4, 60])
def test_the_cubics_are_those_of_scipy(n):
    rng = np.random.default_rng(n)
    for _ in range(20):
        depth = np.cumsum(rng.uniform(0.5, 20.0, n))
        values = np.round(rng.normal(size=(n, 3)), 1)  # equal neighbours, too
        ours = pchip(depth, values).coefficients[:, :-1]
        np.testing.assert_allclose(ours, PchipInterpolator(depth, values).c, atol=1e-12)  # rounding


def test_a_profile_bends_at_its_samples_unless_it_is_constant_around_them():
    profile = pchip([10.0, 20.0, 30.0, 40.0, 50.0], [1.0, 2.0, 4.0, 4.0, 4.0])
    assert profile.bends.tolist() == [-math.inf, 10.0, 20.0, 30.0, math.inf]
    assert pchip([10.0, 20.0], [3.0, 3.0]).bends.tolist() == [-math.inf, math.inf]
    both = in_time([0.0, 60.0], [profile, pchip([0.0, 20.0], [1.0, 2.0])])
    assert both.bends.tolist() == [-math.inf, 0.0, 10.0, 20.0, 30.0, math.inf]
