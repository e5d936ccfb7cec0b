"""The linear model against central differences of the motion, and its modes against cases known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from conftest import WORKED_EXAMPLE

import glidercli
from glidercli.frames import down_in_body, quaternion_from_euler, scale
from glidercli.model import Controls, Parameters
from glidercli.model.equations import State, rates
from glidercli.model.hydrodynamics import flow_angles, velocity_from_flow
from glidercli.model.mass import momentum, placement, velocity
from glidercli.ocean.water import Water
from glidercli.trim.stability import DEVIATIONS, linearised, modes


def nonlinear(y: np.ndarray, c: Controls, water: Water, p: Parameters) -> np.ndarray:
    """Rates of (speed, alpha, beta, p, q, r, roll, pitch) by the simulator's own right-hand side, a small step on."""
    V, Omega = velocity_from_flow(*y[:3]), tuple(y[3:6])
    P, Pi = momentum(V, Omega, c, water.density / p.rho_ref, p)
    q = quaternion_from_euler(y[6], y[7], 0.0)
    r = rates(State((0.0, 0.0, 0.0), q, P, Pi), placement(c, p, True), water, p, True)
    h = 1e-6

    def at(sign: float) -> np.ndarray:
        s = State(
            (0.0, 0.0, 0.0),
            tuple(np.add(q, np.multiply(sign * h, r.q_wxyz))),
            tuple(np.add(P, np.multiply(sign * h, r.P))),
            tuple(np.add(Pi, np.multiply(sign * h, r.Pi))),
        )
        v, w = velocity(s.P, s.Pi, placement(c, p, True), water.density / p.rho_ref, p)
        a, b, e, f = s.q_wxyz
        roll = math.atan2(2 * (a * b + e * f), 1 - 2 * (b * b + e * e))
        return np.array([*flow_angles(v), *w, roll, math.asin(2 * (a * e - f * b))])

    return (at(1.0) - at(-1.0)) / (2 * h)


def test_exact_jacobian_is_that_of_central_differences(p: Parameters) -> None:
    t = glidercli.trim(**WORKED_EXAMPLE)
    c = Controls(t.mass_position, t.mass_rotation, t.net_buoyancy)
    water = Water(p.rho_0, 0.0, p.T_0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.81)
    Omega = scale(t.yaw_rate, down_in_body(t.roll, t.pitch))
    y = np.array([t.speed, t.angle_of_attack, t.sideslip, *Omega, t.roll, t.pitch])
    h = 1e-4
    columns = [(nonlinear(y + d, c, water, p) - nonlinear(y - d, c, water, p)) / (2 * h) for d in h * np.eye(8)]
    x = (t.speed, t.angle_of_attack, t.sideslip, t.yaw_rate, t.roll, t.pitch, *c[:3])
    # nested differences: rounding 1e-16 / 1e-6 / 1e-4 = 1e-6, truncation (1e-4)^2 of third derivatives near 1e2
    np.testing.assert_allclose(linearised(x, water, p), np.array(columns).T, atol=3e-5)


def test_modes_of_a_known_matrix() -> None:
    """A lightly damped oscillator of roll and roll rate, w = 2 rad/s, zeta = 0.1, beside decays and one growth."""
    A = np.diag([-1.0, -2.0, -3.0, 0.0, -5.0, 0.25, 0.0, -7.0])
    A[3, 3], A[3, 6], A[6, 3] = -2 * 0.1 * 2.0, -4.0, 1.0
    found = modes(A)
    assert [m.dominant for m in found if not m.eigenvalue.imag] == [
        "yaw rate", "speed", "angle of attack", "sideslip", "pitch rate", "pitch",
    ]  # fmt: skip
    assert found[0].time_to_double == pytest.approx(math.log(2) / 0.25)
    assert found[0].time_to_half is None
    pair = [m for m in found if m.eigenvalue.imag]
    assert len(pair) == 2
    for one in pair:
        assert one.natural_frequency == pytest.approx(2.0)
        assert one.damping_ratio == pytest.approx(0.1)
        assert one.time_to_half == pytest.approx(math.log(2) / 0.2)
        assert one.dominant in ("roll", "roll rate")
    assert {m.dominant for m in found} <= set(DEVIATIONS)
