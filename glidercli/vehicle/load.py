"""How does a vehicle file become a Vehicle? Read, checked whole, every fault named at once."""

from __future__ import annotations

import functools
from pathlib import Path

from glidercli.files import read_toml
from glidercli.shipped import file_of
from glidercli.vehicle.checking import checked
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["load_vehicle", "shipped_vehicles"]

_DATA = Path(__file__).parent / "data"


@functools.cache
def shipped_vehicles() -> dict[str, Path]:
    """File of each shipped vehicle, by name."""
    return {path.stem: path for path in sorted(_DATA.glob("*.toml"))}


def load_vehicle(name_or_path: str | Path) -> Vehicle:
    """The vehicle of a shipped name or of a TOML file.

    Raises
    ------
    InputError
        The file cannot be read or is no TOML; or, all together, every unknown key, missing value, wrong unit and value
        outside its physical range, as ``FILE: key = value unit, allowed range; ...``.
    """
    known = shipped_vehicles()
    path = file_of(name_or_path, known, "vehicle")
    return _shipped(path) if str(name_or_path) in known else _read(path)


@functools.cache
def _shipped(path: Path) -> Vehicle:
    """A shipped vehicle; its file does not change while the program runs."""
    return _read(path)


def _read(path: Path) -> Vehicle:
    """The vehicle of a file."""
    return checked(Vehicle, read_toml(path, "a vehicle"), path)
