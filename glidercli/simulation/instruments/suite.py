"""How do the sensors aboard make a log of a flight? On a grid that holds every sampling time, piece by piece."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.limits import limits_of
from glidercli.log import Channel, Log
from glidercli.ocean.ocean import Ocean
from glidercli.simulation.instruments.compass import CompassSensor
from glidercli.simulation.instruments.ctd import CtdSensor
from glidercli.simulation.instruments.gps import GpsSensor
from glidercli.simulation.instruments.pressure import PressureSensor
from glidercli.simulation.instruments.sensor import Readings, Sensor
from glidercli.simulation.instruments.settings import Instrument, Instruments
from glidercli.simulation.instruments.truth import Truth

__all__ = ["OWN_CHANNELS", "Grid", "Suite"]

OWN_CHANNELS = ("mass_position", "mass_rotation", "net_buoyancy", "phase")
"""What the vehicle knows of itself: taken from the truth."""
_FINEST_MS = 10
_COARSEST_S = 1.0  # between looks at the truth, which lags take as linear and surfacing as sudden


class Grid:
    """The times at which the flight is looked at: the greatest common divisor of all periods and offsets, divided until
    it is at most a second.

    every : s, of the vehicle's own channels.
    Raises InputError where the divisor is less than 10 ms.
    """

    def __init__(self, instruments: Instruments, every: float) -> None:
        if abs(every * 1e3 - round(every * 1e3)) > 1e-6:
            raise InputError("every", f"{every:g} s is not allowed with instruments; whole milliseconds are")
        times = {"every": every}
        for kind, sensor in instruments.aboard.items():
            times |= {f"{kind} period_s": sensor.period_s, f"{kind} offset_s": sensor.offset_s}
        self._common_ms = math.gcd(*(round(value * 1e3) for value in times.values()))
        if self._common_ms < _FINEST_MS:
            told = ", ".join(f"{name} {value:g}" for name, value in times.items() if value)
            raise InputError(
                "instruments",
                f"{told} s have {self._common_ms} ms as greatest common divisor, at which the flight would be looked "
                f"at; allowed is at least {_FINEST_MS} ms",
            )
        self._parts = math.ceil(self._common_ms / (_COARSEST_S * 1e3))
        self.step = self._common_ms / self._parts / 1e3
        """s"""

    def steps(self, seconds: float) -> int:
        """How many steps of the grid a period or offset has."""
        return round(seconds * 1e3) * self._parts // self._common_ms

    def numbers(self, times: NDArray[np.float64]) -> NDArray[np.int64]:
        """Number of each of the times, s, on the grid; -1 of one that lies between."""
        nearest = np.round(times / self.step)
        return np.where(np.abs(nearest * self.step - times) < 1e-9, nearest, -1.0).astype(np.int64)


class Suite:
    """The sensors aboard at work.

    Parameters
    ----------
    instruments : their settings. seed : of their random numbers. every : s, of the vehicle's own channels.
    ocean : the water of the flight.
    place : latitude and longitude, deg, of the start; None where unknown.
    water_place : of the cast, for salinity and depth; each None where unknown, which is latitude 0 and no longitude.

    Raises
    ------
    InputError
        Periods with too fine a divisor, a GPS without a place, a CTD in water without temperature.
    """

    def __init__(
        self,
        instruments: Instruments,
        seed: int,
        *,
        every: float,
        ocean: Ocean,
        place: tuple[float, float] | None,
        water_place: tuple[float | None, float | None],
    ) -> None:
        self.seed, self._ocean = seed, ocean
        self._settings: Mapping[str, Instrument] = instruments.aboard
        self.grid = Grid(instruments, every)
        latitude, longitude = water_place
        used = 0.0 if latitude is None else latitude
        self._sensors: dict[str, Sensor] = {}
        if instruments.compass:
            self._sensors["compass"] = CompassSensor(instruments.compass, seed)
        if instruments.pressure:
            self._sensors["pressure"] = PressureSensor(instruments.pressure, seed, used)
        if instruments.ctd:
            if not ocean.has_temperature:
                raise InputError(
                    "instruments.ctd",
                    "the water has no temperature; needed is a cast that has it (ctd of the mission, --ctd), or no CTD",
                )
            where = (used, None if latitude is None else longitude)
            self._sensors["ctd"] = CtdSensor(instruments.ctd, seed, where, gauge=instruments.pressure is None)
        if instruments.gps:
            if place is None:
                raise InputError(
                    "instruments.gps",
                    "the flight has no place; needed are latitude and longitude in a mission, or no GPS",
                )
            self._sensors["gps"] = GpsSensor(instruments.gps, seed, place)
        self._every = self.grid.steps(every)
        self._last_step, self._last_ns = -1, -(2**63)
        self.samples = {kind: dict.fromkeys(sensor.channels, 0) for kind, sensor in self._sensors.items()}
        """How many readings each channel of each sensor has so far."""
        self._impossible: dict[tuple[str, str], int] = {}

    def read(self, times: NDArray[np.float64], samples: NDArray[np.float64], truth: Log) -> Log:
        """What the sensors and the vehicle itself record of a piece of the flight.

        times : (n,) s. samples : (n, len(COLUMNS)). truth : the log of the same rows, whose own channels are kept.
        """
        steps, time_ns = self.grid.numbers(times), truth["depth"].time_ns
        before = np.maximum.accumulate(np.concatenate([[self._last_step], steps]))[:-1]
        new = steps > before
        own = (time_ns > self._last_ns) & (new & (steps % self._every == 0) | (steps < 0))  # ends of legs lie between
        self._last_step, self._last_ns = max(before[-1], steps[-1]), int(time_ns[-1])
        channels = {name: Channel(name, time_ns[own], truth[name].values[own], "simulated") for name in OWN_CHANNELS}
        piece, time_ns = Truth(steps[new], times[new], samples[new], self._ocean), time_ns[new]
        for kind, sensor in self._sensors.items():
            for name, (rows, values) in self._readings(kind, sensor, piece).items():
                channels[name] = Channel(name, time_ns[rows], values, "simulated")
                self.samples[kind][name] += len(rows)
        return dataclasses.replace(truth, channels=channels)

    def _readings(self, kind: str, sensor: Sensor, piece: Truth) -> Readings:
        """What a sensor reads of a piece, which may have no row."""
        if not len(piece.steps):
            return {name: (np.array([], np.intp), np.array([])) for name in sensor.channels}
        settings = self._settings[kind]
        since = piece.steps - self.grid.steps(settings.offset_s)
        taken = np.flatnonzero((since >= 0) & (since % self.grid.steps(settings.period_s) == 0))
        readings = sensor.read(piece, taken)
        return {name: self._possible(kind, name, *reading) for name, reading in readings.items()}

    def _possible(
        self, kind: str, name: str, rows: NDArray[np.intp], values: NDArray[np.float64]
    ) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """The readings of a channel that can be; the others, which errors made, are counted."""
        low, high = limits_of(name)
        can_be = (low <= values) & (values <= high)
        if not can_be.all():
            self._impossible[kind, name] = self._impossible.get((kind, name), 0) + int((~can_be).sum())
        return rows[can_be], values[can_be]

    def warnings(self) -> list[str]:
        """What a user should know of the readings of the flight so far."""
        silent = [kind for kind, samples in self.samples.items() if not any(samples.values())]
        told = [f"instruments.{kind} has no reading in this flight" for kind in silent]
        for (kind, name), count in self._impossible.items():
            spec, (low, high) = CHANNELS[name], limits_of(name)
            told.append(
                f"instruments.{kind}: {count} readings of {name} that cannot be are left out, allowed "
                f"{low * spec.factor:.6g} to {high * spec.factor:.6g} {spec.column_unit}"
            )
        return told

    def metadata(self) -> dict[str, str]:
        """What a reader of the log should know."""
        return {"instruments": "; ".join(self._told(kind) for kind in self._sensors), "seed": str(self.seed)}

    def _told(self, kind: str) -> str:
        """A sensor as text: its settings that are not zero, and what was drawn."""
        given = {key: value for key, value in self._plain(kind).items() if value not in (None, 0.0, [0.0] * 3)}
        told = [
            f"{key} = {value:g}" if isinstance(value, float) else f"{key} = {value}" for key, value in given.items()
        ]
        drawn = [f"drawn bias of {name} = {value:.6g}" for name, value in self._drawn(kind).items()]
        return f"{kind}: {', '.join([*told, *drawn])}"

    def _plain(self, kind: str) -> dict[str, Any]:
        given = dataclasses.asdict(self._settings[kind])
        return {key: list(value) if isinstance(value, tuple) else value for key, value in given.items()}

    def _drawn(self, kind: str) -> dict[str, float]:
        """The biases that were drawn, in the unit of the sensor's keys."""
        return {name: chain.drawn for name, chain in self._sensors[kind].chains.items() if chain.drawn}

    def document(self) -> dict[str, Any]:
        """The JSON of the sensors: settings, drawn biases, readings by channel."""
        return {
            kind: {
                "settings": self._plain(kind),
                "drawn_bias": self._drawn(kind),
                "samples": self.samples[kind],
            }
            for kind in self._sensors
        }
