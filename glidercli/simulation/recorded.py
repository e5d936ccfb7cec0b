"""What does a recording say of a flight to be simulated? How it begins, and how its actuators moved."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.frames import Vector, scale
from glidercli.log import Log
from glidercli.model.parameters import Parameters
from glidercli.simulation.legs import Leg
from glidercli.simulation.settling import Settled
from glidercli.simulation.start import Start
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["controls_of", "place_of", "source_of", "start_of"]

_PLAUSIBLE = {"pitch": math.radians(80.0), "roll": math.radians(80.0), "speed_through_water": 1.5}
"""Largest magnitudes of a recorded attitude (rad) and speed (m/s) that a flight is started from: gliders fly within
them, and at a pitch of 90 deg heading and roll mean nothing."""
_NEAR = 60.0  # s; how far from the first depth another channel may be, ten of the trial's samples
_LONG_GAP = 600.0  # s without a sample of an actuator that are worth a word: motors move every few minutes

_SAME_DIVE = 86400.0  # s; controls further from the start are of another dive, or of another clock

CONTROLS = ("mass_position", "mass_rotation", "net_buoyancy")


def source_of(log: Log) -> str:
    """What an error calls a log: the file that it came from, if that is known."""
    return log.metadata.get("source", "log")


def controls_of(
    log: Log, zero_ns: int | None, vehicle: Vehicle, p: Parameters, given: dict[str, float | None]
) -> tuple[Leg, int, list[str]]:
    """The recorded actuators as a leg, the time that is its zero (ns), and warnings.

    Only actuator channels are read. They are linear between their samples and held before the first and after the
    last; so is the table of the leg, whose knots are those of all three.

    zero_ns : time that is zero; None takes that of the first sample of an actuator. given : what is held in place of
    channels that the log does not have (m, rad, kg), or None. Raises InputError where both are missing.
    """
    warnings: list[str] = []
    tables: dict[str, tuple[NDArray[np.int64], NDArray[np.float64]]] = {}
    held = {}
    for name in CONTROLS:
        channel = log.channels.get(name)
        if channel is not None and len(channel):
            tables[name] = (channel.time_ns, channel.values)
        elif name == "net_buoyancy" and len(log.channels.get("ballast_volume", ())):
            volume = log["ballast_volume"]
            tables[name] = (volume.time_ns, -p.rho_0 * volume.values)
            warnings.append(
                f"controls: net buoyancy is the recorded ballast volume times {p.rho_0:g} kg/m3, zero volume neutral"
            )
        elif given[name] is None:
            option = f"--{name.replace('_', '-')}"
            raise InputError(source_of(log), f"has no {name}; {option} holds one, or a log with it is needed")
        else:
            held[name] = float(given[name] or 0.0)
    if not tables:
        raise InputError(source_of(log), f"has no actuator channel; needed is one of {', '.join(CONTROLS)}")
    if "rudder_angle" in log and np.ptp(log["rudder_angle"].values) + np.abs(log["rudder_angle"].values).max() > 0.0:
        warnings.append(f"controls: the log's rudder angle is not flown: the model of {vehicle.name} has no rudder")
    platform = log.metadata.get("platform", "")
    if platform and vehicle.name.lower() not in platform.lower():
        warnings.append(f"controls: {platform} recorded them, {vehicle.name} flies them: no twin of that flight")
    if "mass_position_zero" in log.metadata and "mass_position" in tables:
        slide = vehicle.actuators.mass_position
        shift = slide.nominal - slide.reading
        tables["mass_position"] = (tables["mass_position"][0], tables["mass_position"][1] + shift)
        counted = f"at {slide.reading:g} m of it" if slide.reading else "at its zero"
        warnings.append(
            f"controls: the log counts mass position from the actuator's own zero; the nominal position of "
            f"{vehicle.name}, {slide.nominal:g} m, is taken {counted}"
        )
    knots = np.unique(np.concatenate([times for times, _ in tables.values()]))
    zero = int(knots[0]) if zero_ns is None else zero_ns
    seconds = (knots - zero) / 1e9
    values = np.empty((len(knots), 3))
    for column, name in enumerate(CONTROLS):
        if name in tables:
            times, samples = tables[name]
            values[:, column] = np.interp(seconds, (times - zero) / 1e9, samples)
        else:
            values[:, column] = held[name]
    if seconds[0] > _SAME_DIVE or seconds[-1] < -_SAME_DIVE:
        raise InputError(
            source_of(log), f"its actuators are recorded from {_days(seconds[0])} on, as the start counts; "
            "needed is a recording that begins within a day of it, on the same clock"
        )  # fmt: skip
    if seconds[0] > 1.0:
        warnings.append(f"controls: the first sample comes {seconds[0]:.1f} s after the start; held there until then")
    widest = float(np.diff(seconds).max()) if len(seconds) > 1 else 0.0
    if widest > _LONG_GAP:
        warnings.append(f"controls: up to {widest:.0f} s lie between samples; linear between them")
    return Leg("recorded controls", seconds, values, surface_ends=False, bottom_ends=False), zero, warnings


def _days(seconds: float) -> str:
    return f"{abs(seconds) / 86400.0:.1f} days {'after' if seconds > 0.0 else 'before'} the start"


def start_of(log: Log, depth: float | None, steady: Settled | None) -> tuple[Start, list[str]]:
    """The start that a log shows at its first depth sample, and a warning for everything that it does not show.

    depth : m, in place of the recorded one. steady : the flight that the first controls settle to, whose pitch, roll
    and speed stand in for those that are missing or implausible; None where they settle to none: rest, then.

    Raises InputError where the log has no depth.
    """
    if "depth" not in log:
        raise InputError(source_of(log), f"has no depth; its channels are {', '.join(log.channels)}")
    at = int(log["depth"].time_ns[0])
    recorded = float(log["depth"].values[0])
    warnings: list[str] = []
    if recorded < 0.0 and depth is None:
        warnings.append(f"initial depth of {recorded:.4g} m is above the surface; taken is 0 m")
    instead = steady or Settled.at_rest()
    what = "that of a trim for the first controls" if steady else "0: the first controls settle to no steady flight"
    found = {name: _value(log, name, at) for name in ("heading", "pitch", "roll", "speed_through_water")}
    if found["heading"] is None:
        warnings.append("initial heading: not recorded within 60 s of the first depth; 0 deg is taken")
    for name, limit in _PLAUSIBLE.items():
        value = found[name]
        if value is not None and abs(value) <= limit:
            continue
        shown = value if value is None or name == "speed_through_water" else math.degrees(value)
        unit = "m/s" if name == "speed_through_water" else "deg"
        why = "is not recorded" if shown is None else f"of {shown:.4g} {unit} is not plausible"
        warnings.append(f"initial {name.replace('_', ' ')} {why}; taken is {what}")
        found[name] = None
    V, Omega = _motion(log, at, found["speed_through_water"], instead)
    roll, pitch = found["roll"], found["pitch"]
    start = Start(
        depth=max(0.0, recorded) if depth is None else depth,
        roll=instead.roll if roll is None else roll,
        pitch=instead.pitch if pitch is None else pitch,
        heading=found["heading"] or 0.0,
        V=V,
        Omega=Omega,
    )
    return start, warnings


def _motion(log: Log, at: int, speed: float | None, instead: Settled) -> tuple[Vector, Vector]:
    """Velocity through water and body rates: as recorded; or the recorded speed, its direction that of the steady
    flight that stands in; or that flight."""
    if speed is None:
        return instead.V, instead.Omega
    V, Omega = ([_value(log, name, at) for name in names] for names in ("uvw", "pqr"))
    rates = (Omega[0] or 0.0, Omega[1] or 0.0, Omega[2] or 0.0)
    if V[0] is not None and V[1] is not None and V[2] is not None:
        return (V[0], V[1], V[2]), rates
    size = math.hypot(*instead.V)
    return (scale(speed / size, instead.V) if size > 0.0 else (speed, 0.0, 0.0)), rates


def place_of(log: Log) -> tuple[float, float] | None:
    """Latitude and longitude, deg, nearest to the first depth sample; None if the log has none."""
    if "latitude" not in log or "longitude" not in log:
        return None
    at = int(log["depth"].time_ns[0])
    places = (log[name] for name in ("latitude", "longitude"))
    latitude, longitude = (float(c.values[int(np.abs(c.time_ns - at).argmin())]) for c in places)
    return latitude, longitude


def _value(log: Log, name: str, at: int) -> float | None:
    """The sample of a channel nearest to a time, ns, if it is near."""
    if name not in log or not len(log[name]):
        return None
    channel = log[name]
    i = int(np.abs(channel.time_ns - at).argmin())
    return float(channel.values[i]) if abs(int(channel.time_ns[i]) - at) <= _NEAR * 1e9 else None
