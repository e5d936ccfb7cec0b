"""Do depth and pressure of a log tell of the same water? Where they do not, one of them is called by a wrong unit.

A metre of water is a decibar to within 3 % (0.98 in a lake, 1.01 at 100 m in the sea, 1.02 at 6000 m by TEOS-10). In
the recordings at hand the median of dbar by m, below 5 m, is 0.98 to 1.02: nine vehicles, dives to 37 m up to 702 m, in
one file or with depth in one and pressure in another. Nothing that is taken for something else comes near: psi for dbar
makes 1.45, foot for metre 0.30, bar for dbar 0.1. So what is off by more than SPREAD is told, with the mistake that
makes it so. No value is changed: which of the two is wrong, and in which samples, the numbers do not tell.
"""

from __future__ import annotations

import numpy as np

from glidercli.log import Log
from glidercli.named_units import conversion, units_of
from glidercli.units import DBAR

__all__ = ["doubt_about_gauges"]

SPREAD = 1.2
"""Midway, by factors, between 1 and 1.45, the nearest that a wrong unit makes."""
BELOW = 5.0
"""m or dbar, by the deeper of the two; nearer to the surface waves and the zeros of the sensors count."""
BESIDE = 10 * 10**9
"""ns; a sample of depth so near to one of pressure goes with it: at 0.3 m/s it is 3 m off, down as often as up."""
LEAST = 10
"""Pairs of samples, fewer of which may be garbled."""
MOST = 100_000
"""Pairs that are looked at; a median of more is the same."""


def doubt_about_gauges(log: Log) -> str:
    """A line where the middle of pressure by depth is not what water makes it, with the likely unit; else nothing."""
    if not {"depth", "pressure"} <= log.channels.keys() or log.origin != "measured":
        return ""
    pressure, depth = log["pressure"], log["depth"]
    every = slice(None, None, len(pressure) // MOST + 1)
    time_ns, dbar = pressure.time_ns[every], pressure.values[every] / DBAR
    after = np.clip(np.searchsorted(depth.time_ns, time_ns), 1, max(len(depth) - 1, 1))
    both = np.stack([after - 1, np.minimum(after, len(depth) - 1)])
    apart = np.abs(depth.time_ns[both] - time_ns)
    metres = depth.values[np.take_along_axis(both, apart.argmin(axis=0)[None], axis=0)[0]]
    pairs = (apart.min(axis=0) <= BESIDE) & (np.maximum(dbar, metres) > BELOW) & (np.minimum(dbar, metres) > 0.0)
    if pairs.sum() < LEAST:
        return ""
    ratio = float(np.median(dbar[pairs] / metres[pairs]))
    if 1.0 / SPREAD <= ratio <= SPREAD:
        return ""
    likely = " or ".join(_mistakes(ratio)) or "no unit that is known explains it"
    return (
        f"pressure and depth disagree: in the middle of {int(pairs.sum())} samples below {BELOW:g} m a metre of depth "
        f"is {ratio:.3g} dbar of pressure, and is 1 dbar in water; likely: {likely}; both are kept as recorded"
    )


def _mistakes(ratio: float) -> list[str]:
    """The units that make such a ratio, dbar by m, where they are taken for dbar or m, or dbar and m for them."""
    found = []
    for channel, right, sign in (("pressure", "dbar", 1), ("depth", "m", -1)):
        size = {unit: c.factor for unit in units_of(channel) if (c := conversion(unit, channel)) is not None}
        for unit in size:
            for true, called in ((unit, right), (right, unit)):
                made = (size[called] / size[true]) ** sign
                if true != called and 1.0 / SPREAD < ratio / made < SPREAD:
                    found.append(f"{channel} in {true} that is called {called}")
    return found
