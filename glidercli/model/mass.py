"""How do velocity and momentum belong together? Movable mass, inertia and added mass: eqs (6), (9), (12), (15).

(P, Pi) = M (V, Omega), M = [[Mt, Ct], [Ct^T, It]], with

    Mt = (mr + ms) I + MA,    Ct = CA - ms hat(rs) - mr hat(rr),
    It = Is + Ir(gamma) + IA - mr hat(rr)^2 - ms hat(rs)^2.

Added mass belongs to the water and scales with its density: ``dense`` is rho / rho_ref.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from glidercli.frames import Matrix, Vector, add, cross, dot, scale, times, transposed
from glidercli.kernel import kernel
from glidercli.model.parameters import Controls, Parameters

__all__ = [
    "Placement", "first_moment", "generalized_inertia", "momentum", "movable_momentum", "movable_position", "placement",
    "velocity",
]  # fmt: skip


class Placement(NamedTuple):
    """The masses somewhere: what follows from the controls alone, so that it is worked out once while they rest."""

    s: Vector
    """First moment, kg m: see ``first_moment``."""
    I: Matrix  # noqa: E741
    """Inertia of hull and movable mass about the origin, kg m2: It without the water's IA."""
    P: Vector
    """Momentum of the moving actuator relative to the hull, kg m/s: see ``movable_momentum``."""
    Pi: Vector
    """Its angular momentum, kg m2/s."""
    mb: float
    """Net buoyancy, kg."""


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
def rigid_inertia(c: Controls, p: Parameters) -> Matrix:
    """Is + Ir(gamma) - mr hat(rr)^2 - ms hat(rs)^2, kg m2, about the origin."""
    rs, rr = p.rs, movable_position(c, p)
    Ir = movable_inertia(c.gamma, p)
    ss, sr = p.ms * dot(rs, rs), p.mr * dot(rr, rr)  # -m hat(r)^2 = m (r.r I - r r^T)
    xx = p.Is[0] + Ir[0][0] + ss + sr - p.ms * rs[0] * rs[0] - p.mr * rr[0] * rr[0]
    yy = p.Is[1] + Ir[1][1] + ss + sr - p.ms * rs[1] * rs[1] - p.mr * rr[1] * rr[1]
    zz = p.Is[2] + Ir[2][2] + ss + sr - p.ms * rs[2] * rs[2] - p.mr * rr[2] * rr[2]
    xy = -p.ms * rs[0] * rs[1] - p.mr * rr[0] * rr[1]
    xz = -p.ms * rs[0] * rs[2] - p.mr * rr[0] * rr[2]
    yz = Ir[1][2] - p.ms * rs[1] * rs[2] - p.mr * rr[1] * rr[2]
    return ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))


@kernel
def generalized_inertia(at: Placement, dense: float, p: Parameters) -> tuple[Vector, Matrix, Matrix]:
    """Mt (its diagonal), Ct and It of eq. (15)."""
    mt = p.ms + p.mr
    Mt = (mt + dense * p.MA[0], mt + dense * p.MA[1], mt + dense * p.MA[2])
    s1, s2, s3 = at.s
    Ct = ((0.0, s3, -s2), (-s3, 0.0, s1 + dense * p.Nv), (s2, -s1 + dense * p.Mw, 0.0))
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = at.I
    It = (
        (xx + dense * p.IA[0], xy, xz),
        (xy, yy + dense * p.IA[1], yz),
        (xz, yz, zz + dense * p.IA[2]),
    )
    return Mt, Ct, It


@kernel
def movable_momentum(c: Controls, p: Parameters) -> tuple[Vector, Vector]:
    """Momentum of the moving actuator relative to the hull: (mr rrdot, rr x mr rrdot + Ir gammadot along x).

    The paper takes it as zero (V_rx = 0, omega_rx = 0, section 2.3).
    """
    rate = (c.rrx_rate, -p.Rr * math.cos(c.gamma) * c.gamma_rate, -p.Rr * math.sin(c.gamma) * c.gamma_rate)
    P = scale(p.mr, rate)
    return P, add(cross(movable_position(c, p), P), (p.Ir0[0] * c.gamma_rate, 0.0, 0.0))


@kernel
def placement(c: Controls, p: Parameters, full: bool) -> Placement:
    """Where the controls put the masses.

    full : with the momentum of the moving actuator, which the paper leaves out.
    """
    zero = (0.0, 0.0, 0.0)
    P, Pi = zero, zero
    if full and (c.rrx_rate != 0.0 or c.gamma_rate != 0.0):
        P, Pi = movable_momentum(c, p)
    return Placement(first_moment(c, p), rigid_inertia(c, p), P, Pi, c.mb)


@kernel
def momentum(V: Vector, Omega: Vector, c: Controls, dense: float, p: Parameters) -> tuple[Vector, Vector]:
    """(P, Pi) = M (V, Omega), kg m/s and kg m2/s, body frame, with the actuators at rest: eq. (6)."""
    Mt, Ct, It = generalized_inertia(placement(c, p, False), dense, p)
    P = add((Mt[0] * V[0], Mt[1] * V[1], Mt[2] * V[2]), times(Ct, Omega))
    return P, add(times(transposed(Ct), V), times(It, Omega))


@kernel
def by_parts(a: Vector, b: Vector) -> Vector:
    """Products of the components: a diagonal matrix times a vector."""
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


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
def velocity(P: Vector, Pi: Vector, at: Placement, dense: float, p: Parameters) -> tuple[Vector, Vector]:
    """(V, Omega) = M^-1 (P, Pi), m/s and rad/s, body frame: the inverse of ``momentum``.

    The momentum of a moving actuator is taken off first. Block elimination: V = Mt^-1 (P - Ct Omega),
    (It - Ct^T Mt^-1 Ct) Omega = Pi - Ct^T Mt^-1 P.
    """
    P, Pi = add(P, scale(-1.0, at.P)), add(Pi, scale(-1.0, at.Pi))
    Mt, Ct, It = generalized_inertia(at, dense, p)
    inverse = (1.0 / Mt[0], 1.0 / Mt[1], 1.0 / Mt[2])
    C = transposed(Ct)  # rows of C are columns of Ct
    W = (by_parts(C[0], inverse), by_parts(C[1], inverse), by_parts(C[2], inverse))
    xy, xz, yz = It[0][1] - dot(W[0], C[1]), It[0][2] - dot(W[0], C[2]), It[1][2] - dot(W[1], C[2])
    S = (
        (It[0][0] - dot(W[0], C[0]), xy, xz),
        (xy, It[1][1] - dot(W[1], C[1]), yz),
        (xz, yz, It[2][2] - dot(W[2], C[2])),
    )
    Omega = solve_symmetric(S, (Pi[0] - dot(W[0], P), Pi[1] - dot(W[1], P), Pi[2] - dot(W[2], P)))
    return by_parts(add(P, scale(-1.0, times(Ct, Omega))), inverse), Omega
