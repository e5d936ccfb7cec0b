"""What casts and current profiles does a NetCDF file hold? One or several in time, with every gap counted."""

from __future__ import annotations

import dataclasses
import itertools
from collections import Counter
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean import seawater
from glidercli.ocean.cast import Cast
from glidercli.ocean.counting import counted
from glidercli.ocean.current import CurrentProfile, profile_of
from glidercli.ocean.measured import Measured, cast_of, usable
from glidercli.ocean.netcdf import NcFile, long_dimensions, opened
from glidercli.ocean.netcdf_adjusted import Column, adjusted, is_argo, repeats
from glidercli.ocean.netcdf_layout import MAIN, Layout, layout_of, main_of
from glidercli.ocean.pings import PING_VARIABLES, currents_of_pings, is_pings, pings_of
from glidercli.ocean.place import Place
from glidercli.ocean.series import Moment
from glidercli.ocean.source import left_out, listed
from glidercli.ocean.together import gaps_of, overturns_of

__all__ = ["netcdf_casts", "netcdf_currents"]

P = TypeVar("P", Cast, CurrentProfile)
Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Dropped = tuple[tuple[str, int], ...]

_FEW = "in a profile of fewer than two usable samples"
_AGAIN = "in a profile of a further sampling at the same time"
_NO_TIME = "in a profile without a time"
_ZIGZAG = "in a profile whose depth goes up and down"


def netcdf_casts(path: Path, latitude: float | None, longitude: float | None) -> tuple[Cast, ...]:
    """The casts of a NetCDF file. latitude, longitude : deg, where the file tells none.

    Pressure is taken as sea pressure, as archives have it. Potential and conservative temperature become in-situ ones
    by TEOS-10. Raises InputError where the file has no profiles, a unit is not known, or nothing usable is left.
    """
    if latitude is not None:
        seawater.checked_latitude(latitude)
    with opened(path) as file:
        main = main_of(file, MAIN[:-1])
        if main is None:
            raise InputError(path, f"has neither temperature nor density; it has {file.names}")
        layout = layout_of(file, main[1])
        own = (_along(file, layout, "latitude"), _along(file, layout, "longitude"))
        places = [Place(*at, latitude, longitude) for at in zip(*own, strict=True)]
        read = {quantity: _column(file, layout, quantity) for quantity in _needed(file, layout)}
        columns = adjusted(file, layout, {quantity: column for quantity, column in read.items() if column is not None})
        bad = np.any([column.bad for column in columns.values()], axis=0)
        times = _times(file, layout)
        again = repeats(times) if is_argo(file) else np.zeros(layout.profiles, dtype=bool)
        remarks = tuple(file.remarks)
    casts: list[Cast] = []
    lost: list[Dropped] = []
    zigzag: list[str] = []
    for i in range(layout.profiles):
        rows = {name: column.values[i] for name, column in columns.items()}
        water = _water(path, rows, places[i])
        inside: Mask = np.any([np.isfinite(column) for column in water if column is not None], axis=0)
        kept = inside.copy()
        dropped = counted([("flagged bad", bad[i])], kept)
        kept, more = usable(water, kept)
        order, repeated = _by_depth(water, kept)
        if order is None:
            if layout.profiles == 1:
                raise InputError(path, "its depth goes up and down; a profile goes one way")
            moment = _moment(times[i])
            zigzag.append(f"profile {i}" + (f", {moment.text}" if moment else ""))
            lost += [dropped, ((_ZIGZAG, int(kept.sum())),)]
            continue
        dropped += more + repeated
        timed = layout.profiles == 1 or np.isfinite(times[i])
        if len(order) < 2 or not timed or again[i]:
            why = _NO_TIME if not timed else _AGAIN if again[i] else _FEW
            lost += [dropped, ((why, len(order)),) if len(order) else ()]
            continue
        cast = cast_of(water.rows(order), places[i], path, moment=_moment(times[i]), dropped=dropped)
        casts.append(dataclasses.replace(cast, warnings=_about(water, places[i])))
    if zigzag:
        told = listed(tuple(zigzag), 5)
        line = f"{len(zigzag)} of {layout.profiles} profiles left out, whose depth goes up and down: {told}"
        remarks = (line, *remarks)
    remarks += gaps_of([cast.depth for cast in casts], "sample") + overturns_of([cast.density for cast in casts])
    return _finished(path, casts, lost, remarks, "samples")


