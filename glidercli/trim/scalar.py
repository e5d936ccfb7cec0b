"""What do the scalar equations (35)-(42) and (45)-(49) of the paper say? Each as one function, with its signs.

Each is derived from (28), (29) and held against them in tests/unit/trim. They are the paper's own: C_A left out,
r_b = 0 and r_s2 = 0. ``Spiral`` holds the parameters; R is no part of the equations. docs/recursion.md says what the
print has otherwise.
"""

from __future__ import annotations

import math
from math import cos, sin
from typing import NamedTuple

from glidercli.frames import add, cross, dot, scale, times
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.mass import first_moment, generalized_inertia, placement
from glidercli.model.parameters import Controls, Parameters

__all__ = [
    "Spiral", "eq35", "eq36", "eq37", "eq39", "eq40", "eq41", "eq42", "eq45", "eq46", "eq47", "eq49", "gamma_from_40",
    "rrx_from_37",
]  # fmt: skip


class Spiral(NamedTuple):
    """The parameters of a spiral, SI and rad; g in m/s2."""

    V: float
    alpha: float
    beta: float
    theta: float
    phi: float
    mb: float
    gamma: float
    omega3: float
    rrx: float
    g: float = 9.81


class _Water(NamedTuple):
    """Forces and moments in the flow frame, N and N m: eq. (20). T at omega3 and its rate by omega3."""

    D: float
    SF: float
    L: float
    T: tuple[float, float, float]
    T_rate: tuple[float, float, float]


def _k_b(x: Spiral) -> tuple[float, float, float]:
    return -sin(x.theta), sin(x.phi) * cos(x.theta), cos(x.phi) * cos(x.theta)


def _flow(x: Spiral, p: Parameters) -> _Water:
    V2 = x.V * x.V
    k1, k2, k3 = _k_b(x)
    rate = (p.Kp * k1 * V2, p.Kq * k2 * V2, p.Kr * k3 * V2)
    still = (p.KMR * x.beta * V2, (p.KM0 + p.KM * x.alpha) * V2, p.KMY * x.beta * V2)
    T = (still[0] + rate[0] * x.omega3, still[1] + rate[1] * x.omega3, still[2] + rate[2] * x.omega3)
    return _Water((p.KD0 + p.KD * x.alpha**2) * V2, p.Kbeta * x.beta * V2, (p.KL0 + p.Kalpha * x.alpha) * V2, T, rate)


def _body(x: Spiral, f: tuple[float, float, float]) -> tuple[float, float, float]:
    """A flow-frame vector in the body frame: eq. (21)."""
    ca, sa, cb, sb = cos(x.alpha), sin(x.alpha), cos(x.beta), sin(x.beta)
    return (
        ca * cb * f[0] - ca * sb * f[1] - sa * f[2],
        sb * f[0] + cb * f[1],
        sa * cb * f[0] - sa * sb * f[1] + ca * f[2],
    )


def _mt(p: Parameters) -> tuple[float, float, float]:
    m = p.ms + p.mr
    return m + p.MA[0], m + p.MA[1], m + p.MA[2]


def _drag_x(x: Spiral, w: _Water) -> float:
    return w.D * cos(x.alpha) * cos(x.beta) + w.SF * cos(x.alpha) * sin(x.beta) - w.L * sin(x.alpha)


def _turning_x(x: Spiral, p: Parameters) -> float:
    """Terms of (35) with omega3 squared, N."""
    half, cc = 0.5 * sin(2.0 * x.theta), cos(x.theta) ** 2
    movable = p.mr * (x.rrx * cc + p.Rr * half * cos(x.phi + x.gamma))
    return x.omega3**2 * (movable + p.ms * (p.rs[0] * cc + p.rs[2] * half * cos(x.phi)))


