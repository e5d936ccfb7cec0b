"""What must hold in steady flight? The six equations (28), (29) in nine unknowns, their Jacobian, and three pins.

The unknowns are x = (V, alpha, beta, omega_3, phi, theta, r_rx, gamma, m_b), SI and rad. Three pins make the system
square: each holds one unknown, or the path's curvature 1 / R, at a value. Everything here is a kernel.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import add, dot, down_in_body, scale
from glidercli.kernel import kernel
from glidercli.model.derivatives import down_in_body_along, velocity_from_flow_along, wrench_along
from glidercli.model.equations import equilibrium
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water

__all__ = ["CURVATURE", "SLOWEST", "Pins", "Six", "Unknowns", "radius_speed", "six", "six_along", "system"]

Array = NDArray[np.float64]
Unknowns = tuple[float, float, float, float, float, float, float, float, float]
Six = tuple[float, float, float, float, float, float]
Pins = tuple[int, int, int]
"""Places in x of what is pinned, CURVATURE for 1 / R."""

CURVATURE = 9
SLOWEST = 1e-9
"""m/s: a horizontal speed below it, in vertical flight, is taken as this where it divides."""


@kernel
def six(x: Unknowns, water: Water, p: Parameters) -> Six:
    """The six equations (28), (29) at x, N and N m; zero at a trim."""
    V, alpha, beta, omega3, phi, theta, rrx, gamma, mb = x
    c = Controls(rrx, gamma, mb, 0.0, 0.0)
    return equilibrium(velocity_from_flow(V, alpha, beta), down_in_body(phi, theta), omega3, c, water, p)


@kernel
def six_along(x: Unknowns, d: Unknowns, water: Water, p: Parameters) -> Six:
    """Change of the six equations with a change d of x."""
    speed, alpha, beta, omega3, phi, theta, rrx, gamma, mb = x
    V, dV = velocity_from_flow(speed, alpha, beta), velocity_from_flow_along(speed, alpha, beta, d[0], d[1], d[2])
    k_b, dk_b = down_in_body(phi, theta), down_in_body_along(phi, theta, d[4], d[5])
    Omega, dOmega = scale(omega3, k_b), add(scale(d[3], k_b), scale(omega3, dk_b))
    c, dc = Controls(rrx, gamma, mb, 0.0, 0.0), Controls(d[6], d[7], d[8], 0.0, 0.0)
    f, m = wrench_along(V, Omega, k_b, c, dV, dOmega, dk_b, dc, water, p)
    return (f[0], f[1], f[2], m[0], m[1], m[2])


@kernel
def radius_speed(x: Unknowns, printed: bool) -> float:
    """R omega_3, m/s: the horizontal speed, or as eq. (33) prints it V cos(theta - alpha)."""
    if printed:
        return x[0] * math.cos(x[5] - x[1])
    sinking = dot(velocity_from_flow(x[0], x[1], x[2]), down_in_body(x[4], x[5]))
    return math.sqrt(max(0.0, x[0] * x[0] - sinking * sinking))


@kernel
def radius_speed_along(x: Unknowns, d: Unknowns, printed: bool) -> float:
    """Change of ``radius_speed`` with a change d of x."""
    if printed:
        return d[0] * math.cos(x[5] - x[1]) - x[0] * math.sin(x[5] - x[1]) * (d[5] - d[1])
    V, k_b = velocity_from_flow(x[0], x[1], x[2]), down_in_body(x[4], x[5])
    dV = velocity_from_flow_along(x[0], x[1], x[2], d[0], d[1], d[2])
    sinking = dot(V, k_b)
    dsinking = dot(dV, k_b) + dot(V, down_in_body_along(x[4], x[5], d[4], d[5]))
    return (x[0] * d[0] - sinking * dsinking) / max(radius_speed(x, printed), SLOWEST)


@kernel
def system(
    x: Unknowns, pins: Pins, values: tuple[float, float, float], printed: bool, water: Water, p: Parameters
) -> tuple[Array, Array]:
    """Jacobian (9, 9) and residual (9,): the six equations, then omega_3 = radius_speed / R or x_i = value each pin.

    x_i must stand at its value already; its column, which no step then needs, is left out.
    """
    A, r = np.zeros((9, 9)), np.zeros(9)
    equations = six(x, water, p)
    for row in range(6):
        r[row] = equations[row]
    for column in range(9):
        if column == pins[0] or column == pins[1] or column == pins[2]:
            continue
        d = unit(column)
        change = six_along(x, d, water, p)
        for row in range(6):
            A[row, column] = change[row]
        for k in range(3):
            if pins[k] == CURVATURE:
                A[6 + k, column] = d[3] - values[k] * radius_speed_along(x, d, printed)
    for k in range(3):
        if pins[k] == CURVATURE:
            r[6 + k] = x[3] - values[k] * radius_speed(x, printed)
        else:
            A[6 + k, pins[k]] = 1.0
    return A, r


@kernel
def unit(i: int) -> Unknowns:
    """The change of the i-th unknown alone."""
    return (
        1.0 if i == 0 else 0.0, 1.0 if i == 1 else 0.0, 1.0 if i == 2 else 0.0, 1.0 if i == 3 else 0.0,
        1.0 if i == 4 else 0.0, 1.0 if i == 5 else 0.0, 1.0 if i == 6 else 0.0, 1.0 if i == 7 else 0.0,
        1.0 if i == 8 else 0.0,
    )  # fmt: skip
