"""What is asked? Three pinned quantities of the ten of a steady flight, checked before anything is solved."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from glidercli.errors import InputError, NoSolutionError, UsageError
from glidercli.trim.steady import CURVATURE, Pins
from glidercli.units import DEGREE
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["QUANTITIES", "STALL_RATIO", "Quantity", "Question", "allowed", "question", "spelled"]

STALL_RATIO = 1.5
"""An angle of attack beyond so many times the fitted range is called stalled: 18 deg where 12 deg were fitted. Lift
that is linear in it, eq. (20), has no stall; thin wings at these Reynolds numbers lose theirs from 10 to 18 deg."""


class Quantity(NamedTuple):
    """One of the ten. place : where in the unknowns. factor : what brings the unit of options and tables to SI. least,
    most : what is allowed, in that unit. lateral : zero in straight flight."""

    place: int
    unit: str
    factor: float
    least: float
    most: float
    lateral: bool


QUANTITIES = {
    "speed": Quantity(0, "m/s", 1.0, 1e-3, 10.0, False),
    "angle_of_attack": Quantity(1, "deg", DEGREE, -90.0, 90.0, False),
    "sideslip": Quantity(2, "deg", DEGREE, -90.0, 90.0, True),
    "yaw_rate": Quantity(3, "deg/s", DEGREE, -180.0, 180.0, True),
    "roll": Quantity(4, "deg", DEGREE, -180.0, 180.0, True),
    "pitch": Quantity(5, "deg", DEGREE, -90.0, 90.0, False),
    "mass_position": Quantity(6, "m", 1.0, -10.0, 10.0, False),
    "mass_rotation": Quantity(7, "deg", DEGREE, -180.0, 180.0, True),
    "net_buoyancy": Quantity(8, "kg", 1.0, -math.inf, math.inf, False),
    "turning_radius": Quantity(CURVATURE, "m", 1.0, -1e6, 1e6, True),
}
"""The ten, by name; the options of the command line are these names. The vehicle's mass bounds its net buoyancy."""


class Question(NamedTuple):
    """Three pins. names : what was asked. pins : their places; a turning radius is its curvature. values : SI, rad,
    1/m."""

    names: tuple[str, str, str]
    pins: Pins
    values: tuple[float, float, float]


def spelled(name: str) -> str:
    """The option of a quantity."""
    return "--" + name.replace("_", "-")


def allowed(name: str, value: float, craft: Vehicle) -> float:
    """The value (SI, rad) of a quantity, after checking that it is one that a vehicle can have; else InputError.

    Values beyond the vehicle's own limits pass: designers ask what they would do. Vertical flight is refused here.
    """
    q, words = QUANTITIES[name], name.replace("_", " ")
    least, most = q.least, q.most
    if name == "net_buoyancy":
        least, most = -craft.mass.displaced_mass, craft.mass.displaced_mass
    if math.isinf(value) and name == "turning_radius":
        return value
    told = f"{value / q.factor:g} {q.unit}"
    if not math.isfinite(value):
        raise InputError(words, f"{value} is not allowed; a finite number is needed")
    if not least - 1e-9 <= value / q.factor <= most + 1e-9:
        weight = f", what {craft.name} weighs" if name == "net_buoyancy" else ""
        raise InputError(words, f"{told} is not allowed; {least:g} to {most:g} {q.unit} are{weight}")
    if name == "pitch" and abs(value) > 89.9 * DEGREE:
        raise NoSolutionError(
            f"pitch {told}: vertical flight is no glide; it has no heading and no turning radius, and only lift of "
            "exactly zero would hold it"
        )
    if name in ("angle_of_attack", "sideslip") and abs(value) >= 90.0 * DEGREE:
        raise InputError(words, f"{told} is not allowed; the flow must come from ahead, between -90 and 90 deg")
    stalled = STALL_RATIO * craft.hydrodynamics.fitted_angle
    if name == "angle_of_attack" and abs(value) > stalled:
        raise NoSolutionError(
            f"angle of attack {told}: stalled flight; the linear lift of eq. (20) says nothing beyond "
            f"{stalled / DEGREE:g} deg, {STALL_RATIO:g} times the fitted {craft.hydrodynamics.fitted_angle / DEGREE:g}"
        )
    if name == "turning_radius" and abs(value) < 1e-3:
        raise InputError(words, f"{told} is not allowed; at least 0.001 m to either side, or inf for a straight glide")
    if name == "net_buoyancy" and abs(value) < 1e-9:
        raise NoSolutionError("net buoyancy 0 kg: a neutral glider has no steady flight; give a value other than 0")
    return value