def netcdf_currents(path: Path, latitude: float | None = None) -> tuple[CurrentProfile, ...]:
    """The current profiles of a NetCDF file, in the earth frame; InputError as for casts, and for any other frame.

    latitude : deg, for the depth of a pressure where the file has none.
    """
    with opened(path) as file:
        main = main_of(file, ("east",))
        north = main and file.find("north", main[1].dimensions)
        if main is None and is_pings(file.variables):
            return currents_of_pings(path, pings_of(*_as_read(file), latitude))
        if main is None or north is None:
            file.check_earth([v for v in file.variables.values() if v.name.lower().startswith("vel")])
            what = "has no eastward_sea_water_velocity and northward_sea_water_velocity"
            raise InputError(
                path, f"{what} (standard names, or u and v, uo and vo, UCUR and VCUR); it has {file.names}"
            )
        file.check_earth([main[1], north])
        layout = layout_of(file, main[1])
        along = _column(file, layout, layout.axis)
        assert along is not None
        _, depth, bad = along
        if layout.axis == "pressure":
            here = [latitude if place is None else place for place in _along(file, layout, "latitude")]
            latitudes = np.array([place or 0.0 for place in here])
            depth = seawater.depth_from_pressure(depth, latitudes[:, np.newaxis])  # type: ignore[arg-type]
        velocity = []
        for quantity in ("east", "north", "up"):
            if (column := _column(file, layout, quantity)) is not None:
                velocity.append(column.values)
                bad = bad | column.bad
        times = _times(file, layout)
        remarks = tuple(file.remarks)
    profiles: list[CurrentProfile] = []
    lost: list[Dropped] = []
    for i in range(layout.profiles):
        bins = np.array([component[i] for component in velocity])
        inside = np.isfinite(depth[i])
        timed = layout.profiles == 1 or bool(np.isfinite(times[i]))
        found = profile_of(path, depth[i], bins, inside, [("flagged bad", bad[i])])
        if isinstance(found, CurrentProfile) and timed:
            profiles.append(dataclasses.replace(found, moment=_moment(times[i])))
        elif isinstance(found, CurrentProfile):
            lost += [found.dropped, ((_NO_TIME, len(found.depth)),)]
        else:
            lost.append(found)
    return _finished(path, profiles, lost, remarks + gaps_of([profile.depth for profile in profiles], "bin"), "bins")


def _as_read(file: NcFile) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
    """Variables and attributes of a file that mhkit's dolfyn wrote, as pings.py takes them."""
    names = [name for name in file.variables if name.removesuffix("_avg") in PING_VARIABLES]
    found: dict[str, NDArray[Any]] = {}
    for name in names:
        variable = file.variables[name]
        if name.startswith("time"):
            found[name] = file.seconds(variable)
        elif getattr(variable.dtype, "kind", "") in "fiu":
            found[name] = np.ma.filled(np.ma.asarray(file.numbers(variable), dtype=np.float64), np.nan)
    return found, file.attributes


def _column(file: NcFile, layout: Layout, quantity: str) -> Column | None:
    """A quantity by profile and sample; None where the file does not have it."""
    variable = _variable(file, layout, quantity)
    if variable is None:
        return None
    values, flagged = file.values(variable, quantity)
    tables = layout.table(file.path, variable, values), layout.table(file.path, variable, flagged, False)
    return Column(variable.name, *tables)


def _needed(file: NcFile, layout: Layout) -> list[str]:
    """The quantities that make the water, of those that a file has the most direct ones."""
    groups = (
        ("depth", "pressure"),
        ("temperature", "conservative_temperature", "potential_temperature"),
        ("salinity", "absolute_salinity", "conductivity"),
    )
    found = [next((q for q in group if _variable(file, layout, q) is not None), None) for group in groups]
    if found[1] is None or found[2] is None:
        found[2] = "density"
    return [quantity for quantity in found if quantity is not None]


def _variable(file: NcFile, layout: Layout, quantity: str) -> Any | None:
    """The variable of a quantity that lies along the profiles, or None."""
    if quantity == layout.axis:
        return layout.axis_variable
    within = {layout.vertical, *((layout.across,) if layout.across else ()), *layout.rows}
    for candidate in file.candidates(quantity):
        long = set(long_dimensions(candidate))
        if long <= within and long & {layout.vertical, *layout.rows}:
            return candidate
    return None


