"""Surface drift and depth-averaged current against tracks made from them."""

from __future__ import annotations

import dataclasses
import json
import math

import numpy as np
import pytest

from glidercli.channels import PHASES
from glidercli.log import Channel, Log
from glidercli.logio.derived import with_derived
from glidercli.logio.derived.track import with_track
from glidercli.places import geodetic_of_track

SECOND = 10**9
DRIFT, CURRENT = (0.20, -0.30), (-0.05, 0.10)
"""m/s north and east, at the surface and under water."""


def dive_between_fixes() -> tuple[Log, np.ndarray, np.ndarray, np.ndarray]:
    """300 s of drift, a dive to 100 m and back north at 30 deg, 300 s of drift; fixes as it drifts; its true track."""
    t = np.arange(0, 2601, 10)
    depth = np.interp(t, [0, 300, 1300, 2300, 2600], [1.0, 1.0, 101.0, 1.0, 1.0])
    pitch = np.where(t < 1300, -1.0, 1.0) * math.radians(30.0)
    under = np.clip(t - 300.0, 0.0, 2000.0)
    afloat = t - under
    way = 0.1 * under / math.tan(math.radians(30.0))
    north = way + CURRENT[0] * under + DRIFT[0] * afloat
    east = CURRENT[1] * under + DRIFT[1] * afloat
    fixed = np.flatnonzero((t <= 240) | (t >= 2360))
    lat, lon = geodetic_of_track(north[fixed], east[fixed], 48.0, -130.0)
    times = t.astype(np.int64) * SECOND
    channels = [
        Channel("depth", times, depth), Channel("pitch", times, pitch), Channel("heading", times, 0.0 * t),
        Channel("latitude", times[fixed], lat), Channel("longitude", times[fixed], lon),
    ]  # fmt: skip
    return Log({c.name: c for c in channels}, "measured"), times, north, east


def test_drift_and_current_are_told_apart() -> None:
    log, times, north, east = dive_between_fixes()
    track = with_track(log)
    (closure,) = json.loads(track.metadata["closures"])
    for when in ("before", "after"):
        drift = closure[f"drift_{when}_m_s"]
        assert (drift["north"], drift["east"]) == pytest.approx(DRIFT, abs=1e-6)  # fixes are good to 3e-9 m
    # where it dives between two samples is known to 3 m of depth and one sample, 40 s of 2000: 2 % of the difference
    assert closure["current_north_m_s"] == pytest.approx(CURRENT[0], abs=0.02 * (DRIFT[0] - CURRENT[0]))
    assert closure["current_east_m_s"] == pytest.approx(CURRENT[1], abs=0.02 * (CURRENT[1] - DRIFT[1]))
    assert closure["closure_error_m"] == pytest.approx(2000.0 * math.hypot(*CURRENT), rel=0.1)
    at = np.searchsorted(track["north"].time_ns, times)
    # 20 s on either side at the wrong one of two velocities that differ by 0.47 m/s
    assert np.abs(track["north"].values[at] - north).max() < 10.0
    assert np.abs(track["east"].values[at] - east).max() < 10.0


def test_the_track_meets_every_fix_even_between_samples() -> None:
    log, _, _, _ = dive_between_fixes()
    late = np.array([2605, 2700]) * SECOND  # after the last sample, as a Seaglider's are
    lat, lon = geodetic_of_track([300.0, 310.0], [-40.0, -50.0], 48.0, -130.0)
    fixes = {
        "latitude": np.concatenate([log["latitude"].values, lat]),
        "longitude": np.concatenate([log["longitude"].values, lon]),
    }
    times = np.concatenate([log["latitude"].time_ns, late])
    track = with_track(log.with_channels(*(Channel(n, times, v) for n, v in fixes.items())))
    assert track["north"].time_ns[-1] == late[-1]
    assert track["down"].time_ns[-1] == 2600 * SECOND  # no depth is made up
    first = (fixes["latitude"][0], fixes["longitude"][0])
    found = geodetic_of_track(track["north"].values, track["east"].values, *first)
    at = np.searchsorted(track["north"].time_ns, times)
    np.testing.assert_allclose(found[0][at], fixes["latitude"], atol=1e-10, rtol=0.0)  # 0.01 mm
    np.testing.assert_allclose(found[1][at], fixes["longitude"], atol=1e-10, rtol=0.0)


