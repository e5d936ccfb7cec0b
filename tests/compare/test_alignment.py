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
    with pytest.raises(InputError, match="allowed: none, start, xcorr"):
        align(dive(T), dive(T), "best")  # type: ignore[arg-type]
    for offset in (float("nan"), 1e12, -1e300):
        with pytest.raises(InputError, match=r"offset: .* s; allowed: -1e\+09 to 1e\+09"):
            align(dive(T), dive(T), offset=offset)
