"""What is told of several Logs side by side to Rerun? Each in its colour, in one scene; and how far they are apart.

The first stands where it would stand alone; what belongs to the others stands under /beside/1, /beside/2 and so on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.log import Log
from glidercli.logio.apart import TOO_FAR, apart, in_km
from glidercli.logio.drawable import bottom
from glidercli.logio.labels import labels
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun import still
from glidercli.logio.rerun.about import about_several
from glidercli.logio.rerun.axes import Extent, joined
from glidercli.logio.rerun.chart import Line, chart
from glidercli.logio.rerun.clocks import aligned
from glidercli.logio.rerun.contents import PIECE, header, texts
from glidercli.logio.rerun.differences import Difference, differences, reference_first, taken
from glidercli.logio.rerun.hull import hull_notes
from glidercli.logio.rerun.panels import ASPECT, unit_of
from glidercli.logio.rerun.plots import Plots, lines
from glidercli.logio.rerun.scene import Scene
from glidercli.logio.rerun.sea import Sea
from glidercli.logio.rerun.settling import columns, row
from glidercli.logio.rerun.side_by_side import Pair, Side, side_by_side
from glidercli.residuals import Residuals

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Beside"]

NARROWER = 0.9
"""Of the width of a single log's scene: its column has 34 % of the window in place of 37 %."""


