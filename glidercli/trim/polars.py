"""How far, how fast and how cheaply does a vehicle glide? Its polar, and the best points on it.

Every straight glide follows from its angle of attack and net buoyancy in closed form (straight.py). The work of the
pump, m_b g times the depth gained, is the work of drag; hotel power runs besides; against a current only the difference
of speeds is made good.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError, NoSolutionError
from glidercli.kernel import runner
from glidercli.model.parameters import Parameters, symmetric
from glidercli.ocean.water import Water
from glidercli.trim.output import rows_of
from glidercli.trim.pins import allowed
from glidercli.trim.steady import Array
from glidercli.trim.straight import glides
from glidercli.trim.table import columns, why_no_glide, within_limits
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["BEST", "Best", "Journey", "Polar", "polar"]

SHARES = (0.2, 0.4, 0.6, 0.8, 1.0)
"""Of the largest net buoyancy to either side: the curves of a polar without a net buoyancy of its own."""
POINTS = 121
"""Points of a curve, denser toward the small angles of attack of steep glides."""
BEST = -1
"""Number of no curve: that of the best points."""
_FINE = 200  # net buoyancies, and a tenth of the angles, of the search; energy is flat about its optimum


class Journey(NamedTuple):
    """What a glide has to do besides. current : m/s, against the vehicle. hotel_power : W. pump_efficiency : 0 to 1."""

    current: float = 0.0
    hotel_power: float = 0.0
    pump_efficiency: float = 1.0


class Best(NamedTuple):
    """The best glides of one way, down or up, within the vehicle's limits, as row numbers of the polar's table."""

    best_glide: int | None
    """Least glide angle, the greatest lift to drag; at the greatest net buoyancy, which it hardly depends on."""
    fastest: int | None
    """Greatest horizontal speed."""
    least_energy: int | None
    """Least energy per kilometre made good."""
    holds_station: int | None
    """Least power that is not carried back by the current; None without a current."""
    why_none: str
    """Why there is no least energy, or no holding station; empty where there is."""


class Polar(NamedTuple):
    """table : the columns of ``Trim.document``, then made_good_m_s, power_w and energy_per_km_j; a row each glide.
    curve (n,) : the curve of each row, BEST for the best points that stand after the curves. best : by "dive", "climb".
    """

    table: dict[str, NDArray[Any]]
    curve: NDArray[np.int64]
    best: dict[str, Best]
    warnings: list[str]

    def document(self) -> dict[str, Any]:
        """The best points in the contract's names: a way each, a trim or None each."""
        rows = rows_of(self.table)
        return {
            way: {
                "best_glide": None if best.best_glide is None else rows[best.best_glide],
                "fastest": None if best.fastest is None else rows[best.fastest],
                "least_energy": None if best.least_energy is None else rows[best.least_energy],
                "holds_station": None if best.holds_station is None else rows[best.holds_station],
                "why_none": best.why_none,
            }
            for way, best in self.best.items()
        }


def polar(
    craft: Vehicle, net_buoyancy: float | None, journey: Journey, equations: str, water: Water, p: Parameters
) -> Polar:
    """The polar at one net buoyancy, kg, or at SHARES of the largest to either side, with the best points.

    Without a net buoyancy the best points are sought over all that the vehicle has.

    Raises
    ------
    InputError
        A net buoyancy that no vehicle can have, an impossible journey, a vehicle with a heavier side or without a net
        buoyancy of its own.
    NoSolutionError
        A vehicle that does not glide.
    """
    _check(journey, craft, p)
    limit = craft.actuators.net_buoyancy
    if net_buoyancy is not None:
        allowed("net_buoyancy", net_buoyancy, craft)
        curves = [net_buoyancy]
        ways = {"dive" if net_buoyancy > 0.0 else "climb": np.array([net_buoyancy])}
    else:
        extremes = {"dive": limit.maximum, "climb": limit.minimum}
        curves = [one * share for one in extremes.values() if one for share in SHARES]
        ways = {way: one * np.arange(1, _FINE + 1) / _FINE for way, one in extremes.items() if one}
    if not curves:
        raise InputError(craft.name, "has no net buoyancy of its own; one must be given, in kg")
    parts = [_glides(np.array([mb]), POINTS, craft, water, p) for mb in curves]
    if not any(map(len, parts)):
        raise NoSolutionError(f"{craft.name} has no straight glide within the fitted angles of attack")
    numbers = [np.full(len(part), number) for number, part in enumerate(parts)]
    best, used = {}, sum(map(len, parts))
    for way, buoyancies in ways.items():
        chosen, why = _best(_glides(buoyancies, 10 * _FINE, craft, water, p), journey, craft, water)
        kept = [x for x in chosen if x is not None]
        places = iter(range(used, used + len(kept)))
        glide, fastest, cheapest, station = (None if x is None else next(places) for x in chosen)
        best[way] = Best(glide, fastest, cheapest, station, why)
        used += len(kept)
        parts.append(np.array(kept).reshape(-1, 9))
        numbers.append(np.full(len(kept), BEST))
    x = np.concatenate(parts)
    table = columns(x, np.zeros(len(x), np.int64), craft, water, p, runner(len(x)), equations=equations)
    table["made_good_m_s"], table["power_w"], table["energy_per_km_j"] = _cost(x, journey, water)
    warnings = [f"{way}: {one.why_none}" for way, one in best.items() if one.why_none and journey.current > 0.0]
    return Polar(table, np.concatenate(numbers), best, warnings)


