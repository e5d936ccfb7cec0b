"""Can a vehicle have these controls at all? What no vehicle can have is refused; what lies beyond its limits is not."""

from __future__ import annotations

import math

from glidercli.errors import InputError
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["check_controls"]


def check_controls(vehicle: Vehicle, mass_position: float, mass_rotation: float, net_buoyancy: float) -> None:
    """Refuse controls (SI, rad) that are not finite, and more net buoyancy than the vehicle weighs.

    Controls beyond the vehicle's own limits pass: designers ask what they would do (Actuators.outside names them).
    """
    given = {"net buoyancy": net_buoyancy, "mass position": mass_position, "mass rotation": mass_rotation}
    for name, value in given.items():
        if not math.isfinite(value):
            raise InputError(name, f"{value} is not allowed; a finite number is needed")
    most = vehicle.mass.displaced_mass
    if abs(net_buoyancy) > most:
        raise InputError(
            "net buoyancy", f"{net_buoyancy:g} kg, allowed {-most:g}..{most:g} kg, what {vehicle.name} weighs"
        )
