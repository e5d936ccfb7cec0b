"""How are estimates told? As a document, a table, a picture, numbers in a vehicle file.

Beside a vehicle each coefficient has the vehicle's own, the ratio and whether the interval holds it.
"""

from __future__ import annotations

import dataclasses
from typing import Any

from glidercli.coefficients.base import Base
from glidercli.coefficients.handbook.estimate import Coefficient, Estimated
from glidercli.keeping import Kept
from glidercli.vehicle.writing import Number, revised

__all__ = ["Beside", "answer", "document", "of_base", "rows", "vehicle_text"]


@dataclasses.dataclass(frozen=True)
class Beside:
    """A coefficient of the vehicle beside the estimate. ratio : estimate over it, None where either is zero."""

    value: float
    ratio: float | None
    inside: bool


def of_base(base: Base, one: Coefficient) -> Beside | None:
    """The vehicle's own coefficient beside an estimate; None where its file has none."""
    value = base.coefficients.get(one.row.symbol.replace("_", ""))
    if value is None:
        return None
    total = one.total
    return Beside(value, total.value / value if value and total.value else None, total.holds(value))


def document(found: Estimated, base: Base | None) -> dict[str, Any]:
    """As JSON, with the vehicle's own coefficients where one is given."""
    told = found.document()
    if base is None:
        return {**told, "vehicle": None}
    for one in told["coefficients"]:
        own = of_base(base, found.coefficients[one["symbol"]])
        if own is not None:
            one |= {"vehicle": own.value, "ratio": own.ratio, "vehicle_inside": own.inside}
    return {**told, "vehicle": base.name}


def rows(found: Estimated, base: Base | None) -> list[dict[str, Any]]:
    """As a table: a row a coefficient, a column for each part's share; what a coefficient has not is None."""
    parts = list(dict.fromkeys(part for one in found.coefficients.values() for part in one.parts))
    table = []
    for one in found.coefficients.values():
        total = one.total
        row: dict[str, Any] = {
            "symbol": one.row.symbol, "name": one.row.name, "unit": one.row.unit, "estimate": total.value,
            "lower": total.lower, "upper": total.upper,
        }  # fmt: skip
        if base is not None:
            own = of_base(base, one)
            row |= {
                "vehicle": own and own.value, "ratio": own and own.ratio, "vehicle_inside": own and own.inside,
            }  # fmt: skip
        row |= {f"part_{part}": one.parts[part].value if part in one.parts else None for part in parts}
        table.append({**row, "origin": "estimated", "method": one.row.method})
    return table


def vehicle_text(found: Estimated, base: Base | None, name: str) -> tuple[str, list[str]]:
    """The text of the base's file with the estimates in place, and what it still lacks to be a whole vehicle.

    base : None begins a new file. name : of the new vehicle, if it is new or the base a shipped one.
    """
    source = f"estimated from {found.geometry.name} by handbook formulas"
    at = f"at {found.speed:g} m/s"
    numbers = {
        one.row.name: Number(
            one.total.value + 0.0, f"{source}, interval {one.total.lower:.4g}..{one.total.upper:.4g}, {at}",
            one.row.symbol, _note(found, one.row.symbol),
        )
        for one in found.coefficients.values()
    }  # fmt: skip
    numbers["reference_density"] = Number(found.geometry.density, f"{source}: density of the estimate")
    numbers["fitted_angle"] = Number(found.angle, f"{source}: range that lines were fitted over")
    return revised(base.path if base else None, {"hydrodynamics": numbers}, name=name, changed=f"coefficients {source}")


def _note(found: Estimated, symbol: str) -> str:
    """What a reader of the vehicle file must know of a number."""
    if symbol in ("K_M", "K_MY"):
        whole = found.coefficients[symbol].total.value + found.munk[symbol == "K_MY"]
        return f"without the Munk moment, which the model has from the added mass; {whole:.4g} kg/rad with it"
    return "holds at that speed: water damps with p V, the model with p V2" if symbol in ("K_p", "K_q", "K_r") else ""


def answer(found: Estimated, base: Base | None, vehicle: str = "") -> Kept:
    """The estimates ready to be kept. vehicle : text of a vehicle file, or ""."""
    from glidercli.coefficients.handbook.figure import figure

    table = rows(found, base)
    columns = {name: [row[name] for row in table] for name in table[0]}
    return Kept(columns, document(found, base), lambda: figure(found, base), vehicle)
