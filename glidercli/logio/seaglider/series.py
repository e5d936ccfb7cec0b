"""Which variables of a .nc share a series of times? Those on its one dimension, with as many values."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.records import NO_TIME
from glidercli.logio.seaglider.netcdf_file import NetcdfFile

__all__ = ["Series", "nanoseconds", "series"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

LATEST = 7e9
"""s since 1970; larger times are garbled."""


class Series(NamedTuple):
    """Variables on one series of times; kind names it in the account."""

    kind: str
    time_ns: Times
    table: dict[str, Array]


def series(file: NetcdfFile, time: str, names: dict[str, str]) -> Series:
    """The variables of these names, by key, that share the dimension of a variable of times."""
    dimension, seconds = file.dimension(time), file.array(time)
    if not dimension:
        return Series("", np.array([], np.int64), {})
    table = {key: file.array(name) for key, name in names.items() if file.dimension(name) == dimension}
    return Series(dimension, nanoseconds(seconds), {k: v for k, v in table.items() if len(v) == len(seconds)})


def nanoseconds(seconds: Array) -> Times:
    """UTC ns of seconds since 1970, to the microsecond that these hold; NO_TIME where there is none."""
    sane = np.abs(seconds) < LATEST
    rounded = np.round(np.where(sane, seconds, 0.0) * 1e6).astype(np.int64) * 1000
    return np.where(sane, rounded, NO_TIME).astype(np.int64)
