"""Which depth-averaged currents does a log tell? Those that close its reckoned track, else that of the vehicle itself.

They stand in the metadata: ``closures``, a list with one for each dive between two fixes (derived/closure.py), and
``depth_averaged_current_east_m_s`` and ``_north_m_s`` as the vehicle's own software has them, for a single dive.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from glidercli.log import Log
from glidercli.logio.derived.closure import closures_in
from glidercli.logio.mcap.messages import Array

__all__ = ["averages"]


def averages(log: Log) -> tuple[Array, str]:
    """Rows of time, UTC ns (NaN: unknown), and current to the north and east, m/s, (n, 3); and where they come from."""
    found = [row for item in closures_in(log.metadata.get("closures", "")) if (row := _row(item)) is not None]
    if found:
        return np.array(found), "derived: what the reckoned track of each dive misses at the next fix"
    north, east = (log.number(f"depth_averaged_current_{way}_m_s") for way in ("north", "east"))
    if north is None or east is None:
        return np.empty((0, 3)), ""
    return np.array([[np.nan, north, east]]), "as the vehicle's own software tells it"


def _row(closure: Any) -> list[float] | None:
    """Time of the middle and the current of one closure; None where it is none."""
    try:
        start, end = (
            float(np.datetime64(str(closure[key]).removesuffix("Z")).astype("datetime64[ns]").astype(np.int64))
            for key in ("start", "end")
        )
        row = [0.5 * (start + end), float(closure["current_north_m_s"]), float(closure["current_east_m_s"])]
    except (KeyError, TypeError, ValueError):
        return None
    return row if np.isfinite(row).all() else None
