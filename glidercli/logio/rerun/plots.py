"""What does a Log look like as lines over time? Each channel in table units, on its own times; phases as states."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.channels import CHANNELS, PHASES
from glidercli.log import Log
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.blueprint import COLOURS, series_name
from glidercli.logio.rerun.settling import columns, row

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Plots"]


class Plots:
    """The channels of a log that comes in pieces, each under /GROUP/NAME; depth is negative down.

    log : the first piece; what has samples there is what can come.
    """

    def __init__(self, log: Log) -> None:
        self._zero_ns = log.start_ns
        self._names = [name for name in CHANNELS if name in log and len(log[name])]
        self._phase = -1.0

    def styles(self) -> Iterator[Chunk]:
        """How each is drawn: lines; heading as points, which do not join 359 to 0; phases as coloured states."""
        import rerun as rr

        for name in self._names:
            entity = _entity(name)
            style: dict[str, Any] = {"names": series_name(name), "colors": COLOURS.get(name, look.GREY)}
            if name == "phase":
                yield row(entity, rr.StateConfiguration(values=PHASES, colors=[*look.PHASE_COLOURS.values()]))
            elif name == "heading":
                yield row(entity, rr.SeriesPoints(marker_sizes=1.5, **style))
            else:
                yield row(entity, rr.SeriesLines(widths=1.5, **style))

    def values(self, piece: Log) -> Iterator[Chunk]:
        """The samples of a piece; of phases those that begin one."""
        import rerun as rr

        for name in self._names:
            channel = piece[name]
            if not len(channel):
                continue
            if name == "phase":
                changed = np.flatnonzero(np.diff(channel.values, prepend=self._phase))
                self._phase = float(channel.values[-1])
                states = [PHASES[int(value)] for value in channel.values[changed]]
                if states:
                    times = channel.time_ns[changed]
                    yield columns(_entity(name), self._zero_ns, times, rr.StateChange.columns(state=states))
                continue
            values = channel.values * (-1.0 if name == "depth" else CHANNELS[name].factor)
            yield columns(_entity(name), self._zero_ns, channel.time_ns, rr.Scalars.columns(scalars=values))


def _entity(name: str) -> str:
    return f"/{CHANNELS[name].group}/{name}"
