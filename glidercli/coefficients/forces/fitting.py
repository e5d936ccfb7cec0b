"""Which coefficients of eq. (20) do forces tell? Least squares, equation by equation, in the order of section 3.3."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.coefficients.forces.columns import FLOW, column_of, spelled
from glidercli.coefficients.forces.misfits import misfits, refuse_other_sizes, refuse_other_units
from glidercli.coefficients.forces.regression import Regression, regress
from glidercli.coefficients.forces.table import Forces
from glidercli.errors import InputError
from glidercli.units import DEGREE

__all__ = ["EQUATIONS", "SYMBOLS", "Equation", "Fit", "Fitted", "fit_forces"]

Array = NDArray[np.float64]
Rows = NDArray[np.bool_]

SYMBOLS = {
    "KD0": ("drag_zero", "kg/m"), "KD": ("drag_attack", "kg/m/rad2"), "KL0": ("lift_zero", "kg/m"),
    "Kalpha": ("lift_attack", "kg/m/rad"), "KM0": ("pitch_zero", "kg"), "KM": ("pitch_attack", "kg/rad"),
    "Kbeta": ("side_sideslip", "kg/m/rad"), "KMY": ("yaw_sideslip", "kg/rad"), "Kr": ("yaw_rate", "kg s/rad"),
    "KMR": ("roll_sideslip", "kg/rad"), "Kp": ("roll_rate", "kg s/rad"), "Kq": ("pitch_rate", "kg s/rad"),
}  # fmt: skip
"""Coefficients in the order of section 3.3: key of a vehicle file's table hydrodynamics, and unit."""

ZERO_ANGLE = 0.05 * DEGREE
"""An angle within this of zero is zero: tables may be rounded."""
_DECIMALS = 4
"""of rad, m/s and 1/m, by which cases are told apart when they are counted."""


class Equation(NamedTuple):
    """One regression. measured : symbol of eq. (20). unknowns, held : coefficients, each times V^2 and a flow quantity.

    cases : the cases that it takes, in words. rows : which of a table's they are. needed : number of distinct values
    that they must have at least, by what is counted.
    """

    name: str
    measured: str
    unknowns: tuple[str, ...]
    held: tuple[str, ...]
    cases: str
    rows: Callable[[Forces], Rows]
    needed: dict[str, int]


def _straight(f: Forces) -> Rows:
    return np.asarray(f.kind == "straight")


_AT_ATTACK = "straight, sideslip 0"
_PITCH = "turning about p2"


def _symmetric(f: Forces) -> Rows:
    return np.asarray(_straight(f) & (np.abs(f.beta) <= ZERO_ANGLE))


EQUATIONS = (
    Equation("drag", "D", ("KD0", "KD"), (), _AT_ATTACK, _symmetric, {"angles of attack": 3}),
    Equation("lift", "L", ("KL0", "Kalpha"), (), _AT_ATTACK, _symmetric, {"angles of attack": 3}),
    Equation("pitch moment, straight", "T2", ("KM0", "KM"), (), _AT_ATTACK, _symmetric, {"angles of attack": 3}),
    Equation(
        "side force", "SF", ("Kbeta",), (), "straight, angle of attack 0",
        lambda f: np.asarray(_straight(f) & (np.abs(f.alpha) <= ZERO_ANGLE)), {"sideslips": 3},
    ),
    Equation(
        "yaw moment", "T3", ("KMY", "Kr"), (), "turning about p3",
        lambda f: np.asarray(f.kind == "about-p3"), {"sideslips": 2, "radii": 2},
    ),
    Equation(
        "roll moment", "T1", ("KMR", "Kp"), (), "turning about p2 (or p1)",
        lambda f: np.asarray((f.kind == "about-p2") | (f.kind == "about-p1")), {"sideslips": 2, "radii": 2},
    ),
    Equation(
        "pitch moment, turning", "T2", ("Kq",), ("KM0", "KM"), _PITCH,
        lambda f: np.asarray(f.kind == "about-p2"), {"radii": 2},
    ),
)  # fmt: skip


class Fitted(NamedTuple):
    """An equation with what came of it. rows : of the table, (n,). measured, fitted : N or N m, (n,)."""

    equation: Equation
    rows: NDArray[np.int64]
    measured: Array
    fitted: Array
    found: Regression

    @property
    def r_squared(self) -> float:
        """1 - |residual|^2 / |measured - mean|^2: about the mean, for equations without a constant too."""
        about_mean = self.measured - self.measured.mean()
        total = float(about_mean @ about_mean)
        return 1.0 - float(self.found.residual @ self.found.residual) / total if total > 0.0 else math.nan

    @property
    def rms(self) -> float:
        """Root mean square of the residuals, N or N m."""
        return float(np.sqrt(np.mean(self.found.residual**2)))


class Fit(NamedTuple):
    """The equations that could be fitted, and why the others could not, by name of the equation."""

    fitted: list[Fitted]
    lacking: dict[str, str]
    density: float
    """kg/m3, at which the coefficients hold."""
    far_off: list[tuple[Equation, int]]
    """Rows of the table that an equation is far off, and that no other unit explains."""

    def values(self) -> dict[str, tuple[float, float, Fitted]]:
        """Value, standard error and equation of each coefficient that was found, in the order of SYMBOLS."""
        return {
            symbol: (float(one.found.values[i]), float(one.found.errors[i]), one)
            for one in self.fitted
            for i, symbol in enumerate(one.equation.unknowns)
        }


