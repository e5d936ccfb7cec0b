"""Exact derivatives against central differences of the functions themselves, in water of another density."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from test_equations import ahead, angles
from test_mass import P, controls, vectors

from glidercli.frames import down_in_body
from glidercli.model import Controls
from glidercli.model.derivatives import (
    down_in_body_along,
    flow_angles_along,
    velocity_from_flow_along,
    wrench_along,
)
from glidercli.model.equations import wrench
from glidercli.model.hydrodynamics import flow_angles, forces_and_moments, velocity_from_flow
from glidercli.model.mass import momentum, placement
from glidercli.ocean import Water

DENSE = Water(1030.0, 4e6, 4.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.79)
p = P._replace(rb=(0.02, 0.01, -0.03), kappa=4e-10, chi=6e-5)  # terms that the Seawing leaves at zero
H = 1e-5


def differences(f, x, d):  # type: ignore[no-untyped-def]
    """Central difference of f along d: truncation and rounding both near 1e-10 of f."""
    x, d = np.asarray(x), np.asarray(d)
    return (np.asarray(f(x + H * d)) - np.asarray(f(x - H * d))) / (2 * H)


@settings(max_examples=100)
@given(controls, ahead, vectors, angles, st.lists(st.floats(-1.0, 1.0), min_size=12, max_size=12))
def test_wrench(c, V, Omega, attitude, d) -> None:  # type: ignore[no-untyped-def]
    k_b = down_in_body(*attitude[:2])
    dc = Controls(0.1 * d[9], d[10], d[11])

    def f(x):  # type: ignore[no-untyped-def]
        v, w, k = tuple(x[:3]), tuple(x[3:6]), tuple(x[6:9])
        cc = Controls(*x[9:12])
        Pm, Pi = momentum(v, w, cc, DENSE.density / p.rho_ref, p)
        return np.hstack(
            wrench(
                v,
                w,
                Pm,
                Pi,
                *forces_and_moments(v, w, DENSE.density / p.rho_ref, p),
                k,
                placement(cc, p, False),
                DENSE,
                p,
            )
        )

    step = [*d[:9], dc.rrx, dc.gamma, dc.mb]
    expected = differences(f, [*V, *Omega, *k_b, c.rrx, c.gamma, c.mb], step)
    found = np.hstack(wrench_along(V, Omega, k_b, c, tuple(d[:3]), tuple(d[3:6]), tuple(d[6:9]), dc, DENSE, p))
    # differences of forces up to 1e3 N: rounding 1e3 * 1e-16 / 1e-5 and third derivatives near V1 = V3 = 0.05
    np.testing.assert_allclose(found, expected, atol=2e-6 * (1.0 + np.abs(expected).max()))


@given(ahead, vectors)
def test_flow_angles_and_back(V, dV) -> None:  # type: ignore[no-untyped-def]
    found = flow_angles_along(V, dV)
    np.testing.assert_allclose(velocity_from_flow_along(*flow_angles(V), *found), dV, atol=1e-12)
    expected = differences(lambda x: velocity_from_flow(*x), flow_angles(V), found)
    np.testing.assert_allclose(dV, expected, atol=1e-6 * (1.0 + np.abs(dV).max()))


@given(angles, angles)
def test_direction_of_gravity(attitude, change) -> None:  # type: ignore[no-untyped-def]
    expected = differences(lambda x: down_in_body(*x), attitude[:2], change[:2])
    np.testing.assert_allclose(down_in_body_along(*attitude[:2], *change[:2]), expected, atol=1e-8)
