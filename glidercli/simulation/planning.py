"""How does a mission become legs to fly? Targets into orders, repeats unrolled, what is out of reach named."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

from glidercli.errors import InputError
from glidercli.model.mass import first_moment
from glidercli.model.parameters import Controls, Parameters
from glidercli.simulation.actuators import Drives
from glidercli.simulation.autopilot import GIVEN, HEADING, HELD_PITCH, IN_WATER, RADIUS, TURN_RATE, Order
from glidercli.simulation.legs import Leg, read_controls
from glidercli.simulation.mission import Mission, Steering
from glidercli.simulation.mission_legs import ControlsLeg, Drift, Spiral, Targets, Wait, flat, places
from glidercli.simulation.settling import Settled
from glidercli.simulation.turning import turns_of
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["Plan", "drives_of", "plan"]

_REFRESH = 6.0  # s between changes of the pump's rate: at 0.5 m/s, 3 m of depth, 0.1 % of the slowest pump's rate
_RISING = math.radians(30.0)  # pitch of a vehicle that comes up to drift
_PITCH_SLACK = math.radians(5.0)  # static balance against true pitch on the Seawing: 2 deg at most, at -40 deg
_TURN_SLACK = 0.02  # water other than uniform, a pitch inside its dead band


@dataclasses.dataclass(frozen=True)
class Plan:
    """legs : in the order of flight. drives : limits and rates. files : controls that were read, reconstructed : those
    that say they are reconstructions."""

    legs: list[Leg]
    drives: Drives
    files: list[Path]
    reconstructed: list[Path]

    @property
    def steered(self) -> bool:
        """Whether controllers and motors fly any of it."""
        return any(leg.steered for leg in self.legs)


def drives_of(vehicle: Vehicle, mission: Mission | None = None) -> Drives:
    """Limits and rates of the actuators, those of a mission in place of the vehicle's."""
    a = vehicle.actuators
    slide, turn, pump = a.mass_position, a.mass_rotation, a.net_buoyancy
    drives = Drives(
        rrx_min=slide.minimum, rrx_max=slide.maximum, rrx_rate=slide.rate,
        gamma_min=turn.minimum, gamma_max=turn.maximum, gamma_rate=turn.rate,
        mb_min=pump.minimum, mb_max=pump.maximum,
        pump_rate=pump.pump_rate, pump_slowing=pump.pump_slowing, bleed_rate=pump.return_rate, refresh=_REFRESH,
    )  # fmt: skip
    if mission is None:
        return drives
    c, deg = mission.actuators, math.pi / 180.0
    changes = {
        "rrx_min": (c.mass_position_min_m, 1.0), "rrx_max": (c.mass_position_max_m, 1.0),
        "rrx_rate": (c.mass_position_rate_mm_s, 1e-3),
        "gamma_min": (c.mass_rotation_min_deg, deg), "gamma_max": (c.mass_rotation_max_deg, deg),
        "gamma_rate": (c.mass_rotation_rate_deg_s, deg),
        "mb_min": (c.net_buoyancy_min_kg, 1.0), "mb_max": (c.net_buoyancy_max_kg, 1.0),
        "pump_rate": (c.pump_rate_cm3_s, 1e-6), "pump_slowing": (c.pump_slowing_per_dbar, 1e-4),
        "bleed_rate": (c.return_rate_cm3_s, 1e-6),
    }  # fmt: skip
    return drives._replace(**{name: value * unit for name, (value, unit) in changes.items() if value is not None})


def plan(mission: Mission, path: Path, vehicle: Vehicle, p: Parameters) -> Plan:
    """The legs of a mission for a vehicle.

    Raises InputError, for the mission's file, with every target that lies beyond the actuators' reach.
    """
    drives = drives_of(vehicle, mission)
    faults = _disordered(drives)
    ordered = not faults
    made: dict[int, Leg] = {}
    files, reconstructed = [], []
    for place, leg in places(mission.leg):
        if isinstance(leg, ControlsLeg):
            file = path.parent / leg.controls
            table = read_controls(file, leg.name or leg.kind)
            table = dataclasses.replace(
                table,
                place=place,
                until_depth=math.nan if leg.until_depth_m is None else leg.until_depth_m,
                duration=leg.duration_s or math.inf,
            )
            files.append(file)
            reconstructed += [file] if table.reconstructed else []
            made[id(leg)] = table
        elif isinstance(leg, Drift | Wait):
            made[id(leg)] = dataclasses.replace(_resting(leg, drives, p), place=place)
        elif not ordered:
            continue
        elif beyond := _beyond(leg, drives, p):
            faults += [f"{place}: {fault}" for fault in beyond]
        elif not faults:
            order, fault = _turning(leg, _order(leg, mission.steering, drives, p), drives, p)
            faults += [f"{place}: {fault}"] if fault else []
            made[id(leg)] = dataclasses.replace(_leg(leg, order), place=place)
    if faults:
        raise InputError.of_all(path, faults)
    return Plan([made[id(leg)] for leg in flat(mission.leg)], drives, files, reconstructed)