def _check(journey: Journey, craft: Vehicle, p: Parameters) -> None:
    """Refuse journeys that cannot be and vehicles whose straight glides are not symmetric."""
    if not symmetric(p):
        raise InputError(craft.name, "has its mass or its buoyancy to one side; a polar is for vehicles alike to both")
    for name, value, most, unit in (("current", abs(journey.current), 10.0, "m/s"), (
        "hotel power", journey.hotel_power, 1e4, "W")):  # fmt: skip
        if not 0.0 <= value <= most:
            raise InputError(name, f"{value:g} {unit} is not allowed; 0 to {most:g} {unit} are")
    if not 0.0 < journey.pump_efficiency <= 1.0:
        raise InputError("pump efficiency", f"{journey.pump_efficiency:g} is not allowed; above 0 and up to 1 are")


def _glides(buoyancies: Array, count: int, craft: Vehicle, water: Water, p: Parameters) -> Array:
    """Straight glides (n, 9) of net buoyancies of one sign, over the fitted angles of attack, ``count`` of these."""
    fitted = craft.hydrodynamics.fitted_angle
    alpha = fitted * np.linspace(0.0, 1.0, count) ** 2 * np.sign(buoyancies[0] * p.Kalpha)
    mb, alpha = (grid.ravel() for grid in np.meshgrid(buoyancies, alpha, indexing="ij"))
    x = glides(alpha, mb, water, p)
    x = x[np.isfinite(x[:, 0])]
    flies = why_no_glide(x, x[:, 0] * np.cos(x[:, 5] - x[:, 1]), craft) == ""
    return np.asarray(x[flies])


def _cost(x: Array, journey: Journey, water: Water) -> tuple[Array, Array, Array]:
    """Speed made good, m/s, power, W, and energy per kilometre made good, J, infinite where nothing is made good.

    Power is m_b g w / efficiency + hotel power, w the vertical speed.
    """
    path = x[:, 5] - x[:, 1]
    made_good = x[:, 0] * np.cos(path) - journey.current
    power = -x[:, 8] * water.gravity * x[:, 0] * np.sin(path) / journey.pump_efficiency + journey.hotel_power
    with np.errstate(divide="ignore"):
        return made_good, power, np.where(made_good > 0.0, 1000.0 * power / np.maximum(made_good, 0.0), np.inf)


def _best(x: Array, journey: Journey, craft: Vehicle, water: Water) -> tuple[list[Array | None], str]:
    """What ``Best`` names of glides x, those within the limits, and why some is missing."""
    x = x[within_limits(x, craft)]
    if not len(x):
        return [None] * 4, f"no glide lies within the limits of {craft.name}"
    path = np.abs(x[:, 5] - x[:, 1])
    made_good, power, energy = _cost(x, journey, water)
    strongest = np.abs(x[:, 8]) >= np.abs(x[:, 8]).max() * (1.0 - 1e-9)
    chosen: list[Array | None] = [
        x[int(np.where(strongest, path, np.inf).argmin())],
        x[int(made_good.argmax())],
        x[int(energy.argmin())],
        x[int(np.where(made_good >= 0.0, power, np.inf).argmin())] if journey.current > 0.0 else None,
    ]
    if not np.isfinite(energy.min()):
        chosen[2] = chosen[3] = None
        fastest = made_good.max() + journey.current
        return (
            chosen,
            f"nothing is made good against {journey.current:g} m/s, the fastest glide makes {fastest:.3f} m/s",
        )
    if len(np.unique(x[:, 8])) > 1 and journey.current <= 0.0 and journey.hotel_power == 0.0:
        chosen[2] = None
        return chosen, (
            "without a current or hotel power the slowest glide costs the least energy; give one of them, or a net "
            "buoyancy"
        )
    return chosen, ""
