"""Dead reckoning against tracks known in closed form."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from glidercli.log import Channel, Log
from glidercli.logio.derived.track import with_track
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
