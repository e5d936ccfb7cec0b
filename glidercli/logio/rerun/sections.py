"""What is the water like along the track? Temperature, salinity, density as colours, at the depth of each sample.

A value has its own time; its depth and its place are those of the track at that time, linear between two samples of it
that are no gap. Where they are unknown nothing is drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.panels import unit_of
from glidercli.logio.rerun.settling import columns, row
from glidercli.logio.round_steps import nice
from glidercli.logio.thinned import Thinned
from glidercli.residuals import usual_gap

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["LIFT", "TALL", "Section", "Sections"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

WATER = (
    (("temperature", "conservative_temperature"), "plasma"),
    (("salinity", "absolute_salinity"), "viridis"),
    (("density",), "cividis"),
    (("conductivity",), "viridis"),
)
"""Of each family the first that the log has, and matplotlib's scale for it; conductivity where there is no salinity."""
MOST = 10_000
"""Points of a section; longer ones are thinned evenly."""
TALL, WIDE = 180, 20
"""Size of a colour bar, in its own units."""
LIFT = 13.0
"""By how much a label's point stands above its mark: the viewer writes below the point, 14 px to the middle of the
text, and a bar's unit is 0.9 px in a window of 1400 x 800, 1.2 px in one of 1920 x 1080."""


class Section(NamedTuple):
    """A quantity that is drawn. over_time, key : entities of the section and of its colour bar."""

    name: str
    over_time: str
    key: str
    world: str | None
    """Entity of the points along the track, if the track is known."""

    @property
    def title(self) -> str:
        """What is coloured, with its unit."""
        return f"{self.name.replace('_', ' ')}, {unit_of(self.name)}"


class Sections:
    """The sections of a log that comes in pieces.

    log : the first piece; what has samples there is what can come. zero_ns : where elapsed begins, UTC ns.
    """

    def __init__(self, log: Log, zero_ns: int) -> None:
        self._zero_ns = zero_ns
        self._depth = next((name for name in ("depth", "down") if name in log and len(log[name])), None)
        told = [(next((n for n in names if n in log and len(log[n])), None), scale) for names, scale in WATER]
        if told[1][0] is not None:
            told = told[:3]
        self._kept = {} if self._depth is None else {name: (Thinned(MOST), scale) for name, scale in told if name}
        self._gap = 0.0 if self._depth is None else usual_gap(log[self._depth])
        self._held: dict[str, tuple[Times, Array]] = {}

    def add(self, piece: Log, times: Times, places: Array) -> None:
        """Keep what is drawn of a piece. times, places : of the track in it, UTC ns, (n, 3), NED, m."""
        if not self._kept or self._depth is None:
            return
        depth = piece[self._depth]
        lines = {"depth": (depth.time_ns, depth.values[:, np.newaxis]), "place": (times, places)}
        for name, (at, values) in lines.items():
            if name in self._held:
                at, values = np.concatenate([self._held[name][0], at]), np.concatenate([self._held[name][1], values])
            if len(at):
                self._held[name] = at[-1:], values[-1:]
            lines[name] = at, values
        for name, (kept, _) in self._kept.items():
            told = piece[name]
            elapsed = (told.time_ns - self._zero_ns).astype(np.float64)
            where = [_between(told.time_ns, *lines[line], self._gap) for line in ("depth", "place")]
            rows = np.column_stack([elapsed, told.values * CHANNELS[name].factor, *where])
            kept.add(rows[np.isfinite(rows[:, 2])])

    def drawn(self, root: str) -> tuple[list[Chunk], list[Section]]:
        """What there is to see so far. root : entity of the sections over time."""
        import rerun as rr

        chunks: list[Chunk] = []
        found: list[Section] = []
        for name, (kept, scale) in self._kept.items():
            rows = kept.rows()
            if len(rows) < 2:
                continue
            low, high = (float(edge) for edge in np.percentile(rows[:, 1], [1.0, 99.0]))
            if not high > low:
                continue
            paint = look.scale(scale, np.clip((rows[:, 1] - low) / (high - low), 0.0, 1.0))
            placed = np.isfinite(rows[:, 3:]).all(axis=1)
            section = Section(name, f"{root}/{name}", f"/key/{name}", f"/world/water/{name}" if placed.any() else None)
            times = self._zero_ns + rows[:, 0].round().astype(np.int64)
            points = [*rr.Scalars.columns(scalars=-rows[:, 2]), *rr.SeriesPoints.columns(colors=look.packed(paint))]
            style = rr.SeriesPoints(marker_sizes=2.5, markers="circle", names=section.title)
            chunks += [row(section.over_time, style), columns(section.over_time, self._zero_ns, times, points)]
            if section.world is not None:
                cloud = rr.Points3D(rows[placed, 3:], colors=paint[placed], radii=rr.Radius.ui_points(2.2))
                chunks.append(row(section.world, cloud))
            chunks += _key(section, scale, low, high)
            found.append(section)
        return chunks, found


def _between(times: Times, at: Times, values: Array, gap: float) -> Array:
    """Values, (m, k), at times, (n,), linear between samples; NaN beyond them and in gaps of more than gap s."""
    found = np.full((len(times), values.shape[1]), np.nan)
    if not len(at):
        return found
    if len(at) == len(times) and np.array_equal(at, times):
        return values
    right = np.clip(np.searchsorted(at, times), min(1, len(at) - 1), len(at) - 1)
    left = np.maximum(right - 1, 0)
    span = (at[right] - at[left]).astype(np.float64)
    part = np.where(span > 0, (times - at[left]) / np.maximum(span, 1.0), 0.0)
    exact = (times == at[left]) | (times == at[right])
    known = exact | ((times > at[left]) & (times < at[right]) & (span <= gap * 1e9))
    found[known] = (values[left] + part[:, np.newaxis] * (values[right] - values[left]))[known]
    return found


def _key(section: Section, scale: str, low: float, high: float) -> list[Chunk]:
    """A colour bar with values and unit."""
    import rerun as rr

    parts = np.linspace(1.0, 0.0, TALL)
    bar = np.repeat(look.scale(scale, parts)[:, np.newaxis, :], WIDE, axis=1)
    step = nice((high - low) / 3.0)
    marks = np.arange(np.ceil(low / step), np.floor(high / step) + 1.0) * step
    digits = max(0, -int(np.floor(np.log10(step))))
    heights = TALL * (1.0 - (marks - low) / (high - low))
    labels = [*(f"{mark:.{digits}f}" for mark in marks), unit_of(section.name)]
    places = [(WIDE + 6.0 + 4.0 * len(word), height - LIFT) for word, height in zip(labels, heights, strict=False)]
    places.append((WIDE / 2 + 14.0, -22.0 - LIFT))
    ticks = rr.LineStrips2D(
        [[(WIDE, height), (WIDE + 5.0, height)] for height in heights],
        colors=look.TEXT, radii=rr.Radius.ui_points(0.6),
    )  # fmt: skip
    return [
        row(f"{section.key}/bar", rr.Image(bar)),
        row(f"{section.key}/ticks", ticks),
        row(f"{section.key}/names", rr.Points2D(places, labels=labels, **look.NAMED)),
    ]
