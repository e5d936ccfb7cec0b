"""Which numbers do the cells of a text hold? NaN where a cell is blank, infinite where it is no number."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["numbers"]


def numbers(texts: Sequence[str]) -> NDArray[np.float64]:
    """Values of trimmed texts, (n,): NaN where one is empty or "nan", infinite where it is no number."""
    import pandas as pd

    values = pd.to_numeric(pd.Series(texts, dtype=object), errors="coerce").to_numpy(dtype=float, copy=True)
    told = np.array([text.lower() not in ("", "nan") for text in texts], dtype=bool)
    values[told & np.isnan(values)] = np.inf
    return values
