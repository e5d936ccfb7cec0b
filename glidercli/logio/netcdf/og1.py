"""What does an OceanGliders 1.0 file (OG1) hold? One mission: a row for each measurement and for each GPS fix.

Names, dimension and meanings: OceanGliders format v1.0.0 (OceanGlidersCommunity/OG-format-user-manual,
OG_Format-v1.0.0.adoc); PHASE: its vocabularyCollection/phase.md; GLIDER_PITCH and the like: its examples of 2024.

    TIME, DEPTH, PRES, TEMP, CNDC, PSAL, PITCH, ROLL, HEADING ...   by row; units as each variable says
    LATITUDE, LONGITUDE             of each measurement: interpolated between fixes: the place for absolute
                                    salinity where there is no fix, and no more
    TIME_GPS, LATITUDE_GPS, LONGITUDE_GPS   the fixes; a file without TIME_GPS has their times in TIME
    PITCH_CTL, ROLL_CTL, VBD_CC     of a Seaglider (seaglider_controls.py)
    PHASE                           1 ascent, 2 descent, 3 surfacing, 4 parking; others are no phase of flight here

Pitch is nose up positive and roll starboard down positive, as recorded: in sg033_20100903 pitch is -17 deg (median)
in phase 2 and depth grows; it is +19 deg in phase 1.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from glidercli.channels import PHASES
from glidercli.errors import InputError
from glidercli.logio.netcdf.pyglider import read_with_attitude
from glidercli.logio.netcdf.seaglider_controls import CONTROL_NAMES, controls
from glidercli.logio.netcdf.times import times_of
from glidercli.logio.netcdf.trajectory import Positions, Rows, faults_in, near_of, part_of, unread_in
from glidercli.logio.netcdf.variables import Values, attributes, text_of, values_of
from glidercli.logio.netcdf.vocabulary import STANDARD_NAMES
from glidercli.logio.reader import Aids, Part
from glidercli.logio.records import NO_TIME
from glidercli.netcdf_opening import holds, opened, rows_of

__all__ = ["is_og1", "read_og1"]

DIMENSION = "N_MEASUREMENTS"
NAMES = {
    "depth": ("DEPTH", "GLIDER_DEPTH"),
    "pressure": ("PRES",),
    "temperature": ("TEMP",),
    "conductivity": ("CNDC",),
    "salinity": ("PSAL",),
    "absolute_salinity": ("SA",),
    "conservative_temperature": ("CT",),
    "density": ("DENSITY",),
    "pitch": ("PITCH", "GLIDER_PITCH"),
    "roll": ("ROLL", "GLIDER_ROLL"),
    "heading": ("HEADING", "GLIDER_HEADING"),
}
PHASE_OF = {1: "climb", 2: "dive", 3: "surface", 4: "hover"}


def is_og1(path: Path) -> bool:
    """Whether the file is NetCDF with the dimension and the time of OceanGliders 1.0."""
    return holds(path, lambda file: DIMENSION in file.dimensions and "TIME" in file.variables)


def read_og1(path: Path, aids: Aids = Aids()) -> Part:
    """One OG1 file; a record is a row of N_MEASUREMENTS.

    Raises InputError for a file of another kind, one that is damaged, and times that cannot be told.
    """
    with opened(path) as file:
        if DIMENSION not in file.dimensions or "TIME" not in file.variables:
            raise InputError(path, f"has no variable TIME along {DIMENSION}; OceanGliders 1.0 (OG1) is needed")
        count = rows_of(path, file, DIMENSION)
        if file["TIME"].dimensions != (DIMENSION,):
            raise InputError(path, f"TIME is along {file['TIME'].dimensions}; along {DIMENSION} is needed")
        warnings: list[str] = []
        metadata = _metadata(file)
        found = read_with_attitude(file, DIMENSION, NAMES, metadata, warnings, CONTROL_NAMES)
        found |= controls(file, DIMENSION, metadata.get("platform_model", ""), metadata, warnings)
        _tell_of_heading(file, found, metadata, warnings)
        if "PHASE" in file.variables and file["PHASE"].dimensions == (DIMENSION,):
            found["phase"] = _phase(file, warnings)
        _tell_of_positions(file, count, warnings)
        time_ns = times_of(path, file["TIME"])
        near = near_of(file, time_ns, ("LATITUDE", "LONGITUDE"))
        unread = unread_in(file, DIMENSION, found)
        faults = faults_in(file, DIMENSION, NAMES, STANDARD_NAMES)
        positions = _positions(path, file, warnings)
        rows = Rows(time_ns, found, positions, metadata, warnings, near=near, unread=unread, faults=faults)
        trajectory = text_of(file, "TRAJECTORY")
    return part_of(path, "og1", rows, (f"og1.{trajectory}",) if trajectory else ())


def _metadata(file: Any) -> dict[str, str]:
    """Which vehicle, which mission."""
    told = {
        "platform": text_of(file, "PLATFORM_SERIAL_NUMBER"),
        "platform_model": text_of(file, "PLATFORM_MODEL"),
        "wmo_id": text_of(file, "WMO_IDENTIFIER"),
        "trajectory": text_of(file, "TRAJECTORY") or text_of(file, "id"),
    }
    told["title"] = f"{told['platform'] or told['trajectory'] or 'glider'} log (OceanGliders 1.0)"
    return {key: text for key, text in told.items() if text}


def _phase(file: Any, warnings: list[str]) -> Values:
    """Phase, derived by whoever published the file."""
    told = attributes(file["PHASE"])
    stored = np.atleast_1d(file["PHASE"][...]).astype(np.float64)
    given = np.isfinite(stored) & ~np.isin(stored, [0.0, *np.atleast_1d(told.get("_FillValue", np.nan))])
    values = np.full(len(stored), np.nan)
    for number, word in PHASE_OF.items():
        values[given & (stored == number)] = PHASES.index(word)
    if other := int((given & np.isnan(values)).sum()):
        warnings.append(
            f"PHASE: {other} values left out that are no phase of flight (inflexion, propelled, transition)"
        )
    return Values("PHASE", values, "derived")


def _tell_of_heading(file: Any, found: dict[str, Values], metadata: dict[str, str], warnings: list[str]) -> None:
    """That a heading stays from magnetic north, where the file says that it is."""
    name = found["heading"].name if "heading" in found else ""
    told = attributes(file[name]) if name else {}
    if any("magnetic" in str(told.get(key, "")).lower() for key in ("comment", "long_name", "standard_name")):
        warnings.append(f"{name}: {np.isfinite(found['heading'].values).sum()} values stay from magnetic north")
        metadata["heading_note"] = f"from magnetic north, {name} as recorded: the file tells no magnetic variation"


def _tell_of_positions(file: Any, count: int, warnings: list[str]) -> None:
    """What is not used of the positions."""
    if {"LATITUDE", "LONGITUDE"} <= file.variables.keys():
        warnings.append(f"LATITUDE, LONGITUDE: {count} positions left out, interpolated between fixes and not measured")


def _positions(path: Path, file: Any, warnings: list[str]) -> Positions | None:
    """The GPS variables; None without them."""
    names = ("LATITUDE_GPS", "LONGITUDE_GPS")
    if not all(n in file.variables and file[n].dimensions == (DIMENSION,) for n in names):
        return None
    latitude, longitude = (values_of(file, n, n.split("_")[0].lower(), warnings) for n in names)
    if latitude is None or longitude is None:
        return None
    time_ns = times_of(path, file["TIME"])
    if "TIME_GPS" in file.variables and file["TIME_GPS"].dimensions == (DIMENSION,):
        of_fix = times_of(path, file["TIME_GPS"])
        time_ns = np.where(of_fix == NO_TIME, time_ns, of_fix)
    return Positions(", ".join(names), time_ns, latitude.values, longitude.values)
