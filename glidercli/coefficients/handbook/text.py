"""How are estimates told on a terminal? A line a coefficient, what its parts give, and how far off it may be."""

from __future__ import annotations

import math

from glidercli.coefficients.base import Base
from glidercli.coefficients.handbook.estimate import Estimated
from glidercli.coefficients.handbook.output import of_base

__all__ = ["text"]

_ERROR_BAR = (
    "How far off, against three vehicles (docs/estimates.md): typically a factor of 1.2 in drag, 1.5 in lift and side "
    "force, 1.7 in moments and damping, at worst 1.4, 2.4, 3.2 and 6; roll by 7 or not at all. Fit for straight "
    "glides, not for spirals."
)


def _number(value: float) -> str:
    """Four digits, which is more than estimates have."""
    return f"{value + 0.0:.4g}"


def text(found: Estimated, base: Base | None) -> str:
    """The coefficients for people."""
    lines = [
        f"ESTIMATED from {found.geometry.name} by handbook formulas, no CFD, nothing measured; at {found.speed:g} m/s, "
        f"up to {math.degrees(found.angle):g} deg, in water of {found.geometry.density:g} kg/m3."
    ]
    over = f"{base.name[:9]:>10}  ratio" if base is not None and base.coefficients else ""
    lines += ["", f"{'':8}{'unit':10}{'estimate':>9}  {'interval':>19}{over}"]
    for one in found.coefficients.values():
        total = one.total
        interval = f"{_number(total.lower):>8} ..{_number(total.upper):>8}"
        line = f"{one.row.symbol:8}{one.row.unit:10}{_number(total.value):>9}  {interval}"
        own = None if base is None else of_base(base, one)
        if own is not None:
            ratio = "" if own.ratio is None else f"{own.ratio:.2f}"
            line += f"{_number(own.value):>10}{ratio:>7}  {'inside' if own.inside else 'outside'}"
        lines.append(line.rstrip())
        if len(one.parts) > 1:
            lines.append("  " + ", ".join(f"{part} {_number(bounds.value)}" for part, bounds in one.parts.items()))
    pitch, yaw = (found.coefficients[symbol].total.value for symbol in ("K_M", "K_MY"))
    lines += [
        "",
        "K_M and K_MY come without the Munk moments that the model has from the added mass, "
        f"{_number(found.munk[0])} and {_number(found.munk[1])} kg/rad; "
        f"whole moments {_number(pitch + found.munk[0])} and {_number(yaw + found.munk[1])} kg/rad.",
        _ERROR_BAR,
    ]
    return "\n".join(lines)
