"""Which channels do the quantities of a Seaglider hold? Units, signs, and what of their values is impossible.

Signs and units, with what shows them in four dives of sg561 (tests/logio/test_seaglider_facts.py):

    pitchAng   deg, nose up positive: negative on dives.
    rollAng    deg, starboard down positive: starboard down turns to port on dives, to starboard on climbs, as a
               Seaglider does (heading rate per degree of roll -0.032 and +0.041 deg/s).
    head       deg, magnetic; true heading = head + magnetic variation (positive east): so is polar_heading of the .nc.
    pitchCtl   cm, the battery forward NEGATIVE: -7.6 at the surface, nose down; -0.6 diving, +0.6 climbing.
    rollCtl    deg; recorded roll is 0.59 of it, with the same sign. The model's rotation moves the mass to port and
               gives negative roll, so mass_rotation = -rollCtl.
    vbdCC      cm3 of oil outside the hull above the neutral C_VBD, floating positive.
    A/D counts (count - centre) x conversion with C_PITCH, PITCH_CNV (cm), C_ROLL_DIVE or C_ROLL_CLIMB, ROLL_CNV (deg),
               C_VBD, VBD_CNV (cm3) of the .log: within a count of pitchCtl, rollCtl and vbdCC.

The names of columns and variables are those of the Seaglider File Formats Manual (University of Washington, 66.12) and
of the basestation's .nc, read from the files themselves.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel
from glidercli.logio.quantities import Quantity, channel_of, without_sentinels
from glidercli.units import CENTIMETRE, CM3, DBAR, DEGREE

__all__ = ["CONTROLS", "DEPTH_CM", "ENGINEERING", "HEADING", "NOTES", "PROCESSED", "RAW", "SEA", "engineering", "fixes"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

HEADING = Quantity("heading", DEGREE, 0.0, 360.0, "deg")
DEPTH_CM = Quantity("depth", CENTIMETRE, -500.0, 650000.0, "cm")
CONTROLS = {
    "pitchCtl": Quantity("mass_position", -CENTIMETRE, -20.0, 20.0, "cm"),
    "rollCtl": Quantity("mass_rotation", -DEGREE, -180.0, 180.0, "deg"),
    "vbdCC": Quantity("ballast_volume", CM3, -1000.0, 1000.0, "cm3"),
}
ENGINEERING = {
    "pitchAng": Quantity("pitch", DEGREE, -90.0, 90.0, "deg"),
    "rollAng": Quantity("roll", DEGREE, -180.0, 180.0, "deg"),
    **CONTROLS,
}
SEA = {
    "depth": Quantity("depth", 1.0, -5.0, 6500.0, "m"),
    "pressure": Quantity("pressure", DBAR, -5.0, 6700.0, "dbar"),
}
RAW = {
    "temperature_raw": Quantity("temperature", 1.0, -3.0, 45.0, "degC"),
    "conductivity_raw": Quantity("conductivity", 1.0, 0.0, 7.5, "S/m"),
}
PROCESSED = {
    "salinity": Quantity("salinity", 1.0, 0.0, 45.0, "PSU"),
    "absolute_salinity": Quantity("absolute_salinity", 1.0, 0.0, 45.0, "g/kg"),
    "conservative_temperature": Quantity("conservative_temperature", 1.0, -3.0, 45.0, "degC"),
}
"""What the basestation computed."""

NOTES = {
    "mass_position_zero": "the vehicle's own centre C_PITCH, not the model's; mass_position = -pitchCtl, which is "
    "negative with the battery forward",
    "mass_rotation_note": "mass_rotation = -rollCtl: recorded roll follows rollCtl, the model's rotation opposes it; "
    "its zero is the vehicle's own, C_ROLL_DIVE until the dive ends, then C_ROLL_CLIMB",
    "ballast_volume_zero": "the vehicle's own neutral C_VBD",
    "motor_note": "samples at the start of each event and at the start and stop of each motor that ran in it; motors "
    "run one after the other, pitch, VBD, roll, from the recorded start of an event on; pauses between them, 2 s in "
    "all at most, are not recorded",
}
"""What a reader of the channels should know, as metadata of the log."""


def engineering(
    time_ns: Times, table: Mapping[str, Array], names: Mapping[str, str], declination: float | None, warnings: list[str]
) -> list[Channel]:
    """Attitude and controls of engineering rows.

    table : columns as recorded, (n,). names : name in the file by column. declination : deg, positive east, or None.
    """
    channels = [
        channel_of(names[column], time_ns, table[column], quantity, warnings)
        for column, quantity in ENGINEERING.items()
        if column in table
    ]
    if "head" not in table:
        return channels
    magnetic = channel_of(names["head"], time_ns, table["head"], HEADING, warnings)
    if declination is None:
        warnings.append(
            f"{names['head']}: {len(magnetic)} values left out: magnetic, and nothing tells the magnetic variation"
        )
        return channels
    true = (magnetic.values + declination * DEGREE) % (2.0 * np.pi)
    return [*channels, Channel("heading", magnetic.time_ns, true)]


WORST_HDOP = 99.0
"""Horizontal dilution of precision that a receiver without a fix reports."""


def fixes(time_ns: Times, table: Mapping[str, Array], warnings: list[str]) -> list[Channel]:
    """GPS fixes; a latitude or longitude that is NaN, or 0 in both, is none.

    table : (n,) each, latitude and longitude, deg, and hdop, NaN where none is told.
    """
    latitude, longitude, hdop = (table[key] for key in ("latitude", "longitude", "hdop"))
    valid = (np.abs(latitude) <= 90.0) & (np.abs(longitude) <= 180.0) & ((latitude != 0.0) | (longitude != 0.0))
    sharp = ~(hdop >= WORST_HDOP)
    for bad, why in ((~valid, "no position"), (valid & ~sharp, f"hdop {WORST_HDOP:g} or more")):
        if bad.any():
            warnings.append(f"GPS: {int(bad.sum())} fixes left out, {why}")
    fix = valid & sharp
    return [Channel("latitude", time_ns[fix], latitude[fix]), Channel("longitude", time_ns[fix], longitude[fix])]


def cells(names: Mapping[str, str], table: Mapping[str, Array], warnings: list[str]) -> dict[str, Array]:
    """The columns, without cells that are no number, which are counted under the names in the file."""
    return {column: without_sentinels(names[column], values, (), warnings) for column, values in table.items()}
