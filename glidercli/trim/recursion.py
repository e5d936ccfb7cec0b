"""Which controls fly at a given speed, angle of attack and sideslip? The paper's recursion, eqs (38)-(49), repaired.

V, alpha, beta fix the velocity V in the body frame and with it the hydrodynamic force F. The recursive vector of (44)
is here D = (k_b, m_b, omega_3, gamma, r_rx), k_b = R_EB^T k standing for (theta, phi); each pass renews every part of
it from the vector equations (28), (29) and the parts before it. docs/recursion.md derives each step and says where the
print could not be followed.

Four sequences are run: net buoyancy may sink or lift the vehicle, and the movable mass's circle is met twice. What a
sequence converges to is a trim only if the six equations (28), (29) say so.
"""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

from glidercli.frames import Vector, add, cross, dot, scale
from glidercli.model.equations import EQUATIONS, equilibrium
from glidercli.model.hydrodynamics import forces_and_moments, velocity_from_flow
from glidercli.model.mass import first_moment, momentum
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water

__all__ = ["CONVERGED", "Iterate", "Recursion", "change", "ended", "nearest_miss", "recursions"]

MOST_PASSES = 60
CONVERGED = 1e-12
"""Largest change of the recursive vector in one pass: unit vector, kg, rad/s, rad, m. Rounding leaves 1e-15."""
RESIDUAL = 1e-9
"""Largest of the six equations, N and N m, of a trim; the smallest weight of interest, 0.01 kg, is 0.1 N."""


class Iterate(NamedTuple):
    """The recursive vector of eq. (44), and whether the circle of the movable mass was met in this pass."""

    k_b: Vector
    """Direction of gravity, body frame."""
    mb: float
    """Net buoyancy, kg."""
    omega3: float
    """rad/s."""
    gamma: float
    """rad."""
    rrx: float
    """m."""
    met: bool

    @property
    def roll(self) -> float:
        """phi, rad."""
        return math.atan2(self.k_b[1], self.k_b[2])

    @property
    def pitch(self) -> float:
        """theta, rad."""
        return -math.asin(max(-1.0, min(1.0, self.k_b[0])))


class Recursion(NamedTuple):
    """One sequence of (44). start : what sets it apart from the others."""

    start: str
    iterates: tuple[Iterate, ...]
    converged: bool
    residual: float
    """Largest of the six equations (28), (29) at the last iterate, N or N m."""

    @property
    def last(self) -> Iterate:
        """The last iterate."""
        return self.iterates[-1]

    @property
    def controls(self) -> Controls:
        """The controls of the last iterate."""
        return Controls(self.last.rrx, self.last.gamma, self.last.mb)


def change(a: Iterate, b: Iterate) -> float:
    """Largest difference of two iterates: unit vector, kg, rad/s, rad, m."""
    of_k_b = max(abs(x - y) for x, y in zip(a.k_b, b.k_b, strict=True))
    return max(of_k_b, abs(a.mb - b.mb), abs(a.omega3 - b.omega3), abs(a.gamma - b.gamma), abs(a.rrx - b.rrx))


def gravity_and_buoyancy(
    F: Vector, u: Vector, s: Vector, before: Iterate, sinks: int, water: Water
) -> tuple[Vector, float]:
    """(k_b, m_b) from the force equation (28): (m_b g I + omega_3 hat(u)) k_b = -F', |k_b| = 1. For (38), (45), (46).

    F' = F - omega_3^2 (s x k_b) x k_b and omega_3 are those of the iterate before. With a = m_b g, w = omega_3 u and
    b = -F', the length of k_b gives a quadratic in a^2 with one root that is not negative.
    """
    w = scale(before.omega3, u)
    b = add(scale(-1.0, F), scale(before.omega3**2, cross(cross(s, before.k_b), before.k_b)))
    bb, ww, wb = dot(b, b), dot(w, w), dot(w, b)
    aa = 0.5 * (bb - ww + math.sqrt((bb - ww) ** 2 + 4.0 * wb * wb))
    a = sinks * math.sqrt(aa)
    k_b = scale(1.0 / (aa + ww), add(add(scale(a, b), scale(-1.0, cross(w, b))), scale(wb / a, w)))
    return k_b, a / water.gravity


def turning_rate(V: Vector, k_b: Vector, c: Controls, water: Water, p: Parameters) -> float:
    """omega_3 from (39), (P x V + T) . k_b = 0, which is linear in omega_3; for (42)."""

    def about_vertical(omega3: float) -> float:
        Omega = scale(omega3, k_b)
        P, _ = momentum(V, Omega, c, water.density / p.rho_ref, p)
        _, T = forces_and_moments(V, Omega, water.density / p.rho_ref, p)
        return dot(add(cross(P, V), T), k_b)

    still = about_vertical(0.0)
    return -still / (about_vertical(1.0) - still)


