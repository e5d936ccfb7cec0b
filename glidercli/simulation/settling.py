"""Where does a flight with these controls settle? Flown from rest in still, uniform water, until it is steady."""

from __future__ import annotations

import math
from typing import NamedTuple

from glidercli.errors import NoSolutionError
from glidercli.frames import Vector, dot, rotation_ned_body, times
from glidercli.model.parameters import Parameters
from glidercli.ocean.ocean import Ocean
from glidercli.simulation.actuators import Drives
from glidercli.simulation.flight import IDEAL, Flight, fly
from glidercli.simulation.legs import Leg, held
from glidercli.simulation.start import Start

__all__ = ["Settled", "settled", "settled_controls"]

_TIME = 1500.0  # s; the slowest mode of the Seawing's spirals has a time constant of some 200 s
_LAST = 60.0  # s over which a steady flight must not change
_DEPTH = 6000.0  # m: no climb from there comes to the surface in that time
_UNCHANGED = 0.02  # of yaw rate, pitch and speed; a pitch inside its dead band still creeps by 1 %


class Settled(NamedTuple):
    """A steady flight. roll, pitch : rad. V : m/s, Omega : rad/s, body frame. yaw_rate : rad/s about the vertical,
    starboard positive. horizontal_speed : m/s."""

    roll: float
    pitch: float
    V: Vector
    Omega: Vector
    yaw_rate: float
    horizontal_speed: float

    @classmethod
    def at_rest(cls) -> Settled:
        """Nothing moves."""
        return cls(0.0, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0)

    @property
    def turning_radius(self) -> float:
        """m, without sign."""
        return self.horizontal_speed / abs(self.yaw_rate) if self.yaw_rate else math.inf


def settled(leg: Leg, controls: tuple[float, float, float], p: Parameters, drives: Drives = IDEAL) -> Settled | None:
    """What a leg settles to, begun with these actuators (m, rad, kg); None if it does not."""
    sea = Ocean.uniform(p.rho_0, temperature_reference=p.T_0).sea
    try:
        flight = fly(
            [leg], sea, p, duration=_TIME, start=Start(depth=_DEPTH), controls=controls, drives=drives, every=_LAST
        )
    except NoSolutionError:
        return None
    before, last = (_motion(flight, i) for i in (-2, -1))
    for a, b in zip((*before.V, before.yaw_rate, before.pitch), (*last.V, last.yaw_rate, last.pitch), strict=True):
        if not math.isclose(a, b, rel_tol=_UNCHANGED, abs_tol=1e-4):
            return None
    return last


def settled_controls(controls: tuple[float, float, float], p: Parameters) -> Settled | None:
    """What held controls (m, rad, kg) settle to; None if they do not, or carry the vehicle nowhere."""
    return settled(held(*controls), controls, p) if controls[2] != 0.0 else None


def _motion(flight: Flight, i: int) -> Settled:
    """The motion of one sample."""
    at = {name: float(flight.column(name)[i]) for name in ("q_w", "q_x", "q_y", "q_z", "u", "v", "w", "p", "q", "r")}
    R = rotation_ned_body((at["q_w"], at["q_x"], at["q_y"], at["q_z"]))
    V, Omega = (at["u"], at["v"], at["w"]), (at["p"], at["q"], at["r"])
    north, east, _ = times(R, V)
    pitch = math.asin(max(-1.0, min(1.0, -R[2][0])))
    return Settled(math.atan2(R[2][1], R[2][2]), pitch, V, Omega, dot(R[2], Omega), math.hypot(north, east))
