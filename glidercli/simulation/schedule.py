"""Which controls at which time? Held values, or a table of knots; linear between them."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.origins import column_name, origins

__all__ = ["Schedule", "held", "read_schedule"]

_COLUMNS = ("elapsed_s", "mass_position_m", "mass_rotation_deg", "net_buoyancy_kg")


@dataclasses.dataclass(frozen=True)
class Schedule:
    """Controls of a leg.

    times : (n,) s from the start of the leg, increasing. values : (n, 3) mass position (m), mass rotation (rad), net
    buoyancy (kg). until_depth : m, ends the leg; NaN where none does. Before the first and after the last knot the
    controls are held. reconstructed : whether their file says that it is a reconstruction.
    """

    name: str
    times: NDArray[np.float64]
    values: NDArray[np.float64]
    until_depth: float = math.nan
    reconstructed: bool = False

    def __post_init__(self) -> None:
        """Own, writable arrays: the compiled integrator then has one signature."""
        object.__setattr__(self, "times", np.array(self.times, dtype=np.float64, order="C"))
        object.__setattr__(self, "values", np.array(self.values, dtype=np.float64, order="C"))


def held(mass_position: float, mass_rotation: float, net_buoyancy: float) -> Schedule:
    """Three controls held for the whole flight (SI, rad)."""
    return Schedule("held", np.zeros(1), np.array([[mass_position, mass_rotation, net_buoyancy]]))


def read_schedule(path: Path, name: str, until_depth: float | None) -> Schedule:
    """Controls from a CSV table with elapsed_s, mass_position_m, mass_rotation_deg and net_buoyancy_kg."""
    import pandas as pd

    try:
        table = pd.read_csv(readable_file(path))
    except (UnicodeDecodeError, pd.errors.ParserError) as error:
        raise InputError(path, f"is not a CSV table: {error}") from None
    table.columns = [column_name(str(head)) for head in table.columns]
    if table.columns.has_duplicates:
        raise InputError(path, f"line 1: column {table.columns[table.columns.duplicated()][0]} stands there twice")
    missing = [column for column in _COLUMNS if column not in table]
    if missing:
        raise InputError(path, f"lacks {', '.join(missing)}; needed are {', '.join(_COLUMNS)}")
    for column in _COLUMNS:
        numbers = pd.to_numeric(table[column], errors="coerce").to_numpy(dtype=float)
        bad = np.flatnonzero(~np.isfinite(numbers))
        if len(bad):
            row = int(bad[0])
            raise InputError(path, f"line {row + 2}: {column} = {table[column].iloc[row]}; a finite number is needed")
        table[column] = numbers
    times = table["elapsed_s"].to_numpy(dtype=float)
    back = np.flatnonzero(np.diff(times) <= 0.0)
    if len(back):
        raise InputError(path, f"line {int(back[0]) + 3}: elapsed_s does not increase; increasing times are needed")
    values = np.column_stack(
        [table["mass_position_m"], np.radians(table["mass_rotation_deg"]), table["net_buoyancy_kg"]]
    ).astype(float)
    said = enumerate(table["origin"].fillna("").astype(str), start=2) if "origin" in table else ()
    reconstructed = "reconstruction" in origins(path, said)
    return Schedule(name, times, values, math.nan if until_depth is None else until_depth, reconstructed)
