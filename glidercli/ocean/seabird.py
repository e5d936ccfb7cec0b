"""Which columns of a Sea-Bird file are pressure, temperature and salinity, and in which units?

Names are those of the manual of SBE Data Processing (appendix "Output Variable Names"). The unit in a column's
brackets decides; only without one does the name: a last letter M stands for metric, E for English (psi).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean import seawater
from glidercli.ocean.cnv import CnvColumn, CnvFile
from glidercli.ocean.downcast import Samples
from glidercli.ocean.source import listed

__all__ = ["PRESSURE", "samples"]

Array = NDArray[np.float64]

PRESSURE = ("prDM", "prdM", "prSM", "pr50M", "pr50M1", "prM", "pr", "prDE", "prdE", "pr50E", "prE")
DEPTH = ("depSM",)
TEMPERATURE = (
    "t090C", "t068C", "t090Cm", "t090", "t068", "tv290C", "tv268C", "tnc90C", "tnc68C", "t4990C", "t4968C", "t3890C",
    "t3868C",
)  # fmt: skip
SECOND_TEMPERATURE = ("t190C", "t168C", "t190Cm", "t190", "t168", "tnc290C", "tnc268C", "t3890C1", "t3868C1")
CONDUCTIVITY = ("c0S/m", "c0mS/cm", "c0uS/cm", "cond0S/m", "cond0mS/cm", "cond0uS/cm")
SALINITY = ("sal00",)
SECOND_SALINITY = ("sal11",)

_PRESSURE_UNITS = {"db": 1.0, "dbar": 1.0, "decibars": 1.0, "psi": 0.6894757293}  # to dbar
_CONDUCTIVITY_UNITS = {"s/m": 1.0, "ms/cm": 0.1, "us/cm": 1e-4, "µs/cm": 1e-4}  # to S/m


def samples(file: CnvFile, latitude: float) -> Samples:
    """The samples of a .cnv file in this program's units.

    latitude : degrees north, for pressure where the file has depth only.

    Salinity is the file's own (sal00); without it, that of conductivity, temperature and pressure by PSS-78.

    Raises
    ------
    InputError
        No pressure or depth, no temperature, neither salinity nor conductivity, or a unit that is not known.
    """
    temperature = _temperature(file, TEMPERATURE)
    if temperature is None:
        raise _missing(file, "temperature", TEMPERATURE)
    pressure = _pressure(file, latitude)
    conductivity = _conductivity(file)
    if (own := file.first(*SALINITY)) is not None:
        salinity = own[1]
    elif conductivity is not None:
        salinity = seawater.practical_salinity(conductivity, temperature, pressure)
    else:
        raise _missing(file, "salinity or conductivity", (*SALINITY, *CONDUCTIVITY))
    flag = file.first("flag")
    second = file.first(*SECOND_SALINITY)
    return Samples(
        pressure_dbar=pressure,
        temperature=temperature,
        salinity=salinity,
        flagged=np.zeros(len(pressure), dtype=bool) if flag is None else flag[1] != 0.0,  # the bad flag reads as NaN
        conductivity=conductivity,
        second_temperature=_temperature(file, SECOND_TEMPERATURE),
        second_salinity=None if second is None else second[1],
    )


def _pressure(file: CnvFile, latitude: float) -> Array:
    """Sea pressure, dbar, (n,); from depth at a latitude where the file has no pressure."""
    if (found := file.first(*PRESSURE)) is not None:
        column, values = found
        return values * _factor(file, column, _PRESSURE_UNITS, "psi" if column.name.endswith("E") else "db")
    if (found := file.first(*DEPTH)) is not None:
        return seawater.pressure_from_depth(found[1], latitude)
    raise _missing(file, "pressure or depth", (*PRESSURE, *DEPTH))


def _temperature(file: CnvFile, names: tuple[str, ...]) -> Array | None:
    """In-situ temperature, degC, ITS-90, (n,), or None."""
    if (found := file.first(*names)) is None:
        return None
    column, values = found
    scale = column.unit if "ITS" in column.unit or "IPTS" in column.unit else column.name
    return seawater.t90_from_t68(values) if "68" in scale else values


def _conductivity(file: CnvFile) -> Array | None:
    """Conductivity, S/m, (n,), or None."""
    if (found := file.first(*CONDUCTIVITY)) is None:
        return None
    column, values = found
    return values * _factor(file, column, _CONDUCTIVITY_UNITS, column.name.split("0", 1)[1])


def _factor(file: CnvFile, column: CnvColumn, units: dict[str, float], unit_of_name: str) -> float:
    """What a column is multiplied by, from the unit in its brackets, else from its name."""
    unit = column.unit or unit_of_name
    if unit.lower() not in units:
        raise InputError(file.path, f"column {column.name} is in {unit!r}, allowed: {listed(tuple(units))}")
    return units[unit.lower()]


def _missing(file: CnvFile, quantity: str, names: tuple[str, ...]) -> InputError:
    """The error that a quantity has no column with a known name."""
    own = tuple(column.name for column in file.columns)
    return InputError(
        file.path, f"has no column of {quantity}; its columns are {listed(own)}; known names: {listed(names)}"
    )
