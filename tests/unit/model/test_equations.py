"""The momentum form against eq. (19) as printed: nudot = M^-1 (-Mdot nu + wrench), with matrices in numpy."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from test_mass import P, controls, hat, matrix, vectors

from glidercli.frames import quaternion_from_euler, rotation_ned_body
from glidercli.model import Controls
from glidercli.model.equations import State, rates
from glidercli.model.hydrodynamics import flow_angles, forces_and_moments, velocity_from_flow
from glidercli.model.mass import momentum, movable_position, placement, velocity
from glidercli.ocean import Water

STILL = Water(1025.0, 0.0, 15.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.81)
moving = st.builds(
    Controls, st.floats(0.35, 0.45), st.floats(-1.6, 1.6), st.floats(-0.5, 0.5), st.floats(-2e-3, 2e-3),
    st.floats(-0.1, 0.1),
)  # fmt: skip
ahead = st.tuples(st.floats(0.05, 1.0), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))  # alpha is undefined at V1 = V3 = 0
angles = st.tuples(st.floats(-3.0, 3.0), st.floats(-1.5, 1.5), st.floats(0.0, 6.0))


def printed(V, Omega, k_b, c, p):  # type: ignore[no-untyped-def]
    """nudot of eq. (19) with the controls moving at their rates, movable momentum left out as in the paper."""
    h = 1e-5
    later = c._replace(rrx=c.rrx + h * c.rrx_rate, gamma=c.gamma + h * c.gamma_rate)
    sooner = c._replace(rrx=c.rrx - h * c.rrx_rate, gamma=c.gamma - h * c.gamma_rate)
    Mdot = (matrix(later, p) - matrix(sooner, p)) / (2 * h)
    nu = np.array([*V, *Omega])
    M = matrix(c, p)
    Pm, Pi = (M @ nu)[:3], (M @ nu)[3:]
    F, T = forces_and_moments(V, Omega, 1.0, p)
    s = p.ms * np.array(p.rs) + p.mr * np.array(movable_position(c, p))
    g = 9.81
    force = np.cross(Pm, Omega) + c.mb * g * np.array(k_b) + F
    moment = np.cross(Pi, Omega) + np.cross(Pm, V) + g * hat(s) @ np.array(k_b) + T
    return np.linalg.solve(M, np.hstack([force, moment]) - Mdot @ nu)


@settings(max_examples=60)
@given(moving, ahead, vectors, angles)
def test_rates_are_eq_19(c, V, Omega, attitude) -> None:  # type: ignore[no-untyped-def]
    q = quaternion_from_euler(*attitude)
    k_b = rotation_ned_body(q)[2]
    Pm, Pi = momentum(V, Omega, c, 1.0, P)
    state = State((0.0, 0.0, 10.0), q, Pm, Pi)
    r = rates(state, placement(c, P, False), STILL, P, False)
    h = 1e-5

    def nu_at(sign: float):  # type: ignore[no-untyped-def]
        moved = c._replace(rrx=c.rrx + sign * h * c.rrx_rate, gamma=c.gamma + sign * h * c.gamma_rate)
        stepped = State(
            state.position, q,
            tuple(a + sign * h * b for a, b in zip(Pm, r.P, strict=True)),
            tuple(a + sign * h * b for a, b in zip(Pi, r.Pi, strict=True)),
        )  # fmt: skip
        return np.hstack(velocity(stepped.P, stepped.Pi, placement(moved, P, False), 1.0, P))

    nudot = (nu_at(+1.0) - nu_at(-1.0)) / (2 * h)
    expected = printed(V, Omega, k_b, c, P)
    # central differences with h = 1e-5 of values near 1e3: truncation and rounding both below 1e-6 of the largest
    np.testing.assert_allclose(nudot, expected, atol=1e-6 * (1.0 + np.abs(expected).max()))


@given(st.floats(1e-3, 2.0), st.floats(-3.1, 3.1), st.floats(-1.5, 1.5))
def test_flow_angles_invert(speed: float, alpha: float, beta: float) -> None:
    found = flow_angles(velocity_from_flow(speed, alpha, beta))
    np.testing.assert_allclose(found, (speed, alpha, beta), atol=1e-7)  # arcsine near 90 deg loses half the digits


def test_standing_still_has_no_forces() -> None:
    assert flow_angles((0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)
    F, T = forces_and_moments((0.0, 0.0, 0.0), (0.1, 0.2, 0.3), 1.0, P)
    assert (*F, *T) == (0.0,) * 6


@given(controls, ahead, vectors, angles)
def test_port_and_starboard_mirror(c, V, Omega, attitude) -> None:  # type: ignore[no-untyped-def]
    """Mirrored in the x-z plane: v, p, r, roll, heading and rotation change sign, and so do their rates."""
    roll, pitch, heading = attitude

    def run(sign: float):  # type: ignore[no-untyped-def]
        cc = c._replace(gamma=sign * c.gamma, gamma_rate=sign * c.gamma_rate)
        q = quaternion_from_euler(sign * roll, pitch, sign * heading)
        Pm, Pi = momentum((V[0], sign * V[1], V[2]), (sign * Omega[0], Omega[1], sign * Omega[2]), cc, 1.0, P)
        return rates(State((0.0, 0.0, 5.0), q, Pm, Pi), placement(cc, P, True), STILL, P, True)

    a, b = run(1.0), run(-1.0)
    np.testing.assert_allclose(b.P, np.multiply(a.P, (1, -1, 1)), atol=1e-9)  # rounding of forces up to 1e3 N
    np.testing.assert_allclose(b.Pi, np.multiply(a.Pi, (-1, 1, -1)), atol=1e-9)
    np.testing.assert_allclose(b.position, np.multiply(a.position, (1, -1, 1)), atol=1e-12)