def question(given: Mapping[str, float | None], craft: Vehicle, symmetric: bool) -> Question:
    """Three pins (SI, rad) as a question.

    symmetric : whether the vehicle is one between port and starboard, so that its straight glides have no sideslip, no
    roll and no mass rotation.

    Raises
    ------
    UsageError
        Too few, too many, dependent or contradictory pins; says what would complete them.
    InputError
        A value that no vehicle can have. NoSolutionError : vertical or stalled flight, or neutral buoyancy.
    """
    pinned = {name: value for name, value in given.items() if value is not None}
    _count(pinned)
    for name, value in pinned.items():
        allowed(name, value, craft)
    _consistent(pinned, symmetric)
    names = tuple(sorted(pinned, key=lambda name: QUANTITIES[name].place))
    pins, values = [], []
    for name in names:
        value = pinned[name]
        straight = symmetric and QUANTITIES[name].lateral and _is_straight(name, value)
        pins.append(QUANTITIES["mass_rotation" if straight else name].place)
        values.append(0.0 if straight else 1.0 / value if name == "turning_radius" else value)
    return Question((names[0], names[1], names[2]), (pins[0], pins[1], pins[2]), (values[0], values[1], values[2]))


def _is_straight(name: str, value: float) -> bool:
    """Whether a lateral pin asks for a straight glide."""
    return math.isinf(value) if name == "turning_radius" else value == 0.0


def _count(pinned: Mapping[str, float]) -> None:
    """Refuse any number of pins but three."""
    if len(pinned) == 3:
        return
    told = ", ".join(map(spelled, pinned)) or "none"
    if len(pinned) > 3:
        raise UsageError(f"too many pins: three determine a trim, {len(pinned)} given: {told}; leave out all but three")
    rest = ", ".join(spelled(name) for name in QUANTITIES if name not in pinned)
    raise UsageError(
        f"too few pins: three determine a trim, given: {told}; {3 - len(pinned)} more of {rest} would complete it"
    )


def _consistent(pinned: Mapping[str, float], symmetric: bool) -> None:
    """Refuse pins that say one thing twice, or two things that cannot both be."""
    lateral = {name: value for name, value in pinned.items() if QUANTITIES[name].lateral}
    straight = [name for name, value in lateral.items() if _is_straight(name, value)] if symmetric else []
    if len(straight) > 1:
        raise UsageError(
            f"dependent pins: {' and '.join(map(spelled, straight))} both ask for a straight glide; one of "
            f"{_longitudinal(pinned)} in place of one of them would complete the trim"
        )
    if straight and len(lateral) > 1:
        turning = next(name for name in lateral if name not in straight)
        raise UsageError(
            f"contradictory pins: {spelled(straight[0])} asks for a straight glide, {spelled(turning)} for a turn"
        )
    if straight and "angle_of_attack" in pinned and "pitch" in pinned:
        raise UsageError(
            "dependent pins: in a straight glide --angle-of-attack and --pitch say the same, drag over lift; one of "
            f"{_longitudinal(pinned)} in place of one of them would complete the trim"
        )
    rate, radius = pinned.get("yaw_rate"), pinned.get("turning_radius")
    if rate is not None and radius is not None and math.isfinite(radius):
        if rate * radius <= 0.0:
            raise UsageError("contradictory pins: --yaw-rate and --turning-radius must turn to the same side")
        if rate * radius > pinned.get("speed", math.inf):
            raise UsageError(
                f"contradictory pins: --yaw-rate times --turning-radius is a horizontal speed of {rate * radius:g} "
                f"m/s, more than the --speed of {pinned['speed']:g} m/s"
            )


def _longitudinal(pinned: Mapping[str, float]) -> str:
    """The pins that a straight glide leaves open and that are not given."""
    return ", ".join(spelled(name) for name, q in QUANTITIES.items() if not q.lateral and name not in pinned)
