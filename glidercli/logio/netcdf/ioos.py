"""What does an IOOS glider file hold? A profile in each file, or a whole deployment (pyglider's L0 time series).

Names, dimension and flags: IOOS_Glider_NetCDF_v2.0 and v3.0 (ioos/ioosngdac, nc/template/*.cdl and its wiki).

    time, depth, pressure, temperature, conductivity, salinity, density   by row; units as each variable says
    pitch, roll, heading            where a group adds them
    lat, lon (latitude, longitude)  of each row: "interpolated latitude at each point in the time-series". They count as
                                    fixes only where flags tell them from interpolated ones (lat_qc 1 or 2 beside 8);
                                    else these, or the middle of the profile, are the place for absolute salinity alone
    profile_lat, profile_lon        the middle of the profile
    u, v at time_uv                 depth-averaged current, an estimate over one or more dives: told as an event, for
                                    it is not the current where the glider was
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from glidercli.errors import InputError
from glidercli.log import Event
from glidercli.logio.netcdf.pyglider import is_pyglider, read_with_attitude
from glidercli.logio.netcdf.times import times_of
from glidercli.logio.netcdf.trajectory import Positions, Rows, faults_in, near_of, part_of, unread_in
from glidercli.logio.netcdf.variables import attributes, flags_of, text_of, values_of
from glidercli.logio.netcdf.vocabulary import STANDARD_NAMES
from glidercli.logio.reader import Aids, Part
from glidercli.logio.records import NO_TIME
from glidercli.netcdf_opening import holds, opened, rows_of

__all__ = ["is_ioos", "read_ioos"]

DIMENSION = "time"
NAMES = {
    name: (name,)
    for name in (
        "depth", "pressure", "temperature", "conductivity", "salinity", "absolute_salinity",
        "conservative_temperature", "density", "pitch", "roll", "heading",
    )
}  # fmt: skip
PLACES = (("lat", "lon"), ("latitude", "longitude"))
MIDDLE = ("profile_lat", "profile_lon")


def _is_ioos(file: Any) -> bool:
    named = text_of(file, "format_version").startswith("IOOS_Glider_NetCDF") or is_pyglider(file)
    profile = "profile_id" in file.variables and any(set(pair) <= file.variables.keys() for pair in PLACES)
    return DIMENSION in file.dimensions and DIMENSION in file.variables and (named or profile)


def is_ioos(path: Path) -> bool:
    """Whether the file is NetCDF of the IOOS glider format, or a time series of pyglider."""
    return holds(path, _is_ioos)


def read_ioos(path: Path, aids: Aids = Aids()) -> Part:
    """One file, a profile or a deployment; a record is a row along time.

    Raises InputError for a file of another kind, a grid of profiles, one that is damaged, and times that cannot be
    told.
    """
    with opened(path) as file:
        if not _is_ioos(file):
            raise InputError(path, "is no IOOS glider file: its format_version, or profile_id and lat, lon, are needed")
        if file[DIMENSION].dimensions != (DIMENSION,) or {"depth", "DEPTH"} & file.dimensions.keys():
            raise InputError(path, "is a grid of profiles; the measurements along time are needed")
        count = rows_of(path, file, DIMENSION)
        warnings: list[str] = []
        metadata = _metadata(file)
        found = read_with_attitude(file, DIMENSION, NAMES, metadata, warnings)
        time_ns = times_of(path, file[DIMENSION])
        positions = _positions(file, time_ns, count, warnings)
        near = next((place for pair in PLACES if (place := near_of(file, time_ns, pair)) is not None), None)
        near = near or near_of(file, time_ns[:1], MIDDLE)
        unread = unread_in(file, DIMENSION, found)
        faults = faults_in(file, DIMENSION, NAMES, STANDARD_NAMES)
        rows = Rows(time_ns, found, positions, metadata, warnings, _current(path, file), near, unread, faults)
        profile = _profile(file)
    trajectory = metadata.get("trajectory", "")
    return part_of(path, "ioos", rows, (f"ioos.{trajectory}.{profile}",) if trajectory and profile else ())


def _metadata(file: Any) -> dict[str, str]:
    """Which vehicle, which deployment."""
    of_variable = attributes(file["platform"]) if "platform" in file.variables else {}
    serial = text_of(file, "glider_serial")
    known = [str(of_variable.get("id", "")).strip(), text_of(file, "glider_name"), serial]
    told = {
        "platform": next((name for name in known if name), ""),
        "wmo_id": str(of_variable.get("wmo_id", "")).strip() or text_of(file, "wmo_id"),
        "trajectory": text_of(file, "deployment_name") or text_of(file, "trajectory"),
    }
    told["title"] = f"{told['platform'] or told['trajectory'] or 'glider'} log (IOOS glider format)"
    return {key: text for key, text in told.items() if text}


def _profile(file: Any) -> str:
    """The number of the profile; "" where the file holds several, or does not tell."""
    if "profile_id" not in file.variables or file["profile_id"].dimensions:
        return ""
    return str(int(file["profile_id"][...])) if file["profile_id"].dtype != str else text_of(file, "profile_id")


def _positions(file: Any, time_ns: Any, count: int, warnings: list[str]) -> Positions | None:
    """Positions that flags tell from interpolated ones; None where all may be interpolated."""
    pair = next((p for p in PLACES if all(n in file.variables and file[n].dimensions == (DIMENSION,) for n in p)), None)
    if pair is None:
        return None
    names = ", ".join(pair)
    flags = [flag for name in pair if (flag := flags_of(file, name)) is not None and (flag == 8).any()]
    if len(flags) < len(pair):
        warnings.append(f"{names}: {count} positions left out, interpolated between fixes and not measured")
        return None
    sure = np.all([np.isin(flag, (1, 2)) for flag in flags], axis=0)
    latitude, longitude = (values_of(file, n, c, warnings) for n, c in zip(pair, PLACES[1], strict=True))
    if latitude is None or longitude is None:
        return None
    return Positions(names, time_ns, np.where(sure, latitude.values, np.nan), np.where(sure, longitude.values, np.nan))


def _current(path: Path, file: Any) -> tuple[Event, ...]:
    """The depth-averaged current, as an event at its time; none where it is missing."""
    if not {"u", "v", "time_uv"} <= file.variables.keys() or any(file[n].size != 1 for n in ("u", "v", "time_uv")):
        return ()
    east, north = (values_of(file, name, f"current_{way}", []) for name, way in (("u", "east"), ("v", "north")))
    if east is None or north is None or not np.isfinite([east.values[0], north.values[0]]).all():
        return ()
    (time_ns,) = times_of(path, file["time_uv"])
    words = f"depth-averaged current {east.values[0]:.3f} m/s east, {north.values[0]:.3f} m/s north"
    return () if time_ns == NO_TIME else (Event(words, int(time_ns)),)
