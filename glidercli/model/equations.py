"""How does the glider move? Eq. (19) as the rate of its momentum, and the six equations of steady flight.

Eq. (19) reads Mdot nu + M nudot = wrench, that is d(M nu)/dt = wrench. The state therefore carries the momentum
(P, Pi) = M nu itself (eqs 16-18): Mdot needs no forming, and an actuator may start or stop at once without a jump in
the state. Velocities follow from (P, Pi) = M (V, Omega) whenever they are needed.

V is the velocity through water, V_r = V - R_EB^T V_current: eq. (50).
"""

from __future__ import annotations

from typing import NamedTuple

from glidercli.frames import (
    Quaternion,
    Vector,
    add,
    cross,
    dot,
    quaternion_rate,
    rotation_ned_body,
    scale,
    times,
    transposed,
)  # fmt: skip
from glidercli.kernel import kernel
from glidercli.model.buoyancy import displaced_mass, hull_excess, pumped_excess
from glidercli.model.hydrodynamics import forces_and_moments
from glidercli.model.mass import Placement, momentum, placement, velocity
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water

__all__ = ["EQUATIONS", "Rates", "State", "equilibrium", "rates", "wrench"]


EQUATIONS = (
    "force along x (28)", "force along y (28)", "force along z (28)",
    "roll moment (29)", "pitch moment (29)", "yaw moment (29)",
)  # fmt: skip
"""Names of what ``equilibrium`` gives."""


class State(NamedTuple):
    """Everything that a flight remembers."""

    position: Vector
    """m, NED from the start; the third is the depth."""
    q_wxyz: Quaternion
    """Attitude, R_EB as a unit quaternion."""
    P: Vector
    """Translational momentum through water, kg m/s, body frame."""
    Pi: Vector
    """Angular momentum through water, kg m2/s, body frame."""


class Rates(NamedTuple):
    """Time derivative of a State, and the power that goes into the water."""

    position: Vector
    q_wxyz: Quaternion
    P: Vector
    Pi: Vector
    power: float
    """W, lost to the water by hydrodynamic forces and moments."""
    V: Vector
    """m/s, velocity through water, body frame."""


@kernel
def wrench(
    V: Vector, Omega: Vector, P: Vector, Pi: Vector, F: Vector, T: Vector, k_b: Vector, at: Placement, water: Water,
    p: Parameters,
) -> tuple[Vector, Vector]:  # fmt: skip
    """The right-hand side of eq. (19), N and N m, body frame.

        P x Omega + mb g k_b + F
        Pi x Omega + P x V + (mr rr + ms rs + mb rb) x g k_b + T

    k_b : R_EB^T k, the direction of gravity. mb is that of the pump and of the hull in this water (buoyancy.py).
    """
    g = water.gravity
    mb = pumped_excess(at.mb, water.density, p)
    weight = mb + hull_excess(water.density, water.pressure, water.temperature, p)
    force = add(add(cross(P, Omega), scale(weight * g, k_b)), F)
    arm = add(at.s, scale(mb, p.rb))
    return force, add(add(cross(Pi, Omega), cross(P, V)), add(cross(arm, scale(g, k_b)), T))


@kernel
def equilibrium(
    V: Vector, k_b: Vector, omega3: float, c: Controls, water: Water, p: Parameters
) -> tuple[float, float, float, float, float, float]:
    """The six equations (28), (29) of steady flight, zero at a trim: N, N, N, N m, N m, N m, body frame.

    Turning is about the vertical, Omega = omega3 k_b: eq. (32). For the paper's form without C_A pass parameters
    through ``without_coupling``.
    """
    Omega = scale(omega3, k_b)
    dense = water.density / p.rho_ref
    P, Pi = momentum(V, Omega, c, dense, p)
    F, T = forces_and_moments(V, Omega, dense, p)
    f, m = wrench(V, Omega, P, Pi, F, T, k_b, placement(c, p, False), water, p)
    return (f[0], f[1], f[2], m[0], m[1], m[2])


@kernel
def shear_wrench(
    V_ned: Vector, REB: tuple[Vector, Vector, Vector], at: Placement, water: Water, p: Parameters
) -> tuple[Vector, Vector]:
    """Force and moment of a current that changes with depth and time, N and N m, body frame; eq. (50) has none.

    Rigid mass feels absolute acceleration: with a = dU/dt + zdot dU/dz along the vehicle's way and
    a_w = dU/dt + W dU/dz along the water's, the force is -(ms + mr) R^T a + md R^T a_w and the moment -s x R^T a.

    V_ned : velocity over ground, m/s. md is the displaced mass, W the downward current, s the first moment.
    """
    RBE = transposed(REB)
    a = times(RBE, add(water.change, scale(V_ned[2], water.shear)))
    a_w = times(RBE, add(water.change, scale(water.current[2], water.shear)))
    md = displaced_mass(at.mb, water.density, water.pressure, water.temperature, p)
    return add(scale(-(p.ms + p.mr), a), scale(md, a_w)), scale(-1.0, cross(at.s, a))


@kernel
def rates(s: State, at: Placement, water: Water, p: Parameters, full: bool) -> Rates:
    """Time derivative of the state: eqs (1), (3), (18) with (50).

    at : where the controls put the masses (see ``placement``). full : with the water's own acceleration along the way;
    False is the paper's form.
    """
    dense = water.density / p.rho_ref
    V, Omega = velocity(s.P, s.Pi, at, dense, p)
    REB = rotation_ned_body(s.q_wxyz)
    k_b = REB[2]  # R_EB^T k: the third row
    V_ned = add(times(REB, V), water.current)
    F, T = forces_and_moments(V, Omega, dense, p)
    force, moment = wrench(V, Omega, s.P, s.Pi, F, T, k_b, at, water, p)
    if full:
        force_shear, moment_shear = shear_wrench(V_ned, REB, at, water, p)
        force, moment = add(force, force_shear), add(moment, moment_shear)
    return Rates(V_ned, quaternion_rate(s.q_wxyz, Omega), force, moment, -dot(F, V) - dot(T, Omega), V)
