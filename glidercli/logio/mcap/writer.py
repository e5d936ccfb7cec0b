"""How does a Log become an MCAP file? Piece by piece: its samples, what viewers draw of them, and what it is.

Metadata, attachments and provenance come first in the file where they are known by then, so that `pymcap-cli recover`
keeps them when the end is lost.
"""

from __future__ import annotations

import dataclasses
import mimetypes
from collections.abc import Sequence
from pathlib import Path
from typing import IO

import numpy as np

from glidercli.errors import OutputError
from glidercli.log import Log
from glidercli.logio.mcap.file import McapFile, Topic
from glidercli.logio.mcap.messages import Messages, message, timestamp
from glidercli.logio.mcap.scene import Scene
from glidercli.logio.mcap.topics import ChannelTopics, event_topics
from glidercli.provenance import version

__all__ = ["AT_THE_END", "FORMAT", "FORMATS", "McapLog", "statement", "write_mcap"]

FORMAT = "2"
"""Raised when a reader of the earlier layout would misread a file."""
FORMATS = ("1", FORMAT)
"""Layouts that can be read. In 1 a metadata record that came again replaced the one before it."""
AT_THE_END = ", told at the end"
"""Ending of the name of a metadata record with what came to be known while the file was written."""
PIECE = 65536
"""Samples of a channel that are made into messages at once: at most 60 MB."""


def write_mcap(log: Log, path: Path, attach: Sequence[Path] = ()) -> None:
    """Write the log to ``path`` as MCAP; `read_mcap` gives it back equal to the last bit.

    attach : files that go with it as attachments, under their names.

    Raises OutputError for a time before 1970, which MCAP cannot hold.
    """
    with path.open("wb") as stream:
        file = McapLog(stream, attach)
        file.add(log)
        file.close(log)


class McapLog:
    """A log as MCAP, piece by piece; the same log in the same pieces gives the same bytes."""

    def __init__(self, stream: IO[bytes], attach: Sequence[Path] = ()) -> None:
        self._path, self._attach = Path(stream.name), attach
        self._file = McapFile(stream)
        self._told: dict[str, dict[str, str]] = {}
        self._provenance = False
        self._start_ns: int | None = None
        self._topics: ChannelTopics | None = None

    def add(self, log: Log) -> None:
        """Append a piece, or the whole; all have the same channels, and the first has samples of each that comes."""
        self._check(log)
        if self._topics is None:
            self._start_ns = log.start_ns if any(map(len, log.channels.values())) else None
            self._tell(log)
            self._topics, self._scene = ChannelTopics(log), Scene(log)
        for piece in log.pieces(PIECE):
            with np.errstate(over="ignore", invalid="ignore"):  # absurd samples may overflow in degrees
                self._file.add([*self._scene.topics(piece), *self._topics.tables(piece)])

    def close(self, log: Log) -> None:
        """Finish the file. log : its last piece, with all events and the final metadata."""
        self._check(log)
        log = dataclasses.replace(log, events=tuple(sorted(log.events, key=lambda event: event.time_ns)))
        first = [event.time_ns for event in log.events[:1]]
        start_ns = min([*first, *([] if self._start_ns is None else [self._start_ns])], default=0)
        self._tell(log)
        with np.errstate(over="ignore", invalid="ignore"):
            drawn: list[Topic] = self._scene.lines(log, start_ns)
        lines = _log_lines(log, self._scene.remarks(), start_ns)
        self._file.add([lines, *drawn, *event_topics(log.events)])
        self._file.finish()

    def _check(self, log: Log) -> None:
        times = [int(c.time_ns[0]) for c in log.channels.values() if len(c)] + [event.time_ns for event in log.events]
        if min(times, default=0) < 0:
            raise OutputError(self._path, f"MCAP times start at 1970; the log starts at {min(times)} ns, before that")

    def _tell(self, log: Log) -> None:
        """Write metadata and attachments, those that are not yet there as they are now."""
        if not self._told:
            for path in self._attach:
                kind = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
                self._file.attach(path.name, path, kind, self._start_ns or 0)
        if not self._provenance and "provenance" in log.metadata:
            data = log.metadata["provenance"].encode()
            self._file.attach("provenance.json", data, "application/json", self._start_ns or 0)
            self._provenance = True
        origins = {name: channel.origin for name, channel in log.channels.items()}
        told = {
            "run": dict(log.metadata),
            "origin": {"log": log.origin, "channels": " ".join(log.channels), **origins},
            "version": {"program": f"glidercli {version()}", "format": FORMAT},
        }
        for name, entries in told.items():
            before = self._told.get(name)
            if before is None or not before.keys() <= entries.keys():
                self._file.metadata(name, entries)
            elif before != entries:
                later = {key: text for key, text in entries.items() if before.get(key) != text}
                self._file.metadata(name + AT_THE_END, later)
        self._told = told


def statement(log: Log) -> str:
    """What the log is, plainly: SIMULATED, MEASURED, RECONSTRUCTION: text."""
    text = log.metadata.get("reconstruction", "")
    if log.origin == "reconstruction":
        return f"RECONSTRUCTION: {text}" if text else "RECONSTRUCTION"
    return f"{log.origin.upper()} FROM A RECONSTRUCTION: {text}" if text else log.origin.upper()


def _log_lines(log: Log, remarks: Sequence[str], start_ns: int) -> Messages:
    """The topic /log: first what the log is, then remarks, then the events."""
    from foxglove_schemas_protobuf.Log_pb2 import Log as Line

    lines = [(start_ns, statement(log), "glider")]
    lines += [(start_ns, text, "scene") for text in remarks]
    if "track_note" in log.metadata:
        lines.append((start_ns, log.metadata["track_note"], "track"))
    for event in log.events:
        depth = "" if event.depth is None else f" at {event.depth:.1f} m"
        lines.append((event.time_ns, event.name + depth, "event"))
    messages = [
        message(Line, timestamp=timestamp(at), level=Line.INFO, message=text, name=name) for at, text, name in lines
    ]
    return Messages("/log", np.array([at for at, _, _ in lines], np.int64), messages)
