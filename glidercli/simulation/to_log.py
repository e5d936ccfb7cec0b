"""How does a simulated flight become a Log? Channels in SI, attitude as Euler angles, phases, place and events."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.frames import euler_from_quaternion_arrays
from glidercli.log import Channel, Event, Log
from glidercli.places import geodetic_of_track
from glidercli.simulation.flight import Flight
from glidercli.simulation.sampling import COLUMNS

__all__ = ["to_log", "with_events"]

Array = NDArray[np.float64]

EPOCH_NS = 946_684_800 * 10**9
"""2000-01-01, start of a flight that states none: an arbitrary date, the same for every run, and the log says so."""

_STILL = 1e-12  # m/s; rounding of a vehicle that lies on the bottom

_DIRECT = (
    "north", "east", "down", "u", "v", "w", "p", "q", "r", "vertical_speed", "mass_position", "mass_rotation",
    "net_buoyancy", "density",
)  # fmt: skip


def to_log(
    times: Array,
    samples: Array,
    *,
    start_ns: int | None,
    place: tuple[float, float] | None,
    stratified: bool,
    has_temperature: bool,
    has_current: bool,
    metadata: Mapping[str, str],
) -> Log:
    """The Log of samples of a flight, without events.

    times : (n,) s. samples : (n, len(COLUMNS)), as in Flight. start_ns : UTC since 1970, or None for an arbitrary date.
    place : latitude and longitude of the start, deg. stratified, has_temperature, has_current : which water channels
    mean anything.
    """
    time_ns = (EPOCH_NS if start_ns is None else start_ns) + np.round(times * 1e9).astype(np.int64)
    column = {name: samples[:, i] for i, name in enumerate(COLUMNS)}
    values: dict[str, Array] = {name: column[name] for name in _DIRECT}
    values["depth"] = values["down"]
    quaternions = np.column_stack([column[f"q_{axis}"] for axis in "wxyz"])
    values["roll"], values["pitch"], values["heading"] = euler_from_quaternion_arrays(quaternions)
    speed = np.sqrt(values["u"] ** 2 + values["v"] ** 2 + values["w"] ** 2)
    values["speed_through_water"] = speed
    values["angle_of_attack"] = np.arctan2(values["w"], values["u"])
    moving = speed > 0.0
    values["sideslip"] = np.arcsin(
        np.clip(np.divide(values["v"], speed, out=np.zeros_like(speed), where=moving), -1, 1)
    )
    phase = np.select(
        [(values["depth"] <= 0.0) & ~moving, np.abs(values["vertical_speed"]) < _STILL, values["vertical_speed"] > 0.0],
        [PHASES.index(name) for name in ("surface", "hover", "dive")],
        PHASES.index("climb"),
    )
    values["phase"] = phase.astype(float)
    if stratified:
        values["pressure"] = column["pressure"]
    if has_temperature:
        values["temperature"] = column["temperature"]
    if has_current:
        values["current_north"], values["current_east"] = column["current_north"], column["current_east"]
        values["current_up"] = 0.0 - column["current_down"]  # -0.0 for none would show
    if place is not None:
        values["latitude"], values["longitude"] = geodetic_of_track(values["north"], values["east"], *place)
    undefined = {"angle_of_attack", "sideslip"}  # no flow, no angle: a vehicle at rest has neither
    channels = {
        name: Channel(name, time_ns[moving], given[moving], "simulated")
        if name in undefined
        else Channel(name, time_ns, given, "simulated")
        for name, given in values.items()
    }
    told = dict(metadata)
    if start_ns is None:
        told["time_note"] = "the date is arbitrary: no start time was given"
    if place is not None:
        told["origin_latitude_deg"], told["origin_longitude_deg"] = (repr(float(item)) for item in place)
    return Log(channels, "simulated", told)


def with_events(log: Log, flight: Flight, start_ns: int | None) -> Log:
    """The log with the start and the events of its flight."""
    start = EPOCH_NS if start_ns is None else start_ns
    found = [Event("start", start, flight.start_depth)]
    found += [Event(e.name, start + round(e.time * 1e9), e.depth) for e in flight.events]
    return dataclasses.replace(log, events=tuple(sorted(found, key=lambda event: event.time_ns)))
