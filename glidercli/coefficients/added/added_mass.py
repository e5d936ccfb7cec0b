"""What water does a vehicle drag along? Each part's added mass and the whole's, about the centre of buoyancy.

Two answers side by side. ``strips``: hull and surfaces by strips alone, as section 2.5 of the paper does; surge is
Lamb's, since strips have none. ``corrected``: the hull's times what they are off by for the spheroid of its length and
volume, whose own are exact then; the surfaces with the flow around their tips and the hull's own flow across.
"""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from glidercli.coefficients.added.spheroid import spheroid
from glidercli.coefficients.added.strips import Terms, hull_strips, surface_strips
from glidercli.coefficients.shape.geometry import Geometry, HullShape
from glidercli.coefficients.shape.planform import middle, root
from glidercli.keeping import Kept

if TYPE_CHECKING:
    from glidercli.coefficients.added.rest import Rest
    from glidercli.coefficients.base import Base
    from glidercli.vehicle.writing import Number

__all__ = ["MODEL", "Estimate", "Row", "added_mass", "answer", "hull_volume", "terms_of"]

_PROFILE = 0.685
"""Area of a profile over chord times thickness: NACA four-digit sections."""


class Row(NamedTuple):
    """A term as it is told: its symbol in the paper, its unit and its name in ``Terms``."""

    symbol: str
    unit: str
    name: str


MODEL = (
    Row("X_u'", "kg", "surge"), Row("Y_v'", "kg", "sway"), Row("Z_w'", "kg", "heave"), Row("K_p'", "kg m2", "roll"),
    Row("M_q'", "kg m2", "pitch"), Row("N_r'", "kg m2", "yaw"), Row("N_v' = Y_r'", "kg m", "yaw_from_sway"),
    Row("M_w' = Z_q'", "kg m", "pitch_from_heave"),
)  # fmt: skip
"""The eight terms of the model: eq. (14), Table 3."""


@dataclasses.dataclass(frozen=True)
class Estimate:
    """Added mass of a geometry.

    origin : the centre of buoyancy along the hull, in the lengths of the geometry, m. volume : of hull and surfaces,
    m3. strips, corrected : terms of each part, "hull" first, then the surfaces by name.
    """

    geometry: Geometry
    origin: float
    volume: float
    strips: dict[str, Terms]
    corrected: dict[str, Terms]

    def total(self, corrected: bool = True) -> Terms:
        """The whole vehicle's."""
        parts = self.corrected if corrected else self.strips
        return sum(parts.values(), Terms())

    def numbers(self, corrected: bool, source: str) -> dict[str, dict[str, Number]]:
        """Tables of a vehicle file: its hull's dimensions and its added mass. source : the geometry."""
        from glidercli.vehicle.writing import Number

        t = self.total(corrected)
        hull = self.geometry.hull
        how = f"estimated from {source} by {'corrected strips' if corrected else 'strips'}"
        return {
            "hull": {"length": Number(hull.length_overall, source), "diameter": Number(hull.thickest, source)},
            "added_mass": {
                "mass": Number((t.surge, t.sway, t.heave), how, "M_A"),
                "inertia": Number((t.roll, t.pitch, t.yaw), how, "I_A"),
                "yaw_from_sway": Number(t.yaw_from_sway, how, "N_v' = Y_r'"),
                "pitch_from_heave": Number(t.pitch_from_heave, how, "M_w' = Z_q'"),
            },
        }

    def notes(self) -> list[str]:
        """What a reader must know of this geometry."""
        hull, found = self.geometry.hull, []
        nose, tail = hull.ends
        for name, surface in self.geometry.surface.items():
            inner = root(surface, hull) or 0.0
            at = float(middle(surface, np.array([inner]))[0])
            if not tail <= at <= nose:
                where = "ahead of the nose" if at > nose else "behind the hull's tail"
                found.append(f"surface {name} stands {where}, on something that is not in the geometry")
            elif surface.root_offset > float(hull.radius(np.array([at]))[0]) + 0.005:
                found.append(f"surface {name} begins {surface.root_offset:g} m from the axis, off the hull")
        left = self.total()
        if left.roll_from_sway or left.roll_from_yaw:
            found.append(
                f"fins on one side couple roll to sway (M(v,p) = {left.roll_from_sway:.3g} kg m) and to yaw (M(p,r) = "
                f"{left.roll_from_yaw:.3g} kg m2), for which the model has no place"
            )
        return found

    def document(self) -> dict[str, Any]:
        """As JSON."""
        return {
            "origin": "estimated",
            "geometry": self.geometry.name,
            "centre_of_buoyancy_m": self.origin,
            "volume_m3": self.volume,
            "displaced_mass_kg": self.volume * self.geometry.density,
            "density_kg_m3": self.geometry.density,
            "terms": [
                {
                    "symbol": row.symbol, "name": row.name, "unit": row.unit,
                    "strips": getattr(self.total(False), row.name), "corrected": getattr(self.total(), row.name),
                    "parts": {
                        part: {
                            "strips": getattr(self.strips[part], row.name),
                            "corrected": getattr(self.corrected[part], row.name),
                        }
                        for part in self.strips
                    },
                }
                for row in MODEL
            ],
            "without_place_in_the_model": {
                "roll_from_sway_kg_m": self.total().roll_from_sway, "roll_from_yaw_kg_m2": self.total().roll_from_yaw,
            },
            "notes": self.notes(),
        }  # fmt: skip


