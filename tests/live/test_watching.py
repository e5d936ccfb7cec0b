"""What does a viewer have after each look at a log that grows? Every sample once, or all anew where a track moved."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from grown_files import appended

from glidercli.live import watching
from glidercli.live.choices import Choices
from glidercli.live.following import Step, newer
from glidercli.live.viewers import Over, Viewers
from glidercli.live.watching import _Watch
from glidercli.log import Channel, Log

T0 = 1_600_000_000 * 10**9


class Shown:
    """A viewer that notes what it is given."""

    name = "a viewer"

    def __init__(self, starts_over: bool) -> None:
        self.starts_over = starts_over
        self.recordings: list[list[Log]] = []
        self.drawn: list[tuple[int, bool]] = []
        self.gone = False

    def begin(self, log: Log, past: Log | None) -> None:
        if past is None:
            self.recordings.append([])
        else:
            assert past.channels.keys() >= log.channels.keys()

    def add(self, piece: Log) -> None:
        self.recordings[-1].append(piece)

    def whole(self, log: Log, whole: Log, panels: bool) -> None:
        self.drawn.append((len(whole["depth"]), panels))

    def clock(self, time_ns: int) -> None:
        assert time_ns >= T0

    def check(self) -> None:
        if self.gone:
            raise ConnectionError("a viewer was closed")

    def close(self, patient: bool) -> None:
        pass


def log(samples: int, shift: float = 0.0, more: bool = False) -> Log:
    times = T0 + np.arange(samples) * 10**9
    channels = [
        Channel("depth", times, np.arange(samples) * 1.0),
        Channel("north", times, np.arange(samples) + shift, "derived"),
    ]
    channels += [Channel("pitch", times, np.zeros(samples))] if more else []
    return Log({channel.name: channel for channel in channels}, "measured")


class Watched:
    def __init__(self) -> None:
        self.said: list[str] = []
        self.viewers = Viewers(Choices(serve=True, follow=True, wait=60.0), self.said.append)
        self.over, self.on = Shown(True), Shown(False)
        self.viewers.all += [self.over, self.on]
        self.watch = _Watch(self.viewers)
        self.last: dict[str, Channel] = {}

    def take(self, now: Log) -> None:
        piece, revised, moved = newer(self.last, now)
        fresh = bool(now.channels.keys() - self.last.keys())
        self.last = dict(now.channels)
        self.watch.take(Step(now, piece, fresh, moved, bool(revised)))


def test_growth_comes_in_pieces_and_is_drawn_in_proportion() -> None:
    see = Watched()
    for samples in range(10, 2000, 10):
        see.take(log(samples))
    for viewer in (see.over, see.on):
        (pieces,) = viewer.recordings
        assert appended(pieces)["depth"].values.tolist() == log(1990)["depth"].values.tolist()
        # at first, and each time that it has more than doubled
        cameras = [count for count, panels in viewer.drawn if panels]
        assert cameras == [10, 30, 70, 150, 310, 630, 1270]
        drawn = np.array([count for count, _ in viewer.drawn])
        early = drawn[1:] <= 1.02 * drawn[:-1]
        assert set(drawn[1:][early]) <= set(cameras)  # the others by more than a fiftieth each
        assert (drawn[1:] - 10 <= 1.02 * drawn[:-1]).all()  # and at the first look that finds so much
        assert viewer.drawn[-1][0] >= 1990 / 1.02 - 10


def test_a_new_channel_joins_without_a_second_recording() -> None:
    see = Watched()
    see.take(log(10))
    see.take(log(20, more=True))
    for viewer in (see.over, see.on):
        (pieces,) = viewer.recordings
        found = appended(pieces)
        assert len(found["depth"]) == len(found["pitch"]) == 20
        assert viewer.drawn[-1] == (20, True)


def test_a_track_that_moved_is_shown_anew_where_that_can_be(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(watching.time, "monotonic", lambda: now[0])
    see = Watched()
    see.take(log(100))
    see.take(log(110, shift=5.0))
    assert [len(appended(pieces)["north"]) for pieces in see.over.recordings] == [100, 110]
    assert appended(see.over.recordings[-1])["north"].values.tolist() == log(110, 5.0)["north"].values.tolist()
    assert [len(appended(pieces)["north"]) for pieces in see.on.recordings] == [110]
    see.take(log(120, shift=9.0))  # within the minute of rest
    assert len(see.over.recordings) == 2
    now[0] += 61.0
    see.watch.take(None)
    assert len(see.over.recordings) == 3
    assert appended(see.over.recordings[-1])["north"].values.tolist() == log(120, 9.0)["north"].values.tolist()


def test_late_samples_of_a_recorded_channel_are_told() -> None:
    whole = log(100)
    gap = dataclasses.replace(whole["depth"], time_ns=whole["depth"].time_ns[50:], values=whole["depth"].values[50:])
    piece, revised, moved = newer({"depth": gap}, whole)
    assert revised == ["depth"]
    assert moved
    assert len(piece["depth"]) == 0


def test_viewers_leave_one_by_one() -> None:
    see = Watched()
    see.take(log(10))
    see.over.gone = True
    see.viewers.check()
    assert see.viewers.all == [see.on]
    see.on.gone = True
    with pytest.raises(Over):
        see.viewers.check()
    assert see.said == ["a viewer was closed; the others go on", "a viewer was closed; no viewer is left"]
