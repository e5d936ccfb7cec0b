"""What of the water does a .nc tell, and how far is it trusted? Its raw values are measured, its products derived.

temperature_raw and conductivity_raw are the sensors' values by their calibration; salinity, absolute salinity,
conservative temperature and density are what the basestation made of them, corrected for thermal inertia.
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
CTD = {name: name for name in (*RAW, *PROCESSED, "speed", "ctd_pressure")}
QUALITY = {
    "temperature_raw": "temperature_raw_qc",
    "conductivity_raw": "conductivity_raw_qc",
    **dict.fromkeys(PROCESSED, "salinity_qc"),
    "speed": "speed_qc",
}
TRUSTED = ("0", "1", "2", "5")
FLAGS = {"3": "probably bad", "4": "bad", "6": "unsampled", "8": "interpolated", "9": "missing"}
"""Of the basestation's quality flags 0 to 9 those that are not trusted."""
NOTES = {
    "salinity": "temperature and conductivity are the raw ones; salinity, absolute salinity, conservative temperature "
    "and density are the basestation's, corrected for thermal inertia (derived)",
    "speed": "speed_through_water is that of the basestation's flight model (derived, not measured)",
}


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


def ctd_channels(time_ns: Times, table: Mapping[str, Array], warnings: list[str]) -> list[Channel]:
    """The channels of the CTD, and the speed of the flight model that stands at its times."""
    channels = [channel_of(name, time_ns, table[name], RAW[name], warnings) for name in RAW if name in table]
    if "ctd_pressure" in table:
        pressure = channel_of("ctd_pressure", time_ns, table["ctd_pressure"], SEA["pressure"], warnings)
        channels = [submerged(c, pressure, warnings) if c.name == "conductivity" else c for c in channels]
    for name, quantity in {**PROCESSED, "speed": SPEED}.items():
        if name in table:
            channels.append(channel_of(name, time_ns, table[name], quantity, warnings, "derived"))
    return channels
