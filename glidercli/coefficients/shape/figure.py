"""What does a geometry look like? From above and from the side, with its centre of buoyancy; its added mass by part."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from glidercli.coefficients.added.added_mass import MODEL, Estimate
from glidercli.coefficients.added.strips import Terms
from glidercli.coefficients.shape.geometry import Geometry, Surface
from glidercli.coefficients.shape.planform import root
from glidercli.pictures import COLOURS, WIDTH

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["draw_shape"]

_VIEW = 5.5  # inch, of the vehicle's length


def draw_shape(estimate: Estimate, beside: tuple[str, Terms] | None) -> Figure:
    """The figure. beside : name and terms of a vehicle."""
    from matplotlib.figure import Figure

    g = estimate.geometry
    x = [*g.hull.ends, *(item for s in g.surface.values() for item in _outlines(g, s)[0][0])]
    across = [
        max([g.hull.thickest / 2.0, *(s.semi_span for s in g.surface.values() if s.plane == plane)])
        for plane in ("horizontal", "vertical")
    ]
    scale = _VIEW / (max(x) - min(x))  # inch of paper for a metre, in both views
    heights = [2.3 * half * scale for half in across]
    figure = Figure(figsize=(WIDTH, sum(heights) + 4.0), layout="constrained")
    above, side, terms = figure.subplots(3, 1, height_ratios=(*heights, 2.2))
    figure.suptitle(f"{g.name}: ESTIMATED added mass, corrected strips", fontsize=9)
    for axes, plane, title in ((above, "horizontal", "from above"), (side, "vertical", "from starboard")):
        _view(axes, g, plane, title)
        axes.set_xlim(min(x) - 0.1 / scale, max(x) + 0.1 / scale)
        axes.plot([estimate.origin], [0.0], "+", color=COLOURS[0], markersize=8, label="centre of buoyancy")
    above.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    side.set_xlabel("along the hull, m, forward to the right")
    _bars(terms, estimate, beside)
    return figure


def _view(axes: Axes, g: Geometry, plane: str, title: str) -> None:
    """Hull and surfaces as they are seen; what stands on edge is a line."""
    nose, tail = g.hull.ends
    x = np.linspace(tail, nose, 401)
    radius = g.hull.radius(x)
    axes.fill_between(x, -radius, radius, color="#CCCCCC", edgecolor="#444444", linewidth=0.8)
    for number, (name, surface) in enumerate(g.surface.items()):
        colour = COLOURS[1 + number % 5]
        for outline in _outlines(g, surface) if surface.plane == plane else [_edge(g, surface)]:
            axes.fill(*outline, facecolor=colour, alpha=0.5, edgecolor=colour, linewidth=1.0)
        if surface.plane == plane:
            x, s = (np.array(item) for item in _outlines(g, surface)[0])
            axes.annotate(name, (x.mean(), s.mean()), ha="center", va="center", fontsize=6.5)
    axes.set_aspect("equal")
    axes.set_title(title, loc="left")
    axes.set_ylabel("m")


def _outlines(g: Geometry, surface: Surface) -> list[tuple[list[float], list[float]]]:
    """Corners of the panels outside of the hull; starboard and up are at the top of their view."""
    s = np.array([root(surface, g.hull) or 0.0, surface.semi_span])
    lead, trail = surface.leading_edge(s), surface.leading_edge(s) - surface.chord(s)
    x = [*lead.tolist(), *trail[::-1].tolist()]
    up = [*s.tolist(), *s[::-1].tolist()]
    signs = {"both": (1.0, -1.0), "upper": (1.0,), "lower": (-1.0,)}[surface.sides]
    return [(x, [sign * item for item in up]) for sign in signs]


def _edge(g: Geometry, surface: Surface) -> tuple[list[float], list[float]]:
    """A surface seen along its plane: from its foremost to its hindmost point, as thick as its profile."""
    x = _outlines(g, surface)[0][0]
    half = surface.thickness * surface.root_chord / 2.0
    return [min(x), max(x), max(x), min(x)], [-half, -half, half, half]


def _bars(axes: Axes, estimate: Estimate, beside: tuple[str, Terms] | None) -> None:
    """Each term's parts as shares of the vehicle's own term, else of its own sum."""
    whole = estimate.total() if beside is None else beside[1]
    scale = np.array([getattr(whole, row.name) or np.nan for row in MODEL])
    places = np.arange(len(MODEL))
    above, below = np.zeros(len(MODEL)), np.zeros(len(MODEL))
    for number, (part, terms) in enumerate(estimate.corrected.items()):
        share = np.nan_to_num(np.array([getattr(terms, row.name) for row in MODEL]) / scale)
        foot = np.where(share >= 0.0, above, below)
        colour = "#999999" if part == "hull" else COLOURS[1 + (number - 1) % 5]
        axes.bar(places, share, 0.6, bottom=foot, color=colour, label=part)
        above, below = above + np.maximum(share, 0.0), below + np.minimum(share, 0.0)
    axes.axhline(1.0, color=COLOURS[0], linewidth=1.0, label="their sum" if beside is None else beside[0])
    axes.axhline(0.0, color="#444444", linewidth=0.6)
    low, high = min(0.0, below.min()), max(1.0, above.max())
    axes.set_ylim(low - 0.05 * (high - low) * (low < 0.0), high + 0.05 * (high - low))
    axes.set_xticks(places, [row.symbol for row in MODEL])
    axes.set_ylabel("share of the sum" if beside is None else f"share of {beside[0]}'s term")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
