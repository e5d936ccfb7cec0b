"""How is a fit of coefficients told? As a document, as a table a coefficient a row, and as text for a terminal."""

from __future__ import annotations

import math
from typing import Any

from glidercli.coefficients.forces.fitting import SYMBOLS, Fitted
from glidercli.coefficients.forces.result import Result
from glidercli.units import DEGREE

__all__ = ["columns", "document", "text"]

R_SQUARED = (
    "1 - squares of the residuals over those of the forces about their mean; negative at worst, without a constant"
)


def _unit(one: Fitted) -> str:
    return "N" if one.equation.measured in ("D", "SF", "L") else "N m"


def _rows(result: Result) -> list[dict[str, Any]]:
    """The coefficients that were fitted, a dictionary each."""
    base = result.base
    scale = result.fit.density / base.density if base is not None and base.density else 1.0
    rows = []
    for symbol, (value, error, one) in result.fit.values().items():
        key, unit = SYMBOLS[symbol]
        of_base = base.coefficients.get(symbol) if base is not None else None
        there = None if of_base is None else of_base * scale
        rows.append({
            "symbol": symbol,
            "name": key,
            "value": value,
            "unit": unit,
            "standard_error": error,
            "relative_error": error / abs(value) if value else math.inf,
            "t": value / error if error > 0.0 else math.inf,
            "cases": len(one.rows),
            "set": one.equation.cases,
            "equation": one.equation.name,
            "base_value": there,
            "difference_in_standard_errors": None if there is None or error <= 0.0 else (value - there) / error,
        })  # fmt: skip
    return rows


def columns(result: Result) -> dict[str, list[Any]]:
    """A row a coefficient."""
    rows = _rows(result)
    return {name: [row[name] for row in rows] for name in rows[0]}


def document(result: Result) -> dict[str, Any]:
    """The contract's JSON document; it may hold numbers that are not finite."""
    f = result.forces
    return {
        "forces": str(f.path),
        "origin": list(f.origin),
        "frame": f.frame,
        "cases": {
            "records": len(f.lines),
            "used": result.used,
            "unused": [{"reason": why, "count": len(lines), "lines": lines} for why, lines in result.unused.items()],
        },
        "reference_density_kg_m3": result.fit.density,
        "fitted_angle_deg": result.fitted_angle / DEGREE,
        "added_mass_subtracted": result.subtracted,
        "coefficients": _rows(result),
        "equations": [_equation(result, one) for one in result.fit.fitted],
        "r_squared_is": R_SQUARED,
        "held": list(result.hold),
        "of_the_base": result.kept,
        "absent": result.absent,
        "not_fitted": list(result.fit.lacking.values()),
        "columns_not_used": f.ignored,
        "warnings": result.warnings,
    }


def _equation(result: Result, one: Fitted) -> dict[str, Any]:
    lines = result.forces.lines[one.rows].tolist()
    worst = int(abs(one.found.residual).argmax())
    return {
        "name": one.equation.name,
        "force": one.equation.measured,
        "unit": _unit(one),
        "coefficients": list(one.equation.unknowns),
        "held": list(one.equation.held),
        "set": one.equation.cases,
        "cases": len(lines),
        "degrees_of_freedom": one.found.freedom,
        "r_squared": one.r_squared,
        "rms_residual": one.rms,
        "largest_residual": {
            "value": float(one.found.residual[worst]), "line": lines[worst], **_case(result, int(one.rows[worst])),
        },
        "correlation": one.found.correlation,
        "condition": one.found.condition,
        "lines": lines,
        "table_values": one.measured.tolist(),
        "fitted_values": one.fitted.tolist(),
    }  # fmt: skip


def _case(result: Result, row: int) -> dict[str, Any]:
    f = result.forces
    return {"angle_of_attack_deg": float(f.alpha[row] / DEGREE), "sideslip_deg": float(f.beta[row] / DEGREE)}


def text(result: Result) -> str:
    """The fit for people."""
    f, fit = result.forces, result.fit
    rows = _rows(result)
    beside = any(row["base_value"] is not None for row in rows)
    lines = [
        f"{f.path}: {len(f.lines)} {' '.join((*f.origin, 'cases'))}, {result.used} used",
        f"{fit.density:.6g} kg/m3, angles to {result.fitted_angle / DEGREE:.4g} deg"
        + ("; forces of added mass taken off" if result.subtracted else ""),
        "",
        "coefficient               value  std error  unit       cases" + ("      base   off/std" if beside else ""),
    ]
    for row in rows:
        line = f"{row['symbol']:<6} {row['name']:<13}{row['value']:>11.5g}{row['standard_error']:>11.2g}  "
        line += f"{row['unit']:<9}{row['cases']:>7}"
        if row["base_value"] is not None:
            apart = row["difference_in_standard_errors"]
            line += f"{row['base_value']:>10.5g}"
            if apart is not None:
                line += f"{apart:>+10.2f}" if abs(apart) < 1e4 else f"{apart:>+10.0e}"
        lines.append(line)
    lines += ["", "equation                    R2   rms residual   largest  at line  correlation"]
    for one in fit.fitted:
        e = _equation(result, one)
        alike = "" if e["correlation"] is None else f"{e['correlation']:+.3f}"
        worst = e["largest_residual"]
        line = f"{e['name']:<22}{e['r_squared']:>8.4f}{e['rms_residual']:>11.2g} {e['unit']:<3}"
        lines.append(f"{line}{worst['value']:>+10.2g}{worst['line']:>9}{alike:>13}".rstrip())
    lines.append("R2 is about the mean." + (" off/std: from the base, in standard errors." if beside else ""))
    if result.kept and result.base is not None:
        lines.append(f"Not fitted, of {result.base.path.name}: {', '.join(result.kept)}")
    return "\n".join(lines)
