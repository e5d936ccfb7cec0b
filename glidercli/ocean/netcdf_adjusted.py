"""Which values of an Argo file count? The adjusted ones of the profiles that have them, else those as recorded.

Argo user's manual 3.4, sections 2.2.3 and 2.2.5: beside PRES, TEMP and PSAL stand PRES_ADJUSTED and so on, which are
empty while DATA_MODE of a profile is R (real time), and are to be used where it is A (adjusted in real time) or D
(delayed mode); a value that was found bad beyond mending is empty there. The first profile is that of the primary
sampling; others of the same time are of the same descent or ascent.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.ocean.netcdf import NcFile
from glidercli.ocean.netcdf_layout import Layout

__all__ = ["Column", "adjusted", "is_argo", "repeats"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_END, _MODE = "_ADJUSTED", "DATA_MODE"


class Column(NamedTuple):
    """A quantity by profile and sample, (profiles, samples) each. name : of its variable. bad : where flagged so."""

    name: str
    values: Array
    bad: Mask


def is_argo(file: NcFile) -> bool:
    """Whether a file tells modes of data as Argo does."""
    return _MODE in file.variables


def adjusted(file: NcFile, layout: Layout, columns: dict[str, Column]) -> dict[str, Column]:
    """The columns, by quantity, with the adjusted values of the profiles that have them; a remark says of how many.

    Without DATA_MODE they are those whose adjusted values are there for all columns that have any.
    """
    twins = {quantity: file.variables.get(column.name + _END) for quantity, column in columns.items()}
    found: dict[str, Column] = {}
    for quantity, variable in twins.items():
        if variable is not None and variable.dimensions == file.variables[columns[quantity].name].dimensions:
            tables = [
                layout.table(file.path, variable, part, empty)
                for part, empty in zip(file.values(variable, quantity), (np.nan, False), strict=True)
            ]
            found[quantity] = Column(variable.name, *tables)
    if not found:
        return columns
    modes = _modes(file, layout)
    if modes is None:
        use = np.all([np.isfinite(column.values).any(axis=1) for column in found.values()], axis=0)
    else:
        use = np.isin(modes, [b"A", b"D"])
    if use.any():
        names = ", ".join(column.name for column in found.values())
        of = "" if modes is None else f" ({_MODE} {', '.join(sorted({mode.decode() for mode in modes[use]}))})"
        file.remarks.append(f"{names} are used of {int(use.sum())} of {len(use)} profiles{of}")
    chosen = {
        quantity: Column(
            column.name,
            np.where(use[:, np.newaxis], found[quantity].values, column.values),
            np.where(use[:, np.newaxis], found[quantity].bad, column.bad),
        )
        for quantity, column in columns.items()
        if quantity in found
    }
    return columns | chosen


def _modes(file: NcFile, layout: Layout) -> NDArray[np.bytes_] | None:
    """DATA_MODE of each profile; None where the file does not tell it."""
    if not is_argo(file) or file.variables[_MODE].size != layout.profiles or file.variables[_MODE].dtype != "S1":
        return None
    return np.asarray(np.ma.filled(np.ma.asarray(file.variables[_MODE][...]), b" "), dtype="S1").ravel()


def repeats(times: Array) -> Mask:
    """Which profiles have the time of one before, (n,); none that has no time. times : (n,), s."""
    first = np.zeros(len(times), dtype=bool)
    first[np.unique(times, return_index=True)[1]] = True
    return ~first & np.isfinite(times)
