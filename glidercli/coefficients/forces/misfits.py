"""Does a column of forces mix units? Rows that no fit of the others can mean, by a fit that a few rows do not move."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.coefficients.forces.columns import FLOW, column_of, spelled
from glidercli.coefficients.forces.table import Forces
from glidercli.errors import InputError

__all__ = ["Misfits", "misfits", "refuse_other_sizes", "refuse_other_units"]

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

_FEW, _OTHER_SIZE = 3, 100.0
"""Cases of each kind, and the ratio of their largest pitch moments, from which on they are told in two units."""
_SHOWN = 8  # lines that an error names


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


def refuse_other_units(f: Forces, measured: str, rows: NDArray[np.int64], other: Mapping[int, str]) -> None:
    """InputError for rows of a table that are told in another unit than the others.

    measured : symbol of eq. (20). rows : of the table, (n,). other : as of ``misfits``, by number among these rows.
    """
    if other:
        lines = ", ".join(str(f.lines[rows[row]]) for row in list(other)[:_SHOWN])
        more = f" and {len(other) - _SHOWN} more" if len(other) > _SHOWN else ""
        told = f"{spelled(column_of(measured))}, {' or '.join(dict.fromkeys(other.values()))}"
        raise InputError(f.path, f"lines {lines}{more}: {told}; one unit is allowed in a column")


def refuse_other_sizes(f: Forces) -> None:
    """InputError for pitch moments of straight and of turning cases that cannot be of one vehicle in one unit."""
    T2 = np.abs(f.measured[:, list(FLOW.values()).index("T2")])
    straight, turning = (T2[(f.kind == kind) & ~np.isnan(T2)] for kind in ("straight", "about-p2"))
    if len(straight) < _FEW or len(turning) < _FEW or not min(straight.max(), turning.max()) > 0.0:
        return
    ratio = float(turning.max() / straight.max())
    if not 1.0 / _OTHER_SIZE < ratio < _OTHER_SIZE:
        raise InputError(
            f.path,
            f"{spelled('pitch_moment')}: the largest of the cases turning about p2 is {ratio:.3g} times that of the "
            "straight ones, as if in another unit; one unit is allowed in a column",
        )
