"""A bare hull across the flow: closed forms of a spheroid, no force without a boundary layer, no Munk moment."""

import math

import numpy as np
import pytest

from glidercli.coefficients.added.spheroid import spheroid
from glidercli.coefficients.handbook.body import crossflow_drag, crosswise, separation
from glidercli.coefficients.shape.geometry import HullShape

SPHEROID = HullShape(length=2.0, diameter=0.2)
VOLUME = 4.0 / 3.0 * math.pi * 0.01
DIFFERENCE = spheroid(2.0, 0.2).k2 - spheroid(2.0, 0.2).k1


def test_where_the_flow_leaves_a_spheroid():
    """S = pi b^2 (1 - t^2) falls most steeply at its tail, x1 = 1: x0 = 0.905 of the length."""
    assert separation(SPHEROID) == pytest.approx(1.0 - 2.0 * 0.905, abs=1e-3)  # stations 0.5 mm apart


def test_force_and_moment_of_a_spheroid():
    """2 (k2 - k1) S0 and 2 (k2 - k1) (S0 x0 - integral of S behind x0), in closed form; at no angle no crossflow."""
    found = crosswise(SPHEROID, VOLUME, 0.0, 1e-9)
    x0 = -0.81
    area = math.pi * 0.01 * (1.0 - x0 * x0)
    behind = math.pi * 0.01 * ((x0 + 1.0) - (x0**3 + 1.0) / 3.0)
    second = math.pi * 0.01 * ((x0**2 - 1.0) / 2.0 - (x0**4 - 1.0) / 4.0)
    assert found.normal.value == pytest.approx(2.0 * DIFFERENCE * area, rel=2e-3)  # x0 is known to a step of 0.5 mm
    assert found.moment.value == pytest.approx(2.0 * DIFFERENCE * (area * x0 - behind), rel=2e-3)
    assert found.damping.value == pytest.approx(2.0 * DIFFERENCE * (area * x0 * x0 - second), rel=2e-3)
    assert found.moment.value < 0.0 < found.damping.value


def test_the_moment_left_is_far_from_munks():
    """Munk's own, 2 (k2 - k1) volume, is the model's; the bare hull adds a part of it, of the other sign."""
    found = crosswise(SPHEROID, VOLUME, 0.0, 1e-9)
    munk = 2.0 * DIFFERENCE * VOLUME
    assert -0.5 * munk < found.moment.value < 0.0


def test_crossflow_is_linear_in_the_range():
    """|x| x and |x|^3 by least squares over -A..A, against numpy's own fits of many points."""
    angle = math.radians(12.0)
    ends = crosswise(SPHEROID, VOLUME, 0.0, angle), crosswise(SPHEROID, VOLUME, 0.0, 1e-12)
    alpha = np.linspace(-angle, angle, 20001)
    strength = crossflow_drag(10.0) * math.pi / 4.0 * 2.0 * 0.2  # by the side area of an ellipse
    line = (np.abs(alpha) * alpha @ alpha) / (alpha @ alpha) * strength
    parabola = (np.abs(alpha) ** 3 @ alpha**2) / (alpha**2 @ alpha**2) * strength
    assert ends[0].normal.value - ends[1].normal.value == pytest.approx(line, rel=1e-3)  # sums of 20001 points
    assert ends[0].drag.value - ends[1].drag.value == pytest.approx(parabola, rel=1e-3)
    assert ends[0].moment.value == pytest.approx(ends[1].moment.value, rel=1e-6)  # alike fore and aft


def test_a_hull_turned_round_about_its_middle():
    """The origin's place matters as it must: moments move by the arm times the force."""
    here, there = (crosswise(SPHEROID, VOLUME, at, 0.2) for at in (0.0, 0.1))
    assert there.moment.value == pytest.approx(here.moment.value - 0.1 * here.normal.value, rel=1e-9)
