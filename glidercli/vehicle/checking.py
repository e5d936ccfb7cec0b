"""What is wrong with a file of quantities? Every fault of its tables, as ``key = value unit, allowed range``."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any, TypeVar, get_args, get_type_hints

from pydantic import TypeAdapter, ValidationError

from glidercli.errors import InputError
from glidercli.vehicle.quantity import Quantity

__all__ = ["check", "checked"]

T = TypeVar("T")


def checked(cls: type[T], given: dict[str, Any], path: Path) -> T:
    """The tables of a file as a frozen class; InputError with every fault if they are none."""
    try:
        return TypeAdapter(cls).validate_python(given, context={"file": str(path)})
    except ValidationError as error:
        raise InputError.of_all(path, [_fault(cls, item) for item in error.errors(include_url=False)]) from None


def check(cls: type, given: dict[str, Any], path: Path) -> tuple[list[str], list[str]]:
    """What the tables of a file lack, and every other fault that they have."""
    try:
        TypeAdapter(cls).validate_python(given, context={"file": str(path)})
    except ValidationError as error:
        found = error.errors(include_url=False)
        lacking = [".".join(map(str, item["loc"])) for item in found if item["type"] == "missing"]
        return lacking, [_fault(cls, item) for item in found if item["type"] != "missing"]
    return [], []


def _fault(cls: type, item: Any) -> str:
    """One fault as text: key, value, what is allowed."""
    key = ".".join(str(part) for part in item["loc"])
    match item["type"]:
        case "quantity":
            return f"{key} {item['ctx']['what']}"
        case "missing":
            return f"{key} is missing{_allowed(cls, item['loc'])}"
        case "unexpected_keyword_argument":
            return f"{key} is unknown; known here: {', '.join(_known(cls, item['loc'][:-1]))}"
        case "dataclass_type" | "dict_type":
            return f"{key} = {item['input']!r} is no table; write [{key}]"
        case "value_error":
            told = str(item["ctx"]["error"])
            return told if told.startswith(key) else f"{key}: {told}"
        case _:
            return f"{key} = {item['input']!r}: {item['msg']}"


def _class_at(cls: Any, location: tuple[Any, ...]) -> Any:
    """The class that stands at a place in the file; of a table of tables, that of each."""
    for part in location:
        of_each = get_args(cls)
        cls = of_each[1] if len(of_each) == 2 else get_type_hints(cls).get(str(part))
    return cls


def _known(cls: type, location: tuple[Any, ...]) -> list[str]:
    return [field.name for field in dataclasses.fields(_class_at(cls, location))]


def _allowed(cls: type, location: tuple[Any, ...]) -> str:
    """What a missing quantity may be, as text; nothing for a missing table."""
    hint = get_type_hints(_class_at(cls, location[:-1]), include_extras=True).get(str(location[-1]))
    found = [extra for extra in get_args(hint) if isinstance(extra, Quantity)]
    return f", allowed {found[0].allowed}" if found else ""
