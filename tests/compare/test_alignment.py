"""A clock that was shifted by a known time is shifted back by it."""

import numpy as np
import pytest
from analytic_flights import log, vee
from hypothesis import given, settings
from hypothesis import strategies as st

from glidercli.compare.align import align, shifted
from glidercli.errors import InputError
from glidercli.log import Event, Log

T = np.arange(0.0, 3000.0, 6.0)


def dive(t, late: float = 0.0, **options) -> Log:
    return log(t, depth=vee(200.0, 1200.0, 1000.0)(t - late - 200.0), **options)


def test_none_leaves_utc_but_for_the_offset() -> None:
    assert align(dive(T), dive(T)).shift == 0.0
    assert align(dive(T), dive(T), offset=-7.5).shift == -7.5


def test_start_lays_first_depth_samples_on_each_other() -> None:
    # an earlier sample of another channel does not count
    measured = dive(T[10:]).with_channels(*log(T, pitch=0.0 * T).channels.values())
    assert align(measured, dive(T), "start", offset=2.0).shift == pytest.approx(62.0, abs=1e-9)  # ns resolution


@given(st.floats(-500.0, 500.0))
@settings(max_examples=30, deadline=None)
def test_xcorr_finds_any_shift(late: float) -> None:
    found = align(dive(T, late), dive(T), "xcorr").shift
    # the corner at apogee is rounded by interpolation at 6 s: a tenth of a step
    assert found == pytest.approx(late, abs=0.6)


def test_xcorr_on_a_straight_descent_and_other_clocks() -> None:
    measured = log(T + 1e6, depth=5.0 + 0.25 * T)
    simulated = log(T[::2], depth=0.25 * T[::2])
    shift = align(measured, simulated, "xcorr").shift
    # the simulated reaches each depth 5 / 0.25 s later; the mean square is a parabola, so rounding alone is left
    assert shift == pytest.approx(1e6 - 20.0, abs=1e-3)


def test_xcorr_is_not_misled_by_a_gap_or_unequal_lengths() -> None:
    whole = dive(T, late=90.0)
    kept = np.concatenate([T[:150], T[260:]])
    gappy = log(kept, depth=vee(200.0, 1200.0, 1000.0)(kept - 290.0))
    part = dive(T[:300])
    for measured in (whole, gappy):
        assert align(measured, part, "xcorr").shift == pytest.approx(90.0, abs=0.6)  # a tenth of a step, as above


def test_shifted_moves_every_channel_and_event_and_nothing_else() -> None:
    flight = Log(dive(T).channels, "measured", {"a": "b"}, (Event("apogee", 5),))
    moved = shifted(flight, 2.5)
    assert (moved["depth"].time_ns - flight["depth"].time_ns == 2_500_000_000).all()
    assert (moved["depth"].values == flight["depth"].values).all()
    assert moved.events[0].time_ns == 2_500_000_005
    assert moved.metadata == flight.metadata
    assert shifted(flight, 0.0) is flight


def test_faults() -> None:
    blind = log(T, pitch=0.0 * T)
    with pytest.raises(InputError, match="the measured log has 0 depth samples; at least 1"):
        align(blind, dive(T), "start")
    with pytest.raises(InputError, match="the simulated log has 2 depth samples; at least 3"):
        align(dive(T), dive(T[:2]), "xcorr")
    with pytest.raises(InputError, match="allowed: none, start, gps, dive, xcorr"):
        align(dive(T), dive(T), "best")  # type: ignore[arg-type]
    for offset in (float("nan"), 1e12, -1e300):
        with pytest.raises(InputError, match=r"offset: .* s; allowed: -1e\+09 to 1e\+09"):
            align(dive(T), dive(T), offset=offset)


def test_events_put_at_the_same_time() -> None:
    late, measured = 37.0, dive(T + 3.0, late=37.0)
    begun = align(measured, dive(T), "dive")
    # a dive begins at the last sample within a fifth of 5 m of the surface: found to a sample of 6 s in each
    assert begun.shift == pytest.approx(late, abs=6.0)
    assert begun.certainty == pytest.approx(6.0)  # half of 6 s and of 6 s
    fixes, places = T[::10] + 500.0, T
    placed = measured.with_channels(*log(fixes, latitude=0 * fixes, longitude=0 * fixes).channels.values())
    again = dive(T).with_channels(*log(places, latitude=0 * places, longitude=0 * places).channels.values())
    found = align(placed, again, "gps", offset=1.5)
    assert found.shift == pytest.approx(501.5, abs=1e-9)
    assert found.certainty == pytest.approx(33.0)  # half of 60 s and of 6 s


