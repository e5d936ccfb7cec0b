"""Invariants of flight: steady state, current, mirror, energy, shear, and one source run two ways."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from conftest import WORKED_EXAMPLE

import glidercli
from glidercli.frames import dot, rotation_ned_body
from glidercli.model import Parameters
from glidercli.model.equations import State, rates
from glidercli.model.mass import first_moment, momentum, placement
from glidercli.model.parameters import Controls
from glidercli.ocean import Ocean, Sea, at_depth
from glidercli.ocean.current import CurrentProfile
from glidercli.simulation.flight import Flight, fly
from glidercli.simulation.legs import Leg, held
from glidercli.simulation.start import Start


def sea(depth: list[float] | None = None, east: list[float] | None = None, north: list[float] | None = None) -> Sea:
    currents = []
    if depth is not None and east is not None and north is not None:
        zeros = np.zeros(len(depth))
        profile = CurrentProfile(
            np.array(depth), np.array(east), np.array(north), zeros, Path("test"), dropped=(), warnings=()
        )
        currents = [profile]
    ocean = Ocean.build(1025.0, currents=currents, temperature_reference=15.0)
    return ocean.sea


STILL = sea()
SPIRAL = [held(**WORKED_EXAMPLE)]


def difference(a: Flight, b: Flight, *names: str) -> float:
    return max(float(np.abs(a.column(name) - b.column(name)).max()) for name in names)


def test_steady_state_is_the_trim() -> None:
    trim = glidercli.trim(**WORKED_EXAMPLE).document()
    final = glidercli.simulate(**WORKED_EXAMPLE, duration=6000.0, every=60.0).document()["final"]
    yaw_rate = math.sqrt(sum(final[f"{axis}_deg_s"] ** 2 for axis in "pqr"))
    # the 1e-6; the slowest mode, 142 s, has decayed by e^-42 and the tolerance is 1e-8
    assert final["speed_through_water_m_s"] == pytest.approx(trim["speed_m_s"], rel=1e-6)
    assert yaw_rate == pytest.approx(trim["yaw_rate_deg_s"], rel=1e-6)
    for name in ("angle_of_attack_deg", "sideslip_deg", "roll_deg", "pitch_deg", "vertical_speed_m_s"):
        assert final[name] == pytest.approx(trim[name], rel=1e-6), name


@pytest.mark.parametrize("full", [True, False])
def test_a_trim_makes_the_right_hand_side_vanish(p: Parameters, full: bool) -> None:
    t = glidercli.trim(**WORKED_EXAMPLE)
    from glidercli.frames import down_in_body, quaternion_from_euler, scale
    from glidercli.model.hydrodynamics import velocity_from_flow

    c = Controls(t.mass_position, t.mass_rotation, t.net_buoyancy)
    V = velocity_from_flow(t.speed, t.angle_of_attack, t.sideslip)
    Omega = scale(t.yaw_rate, down_in_body(t.roll, t.pitch))
    P, Pi = momentum(V, Omega, c, 1.0, p)
    state = State((0.0, 0.0, 10.0), quaternion_from_euler(t.roll, t.pitch, 1.0), P, Pi)
    r = rates(state, placement(c, p, full), at_depth(STILL, 10.0, 0.0), p, full)
    assert max(map(abs, (*r.P, *r.Pi))) < 1e-9  # the solver stops at 1e-10 N or N m


@pytest.mark.parametrize("full", [True, False])
def test_a_uniform_current_only_carries_the_track(p: Parameters, full: bool) -> None:
    carried = fly(SPIRAL, sea([0.0, 1000.0], [0.3, 0.3], [-0.2, -0.2]), p, duration=1500.0, full=full)
    still = fly(SPIRAL, STILL, p, duration=1500.0, full=full)
    for name, speed in (("east", 0.3), ("north", -0.2)):
        moved = carried.column(name) - speed * carried.times
        assert np.abs(moved - still.column(name)).max() < 1e-6 * 0.3 * 1500.0  # the 1e-6 of the track
    assert difference(carried, still, "down", "u", "v", "w", "p", "q", "r", "q_w", "q_x", "q_y", "q_z") < 1e-9


def test_with_paper_equations_any_horizontal_profile_changes_only_the_track(p: Parameters) -> None:
    sheared = sea([0.0, 100.0, 200.0, 400.0], [0.8, 0.1, -0.3, 0.0], [0.1, 0.3, 0.0, 0.2])
    flown, still = (fly(SPIRAL, s, p, duration=1000.0, full=False) for s in (sheared, STILL))
    assert difference(flown, still, "down", "u", "v", "w", "p", "q", "r") < 1e-9  # nothing but rounding reaches them
    assert difference(flown, still, "east") > 10.0


def test_shear_against_absolute_motion(p: Parameters) -> None:
    """Without water forces and added mass a sheared current cannot move the body: its absolute motion is free fall."""
    zero = (0.0, 0.0, 0.0)
    none = dict.fromkeys(
        ("Nv", "Mw", "KD0", "KD", "Kbeta", "KL0", "Kalpha", "KMR", "Kp", "KM0", "KM", "Kq", "KMY", "Kr"), 0.0
    )
    bare = p._replace(MA=zero, IA=zero, **none)
    depth = list(np.linspace(0.0, 400.0, 41))
    sheared = sea(depth, [0.01 * (z - 50.0) for z in depth], [0.004 * (z - 50.0) for z in depth])  # still at 50 m
    a, b = (fly(SPIRAL, s, bare, duration=60.0, start=Start(depth=50.0), rtol=1e-11) for s in (sheared, STILL))
    assert difference(a, b, "north", "east", "down", "q_w", "q_x", "q_y", "q_z") < 1e-6  # m; global error at rtol 1e-11
    assert np.abs(a.column("u") - b.column("u")).max() > 1e-3  # while the motion through water differs


def test_mirror(p: Parameters) -> None:
    port = [held(0.4216, -math.radians(45.0), 0.3)]
    a, b = fly(SPIRAL, STILL, p, duration=800.0), fly(port, STILL, p, duration=800.0)
    assert difference(a, b, "north", "down", "u", "w", "q") < 1e-9  # rounding
    for name in ("east", "v", "p", "r"):
        assert np.abs(a.column(name) + b.column(name)).max() < 1e-9, name


def test_energy_balance(p: Parameters) -> None:
    """Net weight's work = energy lost to the water + kinetic energy + raised centre of mass."""
    flight = fly(SPIRAL, STILL, p, duration=900.0, rtol=1e-10)
    c = Controls(0.4216, math.radians(45.0), 0.3)
    s = first_moment(c, p)

    def energy(i: int) -> float:
        V = tuple(float(flight.column(name)[i]) for name in "uvw")
        Omega = tuple(float(flight.column(name)[i]) for name in "pqr")
        q = tuple(float(flight.column(f"q_{name}")[i]) for name in "wxyz")
        P, Pi = momentum(V, Omega, c, 1.0, p)
        kinetic = 0.5 * (dot(P, V) + dot(Pi, Omega))
        return kinetic - 9.81 * dot(s, rotation_ned_body(q)[2])

    work = 0.3 * 9.81 * flight.column("down")[-1]
    spent = flight.column("energy")[-1] + energy(-1) - energy(0)
    assert spent == pytest.approx(work, rel=1e-7)  # rtol 1e-10 over some thousand steps


