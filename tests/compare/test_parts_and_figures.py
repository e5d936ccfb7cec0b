"""Errors by depth, figures of both flights, events with their places, and the order of several simulations."""

from __future__ import annotations

import time

import numpy as np
import pytest
from analytic_flights import START_NS, log, vee

from glidercli.compare import compare
from glidercli.compare.events import paired
from glidercli.log import Event, Log

T = np.arange(0.0, 2001.0, 5.0)
DEPTH = vee(300.0, 1000.0, 1000.0)(T)


def test_errors_by_depth_are_those_of_the_samples_there() -> None:
    off = np.where(DEPTH < 100.0, 2.0, np.where(DEPTH < 200.0, -5.0, 0.5))
    measured, simulated = log(T, depth=DEPTH, pitch=0.0 * T), log(T, "simulated", depth=DEPTH, pitch=off)
    found = compare(measured, simulated, depth_band=100.0).document()["bands"]
    assert [(one["from_m"], one["to_m"]) for one in found] == [(0, 100), (100, 200), (200, 300), (300, 400)]
    assert [one["channels"]["pitch"]["bias"] for one in found] == pytest.approx([2.0, -5.0, 0.5, 0.5])
    assert sum(one["channels"]["pitch"]["n"] for one in found) == len(T)
    assert (
        compare(measured, simulated).document()["bands"] == found
    )  # 300 m make four bands of 100 m without being asked


def test_a_sample_in_a_gap_of_measured_depth_is_in_no_band() -> None:
    kept = (T < 400.0) | (T > 700.0)
    measured = log(T[kept], depth=DEPTH[kept]).with_channels(*log(T, pitch=0.0 * T).channels.values())
    found = compare(measured, log(T, "simulated", depth=DEPTH, pitch=0.0 * T))
    document = found.document()
    banded = sum(one["channels"]["pitch"]["n"] for one in document["bands"])
    assert document["channels"]["pitch"]["n"] - banded == int((~kept).sum())
    assert any(f"no band of depth: {int((~kept).sum())} of pitch" in note for note in document["notes"])


def outcomes(measured: Log, simulated: Log) -> dict[str, tuple[float, float, float, float | None]]:
    found = compare(measured, simulated).document()["outcomes"]
    return {one["name"]: (one["measured"], one["simulated"], one["difference"], one["relative"]) for one in found}


def test_turns_are_added_up_on_dives_and_climbs() -> None:
    """0.18 deg/s is a turn in 2,000 s; the simulated flight turns twice as fast, and to port on the climb."""
    slow, fast = 0.18 * T, np.where(T < 1000.0, 0.36 * T, 720.0 - 0.36 * T)
    found = outcomes(log(T, depth=DEPTH, heading=slow % 360.0), log(T, "simulated", depth=DEPTH, heading=fast % 360.0))
    assert found["turns to starboard"] == pytest.approx((1.0, 0.0, -1.0, -1.0), abs=1e-9)
    # of each leg the samples within 1 m of the surface and of the apogee, one of 200, are the turn and not the leg
    assert found["turns to starboard on dives"][:2] == pytest.approx((0.5, 1.0), rel=0.01)
    assert found["turns to starboard on climbs"][:2] == pytest.approx((0.5, -1.0), rel=0.01)


def test_figures_are_of_the_time_that_both_cover() -> None:
    short = T[:201]  # the dive alone
    found = outcomes(log(T, depth=DEPTH), log(short, "simulated", depth=0.9 * DEPTH[:201]))
    assert found["maximum depth"] == pytest.approx((300.0, 270.0, -30.0, -0.1))
    assert found["time to maximum depth"][:2] == pytest.approx((1000.0, 1000.0))
    assert "time on climbs" not in found


def test_events_tell_how_far_apart_and_relative_to_what() -> None:
    """The simulated vehicle is 10 s late, 3 m deeper, and 0.03 m/s faster to the north."""
    place = {"origin_latitude_deg": "20.0", "origin_longitude_deg": "115.0"}
    measured = log(T, metadata=place, depth=DEPTH, north=0.2 * T, east=0.0 * T, down=DEPTH)
    late = vee(303.0, 1000.0, 1000.0)(T - 10.0)
    simulated = log(T, "simulated", place, depth=late, north=0.23 * T, east=0.0 * T, down=late)
    events = {one["name"]: one for one in compare(measured, simulated).document()["events"]}
    apogee = events["apogee"]
    assert apogee["measured"] == {"time_utc": "2011-07-20T04:44:40.000Z", "depth_m": 300.0}
    assert (apogee["time_difference_s"], apogee["time_relative"]) == (10.0, pytest.approx(0.01))
    assert (apogee["depth_difference_m"], apogee["depth_relative"]) == pytest.approx((3.0, 0.01))
    # at 1,000 s the one is at 200 m, at 1,010 s the other at 232.3 m
    assert apogee["place_difference"]["distance_m"] == pytest.approx(32.3, abs=1e-9)
    assert apogee["place_difference"]["relative"] == pytest.approx(32.3 / 200.0, abs=1e-9)
    # 2 m from the surface are passed 6.67 s before it at 0.3 m/s: the sample after that is at 1,995 s, the other's 10 s
    # and 3 / 0.303 s later or on the grid of 5 s
    surfacing = events["surfacing"]
    assert surfacing["measured"]["time_utc"] == "2011-07-20T05:01:15.000Z"
    closure = compare(measured, simulated).document()["track"]["closure"]
    assert closure == surfacing["place_difference"]


