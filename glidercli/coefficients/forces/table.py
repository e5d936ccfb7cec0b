"""What forces were found in which flow? A table of cases and forces, read strictly into SI and the flow frame."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.coefficients.flows.case_table import SETS
from glidercli.coefficients.forces.columns import BODY_FORCES, BODY_MOMENTS, FLOW, Column, columns_of, lacking, spelled
from glidercli.errors import InputError
from glidercli.ocean.source import read_text
from glidercli.ocean.table import Table, parse_table
from glidercli.origins import origins
from glidercli.units import DEGREE

__all__ = ["Forces", "read_forces", "to_body"]

Array = NDArray[np.float64]

_EXPECTED = "a table of forces is CSV: a line of column names such as angle_of_attack_deg, then a line a case"
_LIKE_RADIANS = 0.35
"""deg; a column of at least three angles within this is taken for radians (20 deg) under a wrong name."""
_AGREE = 0.01
"""Of the speed or the turning rate: how far two accounts of one case may differ, for tables that were rounded."""
_AXIS = math.cos(math.radians(2.5))
"""Turning is about an axis of the flow frame if it is within 2.5 deg of it: angles of the table may be rounded."""
_STILL = 1e-6  # rad/s
FASTEST = 15.0
"""m/s; the fastest towing tanks. What is above was meant in another unit."""


class Forces(NamedTuple):
    """A table of n cases, SI and rad; measured is NaN where nothing is told.

    lines : of the file, (n,). alpha, beta, speed : (n,). Omega : body rates (p, q, r), (n, 3). density : (n,), kg/m3,
    or NaN. kind : "straight", "about-p1", "about-p2", "about-p3" or "about another axis", (n,).
    measured : D, SF, L, T1, T2, T3 of eq. (20), (n, 6). frame : "flow", "body" or both, that they were given in.
    ignored : columns that are not used. origin : what a column of that name says, as measured or simulated.
    """

    path: Path
    lines: NDArray[np.int64]
    alpha: Array
    beta: Array
    speed: Array
    Omega: Array
    density: Array
    kind: NDArray[np.str_]
    measured: Array
    frame: str
    ignored: list[str]
    origin: tuple[str, ...]


def to_body(alpha: Array, beta: Array) -> Array:
    """R_BC of eq. (21) for each of n cases, (n, 3, 3): flow frame to body frame."""
    ca, sa, cb, sb = np.cos(alpha), np.sin(alpha), np.cos(beta), np.sin(beta)
    zero = np.zeros_like(ca)
    return np.stack([ca * cb, -ca * sb, -sa, sb, cb, zero, sa * cb, -sa * sb, ca], axis=-1).reshape(-1, 3, 3)


def read_forces(path: Path) -> Forces:
    """The cases and forces of a file. Raises InputError for everything in it that cannot be used."""
    table = parse_table(path, read_text(path, _EXPECTED), _EXPECTED)
    found, ignored = columns_of(table)
    alpha, beta, speed = _flow(table, found)
    R = to_body(alpha, beta)
    Omega = _rates(table, found, speed, R)
    density = np.full(len(table), np.nan)
    if "density" in found:
        density = _column(table, found["density"], 900.0, 1200.0)
    measured, frame = _measured(table, found, R)
    for i, name in enumerate(FLOW):
        told = measured[~np.isnan(measured[:, i]), i]
        if name in ("drag", "lift") and len(told) and not told.any():
            raise InputError(path, f"{spelled(name)}: every value is 0; forces are needed")
    if np.isnan(measured).all():
        raise InputError(
            path, f"holds no force and no moment; needed is one of {', '.join(map(spelled, FLOW))} or more"
        )
    said = origins(path, zip(table.lines, table.cells["origin"], strict=True)) if "origin" in table else ()
    lines, kind = np.array(table.lines), _kinds(R, Omega)
    _check_set(table, kind)
    return Forces(path, lines, alpha, beta, speed, Omega, density, kind, measured, frame, ignored, said)


def _check_set(table: Table, kind: NDArray[np.str_]) -> None:
    """A column set must say what the velocities and rates say."""
    if "set" not in table:
        return
    allowed = (*SETS, "about-p1")
    for line, said, found in zip(table.lines, table.cells["set"], kind.tolist(), strict=True):
        if said not in allowed:
            raise InputError(table.path, f"line {line}: set = {said or 'empty'}, allowed: {', '.join(allowed)}")
        if said != found:
            raise InputError(table.path, f"line {line}: set = {said}, and by the rates p, q, r it is {found}")


def _column(table: Table, column: Column, low: float, high: float, gaps: bool = False) -> Array:
    """A column in SI, every cell a number from low to high in SI. gaps : empty cells and "NaN" are NaN."""
    values = table.measured(column.name) * column.factor
    for line, cell, value in zip(table.lines, table.cells[column.name], values, strict=True):
        if gaps and math.isnan(value):
            continue
        if not low <= value <= high or "_" in cell:
            limits = f"{low / column.factor:g} to {high / column.factor:g}"
            raise InputError(table.path, f"line {line}: {column.name} = {cell or 'empty'}, allowed {limits}")
    return values


def _flow(table: Table, found: dict[str, Column]) -> tuple[Array, Array, Array]:
    """alpha, beta and V: from the angles and the speed, or from the velocity; where both stand they must agree."""
    by_velocity = [found[name] for name in ("u", "v", "w") if name in found]
    by_angles = [found[name] for name in ("angle_of_attack", "sideslip", "speed") if name in found]
    V = np.stack(
        [_column(table, column, -FASTEST, FASTEST) for column in by_velocity] or [np.zeros(len(table))], axis=1
    )
    if len(by_angles) < 3:
        if len(by_velocity) < 3:
            raise lacking(found, ("angle_of_attack", "sideslip", "speed"), table)
        speed = np.linalg.norm(V, axis=1)
        for line in np.array(table.lines)[speed == 0.0]:
            raise InputError(table.path, f"line {line}: the speed is 0, allowed: more")
        return np.arctan2(V[:, 2], V[:, 0]), np.arcsin(V[:, 1] / speed), speed
    alpha, beta = (_angles(table, found[name]) for name in ("angle_of_attack", "sideslip"))
    speed = _column(table, found["speed"], 1e-3, FASTEST)
    if len(by_velocity) == 3:
        ahead = speed[:, None] * to_body(alpha, beta)[:, :, 0]
        off = np.linalg.norm(ahead - V, axis=1) / speed
        _refuse_where(table, off > _AGREE, "u, v, w are not the velocity that the angles and the speed tell")
    return alpha, beta, speed


def _angles(table: Table, column: Column) -> Array:
    """A column of angles, rad; refused where they look like radians called degrees."""
    values = _column(table, column, -0.5 * math.pi, 0.5 * math.pi)
    if column.factor == DEGREE and 0.0 < np.abs(values).max() <= _LIKE_RADIANS * DEGREE and len(set(values)) >= 3:
        most = np.abs(values).max() / DEGREE
        raise InputError(
            table.path,
            f"{column.name}: every angle is within {most:.4g} deg, as if in radians; "
            f"name the column {column.quantity}_rad if they are",
        )
    return values


def _rates(table: Table, found: dict[str, Column], speed: Array, R: Array) -> Array:
    """Body rates, (n, 3): from p, q, r, or from the radius and the set by eqs (24), (26), (27); else straight."""
    rates = [found[name] for name in ("p", "q", "r") if name in found]
    if 0 < len(rates) < 3:
        raise lacking(found, ("p", "q", "r"), table)
    given = np.stack([_column(table, column, -20.0, 20.0) for column in rates], axis=1) if rates else None
    told = _rates_by_radius(table, found, speed, R)
    if given is not None and told is not None:
        off = np.linalg.norm(given - told, axis=1) > _AGREE * np.linalg.norm(told, axis=1) + _STILL
        _refuse_where(table, off, "p, q, r are not the rates that turning_radius_m and set tell")
    if given is not None:
        return given
    return np.zeros((len(table), 3)) if told is None else told


def _rates_by_radius(table: Table, found: dict[str, Column], speed: Array, R: Array) -> Array | None:
    """The same from the radius alone; None for a table without."""
    if "turning_radius" not in found:
        if "set" in table and not {"p", "q", "r"} <= set(found) and set(table.cells["set"]) - {"straight"}:
            raise InputError(table.path, "line 1: p_rad_s, q_rad_s, r_rad_s or turning_radius_m missing beside set")
        return None
    name = found["turning_radius"].name
    cells = [cell if cell.lower() not in ("inf", "infinity") else "" for cell in table.cells[name]]
    radius = table.measured(name) if cells == list(table.cells[name]) else _finite_or_gap(table, name)
    if "set" not in table:
        if np.isnan(radius).all() or {"p", "q", "r"} <= set(found):
            return None
        raise InputError(table.path, f"line 1: set missing beside {name}; it holds {', '.join(SETS)}")
    Omega = np.zeros((len(table), 3))
    for i, (line, kind) in enumerate(zip(table.lines, table.cells["set"], strict=True)):
        if kind not in SETS:
            raise InputError(table.path, f"line {line}: set = {kind or 'empty'}, allowed: {', '.join(SETS)}")
        if (kind == "straight") != math.isnan(radius[i]):
            fault = "has a radius" if kind == "straight" else "has no radius"
            raise InputError(table.path, f"line {line}: set = {kind}, and {fault} in {name}")
        if kind != "straight":
            if not 0.1 <= abs(radius[i]) <= 1e6:
                raise InputError(table.path, f"line {line}: {name} = {radius[i]:g}, allowed 0.1 to 1e+06 either way")
            Omega[i] = R[i][:, 2 if kind == "about-p3" else 1] * (speed[i] / radius[i])
    return Omega


def _finite_or_gap(table: Table, name: str) -> Array:
    """A column in which what is infinite, an endless radius, is NaN."""
    values = table.measured(name)
    values[np.isinf(values)] = np.nan
    return values


def _refuse_where(table: Table, wrong: NDArray[np.bool_], what: str) -> None:
    for line in np.array(table.lines)[wrong]:
        raise InputError(table.path, f"line {line}: {what}; {_AGREE:.0%} is allowed")


def _kinds(R: Array, Omega: Array) -> NDArray[np.str_]:
    """What each case turns about, in the flow frame."""
    rate = np.linalg.norm(Omega, axis=1)
    turning = rate > _STILL
    in_flow = np.abs(np.einsum("nji,nj->ni", R, Omega)) / np.where(turning, rate, 1.0)[:, None]
    axis = np.select(
        [in_flow[:, i] > _AXIS for i in range(3)], ["about-p1", "about-p2", "about-p3"], "about another axis"
    )
    return np.where(turning, axis, "straight")


def _measured(table: Table, found: dict[str, Column], R: Array) -> tuple[Array, str]:
    """D, SF, L, T1, T2, T3, (n, 6), and the frame that they were given in."""
    flow = [name for name in FLOW if name in found]
    body = [name for name in (*BODY_FORCES, *BODY_MOMENTS) if name in found]
    result = np.full((len(table), 6), np.nan)
    for start, names, flow_names in ((0, BODY_FORCES, list(FLOW)[:3]), (3, BODY_MOMENTS, list(FLOW)[3:])):
        in_body = [name for name in names if name in found]
        in_flow = [name for name in flow_names if name in found]
        if in_body and in_flow:
            both = f"{found[in_flow[0]].name} and {found[in_body[0]].name}"
            raise InputError(table.path, f"line 1: {both}: one frame is allowed, flow or body")
        for i, name in enumerate(flow_names):
            if name in found:
                result[:, start + i] = _column(table, found[name], -1e6, 1e6, gaps=True)
        if in_body:
            given = np.full((len(table), 3), np.nan)
            for i, name in enumerate(names):
                if name in found:
                    given[:, i] = _column(table, found[name], -1e6, 1e6, gaps=True)
            turned = _rotated(R, given)
            result[:, start : start + 3] = turned * ((-1.0, 1.0, -1.0) if start == 0 else 1.0)
    return result, "flow and body" if flow and body else "body" if body else "flow"


def _rotated(R: Array, given: Array) -> Array:
    """R_BC^T times each vector, (n, 3); a component that is not given counts only where it has a part in the result."""
    share = np.swapaxes(R, 1, 2)
    parts = np.where(np.abs(share) < 1e-12, 0.0, share * given[:, None, :])
    return np.asarray(parts.sum(axis=2))
