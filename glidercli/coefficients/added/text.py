"""How is added mass told on a terminal? Parts and whole, a vehicle's beside it, and what would account for the rest."""

from __future__ import annotations

from glidercli.aligned import table
from glidercli.coefficients.added.added_mass import MODEL, Estimate
from glidercli.coefficients.added.rest import Rest
from glidercli.coefficients.added.strips import Terms

__all__ = ["text"]


def text(estimate: Estimate, beside: tuple[str, Terms] | None, left: Rest | None) -> str:
    """The estimate for people.

    beside : name and terms of a vehicle. left : what its terms leave beyond the geometry's hull.
    """
    g = estimate.geometry
    lines = [
        f"ESTIMATED by strip theory: {g.name}, {g.description}",
        f"hull {g.hull.length_overall:.3f} m x {g.hull.thickest:.3f} m; with surfaces {1e3 * estimate.volume:.2f} dm3 "
        f"({estimate.volume * g.density:.2f} kg), centre of buoyancy at {estimate.origin:z.4f} m",
        "",
    ]
    name = [] if beside is None else [beside[0], "corrected/it"]
    rows = [["", "", "strips", "corrected", *name]]
    for row in MODEL:
        strips, corrected = (getattr(estimate.total(which), row.name) for which in (False, True))
        cells = [row.symbol, row.unit, f"{strips:z.3f}", f"{corrected:z.3f}"]
        if beside is not None:
            other = getattr(beside[1], row.name)
            cells += [f"{other:z.3f}", f"{corrected / other:z.3f}" if other else ""]
        rows.append(cells)
    lines += table(rows[0], rows[1:], 2)
    if g.surface:
        parts = list(estimate.corrected)
        rows = [["corrected, by part", "", *parts]]
        rows += [
            [row.symbol, row.unit, *(f"{getattr(estimate.corrected[part], row.name):z.3f}" for part in parts)]
            for row in MODEL
        ]
        lines += ["", *table(rows[0], rows[1:], 2)]
    if beside is not None and left is not None:
        lines += ["", *_left(beside[0], left)]
    return "\n".join(lines)


def _left(name: str, left: Rest) -> list[str]:
    """What surfaces would account for what the hull leaves of a vehicle's terms."""
    lines = [f"What the hull alone leaves of {name}'s terms for surfaces:"]
    for what, plane in (("wings", left.wings), ("vertical fins", left.tail)):
        if not plane.mass > 0.0:
            lines.append(f"  {what}: none; {plane.faults[0]}.")
            continue
        lines.append(f"  {what}: {plane.mass:.3f} kg, {plane.distance:.3f} m from the centre of buoyancy.")
        lines += [f"    Impossible: {fault}." for fault in plane.faults]
    if left.wing_reach is not None:
        lines.append(f"  wings of that mass reach {left.wing_reach:.3f} m from the axis, by what is left of K_p'.")
    lines += [f"  {told}." for told in left.signs]
    fit = left.accounted
    if fit is None:
        lines.append(f"No hull with wings and fins gives all of {name}'s terms but surge and roll.")
    else:
        lines += [
            "All but surge and roll come out, by strips, of",
            f"  a hull of {fit.hull_mass:.2f} kg and {fit.hull_inertia:.2f} kg m2: an ellipsoid of "
            f"{fit.hull_length:.2f} m x {fit.hull_diameter:.3f} m,",
            f"  wings of {fit.wing_mass:.2f} kg {fit.wing_distance:.3f} m from the centre of buoyancy,",
            f"  vertical fins of {fit.tail_mass:.2f} kg {fit.tail_distance:.3f} m from it.",
        ]
    return lines