def test_one_fix_at_each_surfacing_tells_no_drift() -> None:
    log, _, _, _ = dive_between_fixes()
    few = np.flatnonzero(np.isin(log["latitude"].time_ns, np.array([240, 2360]) * SECOND))
    picked = (Channel(n, log[n].time_ns[few], log[n].values[few]) for n in ("latitude", "longitude"))
    track = with_track(log.with_channels(*picked))
    (closure,) = json.loads(track.metadata["closures"])
    assert closure["drift_before_m_s"] is None
    assert closure["drift_after_m_s"] is None
    assert "taken to act at the surface before and after it, too" in track.metadata["track_note"]


def test_phases_follow_from_depth() -> None:
    log, times, _, _ = dive_between_fixes()
    phase = with_derived(log)["phase"]
    assert phase.origin == "derived"
    words = np.array(PHASES)[phase.values[np.searchsorted(phase.time_ns, times)].astype(int)]
    at = lambda second: words[second // 10]  # noqa: E731
    assert [at(100), at(800), at(1300), at(1800), at(2500)] == ["surface", "dive", "inflection", "climb", "surface"]


def test_depth_follows_from_pressure_alone() -> None:
    import gsw

    times = np.arange(3) * SECOND
    log = with_derived(Log({"pressure": Channel("pressure", times, np.array([0.0, 5e6, 1e7]))}, "measured"))
    assert log["depth"].origin == "derived"
    np.testing.assert_allclose(log["depth"].values, -gsw.z_from_p([0.0, 500.0, 1000.0], 45.0), rtol=1e-12)
    assert "latitude 45 deg, none is known" in log.metadata["depth_note"]
    # the error that the note names: gravity at the poles and the equator against 45 deg
    poles = gsw.z_from_p(1000.0, 90.0) / gsw.z_from_p(1000.0, 45.0)
    assert abs(poles - 1.0) == pytest.approx(0.0027, abs=0.0001)


@pytest.mark.parametrize(
    ("first", "last", "slow", "told"),
    [
        (600, 1100, 1, False), (700, 1900, 1, False), (600, 890, 1, True), (600, 910, 1, False),
        (600, 790, 2, True), (600, 810, 2, False),  # 9.5 % and 10.5 % of the dive
    ],
)  # fmt: skip
def test_what_missing_samples_miss_is_no_current(first: int, last: int, slow: int, told: bool) -> None:
    """Of a dive of 2000 s, or of twice that; a gap of less than 300 s is bridged by the samples beside it."""
    log, times, _, _ = dive_between_fixes()
    there = (times <= first * SECOND) | (times >= last * SECOND)
    thinned = [Channel(n, times[there], log[n].values[there]) for n in ("depth", "pitch", "heading")]
    log = log.with_channels(*thinned)
    track = with_track(
        log.with_channels(*(dataclasses.replace(c, time_ns=c.time_ns * slow) for c in log.channels.values()))
    )
    (closure,) = json.loads(track.metadata["closures"])
    gap = (last - first) * slow
    assert closure["silent_s"] == pytest.approx(gap if gap > 300 else 0.0, abs=1e-6)
    assert (closure["current_north_m_s"] is not None, closure["current_east_m_s"] is not None) == (told, told)
    assert closure["closure_error_m"] > 100.0
    assert ("and no current, since for" in track.metadata["track_note"]) != told


def test_a_missing_dive_between_two_fixes_is_no_drift() -> None:
    """Two dives 6 h apart, 10 km from one another, without a sample or a fix in between."""
    log, _, _, _ = dive_between_fixes()
    later = 6 * 3600 * SECOND
    channels = []
    for name, channel in log.channels.items():
        moved = channel.values + (0.1 if name == "latitude" else 0.0)
        times = np.concatenate([channel.time_ns, channel.time_ns + later])
        channels.append(Channel(name, times, np.concatenate([channel.values, moved])))
    closures = json.loads(with_track(Log({c.name: c for c in channels}, "measured")).metadata["closures"])
    assert len(closures) == 2
    for closure in closures:
        for when in ("before", "after"):
            drift = closure[f"drift_{when}_m_s"]
            # 0.1 degree further north the parallel is 0.2 % shorter
            assert (drift["north"], drift["east"]) == pytest.approx(DRIFT, abs=1e-3)
