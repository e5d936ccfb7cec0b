"""Mass and momentum against matrices written out with numpy, eqs (6), (8), (11), (15)."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from glidercli.model import Controls, Parameters, parameters
from glidercli.model.mass import generalized_inertia, momentum, movable_position, placement, velocity
from glidercli.vehicle import load_vehicle

P = parameters(load_vehicle("seawing"))
controls = st.builds(Controls, st.floats(0.35, 0.45), st.floats(-1.6, 1.6), st.floats(-0.5, 0.5))
vectors = st.tuples(*[st.floats(-1.0, 1.0)] * 3)


def hat(a: object) -> NDArray[np.float64]:
    x, y, z = np.asarray(a, dtype=float)
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def matrix(c: Controls, p: Parameters) -> NDArray[np.float64]:
    """M of eq. (15) from its definition, with 3 x 3 matrices."""
    rs, rr = np.array(p.rs), np.array(movable_position(c, p))
    cg, sg = np.cos(c.gamma), np.sin(c.gamma)
    Rx = np.array([[1, 0, 0], [0, cg, sg], [0, -sg, cg]])
    Mt = (p.ms + p.mr) * np.eye(3) + np.diag(p.MA)
    CA = np.array([[0, 0, 0], [0, 0, p.Nv], [0, p.Mw, 0]])
    Ct = CA - p.ms * hat(rs) - p.mr * hat(rr)
    It = (
        np.diag(p.Is) + Rx.T @ np.diag(p.Ir0) @ Rx + np.diag(p.IA) - p.mr * hat(rr) @ hat(rr) - p.ms * hat(rs) @ hat(rs)
    )
    return np.block([[Mt, Ct], [Ct.T, It]])


@given(controls, vectors, vectors)
def test_momentum_is_the_matrix_times_velocity(c: Controls, V: tuple[float, ...], Omega: tuple[float, ...]) -> None:
    expected = matrix(c, P) @ np.array([*V, *Omega])
    np.testing.assert_allclose(
        np.hstack(momentum(V, Omega, c, 1.0, P)), expected, atol=1e-12
    )  # rounding of sums of 100


@given(controls, vectors, vectors, st.floats(0.9, 1.1))
def test_velocity_inverts_momentum(c: Controls, V: tuple[float, ...], Omega: tuple[float, ...], dense: float) -> None:
    back = velocity(*momentum(V, Omega, c, dense, P), placement(c, P, False), dense, P)
    np.testing.assert_allclose(np.hstack(back), [*V, *Omega], atol=1e-12)  # condition of M is below 100


@given(controls)
def test_kinetic_energy_is_positive(c: Controls) -> None:
    assert (np.linalg.eigvalsh(matrix(c, P)) > 0).all()


def test_density_scales_only_the_added_part() -> None:
    c = Controls(0.42, 0.3, 0.0)
    Mt, Ct, It = generalized_inertia(placement(c, P, False), 2.0, P)
    single = generalized_inertia(placement(c, P, False), 1.0, P)
    np.testing.assert_allclose(np.subtract(Mt, single[0]), P.MA, rtol=1e-13)  # rounding
    np.testing.assert_allclose(np.subtract(It, single[2]), np.diag(P.IA), atol=1e-14)
    np.testing.assert_allclose(np.subtract(Ct, single[1]), [[0, 0, 0], [0, 0, P.Nv], [0, P.Mw, 0]], atol=1e-14)
