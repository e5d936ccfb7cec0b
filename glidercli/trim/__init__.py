"""Which steady flights does a vehicle have? Trims: straight glides and spirals.

The room bears the name of its function: ``glidercli.trim(...)`` calls ``trim`` below.
"""

from __future__ import annotations

import math
import sys
from types import ModuleType
from typing import Any

from glidercli.errors import InputError
from glidercli.trim.result import Trim
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["Trim", "trim"]


def trim(
    vehicle: Vehicle | str = "seawing",
    *,
    net_buoyancy: float,
    mass_position: float,
    mass_rotation: float,
    equations: str = "full",
) -> Trim:
    """The steady flight of three controls, in uniform water of the vehicle's reference density, g = 9.81 m/s2.

    Parameters
    ----------
    vehicle : a Vehicle, the name of a shipped one, or a file.
    net_buoyancy : kg, sinking positive. mass_position : m, forward. mass_rotation : rad.
    equations : "full" keeps C_A and takes the turning radius as horizontal speed over yaw rate; "paper" drops C_A from
        (30), (31) and takes the radius by eq. (33), V cos(theta - alpha) / omega_3.

    Raises
    ------
    InputError
        A control is not finite, the net buoyancy exceeds the vehicle's weight, or ``equations`` is unknown.
    NoSolutionError
        There is no such flight, or none was found: the message says what fails.
    """
    from glidercli.model.parameters import Controls, parameters, without_coupling
    from glidercli.ocean.water import Water
    from glidercli.trim.result import lift_to_drag, speeds
    from glidercli.trim.root import solve_forward
    from glidercli.trim.stability import growth_rate, linearised
    from glidercli.units import STANDARD_GRAVITY
    from glidercli.vehicle import load_vehicle
    from glidercli.vehicle.controls import check_controls

    if equations not in ("full", "paper"):
        raise InputError("equations", f"{equations!r} is not allowed; full or paper")
    craft = vehicle if isinstance(vehicle, Vehicle) else load_vehicle(vehicle)
    check_controls(craft, mass_position, mass_rotation, net_buoyancy)
    p = parameters(craft)
    p = without_coupling(p) if equations == "paper" else p
    water = Water(p.rho_0, 0.0, p.T_0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), STANDARD_GRAVITY)
    controls = Controls(mass_position, mass_rotation, net_buoyancy)
    solution = solve_forward(controls, craft.actuators.mass_position.nominal, water, p)
    speed, alpha, beta, omega3, phi, theta = (float(item) for item in solution.unknowns)
    if mass_rotation == 0.0:
        beta, omega3, phi = 0.0, 0.0, 0.0  # by symmetry; Newton leaves rounding there
    growth = growth_rate(linearised(solution.unknowns, controls, water, p))
    vertical, horizontal = speeds(speed, alpha, beta, phi, theta)
    along = speed * math.cos(theta - alpha) if equations == "paper" else horizontal
    outside = craft.actuators.outside(mass_position, mass_rotation, net_buoyancy)
    fitted = craft.hydrodynamics.fitted_angle
    warnings = [f"{name.replace('_', ' ')} is beyond the limits of {craft.name}" for name in outside]
    warnings += [
        f"{name} {math.degrees(angle):.1f} deg is beyond the fitted {math.degrees(fitted):g} deg"
        for name, angle in (("angle of attack", alpha), ("sideslip", beta))
        if abs(angle) > fitted
    ]
    if growth >= 0.0:
        time = 1.0 / max(growth, 1e-9)
        warnings.append(f"this trim is not stable: a deviation grows e-fold in {time:.3g} s, the flight ends elsewhere")
    return Trim(
        speed=speed,
        angle_of_attack=alpha,
        sideslip=beta,
        yaw_rate=omega3,
        roll=phi,
        pitch=theta,
        mass_position=mass_position,
        mass_rotation=mass_rotation,
        net_buoyancy=net_buoyancy,
        turning_radius=along / omega3 if omega3 else math.inf,
        vertical_speed=vertical,
        horizontal_speed=horizontal,
        lift_to_drag=lift_to_drag(alpha, p),
        residual=solution.residual,
        iterations=solution.iterations,
        method="root",
        equations=equations,
        within_limits=not outside,
        stable=growth < 0.0,
        warnings=tuple(warnings),
    )


class _Room(ModuleType):
    """A package that is called as the function of its own name, since both are ``glidercli.trim``."""

    def __call__(self, *args: Any, **options: Any) -> Trim:
        return trim(*args, **options)


sys.modules[__name__].__class__ = _Room
