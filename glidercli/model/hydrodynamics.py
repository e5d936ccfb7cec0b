"""What does the water do to the hull? Forces and moments through the flow frame: eqs (20), (21), (22), (25)."""

from __future__ import annotations

import math

from glidercli.frames import Matrix, Vector, dot, times
from glidercli.kernel import kernel
from glidercli.model.parameters import Parameters

__all__ = ["flow_angles", "forces_and_moments", "in_flow_frame", "rotation_body_flow", "velocity_from_flow"]


@kernel
def flow_angles(V: Vector) -> tuple[float, float, float]:
    """Speed V (m/s), angle of attack alpha and sideslip beta (rad) of a velocity through water in the body frame.

    tan alpha = V3 / V1, sin beta = V2 / V. At rest both angles are zero: no force depends on them there. Moving
    backward alpha passes 90 deg, far beyond the angles that the coefficients were fitted to.
    """
    speed = math.sqrt(dot(V, V))
    if speed == 0.0:
        return 0.0, 0.0, 0.0
    return speed, math.atan2(V[2], V[0]), math.asin(max(-1.0, min(1.0, V[1] / speed)))


@kernel
def velocity_from_flow(speed: float, alpha: float, beta: float) -> Vector:
    """V = R_BC (V, 0, 0): eq. (25), the inverse of ``flow_angles``."""
    return (
        speed * math.cos(alpha) * math.cos(beta),
        speed * math.sin(beta),
        speed * math.sin(alpha) * math.cos(beta),
    )


@kernel
def rotation_body_flow(alpha: float, beta: float) -> Matrix:
    """R_BC of eq. (21): from the flow frame to the body frame."""
    ca, sa, cb, sb = math.cos(alpha), math.sin(alpha), math.cos(beta), math.sin(beta)
    return ((ca * cb, -ca * sb, -sa), (sb, cb, 0.0), (sa * cb, -sa * sb, ca))


@kernel
def rotation_along(V: Vector, speed: float) -> Matrix:
    """The same from the velocity through water itself, m/s: no sine or cosine is needed."""
    across = math.sqrt(V[0] * V[0] + V[2] * V[2])
    if across == 0.0:
        return rotation_body_flow(*flow_angles(V)[1:])
    ca, sa, cb, sb = V[0] / across, V[2] / across, across / speed, V[1] / speed
    return ((ca * cb, -ca * sb, -sa), (sb, cb, 0.0), (sa * cb, -sa * sb, ca))


@kernel
def in_flow_frame(
    speed: float, alpha: float, beta: float, Omega: Vector, dense: float, p: Parameters
) -> tuple[Vector, Vector]:
    """(-D, SF, -L), N, and (T1, T2, T3), N m, in the flow frame: eq. (20).

    D  = (KD0 + KD alpha^2) V^2      T1 = (KMR beta + Kp p) V^2
    SF = Kbeta beta V^2              T2 = (KM0 + KM alpha + Kq q) V^2
    L  = (KL0 + Kalpha alpha) V^2    T3 = (KMY beta + Kr r) V^2
    """
    V2 = dense * speed * speed
    D = (p.KD0 + p.KD * alpha * alpha) * V2
    SF = p.Kbeta * beta * V2
    L = (p.KL0 + p.Kalpha * alpha) * V2
    T1 = (p.KMR * beta + p.Kp * Omega[0]) * V2
    T2 = (p.KM0 + p.KM * alpha + p.Kq * Omega[1]) * V2
    T3 = (p.KMY * beta + p.Kr * Omega[2]) * V2
    return (-D, SF, -L), (T1, T2, T3)


@kernel
def forces_and_moments(V: Vector, Omega: Vector, dense: float, p: Parameters) -> tuple[Vector, Vector]:
    """F = R_BC (-D, SF, -L), N, and T = R_BC (T1, T2, T3), N m, in the body frame: eq. (22).

    V : velocity through water, m/s. Omega : body rates (p, q, r), rad/s. dense : rho / rho_ref.
    """
    speed, alpha, beta = flow_angles(V)
    f, t = in_flow_frame(speed, alpha, beta, Omega, dense, p)
    RBC = rotation_along(V, speed)
    return times(RBC, f), times(RBC, t)
