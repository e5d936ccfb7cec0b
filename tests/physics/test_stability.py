"""A trim is called stable where the motion itself comes back to it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from conftest import WORKED_EXAMPLE
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import glidercli
from glidercli.frames import down_in_body, euler_from_quaternion_arrays, quaternion_from_euler, scale
from glidercli.model import Parameters
from glidercli.model.equations import State, rates
from glidercli.model.hydrodynamics import flow_angles, velocity_from_flow
from glidercli.model.mass import momentum, placement, velocity
from glidercli.model.parameters import Controls
from glidercli.ocean.water import Water
from glidercli.trim.stability import growth_rate, linearised

UNSTABLE = {"net_buoyancy": -0.5, "mass_position": 0.3966, "mass_rotation": math.radians(88.0)}


@pytest.mark.parametrize(("controls", "seconds"), [(WORKED_EXAMPLE, 20.0), (UNSTABLE, 5.0)])
def test_small_deviations_move_as_the_linear_model_says(
    p: Parameters, controls: dict[str, float], seconds: float
) -> None:
    """scipy integrates the nonlinear motion with its quaternion; the linear model knows roll and pitch alone."""
    t = glidercli.trim.trims(**controls)[-1]
    c = Controls(t.mass_position, t.mass_rotation, t.net_buoyancy)
    water = Water(p.rho_0, 0.0, p.T_0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.81)
    k_b = down_in_body(t.roll, t.pitch)

    def slope(_: float, y: np.ndarray) -> list[float]:
        q = tuple(y[:4] / np.linalg.norm(y[:4]))
        r = rates(State((0.0, 0.0, 0.0), q, tuple(y[4:7]), tuple(y[7:])), placement(c, p, True), water, p, True)
        return [*r.q_wxyz, *r.P, *r.Pi]

    def flown(deviation: np.ndarray) -> np.ndarray:
        y = np.array([t.speed, t.angle_of_attack, t.sideslip, *scale(t.yaw_rate, k_b), t.roll, t.pitch]) + deviation
        momenta = momentum(velocity_from_flow(*y[:3]), tuple(y[3:6]), c, 1.0, p)
        start = [*quaternion_from_euler(y[6], y[7], 0.0), *momenta[0], *momenta[1]]
        end = solve_ivp(slope, (0.0, seconds), start, rtol=1e-12, atol=1e-14).y[:, -1]
        roll, pitch, _ = euler_from_quaternion_arrays(end[np.newaxis, :4] / np.linalg.norm(end[:4]))
        V, Omega = velocity(tuple(end[4:7]), tuple(end[7:]), placement(c, p, True), 1.0, p)
        return np.array([*flow_angles(V), *Omega, roll[0], pitch[0]])

    A = linearised((t.speed, t.angle_of_attack, t.sideslip, t.yaw_rate, t.roll, t.pitch, *c[:3]), water, p)
    small = 1e-6 * np.array([1.0, -0.5, 0.7, 0.3, -0.4, 0.2, 1.0, -1.0])
    moved = (flown(small) - flown(-small)) / 2.0  # even terms drop out
    # of the largest: the integrator's 1e-12 over deviations of 1e-6, and what is left of third order
    assert moved == pytest.approx(expm(A * seconds) @ small, abs=1e-4 * float(np.abs(moved).max()))
    assert t.stable == (growth_rate(A) < 0.0)


def test_the_worked_example_is_stable_and_the_other_is_not() -> None:
    assert glidercli.trim(**WORKED_EXAMPLE).stable
    stable, unstable = glidercli.trim.trims(**UNSTABLE)
    assert stable.stable
    assert not unstable.stable
    assert any("not stable" in line for line in unstable.warnings)
