"""How do velocity and momentum belong together? Movable mass, inertia and added mass: eqs (6), (9), (12), (15).

(P, Pi) = M (V, Omega), M = [[Mt, Ct], [Ct^T, It]], with

    Mt = (mr + ms) I + MA,    Ct = CA - ms hat(rs) - mr hat(rr),
    It = Is + Ir(gamma) + IA - mr hat(rr)^2 - ms hat(rs)^2.

Added mass belongs to the water and scales with its density: ``dense`` is rho / rho_ref.
"""

from __future__ import annotations

import math

from glidercli.frames import Matrix, Vector, add, cross, dot, scale, times, transposed
from glidercli.kernel import kernel
from glidercli.model.parameters import Controls, Parameters

__all__ = ["first_moment", "momentum", "movable_momentum", "movable_position", "velocity"]


@kernel
def movable_position(c: Controls, p: Parameters) -> Vector:
    """rr = (r_rx, -Rr sin gamma, Rr cos gamma), m, body frame: eq. (9)."""
    return (c.rrx, -p.Rr * math.sin(c.gamma), p.Rr * math.cos(c.gamma))


@kernel
def movable_inertia(gamma: float, p: Parameters) -> Matrix:
    """Ir(gamma) = Rx^T Ir0 Rx, kg m2: eq. (12)."""
    c, s = math.cos(gamma), math.sin(gamma)
    Ix, Iy, Iz = p.Ir0
    return (
        (Ix, 0.0, 0.0),
        (0.0, c * c * Iy + s * s * Iz, c * s * (Iy - Iz)),
        (0.0, c * s * (Iy - Iz), s * s * Iy + c * c * Iz),
    )


@kernel
def first_moment(c: Controls, p: Parameters) -> Vector:
    """s = ms rs + mr rr, kg m: the mass times the centre of mass, body frame."""
    return add(scale(p.ms, p.rs), scale(p.mr, movable_position(c, p)))


@kernel
def generalized_inertia(c: Controls, dense: float, p: Parameters) -> tuple[Vector, Matrix, Matrix]:
    """Mt (its diagonal), Ct and It of eq. (15)."""
    mt = p.ms + p.mr
    Mt = (mt + dense * p.MA[0], mt + dense * p.MA[1], mt + dense * p.MA[2])
    rs, rr = p.rs, movable_position(c, p)
    s1, s2, s3 = first_moment(c, p)
    Ct = ((0.0, s3, -s2), (-s3, 0.0, s1 + dense * p.Nv), (s2, -s1 + dense * p.Mw, 0.0))
    Ir = movable_inertia(c.gamma, p)
    ss, sr = p.ms * dot(rs, rs), p.mr * dot(rr, rr)  # -m hat(r)^2 = m (r.r I - r r^T)
    xx = p.Is[0] + Ir[0][0] + dense * p.IA[0] + ss + sr - p.ms * rs[0] * rs[0] - p.mr * rr[0] * rr[0]
    yy = p.Is[1] + Ir[1][1] + dense * p.IA[1] + ss + sr - p.ms * rs[1] * rs[1] - p.mr * rr[1] * rr[1]
    zz = p.Is[2] + Ir[2][2] + dense * p.IA[2] + ss + sr - p.ms * rs[2] * rs[2] - p.mr * rr[2] * rr[2]
    xy = -p.ms * rs[0] * rs[1] - p.mr * rr[0] * rr[1]
    xz = -p.ms * rs[0] * rs[2] - p.mr * rr[0] * rr[2]
    yz = Ir[1][2] - p.ms * rs[1] * rs[2] - p.mr * rr[1] * rr[2]
    return Mt, Ct, ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))


@kernel
def movable_momentum(c: Controls, p: Parameters) -> tuple[Vector, Vector]:
    """Momentum of the moving actuator relative to the hull: (mr rrdot, rr x mr rrdot + Ir gammadot along x).

    The paper takes it as zero (V_rx = 0, omega_rx = 0, section 2.3).
    """
    rate = (c.rrx_rate, -p.Rr * math.cos(c.gamma) * c.gamma_rate, -p.Rr * math.sin(c.gamma) * c.gamma_rate)
    P = scale(p.mr, rate)
    return P, add(cross(movable_position(c, p), P), (p.Ir0[0] * c.gamma_rate, 0.0, 0.0))


@kernel
def momentum(V: Vector, Omega: Vector, c: Controls, dense: float, p: Parameters) -> tuple[Vector, Vector]:
    """(P, Pi) = M (V, Omega), kg m/s and kg m2/s, body frame, with the actuators at rest: eq. (6)."""
    Mt, Ct, It = generalized_inertia(c, dense, p)
    P = add((Mt[0] * V[0], Mt[1] * V[1], Mt[2] * V[2]), times(Ct, Omega))
    return P, add(times(transposed(Ct), V), times(It, Omega))


@kernel
def solve_symmetric(m: Matrix, a: Vector) -> Vector:
    """x with m x = a, for a symmetric 3 x 3 matrix, by cofactors."""
    c0, c1, c2 = cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])
    return scale(1.0 / dot(m[0], c0), (
        c0[0] * a[0] + c1[0] * a[1] + c2[0] * a[2],
        c0[1] * a[0] + c1[1] * a[1] + c2[1] * a[2],
        c0[2] * a[0] + c1[2] * a[1] + c2[2] * a[2],
    ))  # fmt: skip


@kernel
def velocity(P: Vector, Pi: Vector, c: Controls, dense: float, p: Parameters) -> tuple[Vector, Vector]:
    """(V, Omega) = M^-1 (P, Pi), m/s and rad/s, body frame: the inverse of ``momentum``.

    Block elimination: V = Mt^-1 (P - Ct Omega), (It - Ct^T Mt^-1 Ct) Omega = Pi - Ct^T Mt^-1 P.
    """
    Mt, Ct, It = generalized_inertia(c, dense, p)
    C = transposed(Ct)  # rows of C are columns of Ct
    W = (
        (C[0][0] / Mt[0], C[0][1] / Mt[1], C[0][2] / Mt[2]),
        (C[1][0] / Mt[0], C[1][1] / Mt[1], C[1][2] / Mt[2]),
        (C[2][0] / Mt[0], C[2][1] / Mt[1], C[2][2] / Mt[2]),
    )
    S = (
        (It[0][0] - dot(W[0], C[0]), It[0][1] - dot(W[0], C[1]), It[0][2] - dot(W[0], C[2])),
        (It[1][0] - dot(W[1], C[0]), It[1][1] - dot(W[1], C[1]), It[1][2] - dot(W[1], C[2])),
        (It[2][0] - dot(W[2], C[0]), It[2][1] - dot(W[2], C[1]), It[2][2] - dot(W[2], C[2])),
    )
    Omega = solve_symmetric(S, (Pi[0] - dot(W[0], P), Pi[1] - dot(W[1], P), Pi[2] - dot(W[2], P)))
    CO = times(Ct, Omega)
    return ((P[0] - CO[0]) / Mt[0], (P[1] - CO[1]) / Mt[1], (P[2] - CO[2]) / Mt[2]), Omega