def test_events_that_are_not_there() -> None:
    with pytest.raises(InputError, match="align gps: the measured log has no position; allowed: none, start, dive"):
        align(dive(T), dive(T), "gps")
    flat = log(T, depth=3.0 + 0.0 * T)
    with pytest.raises(InputError, match="align dive: the simulated log has no dive"):
        align(dive(T), flat, "dive")


def test_what_tells_no_time() -> None:
    flat = log(T, depth=3.0 + 0.0 * T)
    with pytest.raises(
        InputError, match="align xcorr: the simulated depth changes by less than 1 m, which tells no time"
    ):
        align(dive(T), flat, "xcorr")
    found = align(dive(T[:1]), dive(T), "start")
    assert found.certainty is None
    assert "a single sample" in found.note


def test_the_clocks_as_they_are_have_no_certainty() -> None:
    found = align(dive(T), dive(T), offset=3.0)
    assert (found.certainty, found.other, found.note) == (None, None, "")


@pytest.mark.parametrize("memory", [0.0, 0.8])
def test_certainty_of_xcorr_is_the_scatter_of_repeated_trials(memory: float) -> None:
    """Noise of 2 m on a dive to 200 m, white or with memory from sample to sample."""
    rng = np.random.default_rng(11)
    shifts, told = [], []
    for _ in range(200):
        noise = rng.normal(0.0, 2.0, len(T))
        for i in range(1, len(T)):
            noise[i] = memory * noise[i - 1] + np.sqrt(1.0 - memory**2) * noise[i]
        found = align(log(T, depth=vee(200.0, 1200.0, 1000.0)(T - 290.0) + noise), dive(T), "xcorr")
        shifts.append(found.shift)
        told.append(found.certainty)
    # the scatter of 200 draws is known to 5 %; at the corners of a dive the slope, so the curvature, changes by 10 %
    assert np.median(told) == pytest.approx(np.std(shifts), rel=0.25)


def test_xcorr_tells_of_another_dive_that_fits_as_well() -> None:
    def yos(t):
        return sum(vee(100.0, 400.0, 400.0)(t - start) for start in (100.0, 1100.0, 2100.0))

    found = align(log(T, depth=yos(T)), log(T[:170], depth=yos(T[:170])), "xcorr")
    assert found.other is not None
    assert abs(found.shift - found.other) in (pytest.approx(1000.0, abs=6.0), pytest.approx(2000.0, abs=6.0))
    assert "about as close" in found.note
    assert align(dive(T, 90.0), dive(T), "xcorr").other is None


@pytest.mark.parametrize(("deeper", "noise"), [(0.0, 0.0), (1.0, 0.0), (0.0, 0.3)])
def test_of_two_like_yos_the_shift_that_lays_both_on_each_other_is_taken(deeper: float, noise: float) -> None:
    """Samples of 5 and of 7 s: on the steps alone the shift by a whole yo can look closer."""

    def yos(t):
        return 100.0 * np.abs(np.sin(np.pi * t / 1800.0))

    t, u = np.arange(0.0, 3601.0, 5.0), np.arange(1.3, 3601.0, 7.0)
    depths = yos(t) + noise * np.random.default_rng(4).normal(size=len(t))
    found = align(log(t, depth=depths), log(u + 123.4, depth=yos(u) + deeper), "xcorr")
    assert found.shift == pytest.approx(-123.4, abs=0.7)  # a tenth of a step of 7 s, as above
    assert found.other in (pytest.approx(-1923.4, abs=7.0), pytest.approx(1676.6, abs=7.0))
    assert "about as close" in found.note


def test_a_shift_within_its_uncertainty_is_called_so() -> None:
    """Errors of tens of metres that hang together for hours, about a dive on the right clock."""
    walk = 40.0 * np.cos((T - 1350.0) / 400.0)
    found = align(log(T, depth=vee(200.0, 1200.0, 1000.0)(T - 200.0) + walk), dive(T), "xcorr")
    assert found.certainty is not None
    assert abs(found.shift) < found.certainty
    assert found.note.endswith("nothing asks for one")
    clear = align(dive(T, 90.0), dive(T), "xcorr")
    assert "nothing asks" not in clear.note
