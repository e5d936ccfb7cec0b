"""Is each sample shown at its time? A clock that is moved by hand; every sample once, in order, none ahead of it."""

from __future__ import annotations

import numpy as np
import pytest

from glidercli.live import showing
from glidercli.live.choices import Choices
from glidercli.live.pacing import Pace
from glidercli.live.viewers import Viewers
from glidercli.log import Channel, Event, Log

BILLION = 10**9
T0 = 1_600_000_000 * BILLION


class Clock:
    def __init__(self) -> None:
        self.now = 5.0
        self.slept: list[float] = []

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now += seconds


def log() -> Log:
    fast, slow = T0 + np.arange(1000) * BILLION, T0 + 7 + np.arange(10) * 100 * BILLION
    channels = {"depth": Channel("depth", fast, np.arange(1000.0)), "pitch": Channel("pitch", slow, np.zeros(10))}
    return Log(channels, "measured", {}, (Event("begin", T0 - 10 * BILLION), Event("end", T0 + 999 * BILLION)))


@pytest.mark.parametrize("rate", [3.0, 333.3, 1e9])
def test_every_sample_comes_once_at_its_time(rate: float) -> None:
    clock, whole = Clock(), log()
    pace = Pace(whole, rate, clock, clock.sleep)
    depth, pitch, events = [], [], []
    for now_ns, piece in pace.pieces():
        assert piece.channels.keys() == whole.channels.keys()
        shown_ns = pace.start_ns + (clock.now - 5.0) * rate * BILLION
        # two roundings of a float of 1e3 s and one to whole ns
        assert abs(now_ns - min(shown_ns, pace.end_ns)) <= 1e3
        for found, name in ((depth, "depth"), (pitch, "pitch")):
            assert (piece[name].time_ns <= now_ns).all()
            found += piece[name].time_ns.tolist()
        events += piece.events
    assert depth == whole["depth"].time_ns.tolist()
    assert pitch == whole["pitch"].time_ns.tolist()
    assert tuple(events) == whole.events
    assert clock.now - 5.0 == pytest.approx(
        1009.0 / rate, rel=1e-9, abs=2e-3
    )  # the last step is a millisecond at least
    assert max(clock.slept, default=0.0) <= 0.2


def test_a_pause_does_not_count() -> None:
    clock, whole = Clock(), log()
    pace = Pace(whole, 10.0, clock, clock.sleep)
    for number, (now_ns, _) in enumerate(pace.pieces()):
        if number == 100:
            clock.now += 1000.0
            pace.paused(1000.0)
        elapsed = clock.now - 5.0 - (1000.0 if number > 100 else 0.0)
        if number != 100:
            assert abs(now_ns - min(pace.start_ns + elapsed * 10.0 * BILLION, pace.end_ns)) <= 1e3
    assert clock.now - 1005.0 == pytest.approx(100.9, abs=2e-3)


def test_the_play_goes_on_where_it_paused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody watches for 1000 s after the hundredth piece."""
    clock = Clock()
    shown: list[int] = []

    class Left(Viewers):
        def show(self, piece: Log, now_ns: int) -> None:
            shown.append(now_ns)

        def await_return(self) -> float:
            clock.now += 1000.0 if len(shown) == 100 else 0.0
            return 1000.0 if len(shown) == 100 else 0.0

        def each(self, *_: object) -> None:
            pass

    monkeypatch.setattr(showing, "Pace", lambda log, rate: Pace(log, rate, clock, clock.sleep))
    showing._play(log(), 10.0, Left(Choices(wait=1.0), print))
    assert len(shown) > 200
    # a step of 0.2 s of the clock, with two roundings of a float of 1e3 s
    assert np.diff(shown).max() <= 2 * BILLION + 1e3
