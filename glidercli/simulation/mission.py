"""What is to be flown? A mission file: its water and current, where and when it starts, its legs.

name = "..."                    description = "..."
reconstruction = "..."          what is reconstructed and from what; marks every output. Leave out for a plan.
vehicle = "seawing"             name, or file beside the mission
ctd = "water.csv"               files beside the mission; both may be left out
adcp = "current.csv"
start_time = 2011-07-20T04:28:00Z
latitude = 7.0                  deg; sets gravity. longitude = 130.0 places the track
heading_deg = 50.0              of the start; start_depth_m = 0.0
neutral_density_kg_m3 = 1022.0  ballasted so that zero net buoyancy is neutral there; default: the vehicle's
bottom_m = 1000.0               default: none
duration_s = 6120.0             the flight ends here at the latest

[[leg]]                         one after the other; docs/missions.md shows every kind
kind = "dive"                   dive, climb, spiral, hold-heading, drift, wait, controls
pitch_deg = -30.0
net_buoyancy_kg = 0.3
until_depth_m = 800.0

[actuators]                     limits and rates in place of the vehicle's
[steering]                      period, dead bands and gains of the controllers
[instruments.compass]           what records the flight, also .pressure, .ctd, .gps: docs/instruments.md
seed = 0                        of the instruments' noise
"""

from __future__ import annotations

import datetime
from typing import Annotated, Self

from pydantic import ConfigDict, Field, model_validator
from pydantic.dataclasses import dataclass

from glidercli.simulation.instruments.settings import MOST_SEED, Instruments
from glidercli.simulation.mission_legs import MOST_LEGS, ControlsLeg, MissionLeg, count, places
from glidercli.simulation.ranges import Buoyancy, Depth, Heading, Seconds, number, positive
from glidercli.years import FIRST_YEAR, LAST_YEAR

__all__ = ["ActuatorChanges", "Mission", "Steering"]

_CONFIG = ConfigDict(extra="forbid", strict=False)
_YEARS = (FIRST_YEAR, LAST_YEAR - 5)  # of the start: the longest flight then ends before the last time allowed


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class ActuatorChanges:
    """Limits and rates in place of the vehicle's own."""

    mass_position_min_m: Annotated[float, number(-5.0, 5.0)] | None = None
    mass_position_max_m: Annotated[float, number(-5.0, 5.0)] | None = None
    mass_position_rate_mm_s: Annotated[float, number(0.01, 1000.0)] | None = None
    mass_rotation_min_deg: Annotated[float, number(-180.0, 180.0)] | None = None
    mass_rotation_max_deg: Annotated[float, number(-180.0, 180.0)] | None = None
    mass_rotation_rate_deg_s: Annotated[float, number(0.01, 360.0)] | None = None
    net_buoyancy_min_kg: Buoyancy | None = None
    net_buoyancy_max_kg: Buoyancy | None = None
    pump_rate_cm3_s: Annotated[float, number(0.01, 1e5)] | None = None
    pump_slowing_per_dbar: Annotated[float, number(0.0, 0.01)] | None = None
    return_rate_cm3_s: Annotated[float, number(0.01, 1e5)] | None = None


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Steering:
    """The controllers: how often they look, how much they leave alone, how hard they pull (simulation/autopilot.py)."""

    period_s: Annotated[float, number(0.1, 3600.0)] = 6.0
    """The trial's sampling."""
    pitch_band_deg: Annotated[float, number(0.0, 30.0)] = 0.5
    pitch_gain: Annotated[float, positive(1.0)] = 0.1
    """Share of the mass position's error, by static balance, that a sample takes back."""
    heading_band_deg: Annotated[float, number(0.0, 45.0)] = 0.5
    """A change of rotation below it is left alone."""
    heading_gain: Annotated[float, positive(100.0)] = 1.0
    """deg of rotation for a deg of heading."""
    turn_gain_s: Annotated[float, positive(1e4)] = 20.0
    """deg of rotation for a deg/s of turn rate, a sample."""


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Mission:
    """A mission as its file gives it; paths are relative to the file."""

    name: str
    description: str
    leg: tuple[MissionLeg, ...]
    duration_s: Seconds | None = None
    vehicle: str = "seawing"
    reconstruction: str | None = None
    ctd: str | None = None
    adcp: str | None = None
    start_time: datetime.datetime | None = None
    latitude: Annotated[float, number(-90.0, 90.0)] | None = None
    longitude: Annotated[float, number(-180.0, 360.0)] | None = None
    heading_deg: Heading = 0.0
    start_depth_m: Depth = 0.0
    neutral_density_kg_m3: Annotated[float, number(900.0, 1200.0)] | None = None
    bottom_m: Annotated[float, number(1.0, 12000.0)] | None = None
    actuators: ActuatorChanges = ActuatorChanges()
    steering: Steering = Steering()
    instruments: Instruments | None = None
    seed: Annotated[int, Field(ge=0, le=MOST_SEED, strict=True)] = 0
    """Of the instruments."""

    @model_validator(mode="after")
    def _check(self) -> Self:
        faults = [] if count(self.leg) else ["leg = [], at least one is needed"]
        over = [place for place, leg in places(self.leg) if getattr(leg, "until_altitude_m", None) is not None]
        if self.bottom_m is None and over:
            faults.append(f"{over[0]}: until_altitude_m needs the mission's bottom_m, the depth of the bottom")
        if self.start_time is not None and not _YEARS[0] <= self.start_time.year <= _YEARS[1]:
            faults.append(f"start_time = {self.start_time.isoformat()}, allowed the years {_YEARS[0]} to {_YEARS[1]}")
        if self.bottom_m is not None and self.start_depth_m >= self.bottom_m:
            faults.append(f"start_depth_m = {self.start_depth_m:g}, allowed less than bottom_m = {self.bottom_m:g}")
        last = self.leg[-1] if self.leg else None
        if self.duration_s is None and isinstance(last, ControlsLeg) and not (last.until_depth_m or last.duration_s):
            faults.append(
                f"leg {len(self.leg)} (controls) is the last and cannot end; needed is until_depth_m, or duration_s of "
                "the leg or of the mission"
            )
        if count(self.leg) > MOST_LEGS:
            faults.append(f"repeats make more than {MOST_LEGS} legs, the most allowed")
        if faults:
            raise ValueError("; ".join(faults))
        return self
