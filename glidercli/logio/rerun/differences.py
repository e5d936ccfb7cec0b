"""How far are two Logs side by side from each other? Their differences, at the samples of one of them.

The measured log sets the times, and without exactly one the first. The other is interpolated between its own samples,
never across a gap of them and never beyond their ends: there the difference is NaN, which draws as a gap. Errors that a
comparison has found are taken as they are.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.residuals import Residuals, residuals, usual_gap

__all__ = ["Difference", "differences", "reference_first", "taken"]


class Difference(NamedTuple):
    """Of one channel, in the table's unit, on the reference's times, UTC ns; NaN where there is none."""

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
    for name in CHANNELS:
        if name == "phase" or (_apart(reference, other) and name in ("north", "east")):
            continue
        if not all(name in log and len(log[name]) for log in (reference, other)):
            continue
        left = residuals(reference[name], other[name], usual_gap(other[name]))
        if len(left.error):
            found.append(_difference(left, reference, other))
    return found


def taken(errors: Mapping[str, Residuals], reference: Log, other: Log) -> list[Difference]:
    """Errors that a comparison of two logs found, by channel; those without a sample compared are no difference."""
    return [_difference(left, reference, other) for left in errors.values() if len(left.error)]


def _difference(left: Residuals, reference: Log, other: Log) -> Difference:
    times, values = left.with_gaps()
    zeros = {log.metadata.get(f"{left.name}_zero", "") for log in (reference, other)}
    same = len(zeros) == 1 and not (left.name in ("north", "east") and _apart(reference, other))
    return Difference(left.name, times, values, float(np.sqrt(np.mean(left.error**2))), same)


def _apart(reference: Log, other: Log) -> bool:
    """Whether both tell the origin that north and east are counted from, and it is not the same."""
    return None not in (reference.place, other.place) and reference.place != other.place
