"""Which variables of a NetCDF file are which quantity, in this program's units? By standard name, else usual names.

Sources: the CF conventions 1.11 (standard names, units, _FillValue, valid_range, positive, flag_meanings) and layouts
that archives publish: World Ocean Database, CCHDO, Argo, OceanSITES, Copernicus Marine, SeaDataNet.
"""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.named_units import conversion_to, names_of
from glidercli.netcdf_opening import dataset
from glidercli.netcdf_packing import packing_of
from glidercli.ocean.source import listed
from glidercli.units import DBAR
from glidercli.years import FIRST_SECOND, LAST_SECOND

__all__ = ["MOST_VALUES", "QUANTITIES", "NcFile", "long_dimensions", "opened"]

Array = NDArray[np.float64]

MOST_VALUES = 50_000_000
"""Of one variable, 400 MB."""


class Quantity(NamedTuple):
    """How a quantity is found.

    standard : CF standard names. names : of variables, lower case. unit : this program's, "" of times. also : further
    names of that unit, in lower case.
    """

    standard: tuple[str, ...]
    names: tuple[str, ...]
    unit: str
    also: tuple[str, ...] = ()


QUANTITIES: dict[str, Quantity] = {
    "depth": Quantity(
        ("depth", "altitude", "height"), ("depth", "deph", "z", "bindepth", "depth_m", "lev", "level"), "m"
    ),
    "pressure": Quantity(
        ("sea_water_pressure", "sea_water_pressure_due_to_sea_water"),
        ("pressure", "pres", "ctd_pressure", "ctdprs", "pressure_dbar"), "dbar",
    ),
    "temperature": Quantity(
        ("sea_water_temperature",),
        ("temperature", "temp", "ctd_temperature", "ctdtmp", "temperature_degc"), "degC",
    ),
    "potential_temperature": Quantity(
        ("sea_water_potential_temperature",), ("thetao", "potemp", "theta"), "degC"
    ),
    "conservative_temperature": Quantity(
        ("sea_water_conservative_temperature",), ("conservative_temperature",), "degC"
    ),
    "salinity": Quantity(
        ("sea_water_practical_salinity", "sea_water_salinity"),
        ("salinity", "psal", "sal", "ctd_salinity", "ctdsal", "so", "practical_salinity"), "1", ("g/kg", "gkg-1"),
    ),
    "absolute_salinity": Quantity(
        ("sea_water_absolute_salinity",), ("absolute_salinity", "absolute_salinity_g_kg"), "g/kg"
    ),
    "conductivity": Quantity(
        ("sea_water_electrical_conductivity",), ("conductivity", "cndc", "conductivity_s_m"), "S/m"
    ),
    "density": Quantity(("sea_water_density",), ("density", "dens", "density_kg_m3"), "kg/m3"),
    "east": Quantity(
        ("eastward_sea_water_velocity",),
        ("ucur", "uo", "ewct", "current_east", "current_east_m_s", "east", "u"), "m/s",
    ),
    "north": Quantity(
        ("northward_sea_water_velocity",),
        ("vcur", "vo", "nsct", "current_north", "current_north_m_s", "north", "v"), "m/s",
    ),
    "up": Quantity(
        ("upward_sea_water_velocity",), ("wcur", "current_up", "current_up_m_s", "up", "w"), "m/s"
    ),
    "latitude": Quantity(("latitude",), ("latitude", "lat"), "deg"),
    "longitude": Quantity(("longitude",), ("longitude", "lon"), "deg"),
    "time": Quantity(("time",), ("time", "juld"), ""),
}  # fmt: skip

_CALENDARS = ("standard", "gregorian", "proleptic_gregorian")  # those whose days are the days of logs
_FRAMES = ("coord_sys", "coordinate_system", "coord_system", "velocity_frame", "reference_frame")
_NOT_EARTH = ("beam", "inst", "ship", "xyz", "head", "principal", "streamwise")
_FLAGS = ("_qc", "_seadatanet_qc", "_flag", "_flags", "_wodflag")
_BAD_BY_NUMBER = (b"3", b"4", 3, 4)  # Argo and OceanSITES, reference table 2: probably bad, bad


