"""Which mission is meant, and what is wrong with its file? By shipped name or path; every fault told at once."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from glidercli import shipped
from glidercli.errors import InputError
from glidercli.files import read_toml
from glidercli.simulation.instruments.settings import Compass, Ctd, Gps, Instruments, Pressure
from glidercli.simulation.mission import ActuatorChanges, Mission, Steering
from glidercli.simulation.mission_legs import (
    KINDS,
    Climb,
    ControlsLeg,
    Dive,
    Drift,
    HoldHeading,
    Repeat,
    Spiral,
    Wait,
)

__all__ = ["fault", "load_mission"]

_TABLES = {
    "actuators": ActuatorChanges, "steering": Steering, "dive": Dive, "climb": Climb, "spiral": Spiral,
    "hold-heading": HoldHeading, "drift": Drift, "wait": Wait, "controls": ControlsLeg, "repeat": Repeat,
    "instruments": Instruments, "compass": Compass, "pressure": Pressure, "ctd": Ctd, "gps": Gps,
}  # fmt: skip
"""What the tables of a file become, by name or kind."""


def load_mission(name_or_path: str | Path) -> tuple[Mission, Path]:
    """A mission and the file that it came from, by shipped name or path.

    Raises InputError with every fault of the file at once.
    """
    path = shipped.file_of(name_or_path, shipped.missions(), "mission")
    given = read_toml(path, "a mission")
    try:
        return TypeAdapter(Mission).validate_python(given), path
    except ValidationError as error:
        raise InputError.of_all(path, [fault(item) for item in error.errors(include_url=False)]) from None


def fault(item: Any, top: Any = Mission) -> str:
    """One fault as text: the leg, the key, its value, what is allowed. top : what the whole file is."""
    where, key = _place(item["loc"])
    if item["type"] == "missing":
        what = f"{key} is missing"
    elif item["type"] in ("unexpected_keyword_argument", "extra_forbidden"):
        what = f"{key} is unknown; known here: {', '.join(_known(item['loc'][:-1], top))}"
    elif item["type"] == "value_error":
        what = " ".join(part for part in (key, str(item["ctx"]["error"])) if part)
    elif item["type"] == "dataclass_type":
        what = f"{key} = {item['input']!r}, a table is needed"
    elif item["type"] == "tuple_type":
        what = f"{key} is no list of tables; write [[{key}]] above each"
    elif item["type"].startswith("union_tag"):
        said = item["input"].get("kind") if isinstance(item["input"], dict) else item["input"]
        what = f"kind = {said!r}, allowed: {', '.join(KINDS)}" if said else f"has no kind; allowed: {', '.join(KINDS)}"
    else:
        what = f"{key} = {item['input']!r}: {item['msg']}"
    return f"{where}: {what}" if where else what


def _known(location: tuple[Any, ...], top: Any) -> list[str]:
    """The keys that may stand at a place in the file."""
    cls = top
    for part in location:
        if isinstance(part, str):
            cls = _TABLES.get(part, cls)
    return [field.name for field in dataclasses.fields(cls)]


def _place(location: tuple[Any, ...]) -> tuple[str, str]:
    """Where a fault is, for people, who count legs from one; and its key: leg 2 (dive), pitch_deg."""
    where, rest = [], list(location)
    while len(rest) > 1 and rest[0] == "leg" and isinstance(rest[1], int):
        number, rest = rest[1] + 1, rest[2:]
        kind = f" ({rest.pop(0)})" if rest and rest[0] in KINDS else ""
        where.append(f"leg {number}{kind}")
    return ", ".join(where), ".".join(str(part) for part in rest)
