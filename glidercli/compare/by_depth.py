"""How far is a simulation off at each depth? Errors of the samples that were measured in each band of depth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from glidercli.compare.errors import Errors, statistics
from glidercli.log import Log
from glidercli.residuals import Residuals
from glidercli.units import NANOSECOND

__all__ = ["Band", "by_depth"]

WIDTHS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0)
"""m, of a band where none is asked for: the first that makes at most MOST of them."""
MOST = 6
MOST_BANDS = 10_000
"""More than this is a mistake in the width."""


class Band(NamedTuple):
    """Errors of the samples measured at top <= depth < bottom, m, by channel; those without a sample are left out."""

    top: float
    bottom: float
    channels: Mapping[str, Errors]


def by_depth(
    measured: Log, errors: Mapping[str, Residuals], width: float | None, max_gap: float
) -> tuple[tuple[Band, ...], Mapping[str, int]]:
    """Errors by measured depth; and how many samples of each channel have none, where there are some.

    width : m, of the bands; None for one that makes a few. max_gap : s; a depth is interpolated to the samples of other
    channels, not across longer times between depth samples. Above the surface counts as the first band.
    """
    if "depth" not in measured or not len(measured["depth"]):
        return (), {}
    time_ns, depth = measured["depth"].time_ns, np.maximum(measured["depth"].values, 0.0)
    deepest = float(depth.max())
    if width is None:
        width = next((one for one in WIDTHS if deepest < MOST * one), WIDTHS[-1])
    places = {}
    for name, one in errors.items():
        after = np.clip(np.searchsorted(time_ns, one.time_ns), 0, len(time_ns) - 1)
        before = np.where(time_ns[after] == one.time_ns, after, np.maximum(after - 1, 0))
        known = (one.time_ns >= time_ns[0]) & (one.time_ns <= time_ns[-1])
        known &= (time_ns[after] - time_ns[before]) * NANOSECOND <= max_gap
        at = np.interp(one.time_ns, time_ns, depth)
        places[name] = np.where(known, np.floor(at / width), -1.0)
    bands = []
    for number in np.unique(np.concatenate([*places.values()])):
        if number >= 0.0:
            none = {name: np.zeros(len(one.skipped_ns), bool) for name, one in errors.items()}
            found = {
                name: statistics(one.where(places[name] == number, none[name]))
                for name, one in errors.items()
                if (places[name] == number).any()
            }
            bands.append(Band(float(number * width), float((number + 1.0) * width), found))
    lost = {name: int((place < 0.0).sum()) for name, place in places.items()}
    return tuple(bands), {name: count for name, count in lost.items() if count}