@contextlib.contextmanager
def opened(path: Path) -> Iterator[NcFile]:
    """A NetCDF file; InputError where it, or a part that is asked for, cannot be read."""
    readable_file(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # attributes that do not fit; what they would have masked is checked here
            with dataset(path) as file:
                yield NcFile(path, file)
    except (OSError, RuntimeError, ValueError, OverflowError, AttributeError) as error:
        if isinstance(error, AttributeError) and not str(error).startswith("NetCDF:"):  # the library's, of a damage
            raise
        raise InputError(path, f"is a NetCDF file that cannot be read: {' '.join(str(error).split())}") from None


class NcFile:
    """An open NetCDF file; ``remarks`` collects what a reader of results should know."""

    def __init__(self, path: Path, dataset: Any) -> None:
        self.path = path
        self.variables: dict[str, Any] = dict(dataset.variables)
        self.attributes: dict[str, Any] = {name: dataset.getncattr(name) for name in dataset.ncattrs()}
        self.remarks: list[str] = []

    @property
    def names(self) -> str:
        """Its variables, for a message."""
        return listed(tuple(self.variables)) or "nothing"

    def candidates(self, quantity: str) -> list[Any]:
        """Variables that can be a quantity: those of its standard names, then those of its usual names."""
        told = QUANTITIES[quantity]
        numbers = [v for v in self.variables.values() if getattr(v.dtype, "kind", "") in "fiu"]
        by_standard = [
            v for name in told.standard for v in numbers if str(getattr(v, "standard_name", "")).strip() == name
        ]
        bare = [v for v in numbers if not hasattr(v, "standard_name")]
        by_name = [v for name in told.names for v in bare if v.name.lower() == name]
        found = by_standard + by_name
        return sorted(found, key=lambda v: v.name.upper().endswith("_ADJUSTED"))  # netcdf_adjusted.py sees to these

    def find(self, quantity: str, within: tuple[str, ...] | None = None) -> Any | None:
        """The first candidate whose dimensions of more than one are all among ``within``, or None."""
        for variable in self.candidates(quantity):
            if within is None or set(long_dimensions(variable)) <= set(within):
                return variable
        return None

    def check_earth(self, variables: list[Any]) -> None:
        """Refuse velocities that say they are not in the earth frame."""
        told = {name: self.attributes[name] for name in _FRAMES if name in self.attributes}
        for variable in variables:
            told |= {name: variable.getncattr(name) for name in _FRAMES if name in variable.ncattrs()}
        for name, frame in told.items():
            if any(word in str(frame).lower() for word in _NOT_EARTH):
                raise InputError(
                    self.path, f"{name} = {frame}: the current is not in the earth frame; needed are east and north"
                )

    def values(self, variable: Any, quantity: str) -> tuple[Array, NDArray[np.bool_]]:
        """A variable in this program's unit, NaN where it has none, and where a flag calls it bad; both as it stands.

        Depth is positive down: the attribute ``positive`` (or the standard names altitude, height) is heeded.
        """
        raw = self.numbers(variable)
        values = np.ma.filled(np.ma.asarray(raw, dtype=np.float64), np.nan)
        factor, offset = self._factor(variable, quantity)
        values = values * factor + offset
        if quantity == "depth":
            standard = str(getattr(variable, "standard_name", ""))
            up = str(getattr(variable, "positive", "")).lower() == "up" or standard in ("altitude", "height")
            values = -values if up else values
        if quantity == "temperature" and "68" in str(getattr(variable, "reference_scale", "")):
            from glidercli.ocean.seawater import t90_from_t68

            values = t90_from_t68(values)
        return values, self._flagged(variable)

    def seconds(self, variable: Any) -> Array:
        """A variable of times as seconds since 1970, UTC; NaN where it has none, or one before 1700 or after 2200."""
        import cftime

        raw = np.ma.asarray(self.numbers(variable), dtype=np.float64)
        units, calendar = str(getattr(variable, "units", "")), str(getattr(variable, "calendar", "standard")).lower()
        try:
            if calendar not in _CALENDARS:
                raise ValueError
            zero, one = cftime.num2date([0, 1], units, calendar)
            since_1970 = float(cftime.date2num(zero, "seconds since 1970-01-01", calendar))
        except (ValueError, OverflowError, TypeError, AttributeError):
            what = f"{variable.name}: units = {units!r}, calendar = {calendar!r}"
            raise InputError(self.path, f"{what}; needed are times as 'days since 1950-01-01'") from None
        seconds = since_1970 + raw.filled(np.nan) * (one - zero).total_seconds()
        return np.where(
            (seconds >= FIRST_SECOND) & (seconds < LAST_SECOND), seconds, np.nan
        )  # beyond are marks of gaps

    def numbers(self, variable: Any) -> Any:
        """The values of a variable, unpacked and masked where the file has none.

        Raises InputError where they are too many, or where what they are packed by is no number.
        """
        size = math.prod(variable.shape)
        if size > MOST_VALUES:
            raise InputError(self.path, f"{variable.name} has {size:.2g} values, allowed are {MOST_VALUES:.0e}")
        try:
            packing = packing_of({name: variable.getncattr(name) for name in variable.ncattrs()})
        except ValueError as fault:
            raise InputError(self.path, f"{variable.name}: {fault}") from None
        if not packing.notes:
            return variable[...]
        for note in packing.notes:
            self._remark(f"{variable.name}: {note}")
        variable.set_auto_scale(False)  # the library unpacks by numbers alone
        return variable[...] * packing.factor + packing.offset

    def _factor(self, variable: Any, quantity: str) -> tuple[float, float]:
        told = QUANTITIES[quantity]
        unit = str(getattr(variable, "units", "")).strip()
        if not unit:
            if told.unit != "1":
                self._remark(f"{variable.name} has no units; {told.unit} is taken")
            return 1.0, 0.0
        si = "Pa" if told.unit == "dbar" else told.unit
        known = conversion_to(si, unit) or conversion_to(si, unit.split("(")[0])
        if known is None and unit.lower().replace(" ", "") not in told.also:
            raise InputError(self.path, f"{variable.name} is in {unit!r}, allowed: {', '.join(names_of(si))}")
        if known is None:
            return 1.0, 0.0
        return (known.factor / DBAR, 0.0) if si == "Pa" else known

    def _remark(self, line: str) -> None:
        if line not in self.remarks:
            self.remarks.append(line)

    def _flagged(self, variable: Any) -> NDArray[np.bool_]:
        """Where the variable of flags that goes with a variable calls it bad."""
        none = np.zeros(variable.shape, dtype=bool)
        named = [*str(getattr(variable, "ancillary_variables", "")).split()]
        lower = {name.lower(): name for name in self.variables}
        named += [lower[variable.name.lower() + end] for end in _FLAGS if variable.name.lower() + end in lower]
        for name in named:
            flags = self.variables.get(name)
            if flags is None or flags.shape != variable.shape:
                continue
            meanings = str(getattr(flags, "flag_meanings", "")).split()
            numbers = np.atleast_1d(getattr(flags, "flag_values", []))
            bad = [value for value, word in zip(numbers, meanings, strict=False) if "bad" in word.lower()]
            by_table = any(word in str(getattr(flags, "conventions", "")).lower() for word in ("argo", "oceansites"))
            bad = bad or (list(_BAD_BY_NUMBER) if by_table else [])
            if bad:
                raw = np.ma.asarray(flags[...])
                called = np.isin(
                    raw.data, np.array([x for x in bad if isinstance(x, bytes) == (raw.dtype.kind == "S")])
                )
                return np.asarray(called & ~np.ma.getmaskarray(raw))
        return none


def long_dimensions(variable: Any) -> tuple[str, ...]:
    """Names of a variable's dimensions of more than one."""
    return tuple(name for name, size in zip(variable.dimensions, variable.shape, strict=True) if size != 1)