def eq35(x: Spiral, p: Parameters) -> float:
    """Force along x, N."""
    _, mt2, mt3 = _mt(p)
    across = mt2 * sin(x.beta) * cos(x.phi) - mt3 * sin(x.alpha) * cos(x.beta) * sin(x.phi)
    turning = x.V * x.omega3 * across * cos(x.theta)
    return turning - x.mb * x.g * sin(x.theta) + _turning_x(x, p) - _drag_x(x, _flow(x, p))


def eq45(x: Spiral, p: Parameters) -> float:
    """theta from (35), rad: f_theta2 sin theta - f_theta1 cos theta = -f_theta, on the branch next to level flight."""
    _, mt2, mt3 = _mt(p)
    across = mt2 * sin(x.beta) * cos(x.phi) - mt3 * sin(x.alpha) * cos(x.beta) * sin(x.phi)
    return _solved(x.mb * x.g, -x.V * x.omega3 * across, _turning_x(x, p) - _drag_x(x, _flow(x, p)))


def _solved(of_sine: float, of_cosine: float, right: float) -> float:
    """The angle with of_sine sin + of_cosine cos = right, within 90 deg of -lambda; clipped where none is."""
    sign = math.copysign(1.0, of_sine)
    length = math.hypot(of_sine, of_cosine)
    shift = math.atan2(sign * of_cosine, sign * of_sine)
    return math.asin(max(-1.0, min(1.0, sign * right / length))) - shift


def _side_y(x: Spiral, w: _Water) -> float:
    return w.SF * cos(x.beta) - w.D * sin(x.beta)


def _turning_y(x: Spiral, p: Parameters) -> float:
    """Terms of (36) with omega3 squared but without a factor sin phi, N."""
    across = 0.5 * sin(2.0 * x.phi) * cos(x.theta) ** 2
    out = sin(x.gamma) * (cos(x.phi) ** 2 * cos(x.theta) ** 2 + sin(x.theta) ** 2)
    return -(x.omega3**2) * (p.ms * p.rs[2] * across + p.mr * p.Rr * (out + cos(x.gamma) * across))


def _of_sin_phi(x: Spiral, p: Parameters) -> float:
    """f_phi1 of (46)."""
    along = p.ms * p.rs[0] + p.mr * x.rrx
    return x.mb * x.g * cos(x.theta) + x.omega3**2 * along * 0.5 * sin(2.0 * x.theta)


def eq36(x: Spiral, p: Parameters) -> float:
    """Force along y, N."""
    mt1, _, mt3 = _mt(p)
    ahead = mt1 * cos(x.alpha) * cos(x.beta) * cos(x.phi) * cos(x.theta)
    below = mt3 * sin(x.alpha) * cos(x.beta) * sin(x.theta)
    still = _of_sin_phi(x, p) * sin(x.phi) + _turning_y(x, p) + _side_y(x, _flow(x, p))
    return still - x.V * x.omega3 * (below + ahead)


def eq46(x: Spiral, p: Parameters) -> float:
    """phi from (36), rad: f_phi1 sin phi - f_phi2 cos phi = f_phi."""
    mt1, _, mt3 = _mt(p)
    f_phi2 = x.V * x.omega3 * mt1 * cos(x.alpha) * cos(x.beta) * cos(x.theta)
    below = x.V * x.omega3 * mt3 * sin(x.alpha) * cos(x.beta) * sin(x.theta)
    return _solved(_of_sin_phi(x, p), -f_phi2, below - _turning_y(x, p) - _side_y(x, _flow(x, p)))


def _of_gamma(x: Spiral, p: Parameters) -> tuple[float, float]:
    """f_gamma1 and f_gamma2 of (48), factors of cos gamma and sin gamma, N m."""
    level = cos(x.phi) ** 2 * cos(x.theta) ** 2 - sin(x.theta) ** 2
    across = sin(x.phi) * sin(x.alpha) * cos(x.beta) - sin(x.beta) * cos(x.phi)
    f1 = p.mr * x.V * p.Rr * x.omega3 * cos(x.theta) * across + p.mr * x.g * p.Rr * sin(x.theta)
    f1 -= p.mr * p.Rr * x.rrx * x.omega3**2 * level
    return f1, p.mr * p.Rr * x.rrx * x.omega3**2 * sin(x.phi) * cos(x.phi) * cos(x.theta) ** 2