def test_plain_and_compiled_are_one_source(p: Parameters) -> None:
    plain, fast = (fly(SPIRAL, STILL, p, duration=20.0, plain=plain) for plain in (True, False))
    np.testing.assert_allclose(plain.samples, fast.samples, rtol=0, atol=1e-9)  # fused multiply-adds may differ


def test_tolerance_bounds_the_error(p: Parameters) -> None:
    best = fly(SPIRAL, STILL, p, duration=1500.0, rtol=1e-12)
    errors = [difference(fly(SPIRAL, STILL, p, duration=1500.0, rtol=r), best, "north", "east") for r in (1e-6, 1e-8)]
    assert errors[0] < 1e-4
    assert errors[1] < 1e-6
    assert errors[1] < errors[0]


@pytest.mark.parametrize("equations", ["full", "paper"])
@pytest.mark.parametrize(
    "mission", ["heading-hold-yoyo", "sawtooth-transect", "south-china-sea-2011", "station-keeping-spiral"]
)
def test_the_default_tolerance_is_good_for_a_centimetre_over_6000_s(mission: str, equations: str) -> None:
    """Errors grow a thousandfold where the station keeper turns over at its apogee, all but at rest."""
    flown, best = (
        glidercli.simulate(mission, equations=equations, duration=6000.0, every=10.0, **given).log
        for given in ({}, {"rtol": 1e-11})
    )
    both = min(len(flown["depth"].values), len(best["depth"].values))
    off = [flown[name].values[:both] - best[name].values[:both] for name in ("north", "east", "depth")]
    assert np.sqrt(np.square(off).sum(axis=0)).max() < 0.01  # m, the issue's


