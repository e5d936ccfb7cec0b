"""What does a Log look like as lines over time? Each channel in table units, on its own times; phases as states."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS, PHASES
from glidercli.log import Log
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.axes import Extent, extent, joined
from glidercli.logio.rerun.panels import COLOURS, series_name
from glidercli.logio.rerun.settling import columns, row
from glidercli.residuals import usual_gap

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Plots", "lines"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
Mask = NDArray[np.bool_]
THICK, THIN, DOT = 2.0, 1.5, 7.0
"""Widths of lines, px. Rerun draws a sample that is joined to no other as a dot, as wide as the line is there."""


def lines(width: float | None, **style: Any) -> Any:
    """The style of a line: of the samples that fall on a pixel the extremes are drawn, not the mean.

    width : px, None where it changes with time.
    """
    import rerun as rr

    return rr.SeriesLines(widths=width, aggregation_policy=rr.components.AggregationPolicy.MinMax, **style)


class Plots:
    """The channels of a log that comes in pieces, each under PLACE/GROUP/NAME; depth is negative down.

    log : the first piece; what has samples there is what can come. zero_ns : where elapsed begins, UTC ns.
    colour, label : of a log that is drawn with others; alone, each line has its own colour, depth that of its phase.
    phases : names of those that came so far. extents : of the values that came so far, by channel.
    """

    def __init__(
        self, log: Log, zero_ns: int, place: str = "", colour: look.Colour | None = None, label: str = ""
    ) -> None:
        self._zero_ns, self._place, self._colour, self._label = zero_ns, place, colour, label
        self._names = [name for name in CHANNELS if name in log and len(log[name])]
        self._by_phase = colour is None and {"depth", "phase"} <= {*self._names}
        self._gaps_ns = {name: int(usual_gap(log[name]) * 1e9) for name in self._names}
        self._held: dict[str, tuple[int, bool]] = {}  # the last sample so far, and whether it is joined to one before
        self._begun: set[str] = set()  # lines whose first sample is drawn
        self.extents: dict[str, Extent] = {}
        self._phase = -1.0
        self._seen: set[int] = set()

    @property
    def phases(self) -> list[str]:
        """Names of the phases that came so far, if depth is coloured by them."""
        return [PHASES[code] for code in sorted(self._seen)] if self._by_phase else []

    def styles(self) -> Iterator[Chunk]:
        """How each is drawn: lines; heading as points, which do not join 359 to 0; phases as coloured states."""
        import rerun as rr

        for name in self._names:
            entity = self._entity(name)
            colour = self._colour or COLOURS.get(name, look.GREY)
            style: dict[str, Any] = {"names": self._label or series_name(name), "colors": colour}
            if name == "phase":
                yield row(entity, rr.StateConfiguration(values=PHASES, colors=[*look.PHASE_COLOURS.values()]))
            elif name == "heading":
                yield row(entity, rr.SeriesPoints(marker_sizes=1.2, markers="circle", **style))
            else:
                if name == "depth" and self._by_phase:
                    del style["colors"]  # what stands still would hide what changes
                yield row(entity, lines(None, **style))

    def values(self, piece: Log) -> Iterator[Chunk]:
        """The samples of a piece; NaN 1 ns after each that a gap follows breaks the line; phases where they begin."""
        import rerun as rr

        for name in self._names:
            channel = piece[name]
            if not len(channel):
                continue
            if name == "phase":
                yield from self._states(piece)
                continue
            values = channel.values * (-1.0 if name == "depth" else CHANNELS[name].factor)
            self._extend(name, values)
            held = [self._held[name][0]] if name in self._held else []
            times = np.concatenate([np.array(held, np.int64), channel.time_ns])
            gaps = np.diff(times) > self._gaps_ns[name]
            rows = np.flatnonzero(gaps) + 1 - len(held)
            at, drawn = np.insert(channel.time_ns, rows, times[:-1][gaps] + 1), np.insert(values, rows, np.nan)
            yield columns(self._entity(name), self._zero_ns, at, rr.Scalars.columns(scalars=drawn))
            to_before = np.concatenate([[self._held[name][1] if held else False], ~gaps])
            yield from self._width(name, times[:-1], ~to_before[:-1] & gaps)
            self._held[name] = int(times[-1]), bool(to_before[-1])

    def ends(self) -> Iterator[Chunk]:
        """What is known of the last samples when no more come: whether they stand alone."""
        for name, (time_ns, is_joined) in self._held.items():
            yield from self._width(name, np.array([time_ns]), np.array([not is_joined]), last=True)

    def _width(self, name: str, times: Times, alone: Mask, last: bool = False) -> Iterator[Chunk]:
        """The width of a line at its first sample, at samples that are joined to no other, and after these.

        It changes back at the NaN after a sample; at the next sample, which Rerun joins to what was drawn before a
        change, that would be a dot, too. last : no NaN follows.
        """
        import rerun as rr

        if name == "heading" or not len(times):  # heading is drawn as points
            return
        usual = THICK if name == "depth" and self._by_phase else THIN
        begins = times[:1][[name not in self._begun and not alone[0]]]
        changes = np.stack([times[alone], times[alone] + 1], axis=-1).ravel()
        widths = np.concatenate([np.full(len(begins), usual), np.tile([DOT, usual], int(alone.sum()))])
        at = np.concatenate([begins, changes])
        if last and alone[-1]:
            at, widths = at[:-1], widths[:-1]
        self._begun.add(name)
        if len(at):
            yield columns(self._entity(name), self._zero_ns, at, rr.SeriesLines.columns(widths=widths))

    def _extend(self, name: str, values: Array) -> None:
        new = extent(values)
        self.extents[name] = joined([self.extents.get(name, new), new])

    def _states(self, piece: Log) -> Iterator[Chunk]:
        """Phases where they begin, and the colour of depth from there on."""
        import rerun as rr

        times, codes = piece["phase"].time_ns, piece["phase"].values.astype(np.int64)
        changed = np.flatnonzero(np.diff(codes, prepend=int(self._phase)))
        if not len(changed):
            return
        states = [PHASES[code] for code in codes[changed]]
        yield columns(self._entity("phase"), self._zero_ns, times[changed], rr.StateChange.columns(state=states))
        if self._by_phase:
            paint = look.packed(np.array([look.PHASE_COLOURS[state] for state in states], dtype=np.uint8))
            begins = times[changed]
            if self._phase < 0.0 and len(piece["depth"]) and piece["depth"].time_ns[0] < begins[0]:
                grey = look.packed(np.array([look.GREY], dtype=np.uint8))
                begins, paint = np.append(piece["depth"].time_ns[:1], begins), np.append(grey, paint)
            yield columns(self._entity("depth"), self._zero_ns, begins, rr.SeriesLines.columns(colors=paint))
        self._phase = float(codes[-1])
        self._seen.update(codes[changed].tolist())

    def _entity(self, name: str) -> str:
        return f"{self._place}/{CHANNELS[name].group}/{name}"
