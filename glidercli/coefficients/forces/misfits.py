"""Does a column of forces mix units? Rows that no fit of the others can mean, by a fit that a few rows do not move."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Misfits", "misfits"]

Array = NDArray[np.float64]

_FACTORS = {
    1000.0: "as if in thousandths of the unit", 1e-3: "as if in thousands of the unit",
    9.80665: "as if in newtons among kilograms-force", 1.0 / 9.80665: "as if in kilograms-force among newtons",
}  # fmt: skip
"""What a value may be of the fit where it is told in another unit than the others."""
_NEAR = 0.15
"""How near to a factor, relative: what scatter and eq. (20) leave of a row."""
_CLEAR = 0.2
"""Of the largest fitted value: below it a row is too close to zero for its factor to mean anything."""
_GROSS = 0.5
"""Of the largest fitted value: a residual beyond it, and beyond ten times the median one, is no scatter."""
_MOST = 0.4
"""Of the rows; with more of them odd, nobody can say which are right."""


class Misfits(NamedTuple):
    """Rows in another unit than the others, with what they look like, and rows that are far off for no such reason."""

    other_unit: dict[int, str]
    far_off: list[int]


def misfits(X: Array, y: Array) -> Misfits:
    """Rows of y (n,) that no x of the others means, with X (n, k) the regressors.

    x is that of the least sum of absolute residuals, by iterated weights: a minority of wild rows does not move it.
    """
    weights: NDArray[Any] = np.ones(len(y))
    x = np.zeros(X.shape[1])
    for _ in range(60):
        root = np.sqrt(weights)
        x = np.linalg.lstsq(X * root[:, None], y * root, rcond=None)[0]
        off = np.abs(y - X @ x)
        weights = 1.0 / np.maximum(off, 1e-6 * max(float(np.median(np.abs(y))), 1e-300))
    fit = X @ x
    off = np.abs(y - fit)
    size = float(np.abs(fit).max())
    odd = (off > _GROSS * size) & (off > 10.0 * float(np.median(off)))
    odd |= (np.abs(fit) > _CLEAR * size) & (off > _GROSS * np.abs(fit)) & (off > 10.0 * float(np.median(off)))
    if not 0 < odd.sum() <= _MOST * len(y):
        return Misfits({}, [])
    other: dict[int, str] = {}
    for row in np.flatnonzero(odd & (np.abs(fit) > _CLEAR * size)).tolist():
        for factor, told in _FACTORS.items():
            if abs(y[row] / fit[row] / factor - 1.0) < _NEAR:
                other[row] = told
    return Misfits(other, [row for row in np.flatnonzero(odd).tolist() if row not in other])
