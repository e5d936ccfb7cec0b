"""Tables of forces made from eq. (20) with known coefficients, on the cases of Table 2."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np

from glidercli.coefficients.flows.case_table import cases
from glidercli.model import Parameters
from glidercli.model.hydrodynamics import in_flow_frame, rotation_body_flow
from glidercli.vehicle import load_vehicle

FLOW = ("drag_N", "side_force_N", "lift_N", "roll_moment_N_m", "pitch_moment_N_m", "yaw_moment_N_m")
BODY = (
    "body_x_force_N", "body_y_force_N", "body_z_force_N", "body_x_moment_N_m", "body_y_moment_N_m", "body_z_moment_N_m",
)  # fmt: skip
CASE = (
    "angle_of_attack_deg", "sideslip_deg", "speed_m_s", "p_rad_s", "q_rad_s", "r_rad_s", "density_kg_m3",
)  # fmt: skip
SIZE = np.array([1.6, 1.6, 6.1, 0.8, 1.4, 1.5])
"""About the largest force or moment of each kind on Table 2's cases, N and N m, for noise in proportion."""


def table_2() -> dict[str, np.ndarray]:
    """The columns of CASE, and the set, of the Seawing's cases."""
    columns = cases(load_vehicle("seawing").hull).columns
    return {name: columns[name] for name in (*CASE, "set", "turning_radius_m")}


def forces_of(columns: dict[str, np.ndarray], p: Parameters) -> np.ndarray:
    """D, SF, L, T1, T2, T3 of the model itself, (n, 6)."""
    result = []
    for a, b, V, *Omega, rho in zip(*(columns[name] for name in CASE), strict=True):
        force, moment = in_flow_frame(V, math.radians(a), math.radians(b), tuple(Omega), rho / p.rho_ref, p)
        result.append([-force[0], force[1], -force[2], *moment])
    return np.array(result)


def in_body(columns: dict[str, np.ndarray], forces: np.ndarray) -> np.ndarray:
    """The same as components along the body axes, by R_BC."""
    result = []
    for a, b, row in zip(columns["angle_of_attack_deg"], columns["sideslip_deg"], forces, strict=True):
        R = np.array(rotation_body_flow(math.radians(a), math.radians(b)))
        result.append([*(R @ [-row[0], row[1], -row[2]]), *(R @ row[3:])])
    return np.array(result)


def write(path: Path, columns: dict[str, np.ndarray], forces: np.ndarray, names: tuple[str, ...] = FLOW) -> Path:
    """A table of cases and forces, digits in full."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        out = csv.writer(stream)
        out.writerow([*columns, *names])
        for values in zip(*columns.values(), *forces.T, strict=True):
            out.writerow(["" if isinstance(v, float) and not math.isfinite(v) else v for v in values])
    return path
