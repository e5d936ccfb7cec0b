"""How does a NetCDF variable become numbers in SI? Fill values, packing, valid range, quality flags and units.

Fill value, packing and valid range as CF 1.10 says (sections 2.5.1 and 8.1: the valid range is of the stored values).
Quality flags 0 to 9 as the IOOS glider format 2.0 and OceanGliders 1.0 number them: 0 no check, 1 good, 2 probably
good (QARTOD: not evaluated), 3 probably bad or suspect, 4 bad, 5 changed, 6 and 7 not used, 8 interpolated, 9 missing.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Origin
from glidercli.named_units import conversion, units_of
from glidercli.netcdf_packing import Packing, packing_of

__all__ = [
    "BAD_PLACE", "COMPUTED", "Values", "attributes", "fault_of", "flags_of", "stored_numbers", "text_of", "values_of",
]  # fmt: skip

Array = NDArray[np.float64]

BAD = {3: "probably bad", 4: "bad", 6: "unused flag", 7: "unused flag", 8: "interpolated", 9: "missing"}
BAD_PLACE = {flag: meaning for flag, meaning in BAD.items() if flag != 8}
"""Of a position that need not be a fix."""
CHANGED = 5
UNITLESS = {"latitude": "degrees", "longitude": "degrees", "salinity": "1"}
"""Units that need not be told. Of places CF knows none but degrees (sections 4.1 and 4.2), and practical salinity has
no dimension, which needs no unit (3.1). Of all others several are in use: a temperature may be in degC or K, a
conductivity in S/m or mS/cm, a pitch in deg or rad."""
LARGEST = 1e200
"""Larger numbers are impossible for any channel, and products with them stay numbers."""
LONGEST_TEXT = 4096
COMPUTED = ("salinity", "density", "absolute_salinity", "conservative_temperature")
"""Never measured: computed from conductivity, temperature and pressure."""


class Values(NamedTuple):
    """A variable's values.

    name : of the variable. values : (n,), SI, NaN where there is none. origin : derived where the file says that they
    were computed or interpolated.
    """

    name: str
    values: Array
    origin: Origin


def attributes(variable: Any) -> dict[str, Any]:
    """The attributes of a variable."""
    return {key: variable.getncattr(key) for key in variable.ncattrs()}


def text_of(file: Any, name: str) -> str:
    """The text that a variable or a global attribute holds; "" where there is none."""
    if name in file.variables and not file[name].dimensions[1:] and file[name].size <= LONGEST_TEXT:
        found = np.atleast_1d(file[name][...])
        if found.dtype.kind == "S":
            return b"".join(found.tolist()).decode("utf-8", "replace").strip("\0 ")
        if found.dtype.kind in "OU":
            return " ".join(str(item) for item in found[:1].tolist()).strip()
    return str(file.getncattr(name)).strip() if name in file.ncattrs() else ""


def flags_of(file: Any, name: str) -> NDArray[np.int64] | None:
    """The quality flags of a variable, (n,), -1 where none is given; None without flags.

    They stand in NAME_QC or NAME_qc, as numbers, or as digits in old files.
    """
    flags = next((file[name + end] for end in ("_QC", "_qc") if name + end in file.variables), None)
    if flags is None or flags.dimensions != file[name].dimensions:
        return None
    stored = flags[...]
    if stored.dtype.kind == "S":
        stored = np.where(np.char.isdigit(stored), stored, b"-1").astype(np.int64)
    if stored.dtype.kind not in "iuf":
        return None
    numbers = np.atleast_1d(stored).astype(np.float64)
    return np.where((numbers >= 0) & (numbers <= 9), numbers, -1).astype(np.int64)


def fault_of(told: Mapping[str, Any], channel: str) -> str:
    """Why a variable with these attributes cannot be read as a channel, and what is needed; "" where it can."""
    unit = _unit(told, channel)
    if conversion(unit, channel) is None:
        says = f"the unit {unit!r} is not known for {channel}" if unit else f"no unit is told for {channel}"
        return f"{says}; known are {', '.join(units_of(channel))}"
    try:
        packing_of(told)
    except ValueError as fault:
        return str(fault)
    return ""


def _unit(told: Mapping[str, Any], channel: str) -> str:
    return str(told.get("units", "")).strip() or UNITLESS.get(channel, "")


def values_of(file: Any, name: str, channel: str, warnings: list[str], bad: Mapping[int, str] = BAD) -> Values | None:
    """The values of a variable as a channel; None, with a warning, where its unit or its packing is not known.

    What is left out, apart from blanks, is counted in a warning. bad : flags of what is left out, and their meanings.
    A unit that need not be told (UNITLESS) is taken, with a warning.
    """
    variable = file[name]
    told = attributes(variable)
    unit, fault = _unit(told, channel), fault_of(told, channel)
    to_si = conversion(unit, channel)
    if to_si is None or fault:
        warnings.append(f"{name}: left out, {fault}")
        return None
    if not str(told.get("units", "")).strip():
        taken = "practical salinity, which has none" if channel == "salinity" else f"{unit} of {channel}"
        warnings.append(f"{name}: no unit is told, taken as {taken}")
    packing = packing_of(told)
    warnings += [f"{name}: {note}" for note in packing.notes]
    stored = np.atleast_1d(variable[...])
    good = ~np.isnan(stored)
    good &= ~_counted(name, np.isinf(stored), "infinite left out", warnings)
    for key in ("_FillValue", "missing_value"):
        good &= ~np.isin(stored, np.atleast_1d(told.get(key, np.nan)))
    good &= ~_counted(name, good & ~_valid(stored, told), "outside the file's own valid range left out", warnings)
    flags = flags_of(file, name)
    if flags is not None:
        for flag, meaning in bad.items():
            why = f"flagged {flag} ({meaning}) left out"
            good &= ~_counted(name, good & (flags == flag), why, warnings)
        _counted(name, good & (flags == CHANGED), f"flagged {CHANGED} (changed by its publisher) kept", warnings)
    bounded = np.clip(stored.astype(np.float64), -LARGEST, LARGEST)
    values = bounded * packing.factor + packing.offset
    sign = -1.0 if channel == "depth" and str(told.get("positive", "")).lower() == "up" else 1.0
    values = sign * (values * to_si.factor + to_si.offset)
    origin: Origin = "derived" if channel in COMPUTED or _is_computed(told) else "measured"
    return Values(name, np.where(good, values, np.nan), origin)


def stored_numbers(variable: Any, packing: Packing) -> Array:
    """The numbers of a variable, unpacked, (n,), NaN where there is none."""
    told, stored = attributes(variable), np.atleast_1d(variable[...])
    missing = [np.atleast_1d(told[key]) for key in ("_FillValue", "missing_value") if key in told]
    blank = np.isinf(stored) | np.isin(stored, np.concatenate(missing) if missing else [])
    values = np.clip(stored.astype(np.float64), -LARGEST, LARGEST)
    return np.where(blank, np.nan, values * packing.factor + packing.offset)


def _valid(stored: NDArray[Any], told: dict[str, Any]) -> NDArray[np.bool_]:
    """Whether values lie in valid_min to valid_max, or valid_range; bounds that are no numbers do not count."""
    both = np.atleast_1d(told.get("valid_range", ()))
    low = told.get("valid_min", both[0] if len(both) == 2 else -np.inf)
    high = told.get("valid_max", both[1] if len(both) == 2 else np.inf)
    try:
        return (stored >= float(low)) & (stored <= float(high))
    except (TypeError, ValueError):
        return np.ones(stored.shape, dtype=bool)


def _counted(name: str, which: NDArray[np.bool_], what: str, warnings: list[str]) -> NDArray[np.bool_]:
    """The mask itself; how many it marks goes into a warning."""
    if count := int(which.sum()):
        warnings.append(f"{name}: {count} values {what}")
    return which


def _is_computed(told: dict[str, Any]) -> bool:
    """Whether attributes say that values were calculated or interpolated ("calulated" stands in pyglider's files)."""
    kind, method, comment = (str(told.get(key, "")).lower() for key in ("observation_type", "method", "comment"))
    made = kind.startswith(("calc", "calul", "deriv", "estim", "interp"))
    return made or "linear" in method or "interpol" in method or "interpolated" in comment
