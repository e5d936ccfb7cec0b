"""Which flows must be computed for the coefficients of eq. (20)? The CFD cases of Table 2, by eqs (23) to (27).

Flow frame: p1 along the velocity, p2 to starboard, p3 down, R_BC of eq. (21) brings it to the body frame. A positive
turn about p3 is to starboard, one about p2 is nose up. The centre of curvature c is where V = Omega x (-c) holds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.coefficients.flows.reynolds import PAPER_DENSITY, PAPER_VISCOSITY, reynolds_number, turbulence
from glidercli.errors import InputError
from glidercli.frames import times
from glidercli.model.hydrodynamics import rotation_body_flow, velocity_from_flow
from glidercli.units import DEGREE
from glidercli.vehicle.vehicle import Hull

__all__ = ["COLUMNS", "RADII", "SETS", "SPEED", "CaseTable", "cases"]

SPEED = 0.257
"""m/s, of Table 2: 0.5 knot."""
RADII = (5.0, 10.0, 20.0, 30.0, 40.0)
"""m, of Table 2: from the centre of curvature to the centre of buoyancy."""
SETS = ("straight", "about-p3", "about-p2")
"""Straight, turning in the horizontal plane of the flow frame, turning in its vertical plane."""

_STRAIGHT = tuple(float(angle) for angle in range(-12, 13))
_ANGLES = {  # (angle of attack, sideslip), deg
    "straight": [(a, 0.0) for a in _STRAIGHT] + [(0.0, b) for b in _STRAIGHT if b],
    "about-p3": [(0.0, float(b)) for b in (-3, 0, 3, 6, 9, 12)] + [(float(a), 0.0) for a in (-3, 3, 6, 9)],
}
_ANGLES["about-p2"] = _ANGLES["about-p3"]
_HALF_WIDTH, _AHEAD, _LONG = 9.0, 1.5, 5.0  # section 3.2: diameters, hull lengths, hull lengths

COLUMNS = (
    "case", "set", "turbulence_model", "angle_of_attack_deg", "sideslip_deg", "speed_m_s", "turning_radius_m",
    "curvature_1_m", "angular_speed_rad_s", "u_m_s", "v_m_s", "w_m_s", "p_rad_s", "q_rad_s", "r_rad_s",
    "centre_p1_m", "centre_p2_m", "centre_p3_m", "inlet_speed_inner_m_s", "inlet_speed_centre_m_s",
    "inlet_speed_outer_m_s", "domain_length_m", "domain_width_m", "domain_height_m", "inlet_distance_m",
    "reynolds_number", "density_kg_m3", "viscosity_Pa_s",
)  # fmt: skip
"""What is said of every case. The radius of a straight one is infinite: an empty cell, null."""


class CaseTable(NamedTuple):
    """columns : an array each, by COLUMNS. warnings : what to know before computing."""

    columns: dict[str, NDArray[Any]]
    warnings: list[str]

    def counts(self) -> dict[str, int]:
        """Cases of each set."""
        return {name: int((self.columns["set"] == name).sum()) for name in SETS}


def cases(
    hull: Hull,
    *,
    speed: float = SPEED,
    radii: Sequence[float] = RADII,
    density: float = PAPER_DENSITY,
    viscosity: float = PAPER_VISCOSITY,
) -> CaseTable:
    """The cases of Table 2 for a hull.

    speed : V and Vc, m/s. radii : Rc, m, each larger than the half width of the domain, 9 diameters.
    density : kg/m3. viscosity : Pa s.

    Raises InputError for a value that cannot be, or a radius that puts the centre of curvature into the domain.
    """
    for name, value, least, most, unit in (
        ("speed", speed, 1e-3, 50.0, "m/s"), ("density", density, 900.0, 1200.0, "kg/m3"),
        ("viscosity", viscosity, 1e-4, 0.1, "Pa s"),
    ):  # fmt: skip
        if not least <= value <= most:
            raise InputError(name, f"{value:g} {unit} is not allowed; {least:g} to {most:g} are")
    half = _HALF_WIDTH * hull.diameter
    for radius in radii:
        if not half < radius < math.inf:
            raise InputError(
                "radius",
                f"{radius:g} m is not allowed; more than {half:g} m is needed, the half width of the domain "
                f"({_HALF_WIDTH:g} diameters): its inner edge would pass the centre of curvature",
            )
    if twice := [radius for i, radius in enumerate(radii) if radius in radii[:i]]:
        raise InputError("radius", f"{twice[0]:g} m is given twice")
    reynolds = reynolds_number(speed, hull.length, density, viscosity)
    shared: dict[str, Any] = {
        "speed_m_s": speed,
        "domain_length_m": _LONG * hull.length,
        "domain_width_m": 2.0 * half,
        "domain_height_m": 2.0 * half,
        "inlet_distance_m": _AHEAD * hull.length,
        "reynolds_number": reynolds,
        "density_kg_m3": density,
        "viscosity_Pa_s": viscosity,
    }
    rows = [
        {**shared, **_case(kind, alpha, beta, radius, speed, half)}
        for kind in SETS
        for radius in ((math.inf,) if kind == "straight" else radii)
        for alpha, beta in _ANGLES[kind]
    ]
    rows = [{"case": number, **row} for number, row in enumerate(rows, start=1)]
    columns = {name: np.array([row[name] for row in rows]) for name in COLUMNS}
    return CaseTable(columns, [text for text in (turbulence(reynolds),) if text])


def _case(kind: str, alpha_deg: float, beta_deg: float, radius: float, speed: float, half: float) -> dict[str, Any]:
    """One case: V by (25), omega by (24), Omega by (26) or (27), the inlet's speeds omega R_inlet."""
    alpha, beta = alpha_deg * DEGREE, beta_deg * DEGREE
    straight = kind == "straight"
    omega = speed / radius
    about = {"straight": (0.0, 0.0, 0.0), "about-p3": (0.0, 0.0, omega), "about-p2": (0.0, omega, 0.0)}[kind]
    centre = {"straight": (math.inf,) * 3, "about-p3": (0.0, radius, 0.0), "about-p2": (0.0, 0.0, -radius)}[kind]
    V, Omega = velocity_from_flow(speed, alpha, beta), times(rotation_body_flow(alpha, beta), about)
    inlet = [speed if straight else omega * (radius + side) for side in (-half, 0.0, half)]
    return {
        "set": kind,
        "turbulence_model": "k-epsilon" if straight else "k-omega",
        "angle_of_attack_deg": alpha_deg,
        "sideslip_deg": beta_deg,
        "turning_radius_m": radius,
        "curvature_1_m": 1.0 / radius,
        "angular_speed_rad_s": omega,
        **dict(zip(("u_m_s", "v_m_s", "w_m_s"), V, strict=True)),
        **{name: value + 0.0 for name, value in zip(("p_rad_s", "q_rad_s", "r_rad_s"), Omega, strict=True)},
        **dict(zip(("centre_p1_m", "centre_p2_m", "centre_p3_m"), centre, strict=True)),
        **dict(zip(("inlet_speed_inner_m_s", "inlet_speed_centre_m_s", "inlet_speed_outer_m_s"), inlet, strict=True)),
    }
