"""Which values does the axis of a plot show? All that are drawn, with some room, and two marks where it can be.

Rerun marks an axis at steps of a power of ten, as close as the labels have room for, and fills the plot with whatever a
line does, be it rounding. So the axis is set: no narrower than a sensor or a pilot tells apart, and out to the next
mark where there would be one alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS

__all__ = ["Extent", "axis", "extent", "joined"]

Extent = tuple[float, float]
"""Least and greatest value, in the unit that is drawn."""

NARROWEST = {
    "m": 2.0, "deg": 2.0, "m/s": 0.02, "deg/s": 0.02, "kg": 0.002, "cm3": 2.0, "degC": 0.02, "1": 0.02, "g/kg": 0.02,
    "kg/m3": 0.02, "S/m": 0.002, "dbar": 2.0,
}  # fmt: skip
"""Of each unit of the channel table, what an axis shows at least: some ten times what is told apart in it."""
NARROWEST_OF = {"mass_position": 0.002, "latitude": 2e-4, "longitude": 2e-4}
"""Of channels that vary by less than others of their unit: m, deg, deg."""
HEIGHT, FRAME, LABEL = 700.0, 45.0, 22.0
"""px in a window of 800: of a column of panels, of each one's title and times, and of a label with its distance."""
FURTHEST = 0.7
"""Part of what is drawn by which an axis is stretched to a mark, at most."""
ROOM = 0.06
"""Part of an axis that is left free at each end: half the height of a label in a panel of 120 px."""
CLEAR = 0.8
"""Part of that room that a mark keeps from the end."""


def extent(values: NDArray[np.float64]) -> Extent:
    """Of values, at least one of them a number."""
    return float(np.nanmin(values)), float(np.nanmax(values))


def joined(extents: Iterable[Extent]) -> Extent:
    """The extent of several, at least one."""
    lows, highs = zip(*extents, strict=True)
    return min(lows), max(highs)


def axis(names: Sequence[str], extents: Mapping[str, Extent], panels: int) -> Extent | None:
    """The ends of the axis of a plot of channels, or of their differences; None where their extents are not known.

    panels : how many such plots stand above one another, one less for a taller one. Where marks have no room for labels
    those of the next power of ten count.
    """
    known = [extents[name] for name in names if name in extents]
    if not known:
        return None
    low, high = joined(known)
    least = max(NARROWEST_OF.get(name, NARROWEST[CHANNELS[name].column_unit]) for name in names)
    if high - low < least:
        low, high = 0.5 * (low + high - least), 0.5 * (low + high + least)
    step = 10.0 ** math.floor(math.log10(high - low))
    if high - low > (HEIGHT / panels - FRAME) / LABEL * step:
        step *= 10.0
    low, high = _to_two_marks(low, high, step)
    room = ROOM * (high - low)
    return -_clear(-low + room, step, room), _clear(high + room, step, room)


def _clear(end: float, step: float, room: float) -> float:
    """The upper end of an axis, further out where the label of the mark below it would be cut; also of finer marks."""
    for one in (step, 0.1 * step):
        if end - math.floor(end / one + 1e-9) * one < CLEAR * room and one > room:
            return math.floor(end / one + 1e-9) * one + CLEAR * room
    return end


def _to_two_marks(low: float, high: float, step: float) -> Extent:
    """Stretched to the nearest marks until it holds two; as it is where these are far."""
    first, last = math.ceil(low / step - 1e-6), math.floor(high / step + 1e-6)
    left, right = low, high
    while last - first < 1:
        below, above = left - (first - 1) * step, (last + 1) * step - right
        if below < above:
            first, left = first - 1, (first - 1) * step
        else:
            last, right = last + 1, (last + 1) * step
    return (left, right) if right - left <= (1.0 + FURTHEST) * (high - low) else (low, high)
