"""What is a leg? What holds or steers the actuators on it, and what ends it."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.origins import column_name, origins
from glidercli.simulation.autopilot import GIVEN, Order

__all__ = ["Leg", "held", "read_controls"]

_COLUMNS = ("elapsed_s", "mass_position_m", "mass_rotation_deg", "net_buoyancy_kg")

NO_ORDER = Order(GIVEN, 0.0, GIVEN, 0.0, 0.0, 0.0, 0.0, GIVEN, 0.0, 0.0, 0.0, 0.0, math.inf, 0.0, math.inf)
"""Of a leg whose controls stand in a table."""


@dataclasses.dataclass(frozen=True)
class Leg:
    """A leg of a flight; it ends at the first of its ends.

    times : (n,) s from the start of the leg, increasing. values : (n, 3) mass position (m), mass rotation (rad), net
        buoyancy (kg): a table of controls, linear between knots and held before the first and after the last. Empty
        where ``order`` steers.
    order : what the steering does.
    goes : "down", "up", or "" for whichever way ``until_depth`` lies.
    until_depth : m. until_altitude : m over the bottom. duration : s. turns : of heading, either way. NaN or infinite
        where the leg does not end so.
    surface_ends, bottom_ends : whether surfacing or grounding ends it; else the vehicle is held there and the leg goes
        on.
    keeps : whether the actuators stay where the leg finds them, whatever the order says.
    reconstructed : whether its controls come from a file that says that it is a reconstruction.
    place : where it stands in the mission's file, for messages.
    """

    name: str
    times: NDArray[np.float64] = dataclasses.field(default_factory=lambda: np.empty(0))
    values: NDArray[np.float64] = dataclasses.field(default_factory=lambda: np.empty((0, 3)))
    until_depth: float = math.nan
    reconstructed: bool = False
    order: Order = NO_ORDER
    goes: Literal["down", "up", ""] = ""
    until_altitude: float = math.nan
    duration: float = math.inf
    turns: float = math.inf
    surface_ends: bool = True
    bottom_ends: bool = True
    keeps: bool = False
    place: str = ""

    def __post_init__(self) -> None:
        """Own, writable arrays: the compiled integrator then has one signature."""
        object.__setattr__(self, "times", np.array(self.times, dtype=np.float64, order="C"))
        object.__setattr__(self, "values", np.array(self.values, dtype=np.float64, order="C"))

    @property
    def steered(self) -> bool:
        """Whether controllers set the actuators, not a table."""
        return len(self.times) == 0

    @property
    def ends_by_depth_alone(self) -> bool:
        """Whether a steered leg goes on until it comes to its depth."""
        others = math.isinf(self.duration) and math.isinf(self.turns) and math.isnan(self.until_altitude)
        return self.steered and others and not math.isnan(self.until_depth)

    @property
    def ends_by_time_alone(self) -> bool:
        """Whether the leg lasts its duration whatever happens on it."""
        others = math.isinf(self.turns) and math.isnan(self.until_altitude) and math.isnan(self.until_depth)
        return math.isfinite(self.duration) and others and not (self.surface_ends or self.bottom_ends)

    @property
    def extremes(self) -> NDArray[np.float64]:
        """Least and greatest of each control in the table, (2, 3), NaN where one is; (0, 3) of a steered leg."""
        return np.stack([self.values.min(axis=0), self.values.max(axis=0)]) if len(self.values) else self.values


def held(mass_position: float, mass_rotation: float, net_buoyancy: float) -> Leg:
    """Three controls held for the whole flight (SI, rad)."""
    return Leg("held", np.zeros(1), np.array([[mass_position, mass_rotation, net_buoyancy]]))


def read_controls(path: Path, name: str) -> Leg:
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
    return Leg(name, times, values, reconstructed=reconstructed)
