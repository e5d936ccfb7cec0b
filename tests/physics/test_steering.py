"""Flights whose legs are steered: pitch and heading held, real motors, surface and bottom."""

from __future__ import annotations

import math

import numpy as np
import pytest

import glidercli
from glidercli.model import Parameters
from glidercli.model.mass import first_moment
from glidercli.model.parameters import Controls
from glidercli.ocean import Ocean
from glidercli.simulation.actuators import Drives
from glidercli.simulation.autopilot import GIVEN, HEADING, HELD_PITCH, Order
from glidercli.simulation.flight import fly
from glidercli.simulation.legs import NO_ORDER, Leg

STILL = Ocean.uniform(1025.0, temperature_reference=15.0).sea
NEUTRAL = 0.4016
DRIVES = Drives(
    rrx_min=0.3516, rrx_max=0.4516, rrx_rate=2e-3, gamma_min=-math.pi / 2, gamma_max=math.pi / 2,
    gamma_rate=math.radians(5.0), mb_min=-0.5, mb_max=0.5, pump_rate=5e-6, pump_slowing=5e-8, bleed_rate=1e-5, refresh=6.0,
)  # fmt: skip
LEVEL = (NEUTRAL, 0.0, 0.0)


def pitched(p: Parameters, pitch: float, mb: float) -> Order:
    """Hold a pitch, rad, beginning with the mass where static balance puts it."""
    s_z = first_moment(Controls(NEUTRAL, 0.0, 0.0), p)[2]
    return NO_ORDER._replace(
        net_buoyancy=mb, holds_pitch=HELD_PITCH, pitch=pitch, mass_position=NEUTRAL - s_z / p.mr * math.tan(pitch),
        pitch_band=math.radians(0.5), pitch_gain=0.1 * s_z / (p.mr * math.cos(pitch) ** 2), period=6.0,
    )  # fmt: skip


def test_pitch_is_held_and_the_yo_ends_at_its_depths(p: Parameters) -> None:
    down = Leg("dive", order=pitched(p, math.radians(-30.0), 0.3), goes="down", until_depth=200.0)
    up = Leg("climb", order=pitched(p, math.radians(30.0), -0.3), goes="up", until_depth=0.0)
    flight = fly([down, up], STILL, p, controls=LEVEL, drives=DRIVES, floats=True, duration=6000.0)
    names = [event.name for event in flight.events]
    assert names == ["dive begins", "end of dive", "apogee", "surfacing"]
    quaternions = [flight.column(f"q_{axis}") for axis in "wxyz"]
    pitch = np.degrees(np.arcsin(2.0 * (quaternions[0] * quaternions[2] - quaternions[3] * quaternions[1])))
    end = int(np.searchsorted(flight.times, next(e.time for e in flight.events if e.name == "end of dive")))
    assert pitch[end - 60 : end] == pytest.approx(-30.0, abs=0.6)  # the dead band, and what is left of the transient
    trims = glidercli.trim(net_buoyancy=0.3, yaw_rate=0.0, pitch=math.radians(pitch[end - 1]))
    assert flight.column("u")[end - 1] == pytest.approx(trims.speed * math.cos(trims.angle_of_attack), rel=0.01)


def test_motors_move_at_their_rates_and_the_pump_slows_with_pressure(p: Parameters) -> None:
    leg = Leg("climb", order=pitched(p, math.radians(30.0), -0.3), goes="up", until_depth=700.0)
    flight = fly([leg], STILL, p, controls=(NEUTRAL, 0.0, 0.3), drives=DRIVES, start=start_at(800.0), every=1.0)
    position, mb = flight.column("mass_position"), flight.column("net_buoyancy")
    assert np.abs(np.diff(position)).max() == pytest.approx(2e-3, rel=1e-6)
    pressure = 1025.0 * 9.81 * 800.0
    assert -np.diff(mb[:5]) == pytest.approx(5e-6 * (1.0 - 5e-8 * pressure) * 1025.0, rel=0.01)  # sinks a metre
    volume = (0.3 + 0.3) / 1025.0
    assert flight.tallies.pumped == pytest.approx(volume, rel=1e-9)
    least, most = (1025.0 * 9.81 * depth * volume for depth in (flight.depths[0], flight.depths[1]))
    assert least < flight.tallies.pump_work < most


def start_at(depth: float):  # type: ignore[no-untyped-def]
    from glidercli.simulation.flight import Start

    return Start(depth=depth)


def test_heading_is_held(p: Parameters) -> None:
    order = pitched(p, math.radians(-30.0), 0.3)._replace(
        holds_turn=HEADING, wanted=math.radians(90.0), gain=1.0, damping=0.0
    )
    flight = fly([Leg("dive", order=order, duration=3000.0)], STILL, p, controls=(NEUTRAL, 0.0, 0.3), drives=DRIVES)
    q = flight.last[3:7]
    heading = math.degrees(math.atan2(2.0 * (q[0] * q[3] + q[1] * q[2]), 1.0 - 2.0 * (q[2] ** 2 + q[3] ** 2)))
    assert heading == pytest.approx(90.0, abs=0.5)  # the rest of an approach with a time constant of 200 s


def test_grounding_holds_until_the_pump_lifts(p: Parameters) -> None:
    down = Leg("dive", order=pitched(p, math.radians(-30.0), 0.3), goes="down", until_depth=200.0)
    up = Leg("climb", order=pitched(p, math.radians(30.0), -0.3), goes="up", until_depth=0.0)
    flight = fly([down, up], STILL, p, controls=LEVEL, drives=DRIVES, floats=True, duration=6000.0, bottom=100.0)
    names = [event.name for event in flight.events]
    assert names == ["dive begins", "grounding", "lift-off", "surfacing"]
    assert flight.depths[1] == 100.0


def test_turns_end_a_leg(p: Parameters) -> None:
    order = pitched(p, math.radians(-30.0), 0.3)._replace(holds_turn=GIVEN, mass_rotation=math.radians(45.0))
    flight = fly([Leg("spiral", order=order, turns=0.5)], STILL, p, controls=(NEUTRAL, 0.0, 0.3), drives=DRIVES)
    q = flight.last[3:7]
    heading = math.atan2(2.0 * (q[0] * q[3] + q[1] * q[2]), 1.0 - 2.0 * (q[2] ** 2 + q[3] ** 2))
    assert abs(heading) == pytest.approx(math.pi, abs=1e-9)  # located, not stepped over


@pytest.mark.parametrize("every", [0.5, 7.0])
def test_what_is_recorded_does_not_change_the_flight(p: Parameters, every: float) -> None:
    leg = Leg("dive", order=pitched(p, math.radians(-30.0), 0.3), goes="down", until_depth=200.0)
    a, b = (
        fly([leg], STILL, p, controls=LEVEL, drives=DRIVES, floats=True, duration=6000.0, every=step)
        for step in (1.0, every)
    )
    np.testing.assert_array_equal(a.last, b.last)
    assert a.events == b.events
