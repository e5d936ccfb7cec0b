"""What does a flight cost? Pump, motors and hotel load, in J of the battery; and how far that battery carries.

pump      work against the sea's pressure / efficiency of the pump          (letting oil back in costs nothing)
motors    power x travel / rate, of slide and rotation
hotel     power x duration
endurance = battery / (total / duration)        range = endurance x distance over ground / duration
"""

from __future__ import annotations

import dataclasses
import math

from glidercli.simulation.actuators import Drives
from glidercli.simulation.flight import Tallies
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["Costs", "costs"]


@dataclasses.dataclass(frozen=True)
class Costs:
    """Energy in J. lost_to_water : by drag and moments, what the flight itself dissipates, no cost of the battery.

    dives : apogees. battery : J. endurance : s, range : m, of a full battery spent like this.
    """

    lost_to_water: float
    pump_work: float
    pump: float
    slide: float
    rotation: float
    hotel: float
    dives: int
    battery: float
    endurance: float
    range: float

    @property
    def total(self) -> float:
        """J from the battery."""
        return self.pump + self.slide + self.rotation + self.hotel

    @property
    def per_dive(self) -> float:
        """J; NaN without a whole dive."""
        return self.total / self.dives if self.dives else math.nan

    def document(self) -> dict[str, float | int]:
        """For JSON, with units."""
        return {
            "lost_to_water_j": self.lost_to_water,
            "pump_work_j": self.pump_work,
            "pump_j": self.pump,
            "slide_j": self.slide,
            "rotation_j": self.rotation,
            "hotel_j": self.hotel,
            "total_j": self.total,
            "dives": self.dives,
            "per_dive_j": self.per_dive,
            "battery_j": self.battery,
            "endurance_s": self.endurance,
            "range_m": self.range,
        }


def costs(
    tallies: Tallies, craft: Vehicle, drives: Drives, *, duration: float, distance: float, dives: int, lost: float
) -> Costs:
    """The costs of a flight of a duration, s, and a track of a distance, m, over ground. lost : J, to the water."""
    slide, turn, pump = craft.actuators.mass_position, craft.actuators.mass_rotation, craft.actuators.net_buoyancy
    found = Costs(
        lost_to_water=lost,
        pump_work=tallies.pump_work,
        pump=tallies.pump_work / pump.pump_efficiency,
        slide=slide.power * tallies.slid / drives.rrx_rate,
        rotation=turn.power * tallies.rotated / drives.gamma_rate,
        hotel=craft.energy.hotel_power * duration,
        dives=dives,
        battery=craft.energy.battery,
        endurance=math.inf,
        range=math.inf,
    )
    if found.total == 0.0 or duration == 0.0:
        return found
    endurance = craft.energy.battery / found.total * duration
    return dataclasses.replace(found, endurance=endurance, range=endurance * distance / duration)