def _rest_of_37(x: Spiral, p: Parameters) -> float:
    """f_gamma of (48): what (37) has beside the factors of cos gamma and sin gamma, N m."""
    sa, ca, sb, cb = sin(x.alpha), cos(x.alpha), sin(x.beta), cos(x.beta)
    st, ct, sp, cp = sin(x.theta), cos(x.theta), sin(x.phi), cos(x.phi)
    rs1, _, rs3 = p.rs
    _, Iry, Irz = p.Ir0
    half, w2 = 0.5 * sin(2.0 * x.theta) * cp, x.omega3**2
    w = _flow(x, p)
    munk = (p.MA[2] - p.MA[0]) * x.V**2 * cb * cb * sa * ca
    weight = -p.ms * x.g * (rs3 * st + rs1 * cp * ct) - p.mr * x.g * x.rrx * cp * ct
    static = p.ms * x.omega3 * x.V * (rs3 * (sb * cp - sa * cb * sp) * ct - rs1 * (ca * cb * sp * ct + sb * st))
    movable = -p.mr * x.V * x.omega3 * x.rrx * (ca * cb * sp * ct + st * sb)
    turned = -(Iry - Irz + p.mr * p.Rr**2) * 0.5 * sin(2.0 * x.gamma) * sp * st * ct
    inertia = p.Is[0] - p.Is[2] + p.Ir0[0] + p.IA[0] - p.IA[2] - Iry * sin(x.gamma) ** 2
    inertia += (p.mr * p.Rr**2 - Irz) * cos(x.gamma) ** 2 - p.mr * x.rrx**2
    offset = p.ms * (half * (rs3**2 - rs1**2) + rs1 * rs3 * (cp * cp * ct * ct - st * st))
    return w.T[0] * sb + w.T[1] * cb + munk + weight + static + movable + w2 * (turned + inertia * half + offset)


def eq37(x: Spiral, p: Parameters) -> float:
    """Moment about y, N m."""
    f1, f2 = _of_gamma(x, p)
    return _rest_of_37(x, p) - f1 * cos(x.gamma) - f2 * sin(x.gamma)


def eq47(x: Spiral, p: Parameters) -> float:
    """gamma from (37) with (48), rad: f_gamma2 sin gamma + f_gamma1 cos gamma = f_gamma."""
    f1, f2 = _of_gamma(x, p)
    return _nearest(f2, f1, _rest_of_37(x, p), x.gamma)


def _nearest(of_sine: float, of_cosine: float, right: float, to: float) -> float:
    """Of the two angles with of_sine sin + of_cosine cos = right the one nearer to ``to``; clipped where none is."""
    angle = math.asin(max(-1.0, min(1.0, right / math.hypot(of_sine, of_cosine))))
    shift = math.atan2(of_cosine, of_sine)
    found = [math.remainder(one - shift, math.tau) for one in (angle, math.pi - angle)]
    return min(found, key=lambda one: abs(one - to))


def rrx_from_37(x: Spiral, p: Parameters) -> float:
    """r_rx from (37), m: one step along the terms linear in it. Where the print takes it from (40)."""
    st, ct, sp, cp = sin(x.theta), cos(x.theta), sin(x.phi), cos(x.phi)
    ahead = cos(x.alpha) * cos(x.beta) * sp * ct + st * sin(x.beta)
    level = (cp * cp * ct * ct - st * st) * cos(x.gamma) - sp * cp * ct * ct * sin(x.gamma)
    slope = p.mr * (-x.g * cp * ct - x.V * x.omega3 * ahead + x.omega3**2 * p.Rr * level)
    return x.rrx - eq37(x, p) / slope


