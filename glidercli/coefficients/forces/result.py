"""What came of a fit of coefficients? The whole of it: read, checked, fitted, held against a base, ready to be told."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from glidercli.coefficients.base import Base, read_base
from glidercli.coefficients.forces.fitting import SYMBOLS, ZERO_ANGLE, Fit, fit_forces
from glidercli.coefficients.forces.munk import munk_slopes, without_added_mass
from glidercli.coefficients.forces.repeats import repeats
from glidercli.coefficients.forces.table import Forces, read_forces
from glidercli.errors import InputError, UsageError

__all__ = ["Result", "fit", "impossible"]

_UNSURE = 0.5
"""A coefficient whose standard error exceeds this share of its value is warned of."""
_FAR = 30.0
"""Ratio to the base's coefficient from which on units are in doubt."""
_TOGETHER = 0.95
"""Correlation of two coefficients beyond which the cases hardly tell them apart."""


class Result(NamedTuple):
    """A fit and all that is told of it.

    forces : as fitted, with the added mass's part taken off where that was asked for. unused : rows and reason.
    base : the vehicle that it is held against, or None. hold : coefficients left at the base's value.
    density, fitted_angle : kg/m3, rad, for the new vehicle. subtracted : whether added mass was taken off.
    """

    forces: Forces
    fit: Fit
    unused: dict[str, list[int]]
    base: Base | None
    hold: tuple[str, ...]
    fitted_angle: float
    subtracted: bool
    warnings: list[str]

    @property
    def used(self) -> int:
        """Cases that some coefficient was fitted to."""
        return len(self.forces.lines) - sum(map(len, self.unused.values()))

    @property
    def kept(self) -> list[str]:
        """Coefficients that stay those of the base."""
        found = self.fit.values()
        return [symbol for symbol in (self.base.coefficients if self.base else ()) if symbol not in found]

    @property
    def absent(self) -> list[str]:
        """Coefficients that neither the fit nor the base has."""
        return [symbol for symbol in SYMBOLS if symbol not in self.fit.values() and symbol not in self.kept]


def fit(
    forces: str | Path,
    *,
    vehicle: str | None = None,
    density: float | None = None,
    subtract_munk: bool = False,
    partial: bool = False,
    hold: Sequence[str] = (),
) -> Result:
    """The coefficients of eq. (20) from a table of cases and forces, by least squares in the order of section 3.3.

    vehicle : name or file that the result is held against and that supplies what is not fitted.
    density : of the water, kg/m3, where the table has no column of it.
    subtract_munk : take the forces and moments of the vehicle's added mass off first; see munk.py.
    partial : pass coefficients that the table does not tell. hold : coefficients, by symbol or key of a vehicle file,
    that stay those of the vehicle.

    Raises InputError for a table that cannot be used or tells too little, UsageError for options without a sense.
    """
    base = None if vehicle is None else read_base(vehicle)
    held = _held(hold, base)
    table = read_forces(Path(forces))
    at = _density(table, density)
    twice = repeats(table)
    if subtract_munk:
        if base is None or base.added_mass is None:
            told = "it needs --vehicle" if base is None else f"{base.path} has no added mass"
            raise UsageError(f"--subtract-munk takes off what added mass gives; {told}")
        table = without_added_mass(table, base.added_mass, base.density or at, at)
    scale = at / base.density if base is not None and base.density is not None else 1.0
    found = fit_forces(
        table,
        at,
        used=twice.copies < 0,
        partial=partial,
        hold={symbol: value * scale for symbol, value in held.items()},
    )
    angle = float(max(np.abs(table.alpha).max(), np.abs(table.beta).max()))
    result = Result(table, found, _unused(table, found, twice.copies), base, tuple(held), angle, subtract_munk, [])
    return result._replace(warnings=[*twice.notes, *_warnings(result)])


def _held(names: Sequence[str], base: Base | None) -> dict[str, float]:
    """Values of the base by symbol, for coefficients named by symbol or key."""
    if names and base is None:
        raise UsageError("--hold leaves a coefficient at the vehicle's value; it needs --vehicle")
    by_key = {key: symbol for symbol, (key, _) in SYMBOLS.items()}
    held = {}
    for name in names:
        symbol = by_key.get(name, name)
        if symbol not in SYMBOLS:
            raise UsageError(f"--hold {name}: is no coefficient; allowed: {', '.join(SYMBOLS)}")
        assert base is not None
        if symbol not in base.coefficients:
            raise InputError(base.path, f"has no {SYMBOLS[symbol][0]} ({symbol}) to hold")
        held[symbol] = base.coefficients[symbol]
    return held


def _density(f: Forces, given: float | None) -> float:
    """The density at which the coefficients shall hold: that of the table, its mean if it varies."""
    told = f.density[~np.isnan(f.density)]
    if len(told) and given is not None:
        raise UsageError("--density is for tables without a column density_kg_m3; leave one out")
    if len(told):
        return float(told.mean()) if np.ptp(told) > 0.0 else float(told[0])
    if given is None:
        raise InputError(f.path, "tells no density of the water; a column density_kg_m3 or --density is needed")
    if not 900.0 <= given <= 1200.0:
        raise InputError("--density", f"{given:g} kg/m3 is not allowed; 900 to 1200 is")
    return given


