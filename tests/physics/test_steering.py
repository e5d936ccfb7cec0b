"""Flights whose legs are steered: pitch and heading held, real motors, surface and bottom."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import pytest

import glidercli
from glidercli.model import Parameters
from glidercli.model.mass import first_moment
from glidercli.model.parameters import Controls
from glidercli.ocean import Ocean
from glidercli.simulation.actuators import Drives
from glidercli.simulation.autopilot import GIVEN, HEADING, HELD_PITCH, IN_WATER, RADIUS, TURN_RATE, Order
from glidercli.simulation.flight import Flight, fly
from glidercli.simulation.legs import NO_ORDER, Leg, held
from glidercli.simulation.start import Start

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
    # the pitch still creeps inside the dead band of 0.5 deg, which is 1 % of the speed
    assert flight.column("u")[end - 1] == pytest.approx(trims.speed * math.cos(trims.angle_of_attack), rel=0.01)


def test_motors_move_at_their_rates_and_the_pump_slows_with_pressure(p: Parameters) -> None:
    leg = Leg("climb", order=pitched(p, math.radians(30.0), -0.3), goes="up", until_depth=700.0)
    flight = fly([leg], STILL, p, controls=(NEUTRAL, 0.0, 0.3), drives=DRIVES, start=Start(depth=800.0), every=1.0)
    position, mb = flight.column("mass_position"), flight.column("net_buoyancy")
    assert np.abs(np.diff(position)).max() == pytest.approx(2e-3, rel=1e-6)
    pressure = 1025.0 * 9.81 * 800.0
    # it sinks less than a metre in these seconds, 0.1 % of the pressure
    assert -np.diff(mb[:5]) == pytest.approx(5e-6 * (1.0 - 5e-8 * pressure) * 1025.0, rel=2e-3)
    volume = (0.3 + 0.3) / 1025.0
    assert flight.tallies.pumped == pytest.approx(volume, rel=1e-9)
    least, most = (1025.0 * 9.81 * depth * volume for depth in (flight.depths[0], flight.depths[1]))
    assert least < flight.tallies.pump_work < most


def test_heading_is_held(p: Parameters) -> None:
    order = pitched(p, math.radians(-30.0), 0.3)._replace(holds_turn=HEADING, wanted=math.radians(90.0), gain=1.0)
    flight = fly([Leg("dive", order=order, duration=3000.0)], STILL, p, controls=(NEUTRAL, 0.0, 0.3), drives=DRIVES)
    q = flight.samples[-1, 3:7]
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
    q = flight.samples[-1, 3:7]
    heading = math.atan2(2.0 * (q[0] * q[3] + q[1] * q[2]), 1.0 - 2.0 * (q[2] ** 2 + q[3] ** 2))
    assert abs(heading) == pytest.approx(math.pi, abs=1e-9)  # located, not stepped over


@pytest.mark.parametrize("every", [0.5, 7.0])
def test_what_is_recorded_does_not_change_the_flight(p: Parameters, every: float) -> None:
    leg = Leg("dive", order=pitched(p, math.radians(-30.0), 0.3), goes="down", until_depth=200.0)
    a, b = (
        fly([leg], STILL, p, controls=LEVEL, drives=DRIVES, floats=True, duration=6000.0, every=step)
        for step in (1.0, every)
    )
    np.testing.assert_array_equal(a.samples[-1], b.samples[-1])
    assert a.events == b.events


def dive(order: Order, p: Parameters, duration: float = 3000.0, **more) -> Flight:  # type: ignore[no-untyped-def]
    leg = Leg("dive", order=order, duration=duration)
    return fly([leg], STILL, p, controls=(NEUTRAL, 0.0, 0.3), drives=DRIVES, **more)


def yaw_rates(flight: Flight) -> np.ndarray:
    """Turn about the vertical from the recorded attitude alone, rad/s."""
    w, x, y, z = (flight.column(f"q_{axis}") for axis in "wxyz")
    heading = np.unwrap(np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))
    return np.diff(heading) / np.diff(flight.times)


def test_turn_rate_is_held(p: Parameters) -> None:
    wanted = math.radians(-0.1)
    order = pitched(p, math.radians(-30.0), 0.3)._replace(holds_turn=TURN_RATE, wanted=wanted, gain=20.0)
    assert yaw_rates(dive(order, p))[-1] == pytest.approx(wanted, rel=1e-3)  # pitch creeps inside its dead band


def test_turning_radius_is_held(p: Parameters) -> None:
    order = pitched(p, math.radians(-30.0), 0.3)._replace(holds_turn=RADIUS, wanted=150.0, gain=20.0)
    flight = dive(order, p)
    north, east = (np.diff(flight.column(name)) / np.diff(flight.times) for name in ("north", "east"))
    radius = np.hypot(north, east)[-1] / yaw_rates(flight)[-1]
    assert radius == pytest.approx(150.0, rel=2e-3)  # pitch creeps inside its dead band


def test_net_buoyancy_is_held_in_the_water_until_the_oil_is_out(p: Parameters) -> None:
    denser = p._replace(rho_0=1021.5)  # 0.22 kg more is needed in water of 1025 kg/m3
    order = pitched(p, math.radians(-30.0), 0.2)._replace(holds_buoyancy=IN_WATER)
    assert dive(order, denser).excess == pytest.approx(0.2, abs=1e-9)  # rounding
    flight = dive(order._replace(net_buoyancy=0.35), denser)
    assert flight.column("net_buoyancy")[-1] == 0.5
    assert [event.name for event in flight.events].count("oil at its limit") == 1


def test_rotation_returns_to_zero_at_times(p: Parameters) -> None:
    order = pitched(p, math.radians(-30.0), 0.3)._replace(
        mass_rotation=math.radians(-60.0), time_on=300.0, time_off=60.0
    )
    rotation = np.degrees(dive(order, p, duration=720.0).column("mass_rotation"))
    moving = 12.0  # s for 60 deg at 5 deg/s
    assert rotation[int(moving) : 301] == pytest.approx(-60.0)
    assert rotation[300 + int(moving) : 361] == pytest.approx(0.0)
    assert rotation[360 + int(moving) : 661] == pytest.approx(-60.0)


def test_an_altitude_ends_a_leg(p: Parameters) -> None:
    leg = Leg("dive", order=pitched(p, math.radians(-30.0), 0.3), goes="down", until_altitude=20.0)
    flight = fly([leg], STILL, p, controls=(NEUTRAL, 0.0, 0.3), drives=DRIVES, duration=6000.0, bottom=100.0)
    assert flight.column("down")[-1] == 80.0


def test_the_surface_holds_and_the_leg_goes_on(p: Parameters) -> None:
    current = Ocean.uniform(1025.0, temperature_reference=15.0).sea
    current.current.coefficients[3, 0] = (0.1, -0.2, 0.0)
    leg = Leg("up and wait", order=pitched(p, math.radians(30.0), -0.3), duration=2000.0, surface_ends=False)
    flight = fly([leg], current, p, controls=(NEUTRAL, 0.0, -0.3), drives=DRIVES, start=Start(depth=50.0))
    surfaced = next(event.time for event in flight.events if event.name == "surfacing")
    afloat = flight.times > surfaced + 1.0
    assert flight.times[-1] == 2000.0
    assert (flight.column("down")[afloat] == 0.0).all()
    assert np.diff(flight.column("north")[afloat]) == pytest.approx(0.1, rel=1e-9)  # rounding
    assert np.diff(flight.column("east")[afloat]) == pytest.approx(-0.2, rel=1e-9)


def test_one_leg_flown_twice_is_two_legs(p: Parameters) -> None:
    down = Leg("dive", order=pitched(p, math.radians(-30.0), 0.3), goes="down", until_depth=60.0)
    up = Leg("climb", order=pitched(p, math.radians(30.0), -0.3), goes="up", until_depth=20.0)
    flight = fly([down, up, down, up], STILL, p, controls=LEVEL, drives=DRIVES, floats=True, duration=6000.0)
    names = [event.name for event in flight.events]
    assert names.count("end of dive") == 2
    assert names[-1] == "end of flight"


def test_a_leg_that_ends_while_the_mass_moves_is_told_as_it_moves(p: Parameters) -> None:
    order = pitched(p, math.radians(-30.0), 0.3)
    on_grid, off_grid = (dive(order, p, duration=3.0, every=every).samples[-1] for every in (1.0, 2.0))
    np.testing.assert_allclose(off_grid, on_grid, rtol=0.0, atol=1e-12)  # dense output at the end of a step rounds


def test_a_motor_settles_however_late_it_is(p: Parameters) -> None:
    """At 5e7 s the clock is kept to 7e-9 s; a motor must reach its command all the same, or the flight never goes on."""
    from glidercli.ocean import at_depth
    from glidercli.simulation.memory import COMMAND_GAMMA, GAMMA, T, new_memory
    from glidercli.simulation.segments import move_actuators, steered
    from glidercli.simulation.stepper import SIZE

    y = np.zeros(SIZE)
    y[3] = 1.0
    for command in np.linspace(0.1, 1.0, 37):
        m = new_memory((NEUTRAL, 0.0, 0.0))
        m[T] = 5e7 + command / 3.0
        order = NO_ORDER._replace(mass_position=NEUTRAL, mass_rotation=float(command))
        segment, stop = steered(y, m, order, DRIVES, at_depth(STILL, 0.0, 0.0), p, True, np.zeros((4, 3)))
        move_actuators(m, segment, stop, p)
        assert m[GAMMA] == m[COMMAND_GAMMA] == command


def test_a_heavy_vehicle_that_turns_over_at_the_surface_is_not_stopped_there(p: Parameters) -> None:
    """With its mass aft its nose, and with it the origin, rises while the centre of mass sinks: no further than a
    pendulum swings whose length is what sets the two apart, 2 s / m = 2 x 11 kg x 0.05 m / 65 kg = 17 mm."""
    flight = fly([held(0.3516, 0.0, 0.02)], STILL, p, duration=600.0, every=0.1)
    assert [event.name for event in flight.events if event.name in ("surfacing", "dive begins")] == []
    assert -0.017 < flight.depths[0] < -1e-3
    assert flight.depths[1] > 1.0


def test_the_surface_lets_go_of_a_slow_slide_once(p: Parameters) -> None:
    """A slide so slow that the mass is still aft when the pump has made the vehicle heavy."""
    slow = DRIVES._replace(rrx_rate=1e-4)
    up = Leg("up", order=pitched(p, math.radians(30.0), -0.3), duration=1500.0, surface_ends=False)
    down = Leg("down", order=pitched(p, math.radians(-30.0), 0.3), goes="down", until_depth=50.0)
    flight = fly([up, down], STILL, p, controls=(NEUTRAL, 0.0, -0.3), drives=slow, start=Start(depth=20.0))
    assert [event.name for event in flight.events] == ["surfacing", "end of up", "dive begins", "end of flight"]


@pytest.mark.parametrize("rising", [0.001, 0.02])
def test_water_that_rises_slower_than_a_glider_sinks_does_not_hold_it(p: Parameters, rising: float) -> None:
    water = Ocean.uniform(1025.0, temperature_reference=15.0).sea
    water.current.coefficients[3, 0] = (0.0, 0.0, -rising)
    flight = fly([held(0.4216, 0.0, 0.5)], water, p, duration=500.0)
    still = fly([held(0.4216, 0.0, 0.5)], STILL, p, duration=500.0)
    assert flight.depths[1] == pytest.approx(still.depths[1] - rising * 500.0, abs=1e-3)  # carried, no more


def test_a_table_of_controls_goes_on_whatever_the_clock_rounds(p: Parameters) -> None:
    """(start + 357 s) - start may be less than 357 s, most of all where the sum passes a power of two; the knot is passed
    all the same."""
    from glidercli.simulation.memory import LEG_START, T, new_memory
    from glidercli.simulation.segments import tabled

    knots = np.array([0.0, 357.0, 729.0])
    values = np.array([[NEUTRAL, 0.0, 0.1]] * 3)
    rounded = 0
    for start in np.random.default_rng(7).uniform(160.0, 500.0, 500):
        m = new_memory((NEUTRAL, 0.0, 0.1))
        m[LEG_START], m[T] = start, start + 357.0
        rounded += m[T] - m[LEG_START] < 357.0
        assert tabled(knots, values, m, p, True)[1] == start + 729.0
    assert rounded > 50


def test_a_tight_tolerance_gets_past_a_jump_of_the_forces(p: Parameters) -> None:
    """With the mass aft the vehicle slides backward from rest; there the lift jumps where the sinking turns to rising."""
    flight, best = (fly([held(0.3673, 0.0, 0.1)], STILL, p, duration=60.0, rtol=rtol) for rtol in (1e-7, 1e-13))
    assert flight.column("u").min() < -0.01
    assert np.abs(flight.column("down") - best.column("down")).max() < 1e-4  # m


@pytest.mark.parametrize("goes", ["down", ""])
def test_a_leg_that_begins_below_its_altitude_ends_at_once_and_the_bottom_stays(
    p: Parameters, goes: Literal["down", ""]
) -> None:
    order = pitched(p, math.radians(-30.0), 0.3)
    legs = [
        Leg("down", order=order, goes="down", until_depth=57.0),
        Leg("low", order=order, goes=goes, until_altitude=7.4),
        Leg("on", order=order, duration=120.0, bottom_ends=False),
    ]
    flight = fly(legs, STILL, p, controls=LEVEL, drives=DRIVES, floats=True, bottom=63.9)
    assert [line.split(" begins")[0] for line in flight.skipped] == ["low"]
    assert flight.depths[1] == 63.9
    assert next(event.depth for event in flight.events if event.name == "grounding") == 63.9
