"""How does a vehicle file become a Vehicle? Read, checked whole, every fault named at once."""

from __future__ import annotations

import dataclasses
import functools
from pathlib import Path
from typing import Any, get_args, get_type_hints

from pydantic import TypeAdapter, ValidationError

from glidercli.errors import InputError
from glidercli.files import read_toml
from glidercli.vehicle.quantity import Quantity
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["check", "load_vehicle", "shipped_vehicles"]

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
    shipped = shipped_vehicles()
    text = str(name_or_path)
    if text in shipped:
        return _shipped(shipped[text])
    if Path(text).suffix == "" and not Path(text).exists():
        raise InputError(text, f"is no vehicle; shipped are {', '.join(shipped)}, or give a .toml file")
    return _read(Path(text))


@functools.cache
def _shipped(path: Path) -> Vehicle:
    """A shipped vehicle; its file does not change while the program runs."""
    return _read(path)


def _read(path: Path) -> Vehicle:
    """The vehicle of a file."""
    given = read_toml(path, "a vehicle")
    try:
        return TypeAdapter(Vehicle).validate_python(given, context={"file": str(path)})
    except ValidationError as error:
        raise InputError.of_all(path, [_fault(item) for item in error.errors(include_url=False)]) from None


def check(given: dict[str, Any], path: Path) -> tuple[list[str], list[str]]:
    """What the tables of a file lack to be a vehicle, and every other fault that they have."""
    try:
        TypeAdapter(Vehicle).validate_python(given, context={"file": str(path)})
    except ValidationError as error:
        found = error.errors(include_url=False)
        lacking = [".".join(map(str, item["loc"])) for item in found if item["type"] == "missing"]
        return lacking, [_fault(item) for item in found if item["type"] != "missing"]
    return [], []


def _fault(item: Any) -> str:
    """One fault as text: key, value, what is allowed."""
    key = ".".join(str(part) for part in item["loc"])
    match item["type"]:
        case "quantity":
            return f"{key} {item['ctx']['what']}"
        case "missing":
            return f"{key} is missing{_allowed(item['loc'])}"
        case "unexpected_keyword_argument":
            return f"{key} is unknown; known here: {', '.join(_known(item['loc'][:-1]))}"
        case "value_error":
            return str(item["ctx"]["error"])
        case _:
            return f"{key} = {item['input']!r}: {item['msg']}"


def _class_at(location: tuple[Any, ...]) -> Any:
    """The parameter class that stands at a place in the file."""
    cls: Any = Vehicle
    for part in location:
        cls = get_type_hints(cls).get(str(part))
    return cls


def _known(location: tuple[Any, ...]) -> list[str]:
    return [field.name for field in dataclasses.fields(_class_at(location))]


def _allowed(location: tuple[Any, ...]) -> str:
    """What a missing quantity may be, as text; nothing for a missing table."""
    hint = get_type_hints(_class_at(location[:-1]), include_extras=True).get(str(location[-1]))
    found = [extra for extra in get_args(hint) if isinstance(extra, Quantity)]
    return f", allowed {found[0].allowed}" if found else ""
