"""Analytic flights that the tests of this room compare."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.log import Channel, Log, Origin

START_NS = 1_311_136_080_000_000_000
"""2011-07-20 04:28 UTC."""

Array = NDArray[np.float64]


def ns(seconds: Array) -> NDArray[np.int64]:
    """UTC ns of seconds after the start."""
    return START_NS + np.round(np.asarray(seconds) * 1e9).astype(np.int64)


def channel(name: str, seconds: Array, table_values: Array, origin: Origin = "measured") -> Channel:
    """A channel from values in the table's unit (angles in degrees)."""
    values = np.broadcast_to(np.asarray(table_values, dtype=float), np.shape(seconds)) / CHANNELS[name].factor
    return Channel(name, ns(seconds), values, origin)


def log(
    seconds: Array, origin: Origin = "measured", metadata: Mapping[str, str] | None = None, **columns: Array
) -> Log:
    """A log whose channels share their times; values in the table's units."""
    return Log({name: channel(name, seconds, v, origin) for name, v in columns.items()}, origin, metadata or {})


def vee(deepest: float, down: float, up: float) -> Callable[[Array], Array]:
    """Depth of one dive: straight to ``deepest``, m, in ``down`` s and back in ``up`` s; at the surface outside."""
    return lambda seconds: np.interp(seconds, [0.0, down, down + up], [0.0, deepest, 0.0])
