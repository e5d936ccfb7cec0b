"""Where a track lies on the globe, against Vincenty's geodesics of pymap3d."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymap3d.lox import loxodrome_direct
from pymap3d.vincenty import vdist

from glidercli.places import geodetic_of_track, track_of_geodetic


@pytest.mark.parametrize("latitude", [-60.0, 0.0, 20.0, 71.0])
def test_north_is_a_way_along_the_meridian(latitude: float) -> None:
    found, longitude = geodetic_of_track([100e3], [0.0], latitude, 118.0)
    way, bearing = vdist(latitude, 118.0, found[0], longitude[0])
    assert way == pytest.approx(100e3, abs=0.1)  # the radius of the middle is the mean to (0.9 deg)^2 e^2 / 24
    assert bearing == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("latitude", [-60.0, 0.0, 20.0, 71.0])
def test_east_is_a_way_along_the_parallel(latitude: float) -> None:
    found, longitude = geodetic_of_track([0.0], [4000.0], latitude, 118.0)
    way, _ = vdist(latitude, 118.0, found[0], longitude[0])
    assert found[0] == latitude
    assert way == pytest.approx(4000.0, abs=1e-3)  # the geodesic cuts the arc by (4 km tan(lat) / R)^2 / 24 of it


def test_a_month_to_the_east_is_a_rhumb_line() -> None:
    north, east = 78.3e3, 1370.6e3
    latitude, longitude = geodetic_of_track([north], [east], 20.0, 118.0)
    way, bearing = math.hypot(north, east), math.degrees(math.atan2(east, north))
    exact = loxodrome_direct(20.0, 118.0, way, bearing)
    assert latitude[0] == pytest.approx(exact[0], abs=1e-6)
    assert longitude[0] == pytest.approx(exact[1], abs=2e-4)  # 20 m: the parallel of the middle for those on the way


@given(
    st.floats(-300e3, 300e3), st.floats(-2000e3, 2000e3), st.floats(-70.0, 70.0), st.floats(-180.0, 180.0)
)  # fmt: skip
def test_there_and_back(north: float, east: float, latitude: float, longitude: float) -> None:
    there = geodetic_of_track([north], [east], latitude, longitude)
    back = track_of_geodetic(*there, latitude, longitude)
    # the middle latitude is found once: its own error of (3 deg)^2 e^2 / 8 is 2e-6 of a way of 300 km, and the parallel's
    np.testing.assert_allclose(back, [[north], [east]], atol=2.0)
    assert -180.0 <= there[1][0] <= 180.0