def _disordered(d: Drives) -> list[str]:
    """Faults of limits that leave nothing between them; a rotation may be fixed, as a Slocum's."""
    pairs = {
        "mass_position_min_m and mass_position_max_m must increase": d.rrx_min < d.rrx_max,
        "mass_rotation_min_deg and mass_rotation_max_deg must not decrease": d.gamma_min <= d.gamma_max,
        "net_buoyancy_min_kg and net_buoyancy_max_kg must increase": d.mb_min < d.mb_max,
    }
    return [f"actuators: {fault}" for fault, good in pairs.items() if not good]


def balanced_position(pitch: float, p: Parameters) -> float:
    """Mass position, m, at which static balance gives a pitch, rad: tan(pitch) = -s_x / s_z."""
    s_x, _, s_z = first_moment(Controls(0.0, 0.0, 0.0), p)
    return (-s_z * math.tan(pitch) - s_x) / p.mr


def balanced_pitch(position: float, p: Parameters) -> float:
    """Pitch, rad, of static balance at a mass position, m: the inverse of ``balanced_position``."""
    s_x, _, s_z = first_moment(Controls(position, 0.0, 0.0), p)
    return math.atan2(-s_x, s_z)


def _beyond(leg: Targets, d: Drives, p: Parameters) -> list[str]:
    """Faults of targets that the actuators cannot reach."""
    faults = []
    deg = math.degrees
    for name, value, least, most in (
        ("mass_position_m", leg.mass_position_m, d.rrx_min, d.rrx_max),
        ("mass_rotation_deg", leg.mass_rotation_deg, deg(d.gamma_min), deg(d.gamma_max)),
        ("net_buoyancy_kg", leg.net_buoyancy_kg, d.mb_min, d.mb_max),
    ):
        if value is not None and not least - 1e-9 <= value <= most + 1e-9:
            faults.append(f"{name} = {value:g}, allowed {least:g} to {most:g}, the reach of the actuator")
    if leg.pitch_deg is not None:
        low, high = balanced_pitch(d.rrx_max, p), balanced_pitch(d.rrx_min, p)
        if not low - _PITCH_SLACK <= math.radians(leg.pitch_deg) <= high + _PITCH_SLACK:
            faults.append(
                f"pitch_deg = {leg.pitch_deg:g}, allowed {deg(low):.1f} to {deg(high):.1f}, what mass positions of "
                f"{d.rrx_min:g} to {d.rrx_max:g} m balance"
            )
    return faults


def _order(leg: Targets, s: Steering, d: Drives, p: Parameters) -> Order:
    """What a leg asks of the steering; gains still for a vehicle that turns as its mass does."""
    holds_pitch, position, pitch = GIVEN, leg.mass_position_m, 0.0
    if leg.pitch_deg is not None:
        pitch = math.radians(leg.pitch_deg)
        holds_pitch, position = HELD_PITCH, min(max(balanced_position(pitch, p), d.rrx_min), d.rrx_max)
    assert position is not None  # the mission has one or the other
    holds_turn, wanted, gain = GIVEN, 0.0, 0.0
    if leg.heading_deg is not None:
        holds_turn, wanted, gain = HEADING, math.radians(leg.heading_deg), s.heading_gain
    elif leg.turn_rate_deg_s is not None:
        holds_turn, wanted, gain = TURN_RATE, math.radians(leg.turn_rate_deg_s), s.turn_gain_s
    elif leg.turning_radius_m is not None:
        holds_turn, wanted, gain = RADIUS, leg.turning_radius_m, s.turn_gain_s
    intermittent = leg.rotation_on_s is not None and leg.rotation_off_s is not None
    in_water = leg.net_buoyancy_in_water_kg
    s_z = first_moment(Controls(position, 0.0, 0.0), p)[2]
    return Order(
        holds_buoyancy=GIVEN if in_water is None else IN_WATER,
        net_buoyancy=float(leg.net_buoyancy_kg or 0.0) if in_water is None else float(in_water),
        holds_pitch=holds_pitch,
        mass_position=float(position),
        pitch=pitch,
        pitch_band=math.radians(s.pitch_band_deg),
        pitch_gain=s.pitch_gain * s_z / (p.mr * math.cos(pitch) ** 2),
        holds_turn=holds_turn,
        mass_rotation=math.radians(leg.mass_rotation_deg or 0.0),
        wanted=float(wanted),
        turn_band=math.radians(s.heading_band_deg) if holds_turn == HEADING else 0.0,
        gain=float(gain),
        time_on=float(leg.rotation_on_s or 0.0) if intermittent else math.inf,
        time_off=float(leg.rotation_off_s or 0.0) if intermittent else 0.0,
        period=float(s.period_s),
    )


