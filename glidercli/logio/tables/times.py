"""When was each row of a table? Texts and numbers of the formats that a mapping may name, as UTC ns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.netcdf.times import ticks, zero_and_unit
from glidercli.logio.own.cells import times_of_timestamps
from glidercli.logio.records import NO_TIME, to_ns
from glidercli.logio.tables.cells import numbers, words
from glidercli.logio.tables.mapping import NUMBERS, Missing, Time

__all__ = ["times_of"]

Times = NDArray[np.int64]

HOUR = 3600 * 10**9
MATLAB_1970 = 719529.0
"""MATLAB's datenum of 1970-01-01, days."""
ZONED = r"\d[Tt ]\d.*(Z|z|[+-]\d\d(:?\d\d)?)$"
"""An ISO time that tells its own zone."""


def times_of(columns: Mapping[str, Any], time: Time, missing: Missing, decimal: str) -> Times:
    """The times of the rows, (n,), UTC ns; NO_TIME where a cell tells none.

    Texts that tell their own zone are not shifted by utc_offset_h, nor are timestamps of Parquet.
    """
    import pyarrow as pa
    from pyarrow import compute as pc

    first = columns[time.names[0]]
    if pa.types.is_timestamp(first.type):
        return times_of_timestamps(first)
    shift = round(time.utc_offset_h * HOUR)
    if time.format in NUMBERS or " since " in time.format:
        values = numbers(first, missing, decimal)
        time_ns = _of_numbers(values, time.format)
        zoned = np.zeros(len(time_ns), dtype=bool)
    else:
        parts = [words(columns[name], missing) for name in time.names]
        texts = pc.binary_join_element_wise(*parts, " ") if len(parts) > 1 else parts[0]
        time_ns = _of_texts(texts, time.format)
        own_zone = ZONED if time.format == "iso" else "^$"
        zoned = pc.match_substring_regex(texts, own_zone).fill_null(False).to_numpy(zero_copy_only=False)
        zoned = zoned | ("%z" in time.format)
    return np.where((time_ns == NO_TIME) | zoned, time_ns, time_ns - shift)


def _of_numbers(values: NDArray[np.float64], form: str) -> Times:
    """Times that are counted."""
    if form == "matlab":
        return ticks(values - MATLAB_1970, 0, 24 * HOUR)
    if form in NUMBERS:
        return ticks(values, 0, 10**9 if form == "unix" else 10**6)
    return ticks(values, *zero_and_unit(form))


def _of_texts(texts: Any, form: str) -> Times:
    """Times that are written out."""
    import pandas as pd

    series = pd.Series(texts.to_numpy(zero_copy_only=False), dtype=object)
    pattern = "ISO8601" if form == "iso" else form
    parsed = pd.to_datetime(series, utc=True, errors="coerce", format=pattern).dt.tz_localize(None)
    return to_ns(parsed)
