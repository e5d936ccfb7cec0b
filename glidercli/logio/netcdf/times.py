"""When was each record? Times "UNIT since DATE" as integers, UTC ns, exact as far as the stored numbers are."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.logio.records import NO_TIME, YEARS

__all__ = ["ticks", "times_of", "zero_and_unit"]

Times = NDArray[np.int64]

UNITS = {
    "nanoseconds": 1, "nanosecond": 1, "ns": 1,
    "microseconds": 10**3, "microsecond": 10**3, "us": 10**3,
    "milliseconds": 10**6, "millisecond": 10**6, "msec": 10**6, "ms": 10**6,
    "seconds": 10**9, "second": 10**9, "sec": 10**9, "secs": 10**9, "s": 10**9,
    "minutes": 60 * 10**9, "minute": 60 * 10**9, "min": 60 * 10**9, "mins": 60 * 10**9,
    "hours": 3600 * 10**9, "hour": 3600 * 10**9, "hr": 3600 * 10**9, "h": 3600 * 10**9,
    "days": 86400 * 10**9, "day": 86400 * 10**9, "d": 86400 * 10**9,
}  # fmt: skip
"""ns in a unit, by the names that UDUNITS knows them by."""
CALENDARS = ("standard", "gregorian", "proleptic_gregorian")
FIRST, LAST = (int(np.datetime64(year, "ns").astype(np.int64)) for year in YEARS)
"""Times allowed, ns: 64 bits hold little more."""


def zero_and_unit(text: str, calendar: str = "proleptic_gregorian") -> tuple[int, int]:
    """Of "seconds since 1970-01-01T00:00:00Z": the date as UTC ns since 1970, of any size, and the ns in a unit.

    calendar : of CALENDARS; that of CF, "standard", is Julian before 1582-10-15.

    Raises ValueError, with what is allowed, where the text is of another form.
    """
    import cftime

    parts = re.fullmatch(r"\s*(\w+)\s+since\s+(.*?)\s*", text, re.IGNORECASE | re.DOTALL)
    if parts is None or parts[1].lower() not in UNITS:
        raise ValueError(f"{text!r} is no unit of times; needed is like 'seconds since 1970-01-01T00:00:00Z'")
    fraction = re.search(r":\d\d\.(\d+)", parts[2])
    whole = parts[2].replace(f".{fraction[1]}", "", 1) if fraction else parts[2]
    try:
        date = cftime.num2date(0, f"seconds since {whole}", calendar)
        zero = int(cftime.date2num(date, "seconds since 1970-01-01", calendar)) * 10**9
    except (ValueError, OverflowError, TypeError):
        raise ValueError(f"{parts[2]!r} is no date; needed is like 1970-01-01T00:00:00Z") from None
    return zero + (int(fraction[1][:9].ljust(9, "0")) if fraction else 0), UNITS[parts[1].lower()]


def ticks(values: NDArray[Any], zero_ns: int, unit_ns: int) -> Times:
    """UTC ns of counted units, (n,); NO_TIME where not finite or outside the years 1700 to 2200.

    Integers are exact. Of floats the whole units are exact and the rest is rounded to the ns, which is as near as the
    stored number itself is: 2.4e-7 s for seconds since 1970.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        rough = values.astype(np.float64) * unit_ns + float(zero_ns)
    told = (rough > FIRST) & (rough < LAST)  # false where it is NaN
    time_ns = np.full(len(values), NO_TIME)
    since, zero = divmod(zero_ns, unit_ns)  # units from 1970 to the zero, which may be more ns than 64 bits hold
    if abs(since) >= 1 << 62:
        return time_ns
    good = values[told]
    if good.dtype.kind in "iu":
        time_ns[told] = zero + (good.astype(np.int64) + since) * unit_ns
    else:
        whole = np.floor(good.astype(np.float64))
        rest = np.rint((good - whole) * unit_ns).astype(np.int64)
        time_ns[told] = zero + (whole.astype(np.int64) + since) * unit_ns + rest
    return time_ns


def times_of(path: Path, variable: Any) -> Times:
    """The times of a variable, (n,), UTC ns; NO_TIME where it has none. Raises InputError for units that tell none."""
    name = variable.name
    told = {key: variable.getncattr(key) for key in variable.ncattrs()}
    calendar = str(told.get("calendar", "standard")).lower()
    if calendar not in CALENDARS:
        raise InputError(path, f"{name} counts in the calendar {calendar}; allowed: {', '.join(CALENDARS)}")
    if variable.dtype == str or variable.dtype.kind not in "iuf" or len(variable.dimensions) > 1:
        raise InputError(path, f"{name} is no column of numbers; times of records are needed")
    try:
        zero_ns, unit_ns = zero_and_unit(str(told.get("units", "")), calendar)
    except ValueError as fault:
        raise InputError(path, f"{name}: {fault}") from None
    stored = np.atleast_1d(variable[...])
    missing = np.isin(stored, [told[key] for key in ("_FillValue", "missing_value") if key in told])
    return np.where(missing, NO_TIME, ticks(stored, zero_ns, unit_ns))
