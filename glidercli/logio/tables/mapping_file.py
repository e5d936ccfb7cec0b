"""Which mapping belongs to a table, and what is wrong with it? Every fault of the file told at once."""

from __future__ import annotations

import dataclasses
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from glidercli.errors import InputError
from glidercli.files import read_toml
from glidercli.logio.tables.mapping import Column, File, Mapping, Missing, Time, column_faults, time_faults

__all__ = ["load_mapping", "mapping_beside"]

COMMON = "columns.toml"
"""The mapping of all tables of a folder."""
_TABLES: dict[str, Any] = {"time": Time, "columns": Column, "missing": Missing, "file": File}
_MOST = 1 << 20
"""bytes; a longer file is no mapping."""


def mapping_beside(table: Path) -> Path | None:
    """NAME.toml beside NAME.csv, or columns.toml in the folder, if it looks like a mapping; else None."""
    own, common = table.with_suffix(".toml"), table.with_name(COMMON)
    if own != table and own.is_file() and _looks_like(own):
        return own
    return common if common.is_file() and (_looks_like(common) is not False) else None


def _looks_like(path: Path) -> bool | None:
    """Whether the file has the tables time and columns; None where it is no TOML."""
    if path.stat().st_size > _MOST:
        return False
    try:
        found = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return isinstance(found.get("time"), dict) and isinstance(found.get("columns"), dict)


def load_mapping(path: Path) -> Mapping:
    """The mapping of a TOML file. Raises InputError with every fault of the file."""
    given = read_toml(path, "a mapping of columns")
    try:
        return TypeAdapter(Mapping).validate_python(given)
    except ValidationError as error:
        items = error.errors(include_url=False)
        raise InputError.of_all(path, [*map(_fault, items), *_untold(given, items)]) from None


def _untold(given: dict[str, Any], items: Sequence[Any]) -> list[str]:
    """The faults of keys together, which are not looked for where one of the keys has a fault of its own."""
    told = {item["loc"] for item in items}
    found = []
    for table, faults_of in (("time", time_faults), ("columns", column_faults)):
        if isinstance(given.get(table), dict) and (table,) not in told:
            found += [f"{table}: {fault}" for fault in faults_of(given[table])]
    return found


def _fault(item: Any) -> str:
    """One fault as text: key, value, what is allowed."""
    key = ".".join(str(part) for part in item["loc"])
    match item["type"]:
        case "missing":
            return f"{key} is missing"
        case "unexpected_keyword_argument":
            return f"{key} is unknown; known here: {', '.join(_known(item['loc'][:-1]))}"
        case "value_error":
            said = "" if isinstance(item["input"], dict) else f" = {item['input']!r}"
            return f"{key}{said}: {item['ctx']['error']}"
        case "dataclass_type":
            return f"{key} is no table; known in it: {', '.join(_known(item['loc']))}"
        case _:
            return f"{key} = {item['input']!r}: {item['msg']}"


def _known(location: tuple[Any, ...]) -> list[str]:
    """The keys that may stand at a place in the file."""
    cls = _TABLES.get(str(location[0]), Mapping) if location else Mapping
    return [field.name for field in dataclasses.fields(cls)]
