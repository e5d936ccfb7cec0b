"""What is told of a Log to Rerun? Styles and the hull first, samples piece by piece, then what shows the whole.

A file and a live connection hold the same chunks; they differ in where these go, and in their ids, alone.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Event, Log
from glidercli.logio.drawable import bottom
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun import still
from glidercli.logio.rerun.about import about
from glidercli.logio.rerun.blueprint import Shown, blueprint
from glidercli.logio.rerun.chart import Line, chart
from glidercli.logio.rerun.hull import hull_notes
from glidercli.logio.rerun.panels import ASPECT
from glidercli.logio.rerun.plots import Plots
from glidercli.logio.rerun.scene import Scene
from glidercli.logio.rerun.sea import Sea
from glidercli.logio.rerun.sections import Section, Sections
from glidercli.logio.rerun.settling import columns, row

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["PIECE", "Contents", "header", "texts"]

Array = NDArray[np.float64]
PIECE = 65536
"""Samples of a channel that go into one chunk."""


class Contents:
    """The chunks of a log that comes in pieces.

    log : the first piece, or the whole, without empty channels; what has samples there is what can come.
    """

    def __init__(self, log: Log) -> None:
        self._first = log
        self._zero_ns, self._end_ns = log.start_ns, log.end_ns
        self._plots, self._scene = Plots(log, self._zero_ns), Scene(log, self._zero_ns)
        self._sections = Sections(log, self._zero_ns)

    def styles(self) -> list[Chunk]:
        """How things are drawn, and the hull."""
        return [*self._plots.styles(), *self._scene.hull()]

    def samples(self, log: Log) -> Iterator[list[Chunk]]:
        """The chunks of a piece, some at a time."""
        for piece in log.pieces(PIECE):
            self._sections.add(piece, *self._scene.places(piece))
            yield [*self._plots.values(piece), *self._scene.moving(piece)]
        self._end_ns = max(self._end_ns, log.end_ns)

    def whole(
        self, log: Log, events: bool = True, sections: str | None = "/section", grows: bool = False
    ) -> tuple[list[Chunk], Any]:
        """What can be told when the last piece is there, and the panels, a rerun Blueprint.

        log : that piece, with all events and the final metadata. events : whether they are among what is told.
        sections : entity of the water's sections, which stand in time and therefore cannot be drawn anew under the same
        one; None for none. grows : whether more may come, so that axes are not set.
        """
        import rerun as rr

        whole = dataclasses.replace(log, channels=self._first.channels)
        notes = ["Depth is plotted negative down; plots join samples by straight lines, not across gaps."]
        told = texts(log.events, self._zero_ns) if events else []
        chunks = [header(log, self._zero_ns), *told, *self._scene.rail(), *([] if grows else self._plots.ends())]
        places, mapped = self._scene.fixes(log)
        sea = None
        if self._scene.track.count > 1:
            sea = self._surroundings(log, places, chunks, notes)
        elif self._scene.has_hull:
            notes.append("The log has no track: the hull turns in one place.")
        drawn = still.fixes(places, self._scene.positions.count, "/world")
        water: list[Section] = []
        if sections is not None:
            more, water = self._sections.drawn(sections)
            chunks += more
        chunks, notes = chunks + drawn[0], notes + drawn[1]
        if water:
            notes.append("Sections: each sample of the water at the depth, and the place, of the track at its time.")
        zoom = None
        line = Line("/map", *self._scene.on_map(), mapped, look.ORANGE, look.VIOLET)
        if len(line.track) or len(line.fixes):
            more, zoom = chart([line])
            chunks += more
        if self._scene.has_hull:
            notes += hull_notes(self._first)
        chunks.append(row("/about", rr.TextDocument(about(whole, notes), media_type=rr.MediaType.MARKDOWN)))
        has_current = self._scene.currents.count > 0
        phases, span_ns = self._plots.phases, self._end_ns - self._zero_ns
        extents = {} if grows else self._plots.extents
        shown = Shown(span_ns, sea, self._scene.has_hull, zoom, phases, water, has_current, extents)
        return chunks, blueprint(whole, shown)

    def events(self, events: Sequence[Event]) -> list[Chunk]:
        """Events as lines of text."""
        return texts(events, self._zero_ns)

    def _surroundings(self, log: Log, fixes: Array, chunks: list[Chunk], notes: list[str]) -> Sea:
        """The track, with the sea about it, added to what is drawn and told."""
        import rerun as rr

        rows = self._scene.track.rows()
        sea = Sea.about(rows[:, :3], bottom(log), fixes, ASPECT[1 + self._scene.has_hull])
        scale = rr.Transform3D(scale=[1.0, 1.0, sea.exaggeration])
        chunks.append(row("/world", scale))
        arrows = still.arrows(self._scene.currents.rows(), sea.extent, "/world")
        for drawn in (still.track(rows, "/world", self._scene.stretches.told()), (sea.chunks, sea.notes), arrows):
            chunks += drawn[0]
            notes += drawn[1]
        return sea


def texts(events: Sequence[Event], zero_ns: int, entity: str = "/events", before: str = "") -> list[Chunk]:
    """Events as lines of text. before : what each begins with."""
    import rerun as rr

    if not events:
        return []
    words = [before + (e.name if e.depth is None else f"{e.name}, depth {e.depth:.1f} m") for e in events]
    times = np.array([e.time_ns for e in events], dtype=np.int64)
    lines = rr.TextLog.columns(text=words, level=["INFO"] * len(words))
    return [columns(entity, zero_ns, times, lines)]


def header(log: Log, zero_ns: int) -> Chunk:
    """Name and start of the recording."""
    import rerun as rr

    name = f"{log.kind} {np.datetime64(zero_ns // 10**9, 's')} UTC"
    return row("/__properties", rr.archetypes.RecordingInfo(start_time=zero_ns, name=name))
