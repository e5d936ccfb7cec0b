"""How do forces change with motion, attitude and controls? Exact first derivatives of eqs (6), (20)-(22) and (19).

Each function is named after the one that it differentiates and takes the same arguments, then the direction: small
changes dV, dOmega, dk_b, dc. It returns the change of the result to first order (the product rule, term by term), so
that one call gives one column of a Jacobian. dc is a change of the controls; only their places move, not their rates.
"""

from __future__ import annotations

import math

from glidercli.frames import Matrix, Vector, add, cross, dot, scale, times
from glidercli.kernel import kernel
from glidercli.model.buoyancy import hull_excess, pumped_excess
from glidercli.model.hydrodynamics import flow_angles, in_flow_frame, rotation_body_flow
from glidercli.model.mass import first_moment, momentum, movable_position
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water

__all__ = ["down_in_body_along", "flow_angles_along", "velocity_from_flow_along", "wrench_along"]


@kernel
def movable_position_along(c: Controls, dc: Controls, p: Parameters) -> Vector:
    """Change of rr, eq. (9), m."""
    return (dc.rrx, -p.Rr * math.cos(c.gamma) * dc.gamma, -p.Rr * math.sin(c.gamma) * dc.gamma)


@kernel
def momentum_along(
    V: Vector, Omega: Vector, c: Controls, dV: Vector, dOmega: Vector, dc: Controls, dense: float, p: Parameters
) -> tuple[Vector, Vector]:
    """Change of (P, Pi) = M (V, Omega): M (dV, dOmega) + dM (V, Omega), kg m/s and kg m2/s.

    The controls move s = ms rs + mr rr in Ct, and Ir(gamma) and -mr hat(rr)^2 in It: eqs (12), (15).
    """
    P, Pi = momentum(dV, dOmega, c, dense, p)
    rr, drr = movable_position(c, p), movable_position_along(c, dc, p)
    ds = scale(p.mr, drr)
    twist = dc.gamma * (p.Ir0[2] - p.Ir0[1])
    s2, c2 = math.sin(2.0 * c.gamma), math.cos(2.0 * c.gamma)
    dIr_Omega = (0.0, twist * (s2 * Omega[1] - c2 * Omega[2]), twist * (-c2 * Omega[1] - s2 * Omega[2]))
    turned = add(scale(2.0 * dot(rr, drr), Omega), add(scale(-dot(rr, Omega), drr), scale(-dot(drr, Omega), rr)))
    return (
        add(P, cross(Omega, ds)),
        add(Pi, add(cross(ds, V), add(dIr_Omega, scale(p.mr, turned)))),
    )


@kernel
def flow_angles_along(V: Vector, dV: Vector) -> tuple[float, float, float]:
    """Changes of speed (m/s), angle of attack and sideslip (rad) with V; V must not be zero, nor all along y."""
    speed = math.sqrt(dot(V, V))
    ahead = V[0] * V[0] + V[2] * V[2]
    dspeed = dot(V, dV) / speed
    return (
        dspeed,
        (V[0] * dV[2] - V[2] * dV[0]) / ahead,
        (dV[1] - V[1] / speed * dspeed) / math.sqrt(ahead),
    )


@kernel
def velocity_from_flow_along(
    speed: float, alpha: float, beta: float, dspeed: float, dalpha: float, dbeta: float
) -> Vector:
    """Change of V = R_BC (V, 0, 0), eq. (25), m/s."""
    ca, sa, cb, sb = math.cos(alpha), math.sin(alpha), math.cos(beta), math.sin(beta)
    return (
        dspeed * ca * cb - speed * (dalpha * sa * cb + dbeta * ca * sb),
        dspeed * sb + speed * dbeta * cb,
        dspeed * sa * cb + speed * (dalpha * ca * cb - dbeta * sa * sb),
    )


@kernel
def down_in_body_along(roll: float, pitch: float, droll: float, dpitch: float) -> Vector:
    """Change of k_b, the third row of eq. (2)."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    return (-cp * dpitch, cr * cp * droll - sr * sp * dpitch, -sr * cp * droll - cr * sp * dpitch)


@kernel
def turned_to_body(RBC: Matrix, f: Vector, df: Vector, dalpha: float, dbeta: float) -> Vector:
    """Change of R_BC f: the flow frame turns about the body's y axis with alpha, and about its own z axis with beta."""
    body = times(RBC, f)
    change = times(RBC, (df[0] - dbeta * f[1], df[1] + dbeta * f[0], df[2]))
    return (change[0] - dalpha * body[2], change[1], change[2] + dalpha * body[0])


@kernel
def forces_and_moments_along(
    V: Vector, Omega: Vector, dV: Vector, dOmega: Vector, dense: float, p: Parameters
) -> tuple[Vector, Vector]:
    """Changes of F and T of eqs (20), (22), N and N m, body frame."""
    speed, alpha, beta = flow_angles(V)
    dspeed, dalpha, dbeta = flow_angles_along(V, dV)
    f, t = in_flow_frame(speed, alpha, beta, Omega, dense, p)
    V2, by_speed = dense * speed * speed, 2.0 * dspeed / speed  # f and t are proportional to V^2
    df = (
        by_speed * f[0] - 2.0 * p.KD * alpha * dalpha * V2,
        by_speed * f[1] + p.Kbeta * dbeta * V2,
        by_speed * f[2] - p.Kalpha * dalpha * V2,
    )
    dt = (
        by_speed * t[0] + (p.KMR * dbeta + p.Kp * dOmega[0]) * V2,
        by_speed * t[1] + (p.KM * dalpha + p.Kq * dOmega[1]) * V2,
        by_speed * t[2] + (p.KMY * dbeta + p.Kr * dOmega[2]) * V2,
    )
    RBC = rotation_body_flow(alpha, beta)
    return turned_to_body(RBC, f, df, dalpha, dbeta), turned_to_body(RBC, t, dt, dalpha, dbeta)


@kernel
def wrench_along(
    V: Vector, Omega: Vector, k_b: Vector, c: Controls, dV: Vector, dOmega: Vector, dk_b: Vector, dc: Controls,
    water: Water, p: Parameters,
) -> tuple[Vector, Vector]:  # fmt: skip
    """Change of the right-hand side of eq. (19), N and N m, body frame, with (P, Pi) = M (V, Omega)."""
    g, dense = water.gravity, water.density / p.rho_ref
    P, Pi = momentum(V, Omega, c, dense, p)
    dP, dPi = momentum_along(V, Omega, c, dV, dOmega, dc, dense, p)
    dF, dT = forces_and_moments_along(V, Omega, dV, dOmega, dense, p)
    mb, dmb = pumped_excess(c.mb, water.density, p), pumped_excess(dc.mb, water.density, p)
    weight = mb + hull_excess(water.density, water.pressure, water.temperature, p)
    gravity = add(scale(dmb * g, k_b), scale(weight * g, dk_b))
    arm = add(first_moment(c, p), scale(mb, p.rb))
    darm = add(scale(p.mr, movable_position_along(c, dc, p)), scale(dmb, p.rb))
    couple = add(cross(darm, scale(g, k_b)), cross(arm, scale(g, dk_b)))
    turning = add(add(cross(dPi, Omega), cross(Pi, dOmega)), add(cross(dP, V), cross(P, dV)))
    return add(add(cross(dP, Omega), cross(P, dOmega)), add(gravity, dF)), add(turning, add(couple, dT))
