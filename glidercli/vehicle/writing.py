"""How do new numbers get into a vehicle file? Into a copy of another file, whose comments and further numbers stay."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any, get_args, get_type_hints

from glidercli.errors import InputError
from glidercli.files import read_toml
from glidercli.vehicle.checking import check
from glidercli.vehicle.load import shipped_vehicles
from glidercli.vehicle.quantity import Quantity
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["Number", "revised"]

_DIGITS = 6
"""significant, of a number that is written: below any standard error that coefficients have."""


@dataclasses.dataclass(frozen=True)
class Number:
    """A number for a vehicle file: its value in SI (rad), and where it comes from."""

    value: float | tuple[float, float, float]
    source: str
    symbol: str = ""
    note: str = ""


def revised(
    base: Path | None, tables: Mapping[str, Mapping[str, Number]], *, name: str, changed: str
) -> tuple[str, list[str]]:
    """The text of a vehicle file with numbers replaced or added, and the names of what it still lacks to be whole.

    base : a vehicle file; tables and numbers may be missing in it. Its comments stay. None begins a new file.
    tables : numbers by table and key, as {"added_mass": {"mass": Number(...)}}; their units are the vehicle's.
    name : of the new vehicle, if it is new or the base a shipped one; a file of the user's keeps its own.
    changed : what was changed, for its description.

    Raises
    ------
    InputError
        The base cannot be read, or a number, its own or a new one, is none that a vehicle can have.
    """
    import tomlkit

    document: Any = tomlkit.document()
    if base is not None:
        read_toml(base, "a vehicle")
        document = tomlkit.parse(base.read_text(encoding="utf-8-sig"))
    if base is None or base in shipped_vehicles().values():
        document["name"] = name
    told = document.get("description")
    if isinstance(told, str) and changed not in told:
        document["description"] = f"{told}; {changed}"
    for table, numbers in tables.items():
        if not isinstance(document.setdefault(table, tomlkit.table()), dict):
            raise InputError(base or name, f"{table} = {document[table]!r} is no table; write [{table}]")
        for key, number in numbers.items():
            document[table][key] = _entry(_unit(table, key), number)
    text = tomlkit.dumps(document)
    missing, faults = check(Vehicle, document.unwrap(), base or Path(name))
    if faults:
        raise InputError.of_all(base or name, faults)
    return text, missing


def _unit(table: str, key: str) -> Quantity:
    """What a vehicle file says of a number."""
    hints = get_type_hints(get_type_hints(Vehicle)[table], include_extras=True)
    return next(extra for extra in get_args(hints[key]) if isinstance(extra, Quantity))


def _entry(quantity: Quantity, number: Number) -> Any:
    """A number as it stands in a file: { value, unit, symbol, source, note }."""
    import tomlkit

    values = number.value if isinstance(number.value, tuple) else (number.value,)
    written = [float(f"{quantity.in_file(value):.{_DIGITS}g}") for value in values]
    entry = tomlkit.inline_table()
    entry["value"] = written if isinstance(number.value, tuple) else written[0]
    entry["unit"] = quantity.unit
    for key in ("symbol", "source", "note"):
        if getattr(number, key):
            entry[key] = getattr(number, key)
    return entry
