"""Many trims as columns: the names, units and meaning of ``Trim.document``, an array each."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.kernel import kernel
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.trim.newton import as_unknowns, worst
from glidercli.trim.pins import STALL_RATIO
from glidercli.trim.result import VERTICAL, speeds, table_4
from glidercli.trim.stability import linearised
from glidercli.trim.steady import radius_speed
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["columns", "linear_models", "quantities", "ranks", "why_no_glide", "within_limits"]

Array = NDArray[np.float64]
Runner = Callable[..., Any]
"""Calls a kernel, plain or compiled: (kernel, arguments...)."""

HORIZONTAL = 2
"""Column of ``quantities``."""

_DEG = 180.0 / np.pi


@kernel
def quantities(x: Array, printed: bool, water: Water, p: Parameters) -> Array:
    """(n, 4) of trims x (n, 9): R omega_3, vertical and horizontal speed, m/s, and the largest of the six equations."""
    found = np.zeros((len(x), 4))
    for i in range(len(x)):
        one = as_unknowns(x[i])
        vertical, horizontal = speeds(one[0], one[1], one[2], one[4], one[5])
        found[i, 0], found[i, 1], found[i, 2] = radius_speed(one, printed), vertical, horizontal
        found[i, 3] = worst(one, water, p)
    return found


@kernel
def linear_models(x: Array, water: Water, p: Parameters) -> Array:
    """The linear models (n, 8, 8) of trims x (n, 9)."""
    found = np.zeros((len(x), 8, 8))
    for i in range(len(x)):
        found[i] = linearised(as_unknowns(x[i]), water, p)
    return found


def why_no_glide(x: Array, horizontal: Array, craft: Vehicle) -> NDArray[np.str_]:
    """For trims x (n, 9): "stalled", "vertical" or "", as result.no_glide rules. horizontal : speed, m/s, (n,)."""
    stalled = np.abs(x[:, 1]) > STALL_RATIO * craft.hydrodynamics.fitted_angle
    vertical = horizontal < np.sin(VERTICAL) * x[:, 0]
    return np.where(stalled, "stalled", np.where(vertical, "vertical", ""))


def columns(
    x: Array, iterations: NDArray[np.int64], craft: Vehicle, water: Water, p: Parameters, run: Runner, *, equations: str
) -> dict[str, NDArray[Any]]:
    """Trims x (n, 9) by method root as columns, in the order of ``Trim.document``. run : calls a kernel."""
    q = run(quantities, x, equations == "paper", water, p)
    growth = np.linalg.eigvals(run(linear_models, x, water, p)).real.max(axis=1) if len(x) else np.zeros(0)
    with np.errstate(divide="ignore"):
        radius = np.where(x[:, 3] == 0.0, np.inf, q[:, 0] / x[:, 3])
    lift = p.KL0 + p.Kalpha * x[:, 1]
    return {
        "speed_m_s": x[:, 0],
        "angle_of_attack_deg": x[:, 1] * _DEG,
        "sideslip_deg": x[:, 2] * _DEG,
        "yaw_rate_rad_s": x[:, 3],
        "yaw_rate_deg_s": x[:, 3] * _DEG,
        "roll_deg": x[:, 4] * _DEG,
        "pitch_deg": x[:, 5] * _DEG,
        "mass_position_m": x[:, 6],
        "mass_rotation_deg": x[:, 7] * _DEG,
        "net_buoyancy_kg": x[:, 8],
        "turning_radius_m": radius,
        "vertical_speed_m_s": q[:, 1],
        "horizontal_speed_m_s": q[:, HORIZONTAL],
        "glide_angle_deg": np.arctan2(q[:, 1], q[:, HORIZONTAL]) * _DEG,
        "lift_to_drag": lift / (p.KD0 + p.KD * x[:, 1] ** 2),
        "residual": q[:, 3],
        "iterations": iterations,
        "method": np.full(len(x), "root"),
        "equations": np.full(len(x), equations),
        "stable": growth < 0.0,
        "growth_rate_1_s": growth,
        "within_limits": within_limits(x, craft),
    }


def ranks(x: Array, table: dict[str, NDArray[Any]], nominal: float) -> Array:
    """Ranks (n,) by which trims of one question are ordered, as result.ranked does: limits, Table 4, stability."""
    outside = ~table["within_limits"]
    beyond = ~np.array([table_4(row, nominal) for row in x.tolist()], dtype=bool)
    found: Array = 4.0 * outside + 2.0 * beyond + ~table["stable"]
    return found


def within_limits(x: Array, craft: Vehicle) -> NDArray[np.bool_]:
    """Whether the controls of trims x lie within the vehicle's limits."""
    inside = np.ones(len(x), dtype=bool)
    for column, (_, limit) in zip((6, 7, 8), craft.actuators.ranges(), strict=True):
        inside &= (x[:, column] >= limit.minimum - 1e-9) & (x[:, column] <= limit.maximum + 1e-9)
    return inside
