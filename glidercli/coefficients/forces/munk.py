"""What part of measured forces does the model add itself? Those of added mass in steady motion, as the Munk moment.

Eq. (19) has P x Omega in the force and P x V + Pi x Omega in the moment, with the water's own momentum in P and Pi:
P_A = M_A V + C_A Omega, Pi_A = C_A^T V + I_A Omega (eq. (14)). A hull that moves steadily through still water is
measured with them: in a CFD run, in a tow tank, on a rotating arm.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.coefficients.forces.table import Forces, to_body
from glidercli.vehicle.vehicle import AddedMass

__all__ = ["munk_slopes", "of_added_mass", "without_added_mass"]

Array = NDArray[np.float64]


def of_added_mass(V: Array, Omega: Array, added: AddedMass) -> tuple[Array, Array]:
    """P_A x Omega, N, and P_A x V + Pi_A x Omega, N m, in the body frame, (n, 3), at the density of the added mass.

    V : m/s, Omega : rad/s, body frame, (n, 3).
    """
    CA = np.zeros((3, 3))
    CA[1, 2], CA[2, 1] = added.yaw_from_sway, added.pitch_from_heave
    P = V * added.mass + Omega @ CA.T
    Pi = V @ CA + Omega * added.inertia
    return np.cross(P, Omega), np.cross(P, V) + np.cross(Pi, Omega)


def without_added_mass(f: Forces, added: AddedMass, added_density: float, density: float) -> Forces:
    """The table with the forces and moments of added mass taken off.

    added_density : kg/m3, at which the added mass holds. density : kg/m3 of cases that tell none.
    """
    R = to_body(f.alpha, f.beta)
    dense = np.where(np.isnan(f.density), density, f.density)[:, None] / added_density
    force, moment = of_added_mass(f.speed[:, None] * R[:, :, 0], f.Omega, added)
    force, moment = (np.einsum("nji,nj->ni", R, dense * vector) for vector in (force, moment))
    return f._replace(measured=f.measured - np.hstack([force * (-1.0, 1.0, -1.0), moment]))


def munk_slopes(added: AddedMass) -> tuple[float, float]:
    """(MA3 - MA1) of the pitch moment, per alpha V^2, and (MA1 - MA2) of the yaw moment, per beta V^2; kg/rad."""
    m1, m2, m3 = added.mass
    return m3 - m1, m1 - m2
