"""Which hydrodynamic coefficients would a shape have? Handbook estimates of eq. (20), with intervals, part by part.

Forces of a steady flight about the centre of buoyancy, over V^2: K = rho/2 times areas. Two things are the model's own:

- The Munk moments of P x V, (Z_w' - X_u') alpha V^2 in pitch and -(Y_v' - X_u') beta V^2 in yaw, come on top of K_M and
  K_MY in the model. What is estimated is the whole moment; K_M and K_MY are what is left of it once the model's own is
  taken away, so they hold with the added mass that they were estimated with. For a wing that leaves its lift in the
  middle of its chord: a quarter of the chord times the lift of a flat plate is exactly what its added mass makes.
- Eq. (20) has damping as K_p p V^2, where water has it as p V. The coefficient is the latter over the speed at which it
  is to hold; at twice that speed the model damps twice too much.

Signs are those of the model: T1..T3 about x, y, z, a surface at x with lift slope K_alpha > 0 gives K_M = x K_alpha,
a fin with K_beta < 0 gives K_MY = x K_beta: aft (x < 0) it turns the nose into the flow.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any, NamedTuple

from glidercli.coefficients.added.added_mass import added_mass, hull_volume
from glidercli.coefficients.added.spheroid import spheroid
from glidercli.coefficients.flows.case_table import SPEED
from glidercli.coefficients.flows.reynolds import PAPER_VISCOSITY
from glidercli.coefficients.forces.munk import munk_slopes
from glidercli.coefficients.handbook.body import crosswise
from glidercli.coefficients.handbook.bounds import Bounds, exactly
from glidercli.coefficients.handbook.friction import REYNOLDS, friction, hull_form, profile_form, wetted_area
from glidercli.coefficients.handbook.lifting import SHIFT, Lifting, lifting
from glidercli.coefficients.shape.geometry import Geometry, Surface
from glidercli.errors import InputError
from glidercli.vehicle.vehicle import AddedMass

__all__ = ["COEFFICIENTS", "SPEED", "Coefficient", "Estimated", "Row", "estimate"]

FITTED = math.radians(12.0)
"""rad: range of the CFD cases, Table 2."""

ATTACHED_FROM = 1e5
"""Chord Reynolds number from which the flow is nominally attached at the leading edge; below, no suction."""
OSWALD = 0.9
"""Of the induced drag of attached flow, L^2 / (q pi b^2 e)."""
INCIDENCE = math.radians(0.5)
"""By which a wing may stand off the hull's axis: interval of K_L0 and K_M0 around zero."""
SLENDER = 4.0
"""Length over diameter from which the hull's formulas are used without a warning."""
DIHEDRAL = math.radians(2.0)
"""Of wings whose file says flat: what their roll from sideslip may come to is that of so much, to either side."""


class Row(NamedTuple):
    """A coefficient: its symbol in the paper, its name in a vehicle file, its unit there, and the formulas' sources."""

    symbol: str
    name: str
    unit: str
    method: str


_FRICTION = "ITTC (1957), Blasius (1908), form factors of Hoerner (1965)"
_LIFT = "Helmbold and DATCOM 4.1.3.2, TR 1307; hull: Hopkins (1951), Allen & Perkins (1951)"
COEFFICIENTS = (
    Row("K_D0", "drag_zero", "kg/m", _FRICTION),
    Row("K_D", "drag_attack", "kg/m/rad2", "no leading-edge suction, or induced drag; Allen & Perkins (1951)"),
    Row("K_beta", "side_sideslip", "kg/m/rad", _LIFT),
    Row("K_L0", "lift_zero", "kg/m", "symmetric: zero; interval 0.5 deg of incidence"),
    Row("K_alpha", "lift_attack", "kg/m/rad", _LIFT),
    Row("K_MR", "roll_sideslip", "kg/rad", "side force at its height; wings: zero, 2 deg of dihedral as interval"),
    Row("K_p", "roll_rate", "kg s/rad", "strips of the slope of a rolling wing, over the speed"),
    Row("K_M0", "pitch_zero", "kg", "drag at its height; interval 0.5 deg of incidence"),
    Row("K_M", "pitch_attack", "kg/rad", f"{_LIFT}; less the model's Munk moment"),
    Row("K_q", "pitch_rate", "kg s/rad", "lift times arm squared, over the speed; hull: Hopkins, Allen & Perkins"),
    Row("K_MY", "yaw_sideslip", "kg/rad", f"{_LIFT}; less the model's Munk moment"),
    Row("K_r", "yaw_rate", "kg s/rad", "lift times arm squared, over the speed; hull: Hopkins, Allen & Perkins"),
)  # fmt: skip
"""As in eq. (20) and Table 3."""

