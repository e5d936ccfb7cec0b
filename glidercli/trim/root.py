"""Method root: every trim with three pinned quantities, from the model's six equations alone."""

from __future__ import annotations

from glidercli.errors import NoSolutionError
from glidercli.kernel import warmed
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.trim.atlas import atlas, chart
from glidercli.trim.forward import CONTROLS, from_controls
from glidercli.trim.pins import QUANTITIES, Question
from glidercli.trim.search import search
from glidercli.trim.steady import Unknowns
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["NEAREST", "solutions"]

NEAREST = 12
"""Trims of the atlas that a single question follows besides. Of 100 random flights, each asked for by all 120 sets of
three pins, that leaves 8 of 12,000 unfound."""


def solutions(
    asked: Question, craft: Vehicle, printed: bool, water: Water, p: Parameters
) -> list[tuple[Unknowns, int]]:
    """Every trim found, each with its Newton iterations.

    printed : whether a turning radius is that of eq. (33). Raises NoSolutionError where there is none, with the nearest
    point and the equation that fails there.
    """
    if asked.pins == CONTROLS:
        rrx, gamma, mb = asked.values
        nominal = craft.actuators.mass_position.nominal
        found, iterations, count, _ = warmed(from_controls)(rrx, gamma, mb, nominal, water, p)
    else:
        seen = chart(atlas(craft.actuators, printed, water, p), asked.pins)
        found, iterations, count = search(asked.values, asked.pins, seen, NEAREST, True, printed, water, p)
    if not count:
        from glidercli.trim.nearest import nearest_miss

        seen = chart(atlas(craft.actuators, printed, water, p), asked.pins)
        why = nearest_miss(asked, seen, printed, water, p)
        raise NoSolutionError(f"no steady flight found with {told(asked)}: {why}{_usual_reason(asked, craft)}")
    return [(tuple(x), int(n)) for x, n in zip(found[:count].tolist(), iterations[:count], strict=True)]


def told(asked: Question) -> str:
    """The pins and their values, for people."""
    parts = []
    for name, pin, value in zip(asked.names, asked.pins, asked.values, strict=True):
        q = QUANTITIES[name]
        if pin != q.place:
            parts.append("a straight glide")
        else:
            shown = 1.0 / value if name == "turning_radius" else value / q.factor
            parts.append(f"{name.replace('_', ' ')} {shown:g} {q.unit}")
    return ", ".join(parts)


def _usual_reason(asked: Question, craft: Vehicle) -> str:
    """The usual reason: the mass lies on the wrong side of the position that holds the hull level."""
    given = dict(zip(asked.names, asked.values, strict=True))
    level = craft.actuators.mass_position.nominal
    if "net_buoyancy" not in given or "mass_position" not in given:
        return ""
    if (given["mass_position"] - level) * given["net_buoyancy"] >= 0.0:
        return ""
    way, needed = ("sinking", "forward") if given["net_buoyancy"] > 0.0 else ("rising", "aft")
    return f"; a {way} glider needs the mass {needed} of {level:g} m, where it holds the hull level"
