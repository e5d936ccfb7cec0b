"""What shape is the vehicle? A hull of revolution and flat surfaces on it, from a TOML file, checked whole.

Lengths along the hull are measured forward from any point, the same for all: the program finds the centre of buoyancy.
docs/coefficients.md shows a file.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field, model_validator
from pydantic.dataclasses import dataclass

from glidercli.coefficients.shape.planform import middle, overlap, root
from glidercli.files import read_toml
from glidercli.shipped import file_of
from glidercli.vehicle.checking import checked
from glidercli.vehicle.quantity import Quantity

__all__ = ["WHOLE", "Geometry", "HullShape", "Surface", "load_geometry", "shipped_geometries"]

Array = NDArray[np.float64]

_CONFIG = ConfigDict(extra="forbid")
_DATA = Path(__file__).parent / "geometries"

_LEAST_RADIUS = 1e-4  # m, of the thickest section
_LEAST_INSIDE = 1e-5  # m, between nose and tail
WHOLE = ("hull", "further", "Munk")
"""Names that stand for other parts than surfaces: see added_mass.py and estimate.py."""

Length = Annotated[float, Quantity("m", 0.01, 20.0)]
Along = Annotated[float, Quantity("m", -50.0, 50.0)]


@dataclass(frozen=True, config=_CONFIG)
class HullShape:
    """A body of revolution: a prolate ellipsoid (length, diameter) or an outline (stations, radii)."""

    length: Length | None = None
    diameter: Annotated[float, Quantity("m", 0.01, 5.0)] | None = None
    nose: Along | None = None
    """Where the ellipsoid begins; default: half its length, so that lengths count from its middle."""
    stations: Annotated[tuple[float, ...], Quantity("m", -50.0, 50.0, size=0)] | None = None
    """Of the outline, from nose to tail; between them it is straight."""
    radii: Annotated[tuple[float, ...], Quantity("m", 0.0, 5.0, size=0)] | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        ellipsoid = [self.length, self.diameter]
        outline = [self.stations, self.radii]
        if all(item is not None for item in ellipsoid) and all(item is None for item in outline):
            faults = self._ellipsoid_faults()
        elif all(item is not None for item in outline) and all(item is None for item in (*ellipsoid, self.nose)):
            faults = self._outline_faults()
        else:
            faults = ["hull: needed are length and diameter of an ellipsoid, or stations and radii of an outline"]
        if faults:
            raise ValueError("; ".join(faults))
        return self

    def _ellipsoid_faults(self) -> list[str]:
        length, diameter = self.length or 0.0, self.diameter or 0.0
        if length > diameter:
            return []
        return [f"hull.length = {length:g} m, allowed: more than its diameter, {diameter:g} m"]

    def _outline_faults(self) -> list[str]:
        x, r = np.array(self.stations), np.array(self.radii)
        if len(x) != len(r):
            return [f"hull has {len(x)} stations and {len(r)} radii; each station needs one radius"]
        if len(x) < 3:
            return [f"hull.stations: {len(x)} given, at least 3 are needed"]
        if turns := np.flatnonzero(np.diff(x) >= 0.0).tolist():
            at = turns[0] + 1
            return [
                f"hull.stations: station {at + 1} at {x[at]:g} m does not lie behind station {at} at {x[at - 1]:g} m: "
                "the outline crosses itself; allowed: from nose to tail, each behind the one before"
            ]
        if not r.max() >= _LEAST_RADIUS:
            return [f"hull has no volume: its largest radius is {r.max():g} m, allowed: {_LEAST_RADIUS:g} m or more"]
        if thin := np.flatnonzero(r[1:-1] < _LEAST_INSIDE).tolist():
            at = thin[0] + 1
            return [
                f"hull.radii: radius {at + 1} is {r[at]:g} m between nose and tail: the hull falls in two; allowed: "
                f"{_LEAST_INSIDE:g} m or more"
            ]
        if x[0] - x[-1] <= 2.0 * r.max():
            return [
                f"hull is {x[0] - x[-1]:g} m long and {2.0 * r.max():g} m thick; allowed: longer than thick, "
                "as strips of a slender hull need"
            ]
        return []

    @property
    def ends(self) -> tuple[float, float]:
        """Where nose and tail are, m."""
        if self.stations is not None:
            return self.stations[0], self.stations[-1]
        length = self.length or 0.0
        nose = length / 2.0 if self.nose is None else self.nose
        return nose, nose - length

    @property
    def length_overall(self) -> float:
        """From nose to tail, m."""
        return self.ends[0] - self.ends[1]

    @property
    def thickest(self) -> float:
        """Largest diameter, m."""
        return (self.diameter or 0.0) if self.radii is None else 2.0 * max(self.radii)

    @property
    def corners(self) -> Array:
        """Stations between which the square of the radius is a polynomial, from tail to nose, m."""
        return np.array(self.ends[::-1]) if self.stations is None else np.array(self.stations)[::-1]

    def radius(self, x: Array) -> Array:
        """Radius at stations, m; zero before the nose and behind the tail."""
        nose, tail = self.ends
        if self.stations is None:
            t = (2.0 * np.asarray(x) - nose - tail) / (nose - tail)
            return (self.diameter or 0.0) / 2.0 * np.sqrt(np.maximum(1.0 - t * t, 0.0))
        radii = np.array(self.radii)[::-1]
        return np.asarray(np.interp(x, self.corners, radii, left=0.0, right=0.0))


@dataclass(frozen=True, config=_CONFIG)
class Surface:
    """Wings or fins: a flat trapezoid in a plane through the hull's axis, on both sides of it or on one."""

    plane: Literal["horizontal", "vertical"]
    semi_span: Annotated[float, Quantity("m", 0.005, 10.0)]
    """Tip from the hull's axis."""
    root_chord: Annotated[float, Quantity("m", 0.005, 5.0)]
    tip_chord: Annotated[float, Quantity("m", 0.0, 5.0)]
    root_position: Along
    """Leading edge at the root."""
    tip_position: Along
    """Leading edge at the tip."""
    root_offset: Annotated[float, Quantity("m", 0.0, 10.0)] = 0.0
    """Root from the hull's axis: where root chord and position hold."""
    thickness: Annotated[float, Quantity("1", 0.0, 0.4)] = 0.1
    """Of the profile, share of the chord."""
    sides: Literal["both", "upper", "lower"] = "both"

    @model_validator(mode="after")
    def _check(self) -> Self:
        faults = []
        if self.root_offset >= self.semi_span:
            faults.append(f"root_offset = {self.root_offset:g} m, allowed: less than semi_span = {self.semi_span:g} m")
        if self.plane == "horizontal" and self.sides != "both":
            faults.append(f"sides = {self.sides!r}, allowed 'both' in the horizontal plane")
        if faults:
            raise ValueError("; ".join(faults))
        return self

    def chord(self, s: Array) -> Array:
        """Chord at distances from the axis, m; inside of the root the edges go on straight."""
        return self.root_chord + (self.tip_chord - self.root_chord) * self._share(s)

    def leading_edge(self, s: Array) -> Array:
        """Leading edge at distances from the axis, m, forward."""
        return self.root_position + (self.tip_position - self.root_position) * self._share(s)

    def _share(self, s: Array) -> Array:
        return (np.asarray(s) - self.root_offset) / (self.semi_span - self.root_offset)

    @property
    def panels(self) -> int:
        """How many sides carry a panel."""
        return 2 if self.sides == "both" else 1


