"""What is told of a Log in Foxglove's messages? Its samples and the scene piece by piece, then what shows the whole.

A file and a live connection hold the same messages; they differ in where these go alone.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence

import numpy as np

from glidercli.log import Log
from glidercli.logio.mcap.file import Topic
from glidercli.logio.mcap.messages import Messages, message, timestamp
from glidercli.logio.mcap.scene import Scene
from glidercli.logio.mcap.side import ALONE, Side
from glidercli.logio.mcap.topics import ChannelTopics, event_topics

__all__ = ["Contents", "Line", "log_topic", "statement"]

PIECE = 65536
"""Samples of a channel that are made into messages at once: at most 60 MB."""


Line = tuple[int, str, str]
"""Of the topic /log: when, UTC ns, what, and by whom."""


class Contents:
    """The topics of a log that comes in pieces.

    log : the first piece, or the whole; what has samples there is what can come. side : which of the flights in the
    file it is.
    """

    def __init__(self, log: Log, side: Side = ALONE) -> None:
        self._side = side
        self._start_ns = log.start_ns if any(map(len, log.channels.values())) else None
        self._topics, self.scene = ChannelTopics(log, side.package), Scene(side.drawn(log), side)

    def samples(self, log: Log) -> Iterator[list[Topic]]:
        """The messages of a piece, some topics at a time; transforms first."""
        for piece in log.pieces(PIECE):
            with np.errstate(over="ignore", invalid="ignore"):  # absurd samples may overflow in degrees
                yield self._placed([*self.scene.topics(self._side.drawn(piece)), *self._topics.tables(piece)])

    def whole(self, log: Log) -> list[Topic]:
        """What can be told when the last piece is there. log : that piece, with all events and the final metadata."""
        lines, drawn = self.parts(log)
        return [log_topic(lines), *drawn]

    def parts(self, log: Log) -> tuple[list[Line], list[Topic]]:
        """The lines of the topic /log, and the other topics of ``whole``."""
        log = dataclasses.replace(log, events=tuple(sorted(log.events, key=lambda event: event.time_ns)))
        first = [event.time_ns for event in log.events[:1]]
        start_ns = min([*first, *([] if self._start_ns is None else [self._start_ns])], default=0)
        with np.errstate(over="ignore", invalid="ignore"):
            drawn: list[Topic] = self.scene.lines(self._side.drawn(log), start_ns)
        events = event_topics(log.events, self._side.package)
        return _lines(log, self.scene.remarks(), start_ns), self._placed([*drawn, *events])

    def _placed(self, topics: Sequence[Topic]) -> list[Topic]:
        """The topics under the names that they have in the file."""
        return [dataclasses.replace(topic, name=self._side.place + topic.name) for topic in topics]


def statement(log: Log) -> str:
    """What the log is, plainly: SIMULATED, MEASURED, RECONSTRUCTION: text."""
    text = log.metadata.get("reconstruction", "")
    if log.origin == "reconstruction":
        return f"RECONSTRUCTION: {text}" if text else "RECONSTRUCTION"
    return f"{log.origin.upper()} FROM A RECONSTRUCTION: {text}" if text else log.origin.upper()


def _lines(log: Log, remarks: Sequence[str], start_ns: int) -> list[Line]:
    """First what the log is, then remarks, then the events."""
    lines = [(start_ns, statement(log), "glider")]
    lines += [(start_ns, text, "scene") for text in remarks]
    if "track_note" in log.metadata:
        lines.append((start_ns, log.metadata["track_note"], "track"))
    for event in log.events:
        depth = "" if event.depth is None else f" at {event.depth:.1f} m"
        lines.append((event.time_ns, event.name + depth, "event"))
    return lines


def log_topic(lines: Sequence[Line]) -> Messages:
    """The topic /log."""
    from foxglove_schemas_protobuf.Log_pb2 import Log as Said

    messages = [
        message(Said, timestamp=timestamp(at), level=Said.INFO, message=text, name=name) for at, text, name in lines
    ]
    return Messages("/log", np.array([at for at, _, _ in lines], np.int64), messages)
