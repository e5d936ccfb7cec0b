"""Friction lines, form factors and wetted areas against closed forms and printed values."""

import math

import pytest

from glidercli.coefficients.handbook.friction import friction, hull_form, laminar, profile_form, turbulent, wetted_area
from glidercli.coefficients.shape.geometry import HullShape


def test_plates():
    """ITTC's own line at 1e7 is 0.003 exactly, 0.075/25; Blasius at 1e6 is 1.328e-3."""
    assert turbulent(1e7) == pytest.approx(0.003, rel=1e-12)
    assert laminar(1e6) == pytest.approx(1.328e-3, rel=1e-12)


@pytest.mark.parametrize("reynolds", [3e4, 1.9e5, 4.3e5, 2e6, 1.2e7])
def test_the_interval_holds_the_value_and_both_lines(reynolds):
    found = friction(reynolds)
    assert found.lower <= found.value <= found.upper
    assert found.holds(turbulent(reynolds))
    if reynolds <= 3e6:  # beyond, no plate stays laminar
        assert found.holds(laminar(reynolds))


def test_form_factors():
    """Of a plate 1; Hoerner's at a thickness of one tenth, by hand."""
    assert hull_form(0.0, 1.0) == profile_form(0.0) == 1.0
    assert hull_form(0.1, 1.0) == pytest.approx(1.0 + 0.15 / math.sqrt(10.0) + 0.007, rel=1e-12)
    assert profile_form(0.1) == pytest.approx(1.206, rel=1e-12)


def test_wetted_areas():
    """A spheroid by its closed form, 2 pi b^2 + 2 pi a b asin(e)/e; a cylinder with flat ends; a cone."""
    a, b = 0.995, 0.11
    e = math.sqrt(1.0 - (b / a) ** 2)
    exact = 2.0 * math.pi * b * b + 2.0 * math.pi * a * b * math.asin(e) / e
    assert wetted_area(HullShape(length=2 * a, diameter=2 * b)) == pytest.approx(exact, rel=1e-5)  # 48 nodes
    cylinder = HullShape(stations=(1.0, 0.5, 0.0), radii=(0.1, 0.1, 0.1))
    assert wetted_area(cylinder) == pytest.approx(2.0 * math.pi * 0.1 * 1.1, rel=1e-12)
    cone = HullShape(stations=(1.0, 0.5, 0.0), radii=(0.0, 0.05, 0.1))
    assert wetted_area(cone) == pytest.approx(math.pi * 0.1 * (math.hypot(1.0, 0.1) + 0.1), rel=1e-12)
