"""What is kept of a flight at one time? The state and the controls; and what they mean, worked out afterwards."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import dot, rotation_ned_body
from glidercli.kernel import kernel
from glidercli.model.mass import placement, velocity
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Sea, at_depth
from glidercli.simulation.stepper import ENERGY, SIZE, state_of

__all__ = ["COLUMNS", "ROW_WIDTH", "observe", "record"]

Array = NDArray[np.float64]

ROW_WIDTH = SIZE + 5
"""Of a row: the state and the controls with their rates."""

COLUMNS = (
    "north", "east", "down", "q_w", "q_x", "q_y", "q_z", "u", "v", "w", "p", "q", "r", "energy", "mass_position",
    "mass_rotation", "net_buoyancy", "density", "pressure", "temperature", "current_north", "current_east",
    "current_down", "vertical_speed",
)  # fmt: skip
"""Columns of ``Flight.samples``; SI, rad."""


@kernel
def record(row: Array, y: Array, c: Controls) -> None:
    """One row of output: the state and the controls with their rates."""
    for j in range(SIZE):
        row[j] = y[j]
    row[SIZE], row[SIZE + 1], row[SIZE + 2], row[SIZE + 3], row[SIZE + 4] = c


@kernel
def observe(times: Array, rows: Array, sea: Sea, p: Parameters, full: bool, out: Array) -> None:
    """Fill ``out`` (n, len(COLUMNS)) with what rows (n, ROW_WIDTH) of states and controls at times (n,), s, mean."""
    for i in range(len(rows)):
        y = rows[i]
        c = Controls(y[SIZE], y[SIZE + 1], y[SIZE + 2], y[SIZE + 3], y[SIZE + 4])
        water = at_depth(sea, y[2], times[i])
        s = state_of(y)
        V, Omega = velocity(s.P, s.Pi, placement(c, p, full), water.density / p.rho_ref, p)
        out[i, 0], out[i, 1], out[i, 2] = s.position
        out[i, 3], out[i, 4], out[i, 5], out[i, 6] = s.q_wxyz
        out[i, 7], out[i, 8], out[i, 9] = V
        out[i, 10], out[i, 11], out[i, 12] = Omega
        out[i, 13] = y[ENERGY]
        out[i, 14], out[i, 15], out[i, 16] = c.rrx, c.gamma, c.mb
        out[i, 17], out[i, 18], out[i, 19] = water.density, water.pressure, water.temperature
        out[i, 20], out[i, 21], out[i, 22] = water.current
        out[i, 23] = dot(rotation_ned_body(s.q_wxyz)[2], V) + water.current[2]
