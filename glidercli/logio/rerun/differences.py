"""How far are two Logs side by side from each other? Their differences, at the samples of one of them.

The measured log sets the times, and without exactly one the first. The other is interpolated between its own samples,
never across a gap of them and never beyond their ends: there the difference is NaN, which draws as a gap. A difference
has the sign of its plot: depth, which is plotted negative down, is below zero where the other is deeper.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.drawable import origin
from glidercli.residuals import residuals, usual_gap

__all__ = ["Difference", "differences", "reference_first"]


class Difference(NamedTuple):
    """Of one channel, in the table's unit, on the reference's times, UTC ns; NaN where there is none.

    Of depth the values are negative where the other is deeper.
    """

    name: str
    time_ns: NDArray[np.int64]
    values: NDArray[np.float64]
    rms: float
    same_zero: bool
    """Whether both count from the same zero, as far as they tell."""


def reference_first(log: Log, other: Log) -> bool:
    """Whether the first of two logs sets the times, and is what is taken away."""
    return log.origin == "measured" or other.origin != "measured"


def differences(reference: Log, other: Log) -> list[Difference]:
    """Other less reference, of each channel that both have, in the order of the channel table; the phase is a word."""
    found = []
    apart = None not in (origin(reference), origin(other)) and origin(reference) != origin(other)
    for name in CHANNELS:
        if name == "phase" or (apart and name in ("north", "east")):
            continue
        if not all(name in log and len(log[name]) for log in (reference, other)):
            continue
        left = residuals(reference[name], other[name], usual_gap(other[name]))
        if not len(left.error):
            continue
        times = np.concatenate([left.time_ns, left.skipped_ns])
        error = -left.error if name == "depth" else left.error
        values = np.concatenate([error, np.full(len(left.skipped_ns), np.nan)])
        order = np.argsort(times)
        zeros = {log.metadata.get(f"{name}_zero", "") for log in (reference, other)}
        rms = float(np.sqrt(np.mean(left.error**2)))
        found.append(Difference(name, times[order], values[order], rms, len(zeros) == 1))
    return found
