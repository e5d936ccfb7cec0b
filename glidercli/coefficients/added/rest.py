"""What would account for a vehicle's added mass? Surfaces that fill what its hull leaves; a hull that fits all terms.

A surface of mass mu at x behind or ahead of the centre of buoyancy adds mu to the mass across its plane, mu x to the
coupling and mu x^2 to the inertia. So what is left of a vehicle's terms beyond the hull's says where the surfaces are;
and whether there can be any. With the hull's own mass h and inertia I left free, six terms have six unknowns:

    h + mu_w = Z_w',   mu_w |x_w| = |M_w'|,   I + mu_w x_w^2 = M_q'        wings
    h + mu_t = Y_v',   mu_t |x_t| = |N_v'|,   I + mu_t x_t^2 = N_r'        tail
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from glidercli.coefficients.added.strips import Terms
from glidercli.coefficients.shape.geometry import Geometry

__all__ = ["Accounted", "Plane", "Rest", "rest"]


@dataclasses.dataclass(frozen=True)
class Plane:
    """What surfaces in one plane would have to be.

    mass : added by them across their plane, kg. distance : of their middle from the centre of buoyancy, m, without a
    sign, since nothing printed decides that of the coupling. inertia_left : that of the vehicle less the hull's and
    mass x distance^2, kg m2. faults : why no surface of this vehicle can be so; none if one can.
    """

    mass: float
    distance: float
    inertia_left: float
    faults: tuple[str, ...]


@dataclasses.dataclass(frozen=True)
class Accounted:
    """Hull, wings and tail that give six terms at once: kg, m, kg m2; length and diameter of the hull by strips, m."""

    hull_mass: float
    hull_inertia: float
    wing_mass: float
    wing_distance: float
    tail_mass: float
    tail_distance: float
    hull_length: float
    hull_diameter: float


@dataclasses.dataclass(frozen=True)
class Rest:
    """What is left of a vehicle's added mass beyond a hull.

    wings, tail : surfaces that would fill it. wing_reach : semi-span at which rectangular wings of that mass have the
    roll inertia that is left, m; None if there is none to fill. accounted : see ``Accounted``; None if nothing does.
    signs : what the signs of the couplings say.
    """

    wings: Plane
    tail: Plane
    wing_reach: float | None
    accounted: Accounted | None
    signs: tuple[str, ...]

    def document(self) -> dict[str, Any]:
        """As JSON."""
        return dataclasses.asdict(self)


def rest(vehicle: Terms, hull: Terms, geometry: Geometry, origin: float) -> Rest:
    """What surfaces would account for the rest of a vehicle's added mass.

    vehicle : its terms. hull : those of its hull alone, whose geometry it is. origin : centre of buoyancy, m.
    """
    radius, length = geometry.hull.thickest / 2.0, geometry.hull.length_overall
    wings = _plane(vehicle.heave - hull.heave, vehicle.pitch_from_heave, vehicle.pitch - hull.pitch, length)
    tail = _plane(vehicle.sway - hull.sway, vehicle.yaw_from_sway, vehicle.yaw - hull.yaw, length)
    accounted = _accounted(vehicle, geometry.density)
    reach = _reach(wings.mass, vehicle.roll - hull.roll, radius)
    return Rest(wings, tail, reach, accounted, _signs(vehicle, accounted, geometry.hull.ends[0] - origin))


def _signs(vehicle: Terms, accounted: Accounted | None, nose: float) -> tuple[str, ...]:
    """What the signs of the couplings say of where surfaces are. nose : ahead of the centre of buoyancy, m."""
    found = []
    for symbol, what, value, ahead, distance in (
        ("N_v'", "vertical fins", vehicle.yaw_from_sway, 1.0, accounted and accounted.tail_distance),
        ("M_w'", "wings", vehicle.pitch_from_heave, -1.0, accounted and accounted.wing_distance),
    ):
        if value == 0.0:
            continue
        where = "ahead of" if value * ahead > 0.0 else "behind"
        told = f"{symbol} {'above' if value > 0.0 else 'below'} zero puts the {what} {where} the centre of buoyancy"
        if distance and where == "ahead of" and distance > nose:
            told += f", {distance:.3g} m: the nose is {nose:.3g} m ahead, so strip theory wants the other sign"
        found.append(told)
    return tuple(found)


def _plane(mass: float, coupling: float, inertia: float, length: float) -> Plane:
    if not mass > 0.0:
        return Plane(mass, math.nan, inertia, (f"the hull alone has {-mass:.3g} kg more",))
    distance = abs(coupling) / mass
    left = inertia - mass * distance**2
    faults = []
    if distance > 0.75 * length:
        faults.append(f"{mass:.3g} kg would have to stand {distance:.3g} m off, and the vehicle is {length:.3g} m long")
    if left < -1e-9 * abs(inertia):
        faults.append(f"hull and surfaces would have {-left:.3g} kg m2 more than the vehicle")
    return Plane(mass, distance, left, tuple(faults))


def _reach(mass: float, roll: float, radius: float) -> float | None:
    """Semi-span s of rectangular wings, m: their mean square distance (s^2 + s a + a^2)/3 is roll / mass."""
    if not (mass > 0.0 and roll > 0.0):
        return None
    square = 3.0 * roll / mass - 0.75 * radius**2
    return math.sqrt(square) - radius / 2.0 if square > 0.25 * radius**2 else None


def _accounted(vehicle: Terms, density: float) -> Accounted | None:
    """The root h of N_v'^2/(Y_v' - h) - M_w'^2/(Z_w' - h) = N_r' - M_q' between 0 and both masses, by bisection."""
    wing2, tail2 = vehicle.pitch_from_heave**2, vehicle.yaw_from_sway**2

    def excess(h: float) -> float:
        return tail2 / (vehicle.sway - h) - wing2 / (vehicle.heave - h) - (vehicle.yaw - vehicle.pitch)

    low, high = 0.0, min(vehicle.sway, vehicle.heave) * (1.0 - 1e-9)
    if not (wing2 > 0.0 and tail2 > 0.0 and high > 0.0 and excess(low) * excess(high) < 0.0):
        return None
    for _ in range(100):
        h = (low + high) / 2.0
        low, high = (h, high) if excess(low) * excess(h) > 0.0 else (low, h)
    wings, tail = vehicle.heave - h, vehicle.sway - h
    inertia = vehicle.pitch - wing2 / wings
    if not inertia > 0.0:
        return None
    length = 2.0 * math.sqrt(5.0 * inertia / h)  # strips of an ellipsoid: h = rho V, I = h (L/2)^2 / 5
    return Accounted(
        h, inertia, wings, math.sqrt(wing2) / wings, tail, math.sqrt(tail2) / tail, length,
        math.sqrt(6.0 * h / (math.pi * density * length)),
    )  # fmt: skip
