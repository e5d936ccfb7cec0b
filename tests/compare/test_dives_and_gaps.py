"""No dive goes on across a time in which the vehicle may have been at the surface; shorter gaps are told."""

from itertools import pairwise

import numpy as np
import pytest
from analytic_flights import channel, log, ns, vee

from glidercli.channels import PHASES
from glidercli.dives import Interval, cuts, long_gaps, mask, phases
from glidercli.log import Log
from glidercli.logio.derived.motion import with_motion
from glidercli.logio.overview import overview
from glidercli.logio.reading import Reading

DAY = 86400.0


def two_dives(between: float) -> tuple[np.ndarray, np.ndarray]:
    """Two dives to 600 m in an hour each way, a sample each 10 s, the second so many seconds after the first."""
    t = np.arange(0.0, 7200.0, 10.0)
    depth = vee(600.0, 3600.0, 3600.0)(t)
    return np.concatenate([t, t + 7200.0 + between]), np.concatenate([depth, depth])


def dives_of(made: Log) -> list[tuple[float, float, float | None]]:
    """Start, s, how long, s, and gap, s, of each dive."""
    found = overview(Reading(made, ())).dives
    return [((d.start_ns - ns(0.0)) * 1e-9, (d.end_ns - d.start_ns) * 1e-9, d.gap) for d in found]


@pytest.mark.parametrize("derived", [False, True])
@pytest.mark.parametrize("between", [400.0, 4.0 * 3600.0, 764.0 * DAY])
def test_dives_of_two_files_far_apart_last_as_long_as_each(between: float, derived: bool) -> None:
    made = log(*two_dives(between)[:1], depth=two_dives(between)[1])
    first, second = dives_of(with_motion(made) if derived else made)
    # within 1 m of the surface is the turn: 6 s at 0.167 m/s, and one interval of 10 s each way
    assert first == (pytest.approx(0.0, abs=20.0), pytest.approx(7200.0, abs=40.0), None)
    assert second == (pytest.approx(7200.0 + between, abs=20.0), pytest.approx(7200.0, abs=40.0), None)


def test_a_descent_and_an_ascent_of_two_dives_are_no_one() -> None:
    """The first dive lacks its climb, the last its descent; dives between them are missing."""
    t, depth = two_dives(20.0 * 3600.0)
    there = (t < 3600.0) | (t > t[-1] - 3600.0)
    (only,) = dives_of(log(t[there], depth=depth[there]))
    assert only == (pytest.approx(0.0, abs=20.0), pytest.approx(3600.0, abs=40.0), None)


def test_a_gap_too_short_to_have_surfaced_in_is_told() -> None:
    """From 500 m up and down again takes 2000 s at 0.5 m/s: the dive goes on across 1000 s, and not across 2100 s."""
    t, depth = two_dives(10.0)
    for gap, lasts, told in ((1000.0, 7200.0, pytest.approx(1000.0, abs=10.0)), (2100.0, 3000.0, None)):
        there = (t <= 3000.0) | (t >= 3000.0 + gap)
        found = dives_of(log(t[there], depth=depth[there]))
        assert len(found) == 2  # the climb alone is no dive
        assert found[0] == (pytest.approx(0.0, abs=20.0), pytest.approx(lasts, abs=40.0), told)


def test_a_recorded_phase_holds_across_no_cut() -> None:
    t, depth = two_dives(5.5 * 3600.0)
    turn = np.where(np.arange(len(t)) % 720 < 360, PHASES.index("dive"), PHASES.index("climb")).astype(float)
    made = log(t, depth=depth).with_channels(channel("phase", t, turn))
    assert all((leg.end_ns - leg.start_ns) * 1e-9 <= 3610.0 for leg in phases(made))
    assert [round(lasts / 100.0) for _, lasts, _ in dives_of(made)] == [72, 72]


def test_a_phase_that_is_told_where_it_begins_is_not_cut() -> None:
    """As in a .log alone: a sample at each begin; depth every 10 s."""
    t, depth = two_dives(20.0)
    begins = np.array([0.0, 3600.0, 7220.0, 10820.0, 14420.0])
    words = np.array([PHASES.index(word) for word in ("dive", "climb", "dive", "climb", "surface")], dtype=float)
    made = log(t, depth=depth).with_channels(channel("phase", begins, words))
    assert [leg.name for leg in phases(made)] == ["dive", "climb"] * 2
    assert [lasts for _, lasts, _ in dives_of(made)] == [7220.0, 7200.0]


def test_sparse_samples_are_no_gaps() -> None:
    t = np.arange(0.0, 20000.0, 600.0)
    made = log(t, depth=vee(1000.0, 10000.0, 10000.0)(t))
    assert not len(long_gaps(made["depth"].time_ns))
    assert not len(cuts(made))
    assert len(dives_of(made)) == 1
    assert not len(long_gaps(np.array([], np.int64)))


@pytest.mark.parametrize("name", ["dive", "climb"])
def test_times_within_legs_are_those_that_a_look_at_each_leg_finds(name: str) -> None:
    rng = np.random.default_rng(3)
    ends = np.sort(rng.integers(0, 1000, 60))
    legs = tuple(Interval(str(rng.choice(["dive", "climb"])), int(a), int(b)) for a, b in pairwise(ends))
    times = np.sort(rng.integers(-5, 1005, 500))
    wanted = [any(leg.name == name and leg.start_ns <= time < leg.end_ns for leg in legs) for time in times]
    assert mask(times, legs, name).tolist() == wanted
    assert not mask(times, (), name).any()