FURTHER = "further"
"""Name of the part of K_D0 that is the geometry's drag_area."""
MUNK = "Munk"
"""Name of the part of K_M and K_MY that takes the model's own moment away, where it is not the bare hull's."""


@dataclasses.dataclass(frozen=True)
class Coefficient:
    """An estimated coefficient: what each part of the vehicle gives to it, "hull" first."""

    row: Row
    parts: dict[str, Bounds]

    @property
    def total(self) -> Bounds:
        """Of the whole vehicle."""
        return sum(self.parts.values(), Bounds())


@dataclasses.dataclass(frozen=True)
class Estimated:
    """Estimated coefficients of a geometry.

    speed : m/s, at which friction and damping hold. viscosity : of the water, Pa s. angle : up to which lines are
    fitted, rad. origin : centre of buoyancy along the hull, m. munk : the model's own moments over V^2 and angle, in
    pitch and yaw, kg/rad. reynolds : of each part. warnings : what a user must know.
    """

    geometry: Geometry
    speed: float
    viscosity: float
    angle: float
    origin: float
    munk: tuple[float, float]
    reynolds: dict[str, float]
    coefficients: dict[str, Coefficient]
    warnings: list[str]

    def document(self) -> dict[str, Any]:
        """As JSON."""
        return {
            "origin": "estimated",
            "geometry": self.geometry.name,
            "description": self.geometry.description,
            "speed_m_s": self.speed,
            "viscosity_Pa_s": self.viscosity,
            "fitted_angle_deg": math.degrees(self.angle),
            "reference_density_kg_m3": self.geometry.density,
            "centre_of_buoyancy_m": self.origin,
            "model_munk_moment_kg_rad": {"pitch": self.munk[0], "yaw": self.munk[1]},
            "reynolds": self.reynolds,
            "coefficients": [
                {
                    "symbol": one.row.symbol, "name": one.row.name, "unit": one.row.unit,
                    **dataclasses.asdict(one.total),
                    "parts": {part: dataclasses.asdict(bounds) for part, bounds in one.parts.items()},
                    "method": one.row.method,
                }
                for one in self.coefficients.values()
            ],
            "warnings": self.warnings,
        }  # fmt: skip


def estimate(
    geometry: Geometry,
    speed: float = SPEED,
    viscosity: float = PAPER_VISCOSITY,
    angle: float = FITTED,
    added: AddedMass | None = None,
) -> Estimated:
    """Estimate the coefficients of eq. (20) from a shape.

    speed : m/s, at which they hold. viscosity : of the water, Pa s. angle : up to which they are fitted, rad.
    added : added mass of the vehicle that they are for; default: the geometry's own, corrected strips.

    Raises
    ------
    InputError
        A speed, viscosity or angle that no estimate can be made for.
    """
    for name, value, least, most, unit in (
        ("speed", speed, 1e-3, 20.0, "m/s"), ("viscosity", viscosity, 1e-4, 0.1, "Pa s"),
        ("angle", angle, 1e-9, math.radians(30.0), "rad"),
    ):  # fmt: skip
        if not least <= value <= most:
            raise InputError(name, f"{value:g} {unit} is not allowed; {least:g} to {most:g} are")
    water = added_mass(geometry)
    own = water.total()
    munk = (own.heave - own.surge, own.surge - own.sway) if added is None else munk_slopes(added)
    kinematic = viscosity / geometry.density
    parts = {name: _surface(item, geometry, water.origin, speed, kinematic) for name, item in geometry.surface.items()}
    found: dict[str, dict[str, Bounds]] = {row.symbol: {} for row in COEFFICIENTS}
    _add(found, "hull", _hull(geometry, water.origin, speed, kinematic, angle))
    for name, (_, terms) in parts.items():
        _add(found, name, terms)
    if geometry.drag_area:
        found["K_D0"][FURTHER] = exactly(geometry.density / 2.0 * geometry.drag_area)
    hull_munk = _hull_munk(geometry)
    for symbol, of_model, of_hull in (("K_M", munk[0], hull_munk), ("K_MY", munk[1], -hull_munk)):
        if abs(of_model - of_hull) > 1e-9 * abs(of_hull):
            found[symbol][MUNK] = exactly(of_hull - of_model)
    reynolds = {
        "hull": speed * geometry.hull.length_overall / kinematic,
        **{name: speed * item.chord / kinematic for name, (item, _) in parts.items()},
    }
    return Estimated(
        geometry, speed, viscosity, angle, water.origin, munk, reynolds,
        {row.symbol: Coefficient(row, found[row.symbol]) for row in COEFFICIENTS},
        _warnings(geometry, reynolds) + water.notes(),
    )  # fmt: skip


