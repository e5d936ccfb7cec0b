"""Does a table of forces hold a case twice, and does it then say the same? Copies, repeats and contradictions."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.coefficients.forces.columns import FLOW
from glidercli.coefficients.forces.table import Forces
from glidercli.errors import InputError

__all__ = ["Repeats", "repeats"]

_FAR = 0.1
"""Of a force's largest size in the table: repeats of one case that differ by more contradict each other."""
_SAME = 1e-9
"""Relative; text of one number in two programs."""


class Repeats(NamedTuple):
    """copies : row that each row repeats number by number, -1 for none, (n,). notes : on cases measured again."""

    copies: NDArray[np.int64]
    notes: list[str]


def repeats(f: Forces) -> Repeats:
    """Copies of a row count once; repeated cases with other forces are scatter, or a contradiction: InputError."""
    density = np.where(np.isnan(f.density), 0.0, f.density)
    key = np.round(np.column_stack([f.alpha, f.beta, f.speed, f.Omega, density]), 8)
    _, group = np.unique(key, axis=0, return_inverse=True)
    group = group.ravel()
    size = np.array([np.nanmax(np.abs(column)) if (~np.isnan(column)).any() else 0.0 for column in f.measured.T])
    copies = np.full(len(key), -1)
    again: list[str] = []
    against: list[str] = []
    for number in np.flatnonzero(np.bincount(group) > 1):
        rows = np.flatnonzero(group == number)
        kept = [rows[0]]
        for row in rows[1:]:
            same = [other for other in kept if _alike(f.measured[row], f.measured[other], size)]
            if same:
                copies[row] = same[0]
                continue
            off = np.nan_to_num(np.abs(f.measured[row] - f.measured[kept[0]]))
            for i in np.flatnonzero(off > _FAR * size):
                against.append(
                    f"lines {f.lines[kept[0]]} and {f.lines[row]}: one case, and {_two(f, kept[0], row, int(i))}"
                )
            kept.append(row)
        if len(kept) > 1:
            again.append(" and ".join(str(f.lines[row]) for row in kept))
    if against:
        more = f"; {len(against) - 3} more" if len(against) > 3 else ""
        raise InputError(f.path, "; ".join(against[:3]) + more + f"; allowed: within {_FAR:.0%} of the largest")
    shown = "; ".join(again[:5]) + (f"; {len(again) - 5} more" if len(again) > 5 else "")
    return Repeats(
        copies, [f"cases that stand more than once, with other forces each time: lines {shown}"] * bool(again)
    )


def _alike(one: NDArray[np.float64], other: NDArray[np.float64], size: NDArray[np.float64]) -> bool:
    return bool(((np.abs(one - other) <= _SAME * size) | (np.isnan(one) & np.isnan(other))).all())


def _two(f: Forces, first: int, second: int, column: int) -> str:
    name = list(FLOW)[column].replace("_", " ")
    return f"{name} {f.measured[first, column]:.6g} and {f.measured[second, column]:.6g}"
