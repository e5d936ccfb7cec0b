"""What water does a CTD file describe? One cast: density, and temperature and salinity if measured, by depth."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean import seawater
from glidercli.ocean.cnv import is_cnv, parse_cnv
from glidercli.ocean.doubts import doubts
from glidercli.ocean.downcast import CONDUCTIVITY, DEEPEST_DBAR, DENSITY, SALINITY, TEMPERATURE, downcast
from glidercli.ocean.place import Place, middle_of
from glidercli.ocean.profile import wide_gaps
from glidercli.ocean.seabird import PRESSURE, samples
from glidercli.ocean.series import Moment
from glidercli.ocean.source import left_out, listed, read_text
from glidercli.ocean.table import Table, TooFewError, parse_table

__all__ = ["EXPECTED", "Cast", "cast_of_table", "read_ctd"]

Array = NDArray[np.float64]

_CSV_COLUMNS = (
    "depth_m or pressure_dbar; temperature_degC with salinity, absolute_salinity_g_kg or conductivity_S_m, or "
    "density_kg_m3; and, if known, latitude_deg, longitude_deg, time_utc"
)
EXPECTED = f"a CTD cast is a Sea-Bird .cnv file, a NetCDF file or a table with the columns {_CSV_COLUMNS}"
_SALT = ("salinity", "absolute_salinity_g_kg", "conductivity_S_m")
_NEEDED = ("depth_m", "pressure_dbar", "temperature_degC", *_SALT, "density_kg_m3")
_USED = (*_NEEDED, "latitude_deg", "longitude_deg")
_DENSITY_MISMATCH = 0.1  # kg/m3; equations of state in use differ by less than 0.03


@dataclass(frozen=True)
class Cast:
    """A vertical profile of the water.

    depth : (n,), m, positive down, strictly increasing.
    pressure_dbar : (n,), sea pressure.
    temperature : (n,), degC, in situ, ITS-90; None if not measured.
    salinity : (n,), practical; None if not measured. absolute_salinity : (n,), g/kg; None if unknown.
    density : (n,), kg/m3, in situ.
    latitude, longitude : degrees, north and east positive; None if unknown.
    time_utc : start of the cast as the file has it, or None.
    dropped : samples left out, as (reason, count).
    warnings : one line each, without the file's name.
    reconstructed : whether the file says that it is a reconstruction.
    moment : when it holds, of a profile among several; None of a single one, which always holds.
    """

    depth: Array
    pressure_dbar: Array
    temperature: Array | None
    salinity: Array | None
    absolute_salinity: Array | None
    density: Array
    latitude: float | None
    longitude: float | None
    time_utc: str | None
    source: Path
    dropped: tuple[tuple[str, int], ...]
    warnings: tuple[str, ...]
    reconstructed: bool = False
    moment: Moment | None = None

    @property
    def records(self) -> int:
        """Samples in the file: those kept and those dropped."""
        return len(self.depth) + sum(count for _, count in self.dropped)


def read_ctd(path: str | Path, latitude: float | None = None, longitude: float | None = None) -> Cast:
    """The cast in a Sea-Bird .cnv file or a plain table, told apart by content; either may be gzipped.

    latitude, longitude : degrees north and east; used only where the file has none.

    A .cnv file is a record in time: its last descent is taken (see downcast.py). A table is a profile already: a row
    that lacks a value is left out and counted; the others must grow deeper, and any other fault is an error. Density
    comes from temperature and salinity by TEOS-10 where both are there, else from the file. Nothing is interpolated
    here; between samples profile.py holds.

    Raises
    ------
    InputError
        The file cannot be read, lacks a quantity (its columns and the allowed ones are named), has a cell that is no
        number or impossible (line and column are named), is unsorted, or no good sample is left.
    """
    path = Path(path)
    if latitude is not None:
        seawater.checked_latitude(latitude)
    text = read_text(path, EXPECTED)
    if is_cnv(text):
        return _from_cnv(path, text, latitude, longitude)
    return cast_of_table(parse_table(path, text, EXPECTED), latitude, longitude)


def _from_cnv(path: Path, text: str, latitude: float | None, longitude: float | None) -> Cast:
    """The last descent of a .cnv file."""
    file = parse_cnv(path, text)
    place = Place(file.latitude, file.longitude, latitude, longitude)
    recorded = samples(file, place.used)
    kept, dropped, warnings = downcast(recorded)
    if file.unreadable:
        dropped = (("unreadable row", file.unreadable), *dropped)
    total = len(file.rows) + file.unreadable
    if file.announced is not None and file.announced != total:
        warnings = (f"the header announces {file.announced} rows, the file has {total}: it may be cut off", *warnings)
    if len(kept) < 2:
        reasons = ", ".join(f"{count} {reason}" for reason, count in dropped) or "nothing dropped"
        raise InputError(path, f"has {len(kept)} usable samples of {total}: {reasons}; at least two are needed")
    pressure, temperature = recorded.pressure_dbar[kept], recorded.temperature[kept]
    salinity = recorded.salinity[kept]
    absolute = place.absolute_salinity(salinity, pressure)
    depth = seawater.depth_from_pressure(pressure, place.used)
    computed = "depth" if file.first(*PRESSURE) else "pressure"
    return Cast(
        depth=depth,
        pressure_dbar=pressure,
        temperature=temperature,
        salinity=salinity,
        absolute_salinity=absolute,
        density=seawater.density(absolute, temperature, pressure),
        latitude=place.latitude,
        longitude=place.longitude,
        time_utc=file.time_utc,
        source=path,
        dropped=dropped,
        warnings=(
            *warnings,
            *place.warnings(computed, True),
            *left_out(dropped, total, "samples"),
            *wide_gaps(depth, "sample"),
        ),
    )


def cast_of_table(table: Table, latitude: float | None, longitude: float | None) -> Cast:
    """The profile of a plain table, every row of it that lacks nothing; TooFewError where fewer than two are left."""
    whole = table
    table, dropped = _complete(whole)
    own_latitude = _constant(table, "latitude_deg", -90.0, 90.0)
    own_longitude = _constant(table, "longitude_deg", -180.0, 360.0)
    place = Place(own_latitude, own_longitude, latitude, longitude)
    depth, pressure = _axes(table, place)
    temperature = _column(table, "temperature_degC", TEMPERATURE)
    salinity = _column(table, "salinity", SALINITY)
    conductivity = _column(table, "conductivity_S_m", CONDUCTIVITY)
    if salinity is None and conductivity is not None and temperature is not None:
        salinity = seawater.practical_salinity(conductivity, temperature, pressure)
    absolute = _column(table, "absolute_salinity_g_kg", SALINITY)
    by_place = absolute is None and salinity is not None
    if absolute is None and salinity is not None:
        absolute = place.absolute_salinity(salinity, pressure)
    density, warnings = _density(table, absolute, temperature, pressure)
    if len(table) < 2:
        raise TooFewError(
            table.path, f"line {table.lines[0]}: is the only usable sample of its profile; at least two are needed"
        )
    missing = next((name.split("_")[0] for name in ("depth_m", "pressure_dbar") if name not in table), None)
    if unknown := table.unknown(_USED):
        warnings += (f"columns not known and not used: {listed(unknown)}",)
    return Cast(
        depth=depth,
        pressure_dbar=pressure,
        temperature=temperature,
        salinity=salinity,
        absolute_salinity=absolute,
        density=density,
        latitude=place.latitude,
        longitude=place.longitude,
        time_utc=(table.cells["time_utc"][0] or None) if "time_utc" in table else None,
        source=table.path,
        dropped=dropped,
        warnings=(
            *left_out(dropped, len(whole), "samples"),
            *place.warnings(missing, by_place),
            *warnings,
            *doubts(salinity, density),
            *wide_gaps(depth, "sample"),
        ),
        reconstructed=whole.reconstructed,
    )


def _complete(table: Table) -> tuple[Table, tuple[tuple[str, int], ...]]:
    """The rows that lack nothing of the water, and what is left out, counted by the first column that a row lacks."""
    kept = np.ones(len(table), dtype=bool)
    dropped: list[tuple[str, int]] = []
    idle = [table.measured(name) == 0.0 for name in ("temperature_degC", *_SALT) if name in table]
    if len(idle) > 1 and (zero := np.all(idle, axis=0)).any():
        dropped.append(("temperature and salinity both zero", int(zero.sum())))
        kept &= ~zero
    for name in (name for name in _NEEDED if name in table):
        lacking = table.lacking(name) & kept
        if lacking.any():
            dropped.append((f"without {name}", int(lacking.sum())))
            kept &= ~lacking
    if not kept.any():
        reasons = ", ".join(f"{count} {reason}" for reason, count in dropped)
        raise TooFewError(table.path, f"has no usable sample among {len(table)}: {reasons}; at least two are needed")
    return table.rows(kept), tuple(dropped)


def _axes(table: Table, place: Place) -> tuple[Array, Array]:
    """Depth, m, and pressure, dbar, of a table's rows; the one that it lacks comes from the other."""
    if "pressure_dbar" not in table:
        if "depth_m" not in table:
            raise _missing(table, "depth_m or pressure_dbar")
        depth = table.increasing("depth_m", 0.0, DEEPEST_DBAR)
        return depth, seawater.pressure_from_depth(depth, place.used)
    pressure = table.increasing("pressure_dbar", 0.0, DEEPEST_DBAR)
    if "depth_m" not in table:
        return seawater.depth_from_pressure(pressure, place.used), pressure
    depth = table.increasing("depth_m", 0.0, DEEPEST_DBAR)
    expected = seawater.pressure_from_depth(depth, place.used)
    for i in np.flatnonzero(np.abs(pressure - expected) > 5.0 + 0.05 * expected):  # fresh water has 3 % less
        what = f"pressure_dbar = {pressure[i]:g} at depth_m = {depth[i]:g}, where {expected[i]:.0f} dbar are expected"
        raise InputError(table.path, f"line {table.lines[i]}: {what}")
    return depth, pressure


