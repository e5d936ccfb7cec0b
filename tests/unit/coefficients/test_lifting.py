"""Lift slopes at their limits, and what a hull makes of a surface."""

import math

import pytest

from glidercli.coefficients.handbook.lifting import SECTION, lift_slope, lifting, one_sided
from glidercli.coefficients.shape.geometry import HullShape, Surface

SLENDER = HullShape(stations=(2.0, 0.0, -2.0), radii=(1e-4, 1e-4, 1e-4))  # a needle: no hull at all
HULL = HullShape(stations=(1.0, 0.9, -0.9, -1.0), radii=(0.0, 0.1, 0.1, 0.0))


def wing(**changes):
    given = {
        "plane": "horizontal", "semi_span": 0.6, "root_chord": 0.15, "tip_chord": 0.15, "root_position": 0.0,
        "tip_position": 0.0,
    } | changes  # fmt: skip
    return Surface(**given)


def test_limits_of_the_slope():
    """2 pi without ends; pi A / 2 of a very short wing (Jones 1946), whatever its sweep; the next term is A^2/16."""
    assert lift_slope(1e6) == pytest.approx(2.0 * math.pi, rel=1e-5)
    assert lift_slope(1e6, section_share=0.9) == pytest.approx(0.9 * 2.0 * math.pi, rel=1e-5)
    for sweep in (0.0, 1.0):
        assert lift_slope(1e-3, sweep) == pytest.approx(math.pi * 1e-3 / 2.0, rel=1e-6)
    assert lift_slope(1e6, math.tan(math.radians(60.0))) == pytest.approx(math.pi, rel=1e-5)  # cosine of sweep


def test_helmbold_against_lifting_line():
    """Prandtl's 2 pi A / (A + 2) of an elliptic wing is what Helmbold's tends to: 4 % apart at A = 8, 2 % at 16."""
    for aspect, apart in ((8.0, 0.04), (16.0, 0.02)):
        assert lift_slope(aspect) == pytest.approx(2.0 * math.pi * aspect / (aspect + 2.0), rel=apart)


def test_a_wing_without_hull_is_a_wing():
    """By hand: A = 1.2/0.15 = 8, area 0.18 m2; the hull is 0.1 mm thick at most, 2e-4 of the panel."""
    found = lifting(wing(), SLENDER)
    assert found.aspect == pytest.approx(8.0, rel=5e-4)
    assert found.lift.value == pytest.approx(0.18 * lift_slope(8.0, 0.0, SECTION[0]), rel=5e-4)
    assert found.centre == pytest.approx(-0.15 / 4.0, rel=1e-9)
    assert found.middle == pytest.approx(-0.15 / 2.0, rel=1e-9)
    assert found.height == pytest.approx(0.3, rel=5e-4)
    slope = lift_slope(4.0, 0.0, SECTION[0])
    assert found.rolling.value == pytest.approx(slope * 0.15 * 2.0 * 0.6**3 / 3.0, rel=5e-4)


def test_a_hull_adds_by_tr_1307():
    """(1 + r/s)^2 on the exposed panels."""
    found = lifting(wing(), HULL)
    panels = 2.0 * 0.5 * 0.15
    exposed = panels * lift_slope(2.0 * 0.5 / 0.15, 0.0, SECTION[0])
    assert found.lift.value == pytest.approx(exposed * (1.0 + 0.1 / 0.6) ** 2, rel=1e-6)


def test_one_side():
    """Half an image without hull; a whole one where the fin is low on a large hull; between them in order."""
    assert one_sided(0.0, 0.2) == 0.5
    assert one_sided(1.0, 1.01) == pytest.approx(1.0, abs=0.02)
    shares = [one_sided(radius, 0.2) for radius in (0.0, 0.02, 0.05, 0.1, 0.15, 0.19)]
    assert shares == sorted(shares)


def test_a_fin_on_one_side_has_half_of_the_panels_and_less_slope():
    both = lifting(wing(plane="vertical", semi_span=0.25), HULL)
    one = lifting(wing(plane="vertical", semi_span=0.25, sides="upper"), HULL)
    assert one.area == pytest.approx(both.area / 2.0, rel=1e-12)
    assert 0.35 * both.lift.value < one.lift.value < 0.5 * both.lift.value  # between no image at all and a whole one


def test_a_fin_on_a_mast_has_nothing_of_the_hull():
    """Off the hull by more than its radius: the lone panel, with no image and no factor."""
    found = lifting(wing(plane="vertical", sides="upper", semi_span=0.5, root_offset=0.3), HULL)
    assert found.lift.value == pytest.approx(0.2 * 0.15 * lift_slope(0.2 / 0.15, 0.0, SECTION[0]), rel=1e-9)
