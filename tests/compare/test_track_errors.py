"""Errors of tracks whose closed forms are known, and against another library's rotation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from analytic_flights import START_NS, log
from scipy.spatial.transform import Rotation

from glidercli.compare import compare
from glidercli.compare.tracks import tracks

T = np.arange(0.0, 4001.0, 10.0)
ROUNDING = 1e-9  # m; places below 1e4 m through one subtraction and one interpolation


def flight(north, east, down, t=T, origin="measured", **place):
    metadata = {f"origin_{axis}_deg": repr(value) for axis, value in place.items()}
    return log(t, origin, metadata, north=north + 0.0 * t, east=east + 0.0 * t, down=down + 0.0 * t)


def errors(measured, simulated, max_gap=60.0):
    both = tracks(measured, simulated)
    assert both is not None
    found = both.errors(max_gap)
    assert found is not None
    return found


HERE = {"latitude": 20.0, "longitude": 115.0}


def test_a_constant_shift_is_every_absolute_error_and_none_of_the_others() -> None:
    found = errors(flight(0.2 * T, 0.1 * T, 5.0, **HERE), flight(0.2 * T + 3.0, 0.1 * T - 4.0, 17.0, **HERE))
    far = found.absolute
    assert (far.n, far.max_time_ns) == (len(T), START_NS)
    for value in (far.rmse, far.mean, far.median, far.max):
        assert value == pytest.approx(13.0, abs=ROUNDING)  # 3, 4, 12
    assert far.std == pytest.approx(0.0, abs=ROUNDING)
    assert found.aligned.rmse == pytest.approx(0.0, abs=ROUNDING)
    assert found.turn == pytest.approx(0.0, abs=ROUNDING)
    assert [one.rmse for one in found.relative] == pytest.approx([0.0, 0.0], abs=ROUNDING)
    assert not found.level


def test_a_velocity_that_is_off_drifts() -> None:
    """0.05 m/s too fast to the north: 3 m in 60 s; the mean square of v t over n samples is known."""
    found = errors(flight(0.2 * T, 0.0, 0.0, **HERE), flight(0.25 * T, 0.0, 0.0, **HERE))
    assert [one.over for one in found.relative] == [60.0, 600.0]  # 3,600 s do not fit twice into 4,000 s
    assert [one.rmse for one in found.relative] == pytest.approx([3.0, 30.0], abs=ROUNDING)
    assert [one.max for one in found.relative] == pytest.approx([3.0, 30.0], abs=ROUNDING)
    assert [one.of_way for one in found.relative] == pytest.approx([0.25, 0.25], abs=ROUNDING)
    assert [one.n for one in found.relative] == [len(T) - 6, len(T) - 60]
    last = len(T) - 1  # sum of k^2, k = 0 ... last
    square = 0.5**2 * last * (last + 1) * (2 * last + 1) / 6.0 / len(T)
    assert found.absolute.rmse == pytest.approx(math.sqrt(square), abs=1e-8)
    assert found.absolute.max == pytest.approx(200.0, abs=ROUNDING)
    assert (found.way, found.simulated_way) == pytest.approx((800.0, 1000.0), abs=1e-8)


@pytest.mark.parametrize("turn", [0.3, -1.2, 3.0])
def test_a_turned_track_is_turned_back(turn: float) -> None:
    north, east, down = 300.0 * np.sin(T / 500.0), 0.2 * T, 50.0 * np.cos(T / 300.0)
    c, s = math.cos(turn), math.sin(turn)
    found = errors(
        flight(north, east, down, **HERE), flight(c * north - s * east + 7.0, s * north + c * east, down, **HERE)
    )
    assert found.aligned.rmse == pytest.approx(0.0, abs=1e-8)
    assert found.turn == pytest.approx(-turn, abs=1e-12)
    assert found.absolute.rmse > 100.0


def test_the_turn_is_that_of_another_library() -> None:
    """scipy's rotation between two sets of vectors, these being level, is about the vertical."""
    rng = np.random.default_rng(2)
    p, noise = (np.column_stack([np.cumsum(rng.normal(size=(len(T), 2)), axis=0), np.zeros(len(T))]) for _ in range(2))
    s = Rotation.from_rotvec([0.0, 0.0, 0.9]).apply(p) + 0.2 * noise
    found = errors(flight(*p.T, **HERE), flight(*s.T, **HERE))
    rotation, rssd = Rotation.align_vectors(p - p.mean(axis=0), s - s.mean(axis=0))
    assert found.turn == pytest.approx(rotation.as_rotvec()[2], abs=1e-9)
    assert found.aligned.rmse == pytest.approx(rssd / math.sqrt(len(T)), rel=1e-9)


