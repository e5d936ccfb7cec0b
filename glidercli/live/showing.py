"""How does a log go to its viewers, and when is that over? At once or at a pace.

Over is it when the user says so by Ctrl-C, when the last window is closed, or when a play that only a WebSocket shows
has come to its end. All of these are normal ends.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable

from glidercli.live.choices import Choices
from glidercli.live.pacing import Pace
from glidercli.live.viewers import Viewers, opened
from glidercli.log import Log

__all__ = ["show"]


def show(log: Log, choices: Choices, tell: Callable[[str], None]) -> None:
    """Show a log that is known as a whole; returns when that is over, and ends all that it started.

    tell : is told, a line each, where to look and what happens to viewers.
    """
    with contextlib.suppress(KeyboardInterrupt), opened(log, choices, tell) as viewers:
        viewers.each(lambda viewer: viewer.begin(log, None))
        viewers.each(lambda viewer: viewer.whole(log, log, panels=True))
        if choices.pace is None:
            viewers.each(lambda viewer: viewer.add(log))
        else:
            viewers.await_first(needed=True)
            _play(log, choices.pace, viewers)
        viewers.stay()


def _play(log: Log, rate: float, viewers: Viewers) -> None:
    pace = Pace(log, rate)
    viewers.each(lambda viewer: viewer.clock(pace.start_ns))
    for now_ns, piece in pace.pieces():
        viewers.show(piece, now_ns)
        if now_ns < pace.end_ns:
            pace.paused(viewers.await_return())
