"""What of the water does a .nc tell, and how far is it trusted? Its raw values are measured, its products derived.

temperature_raw and conductivity_raw are the sensors' values by their calibration; salinity, absolute salinity,
conservative temperature are what the basestation made of them, corrected for thermal inertia. density_insitu is left
out: it stays within 0.01 kg/m3 of the potential density where pressure adds 0.4 kg/m3 (97 dbar, sg561) to 3.2 kg/m3
(706 dbar, sg249). Density is computed here instead, by TEOS-10.
A value counts where its quality flag (one character, flag_meanings in the file) says good, probably good, changed or
nothing; what the basestation interpolated is left out, as is what it calls bad.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel
from glidercli.logio.quantities import Quantity, channel_of, submerged
from glidercli.logio.seaglider.columns import PROCESSED, RAW, SEA
from glidercli.logio.seaglider.netcdf_file import NetcdfFile
from glidercli.units import CENTIMETRE

__all__ = ["CTD", "NOTES", "ctd_channels", "without_bad"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

SPEED = Quantity("speed_through_water", CENTIMETRE, 0.0, 200.0, "cm/s")
CTD = {name: name for name in (*RAW, *PROCESSED, "temperature", "speed", "ctd_pressure")}
QUALITY = {
    "temperature_raw": "temperature_raw_qc",
    "conductivity_raw": "conductivity_raw_qc",
    **dict.fromkeys(PROCESSED, "salinity_qc"),
    "temperature": "temperature_qc",
    "speed": "speed_qc",
}
TRUSTED = ("0", "1", "2", "5")
FLAGS = {"3": "probably bad", "4": "bad", "6": "unsampled", "8": "interpolated", "9": "missing"}
"""Of the basestation's quality flags 0 to 9 those that are not trusted."""
NOTES = {
    "salinity": (
        "salinity",
        "temperature and conductivity are the raw ones; salinity, absolute salinity and conservative temperature are "
        "the basestation's, corrected for thermal inertia (derived)",
    ),
    "density": (
        "ctd_pressure",
        "by TEOS-10 from the basestation's salinity and corrected temperature; its own density_insitu lacks the effect "
        "of pressure",
    ),
    "speed": ("speed", "speed_through_water is that of the basestation's flight model (derived, not measured)"),
}
"""What to know of a channel, as (variable that it is taken from, note)."""


def without_bad(
    file: NetcdfFile, table: Mapping[str, Array], warnings: list[str], flags: str | None = None
) -> dict[str, Array]:
    """The table, NaN where a value's quality is not trusted; these are counted by flag.

    flags : name of the variable of flags for all columns; default: that of each column.
    """
    trusted = {}
    for name, values in table.items():
        quality = file.quality(flags or QUALITY.get(name, ""))
        if len(quality) != len(values):
            trusted[name] = values
            continue
        bad = np.isfinite(values) & ~np.isin(quality, TRUSTED)
        for flag in np.unique(quality[bad]):
            count = int((bad & (quality == flag)).sum())
            warnings.append(f"{name}: {count} values of quality {flag} ({FLAGS.get(str(flag), 'unknown')}) left out")
        trusted[name] = np.where(bad, np.nan, values)
    return trusted


def ctd_channels(
    time_ns: Times, table: Mapping[str, Array], place: tuple[float, float] | None, warnings: list[str]
) -> list[Channel]:
    """The channels of the CTD, and the speed of the flight model that stands at its times.

    place : longitude and latitude of the dive, deg, or None.
    """
    channels = [channel_of(name, time_ns, table[name], RAW[name], warnings) for name in RAW if name in table]
    if "ctd_pressure" in table:
        pressure = channel_of("ctd_pressure", time_ns, table["ctd_pressure"], SEA["pressure"], warnings)
        channels = [submerged(c, pressure, warnings) if c.name == "conductivity" else c for c in channels]
    for name, quantity in {**PROCESSED, "speed": SPEED}.items():
        if name in table:
            channels.append(channel_of(name, time_ns, table[name], quantity, warnings, "derived"))
    if {"salinity", "temperature", "ctd_pressure"} <= table.keys():
        channels.append(_density(time_ns, table, place))
    return channels


def _density(time_ns: Times, table: Mapping[str, Array], place: tuple[float, float] | None) -> Channel:
    """In-situ density, kg/m3, where salinity, temperature and pressure are plausible."""
    import gsw

    salinity, temperature, pressure = (table[name] for name in ("salinity", "temperature", "ctd_pressure"))
    good = (salinity >= 0.0) & (salinity <= 45.0) & (temperature >= -3.0) & (temperature <= 45.0)
    good &= (pressure >= -5.0) & (pressure <= 6700.0)
    practical, p = salinity[good], np.maximum(pressure[good], 0.0)
    absolute = gsw.SR_from_SP(practical) if place is None else gsw.SA_from_SP(practical, p, *place)
    density = gsw.rho_t_exact(absolute, temperature[good], p)
    known = np.isfinite(density)
    return Channel("density", time_ns[good][known], density[known], "derived")
