"""What does each part of a vehicle add, strip by strip? Hull, wings, fins about the centre of buoyancy (section 2.5).

A strip of two-dimensional added mass a, at x forward and s from the axis, has the kinetic energy a/2 times the square
of its velocity across, w + p y - q x in heave and v + r x - p z in sway. Summed up (the kinetic-energy form of eq. 14):

    M(v,v) = sum a    M(v,r) = sum a x     M(r,r) = sum a x^2     M(v,p) = -sum a z    M(p,p) = sum a s^2
    M(w,w) = sum a    M(w,q) = -sum a x    M(q,q) = sum a x^2     M(p,r) = -sum a x z

Surfaces are cut into strips across their longer side: a wing into chords, a = rho pi c^2/4 and rho pi c^4/128 of
turning about its middle (Lamb 1932, art. 71); a long low fin into sections of hull and fin (section.py).
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from glidercli.coefficients.added.section import section
from glidercli.coefficients.shape.geometry import Geometry, HullShape, Surface
from glidercli.coefficients.shape.planform import middle, root

__all__ = ["Terms", "end_factor", "hull_strips", "surface_strips"]

Array = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)
_SHORT = (0.0, 0.100, 0.125, 0.160, 0.200, 0.250, 1 / 3, 0.400, 0.500, 1 / 1.5, 0.800, 1.0)
_SHARE = (1.0, 0.947, 0.934, 0.917, 0.897, 0.872, 0.830, 0.801, 0.757, 0.690, 0.642, 0.579)
"""Added mass of a rectangular plate over that of its strips, by its shorter over its longer side: DNV-RP-H103 (2011),
table A-2. A doublet lattice gives the same within 1 % (tests/unit/coefficients/test_strips.py)."""


@dataclasses.dataclass(frozen=True)
class Terms:
    """Added mass of a part or a whole, kg, kg m and kg m2, body axes about the centre of buoyancy."""

    surge: float = 0.0
    """M(u,u) = X_u'."""
    sway: float = 0.0
    """M(v,v) = Y_v'."""
    heave: float = 0.0
    """M(w,w) = Z_w'."""
    roll: float = 0.0
    """M(p,p) = K_p'."""
    pitch: float = 0.0
    """M(q,q) = M_q'."""
    yaw: float = 0.0
    """M(r,r) = N_r'."""
    yaw_from_sway: float = 0.0
    """M(v,r) = N_v' = Y_r'."""
    pitch_from_heave: float = 0.0
    """M(w,q) = M_w' = Z_q'."""
    roll_from_sway: float = 0.0
    """M(v,p): of fins on one side; the model has no place for it."""
    roll_from_yaw: float = 0.0
    """M(p,r): likewise."""

    def tidied(self, mass: float, length: float) -> Terms:
        """Zero where a term is rounding alone. mass, length : of the vehicle, kg and m."""
        least = 1e-12 * mass * max(length, length * length)
        return Terms(*(value if abs(value) > least else 0.0 for value in dataclasses.astuple(self)))

    def __add__(self, other: Terms) -> Terms:
        """The sum, term by term."""
        return Terms(*(a + b for a, b in zip(dataclasses.astuple(self), dataclasses.astuple(other), strict=True)))


def end_factor(length: float, width: float) -> float:
    """What flow around the ends leaves of the strips of a rectangular plate, see ``_SHARE``; sides in m."""
    return float(np.interp(min(length, width) / max(length, width), _SHORT, _SHARE))


def hull_strips(hull: HullShape, origin: float, density: float) -> Terms:
    """The hull by strips of rho pi r^2; along its axis strips tell nothing, and surge is left zero.

    origin : centre of buoyancy along the hull, m. density : kg/m3.
    """
    x, weight = _between(hull.corners)
    a = density * np.pi * hull.radius(x) ** 2 * weight
    x = x - origin
    mass, first, second = float(a.sum()), float((a * x).sum()), float((a * x * x).sum())
    return Terms(
        sway=mass, heave=mass, pitch=second, yaw=second, yaw_from_sway=first, pitch_from_heave=-first
    )  # fmt: skip