def _moment_without_movable(x: Spiral, p: Parameters, restored: bool) -> tuple[float, float, float]:
    """ms g rs x k_b + (It Omega) x Omega + (Mt V) x V + T, and, if ``restored``, ms rs x (V x Omega), N m."""
    k_b, V = _k_b(x), velocity_from_flow(x.V, x.alpha, x.beta)
    _, _, It = generalized_inertia(placement(Controls(x.rrx, x.gamma, x.mb), p, False), 1.0, p)
    mt, Omega = _mt(p), scale(x.omega3, k_b)
    u = (mt[0] * V[0], mt[1] * V[1], mt[2] * V[2])
    total = add(scale(p.ms * x.g, cross(p.rs, k_b)), cross(times(It, Omega), Omega))
    total = add(total, add(cross(u, V), _body(x, _flow(x, p).T)))
    return add(total, scale(p.ms, cross(p.rs, cross(V, Omega)))) if restored else total


def eq40(x: Spiral, p: Parameters, restored: bool = True) -> float:
    """(29) along rr, N m2; the print leaves out rr . (ms rs x (V x Omega)), which ``restored`` adds."""
    M1, M2, M3 = _moment_without_movable(x, p, restored)
    return M1 * x.rrx + p.Rr * (M3 * cos(x.gamma) - M2 * sin(x.gamma))


def eq49(x: Spiral, p: Parameters, restored: bool = True) -> float:
    """r_rx from (40), m."""
    M1, M2, M3 = _moment_without_movable(x, p, restored)
    return p.Rr * (M2 * sin(x.gamma) - M3 * cos(x.gamma)) / M1


def gamma_from_40(x: Spiral, p: Parameters, restored: bool = True) -> float:
    """gamma from (40), rad. Where the print takes it from (37)."""
    M1, M2, M3 = _moment_without_movable(x, p, restored)
    return _nearest(-p.Rr * M2, p.Rr * M3, -M1 * x.rrx, x.gamma)


def eq39(x: Spiral, p: Parameters) -> float:
    """omega_3 from (39), rad/s: (P x V + T) . k_b = 0, linear in omega_3."""
    k_b, V = _k_b(x), velocity_from_flow(x.V, x.alpha, x.beta)
    s = first_moment(Controls(x.rrx, x.gamma, x.mb), p)
    mt, w = _mt(p), _flow(x, p)
    u = (mt[0] * V[0], mt[1] * V[1], mt[2] * V[2])
    whole, rate = _body(x, w.T), _body(x, w.T_rate)
    still = dot(add(cross(u, V), add(whole, scale(-x.omega3, rate))), k_b)
    return -still / dot(add(scale(-1.0, cross(cross(s, k_b), V)), rate), k_b)


def eq41(x: Spiral, p: Parameters) -> float:
    """m_b from (38), kg: the force along k_b."""
    w, k = _flow(x, p), _k_b(x)
    return -dot(_body(x, (-w.D, w.SF, -w.L)), k) / x.g


def eq42(x: Spiral, p: Parameters) -> float:
    """omega_3, rad/s: (T . k_b) omega_3 = -(F + m_b g k_b) . V, quadratic, T being linear in omega_3.

    Of the two roots that nearer to omega_3 of the pass before; where the discriminant is negative their common part.
    """
    w, k_b, V = _flow(x, p), _k_b(x), velocity_from_flow(x.V, x.alpha, x.beta)
    F = _body(x, (-w.D, w.SF, -w.L))
    a = dot(_body(x, w.T_rate), k_b)
    b = dot(_body(x, w.T), k_b) - a * x.omega3
    c = dot(add(F, scale(x.mb * x.g, k_b)), V)
    root = math.sqrt(max(b * b - 4.0 * a * c, 0.0))
    return min(((-b + s * root) / (2.0 * a) for s in (1.0, -1.0)), key=lambda value: abs(value - x.omega3))