def fit_forces(
    f: Forces,
    density: float,
    *,
    used: Rows | None = None,
    partial: bool = False,
    hold: Mapping[str, float] | None = None,
) -> Fit:
    """The coefficients of eq. (20) from a table of cases and forces.

    density : kg/m3, at which they shall hold; forces of a table with densities are scaled by rho / density.
    used : rows that may be used; default all. partial : pass what the table does not tell; else it is an InputError
    that names what is missing. hold : values of coefficients that are not fitted, by symbol.
    """
    dense = np.where(np.isnan(f.density), 1.0, f.density / density)
    V2 = dense * f.speed * f.speed
    quantities = {
        "KD0": V2, "KD": f.alpha**2 * V2, "KL0": V2, "Kalpha": f.alpha * V2, "KM0": V2, "KM": f.alpha * V2,
        "Kbeta": f.beta * V2, "KMY": f.beta * V2, "Kr": f.Omega[:, 2] * V2, "KMR": f.beta * V2,
        "Kp": f.Omega[:, 0] * V2, "Kq": f.Omega[:, 1] * V2,
    }  # fmt: skip
    values = dict(hold or {})
    fitted: list[Fitted] = []
    far_off: list[tuple[Equation, int]] = []
    lacking: dict[str, str] = {}
    refuse_other_sizes(f)
    for equation in (_holding(equation, values) for equation in EQUATIONS):
        if not equation.unknowns:
            continue
        y = f.measured[:, list(FLOW.values()).index(equation.measured)]
        chosen = equation.rows(f) & ~np.isnan(y) & (True if used is None else used)
        why = _too_few(f, equation, chosen)
        if not why and any(symbol not in values for symbol in equation.held):
            why = f"{' and '.join(equation.held)} of the straight cases"
        if not why:
            X = np.stack([quantities[symbol][chosen] for symbol in equation.unknowns], axis=1)
            Z = np.stack([quantities[symbol][chosen] for symbol in equation.held] or [np.zeros(len(X))], axis=1)
            given = Z @ ([values[symbol] for symbol in equation.held] or [0.0])
            rows = np.flatnonzero(chosen)
            odd = misfits(X, y[chosen] - given)
            refuse_other_units(f, equation.measured, rows, odd.other_unit)
            far_off += [(equation, int(rows[row])) for row in odd.far_off]
            found = regress(X, y[chosen] - given, Z, _covariance(fitted, equation.held))
            if found.distinct:
                fitted.append(Fitted(equation, rows, y[chosen], y[chosen] - found.residual, found))
                values.update(zip(equation.unknowns, found.values.tolist(), strict=True))
            else:
                why = f"cases that tell {' from '.join(equation.unknowns)}"
        if why:
            lacking[equation.name] = f"{', '.join(equation.unknowns)} ({equation.name}): {why}"
    if lacking and not (partial and fitted):
        more = "" if partial else "; --partial fits the others"
        raise InputError(f.path, f"too little for {'; '.join(lacking.values())}{more}")
    return Fit(fitted, lacking, density, far_off)


def _holding(equation: Equation, values: Mapping[str, float]) -> Equation:
    """The equation with some unknowns held at values: what only they need is needed no more."""
    told = tuple(symbol for symbol in equation.unknowns if symbol in values)
    if not told:
        return equation
    left = tuple(symbol for symbol in equation.unknowns if symbol not in told)
    freed = "radii" if told[0] in ("Kr", "Kp") else "sideslips"
    needed = {what: least for what, least in equation.needed.items() if what != freed}
    return equation._replace(unknowns=left, held=(*equation.held, *told), needed=needed)


def _covariance(fitted: Sequence[Fitted], held: Sequence[str]) -> Array:
    """Covariance of held coefficients: zero for those that the fit did not find. At least (1, 1)."""
    covariance = np.zeros((max(len(held), 1),) * 2)
    for one in fitted:
        for i, first in enumerate(held):
            for j, second in enumerate(held):
                if {first, second} <= set(one.equation.unknowns):
                    at = one.equation.unknowns.index
                    covariance[i, j] = one.found.covariance[at(first), at(second)]
    return covariance


def _too_few(f: Forces, equation: Equation, chosen: Rows) -> str:
    """What an equation lacks, "" if nothing."""
    of_kind = int(equation.rows(f).sum())
    count = int(chosen.sum())
    if of_kind and not count:
        return f"{spelled(column_of(equation.measured))}, or the body's, in {of_kind} cases {equation.cases}"
    if not count:
        least = " and ".join(f"{number} {what}" for what, number in equation.needed.items())
        return f"no case {equation.cases}; at least {len(equation.unknowns) + 1} with {least} are needed"
    distinct = {
        "angles of attack": _distinct(f.alpha[chosen]),
        "sideslips": _distinct(f.beta[chosen]),
        "radii": _distinct(np.linalg.norm(f.Omega[chosen], axis=1) / f.speed[chosen]),
    }
    short = [f"{distinct[what]} of {least} {what}" for what, least in equation.needed.items() if distinct[what] < least]
    if count <= len(equation.unknowns):
        short.append(f"{count} of {len(equation.unknowns) + 1} cases")
    return f"{count} cases {equation.cases}, with {' and '.join(short)} needed at least" if short else ""


def _distinct(values: Sequence[float] | Array) -> int:
    return len(np.unique(np.round(np.asarray(values), _DECIMALS)))
