"""Dead reckoning against tracks known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pymap3d
import pytest

from glidercli.log import Channel, Log
from glidercli.logio.dead_reckoning import with_track

TIMES = np.arange(0, 1001, 10, dtype=np.int64) * 10**9


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
    lat, lon, _ = pymap3d.ned2geodetic(np.array([0.0, 500.0]), np.array([0.0, -80.0]), 0.0, 48.9, -130.6, 0.0)
    track = with_track(log_of(0.0, latitude=Channel("latitude", ends, lat), longitude=Channel("longitude", ends, lon)))
    # 1 cm: latitude and longitude of the second fix are on the ellipsoid, the track in its tangent plane
    assert track["north"].values[-1] == pytest.approx(500.0, abs=0.03)
    assert track["east"].values[-1] == pytest.approx(-80.0, abs=0.03)
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
