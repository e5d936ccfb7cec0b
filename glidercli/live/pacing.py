"""When is each sample shown? At its log time, at so many times the speed at which it happened; pauses do not count."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Iterator

from glidercli.log import Log

__all__ = ["Pace", "between"]

STEP, LEAST = 0.2, 0.001
"""s of the clock between two pieces, at most and at least."""
BILLION = 1_000_000_000


class Pace:
    """The log's clock while it is played. rate : log time per time of the clock. clock, sleep : in s."""

    def __init__(
        self, log: Log, rate: float,
        clock: Callable[[], float] = time.monotonic, sleep: Callable[[float], None] = time.sleep,
    ) -> None:  # fmt: skip
        self._log, self._rate = log, rate
        self._clock, self._sleep = clock, sleep
        times = [event.time_ns for event in log.events]
        self.start_ns = min([log.start_ns, *times])
        self.end_ns = max([log.end_ns, *times])
        self._begun = clock()

    def pieces(self) -> Iterator[tuple[int, Log]]:
        """The log's time, UTC ns, and what has happened since the piece before; all have the same channels."""
        shown_ns = self.start_ns
        self._begun = self._clock()
        whole = (self.end_ns - self.start_ns) / (self._rate * BILLION)
        while shown_ns <= self.end_ns:
            passed = self._clock() - self._begun
            now_ns = self.end_ns if passed >= whole else self.start_ns + int(passed * self._rate * BILLION)
            if now_ns >= shown_ns:
                yield now_ns, between(self._log, shown_ns, now_ns + 1)
                shown_ns = now_ns + 1
            if shown_ns <= self.end_ns:
                left = whole - (self._clock() - self._begun)
                self._sleep(min(STEP, max(left, LEAST)))

    def paused(self, seconds: float) -> None:
        """Let so much time of the clock not count."""
        self._begun += seconds


def between(log: Log, start_ns: int, end_ns: int) -> Log:
    """The part with start_ns <= time < end_ns; channels without a sample there are empty."""
    channels = {name: channel.sliced(start_ns, end_ns) for name, channel in log.channels.items()}
    events = tuple(event for event in log.events if start_ns <= event.time_ns < end_ns)
    return dataclasses.replace(log, channels=channels, events=events)
