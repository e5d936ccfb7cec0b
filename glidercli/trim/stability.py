"""Does a steady flight hold? Eq. (19) linearised exactly about a trim, and the modes in which deviations die or grow.

A deviation is one of speed, angle of attack, sideslip, body rates p, q, r, roll and pitch. The rate of none depends on
place or heading, so that a trim is a fixed point of these eight; it holds where every eigenvalue has a negative real
part.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import Vector, down_in_body, scale
from glidercli.kernel import kernel
from glidercli.model.derivatives import down_in_body_along, flow_angles_along, velocity_from_flow_along, wrench_along
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.mass import placement, velocity
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water
from glidercli.trim.steady import Unknowns

__all__ = ["DEVIATIONS", "Mode", "growth_rate", "linearised", "modes"]

Array = NDArray[np.float64]

DEVIATIONS = (
    "speed", "angle of attack", "sideslip", "roll rate", "pitch rate", "yaw rate", "roll", "pitch",
)  # fmt: skip
"""What the rows and columns of the linear model stand for."""


class Mode(NamedTuple):
    """One eigenvalue of the linear model, and what it means. Frequency and damping are those of a complex pair."""

    eigenvalue: complex
    """1/s."""
    damping_ratio: float
    """-Re / |eigenvalue|: 1 for a decay without oscillation, -1 for such a growth."""
    natural_frequency: float
    """|eigenvalue|, rad/s."""
    time_to_half: float | None
    """s; None where the mode grows."""
    time_to_double: float | None
    """s; None where the mode decays."""
    dominant: str
    """The deviation that takes the largest part in it: largest product of its entries in the left and right
    eigenvectors, which does not depend on units."""

    def document(self) -> dict[str, Any]:
        """The mode in the contract's names."""
        return {
            "eigenvalue": [self.eigenvalue.real, self.eigenvalue.imag],
            "damping_ratio": self.damping_ratio,
            "natural_frequency_rad_s": self.natural_frequency,
            "time_to_half_s": self.time_to_half,
            "time_to_double_s": self.time_to_double,
            "dominant": self.dominant,
        }


@kernel
def turning_along(
    Omega: Vector, dOmega: Vector, roll: float, pitch: float, d_roll: float, d_pitch: float
) -> tuple[float, float]:
    """Changes of the roll and pitch rates of eq. (3), rad/s.

    phi' = p + (q sin phi + r cos phi) tan theta, theta' = q cos phi - r sin phi.
    """
    cr, sr, t = math.cos(roll), math.sin(roll), math.tan(pitch)
    turning = Omega[1] * sr + Omega[2] * cr
    rise = Omega[1] * cr - Omega[2] * sr
    d_turning = dOmega[1] * sr + dOmega[2] * cr + rise * d_roll
    d_rise = dOmega[1] * cr - dOmega[2] * sr - turning * d_roll
    return dOmega[0] + d_turning * t + turning * (1.0 + t * t) * d_pitch, d_rise


@kernel
def linearised(x: Unknowns, water: Water, p: Parameters) -> Array:
    """The matrix A, (8, 8), of d/dt delta = A delta about a trim x, in the order of DEVIATIONS; SI, rad.

    With the controls at rest M does not change, so that d(M nu)/dt = wrench gives M delta-nudot = delta-wrench, exactly
    as the derivatives of the model's own functions have it.
    """
    speed, alpha, beta, omega3, phi, theta, rrx, gamma, mb = x
    c, still = Controls(rrx, gamma, mb, 0.0, 0.0), Controls(0.0, 0.0, 0.0, 0.0, 0.0)
    at = placement(c, p, False)
    V, k_b = velocity_from_flow(speed, alpha, beta), down_in_body(phi, theta)
    Omega = scale(omega3, k_b)
    A = np.zeros((8, 8))
    for column in range(8):
        d = np.zeros(8)
        d[column] = 1.0
        dV = velocity_from_flow_along(speed, alpha, beta, d[0], d[1], d[2])
        dOmega = (d[3], d[4], d[5])
        dk_b = down_in_body_along(phi, theta, d[6], d[7])
        force, moment = wrench_along(V, Omega, k_b, c, dV, dOmega, dk_b, still, water, p)
        V_rate, Omega_rate = velocity(force, moment, at, water.density / p.rho_ref, p)
        flow_rate = flow_angles_along(V, V_rate)
        attitude_rate = turning_along(Omega, dOmega, phi, theta, d[6], d[7])
        for row in range(3):
            A[row, column] = flow_rate[row]
            A[3 + row, column] = Omega_rate[row]
        A[6, column], A[7, column] = attitude_rate[0], attitude_rate[1]
    return A


def growth_rate(A: Array) -> float:
    """Rate at which the worst deviation grows, 1/s; negative where every deviation decays and the trim is stable."""
    return float(np.linalg.eigvals(A).real.max())


def modes(A: Array) -> list[Mode]:
    """The modes of a linear model (8, 8), slowest decay first; both of a complex pair are listed."""
    values, right = np.linalg.eig(A)
    parts = np.abs(np.linalg.inv(right).T * right)  # participation: left times right eigenvector, entry by entry
    found = []
    for value, part in zip(values, parts.T, strict=True):
        size, real = float(abs(value)), float(value.real)
        found.append(
            Mode(
                eigenvalue=complex(value),
                damping_ratio=-real / size if size else 0.0,
                natural_frequency=size,
                time_to_half=math.log(2.0) / -real if real < 0.0 else None,
                time_to_double=math.log(2.0) / real if real > 0.0 else None,
                dominant=DEVIATIONS[int(part.argmax())],
            )
        )
    return sorted(found, key=lambda mode: (-mode.eigenvalue.real, mode.eigenvalue.imag))
