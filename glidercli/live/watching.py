"""How is a log shown while its files grow? What is new goes to the viewers; what turned out otherwise is told anew.

The track and the notes are drawn again as the log grows by a fiftieth, cameras as it doubles, so that what viewers
keep of them stays in proportion to the log.
"""

from __future__ import annotations

import contextlib
import dataclasses
import time
from collections.abc import Callable

from glidercli.live.choices import Choices
from glidercli.live.following import Follower, Step
from glidercli.live.viewers import CHECK, Viewers, opened
from glidercli.log import Log

__all__ = ["follow"]

POLL, SHARE = 1.0, 2.0
"""s between two looks at files, at least, and at least so many times what a look takes."""
GREW, DOUBLED = 1.02, 2.0
"""By how much a log grows until its track is drawn anew, and until cameras are set anew."""
REST = 60.0
"""s, at least, between two times that a viewer is shown all anew."""


def follow(follower: Follower, choices: Choices, tell: Callable[[str], None]) -> None:
    """Show what files hold, and what is added to them, until Ctrl-C or until the last window is closed."""
    with contextlib.suppress(KeyboardInterrupt):
        while (step := follower.look()) is None:
            time.sleep(max(POLL, SHARE * follower.took))
        with opened(step.log, choices, tell) as viewers:
            tell("following; Ctrl-C ends it")
            watch = _Watch(viewers)
            while True:
                watch.take(step)
                until = time.monotonic() + max(POLL, SHARE * follower.took)
                while time.monotonic() < until:
                    viewers.check()
                    time.sleep(CHECK)
                step = follower.look()


class _Watch:
    """What the viewers have been shown of a log that grows."""

    def __init__(self, viewers: Viewers) -> None:
        self._viewers = viewers
        self._shown: Log | None = None
        self._drawn = self._sized = 0
        """Samples when the track, and the cameras, were last made anew."""
        self._moved = self._revised = False
        """Whether what stands in viewers lies elsewhere, or is told otherwise, by now."""
        self._over = time.monotonic()

    def take(self, step: Step | None) -> None:
        """Show what a look gave; None where it gave nothing."""
        if step is None:
            if self._shown is None or not self._moved or time.monotonic() < self._over:
                return
            step = Step.without_news(self._shown)
        self._moved |= step.moved
        self._revised |= step.revised
        log, past = step.log, self._shown and _padded(self._shown, step.log)
        count = sum(map(len, log.channels.values()))
        new = past is None or step.fresh
        grown = new or count > DOUBLED * self._sized
        rested = time.monotonic() >= self._over
        over = past is not None and ((self._moved and rested) or (self._revised and grown))
        groups = [
            (again, [v for v in self._viewers.all if (over and v.starts_over) == again]) for again in (False, True)
        ]
        for again, chosen in groups:
            if new or again:
                self._viewers.each(lambda viewer: viewer.begin(log, None if again else past), chosen)  # noqa: B023
        if grown or over or count > GREW * self._drawn:
            self._viewers.each(lambda viewer: viewer.whole(log, log, panels=grown or over))
            self._drawn = count
        if past is None:
            self._viewers.await_first(needed=False)
        elif new:
            self._viewers.settle()
        for again, chosen in groups:
            self._viewers.each(lambda viewer: viewer.add(log if again else step.piece), chosen)  # noqa: B023
        self._viewers.each(lambda viewer: viewer.clock(log.end_ns))
        if grown or over:
            self._sized = count
        if over:
            self._moved = self._revised = False
            self._over = time.monotonic() + REST
        self._shown = log


def _padded(log: Log, like: Log) -> Log:
    """A log with empty channels for those that only the other has."""
    missing = {
        name: channel.sliced(channel.time_ns[0], channel.time_ns[0])
        for name, channel in like.channels.items()
        if len(channel)
    }
    return dataclasses.replace(log, channels={**missing, **log.channels})
