"""What do the cells of a table in the contract's names tell? Numbers, phases, times."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.logio import number_cells
from glidercli.logio.netcdf.times import FIRST, LAST, ticks
from glidercli.logio.records import NO_TIME, to_ns

__all__ = [
    "ISO_NEEDED", "SECONDS_NEEDED", "has_decimal_comma", "numbers", "phases", "times_of_seconds", "times_of_texts",
    "times_of_timestamps",
]  # fmt: skip

Array = NDArray[np.float64]
Times = NDArray[np.int64]

ISO_NEEDED = "needed is UTC in ISO 8601, as 2019-07-21T23:24:49Z, of the years 1700 to 2200"
SECONDS_NEEDED = "needed are seconds, as 12.5"
_EPOCH_NS = 946_684_800 * 10**9
"""2000-01-01, start of a table that has elapsed_s alone; the same arbitrary date as for a flight without one."""
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d*,\d+([eE][+-]?\d+)?\s*")


def has_decimal_comma(text: str) -> bool:
    """Whether a text is a number but for the comma in it."""
    return _DECIMAL_COMMA.fullmatch(text) is not None


def numbers(cells: Any, decimal: str = ".") -> Array:
    """A pandas Series of texts as numbers: NaN where a cell is empty or says NaN, infinite where it is no number."""
    texts = cells.fillna("").str.strip()
    return number_cells.numbers((texts.str.replace(",", ".", regex=False) if decimal == "," else texts).tolist())


def phases(cells: Any) -> Array:
    """A pandas Series of words as indices into PHASES: NaN where a cell is empty, infinite where it is no phase."""
    stripped = cells.str.strip()
    values = np.full(len(stripped), np.inf)
    values[(stripped.isna() | (stripped == "")).to_numpy()] = np.nan
    for index, phase in enumerate(PHASES):
        values[(stripped == phase).to_numpy()] = index
    return values


def times_of_texts(cells: Any) -> Times:
    """A pandas Series of times in ISO 8601, UTC where they name no zone; UTC ns, NO_TIME where a cell tells none."""
    import pandas as pd

    texts = cells.str.strip().str.replace(",", ".", regex=False)  # ISO 8601 allows a comma before the fraction
    return to_ns(pd.to_datetime(texts, utc=True, errors="coerce", format="ISO8601").dt.tz_localize(None))


def times_of_seconds(elapsed: Array) -> Times:
    """UTC ns of seconds since an arbitrary date; NO_TIME where not finite or centuries away."""
    return ticks(elapsed, _EPOCH_NS, 10**9)


def times_of_timestamps(column: Any) -> Times:
    """An Arrow array of timestamps as UTC ns; NO_TIME where it is null, or outside the years 1700 to 2200."""
    import pyarrow as pa

    rough = column.cast(pa.timestamp("us", column.type.tz), safe=False).cast(pa.int64())
    fine = column.cast(pa.timestamp("ns", column.type.tz), safe=False).cast(pa.int64())
    rough = rough.fill_null(FIRST // 1000 - 1).to_numpy()
    told = (rough > FIRST // 1000) & (rough < LAST // 1000)
    return np.where(told, fine.fill_null(NO_TIME).to_numpy(), NO_TIME)
