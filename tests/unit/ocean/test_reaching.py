"""Beyond the end of a profile those that reach there hold; beyond all of them pressure goes on with depth."""

from __future__ import annotations

from pathlib import Path

import gsw
import numpy as np
import pytest

from glidercli.ocean import Cast, CurrentProfile, Ocean
from glidercli.ocean.reaching import completed
from glidercli.ocean.series import Moment


def cast(bottom: float, density: float, at: float, top: float = 0.0) -> Cast:
    """Water whose density grows by 1 kg/m3 in 100 m."""
    depth = np.arange(top, bottom + 1.0, 5.0)
    value = density + 0.01 * depth
    pressure = gsw.p_from_z(-depth, 20.0)
    return Cast(
        depth, pressure, None, None, None, value, 20.0, None, None, Path("c"), (), (), moment=Moment(at, is_utc=False)
    )


def test_a_shallow_dive_says_nothing_of_deep_water() -> None:
    ocean = Ocean.build(1025.0, (cast(500, 1025.0, 0.0), cast(30, 1020.0, 100.0), cast(500, 1027.0, 200.0)))
    for time, share in ((0.0, 0.0), (50.0, 0.25), (100.0, 0.5), (150.0, 0.75), (200.0, 1.0)):
        assert ocean.at(300.0, time).density == pytest.approx(1028.0 + 2.0 * share, abs=1e-9)
    assert ocean.at(10.0, 100.0).density == pytest.approx(1020.1, abs=1e-9)  # its own water is its own
    assert any("1 of 3 casts end above 450 m" in line for line in ocean.warnings)


def test_the_ends_go_on_where_none_is_on_both_sides() -> None:
    first, middle, last = completed(
        [0.0, 1.0, 2.0],
        [(np.array([0.0, 10.0]), np.array([[1.0], [2.0]])), (np.array([0.0, 20.0]), np.array([[1.0], [3.0]])),
         (np.array([5.0, 10.0]), np.array([[7.0], [8.0]]))],
    )  # fmt: skip
    assert first[0].tolist() == [0.0, 10.0, 15.0, 20.0]
    assert first[1][:, 0].tolist() == [1.0, 2.0, 2.5, 3.0]
    assert middle[0].tolist() == [0.0, 20.0]
    assert last[0].tolist() == [0.0, 5.0, 10.0, 15.0, 20.0]
    assert last[1][:, 0].tolist() == [1.0, 7.0, 8.0, 2.5, 3.0]


def test_currents_likewise() -> None:
    def profile(bottom: float, east: float, at: float) -> CurrentProfile:
        depth = np.array([0.0, bottom])
        flow = np.full(2, east)
        return CurrentProfile(depth, flow, 0 * flow, 0 * flow, Path("a"), (), (), moment=Moment(at, is_utc=False))

    ocean = Ocean.build(1025.0, (), (profile(200.0, 0.1, 0.0), profile(20.0, 0.5, 10.0), profile(200.0, 0.3, 20.0)))
    assert ocean.at(100.0, 10.0).current[1] == pytest.approx(0.2, abs=1e-12)


def test_pressure_goes_on_beyond_the_cast() -> None:
    ocean = Ocean.build(1025.0, cast(15, 1025.0, 0.0, top=5.0), latitude=20.0)
    for depth in (0.0, 5.0, 15.0, 70.0, 200.0):
        # TEOS-10 takes the standard ocean, 1028 kg/m3 at the surface and gravity that grows with depth: 0.4 % apart
        expected = gsw.p_from_z(-depth, 20.0) * 1e4
        assert ocean.at(depth).pressure == pytest.approx(expected, rel=5e-3, abs=300.0)


def test_uniform_water_has_no_pressure() -> None:
    assert Ocean.uniform(1025.0).at(500.0).pressure == 0.0
