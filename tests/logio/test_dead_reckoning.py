"""Dead reckoning against tracks known in closed form."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from glidercli.log import Channel, Log
from glidercli.logio.derived.track import with_track
from glidercli.logio.whereabouts import Whereabouts
from glidercli.places import geodetic_of_track

TIMES = np.arange(0, 1001, 10, dtype=np.int64) * 10**9
PLACED = 1e-6
"""m; a double holds degrees to 3e-14, which is 3e-9 m."""


def log_of(heading: float, **extra: Channel) -> Log:
    seconds = TIMES * 1e-9
    channels = {
        "depth": Channel("depth", TIMES, 0.2 * seconds),
        "pitch": Channel("pitch", TIMES, np.full(len(TIMES), math.radians(-30.0))),
        "heading": Channel("heading", TIMES, np.full(len(TIMES), heading)),
    }
    return Log({**channels, **extra}, "measured")


@pytest.mark.parametrize("heading_deg", [0.0, 90.0, 225.0, 359.9])
def test_constant_glide(heading_deg: float) -> None:
    track = with_track(log_of(math.radians(heading_deg)))
    reach = 200.0 / math.tan(math.radians(30.0))
    assert track["north"].values[-1] == pytest.approx(reach * math.cos(math.radians(heading_deg)), abs=1e-9)  # rounding
    assert track["east"].values[-1] == pytest.approx(reach * math.sin(math.radians(heading_deg)), abs=1e-9)
    assert track["north"].origin == "derived"
    assert "no GPS fix" in track.metadata["track_note"]


def test_the_track_passes_through_the_fixes() -> None:
    ends = TIMES[[0, -1]]
    lat, lon = geodetic_of_track([0.0, 500.0], [0.0, -80.0], 48.9, -130.6)
    track = with_track(log_of(0.0, latitude=Channel("latitude", ends, lat), longitude=Channel("longitude", ends, lon)))
    assert track["north"].values[-1] == pytest.approx(500.0, abs=PLACED)
    assert track["east"].values[-1] == pytest.approx(-80.0, abs=PLACED)
    assert "depth-averaged current" in track.metadata["track_note"]
    assert float(track.metadata["origin_latitude_deg"]) == pytest.approx(48.9)


def test_level_flight_stands_still_and_says_so() -> None:
    flat = Channel("pitch", TIMES, np.zeros(len(TIMES)))
    track = with_track(log_of(0.0, pitch=flat))
    assert np.abs(track["north"].values).max() == 0.0
    assert "held at zero for 1000 s" in track.metadata["track_note"]


def test_a_gap_is_named() -> None:
    late = TIMES.copy()
    late[50:] += 3600 * 10**9
    base = log_of(0.0)
    gapped = Log({n: Channel(n, late, c.values) for n, c in base.channels.items()}, "measured")
    assert "1 gaps longer than 300 s" in with_track(gapped).metadata["track_note"]


def test_a_square_in_a_current_with_a_fix_at_each_corner() -> None:
    """Legs north, east, south, west; a steady current carries them along, and the closure is that current."""
    legs, steps, every = 4, 50, 10
    samples = legs * (steps + 1)  # a step without depth rate turns into the next leg
    times = np.arange(samples, dtype=np.int64) * every * 10**9
    heading = np.repeat(np.radians([0.0, 90.0, 180.0, 270.0]), steps + 1)
    down = np.linspace(0.0, 100.0, steps + 1)
    depth = np.concatenate([down, down[::-1]] * (legs // 2))
    pitch = np.repeat(np.radians([-30.0, 30.0] * (legs // 2)), steps + 1)
    way = np.abs(np.diff(depth)) / math.tan(math.radians(30.0))
    current_north, current_east = 0.05, -0.1
    carried = np.arange(samples) * every
    north = np.concatenate([[0.0], np.cumsum(way * np.cos(heading[1:]))]) + current_north * carried
    east = np.concatenate([[0.0], np.cumsum(way * np.sin(heading[1:]))]) + current_east * carried
    corners = np.array([0, *(leg * (steps + 1) for leg in range(1, legs)), samples - 1])
    lat, lon = geodetic_of_track(north[corners], east[corners], 48.9, -130.6)
    values = {"depth": depth, "pitch": pitch, "heading": heading}
    channels = {name: Channel(name, times, value) for name, value in values.items()}
    channels["latitude"] = Channel("latitude", times[corners], lat)
    channels["longitude"] = Channel("longitude", times[corners], lon)
    track = with_track(Log(channels, "measured"))
    np.testing.assert_allclose(track["north"].values, north, atol=PLACED, rtol=0.0)
    np.testing.assert_allclose(track["east"].values, east, atol=PLACED, rtol=0.0)
    found = re.findall(r"current of (\S+) m/s east, (\S+) m/s north", track.metadata["track_note"])
    assert found == [("-0.100", "0.050")] * legs


EAST = 0.4  # m/s
YO = np.abs(
    0.2 * (TIMES * 1e-9 % 400.0) - 40.0
)  # m, from 40 m up to the surface, and down again: 93 samples, 900 s, under 3 m


def positions_of(rows: slice = slice(None)) -> Whereabouts:
    way = EAST * TIMES[rows] * 1e-9
    return Whereabouts(TIMES[rows], *geodetic_of_track(0.5 * way, way, 48.9, 179.999))


def without_attitude(**extra: Channel) -> Log:
    return Log({"depth": Channel("depth", TIMES, YO), **extra}, "measured")


def test_a_log_without_attitude_is_drawn_through_its_positions() -> None:
    """Every third sample of depth has one; they go over 180 deg of longitude."""
    track = with_track(without_attitude(), positions_of(slice(1, None, 3)))
    rows = TIMES[1::3]
    way = EAST * (rows - rows[0]) * 1e-9
    for name, wanted in {"north": 0.5 * way, "east": way, "down": YO[1::3]}.items():
        assert track[name].origin == "derived"
        assert track[name].time_ns.tolist() == rows.tolist()
        np.testing.assert_allclose(track[name].values, wanted, atol=PLACED * 10, rtol=0.0)  # 360 deg less: a digit
    assert not {"latitude", "longitude"} & track.channels.keys()
    assert float(track.metadata["origin_latitude_deg"]) == pytest.approx(48.9, abs=1e-4)
    note = track.metadata["track_note"]
    assert "through 34 recorded positions, since the log has no pitch and no heading" in note
    assert "no GPS fixes" in note
    assert "67 samples of depth without a position are left out" in note
    assert "longer than" not in note


def test_positions_that_jump_are_drawn_and_told() -> None:
    near = positions_of()
    near.latitude[50] += 0.01  # 1.1 km
    track = with_track(without_attitude(), near)
    assert len(track["north"]) == len(TIMES)
    assert "; 2 steps between them are longer than 3 m/s and 50 m allow" in track.metadata["track_note"]


def test_simulated_positions_serve_as_well() -> None:
    near = positions_of()
    places = {"latitude": near.latitude, "longitude": near.longitude}
    log = without_attitude(**{name: Channel(name, TIMES, values, "simulated") for name, values in places.items()})
    track = with_track(Log(log.channels, "simulated"))
    assert len(track["north"]) == len(TIMES)
    assert "through 101 simulated positions" in track.metadata["track_note"]


def afloat() -> Whereabouts:
    rows = np.flatnonzero(YO < 3.0)
    return Whereabouts(*(values[rows] for values in positions_of()))


def held() -> Whereabouts:
    """The last position at the surface goes on to be told under water."""
    near = positions_of()
    last = np.maximum.accumulate(np.where(YO < 3.0, np.arange(len(YO)), 0))
    return Whereabouts(TIMES, near.latitude[last], near.longitude[last])


@pytest.mark.parametrize(
    ("near", "told"),
    [
        (None, "it has no position under water"),
        (afloat(), "it has no position under water"),
        (held(), "its positions, at 93 samples of depth, go on for 0 of 900 s under water: too little"),
        (positions_of(slice(0, 40)), "go on for 350 of 900 s under water: too little"),
    ],
)
def test_positions_that_do_not_tell_the_way_make_no_track(near: Whereabouts | None, told: str) -> None:
    log = with_track(without_attitude(pitch=Channel("pitch", TIMES, 0.0 * YO)), near)
    assert "north" not in log
    assert log.metadata["track_note"].startswith("no track: the log has no heading, and ")
    assert told in log.metadata["track_note"]


def test_attitude_comes_before_positions() -> None:
    track = with_track(log_of(0.0), positions_of())
    assert track["east"].values[-1] == pytest.approx(0.0, abs=1e-9)
    assert "dead reckoned" in track.metadata["track_note"]


def test_attitude_at_other_times_than_depth_is_told() -> None:
    late = TIMES + 5 * 10**9
    other = {name: Channel(name, late, np.full(len(late), -0.5)) for name in ("pitch", "heading")}
    assert with_track(without_attitude(**other)).metadata["track_note"] == (
        "no track: depth, pitch and heading have no two samples at one time, and it has no position under water"
    )
