"""A current that changes with depth and time, against a formulation in absolute velocity by another solver."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from test_mass import matrix

from glidercli.frames import quaternion_rate, rotation_ned_body
from glidercli.model import Controls, Parameters
from glidercli.model.hydrodynamics import forces_and_moments
from glidercli.model.mass import movable_position
from glidercli.ocean import Ocean, Sea
from glidercli.ocean.profile import in_time, pchip
from glidercli.simulation.flight import Flight, fly
from glidercli.simulation.legs import held
from glidercli.simulation.start import Start

CONTROLS = Controls(0.4216, math.radians(45.0), 0.3)
G, END, DEPTH = 9.81, 600.0, 100.0
STILL = Ocean.uniform(1025.0, temperature_reference=15.0)


def uniform_shear(t: float, z: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A current (NED, m/s) linear in depth and in time, with a vertical part; its slopes by time and by depth."""
    by_depth = np.array([0.004, -0.003, 0.0002]) + t / END * np.array([-0.002, 0.004, 0.0])
    U = np.array([0.3, -0.1, 0.01]) + t / END * np.array([0.2, 0.3, -0.02]) + by_depth * z
    by_time = np.array([0.2, 0.3, -0.02]) / END + np.array([-0.002, 0.004, 0.0]) / END * z
    return U, by_time, by_depth


@pytest.fixture(scope="module")
def water() -> Sea:
    """The same as two profiles in time; a cubic through points on a line is the line."""
    depth = np.linspace(0.0, 1000.0, 3)
    profiles = [pchip(depth, np.array([uniform_shear(t, z)[0] for z in depth])) for t in (0.0, END)]
    return Sea(STILL.water, in_time([0.0, END], profiles), G)


def absolute(p: Parameters, rtol: float) -> np.ndarray:
    """Position and attitude at the end, from the momentum of body and water together.

    The body's momentum goes with its velocity over ground, that of the added mass with its velocity through water; the
    water's own acceleration DU/Dt pushes what is displaced. No term of the shear is written out.
    """
    added = matrix(CONTROLS, p) - matrix(CONTROLS, p._replace(MA=(0.0,) * 3, IA=(0.0,) * 3, Nv=0.0, Mw=0.0))
    body = matrix(CONTROLS, p) - added
    s = p.ms * np.array(p.rs) + p.mr * np.array(movable_position(CONTROLS, p))
    displaced = p.ms + p.mr - CONTROLS.mb

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        position, q, momentum = y[:3], tuple(y[3:7] / np.linalg.norm(y[3:7])), y[7:]
        R = np.array(rotation_ned_body(q))
        U, by_time, by_depth = uniform_shear(t, position[2])
        drift = np.hstack([R.T @ U, np.zeros(3)])
        nu = np.linalg.solve(body + added, momentum + added @ drift)  # over ground
        relative = nu - drift
        F, T = forces_and_moments(tuple(relative[:3]), tuple(relative[3:]), 1.0, p)
        of_body, of_water = body @ nu, added @ relative
        force = np.cross(momentum[:3], nu[3:]) + F + CONTROLS.mb * G * R[2]
        force += displaced * R.T @ (by_time + U[2] * by_depth)
        moment = np.cross(momentum[3:], nu[3:]) + np.cross(of_body[:3], nu[:3]) + np.cross(of_water[:3], relative[:3])
        moment += np.cross(s, G * R[2]) + T
        return np.hstack([R @ nu[:3], quaternion_rate(q, tuple(nu[3:])), force, moment])

    drift = np.hstack([uniform_shear(0.0, DEPTH)[0], np.zeros(3)])  # begins at rest in the water
    start = np.hstack([0.0, 0.0, DEPTH, 1.0, 0.0, 0.0, 0.0, body @ drift])
    return solve_ivp(rates, (0.0, END), start, method="DOP853", rtol=rtol, atol=1e-12).y[:7, -1]


def flown(p: Parameters, water: Sea, full: bool = True) -> Flight:
    controls = (CONTROLS.rrx, CONTROLS.gamma, CONTROLS.mb)
    return fly([held(*controls)], water, p, duration=END, start=Start(depth=DEPTH), rtol=1e-11, every=END, full=full)


def last(flight: Flight) -> np.ndarray:
    return np.array([flight.column(name)[-1] for name in ("north", "east", "down", "q_w", "q_x", "q_y", "q_z")])


def test_both_formulations_are_the_same_motion(p: Parameters, water: Sea) -> None:
    theirs = absolute(p, 1e-11)
    np.testing.assert_allclose(last(flown(p, water)), theirs, atol=1e-6)  # m and quaternion; rtol 1e-11 over 600 s
    assert np.abs(last(flown(p, water, full=False)) - theirs)[:3].max() > 1.0  # eq. (50) alone is another motion


def test_between_profiles_the_water_is_linear_in_time(water: Sea) -> None:
    ocean = Ocean(water.water, water.current, G, False, False, True)
    for t in (-50.0, 0.0, 151.7, END, 900.0):
        U, by_time, by_depth = uniform_shear(min(max(t, 0.0), END), 333.0)
        at = ocean.at(333.0, t)
        np.testing.assert_allclose(at.current, U, atol=1e-12)
        np.testing.assert_allclose(at.shear, by_depth, atol=1e-12)
        np.testing.assert_allclose(at.change, by_time if 0.0 <= t < END else 0.0, atol=1e-12)


def test_a_drift_at_the_surface_follows_the_current_in_time(p: Parameters) -> None:
    depth, times = [0.0, 100.0], [0.0, 1000.0, 1500.0, 4000.0]
    east = [0.1, 0.5, -0.2, 0.3]
    profiles = [pchip(depth, [[0.0, e, 0.0], [0.0, e, 0.0]]) for e in east]
    sea = Sea(STILL.water, in_time(times, profiles), G)
    flight = fly([held(0.4016, 0.0, -0.3)], sea, p, duration=3900.0, floats=True, every=100.0)
    moved = [np.trapezoid(np.interp(np.arange(0, t + 1.0), times, east)) for t in (300.0, 1200.0, 3900.0)]
    assert flight.column("east")[[3, 12, 39]] == pytest.approx(moved, abs=1e-9)
