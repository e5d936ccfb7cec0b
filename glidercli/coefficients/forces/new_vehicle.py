"""Which vehicle flies by fitted coefficients? The base's file with the new numbers, each with its source."""

from __future__ import annotations

from glidercli.coefficients.base import Base
from glidercli.coefficients.forces.fitting import SYMBOLS
from glidercli.coefficients.forces.result import Result, impossible
from glidercli.errors import InputError
from glidercli.vehicle.writing import Number, revised

__all__ = ["new_vehicle"]


def new_vehicle(result: Result, base: Base, name: str) -> tuple[str, list[str]]:
    """Text of the new vehicle file, and what it still lacks to be whole. name : of the new vehicle.

    Coefficients and added mass hold at one density: what stays of the base is brought to that of the table.
    Raises InputError for coefficients that no vehicle can have.
    """
    if faults := impossible(result):
        raise InputError.of_all(result.forces.path, faults)
    table = result.forces.path.name
    cases = " ".join((*result.forces.origin, "cases"))
    note = "the added mass's part was taken off the forces first" if result.subtracted else ""
    hydro = {
        SYMBOLS[symbol][0]: Number(
            value, f"fitted to {len(one.rows)} {cases} of {table} ({one.equation.cases}), standard error {error:.2g}",
            f"K_{symbol[1:]}", note,
        )
        for symbol, (value, error, one) in result.fit.values().items()
    }  # fmt: skip
    density = result.fit.density
    hydro["reference_density"] = Number(density, f"density of the water in {table}")
    hydro["fitted_angle"] = Number(result.fitted_angle, f"largest angle in {table}")
    tables = {"hydrodynamics": hydro}
    if base.density is not None and density != base.density:
        scale = density / base.density

        def moved(key: str, value: float | tuple[float, float, float]) -> Number:
            told = f"times {scale:.6g}, for {density:g} in place of {base.density:g} kg/m3"
            new = tuple(scale * v for v in value) if isinstance(value, tuple) else scale * value
            return Number(new, f"{base.sources.get(key, '')}; {told}".lstrip("; "))  # type: ignore[arg-type]

        for symbol in result.kept:
            key = SYMBOLS[symbol][0]
            hydro[key] = moved(key, base.coefficients[symbol])
        if (added := base.added_mass) is not None:
            keys = ("mass", "inertia", "yaw_from_sway", "pitch_from_heave")
            tables["added_mass"] = {key: moved(key, getattr(added, key)) for key in keys}
    changed = f"{', '.join(result.fit.values())} fitted to {table}"
    return revised(base.path, tables, name=name, changed=changed)