def mass_placement(
    V: Vector, k_b: Vector, mb: float, omega3: float, c: Controls, root: int, water: Water, p: Parameters
) -> tuple[float, float, bool]:
    """(gamma, r_rx, met) from (29): s x g k_b = -(Pi x Omega + P x V + T). For (37), (40), (47) and (49).

    s then lies on a line along k_b, which meets the circle of the movable mass, r_ry^2 + r_rz^2 = Rr^2, twice (root +1
    and -1). Where it misses the circle the nearest point stands in, and met is False.
    """
    Omega = scale(omega3, k_b)
    P, Pi = momentum(V, Omega, c, water.density / p.rho_ref, p)
    _, T = forces_and_moments(V, Omega, water.density / p.rho_ref, p)
    moment = add(add(cross(Pi, Omega), cross(P, V)), T)
    across = add(cross(k_b, scale(-1.0 / water.gravity, moment)), scale(-mb, p.rb))  # s = across + lambda k_b
    _, y, z = scale(1.0 / p.mr, add(across, scale(-p.ms, p.rs)))
    ky, kz = k_b[1] / p.mr, k_b[2] / p.mr
    kk, ky_z = ky * ky + kz * kz, ky * y + kz * z
    discriminant = ky_z * ky_z - kk * (y * y + z * z - p.Rr * p.Rr)
    along = (-ky_z + root * math.sqrt(max(discriminant, 0.0))) / kk
    x, y, z = scale(1.0 / p.mr, add(add(across, scale(along, k_b)), scale(-p.ms, p.rs)))
    return math.atan2(0.0 - y, z), x, discriminant >= 0.0


def recursion(
    V: Vector, sinks: int, root: int, nominal: float, water: Water, p: Parameters, passes: int = MOST_PASSES
) -> Recursion:
    """One sequence of (44), from straight flight with the movable mass at its nominal place, m."""
    dense = water.density / p.rho_ref
    u, _ = momentum(V, (0.0, 0.0, 0.0), Controls(nominal, 0.0, 0.0), dense, p)  # Mt V
    F, _ = forces_and_moments(V, (0.0, 0.0, 0.0), dense, p)
    D = Iterate((0.0, 0.0, 1.0), 0.0, 0.0, 0.0, nominal, True)
    iterates: list[Iterate] = []
    converged = False
    for _ in range(passes):
        c = Controls(D.rrx, D.gamma, D.mb)  # of the pass before
        k_b, mb = gravity_and_buoyancy(F, u, first_moment(c, p), D, sinks, water)
        omega3 = turning_rate(V, k_b, c, water, p)
        gamma, rrx, met = mass_placement(V, k_b, mb, omega3, c, root, water, p)
        before, D = D, Iterate(k_b, mb, omega3, gamma, rrx, met)
        iterates.append(D)
        if change(before, D) < CONVERGED:
            converged = True
            break
    start = f"{'sinking' if sinks > 0 else 'rising'}, {'far' if root > 0 else 'near'} side of the circle"
    return ended(start, iterates, converged and D.met, V, water, p)


def ended(start: str, iterates: list[Iterate], stands: bool, V: Vector, water: Water, p: Parameters) -> Recursion:
    """A sequence that is over, judged by the six equations; ``stands`` is whether it came to rest."""
    D = iterates[-1]
    residual = max(map(abs, equilibrium(V, D.k_b, D.omega3, Controls(D.rrx, D.gamma, D.mb), water, p)))
    return Recursion(start, tuple(iterates), stands and residual < RESIDUAL, residual)


def recursions(speed: float, alpha: float, beta: float, nominal: float, water: Water, p: Parameters) -> list[Recursion]:
    """The four sequences of a speed, m/s, angle of attack and sideslip, rad."""
    V = velocity_from_flow(speed, alpha, beta)
    return [recursion(V, sinks, root, nominal, water, p) for sinks, root in itertools.product((1, -1), (1, -1))]


def nearest_miss(sequences: list[Recursion], V: Vector, water: Water, p: Parameters) -> str:
    """Why none of the sequences is a trim: the equation furthest from zero where the residual is least."""
    near = min(sequences, key=lambda one: one.residual)
    D = near.last
    six = equilibrium(V, D.k_b, D.omega3, near.controls, water, p)
    worst = max(range(6), key=lambda i: abs(six[i]))
    circle = "" if D.met else "; the movable mass would have to leave its circle"
    return (
        f"no controls found for this speed, angle of attack and sideslip: the {EQUATIONS[worst]} stays furthest from "
        f"zero, {six[worst]:.3g}, at net buoyancy {D.mb:.3g} kg, mass position {D.rrx:.4g} m, mass rotation "
        f"{math.degrees(D.gamma):.1f} deg, roll {math.degrees(D.roll):.1f} deg, pitch {math.degrees(D.pitch):.1f} "
        f"deg{circle}"
    )
