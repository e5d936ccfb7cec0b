"""What does a vehicle file already say of coefficients? A whole vehicle, or one that is still being made."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

from glidercli.coefficients.forces.fitting import SYMBOLS
from glidercli.errors import InputError
from glidercli.files import read_toml
from glidercli.shipped import file_of
from glidercli.units import DEGREE
from glidercli.vehicle.checking import check
from glidercli.vehicle.load import shipped_vehicles
from glidercli.vehicle.vehicle import AddedMass, Hull, Vehicle

__all__ = ["Base", "read_base"]


class Base(NamedTuple):
    """path : of the file. name : of the vehicle, or of its file. coefficients : by symbol.

    density : at which they hold, kg/m3. added_mass, fitted_angle (rad), hull : None where the file has none.
    sources : where each number of the tables hydrodynamics and added_mass comes from, by key.
    """

    path: Path
    coefficients: dict[str, float]
    density: float | None
    added_mass: AddedMass | None
    sources: dict[str, str]
    name: str
    fitted_angle: float | None
    hull: Hull | None


def read_base(name_or_path: str) -> Base:
    """The coefficients of a shipped vehicle or a file; InputError for any number that no vehicle can have."""
    path = file_of(name_or_path, shipped_vehicles(), "vehicle")
    document = read_toml(path, "a vehicle")
    missing, faults = check(Vehicle, document, path)
    if faults:
        raise InputError.of_all(path, faults)
    hydro: dict[str, Any] = document.get("hydrodynamics", {})
    added: dict[str, Any] = document.get("added_mass", {})
    hull: dict[str, Any] = document.get("hull", {})
    has_hull = bool(hull) and not any(name.startswith("hull") for name in missing)
    keys = ("mass", "inertia", "yaw_from_sway", "pitch_from_heave")
    whole = bool(added) and not any(name.startswith("added_mass") for name in missing)
    values = [added[key]["value"] for key in keys] if whole else []
    return Base(
        path,
        {symbol: float(hydro[key]["value"]) for symbol, (key, _) in SYMBOLS.items() if key in hydro},
        float(hydro["reference_density"]["value"]) if "reference_density" in hydro else None,
        AddedMass(tuple(values[0]), tuple(values[1]), values[2], values[3]) if whole else None,
        {key: str(item.get("source", "")) for table in (hydro, added) for key, item in table.items()},
        str(document.get("name", path.stem)),
        float(hydro["fitted_angle"]["value"]) * DEGREE if "fitted_angle" in hydro else None,
        Hull(hull["length"]["value"], hull["diameter"]["value"]) if has_hull else None,
    )
