"""Which reader does a file of water or current need? Told by its content."""

from __future__ import annotations

from pathlib import Path

from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.ocean.cast import EXPECTED, Cast
from glidercli.ocean.current import CurrentProfile
from glidercli.ocean.kind import AD2CP, NETCDF, PD0, TEXT, kind_of
from glidercli.ocean.table_profiles import table_currents, text_casts

__all__ = ["read_casts", "read_currents"]


def read_casts(path: str | Path, latitude: float | None = None, longitude: float | None = None) -> tuple[Cast, ...]:
    """The casts of a .cnv file, a table or a NetCDF file. latitude, longitude : deg, for a file without its own."""
    path = Path(path)
    kind = kind_of(readable_file(path))
    if kind == NETCDF:
        from glidercli.ocean.netcdf_profiles import netcdf_casts

        return netcdf_casts(path, latitude, longitude)
    if kind != TEXT:
        raise InputError(path, f"is a {kind} file, which holds current, not water; {EXPECTED}")
    return text_casts(path, latitude, longitude)


def read_currents(path: str | Path, latitude: float | None = None) -> tuple[CurrentProfile, ...]:
    """The current profiles of a table, a NetCDF file or an ADCP's binary.

    latitude : deg, of the flight, where a depth comes from a pressure.
    """
    path = Path(path)
    kind = kind_of(readable_file(path))
    if kind == NETCDF:
        from glidercli.ocean.netcdf_profiles import netcdf_currents

        return netcdf_currents(path, latitude)
    if kind in (PD0, AD2CP):
        from glidercli.ocean.adcp_file import adcp_currents

        return adcp_currents(path, kind, latitude)
    return table_currents(path)