def test_a_step_ends_where_the_water_bends(p: Parameters) -> None:
    """Across a bend a step is of third order: with those the same flight was off by 1.5e-4 m, and by 1.8e-5 m without."""
    depth = list(np.linspace(0.0, 300.0, 31))
    wavy = sea(depth, [0.2 * math.sin(z) for z in depth], [0.2 * math.cos(z) for z in depth])
    loose, best = (fly(SPIRAL, wavy, p, duration=1000.0, rtol=rtol) for rtol in (1e-6, 1e-11))
    assert difference(loose, best, "north", "east", "down") < 5e-5  # m


def test_moving_mass_keeps_momentum_of_the_whole(p: Parameters) -> None:
    """Adrift without weight, water or drag, sliding the mass moves the hull so that the centre of mass stays."""
    zero = (0.0, 0.0, 0.0)
    none = dict.fromkeys(
        ("Nv", "Mw", "KD0", "KD", "Kbeta", "KL0", "Kalpha", "KMR", "Kp", "KM0", "KM", "Kq", "KMY", "Kr"), 0.0
    )
    bare = p._replace(MA=zero, IA=zero, **none)
    weightless = STILL._replace(gravity=0.0)
    slide = [Leg("slide", np.array([0.0, 40.0]), np.array([[0.36, 0.0, 1e-9], [0.44, 0.0, 1e-9]]))]
    flight = fly(slide, weightless, bare, duration=60.0, start=Start(depth=100.0), rtol=1e-11)
    q = [flight.column(f"q_{name}") for name in "wxyz"]
    # fly starts from rest of the whole in the hull's frame: momentum zero, so the common centre never moves
    for i in (0, len(flight.times) // 2, -1):
        R = rotation_ned_body(tuple(float(item[i]) for item in q))
        c = Controls(float(flight.column("mass_position")[i]), 0.0, 0.0)
        s = first_moment(c, bare)
        centre = [
            float(flight.column(n)[i]) + dot(R[j], s) / (p.ms + p.mr) for j, n in enumerate(("north", "east", "down"))
        ]
        if i == 0:
            start = centre
        np.testing.assert_allclose(centre, start, atol=1e-8)  # m; 4e-8 would be a thousandth of the pump's share


def test_what_is_told_of_a_flight_does_not_depend_on_its_samples() -> None:
    """Depth reached, track and excursions are kept step by step; the samples of 0.1 s are the independent witness."""
    coarse, fine = (glidercli.simulate("south-china-sea-2011", every=every) for every in (2000.0, 0.1))
    assert coarse.warnings == fine.warnings
    assert (coarse.max_depth, coarse.distance) == (fine.max_depth, fine.distance)
    depth, north, east = (fine.log[name].values for name in ("depth", "north", "east"))
    assert fine.max_depth == pytest.approx(depth.max(), abs=1e-5)  # at apogee 0.05 s make 0.5 * 0.005 m/s2 * 0.05^2 m
    assert fine.max_depth >= depth.max() - 1e-9  # rounding of the dense output
    way = float(np.hypot(np.diff(north), np.diff(east)).sum())
    assert fine.distance == pytest.approx(way, rel=1e-5)  # chords of 0.1 s on turns of some metres
    assert any("angle of attack was beyond" in line for line in coarse.warnings)


def test_a_climb_that_rolls_past_90_deg_is_a_trim_where_the_simulator_settles() -> None:
    controls = {"net_buoyancy": -0.5, "mass_position": 0.3966, "mass_rotation": math.radians(80.0)}
    trim = glidercli.trim(**controls).document()
    flown = glidercli.simulate(**controls, start_depth=10000.0, duration=8000.0, every=1000.0).document()["final"]
    assert trim["stable"]
    assert abs(trim["roll_deg"]) > 100.0
    for name in ("roll_deg", "pitch_deg", "sideslip_deg"):
        assert flown[name] == pytest.approx(trim[name], rel=1e-6), name  # as for the worked example above
