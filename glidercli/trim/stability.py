"""Does a steady flight hold? The eigenvalues of small deviations from it, eq. (19) linearised about the trim.

The deviations are those of momentum P, Pi, roll and pitch: the rate of none depends on place or heading, so that a trim
is a fixed point of these eight. A trim holds where every eigenvalue has a negative real part.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import down_in_body, quaternion_from_euler, scale
from glidercli.model.equations import State, rates, through_water
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.mass import momentum
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water

__all__ = ["growth_rate", "linearised"]

Array = NDArray[np.float64]

_STEP = 1e-6  # of each deviation's size; central differences then err by 1e-12 (truncation) and 1e-10 (rounding)


def linearised(x: Array, c: Controls, water: Water, p: Parameters) -> Array:
    """The matrix A, (8, 8), of d/dt delta = A delta about a trim x = (V, alpha, beta, omega_3, phi, theta), SI, rad.

    delta : deviation of P (kg m/s), Pi (kg m2/s), roll and pitch (rad).
    """
    V, alpha, beta, omega3, phi, theta = (float(item) for item in x)
    Omega = scale(omega3, down_in_body(phi, theta))
    P, Pi = momentum(velocity_from_flow(V, alpha, beta), Omega, c, water.density / p.rho_ref, p)
    at = np.array([*P, *Pi, phi, theta])
    sizes = np.array([max(1.0, float(np.abs(at[:6]).max()))] * 6 + [1.0, 1.0])
    columns = [
        (_rate(at + h, c, water, p) - _rate(at - h, c, water, p)) / (2.0 * h.sum()) for h in np.diag(_STEP * sizes)
    ]
    return np.array(columns).T


def growth_rate(A: Array) -> float:
    """Rate at which the worst deviation grows, 1/s; negative where every deviation decays and the trim is stable."""
    return float(np.linalg.eigvals(A).real.max())


def _rate(y: Array, c: Controls, water: Water, p: Parameters) -> Array:
    """Time derivative of (P, Pi, phi, theta); that of the Euler angles by eq. (3)."""
    P1, P2, P3, Pi1, Pi2, Pi3, phi, theta = (float(item) for item in y)
    s = State((0.0, 0.0, 0.0), quaternion_from_euler(phi, theta, 0.0), (P1, P2, P3), (Pi1, Pi2, Pi3))
    r = rates(s, c, water, p, True)
    _, (roll_rate, pitch_rate, yaw_rate) = through_water(s, c, water, p, True)
    turning = pitch_rate * math.sin(phi) + yaw_rate * math.cos(phi)
    phi_rate = roll_rate + turning * math.tan(theta)
    theta_rate = pitch_rate * math.cos(phi) - yaw_rate * math.sin(phi)
    return np.array([*r.P, *r.Pi, phi_rate, theta_rate])