def _along(file: NcFile, layout: Layout, quantity: str) -> list[float | None]:
    """Latitude or longitude of each profile, None where it is not known."""
    within = (layout.across,) if layout.across else ()
    for variable in file.candidates(quantity):
        long = long_dimensions(variable)
        if variable.size == 1 or (variable.size == layout.profiles and (layout.rows or set(long) <= set(within))):
            values = np.broadcast_to(file.values(variable, quantity)[0].ravel(), (layout.profiles,))
            return [float(v) if abs(v) <= (90.0 if quantity == "latitude" else 360.0) else None for v in values]
    return [None] * layout.profiles


def _times(file: NcFile, layout: Layout) -> Array:
    """Seconds since 1970 of each profile, NaN where not known."""
    for variable in file.candidates("time"):
        if variable.size in (1, layout.profiles) and layout.vertical not in long_dimensions(variable):
            return np.array(np.broadcast_to(file.seconds(variable).ravel(), (layout.profiles,)))
    return np.full(layout.profiles, np.nan)


def _moment(seconds: float) -> Moment | None:
    return Moment(float(seconds), True) if np.isfinite(seconds) else None


def _water(path: Path, rows: dict[str, Array], place: Place) -> Measured:
    """What one profile has, with the in-situ temperature of a potential or conservative one."""
    depth, pressure, temperature = rows.get("depth"), rows.get("pressure"), rows.get("temperature")
    salinity, absolute = rows.get("salinity"), rows.get("absolute_salinity")
    if temperature is None and (salinity is not None or absolute is not None):
        p = pressure if depth is None else seawater.pressure_from_depth(np.clip(depth, 0.0, None), place.used)
        if p is not None:
            if absolute is None and salinity is not None:
                absolute_here = place.absolute_salinity(np.where(np.abs(salinity) < 50.0, salinity, np.nan), p)
            else:
                absolute_here = np.asarray(absolute)
            if (potential := rows.get("potential_temperature")) is not None:
                temperature = seawater.temperature_from_potential(absolute_here, potential, p)
            elif (conservative := rows.get("conservative_temperature")) is not None:
                temperature = seawater.temperature_from_conservative(absolute_here, conservative, p)
    names = ", ".join(rows)
    water = Measured(depth, pressure, temperature, salinity, absolute, rows.get("conductivity"), rows.get("density"))
    return water.checked(path, names)


def _by_depth(water: Measured, kept: Mask) -> tuple[NDArray[np.intp] | None, Dropped]:
    """Kept samples from the top down, and how many repeat a depth; the file may have them from the bottom up.

    None where depth goes both ways.
    """
    axis = water.depth if water.depth is not None else water.pressure_dbar
    assert axis is not None
    order = np.flatnonzero(kept)
    steps = np.diff(axis[order])
    if len(steps) and (steps < 0.0).any():
        if (steps > 0.0).any():
            return None, ()
        order = order[::-1]
    again = np.concatenate([[False], np.diff(axis[order]) == 0.0]) if len(order) else np.zeros(0, dtype=bool)
    return order[~again], (("repeated depth", int(again.sum())),) if again.any() else ()


def _about(water: Measured, place: Place) -> tuple[str, ...]:
    """What a cast's place leaves open."""
    computed = "depth" if water.depth is None else "pressure"
    return place.warnings(computed, water.salinity is not None or water.conductivity is not None)


def _finished(path: Path, found: list[P], lost: list[Dropped], remarks: tuple[str, ...], what: str) -> tuple[P, ...]:
    """The profiles, with the account of those that are left out on the first one; InputError where none is left."""
    gone: Counter[str] = Counter()
    whole: Counter[str] = Counter()
    for reason, count in itertools.chain(*lost):
        gone[reason] += count
    whole.update(gone)
    for reason, count in itertools.chain(*(profile.dropped for profile in found)):
        whole[reason] += count
    total: int = sum(profile.records for profile in found) + gone.total()
    if not found:
        told = ", ".join(f"{count} {reason}" for reason, count in whole.items()) or "no values at all"
        raise InputError(path, f"has no profile of two usable {what} among {total} {what}: {told}")
    warnings = (*remarks, *left_out(tuple(whole.items()), total, what), *found[0].warnings)
    found[0] = dataclasses.replace(found[0], dropped=(*gone.items(), *found[0].dropped), warnings=warnings)
    return tuple(found)
