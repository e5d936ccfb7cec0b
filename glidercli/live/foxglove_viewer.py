"""How do WebSocket viewers show a log? The messages that an .mcap of it would hold, and those that all must have kept.

What shows the whole, and the frames and the hull, are kept for viewers that come late; samples are not.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from itertools import groupby
from operator import itemgetter

from glidercli.errors import InputError
from glidercli.live.foxglove import FoxgloveServer, Message
from glidercli.log import Log
from glidercli.logio.mcap.contents import Contents, statement
from glidercli.logio.mcap.file import Topic
from glidercli.logio.mcap.messages import Messages, Table

__all__ = ["FoxgloveViewer"]

BATCH = 500
"""Messages between two looks whether viewers keep up."""
DRAWN = ("/map/track", "/viz/track")
"""Topics of which only the last message counts."""


class FoxgloveViewer:
    """A WebSocket server that shows a log. port : None for the usual one or another. tell : is told a line each."""

    name = "Foxglove"
    starts_over = False

    def __init__(self, log: Log, port: int | None, tell: Callable[[str], None]) -> None:
        self.server = FoxgloveServer(port, _about(log), tell)
        self._contents = Contents(log)
        self._known: set[tuple[str, int, int]] = set()
        self._due: list[Message] = []

    def begin(self, log: Log, past: Log | None) -> None:
        """Get ready for the channels of a log."""
        if log.start_ns < 0:
            raise InputError("Foxglove", "takes no times before 1970; this log has some")
        self._contents = Contents(log)
        if past is not None:
            for topics in self._contents.samples(past):
                self._announce(topics)

    def add(self, piece: Log) -> None:
        """Send the messages of a piece, and of those that are kept what is due by its end, all in the order of time."""
        for topics in self._contents.samples(piece):
            self._announce(topics)
            tables = [topic for topic in topics if isinstance(topic, Table) and len(topic.time_ns)]
            if not tables:
                continue
            items = [(*item, True) for item in self._taken(max(int(topic.time_ns[-1]) for topic in tables))]
            for topic in tables:
                messages = zip(topic.time_ns.tolist(), topic.payloads(0, len(topic.time_ns)), strict=True)
                items += [(topic.name, time_ns, data, False) for time_ns, data in messages]
            items.sort(key=itemgetter(1))  # at one time in this order
            for keep, run in groupby(items, key=itemgetter(3)):
                batch = [item[:3] for item in run]
                for first in range(0, len(batch), BATCH):
                    self.server.send(batch[first : first + BATCH], keep)

    def whole(self, log: Log, whole: Log, panels: bool) -> None:
        """Let all viewers have track, notes and events, each when its time comes."""
        contents = Contents(whole)
        for topics in contents.samples(whole):
            self._announce(topics)
        told = contents.whole(log)
        self.server.announce(told)
        self.server.forget(DRAWN)
        self._plan(told)

    def clock(self, time_ns: int) -> None:
        """Send the log's time, and what is due by then."""
        self.server.send(self._taken(time_ns), keep=True)
        self.server.clock(time_ns)

    def check(self) -> None:
        """Nothing: viewers come and leave."""

    def close(self, patient: bool) -> None:
        """End the server."""
        self.server.close(patient)

    def _taken(self, time_ns: int) -> list[Message]:
        """What is due by a time, taken from what is planned, in the order of time."""
        due = sorted((item for item in self._due if item[1] <= time_ns), key=itemgetter(1))
        self._due = [item for item in self._due if item[1] > time_ns]
        return due

    def _announce(self, topics: Iterable[Topic]) -> None:
        """Tell of topics, and plan what of them is kept."""
        topics = [topic for topic in topics if len(topic.time_ns)]
        self.server.announce(topics)
        self._plan(topic for topic in topics if isinstance(topic, Messages))

    def _plan(self, topics: Iterable[Topic]) -> None:
        for topic in topics:
            for time_ns, data in zip(topic.time_ns.tolist(), topic.payloads(0, len(topic.time_ns)), strict=True):
                if (known := (topic.name, time_ns, hash(data))) not in self._known:
                    self._known.add(known)
                    self._due.append((topic.name, time_ns, data))


def _about(log: Log) -> Mapping[str, str]:
    """What viewers are told of a log beside its messages: a text for every key."""
    return {"log": statement(log), **{k: v if isinstance(v, str) else json.dumps(v) for k, v in log.metadata.items()}}