@dataclass(frozen=True, config=_CONFIG)
class Geometry:
    """The outer shape of a glider."""

    name: str
    description: str
    reference: str
    hull: HullShape
    surface: Annotated[dict[str, Surface], Field(default_factory=dict)]
    """Wings, tail fins: by name."""
    centre_of_buoyancy: Along | None = None
    """Along the hull; default: the centre of the volume of hull and surfaces."""
    density: Annotated[float, Quantity("kg/m3", 900.0, 1200.0)] = 1025.0
    """Of the water that is accelerated."""
    drag_area: Annotated[float, Quantity("m2", 0.0, 1.0)] = 0.0
    """Drag over dynamic pressure of what is neither hull nor surface: masts, sensors, antennas."""

    @model_validator(mode="after")
    def _check(self) -> Self:
        faults = [
            f"surface.{name}: the name stands for another part; {', '.join(WHOLE)} are taken"
            for name in self.surface
            if name in WHOLE
        ]
        nose, tail = self.hull.ends
        if self.centre_of_buoyancy is not None and not tail <= self.centre_of_buoyancy <= nose:
            told = f"centre_of_buoyancy = {self.centre_of_buoyancy:g} m"
            faults.append(f"{told}, allowed: in the hull, {tail:g}..{nose:g} m")
        faults += [
            f"surface.{name} does not stick out of the hull: its tip is {item.semi_span:g} m from the axis, the hull's "
            f"radius there {float(self.hull.radius(middle(item, np.array([item.semi_span])))[0]):g} m"
            for name, item in self.surface.items()
            if root(item, self.hull) is None
        ]
        names = list(self.surface)
        faults += [
            f"surface.{one} and surface.{other} cross each other in the {self.surface[one].plane} plane"
            for i, one in enumerate(names)
            for other in names[i + 1 :]
            if overlap(self.surface[one], self.surface[other])
        ]
        if faults:
            raise ValueError("; ".join(faults))
        return self


def shipped_geometries() -> dict[str, Path]:
    """File of each shipped geometry, by name."""
    return {path.stem: path for path in sorted(_DATA.glob("*.toml"))}


def load_geometry(name_or_path: str | Path) -> tuple[Geometry, Path]:
    """The geometry of a shipped name or a TOML file, and the file.

    Raises InputError with every fault of the file at once.
    """
    path = file_of(name_or_path, shipped_geometries(), "geometry")
    return checked(Geometry, read_toml(path, "a geometry"), path), path
