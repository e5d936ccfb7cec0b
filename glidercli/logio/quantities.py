"""How does a recorded quantity become a channel? Its unit and sign, and what of its values is impossible."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel, Origin
from glidercli.units import DBAR

__all__ = ["Quantity", "channel_of", "channels_from", "degrees", "submerged", "without_sentinels"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

SUBMERGED = 0.5
"""Pressure in dbar below which the conductivity cell may be in air."""


class Quantity(NamedTuple):
    """What a column holds."""

    channel: str
    factor: float
    """Channel value (SI) = factor x recorded value; a sign that differs is in it."""
    low: float
    high: float
    """Recorded values outside of these are impossible."""
    unit: str
    """Of the recorded values, for messages."""


def without_sentinels(name: str, values: Array, sentinels: tuple[float, ...], warnings: list[str]) -> Array:
    """The values, NaN where they are infinite (no number) or a sentinel (no value); both are counted in a warning."""
    texts, marked = np.isinf(values), np.isin(values, sentinels)
    if texts.any():
        warnings.append(f"{name}: {int(texts.sum())} cells left out that are no number")
    if marked.any():
        marks = " or ".join(f"{mark:g}" for mark in sorted(sentinels, reverse=True))
        warnings.append(f"{name}: {int(marked.sum())} cells of {marks} left out, no value")
    return np.where(texts | marked, np.nan, values)


def channel_of(
    name: str, time_ns: Times, values: Array, quantity: Quantity, warnings: list[str], origin: Origin = "measured"
) -> Channel:
    """The channel of a recorded column, without its blanks (NaN) and its impossible values, which are counted.

    time_ns : (n,), UTC ns, strictly increasing. values : (n,), as recorded.
    """
    given = np.isfinite(values)
    inside = given & (values >= quantity.low) & (values <= quantity.high)
    outside = int((given & ~inside).sum())
    if outside:
        warnings.append(
            f"{name}: {outside} values outside {round(quantity.low, 6) + 0.0:g}..{round(quantity.high, 6):g} "
            f"{quantity.unit} left out"
        )
    times = time_ns if inside.all() else time_ns[inside]  # shared, not copied, where nothing is left out
    return Channel(quantity.channel, times, values[inside] * quantity.factor, origin)


def channels_from(
    time_ns: Times, columns: Mapping[str, Array], quantities: Mapping[str, Quantity], warnings: list[str]
) -> dict[str, Channel]:
    """The channels of recorded columns, by name, in the order of ``quantities``.

    Where several give one channel the first that has a sample does; the others are counted. Conductivity counts under
    water alone.
    """
    found: dict[str, Channel] = {}
    for name, quantity in quantities.items():
        if name not in columns:
            continue
        channel = channel_of(name, time_ns, columns[name], quantity, warnings)
        if len(channel) and channel.name in found:
            warnings.append(f"{name}: {len(channel)} values left out, another column gives {channel.name}")
        elif len(channel):
            found[channel.name] = channel
    if "conductivity" in found:
        found["conductivity"] = submerged(found["conductivity"], found.get("pressure"), warnings)
    return found


def submerged(conductivity: Channel, pressure: Channel | None, warnings: list[str]) -> Channel:
    """Conductivity where the cell was surely under water."""
    told = np.array([], np.int64) if pressure is None else pressure.time_ns
    wet = told if pressure is None else told[pressure.values >= SUBMERGED * DBAR]
    under = np.isin(conductivity.time_ns, wet)
    blind = int((~np.isin(conductivity.time_ns, told)).sum())
    shallow = int((~under).sum()) - blind
    if shallow:
        warnings.append(
            f"conductivity: {shallow} values at less than {SUBMERGED:g} dbar left out: the cell may be in air"
        )
    if blind:
        warnings.append(f"conductivity: {blind} values without a pressure left out: the cell may be in air")
    return Channel("conductivity", conductivity.time_ns[under], conductivity.values[under], conductivity.origin)


def degrees(value: Array) -> Array:
    """Degrees from ddmm.mmm, signed; NaN where the minutes are 60 or more, or the value is no number."""
    value = np.where(np.isfinite(value), value, np.nan)
    whole = np.floor(np.abs(value) / 100.0)
    minutes = np.abs(value) - 100.0 * whole
    return np.where(minutes < 60.0, np.sign(value) * (whole + minutes / 60.0), np.nan)
