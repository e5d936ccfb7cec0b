"""What is to be flown? A mission file: its water and current, where and when it starts, its legs and controls.

name = "..."                    description = "..."
reconstruction = "..."          what is reconstructed and from what; marks every output. Leave out for a plan.
vehicle = "seawing"             name, or file beside the mission
ctd = "water.csv"               files beside the mission; both may be left out
adcp = "current.csv"
start_time = 2011-07-20T04:28:00Z
latitude = 7.0                  deg; sets gravity. longitude = 130.0 places the track
heading_deg = 50.0              of the start; start_depth_m = 0.0
neutral_density_kg_m3 = 1022.0  ballasted so that zero net buoyancy is neutral there; default: the vehicle's
duration_s = 6120.0             the flight ends here at the latest

[[leg]]
name = "dive"
controls = "dive.csv"           elapsed_s (of the leg), mass_position_m, mass_rotation_deg, net_buoyancy_kg
until_depth_m = 800.0           optional: the leg ends there, else with its controls or the flight
"""

from __future__ import annotations

import datetime
from pathlib import Path
from typing import Any

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from glidercli import shipped
from glidercli.errors import InputError
from glidercli.files import read_toml

__all__ = ["Leg", "Mission", "load_mission"]

_CONFIG = ConfigDict(extra="forbid", strict=False)


@dataclass(frozen=True, config=_CONFIG)
class Leg:
    """One leg: its controls, and the depth that ends it."""

    name: str
    controls: str
    until_depth_m: float | None = Field(default=None, ge=0.0, le=12000.0, allow_inf_nan=False)


@dataclass(frozen=True, config=_CONFIG)
class Mission:
    """A mission as its file gives it; paths are relative to the file."""

    name: str
    description: str
    leg: tuple[Leg, ...] = Field(min_length=1)
    duration_s: float = Field(gt=0.0, le=1e8, allow_inf_nan=False)
    vehicle: str = "seawing"
    reconstruction: str | None = None
    ctd: str | None = None
    adcp: str | None = None
    start_time: datetime.datetime | None = None
    latitude: float | None = Field(default=None, ge=-90.0, le=90.0, allow_inf_nan=False)
    longitude: float | None = Field(default=None, ge=-180.0, le=360.0, allow_inf_nan=False)
    heading_deg: float = Field(default=0.0, ge=-360.0, le=360.0, allow_inf_nan=False)
    start_depth_m: float = Field(default=0.0, ge=0.0, le=12000.0, allow_inf_nan=False)
    neutral_density_kg_m3: float | None = Field(default=None, ge=900.0, le=1200.0, allow_inf_nan=False)


def load_mission(name_or_path: str | Path) -> tuple[Mission, Path]:
    """A mission and the file that it came from, by shipped name or path.

    Raises InputError with every fault of the file at once.
    """
    text = str(name_or_path)
    folder = shipped.find(text)
    if folder is not None:
        path = folder / "mission.toml"
    elif Path(text).suffix == "" and not Path(text).exists():
        raise InputError(text, f"is no mission; shipped are {', '.join(shipped.folders())}, or give a .toml file")
    else:
        path = Path(text)
    given = read_toml(path, "a mission")
    try:
        return TypeAdapter(Mission).validate_python(given), path
    except ValidationError as error:
        raise InputError(path, "; ".join(_fault(item) for item in error.errors(include_url=False))) from None


def _fault(item: Any) -> str:
    key = ".".join(str(part) for part in item["loc"])
    if item["type"] == "missing":
        return f"{key} is missing"
    if item["type"] == "unexpected_keyword_argument":
        return f"{key} is unknown"
    return f"{key} = {item['input']!r}: {item['msg']}"
