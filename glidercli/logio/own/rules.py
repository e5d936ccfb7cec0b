"""What of a file of the program's own can be used? One set of rules for its CSV, Parquet, NetCDF and MCAP.

They are those for recordings: a record whose time cannot be read, that holds no value, or that breaks the order of the
others is dropped by name; a cell that is no number, or that the quantity cannot be, is left out and counted. Those of
clocks and of zeros alone are not among them: what this program wrote has been through them, and a simulation may begin
in any year, at rest at the surface.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS, PHASES
from glidercli.log import Channel, Origin
from glidercli.logio.plausible import quantity_of
from glidercli.logio.records import NO_TIME, in_order, sampled

__all__ = ["Shown", "channels_of", "unread_times", "unusable"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

Shown = Callable[[str, int], str]
"""Of a column's name in tables and a record: where the cell stands, and the cell, as "line 4: 'x'"; or ""."""


def channels_of(
    time_ns: Times,
    columns: Mapping[str, Array],
    origins: Mapping[str, Origin],
    dropped: Counter[str],
    warnings: list[str],
    shown: Shown = lambda column, record: "",
) -> tuple[dict[str, Channel], Times]:
    """The channels, some perhaps without a sample, and the times of the records that are kept.

    time_ns : (n,), UTC ns, NO_TIME where it cannot be read. columns : by channel, (n,), SI; NaN where there is no
    sample, infinite where a cell is no number (or no phase). origins : by channel. What is dropped and what is left out
    is added to ``dropped`` and ``warnings``.
    """
    given = np.zeros(len(time_ns), dtype=bool)
    for name, values in columns.items():
        told = np.isin(values, np.arange(len(PHASES))) if name == "phase" else np.isfinite(values)
        given |= told
        if strange := np.flatnonzero(~told & ~np.isnan(values)).tolist():
            column = CHANNELS[name].column
            what = "no phase" if name == "phase" else "no number"
            where = shown(column, strange[0])
            first = f", the first in {where}" if where else ""
            warnings.append(f"{column}: {len(strange)} cells left out that are {what}{first}")
    dated = time_ns != NO_TIME
    for reason, gone in (("time cannot be read", ~dated), ("no value", dated & ~given)):
        if count := int(gone.sum()):
            dropped[reason] += count
    good = dated & given
    good[good] = in_order(time_ns[good], dropped)
    whole = bool(good.all())
    times = time_ns if whole else time_ns[good]
    channels = {
        name: _channel(name, times, values if whole else values[good], origins[name], warnings)
        for name, values in columns.items()
    }
    kept = sampled(times, channels)
    if unused := int((~kept).sum()):
        dropped["no usable value"] += unused
    return channels, times[kept]


def _channel(name: str, time_ns: Times, values: Array, origin: Origin, warnings: list[str]) -> Channel:
    """The channel without what its quantity cannot be, which is counted in the unit of tables."""
    spec, bounds = CHANNELS[name], quantity_of(name)
    inside = (values >= bounds.low) & (values <= bounds.high)  # false where there is no sample
    if name == "phase":
        inside &= np.isin(values, np.arange(len(PHASES)))
    elif outside := int((np.isfinite(values) & ~inside).sum()):
        low, high = (round(bound * spec.factor, 6) + 0.0 for bound in (bounds.low, bounds.high))
        warnings.append(f"{spec.column}: {outside} values outside {low:g}..{high:g} {spec.column_unit} left out")
    return Channel(name, time_ns if inside.all() else time_ns[inside], values[inside], origin)


def unread_times(column: str, time_ns: Times, shown: Shown, needed: str) -> str:
    """A line that shows the first time that cannot be read, and what is needed; "" where all can."""
    bad = np.flatnonzero(time_ns == NO_TIME)
    if not len(bad):
        return ""
    return f"{column}: {len(bad)} times cannot be read, the first in {shown(column, int(bad[0]))}; " + needed


def unusable(dropped: Mapping[str, int], hints: list[str]) -> str:
    """Why a file gave no record: what was dropped, and the first thing to look at."""
    reasons = ", ".join(f"{count} {reason}" for reason, count in dropped.items())
    return "no usable record" + (f": {reasons}" if reasons else "") + (f"; {hints[0]}" if hints else "")
