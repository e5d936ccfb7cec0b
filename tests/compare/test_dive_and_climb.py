"""Dives and climbs are found where an analytic profile has them."""

import numpy as np
import pytest
from analytic_flights import channel, log, ns, vee
from hypothesis import given
from hypothesis import strategies as st

from glidercli.channels import PHASES
from glidercli.dives import mask, phases, turning_points
from glidercli.errors import InputError
from glidercli.log import Log


def seconds_of(interval) -> tuple[str, float, float]:
    return interval.name, (interval.start_ns - ns(0.0)) * 1e-9, (interval.end_ns - ns(0.0)) * 1e-9


def test_one_dive() -> None:
    t = np.arange(0.0, 6001.0, 5.0)
    dive, climb = phases(log(t, depth=vee(800.0, 3000.0, 3000.0)(t)))
    # within 1 m of a turning point is the turn itself: 3.75 s at 0.267 m/s, and one sample interval of 5 s
    assert seconds_of(dive) == ("dive", pytest.approx(0.0, abs=5.0), pytest.approx(3000.0, abs=5.0))
    assert seconds_of(climb) == ("climb", pytest.approx(3000.0, abs=5.0), pytest.approx(6000.0, abs=5.0))


def test_surface_drift_and_hover_belong_to_neither() -> None:
    t = np.arange(0.0, 4000.0, 4.0)
    depth = np.interp(t, [0, 600, 1600, 2200, 3200, 4000], [0.2, 0.2, 300.0, 300.0, 0.2, 0.2])
    dive, climb = phases(log(t, depth=depth + 0.3 * np.sin(t)))
    # 1 m at 0.3 m/s is 3.3 s, waves of 0.3 m 1 s more each way, and one sample interval of 4 s
    assert seconds_of(dive) == ("dive", pytest.approx(600.0, abs=9.0), pytest.approx(1600.0, abs=9.0))
    assert seconds_of(climb) == ("climb", pytest.approx(2200.0, abs=9.0), pytest.approx(3200.0, abs=9.0))


def test_a_leg_that_goes_back_short_of_a_turn_ends_after_it_begins() -> None:
    # 5.8 m from turn to turn, and between 3.9 m back, less than a turn: from within 1 m of one to within 1 m of the other
    depth = np.array([0.0, 60.0, 0.0, 4.85, 0.95, 5.8, 0.0, 60.0, 0.0])
    found = phases(log(np.arange(9.0) * 60.0, depth=depth))
    assert [interval.name for interval in found] == ["dive", "climb"] * 3
    assert all(interval.end_ns > interval.start_ns for interval in found)


def test_many_yos_with_noise() -> None:
    t = np.arange(0.0, 4200.0, 2.0)
    depth = np.interp(t, np.arange(0, 4201, 100), np.tile([8.0, 37.0], 22)[:43])
    noisy = depth + 0.5 * np.random.default_rng(1).standard_normal(len(t))
    names = [interval.name for interval in phases(log(t, depth=noisy))]
    assert names == ["dive", "climb"] * 21


@pytest.mark.parametrize(("sign", "name"), [(1.0, "dive"), (-1.0, "climb")])
def test_one_way_only(sign: float, name: str) -> None:
    t = np.arange(0.0, 100.0)
    (only,) = phases(log(t, depth=100.0 + sign * 0.3 * t))
    assert only.name == name


@pytest.mark.parametrize("depth", [np.full(50, 3.0), 0.4 * np.sin(np.arange(50.0))])
def test_a_log_that_does_not_move_has_no_phases(depth) -> None:
    assert phases(log(np.arange(50.0), depth=depth)) == ()


def test_no_depth_and_no_phase_channel() -> None:
    assert phases(log(np.arange(5.0), pitch=np.zeros(5))) == ()


def test_the_phase_channel_goes_first() -> None:
    t = np.arange(0.0, 100.0, 10.0)
    words = ["surface", "dive", "dive", "dive", "hover", "climb", "climb", "surface", "surface", "surface"]
    codes = np.array([PHASES.index(word) for word in words], dtype=float)
    flight = log(t, depth=vee(300.0, 50.0, 50.0)(t), phase=codes)
    # a sample holds until the next: dive from 10 s to hover at 40 s
    assert [seconds_of(one) for one in phases(flight)] == [("dive", 10.0, 40.0), ("climb", 50.0, 70.0)]
    times = ns(np.array([9.9, 10.0, 39.9, 40.0]))
    assert mask(times, phases(flight), "dive").tolist() == [False, True, True, False]


def test_a_phase_channel_without_dive_or_climb_says_nothing() -> None:
    t = np.arange(0.0, 100.0, 1.0)
    flight = log(t, depth=vee(300.0, 50.0, 50.0)(t), phase=np.zeros(100))
    assert [one.name for one in phases(flight)] == ["dive", "climb"]


def test_prominence_decides_what_a_turn_is() -> None:
    t = np.arange(0.0, 400.0)
    depth = np.interp(t, [0, 100, 120, 250, 399], [0.0, 100.0, 92.0, 200.0, 0.0])
    assert [one.name for one in phases(log(t, depth=depth))] == ["dive", "climb", "dive", "climb"]
    assert [one.name for one in phases(log(t, depth=depth), prominence=10.0)] == ["dive", "climb"]


@pytest.mark.parametrize("wrong", [0.0, -1.0, float("nan")])
def test_prominence_must_be_positive(wrong: float) -> None:
    with pytest.raises(InputError, match="allowed: a positive depth"):
        phases(Log({"depth": channel("depth", np.arange(3.0), np.arange(3.0))}, "measured"), wrong)


@given(st.lists(st.floats(0.0, 1000.0), min_size=2, max_size=60), st.floats(0.5, 50.0))
def test_turning_points_alternate_and_stand_out(values: list[float], prominence: float) -> None:
    depth = np.array(values)
    turns = turning_points(depth, prominence)
    steps = np.diff(depth[turns])
    assert (np.abs(steps) >= prominence).all()
    assert (np.sign(steps[1:]) == -np.sign(steps[:-1])).all()
    assert bool(turns) == (
        max(np.max(np.maximum.accumulate(depth) - depth), np.max(depth - np.minimum.accumulate(depth))) >= prominence
    )