def _unused(f: Forces, found: Fit, copies: np.ndarray[tuple[int], np.dtype[np.int64]]) -> dict[str, list[int]]:
    """Lines of rows that no coefficient was fitted to, by reason."""
    used = {int(row) for one in found.fitted for row in one.rows}
    unused: dict[str, list[int]] = {}
    for row in range(len(f.lines)):
        if row in used:
            continue
        if copies[row] >= 0:
            reason = "the same as another line"
        elif np.isnan(f.measured[row]).all():
            reason = "without any force or moment"
        elif f.kind[row] == "about another axis":
            reason = "turning about another axis than p1, p2, p3"
        elif f.kind[row] == "straight" and min(abs(f.alpha[row]), abs(f.beta[row])) > ZERO_ANGLE:
            reason = "straight, with angle of attack and sideslip at once"
        else:
            reason = "with no force or moment that its coefficients need"
        unused.setdefault(reason, []).append(int(f.lines[row]))
    return unused


def impossible(result: Result) -> list[str]:
    """What no vehicle can have: damping that drives, drag that pushes."""
    faults = []
    for symbol, (value, error, _) in result.fit.values().items():
        unit = SYMBOLS[symbol][1]
        number = f"{symbol} = {value:.4g} {unit}, standard error {error:.2g}"
        if symbol in ("Kp", "Kq", "Kr") and value > 0.0:
            faults.append(f"{number}: damping is never positive; --hold {symbol} leaves it at the vehicle's value")
        elif symbol in ("KD0", "KD") and value < 0.0:
            faults.append(f"{number}: drag is never negative")
    return faults


def _warnings(result: Result) -> list[str]:
    """What to know before the numbers are used."""
    f, found = result.forces, result.fit
    said = [f"columns not used: {', '.join(f.ignored)}"] if f.ignored else []
    for reason, lines in result.unused.items():
        more = f" and {len(lines) - 8} more" if len(lines) > 8 else ""
        said.append(
            f"{len(lines)} of {len(f.lines)} cases not used, {reason}: lines {', '.join(map(str, lines[:8]))}{more}"
        )
    gaps = f.lines[np.isnan(f.measured[:, ~np.isnan(f.measured).all(axis=0)]).any(axis=1)]
    if len(gaps):
        more = f" and {len(gaps) - 8} more" if len(gaps) > 8 else ""
        said.append(
            f"{len(gaps)} cases lack a force or a moment and are left out where it counts: "
            f"lines {', '.join(map(str, gaps[:8]))}{more}"
        )
    said += [f"not fitted: {text}" for text in found.lacking.values()]
    for equation, row in found.far_off[:8]:
        said.append(f"line {f.lines[row]}: {equation.measured} is far from what the other cases tell ({equation.name})")
    for symbol, (value, error, one) in found.values().items():
        if error > _UNSURE * abs(value):
            alike = one.found.correlation
            why = (
                f"; its correlation with the other of the {one.equation.name} is {alike:.2f}"
                if alike is not None
                else ""
            )
            said.append(f"{symbol} = {value:.4g} {SYMBOLS[symbol][1]} is hardly known: standard error {error:.2g}{why}")
    for one in found.fitted:
        alike = one.found.correlation
        if alike is not None and abs(alike) > _TOGETHER:
            said.append(f"{' and '.join(one.equation.unknowns)} are hardly told apart: correlation {alike:.3f}")
    said += _other_scale(result)
    said += impossible(result)
    said += _munk_note(result)
    if result.kept:
        said.append(f"of {result.base.path.name if result.base else ''}, not fitted: {', '.join(result.kept)}")
    if result.absent:
        said.append(f"neither fitted nor in a vehicle: {', '.join(result.absent)}")
    return said


def _other_scale(result: Result) -> list[str]:
    """Coefficients so far from the base's that the table may be in other units than it says."""
    base = result.base.coefficients if result.base else {}
    far = []
    for symbol, (value, error, _) in result.fit.values().items():
        own = base.get(symbol, 0.0)
        if own and abs(value) > 3.0 * error and not 1.0 / _FAR < abs(value / own) < _FAR:
            far.append(f"{symbol} {value / own:.3g}")
    return [f"times the vehicle's: {', '.join(far)}; another vehicle, or other units than the columns say"] * bool(far)


def _munk_note(result: Result) -> list[str]:
    """How large the Munk moment, which the model adds, is beside the fitted moments."""
    base = result.base
    if result.subtracted or base is None or base.added_mass is None:
        return []
    values = result.fit.values()
    scale = result.fit.density / base.density if base.density else 1.0
    pairs = zip(("KM", "KMY"), munk_slopes(base.added_mass), ("alpha", "beta"), strict=True)
    parts = [
        f"{scale * slope:+.4g} {angle} beside {symbol} = {values[symbol][0]:+.4g}"
        for symbol, slope, angle in pairs
        if symbol in values
    ]
    if not parts:
        return []
    return [
        f"the model adds the Munk moment of the added mass, {' and '.join(parts)} kg/rad; forces that hold it already, "
        "as those of CFD and tow tanks do, need --subtract-munk"
    ]