def _density(
    table: Table, absolute: Array | None, temperature: Array | None, pressure: Array
) -> tuple[Array, tuple[str, ...]]:
    """In-situ density, kg/m3, by TEOS-10 where salinity and temperature are there, else the table's; and warnings."""
    own = _column(table, "density_kg_m3", DENSITY)
    if absolute is not None and temperature is not None:
        computed = seawater.density(absolute, temperature, pressure)
        apart = 0.0 if own is None else float(np.abs(own - computed).max())
        if apart > _DENSITY_MISMATCH:
            return computed, (f"density_kg_m3 differs from TEOS-10 by up to {apart:.2f} kg/m3; TEOS-10 is used",)
        return computed, ()
    if own is None:
        salty = temperature is None and any(name in table for name in _SALT)
        raise _missing(table, "temperature_degC" if salty else f"{', '.join(_SALT)} or density_kg_m3")
    return own, ()


def _column(table: Table, name: str, allowed: tuple[float, float]) -> Array | None:
    """Numbers of a column within a range, or None without it."""
    return table.numbers(name, *allowed) if name in table else None


def _constant(table: Table, column: str, low: float, high: float) -> float | None:
    """Median of a column of positions, or None where none is told."""
    told = table.rows(~table.lacking(column)) if column in table else ()
    return middle_of(told.numbers(column, low, high), column.removesuffix("_deg")) if told else None


def _missing(table: Table, needed: str) -> InputError:
    """The error that a column is missing."""
    return InputError(
        table.path, f"has no column {needed}; its columns are {listed(table.columns)}; allowed: {_CSV_COLUMNS}"
    )