def added_mass(geometry: Geometry) -> Estimate:
    """Added mass of a geometry in its water, about its centre of buoyancy, by strips and by corrected strips."""
    shape = geometry.hull
    volumes = {"hull": hull_volume(shape), **{name: _surface_volume(geometry, name) for name in geometry.surface}}
    volume = sum(item[0] for item in volumes.values())
    centre = round(sum(item[0] * item[1] for item in volumes.values()) / volume, 12)  # less is rounding
    origin = centre if geometry.centre_of_buoyancy is None else geometry.centre_of_buoyancy
    bare = hull_strips(shape, origin, geometry.density)
    exact = _exact(shape, bare, volumes["hull"], origin, geometry.density)
    surfaces = {
        corrected: {name: surface_strips(item, geometry, origin, corrected) for name, item in geometry.surface.items()}
        for corrected in (False, True)
    }
    bare, exact = (hull.tidied(volume * geometry.density, shape.length_overall) for hull in (bare, exact))
    return Estimate(
        geometry, origin, volume, {"hull": dataclasses.replace(bare, surge=exact.surge), **surfaces[False]},
        {"hull": exact, **surfaces[True]},
    )  # fmt: skip


def terms_of(base: Base) -> tuple[str, Terms] | None:
    """Name and added mass of a vehicle in the same terms; None of one that has none yet."""
    if (added := base.added_mass) is None:
        return None
    return base.name, Terms(*added.mass, *added.inertia, added.yaw_from_sway, added.pitch_from_heave)


def answer(found: Estimate, beside: tuple[str, Terms] | None, left: Rest | None, vehicle: str) -> Kept:
    """The estimate ready to be kept. vehicle : text of a vehicle file, or ""."""
    from glidercli.coefficients.shape.figure import draw_shape

    rows: dict[str, list[Any]] = {"symbol": [row.symbol for row in MODEL], "unit": [row.unit for row in MODEL]}
    for column, which in (("strips", False), ("corrected", True)):
        rows[column] = [getattr(found.total(which), row.name) for row in MODEL]
        for part in found.strips:
            terms = (found.corrected if which else found.strips)[part]
            rows[f"{part}_{column}"] = [getattr(terms, row.name) for row in MODEL]
    document = found.document()
    if beside is not None:
        rows["vehicle"] = [getattr(beside[1], row.name) for row in MODEL]
        for term, value in zip(document["terms"], rows["vehicle"], strict=True):
            term["vehicle"] = value
        document["vehicle"] = beside[0]
        document["left_for_surfaces"] = None if left is None else left.document()
    return Kept(rows, document, lambda: draw_shape(found, beside), vehicle)


def _exact(hull: HullShape, bare: Terms, volume: tuple[float, float], origin: float, density: float) -> Terms:
    """The hull's strips brought to the exact values of the spheroid of its length and volume: its own, for one."""
    length = hull.length_overall
    diameter = (6.0 * volume[0] / (np.pi * length)) ** 0.5
    k = spheroid(length, diameter)
    arm = volume[1] - origin
    mass = k.k2 * bare.sway
    about_centre = bare.yaw - bare.sway * arm * arm
    turning = about_centre * k.k_turn * (1.0 + (diameter / length) ** 2) + mass * arm * arm
    return Terms(
        surge=k.k1 * density * volume[0], sway=mass, heave=mass, pitch=turning, yaw=turning, yaw_from_sway=mass * arm,
        pitch_from_heave=-mass * arm,
    )  # fmt: skip


def hull_volume(hull: HullShape) -> tuple[float, float]:
    """Volume, m3, and its centre along the hull, m."""
    strips = hull_strips(hull, 0.0, 1.0)
    return strips.sway, strips.yaw_from_sway / strips.sway


def _surface_volume(geometry: Geometry, name: str) -> tuple[float, float]:
    """Volume of a surface outside of the hull, m3, and its centre along the hull, m."""
    surface = geometry.surface[name]
    s = np.linspace(root(surface, geometry.hull) or 0.0, surface.semi_span, 201)
    area = _PROFILE * surface.thickness * surface.chord(s) ** 2
    volume = float(np.trapezoid(area, s)) * surface.panels
    if not volume > 0.0:
        return 0.0, 0.0
    return volume, float(np.trapezoid(area * middle(surface, s), s)) * surface.panels / volume
