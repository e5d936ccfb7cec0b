"""How does a simulated flight become a Log? Channels in SI, attitude as Euler angles, phases, place and events."""

from __future__ import annotations

import datetime
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.frames import euler_from_quaternion_arrays
from glidercli.log import Channel, Event, Log, Origin
from glidercli.simulation.flight import Flight

__all__ = ["to_log"]

Array = NDArray[np.float64]

EPOCH = datetime.datetime(2000, 1, 1, tzinfo=datetime.UTC)
"""Start of a flight that states none; an arbitrary date, the same for every run, and the log says so."""

_DIRECT = (
    "north", "east", "down", "u", "v", "w", "p", "q", "r", "vertical_speed", "mass_position", "mass_rotation",
    "net_buoyancy", "density",
)  # fmt: skip


def to_log(
    flight: Flight,
    *,
    start: datetime.datetime | None,
    place: tuple[float, float] | None,
    stratified: bool,
    has_temperature: bool,
    has_current: bool,
    origin: Origin,
    metadata: Mapping[str, str],
) -> Log:
    """The Log of a flight.

    start : UTC, or None for an arbitrary date. place : latitude and longitude of the start, deg, or None.
    stratified, has_temperature, has_current : which water channels mean anything.
    """
    since = start or EPOCH
    start_ns = int((since - datetime.datetime(1970, 1, 1, tzinfo=datetime.UTC)) / datetime.timedelta(microseconds=1))
    start_ns *= 1000
    time_ns = start_ns + np.round(flight.times * 1e9).astype(np.int64)
    values: dict[str, Array] = {name: flight.column(name) for name in _DIRECT}
    values["depth"] = values["down"]
    quaternions = np.column_stack([flight.column(f"q_{axis}") for axis in "wxyz"])
    values["roll"], values["pitch"], values["heading"] = euler_from_quaternion_arrays(quaternions)
    speed = np.sqrt(values["u"] ** 2 + values["v"] ** 2 + values["w"] ** 2)
    values["speed_through_water"] = speed
    values["angle_of_attack"] = np.arctan2(values["w"], values["u"])
    moving = speed > 0.0
    values["sideslip"] = np.arcsin(
        np.clip(np.divide(values["v"], speed, out=np.zeros_like(speed), where=moving), -1, 1)
    )
    sinking = values["vertical_speed"] >= 0.0
    values["phase"] = np.where(sinking, PHASES.index("dive"), PHASES.index("climb")).astype(float)
    if stratified:
        values["pressure"] = flight.column("pressure")
    if has_temperature:
        values["temperature"] = flight.column("temperature")
    if has_current:
        values["current_north"], values["current_east"] = flight.column("current_north"), flight.column("current_east")
        values["current_up"] = 0.0 - flight.column("current_down")  # -0.0 for none would show
    if place is not None:
        values["latitude"], values["longitude"] = _geodetic(values, place)
    undefined = {"angle_of_attack", "sideslip"}  # no flow, no angle: a vehicle at rest has neither
    channels = {
        name: Channel(name, time_ns[moving], column[moving], origin)
        if name in undefined
        else Channel(name, time_ns, column, origin)
        for name, column in values.items()
    }
    events = [Event("start", int(time_ns[0]), float(values["depth"][0]))]
    events += [Event(e.name, start_ns + round(e.time * 1e9), e.depth) for e in flight.events]
    told = dict(metadata)
    if start is None:
        told["time_note"] = "the date is arbitrary: no start time was given"
    if place is not None:
        told["origin_latitude_deg"], told["origin_longitude_deg"] = (repr(float(item)) for item in place)
    return Log(channels, origin, told, tuple(sorted(events, key=lambda event: event.time_ns)))


def _geodetic(values: Mapping[str, Array], place: tuple[float, float]) -> tuple[Array, Array]:
    """Latitude and longitude, deg, of the track north, east, down of a place on the WGS-84 ellipsoid."""
    import pymap3d

    latitude, longitude, _ = pymap3d.ned2geodetic(values["north"], values["east"], values["down"], *place, 0.0)
    return np.asarray(latitude), np.asarray(longitude)
