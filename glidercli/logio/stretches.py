"""Which samples of a track hang together? Those of a stretch; between two stretches lies a gap, and no line."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Log
from glidercli.residuals import usual_gap

__all__ = ["Stretches", "alone"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]


class Stretches:
    """The stretches of a track that comes in pieces: a new one begins after each gap.

    A gap is what breaks the lines of plots and sections (usual_gap), so that all that is drawn of a log breaks at the
    same times. LONGEST_GAP, across which nothing is derived, would not do: of a flight that is told every 600 s nothing
    would be left.

    log : the first piece. name : the channel whose sampling tells what is a gap.
    """

    def __init__(self, log: Log, name: str) -> None:
        self._gap = usual_gap(log[name]) if name in log else np.inf
        self._last_ns: int | None = None
        self.gaps = 0

    def of(self, times: Times) -> Array:
        """The number of the stretch that each sample is in, (n,), from 0 on; rows of it can be thinned.

        times : (n,), UTC ns, strictly increasing, after those of the pieces before.
        """
        if not len(times):
            return np.empty(0)
        before = times[0] if self._last_ns is None else self._last_ns
        numbers = self.gaps + np.cumsum(np.diff(times, prepend=before) > self._gap * 1e9)
        self._last_ns, self.gaps = int(times[-1]), int(numbers[-1])
        return numbers.astype(np.float64)

    def told(self) -> str:
        """How many gaps there are so far, in words; "" without one."""
        if not self.gaps:
            return ""
        return f"{self.gaps} gap{'s' if self.gaps > 1 else ''} of more than {self._gap:.0f} s between its samples"


def alone(stretches: Array) -> NDArray[np.int64]:
    """The rows that are the only one of their stretch. stretches : (n,), numbers in order."""
    begins = np.diff(stretches, prepend=-1.0) != 0.0
    return np.flatnonzero(begins & np.append(begins[1:], True))