def surface_strips(surface: Surface, geometry: Geometry, origin: float, corrected: bool) -> Terms:
    """What a surface adds to the hull.

    origin : centre of buoyancy along the hull, m. corrected : with the flow around the tips (``end_factor``), with the
    hull's own flow across, which meets strips of chord at (1 + a^2/s^2) times the vehicle's speed and counts twice,
    since the strip pushes the hull in turn, and with surge, rho pi t^2/4 of a profile t thick; else the bare strips.
    """
    inner = root(surface, geometry.hull) or 0.0
    panel = surface.semi_span - inner
    mean = float(surface.chord(np.array([(inner + surface.semi_span) / 2.0]))[0])
    in_chords = 2.0 * panel >= mean  # the hull stands beside a panel as a wall: the panel and its image
    terms = _chords(surface, geometry, inner, origin, corrected) if in_chords else _sections(surface, geometry, origin)
    if not corrected:
        return terms
    share = end_factor(2.0 * panel, mean)
    alone = end_factor(panel, mean) * min(1.0, panel / mean) if in_chords else share  # rolling panels part from another
    shares = {"surge": 1.0, "roll": alone}
    return Terms(*(value * shares.get(name, share) for name, value in dataclasses.asdict(terms).items()))


def _chords(surface: Surface, geometry: Geometry, inner: float, origin: float, corrected: bool) -> Terms:
    """Strips along the flow, each a chord: for wings."""
    s, ds = _between(np.array([inner, surface.semi_span]))
    chord, x = surface.chord(s), middle(surface, s)
    slope = math.atan2(float(x[0] - x[-1]), float(s[-1] - s[0]))  # a swept strip is narrower across: c cos, ds / cos
    a = geometry.density * np.pi / 4.0 * chord**2 * math.cos(slope) * ds
    turning = geometry.density * np.pi / 128.0 * chord**4 * ds
    hull = geometry.hull.radius(x)
    met = 1.0 + (hull / s) ** 2 if corrected else np.ones_like(s)
    x = x - origin
    thick = surface.thickness * chord
    surge = float((geometry.density * np.pi / 4.0 * thick**2 * ds).sum()) * surface.panels if corrected else 0.0
    return _summed(surface, a, x, s, met, turning, surge)


def _summed(surface: Surface, a: Array, x: Array, s: Array, met: Array, turning: Array, surge: float) -> Terms:
    """The sums over strips of a panel, for all its panels."""
    n = surface.panels
    mass, first = n * float((a * met**2).sum()), n * float((a * met**2 * x).sum())
    second = n * float((a * met**2 * x * x + turning).sum())
    roll = n * float((a * s * s).sum())
    if surface.plane == "horizontal":
        return Terms(surge=surge, heave=mass, roll=roll, pitch=second, pitch_from_heave=-first)
    up = {"both": 0.0, "upper": 1.0, "lower": -1.0}[surface.sides]
    return Terms(
        surge=surge, sway=mass, roll=roll, yaw=second, yaw_from_sway=first,
        roll_from_sway=up * float((a * met * s).sum()), roll_from_yaw=up * float((a * met * s * x).sum()),
    )  # fmt: skip


def _sections(surface: Surface, geometry: Geometry, origin: float) -> Terms:
    """Strips across the flow, each a section of hull and fin: for fins longer than high."""
    edges = np.array([surface.root_offset, surface.semi_span])
    lead, trail = surface.leading_edge(edges), surface.leading_edge(edges) - surface.chord(edges)
    x, dx = _between(np.unique(np.concatenate([lead, trail])))
    tip = _outermost(surface, x)
    a = geometry.hull.radius(x)
    other = tip if surface.sides == "both" else a
    with_fin = section(a, tip, other)
    weight = geometry.density * dx
    mass = weight * (with_fin.across - np.pi * a * a)
    x = x - origin
    second, first = float((mass * x * x).sum()), float((mass * x).sum())
    roll = float((weight * with_fin.turning).sum())
    if surface.plane == "horizontal":
        return Terms(heave=float(mass.sum()), roll=roll, pitch=second, pitch_from_heave=-first)
    coupling = weight * with_fin.coupling * {"both": 0.0, "upper": 1.0, "lower": -1.0}[surface.sides]
    return Terms(
        sway=float(mass.sum()), roll=roll, yaw=second, yaw_from_sway=first,
        roll_from_sway=float(coupling.sum()), roll_from_yaw=float((coupling * x).sum()),
    )  # fmt: skip


def _outermost(surface: Surface, x: Array) -> Array:
    """How far out from the axis a surface reaches at stations, m."""
    s = np.linspace(surface.root_offset, surface.semi_span, 513)
    lead, chord = surface.leading_edge(s), surface.chord(s)
    covered = (x[:, None] <= lead) & (x[:, None] >= lead - chord)
    return np.asarray(np.where(covered, s, 0.0).max(axis=1))


def _between(corners: Array) -> tuple[Array, Array]:
    """Points and weights of Gauss and Legendre between corners that increase."""
    half, centre = np.diff(corners) / 2.0, (corners[1:] + corners[:-1]) / 2.0
    return (centre[:, None] + half[:, None] * _NODES).ravel(), (half[:, None] * _WEIGHTS).ravel()
