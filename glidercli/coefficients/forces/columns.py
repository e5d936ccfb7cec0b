"""Which column of a table of forces is what, in which unit? ``NAME_UNIT``, each quantity once."""

from __future__ import annotations

import re
from typing import NamedTuple

from glidercli.coefficients.flows.case_table import COLUMNS
from glidercli.errors import InputError
from glidercli.ocean.source import listed
from glidercli.ocean.table import Table
from glidercli.units import CENTIMETRE, DEGREE, KNOT, MILLIMETRE

__all__ = ["BODY_FORCES", "BODY_MOMENTS", "FLOW", "Column", "column_of", "columns_of", "spelled"]

_ANGLE = {"deg": DEGREE, "rad": 1.0}
_SPEED = {"m_s": 1.0, "cm_s": CENTIMETRE, "mm_s": MILLIMETRE, "knot": KNOT}
_RATE = {"rad_s": 1.0, "deg_s": DEGREE}
_FORCE = {"N": 1.0, "mN": 1e-3, "kN": 1e3}
_MOMENT = {"N_m": 1.0, "mN_m": 1e-3, "N_mm": 1e-3, "kN_m": 1e3}

FLOW = {
    "drag": "D", "side_force": "SF", "lift": "L", "roll_moment": "T1", "pitch_moment": "T2", "yaw_moment": "T3",
}  # fmt: skip
"""In the flow frame: D against p1, SF along p2, L against p3; moments about p1, p2, p3. Symbols of eq. (20)."""
BODY_FORCES = ("body_x_force", "body_y_force", "body_z_force")
"""Along x forward, y starboard, z down."""
BODY_MOMENTS = ("body_x_moment", "body_y_moment", "body_z_moment")
"""About the same axes, at the centre of buoyancy."""

_UNITS: dict[str, dict[str, float]] = {
    "angle_of_attack": _ANGLE,
    "sideslip": _ANGLE,
    "speed": _SPEED,
    **dict.fromkeys(("u", "v", "w"), _SPEED),
    **dict.fromkeys(("p", "q", "r"), _RATE),
    "turning_radius": {"m": 1.0},
    "density": {"kg_m3": 1.0, "g_cm3": 1000.0},
    **dict.fromkeys(("drag", "side_force", "lift", *BODY_FORCES), _FORCE),
    **dict.fromkeys(("roll_moment", "pitch_moment", "yaw_moment", *BODY_MOMENTS), _MOMENT),
}
"""By quantity: units that its column may name, as the factor to SI."""

_COEFFICIENT = {
    "drag": "c_?d|c_?x|drag_?coeff?(icient)?", "side_force": "c_?y|c_?s|side_?force_?coeff?(icient)?",
    "lift": "c_?l|c_?z|lift_?coeff?(icient)?", "roll_moment": "c_?r|c_?mx|c_?ll|roll(_?moment)?_?coeff?(icient)?",
    "pitch_moment": "c_?m|c_?my|pitch(_?moment)?_?coeff?(icient)?",
    "yaw_moment": "c_?n|c_?mz|yaw(_?moment)?_?coeff?(icient)?",
}  # fmt: skip
_UNIT_WORD = re.compile(
    r"n|[mk]n|kgf|lbf?|kp|g|k?g|m[23]?|[cmk]m[23]?|nm|nmm|knm|ft|in|s|ms|h|min|deg|degrees?|rad|radians?|grad|turns?|"
    r"rev|rpm|hz|kn|kt|knots?|mph|newtons?|per|si|l"
)


class Column(NamedTuple):
    """name : as it stands in the file. quantity : what it holds. factor : to SI."""

    name: str
    quantity: str
    factor: float


def spelled(quantity: str) -> str:
    """The name that a column of a quantity has in the first of its units."""
    return f"{quantity}_{next(iter(_UNITS[quantity]))}"


def column_of(symbol: str) -> str:
    """The quantity of the flow frame that a symbol of eq. (20) stands for."""
    return next(name for name, its in FLOW.items() if its == symbol)


def columns_of(table: Table) -> tuple[dict[str, Column], list[str]]:
    """The columns that are used, by quantity, and the names of those that are not.

    Raises InputError, all faults together: a quantity in two columns, a unit that is unknown or missing, a coefficient
    where a force is needed.
    """
    found: dict[str, Column] = {}
    doubtful: list[tuple[str, str, str]] = []
    others, faults = [], []
    for name in table.columns:
        quantity, unit = _parted(name)
        if not quantity:
            if name not in COLUMNS and name != "origin":
                others.append(name)
        elif unit not in _UNITS[quantity]:
            doubtful.append((name, quantity, unit))
        elif quantity in found:
            faults.append(f"{found[quantity].name} and {name} are the same quantity; one is allowed")
        else:
            found[quantity] = Column(name, quantity, _UNITS[quantity][unit])
    for name, quantity, unit in doubtful:
        if quantity in found:
            others.append(name)
        else:
            allowed = " ".join(f"{quantity}_{known}" for known in _UNITS[quantity])
            fault = f"unit {unit} is not known" if unit else "names no unit"
            faults.append(f"column {name}: {fault}; allowed: {allowed}")
    body = all(name in found for name in BODY_FORCES), all(name in found for name in BODY_MOMENTS)
    for name in others:
        for quantity, pattern in _COEFFICIENT.items():
            had = quantity in found or body[quantity.endswith("moment")]
            if re.fullmatch(pattern, name, re.IGNORECASE) and not had:
                faults.append(
                    f"column {name} looks like a coefficient; needed is {spelled(quantity)}, "
                    "the coefficient times rho/2 V^2 and the area (and length) that it was made with"
                )
    if faults:
        raise InputError.of_all(table.path, faults)
    return found, others


def _parted(name: str) -> tuple[str, str]:
    """Quantity and unit of a column's name; no quantity for a column that is none of ours."""
    lower = name.lower()
    for quantity in sorted(_UNITS, key=len, reverse=True):
        if lower == quantity and len(quantity) > 1:
            return quantity, ""
        if lower.startswith(quantity + "_"):
            unit = name[len(quantity) + 1 :]
            words = unit.lower().split("_")
            if unit in _UNITS[quantity] or all(_UNIT_WORD.fullmatch(word) for word in words):
                return quantity, unit
            return "", ""
    return "", ""


def lacking(found: dict[str, Column], names: tuple[str, ...], table: Table) -> InputError:
    """The error for columns without which nothing can be done."""
    needed = ", ".join(spelled(name) for name in names if name not in found)
    return InputError(table.path, f"line 1: {needed} missing; its columns are {listed(table.columns)}")