def test_origins_apart_on_the_globe() -> None:
    """A minute of latitude is 1,845 m at 20 deg north (WGS-84: 1,842.9 m at the equator, 1,861.6 at the pole)."""
    there = {"latitude": 20.0 + 1.0 / 60.0, "longitude": 115.0}
    found = errors(flight(0.1 * T, 0.0, 0.0, **HERE), flight(0.1 * T, 0.0, 0.0, **there))
    assert found.absolute.rmse == pytest.approx(1845.1, abs=0.1)


def test_without_a_place_on_the_globe_both_begin_at_one_place() -> None:
    late = T[5:]
    found = errors(flight(0.1 * T, 0.0, 4.0), flight(0.1 * late + 900.0, 50.0, 4.0, t=late))
    assert found.absolute.rmse == pytest.approx(0.0, abs=ROUNDING)
    assert found.outside == 5
    assert "one place at the first common time" in found.origin


def test_positions_stand_in_for_a_track() -> None:
    fixes = T[::40]
    measured = log(fixes, latitude=20.0 + 0.1 * fixes / 110_704.0, longitude=115.0 + 0.0 * fixes)
    found = errors(measured, flight(0.1 * T, 0.0, 0.1 * T, **HERE))
    assert found.level
    # 110,704 m is a degree of latitude at 20 deg north (WGS-84) to a few m: 0.02 m in 400 m
    assert found.absolute.rmse == pytest.approx(0.0, abs=0.05)


def test_gaps_and_no_common_time() -> None:
    gappy = T[(T < 1000.0) | (T > 2000.0)]
    found = errors(flight(0.1 * T, 0.0, 0.0, **HERE), flight(0.1 * gappy, 0.0, 0.0, t=gappy, **HERE))
    assert found.gap == 101  # 1,000, 1,010 ... 2,000 s
    assert found.absolute.n + found.gap + found.outside == len(T)
    both = tracks(flight(T, 0.0, 0.0, **HERE), flight(T, 0.0, 0.0, t=T + 1e5, **HERE))
    assert both is not None
    assert both.errors(60.0) is None
    assert tracks(flight(T, 0.0, 0.0), flight(T, 0.0, 0.0, t=T + 1e5)) is None
    assert tracks(log(T, depth=T), flight(T, 0.0, 0.0)) is None


def test_one_sample_and_a_standing_vehicle_divide_by_nothing() -> None:
    found = errors(flight(1.0, 0.0, 0.0, t=T[:1], **HERE), flight(0.0, 0.0, 0.0, **HERE))
    assert (found.absolute.rmse, found.aligned.rmse, found.relative) == (1.0, 0.0, ())
    still = errors(flight(0.0, 0.0, 0.0, **HERE), flight(0.1 * T, 0.0, 0.0, **HERE))
    assert [one.of_way for one in still.relative] == [None, None]


def test_the_document_tells_the_worst_time_in_words_alone() -> None:
    place = {f"origin_{axis}_deg": repr(value) for axis, value in HERE.items()}
    logs = [
        log(T, origin, place, depth=5.0 + 0.0 * T, north=way * T, east=0.0 * T, down=5.0 + 0.0 * T)
        for origin, way in (("measured", 0.1), ("simulated", 0.2))
    ]
    told = compare(*logs).document()["track"]
    assert set(told["absolute"]) == {"n", "rmse", "mean", "median", "std", "max", "max_time_utc", "unit"}
    assert told["absolute"]["max_time_utc"] == "2011-07-20T05:34:40.000Z"  # 4,000 s after the first sample