def test_events_that_a_log_names_are_not_derived_again() -> None:
    named = Log(log(T, depth=DEPTH).channels, "simulated", {}, (Event("apogee", START_NS + 10**12, 300.0),))
    found = [one for one in compare(log(T, depth=DEPTH), named).document()["events"] if one["name"] == "apogee"]
    assert len(found) == 1
    assert found[0]["time_difference_s"] == 0.0


def test_the_closest_simulation_comes_first() -> None:
    def off(by: float) -> Log:
        return log(T, "simulated", depth=DEPTH + by, pitch=by / 10.0 + np.sin(T))

    measured = log(T, depth=DEPTH, pitch=np.sin(T))
    found = compare(measured, [off(9.0), off(-3.0), off(9.0)], names=["m", "far", "near", "far too"])
    ranking = found.document()["ranking"]
    assert [(one["rank"], one["name"], one["of"]) for one in ranking] == [
        (1, "near", 802),
        (2, "far", 802),
        (2, "far too", 802),
    ]
    spread = np.ptp(np.sin(T))
    assert ranking[0]["score"] == pytest.approx(0.5 * (3.0 / 300.0 + 0.3 / spread))
    assert "near" in found.text().split("The closest first")[1].splitlines()[2]


def test_simulations_without_a_measure_have_no_rank() -> None:
    """A constant measured channel has no range to normalise by."""
    flat = log(T, depth=5.0 + 0.0 * T)
    ranking = compare(flat, [log(T, "simulated", depth=4.0 + 0.0 * T)]).document()["ranking"]
    assert ranking == [{"rank": None, "name": "simulated", "score": None, "of": 0, "by": ()}]


def test_thousands_of_events_are_paired_in_no_time() -> None:
    """Every pair was sought among all others: 10,000 took minutes. The time of the process, not of the clock."""
    many = tuple(Event("apogee", START_NS + 10**9 * second, 1.0) for second in range(20_000))
    late = tuple(Event("apogee", START_NS + 10**9 * second + 1, 1.0) for second in range(20_000))
    begun = time.process_time()
    pairs = paired(many, late)
    assert time.process_time() - begun < 5.0  # some 0.1 s; all with all, 400 million, take minutes
    assert all(pair.simulated is not None and pair.simulated.time_ns - pair.measured.time_ns == 1 for pair in pairs)


def test_ranking_is_at_samples_that_all_have() -> None:
    """One that is right for 30 s is no closer than one that is right there and a little off elsewhere."""
    part = slice(100, 107)
    whole = log(T, "simulated", depth=DEPTH + np.where(T < 535.0, 0.0, 2.0))
    short = log(T[part], "simulated", depth=DEPTH[part] + 0.5)
    ranking = compare(log(T, depth=DEPTH), [short, whole], names=["m", "short", "whole"]).ranking
    assert [(one.name, one.of) for one in ranking] == [("whole", 7), ("short", 7)]


def test_ranking_counts_each_quantity_once_and_nothing_that_was_given() -> None:
    columns = {
        "depth": DEPTH, "down": DEPTH, "pitch": np.sin(T), "mass_position": 0.4 + 1e-4 * T, "density": 1025.0 + DEPTH,
    }  # fmt: skip
    logs = [log(T, origin, **columns) for origin in ("measured", "simulated", "simulated")]
    assert compare(logs[0], logs[1:]).ranking[0].by == ("depth", "pitch")
    assert compare(logs[0], logs[1:], channels=["density"]).ranking[0].by == ("density",)


def test_a_heading_that_is_wrong_in_a_spiral_is_not_next_to_right() -> None:
    """40 turns: an error of half a circle is half of the range that it can have, not a hundredth."""
    psi = 14400.0 * T / 2000.0
    measured = log(T, depth=DEPTH, heading=psi % 360.0)
    found = compare(measured, log(T, "simulated", depth=DEPTH, heading=(psi + 180.0) % 360.0))
    assert found.runs[0].channels["heading"].nrmse == pytest.approx(0.5, abs=1e-9)


def test_events_far_from_one_another_are_not_the_same() -> None:
    """Two like yos; the simulated log has the first alone: the second apogee, 1,800 s later, has no partner."""
    t = np.arange(0.0, 3601.0, 5.0)
    yos = 100.0 * np.abs(np.sin(np.pi * t / 1800.0))
    one = t <= 1800.0
    events = compare(log(t, depth=yos), log(t[one], "simulated", depth=yos[one])).document()["events"]
    apogees = [one for one in events if one["name"] == "apogee"]
    assert [(one["time_difference_s"], one["simulated"] is None) for one in apogees] == [(0.0, False), (None, True)]
    late = compare(log(t, depth=yos), log(t[one] + 3000.0, "simulated", depth=yos[one])).document()["events"]
    assert all(abs(one["time_difference_s"]) < 900.0 for one in late if one["time_difference_s"] is not None)