def _add(found: dict[str, dict[str, Bounds]], part: str, terms: dict[str, Bounds]) -> None:
    for symbol, bounds in terms.items():
        found[symbol][part] = bounds


def _hull_munk(geometry: Geometry) -> float:
    """The bare hull's own Munk moment in potential flow over V^2 and angle, kg/rad."""
    volume, _ = hull_volume(geometry.hull)
    length = geometry.hull.length_overall
    k = spheroid(length, (6.0 * volume / (math.pi * length)) ** 0.5)
    return (k.k2 - k.k1) * geometry.density * volume


def _hull(geometry: Geometry, origin: float, speed: float, kinematic: float, angle: float) -> dict[str, Bounds]:
    """What the hull gives, friction and forces across the flow; without its Munk moment."""
    hull, half = geometry.hull, geometry.density / 2.0
    skin = friction(speed * hull.length_overall / kinematic)
    drag = skin.times(half * wetted_area(hull) * hull_form(hull.thickest, hull.length_overall))
    across = crosswise(hull, hull_volume(hull)[0], origin, angle)
    # lift and side force stand across the flow, the friction along the axis has a share in them
    lift = across.normal.times(half) + drag.times(-1.0)
    moment, damping = across.moment.times(half), across.damping.times(-half / speed)
    return {
        "K_D0": drag, "K_D": across.drag.times(half), "K_beta": lift.times(-1.0), "K_alpha": lift, "K_M": moment,
        "K_q": damping, "K_MY": moment.times(-1.0), "K_r": damping,
    }  # fmt: skip


def _surface(
    surface: Surface, geometry: Geometry, origin: float, speed: float, kinematic: float
) -> tuple[Lifting, dict[str, Bounds]]:
    """A surface as a lifting one, and what it gives to the coefficients."""
    half = geometry.density / 2.0
    item = lifting(surface, geometry.hull)
    reynolds = speed * item.chord / kinematic
    drag = friction(reynolds).times(half * 2.0 * item.area * profile_form(surface.thickness))
    lift = item.lift.times(half)
    moment = lift.at(item.centre - origin, SHIFT * item.chord)
    damping = lift.times(-((item.middle - origin) ** 2) / speed)
    terms = {"K_D0": drag, "K_p": item.rolling.times(-half / speed)}
    if surface.plane == "horizontal":
        attached = lift.value**2 / (half * math.pi * item.span**2 * OSWALD)
        ends = sorted((attached, lift.value))
        value = lift.value if reynolds < ATTACHED_FROM else attached
        tilted, raised = lift.value * item.height * DIHEDRAL, lift.value * INCIDENCE
        turned = abs(moment.value) * INCIDENCE
        return item, {
            **terms, "K_D": Bounds(value, *ends), "K_alpha": lift, "K_M": moment, "K_q": damping,
            "K_MR": Bounds(0.0, -tilted, tilted), "K_L0": Bounds(0.0, -raised, raised),
            "K_M0": Bounds(0.0, -turned, turned),
        }  # fmt: skip
    up = {"both": 0.0, "upper": 1.0, "lower": -1.0}[surface.sides]
    terms |= {"K_beta": lift.times(-1.0), "K_MY": moment.times(-1.0), "K_r": damping}
    if up:
        terms |= {"K_MR": lift.times(-up * item.height), "K_M0": drag.times(up * item.height)}
    return item, terms


def _warnings(geometry: Geometry, reynolds: dict[str, float]) -> list[str]:
    """What the formulas do not cover of this shape."""
    found = [
        f"{part}: Reynolds number {value:.3g}, the friction lines are for {REYNOLDS[0]:g} to {REYNOLDS[1]:g}"
        for part, value in reynolds.items()
        if not REYNOLDS[0] <= value <= REYNOLDS[1]
    ]
    hull = geometry.hull
    if hull.length_overall < SLENDER * hull.thickest:
        found.append(
            f"the hull is {hull.length_overall / hull.thickest:.2g} times as long as thick; its formulas are for "
            f"slender hulls, {SLENDER:g} times and more"
        )
    planes = [item.plane for item in geometry.surface.values()]
    if not planes:
        found.append("no surfaces in the geometry: these are the coefficients of a bare hull, on which nothing glides")
    elif "horizontal" not in planes:
        found.append("no horizontal surface in the geometry: lift is that of the bare hull")
    if planes.count("horizontal") > 1:
        found.append("several horizontal surfaces: what the wash of one does to another is not counted")
    if not geometry.drag_area:
        found.append("drag_area is 0: masts, sensors and antennas are not in K_D0")
    return found