def _turning(leg: Targets, order: Order, d: Drives, p: Parameters) -> tuple[Order, str]:
    """The order with the sign of its gain as the vehicle turns; and the fault of a turn that it cannot fly."""
    if order.holds_turn == GIVEN:
        return order, ""
    if d.gamma_min == d.gamma_max:
        return order, "asks for a heading or a turn; the vehicle's mass rotation is fixed, and nothing else steers"
    probe = order._replace(net_buoyancy=min(max(order.net_buoyancy, d.mb_min), d.mb_max), holds_buoyancy=GIVEN)
    low, high = turns_of(probe, d, p)
    if low is None or high is None:
        return order, ""
    if high.yaw_rate < low.yaw_rate:
        order = order._replace(gain=-order.gain)
    return order, _too_tight(leg, low, high) if isinstance(leg, Spiral) else ""


def _too_tight(leg: Spiral, low: Settled, high: Settled) -> str:
    """What a spiral asks beyond the tightest turns, or nothing."""
    wanted = leg.turn_rate_deg_s if leg.turn_rate_deg_s is not None else leg.turning_radius_m
    assert wanted is not None  # others are given by the rotation
    way = "to starboard" if wanted > 0.0 else "to port"
    tightest = max((low, high), key=lambda turn: turn.yaw_rate * wanted)
    if tightest.yaw_rate * wanted <= 0.0:
        return f"no mass rotation within its limits turns {way} with this pitch and net buoyancy"
    if leg.turn_rate_deg_s is not None:
        most = math.degrees(abs(tightest.yaw_rate))
        beyond = abs(wanted) > most * (1.0 + _TURN_SLACK)
        return f"turn_rate_deg_s = {wanted:g}, allowed up to {most:.3g} {way}" * beyond
    beyond = abs(wanted) < tightest.turning_radius * (1.0 - _TURN_SLACK)
    return f"turning_radius_m = {wanted:g}, allowed {tightest.turning_radius:.1f} m or more {way}" * beyond


def _leg(leg: Targets, order: Order) -> Leg:
    """A steered leg with its ends."""
    kind: str = leg.kind  # type: ignore[attr-defined]
    rises = kind == "climb" or (kind != "dive" and order.net_buoyancy < 0.0)
    return Leg(
        leg.name or kind,
        order=order,
        goes={"dive": "down", "climb": "up"}.get(kind, ""),  # type: ignore[arg-type]
        until_depth=math.nan if leg.until_depth_m is None else leg.until_depth_m,
        until_altitude=math.nan if leg.until_altitude_m is None else leg.until_altitude_m,
        duration=leg.duration_s or math.inf,
        turns=leg.turns or math.inf,
        surface_ends=rises,
        bottom_ends=not rises,
    )


def _resting(leg: Drift | Wait, d: Drives, p: Parameters) -> Leg:
    """A leg that steers nothing: as light as can be, or everything as it is."""
    position = min(max(balanced_position(_RISING, p), d.rrx_min), d.rrx_max)
    order = Order(GIVEN, d.mb_min, GIVEN, position, 0.0, 0.0, 0.0, GIVEN, 0.0, 0.0, 0.0, 0.0, math.inf, 0.0, math.inf)
    rests = isinstance(leg, Wait)
    return Leg(
        leg.name or leg.kind, order=order, duration=leg.duration_s, surface_ends=False, bottom_ends=False, keeps=rests
    )
