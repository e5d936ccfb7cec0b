"""Which steady flights does a vehicle have? Trims: straight glides and spirals.

The room bears the name of its function: ``glidercli.trim(...)`` calls ``trim`` below.
"""

from __future__ import annotations

import math
import sys
from types import ModuleType
from typing import TYPE_CHECKING, Any

from glidercli.errors import InputError, NoSolutionError
from glidercli.trim.result import Trim
from glidercli.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from collections.abc import Callable

    from glidercli.model.parameters import Parameters
    from glidercli.ocean.water import Water
    from glidercli.trim.recursion import Recursion

__all__ = ["Trim", "trim", "trims_by_recursion"]


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
    from glidercli.model.parameters import Controls
    from glidercli.trim.result import trim_of
    from glidercli.trim.root import solve_forward
    from glidercli.vehicle.controls import check_controls

    craft, p, water = _setting(vehicle, equations)
    check_controls(craft, mass_position, mass_rotation, net_buoyancy)
    controls = Controls(mass_position, mass_rotation, net_buoyancy)
    found = solve_forward(controls, craft.actuators.mass_position.nominal, water, p)
    x = [float(item) for item in found.unknowns]
    if mass_rotation == 0.0:
        x[2] = x[3] = x[4] = 0.0  # beta, omega_3, phi: by symmetry; Newton leaves rounding there
    return trim_of(
        x, controls, craft, water, p,
        equations=equations, method="root", residual=found.residual, iterations=found.iterations,
    )  # fmt: skip


def trims_by_recursion(
    vehicle: Vehicle | str = "seawing",
    *,
    speed: float,
    angle_of_attack: float,
    sideslip: float,
    printed: bool = False,
    look: Callable[[list[Recursion]], None] | None = None,
) -> list[Trim]:
    """The steady flights of a speed, angle of attack and sideslip, by the paper's recursion and its equations.

    vehicle : as for ``trim``. speed : m/s. angle_of_attack, sideslip : rad, within 90 deg.
    printed : the recursion as it is printed, for the record; it finds hardly anything.
    look : called with the sequences, whatever comes of them.

    Returns every trim found, those within the vehicle's limits first, the quadrants of Table 4 before others, stable
    before unstable.

    Raises
    ------
    InputError
        The speed is not positive, or an angle is not within 90 deg.
    NoSolutionError
        No sequence reaches a trim; the message names the equation furthest from zero at the nearest point.
    """
    from glidercli.model.hydrodynamics import velocity_from_flow
    from glidercli.trim.printed import printed_recursions
    from glidercli.trim.recursion import nearest_miss, recursions
    from glidercli.trim.result import ranked, trim_of

    if not (math.isfinite(speed) and speed > 0.0):
        raise InputError("speed", f"{speed} m/s is not allowed; a finite number greater than 0 is needed")
    for name, angle in (("angle of attack", angle_of_attack), ("sideslip", sideslip)):
        if not abs(angle) < 0.5 * math.pi:
            raise InputError(name, f"{math.degrees(angle):g} deg is not allowed; -90 to 90 are, ends left out")
    craft, p, water = _setting(vehicle, "paper")
    run, method = (printed_recursions, "recursion-printed") if printed else (recursions, "recursion")
    sequences = run(speed, angle_of_attack, sideslip, craft.actuators.mass_position.nominal, water, p)
    if look is not None:
        look(sequences)
    found = [
        trim_of(
            (speed, angle_of_attack, sideslip, one.last.omega3, one.last.roll, one.last.pitch), one.controls, craft,
            water, p, equations="paper", method=method, residual=one.residual, iterations=len(one.iterates),
        )
        for one in sequences
        if one.converged
    ]  # fmt: skip
    if not found:
        miss = nearest_miss(sequences, velocity_from_flow(speed, angle_of_attack, sideslip), water, p)
        raise NoSolutionError(miss + ("; as printed the recursion finds hardly any: use --method recursion" * printed))
    return ranked(found, craft.actuators.mass_position.nominal)


def _setting(vehicle: Vehicle | str, equations: str) -> tuple[Vehicle, Parameters, Water]:
    """The vehicle, its parameters in the wanted form, and the uniform water of its reference density."""
    from glidercli.model.parameters import parameters, without_coupling
    from glidercli.ocean.water import Water
    from glidercli.units import STANDARD_GRAVITY
    from glidercli.vehicle import load_vehicle

    if equations not in ("full", "paper"):
        raise InputError("equations", f"{equations!r} is not allowed; full or paper")
    craft = vehicle if isinstance(vehicle, Vehicle) else load_vehicle(vehicle)
    p = parameters(craft)
    p = without_coupling(p) if equations == "paper" else p
    return craft, p, Water(p.rho_0, 0.0, p.T_0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), STANDARD_GRAVITY)


class _Room(ModuleType):
    """A package that is called as the function of its own name, since both are ``glidercli.trim``."""

    def __call__(self, *args: Any, **options: Any) -> Trim:
        return trim(*args, **options)


sys.modules[__name__].__class__ = _Room
