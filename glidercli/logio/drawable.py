"""What can a viewer draw of a Log beside its samples? Hull and movable mass, the bottom."""

from __future__ import annotations

from glidercli.log import Log

__all__ = [
    "bottom", "drawn_eccentricity", "hull_size", "mass_notes", "moves_mass", "slide_zero",
]  # fmt: skip

STAND_IN = (2.0, 0.22)  # m, length and diameter of a usual glider


def hull_size(log: Log) -> tuple[float, float, bool]:
    """Length and diameter of the hull, m, and whether they are the vehicle's own (metadata) or only a stand-in."""
    length, diameter = log.number("hull_length_m"), log.number("hull_diameter_m")
    if length is None or diameter is None or not length > diameter > 0.0:
        return *STAND_IN, False
    return length, diameter, True


def drawn_eccentricity(diameter: float) -> float:
    """How far from the hull's axis the movable mass is drawn, m, so that its rotation is seen."""
    return 0.25 * diameter


def slide_zero(log: Log) -> float:
    """What is taken from a mass position so that it can be drawn in the body frame, m.

    Nothing where its zero is the model's; else the middle of the samples' range.
    """
    if _zero_known(log) or "mass_position" not in log or not len(log["mass_position"]):
        return 0.0
    values = log["mass_position"].values
    return float(0.5 * values.min() + 0.5 * values.max())


def moves_mass(log: Log) -> bool:
    """Whether the log has a sample of where the movable mass is."""
    return any(name in log and len(log[name]) for name in ("mass_position", "mass_rotation"))


def mass_notes(log: Log) -> list[str]:
    """What a viewer of the movable mass must know; nothing where the log does not move one."""
    if not moves_mass(log):
        return []
    true, drawn = log.number("movable_eccentricity_m"), drawn_eccentricity(hull_size(log)[1])
    told = f"exaggerated: {drawn:.3f} m for a true {true:g} m" if true is not None else "not to scale: it is unknown"
    notes = [f"the movable mass (red): its distance from the hull's axis is drawn {told}"]
    if "mass_position" in log and not _zero_known(log):
        notes.append("where its zero lies in the hull is unknown: it is drawn about the middle of its range")
    return notes


def _zero_known(log: Log) -> bool:
    return "mass_position_zero" not in log.metadata and log.number("movable_nominal_position_m") is not None


def bottom(log: Log) -> float | None:
    """Depth of the bottom, m, where the log tells it."""
    depth = log.number("bottom_depth_m")
    return depth if depth is not None and depth > 0.0 else None
