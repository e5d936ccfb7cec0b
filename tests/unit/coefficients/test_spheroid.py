"""Lamb's closed forms against his integrals, his table, limits, and a sphere."""

import pytest
from scipy.integrate import quad

from glidercli.coefficients.added.spheroid import spheroid


def by_integrals(a, b):
    """k1, k2, k' of an ellipsoid with axes a, b, b from the integrals of Lamb, art. 114 and 115, by quadrature."""

    def of(axis):
        return (
            a
            * b
            * b
            * quad(lambda t: 1.0 / ((axis * axis + t) * (a * a + t) ** 0.5 * (b * b + t)), 0.0, float("inf"))[0]
        )

    alpha, beta = of(a), of(b)
    turn = (a * a - b * b) ** 2 * (beta - alpha) / (2.0 * (a * a - b * b) + (a * a + b * b) * (alpha - beta))
    return alpha / (2.0 - alpha), beta / (2.0 - beta), turn / (a * a + b * b)


@pytest.mark.parametrize("ratio", [1.0001, 1.2, 2.0, 5.0, 9.045, 30.0])
def test_the_integrals_say_the_same(ratio):
    assert spheroid(ratio, 1.0) == pytest.approx(by_integrals(ratio / 2.0, 0.5), rel=1e-6, abs=1e-9)  # of quadrature


# Lamb, Hydrodynamics, 6th ed. (1932), art. 115: a/b, k1 (end-on), k2 (broadside-on), k' (rotation)
@pytest.mark.parametrize(
    ("ratio", "k1", "k2", "k_turn"),
    [
        (2.99, 0.122, 0.803, 0.465),
        (4.99, 0.059, 0.895, 0.701),
        (6.97, 0.036, 0.933, 0.805),
        (9.02, 0.024, 0.954, 0.865),
    ],
)
def test_lambs_table(ratio, k1, k2, k_turn):
    found = spheroid(ratio, 1.0)
    assert found[:2] == pytest.approx((k1, k2), abs=1.1e-3)  # printed digits, and a ratio rounded to 0.005
    assert found.k_turn == pytest.approx(k_turn, abs=2e-3)  # his third digit is off by one or two for rotation


def test_a_sphere_and_a_needle():
    assert spheroid(1.0, 1.0) == pytest.approx((0.5, 0.5, 0.0), abs=1e-12)
    assert spheroid(1e4, 1.0) == pytest.approx((0.0, 1.0, 1.0), abs=1e-6)  # 1 - k2 goes with (D/L)^2 log(L/D)


def test_series_and_closed_form_meet():
    below, above = (spheroid(1.0, (1.0 - e * e) ** 0.5) for e in (0.04999, 0.05001))
    assert above == pytest.approx(below, abs=1e-6)  # the slope there is below e
