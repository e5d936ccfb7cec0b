"""Which channels do the columns of a SeaExplorer file hold? Units, signs, and which cells are left out, and why.

Cells arrive as numbers: NaN where blank, infinite where the text is no number, 9999 or -9999 where the vehicle says
that it has no value. Whatever is left out, apart from blanks, is counted in a warning.

Signs and units as brought to channels.py:

    Pitch       nose up positive, as recorded (on dives it is negative).
    LinPos      mm, forward positive: the battery stands further forward on dives. The actuator's own zero is kept.
    AngPos      deg; recorded roll follows it with the same sign (correlation 0.99 over six dives of sea035). The
                model's rotation moves the mass to port and gives negative roll, so mass_rotation = -AngPos.
    BallastPos  cm3 of oil outside the hull, floating positive.
    Lat, Lon    ddmm.mmm, repeated under water: a fix counts where it changes at the surface (NavState 116).
    Heading     from true north, as recorded; Declination is not added. A file with DeadReckoning = 1 shows in Lat, Lon
                the vehicle's own dead reckoning: in five files of sea063 it runs along Heading to within 0.7 deg,
                where Declination is 6 deg. The fixes of sea035 cannot tell: over five dives the depth-averaged current
                scatters by 0.030 m/s whether its 16 deg are added or not.
    LEGATO_CONDUCTIVITY is in mS/cm, GPCTD_CONDUCTIVITY in S/m.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.log import Channel
from glidercli.logio.quantities import Quantity, channels_from, degrees, without_sentinels
from glidercli.logio.whereabouts import Whereabouts, whereabouts
from glidercli.units import CM3, DBAR, DEGREE, MILLIMETRE

__all__ = ["NOTES", "SENTINELS", "USED", "channels_of", "impossible_places", "near_of"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

SENTINELS = (9999.0, -9999.0)
AT_SURFACE = 116


COLUMNS = {
    "Heading": Quantity("heading", DEGREE, 0.0, 360.0, "deg"),
    "Pitch": Quantity("pitch", DEGREE, -90.0, 90.0, "deg"),
    "Roll": Quantity("roll", DEGREE, -180.0, 180.0, "deg"),
    "Depth": Quantity("depth", 1.0, -5.0, 1500.0, "m"),
    "BallastPos": Quantity("ballast_volume", CM3, -1000.0, 1000.0, "cm3"),
    "LinPos": Quantity("mass_position", MILLIMETRE, -200.0, 200.0, "mm"),
    "AngPos": Quantity("mass_rotation", -DEGREE, -180.0, 180.0, "deg"),
    "GPCTD_TEMPERATURE": Quantity("temperature", 1.0, -3.0, 45.0, "degC"),
    "GPCTD_CONDUCTIVITY": Quantity("conductivity", 1.0, 0.0, 7.5, "S/m"),
    "GPCTD_PRESSURE": Quantity("pressure", DBAR, -2.0, 1500.0, "dbar"),
    "LEGATO_TEMPERATURE": Quantity("temperature", 1.0, -3.0, 45.0, "degC"),
    "LEGATO_CONDUCTIVITY": Quantity("conductivity", 0.1, 0.0, 75.0, "mS/cm"),
    "LEGATO_PRESSURE": Quantity("pressure", DBAR, -2.0, 1500.0, "dbar"),
}
USED = (*COLUMNS, "NavState", "Lat", "Lon")
"""Columns that channels are taken from."""
PLACES = (("Lat", "Lon"), ("NAV_LATITUDE", "NAV_LONGITUDE"))
"""Positions of navigation and of payload files, which repeat them."""
NOTES = {
    "mass_position_zero": "the actuator's own zero (LinPos), not the model's",
    "mass_rotation_note": "mass_rotation = -AngPos: recorded roll follows AngPos, the model's rotation opposes it",
    "heading_note": "taken as recorded, from true north; Declination is not added: where a file shows the vehicle's "
    "own dead reckoning (sea063) it runs along the recorded heading to within 0.7 deg, Declination being 6 deg; the "
    "GPS fixes of sea035 cannot tell",
    "phase_note": "from the recorded NavState: 100 dive, 117 climb, 110 and 118 inflection, 115 and 116 surface",
}
"""What a reader of the channels should know, as metadata of the log."""
CTDS = ("GPCTD", "LEGATO")
PHASE_OF_STATE = {100: "dive", 117: "climb", 110: "inflection", 118: "inflection", 115: "surface", 116: "surface"}


def channels_of(time_ns: Times, table: Mapping[str, Array]) -> tuple[list[Channel], list[str]]:
    """The channels of a table, and a warning for each kind of cell left out.

    time_ns : (n,) UTC ns, strictly increasing. table : cells as recorded, (n,) each, by column name.
    """
    warnings: list[str] = []
    used = {name: without_sentinels(name, table[name], SENTINELS, warnings) for name in USED if name in table}
    _without_zeros(used, warnings)
    channels = list(channels_from(time_ns, used, COLUMNS, warnings).values())
    if "NavState" in used:
        channels.append(_phase(time_ns, used["NavState"], warnings))
    if {"NavState", "Lat", "Lon"} <= used.keys():
        channels += _fixes(time_ns, used, warnings)
    return [channel for channel in channels if len(channel)], warnings


def _without_zeros(used: dict[str, Array], warnings: list[str]) -> None:
    """Take out what a CTD tells when it did not sample: temperature, conductivity and pressure all exactly zero."""
    for ctd in CTDS:
        names = [f"{ctd}_{quantity}" for quantity in ("TEMPERATURE", "CONDUCTIVITY", "PRESSURE")]
        if not set(names) <= used.keys():
            continue
        idle = np.all([used[name] == 0.0 for name in names], axis=0)
        if idle.any():
            warnings.append(f"{ctd}: {int(idle.sum())} samples of zeros alone left out")
            used |= {name: np.where(idle, np.nan, used[name]) for name in names}


def _phase(time_ns: Times, state: Array, warnings: list[str]) -> Channel:
    """Phase, derived from the navigation state."""
    phase = np.full(len(state), np.nan)
    for number, word in PHASE_OF_STATE.items():
        phase[state == number] = PHASES.index(word)
    known = np.isfinite(phase)
    other = state[np.isfinite(state) & ~known]
    if len(other):
        states = ", ".join(f"{number:g}" for number in np.unique(other))
        warnings.append(f"NavState: {len(other)} values left out that are no phase of flight ({states})")
    return Channel("phase", time_ns[known], phase[known], "derived")


def _fixes(time_ns: Times, used: Mapping[str, Array], warnings: list[str]) -> list[Channel]:
    """Genuine GPS fixes: where the position changes at the surface; 0, 0 is none."""
    latitude, longitude = degrees(used["Lat"]), degrees(used["Lon"])
    given = np.isfinite(used["Lat"]) | np.isfinite(used["Lon"])
    impossible = impossible_places(used)
    rows = np.flatnonzero(given & ~impossible)
    changed = np.zeros(len(time_ns), dtype=bool)
    changed[rows[1:]] = (np.diff(latitude[rows]) != 0.0) | (np.diff(longitude[rows]) != 0.0)
    fix = changed & (used["NavState"] == AT_SURFACE)
    if count := int(impossible.sum()):
        warnings.append(
            f"Lat, Lon: {count} impossible values left out: beyond 90 or 180 deg, 60 minutes or more, 0 in both, or "
            "one without the other"
        )
    if others := int((given & ~impossible & ~fix).sum()):
        warnings.append(f"Lat, Lon: {others} values left out that are no new fix at the surface, {int(fix.sum())} kept")
    return [Channel("latitude", time_ns[fix], latitude[fix]), Channel("longitude", time_ns[fix], longitude[fix])]


def impossible_places(table: Mapping[str, Array]) -> NDArray[np.bool_]:
    """Where Lat, Lon hold what is no position, (n,); false where both are blank or sentinels, or the file has none."""
    if not {"Lat", "Lon"} <= table.keys():
        return np.zeros(len(next(iter(table.values()), ())), dtype=bool)
    told = [np.where(np.isfinite(table[n]) & ~np.isin(table[n], SENTINELS), table[n], np.nan) for n in ("Lat", "Lon")]
    latitude, longitude = (degrees(values) for values in told)
    place = (np.abs(latitude) <= 90.0) & (np.abs(longitude) <= 180.0) & ((latitude != 0.0) | (longitude != 0.0))
    return np.asarray(np.isfinite(told).any(axis=0) & ~place)


def near_of(time_ns: Times, table: Mapping[str, Array]) -> Whereabouts | None:
    """Where the vehicle took itself to be, by ``channels_of``'s arguments; None where the file does not tell."""
    names = next((pair for pair in PLACES if table.keys() >= set(pair)), None)
    if names is None:
        return None
    ddmm = [np.where(np.isin(table[name], SENTINELS), np.nan, table[name]) for name in names]
    latitude, longitude = (degrees(value) for value in ddmm)
    return whereabouts(time_ns, latitude, longitude)