class Beside:
    """The chunks of a log, which comes whole, and of others beside it.

    log, others : without empty channels. names : what to call each; default: its kind, numbered where that is not
    enough. Clocks that do not overlap are shifted, see clocks.py. errors : of each other log against this one, by
    channel, where a comparison found them; default: differences by a rule of our own, see differences.py.
    """

    def __init__(
        self,
        log: Log,
        others: Sequence[Log],
        names: Sequence[str] = (),
        errors: Sequence[Mapping[str, Residuals]] = (),
    ) -> None:
        self._errors = errors
        self._logs = [log, *(aligned(log, other) for other in others)]
        self._zero_ns = min(one.start_ns for one in self._logs)
        self._sides: list[Side] = []
        self._plots: list[Plots] = []
        self._scenes: list[Scene] = []
        self._apart = {number: far for number, one in enumerate(self._logs) if number and (far := apart(log, one))}
        for number, one in enumerate(self._logs):
            colour = look.OVERLAID[number % len(look.OVERLAID)]
            place = f"/beside/{number}" if number else ""
            label, short = labels(number, self._logs, names)
            self._plots.append(Plots(one, self._zero_ns, place, colour, short))
            far, about = self._apart.get(number), log.place if number else None
            about, moved = (about, (0.0, 0.0)) if far is None else (far.about, far.moved)
            self._scenes.append(Scene(one, self._zero_ns, f"/world{place}", colour, about, moved))
            scene = self._scenes[-1]
            self._sides.append(Side(one, label, short, place, colour, scene.vehicle, scene.has_hull))

    def styles(self) -> list[Chunk]:
        """How things are drawn, and the hulls."""
        return [
            *(chunk for plots in self._plots for chunk in plots.styles()),
            *(chunk for scene in self._scenes for chunk in scene.hull()),
        ]

    def samples(self, log: Log) -> Iterator[list[Chunk]]:
        """The chunks of all logs, some at a time. log : the first, as a whole."""
        for one, plots, scene in zip([log, *self._logs[1:]], self._plots, self._scenes, strict=True):
            for piece in one.pieces(PIECE):
                yield [*plots.values(piece), *scene.moving(piece)]

    def whole(self, log: Log) -> tuple[list[Chunk], Any]:
        """What can be told at the end, and the panels. log : the first, with its final metadata."""
        import rerun as rr

        notes = ["Depth is plotted negative down; plots join samples by straight lines, not across gaps."]
        notes.append("Elapsed counts from the first sample of all.")
        chunks = [header(log, self._zero_ns), *(chunk for plots in self._plots for chunk in plots.ends())]
        for side, scene in zip(self._sides, self._scenes, strict=True):
            chunks += texts(side.log.events, self._zero_ns, f"{side.place}/events", f"{side.short}: ")
            chunks += scene.rail()
            notes += [f"{side.short}: {note}" for note in (hull_notes(side.log) if side.has_hull else [])]
        sea = self._surroundings(chunks, notes)
        told = [scene.fixes(side.log) for side, scene in zip(self._sides, self._scenes, strict=True)]
        mapped_lines = [
            Line(scene.map, *scene.on_map(), mapped, side.colour, side.colour)
            for side, scene, (_, mapped) in zip(self._sides, self._scenes, told, strict=True)
        ]
        zoom = None
        if any(len(line.track) or len(line.fixes) for line in mapped_lines):
            more, zoom = chart(mapped_lines)
            chunks += more
        pairs = [self._pair(number, notes, chunks) for number in range(1, len(self._logs))]
        sides = [(side.label, look.NAMES[side.colour], side.log) for side in self._sides]
        page = rr.TextDocument(about_several(sides, notes), media_type=rr.MediaType.MARKDOWN)
        chunks.append(row("/about", page))
        span_ns = max(one.end_ns for one in self._logs) - self._zero_ns
        return chunks, side_by_side(self._sides, pairs, sea, zoom, span_ns, self._extents(), self._own_starts())

    def _extents(self) -> dict[str, Extent]:
        """Of the values of each channel in all logs."""
        names = {name for plots in self._plots for name in plots.extents}
        return {name: joined(plots.extents[name] for plots in self._plots if name in plots.extents) for name in names}

    def _own_starts(self) -> str:
        """Of tracks that are not where they were: how far apart they began, for a title."""
        words = sorted({in_km(far.distance): far.distance for far in self._apart.values()}.items(), key=lambda w: w[1])
        if not words:
            return ""
        return f"each from its own start, {words[0][0] + ' to ' if len(words) > 1 else ''}{words[-1][0]} apart"

    def _surroundings(self, chunks: list[Chunk], notes: list[str]) -> Sea | None:
        """All tracks, with the sea about them, added to what is drawn and told."""
        import rerun as rr

        tracks = [scene.drawn_track() for scene in self._scenes]
        if not any(len(rows) > 1 for rows in tracks):
            return None
        depths = [depth for depth in map(bottom, self._logs) if depth is not None]
        places = np.concatenate([rows[:, :3] for rows in tracks])
        aspect = NARROWER * ASPECT[1 + any(side.has_hull for side in self._sides)]
        sea = Sea.about(places, max(depths, default=None), np.empty((0, 3)), aspect)
        chunks += [row("/world", rr.Transform3D(scale=[1.0, 1.0, sea.exaggeration])), *sea.chunks]
        notes += sea.notes
        for side, scene, rows in zip(self._sides, self._scenes, tracks, strict=True):
            if len(rows) > 1:
                drawn, told = still.track(rows, f"/world{side.place}", scene.stretches.told(), side.colour)
                chunks += drawn
                notes += [f"{side.short}: {note}" for note in told]
        if len(tracks) > 1 and any(one.place is None for one in self._logs):
            notes.append("Not every log tells where on the globe it was: each track is drawn about its own origin.")
        for number, far in self._apart.items():
            who, first = self._sides[number].short, self._sides[0].short
            notes.append(
                f"{who} began {in_km(far.distance)} from {first}, more than {TOO_FAR:g} times the size of a track; "
                "in one scene both would be dots. Its track is drawn from the same start; the map has both in place."
            )
        return sea

    def _pair(self, number: int, notes: list[str], chunks: list[Chunk]) -> Pair:
        """How far a log is from the first, added to what is drawn and told."""
        sides = self._sides[0], self._sides[number]
        first = bool(self._errors) or reference_first(sides[0].log, sides[1].log)
        reference, other = sides if first else sides[::-1]
        if self._errors:
            found = taken(self._errors[number - 1], reference.log, other.log)
        else:
            found = differences(reference.log, other.log)
        pair = Pair(other, reference, f"/difference/{number}", sides[1].colour, found)
        for one in found:
            chunks += self._drawn(one, pair)
        unlike = [one.name.replace("_", " ") for one in found if not one.same_zero]
        if found:
            notes.append(
                f"Differences: {pair.title}, at the samples of {reference.short}; {other.short} is interpolated "
                "between its own samples, not across gaps of them. Angles are differences on the circle. "
                f"That of depth is positive where {other.short} is deeper, though depth is plotted negative down."
            )
            rms = ", ".join(f"{one.name.replace('_', ' ')} {one.rms:.3g} {unit_of(one.name)}" for one in found)
            notes.append(f"Root of the mean square of {pair.title}: {rms}.")
        if unlike:
            notes.append(f"Counted from different zeros, which is in the difference: {', '.join(unlike)}.")
        return pair

    def _drawn(self, one: Difference, pair: Pair) -> list[Chunk]:
        import rerun as rr

        entity = f"{pair.place}/{one.name}"
        style: dict[str, Any] = {"names": pair.title, "colors": pair.colour}
        points = dict[str, Any](marker_sizes=1.2, markers="circle", **style)
        drawn = lines(1.5, **style) if pair.drawn_as_lines(one.name) else rr.SeriesPoints(**points)
        values = rr.Scalars.columns(scalars=one.values)
        return [row(entity, drawn), columns(entity, self._zero_ns, one.time_ns, values)]
