"""What is told of a Log to Rerun? Styles and the hull first, samples piece by piece, then what shows the whole.

A file and a live connection hold the same chunks; they differ in where these go, and in their ids, alone.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.log import Event, Log
from glidercli.logio.rerun.about import about
from glidercli.logio.rerun.blueprint import blueprint
from glidercli.logio.rerun.plots import Plots
from glidercli.logio.rerun.scene import Scene
from glidercli.logio.rerun.settling import columns, row

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Contents"]

PIECE = 65536
"""Samples of a channel that go into one chunk."""


class Contents:
    """The chunks of a log that comes in pieces.

    log : the first piece, or the whole, without empty channels; what has samples there is what can come.
    """

    def __init__(self, log: Log) -> None:
        self._first = log
        self._end_ns = log.start_ns
        self._plots, self._scene = Plots(log), Scene(log)

    def styles(self) -> list[Chunk]:
        """How things are drawn, and the hull."""
        return [*self._plots.styles(), *self._scene.hull()]

    def samples(self, log: Log) -> Iterator[list[Chunk]]:
        """The chunks of a piece, some at a time."""
        for piece in log.pieces(PIECE):
            yield [*self._plots.values(piece), *self._scene.moving(piece)]
        self._end_ns = max(self._end_ns, log.end_ns)

    def whole(self, log: Log, events: bool = True) -> tuple[list[Chunk], Any]:
        """What can be told when the last piece is there, and the panels, a rerun Blueprint.

        log : that piece, with all events and the final metadata. events : whether they are among what is told.
        """
        import rerun as rr

        whole = dataclasses.replace(log, channels=self._first.channels)
        drawn = self._scene.still(log)
        page = rr.TextDocument(about(whole, drawn.notes), media_type=rr.MediaType.MARKDOWN)
        span_ns = self._end_ns - self._first.start_ns
        views = blueprint(whole, span_ns, drawn.camera, self._scene.has_hull, drawn.has_plan)
        told = self.events(log.events) if events else []
        return [self._header(log), *told, *drawn.chunks, row("/about", page)], views

    def events(self, events: Sequence[Event]) -> list[Chunk]:
        """Events as lines of text."""
        import rerun as rr

        if not events:
            return []
        texts = [e.name if e.depth is None else f"{e.name}, depth {e.depth:.1f} m" for e in events]
        times = np.array([e.time_ns for e in events], dtype=np.int64)
        lines = rr.TextLog.columns(text=texts, level=["INFO"] * len(texts))
        return [columns("/events", self._scene.zero_ns, times, lines)]

    def _header(self, log: Log) -> Chunk:
        """Name and start of the recording."""
        import rerun as rr

        start_ns = self._scene.zero_ns
        name = f"{log.kind} {np.datetime64(start_ns // 10**9, 's')} UTC"
        return row("/__properties", rr.archetypes.RecordingInfo(start_time=start_ns, name=name))
