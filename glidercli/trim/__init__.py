"""Which steady flights does a vehicle have? Trims: straight glides and spirals.

The room bears the name of its function: ``glidercli.trim(...)`` calls ``trim`` below.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import TYPE_CHECKING, Any

from glidercli.errors import InputError, NoSolutionError
from glidercli.trim.result import Trim
from glidercli.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from glidercli.model.parameters import Parameters
    from glidercli.ocean.water import Water
    from glidercli.trim.polars import Journey, Polar
    from glidercli.trim.recursion import Recursion
    from glidercli.trim.sweeping import Axis, TrimMap

__all__ = ["Trim", "polar", "sweep", "trim", "trims", "trims_by_recursion"]


def trim(vehicle: Vehicle | str = "seawing", *, equations: str = "full", **pins: float) -> Trim:
    """The steady flight of three pinned quantities: the first of ``trims``, which see."""
    return trims(vehicle, equations=equations, **pins)[0]


def trims(
    vehicle: Vehicle | str = "seawing",
    *,
    equations: str = "full",
    speed: float | None = None,
    angle_of_attack: float | None = None,
    sideslip: float | None = None,
    yaw_rate: float | None = None,
    roll: float | None = None,
    pitch: float | None = None,
    mass_position: float | None = None,
    mass_rotation: float | None = None,
    net_buoyancy: float | None = None,
    turning_radius: float | None = None,
) -> list[Trim]:
    """Every steady flight with three pinned quantities, in uniform water of the reference density, g = 9.81 m/s2.

    Those within the vehicle's limits come first, the quadrants of Table 4 before others, stable before unstable.

    Parameters
    ----------
    vehicle : a Vehicle, the name of a shipped one, or a file.
    equations : "full" keeps C_A and takes the turning radius as horizontal speed over yaw rate; "paper" drops C_A from
        (30), (31) and takes the radius by eq. (33), V cos(theta - alpha) / omega_3.
    speed : m/s, through water. angle_of_attack, sideslip, roll, pitch : rad. yaw_rate : rad/s about the vertical, to
        starboard positive; 0 asks for a straight glide. mass_position : m, forward. mass_rotation : rad. net_buoyancy :
        kg, sinking positive. turning_radius : m, signed as the yaw rate.

    Raises
    ------
    UsageError
        Not three pins, or pins that depend on or contradict one another.
    InputError
        A pin that no vehicle can have, or ``equations`` is unknown.
    NoSolutionError
        There is no such flight, or none was found: the message says what fails, where.
    """
    from glidercli.model.parameters import symmetric
    from glidercli.trim.pins import question
    from glidercli.trim.result import answered
    from glidercli.trim.root import solutions

    given = {
        "speed": speed, "angle_of_attack": angle_of_attack, "sideslip": sideslip, "yaw_rate": yaw_rate, "roll": roll,
        "pitch": pitch, "mass_position": mass_position, "mass_rotation": mass_rotation, "net_buoyancy": net_buoyancy,
        "turning_radius": turning_radius,
    }  # fmt: skip
    craft, p, water = _setting(vehicle, equations)
    asked = question(given, craft, symmetric(p))
    found = solutions(asked, craft, equations == "paper", water, p)
    return answered(found, craft, water, p, equations=equations, method="root")


def sweep(
    vehicle: Vehicle | str,
    axes: Sequence[Axis],
    *,
    equations: str = "full",
    linearize: bool = False,
    progress: Callable[[float, float], None] | None = None,
    **pins: float,
) -> TrimMap:
    """Every steady flight at every point of a grid: axes are swept, pins are held; together three.

    vehicle, equations, pins : as for ``trims``. axes : names and values, SI and rad. linearize : whether the linear
    model of each is wanted. progress : is told the points searched and the points to search. Raises as ``trims`` does;
    InputError also for more than a million points.
    """
    from glidercli.trim.sweeping import trims_over

    craft, p, water = _setting(vehicle, equations)
    return trims_over(tuple(axes), pins, craft, equations, water, p, linearize=linearize, progress=progress)


def polar(
    vehicle: Vehicle | str = "seawing",
    *,
    net_buoyancy: float | None = None,
    journey: Journey | None = None,
    equations: str = "full",
) -> Polar:
    """The straight glides of a vehicle, and the best, the fastest and the cheapest of them.

    net_buoyancy : kg; without one, five shares of the largest to either side. journey : the current against the
    vehicle and the power besides the pump's; none by default. Raises InputError for what no vehicle can have.
    """
    from glidercli.trim.polars import Journey
    from glidercli.trim.polars import polar as of

    craft, p, water = _setting(vehicle, equations)
    return of(craft, net_buoyancy, journey or Journey(), equations, water, p)


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
        A speed or an angle that no vehicle can have.
    NoSolutionError
        Stalled flight is asked for, or no sequence reaches a trim; the message names the equation furthest from zero at
        the nearest point.
    """
    from glidercli.model.hydrodynamics import velocity_from_flow
    from glidercli.trim.pins import allowed
    from glidercli.trim.printed import printed_recursions
    from glidercli.trim.recursion import nearest_miss, recursions
    from glidercli.trim.result import answered

    craft, p, water = _setting(vehicle, "paper")
    for name, value in (("speed", speed), ("angle_of_attack", angle_of_attack), ("sideslip", sideslip)):
        allowed(name, value, craft)
    run, method = (printed_recursions, "recursion-printed") if printed else (recursions, "recursion")
    sequences = run(speed, angle_of_attack, sideslip, craft.actuators.mass_position.nominal, water, p)
    if look is not None:
        look(sequences)
    found = [
        (
            (speed, angle_of_attack, sideslip, one.last.omega3, one.last.roll, one.last.pitch, *one.controls[:3]),
            len(one.iterates),
        )
        for one in sequences
        if one.converged
    ]
    if not found:
        miss = nearest_miss(sequences, velocity_from_flow(speed, angle_of_attack, sideslip), water, p)
        raise NoSolutionError(miss + ("; as printed the recursion finds hardly any: use --method recursion" * printed))
    return answered(found, craft, water, p, equations="paper", method=method)


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
