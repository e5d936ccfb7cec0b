"""Which channels do the sensors of a Slocum hold? Units, signs, and which samples are left out, and why.

Signs and units, and what shows them (comet 2016 and 2019, modena 2015):

    m_heading         rad from magnetic north. In the glider's local coordinates its own speed through water points
                      along it (in 2015 and 2019, when it knew no current, m_vx_lmc and m_vy_lmc to within 1e-5 deg),
                      and these coordinates it turns from its map's north by exactly m_gps_mag_var (x_utm_to_lmc_*:
                      -1.0, -3.9, -0.1 deg), negative where magnetic north lies east of true north.
                      So heading = m_heading - m_gps_mag_var, where a file has that.
                      (So also the makers: magnetic heading = true heading + variation, west positive.)
    m_pitch, m_roll   rad, nose up and port wing up (starboard down) positive, by the makers' list of sensors.
    m_battpos         inch, forward positive: the depth rate follows it (correlation 0.96 to 0.98 in the comet). Its own
                      zero is kept.
    m_fin             rad, to starboard positive: the yaw rate follows it in sawtooth flight (correlation 0.48 to 0.80),
                      and held at 0.20 rad it turns the heading clockwise (the spiral). So also the makers: C_FIN(rad),
                      >0 turns to stbd (behaviour set_heading, as in spiral.mi).
    m_battroll        rad; the makers: C_BATTROLL(rad) >0 puts stbd wing down (spiral.mi). The model's rotation moves
                      the mass to port, so mass_rotation = -m_battroll. No file at hand has it moved.
    m_depth           m, 10 m to a bar of the vehicle's own gauge: m_depth / m_pressure is 10.000 in all files.
    m_ballast_pumped  cc, floating positive (-231 on dives, +231 on climbs); m_de_oil_vol the same in deep gliders.
    sci_water_*       degC, S/m, bar of sea pressure (0.01 bar at the surface).
    m_gps_lat, _lon   ddmm.mmm; 69696969 or 69697000 for none, which is no place. m_lat and m_lon are the glider's
                      dead reckoning, and no fixes.

A receiver whose antenna goes under goes on for some 30 s with its last velocity, and its m_gps_status stays 0. What
shows it: of 403 positions of eight files that count satellites (comet 2016 and 2019, modena 2015, sebastian 2014, and
0160 on land) 47 have fewer than the four that a position takes. In all but two of them the glider is on its way down,
at 0.9 to 4.6 m, the number falls to 0, and mostly m_gps_speed and m_gps_heading stand still to the last bit while the
position moves in equal steps: in comet 2016 at 5.7 m/s, 170 m to the east, where the drift is 0.3 m/s. One of two
positions by three satellites is 27 m off. So with fewer than four (m_gps_num_satellites) a position is no fix. A cycle
that tells no number has the lower of those before and after it (one of comet 2016 is 12 m off); after a damage the
number is not known until it is told anew, and that is no fix either. Where satellites are not recorded a position is no
fix if speed and heading are repeated while it moves, or if it lies 1.5 m deeper than the shallowest one of its
surfacing: of the 47 that finds 35, of the other 356 it takes 2, of a car at 17 m/s. It finds 8 in four files without
satellites (amadeus 2014, electa 2023, unit_887 2021), none in comet-2019-218-00-032.sbd. Depth alone does not tell:
after a dive to 191 m the gauge of modena stands at 3.4 to 3.9 m with eight satellites in view.
What the receiver holds to be wrong goes to m_gps_invalid_*, m_gps_toofar_* or m_gps_ignored_*, and is not read.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel
from glidercli.logio.quantities import Quantity, channels_from, degrees, without_sentinels
from glidercli.logio.records import CHANNELS_AT_REST
from glidercli.units import BAR, CM3, INCH

__all__ = ["AT_REST", "RECEIVER", "RELAYED", "USED", "Column", "channels_of"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
Mask = NDArray[np.bool_]

QUARTER, HALF, WHOLE = 1.5708, 3.1416, 6.2832
"""rad; parts of a turn, rounded up as numbers of 4 bytes are."""
SENSORS = {
    "m_depth": Quantity("depth", 1.0, -5.0, 1500.0, "m"),
    "m_pitch": Quantity("pitch", 1.0, -QUARTER, QUARTER, "rad"),
    "m_roll": Quantity("roll", 1.0, -HALF, HALF, "rad"),
    "m_heading": Quantity("heading", 1.0, 0.0, WHOLE, "rad"),
    "m_battpos": Quantity("mass_position", INCH, -5.0, 5.0, "in"),
    "m_battroll": Quantity("mass_rotation", -1.0, -HALF, HALF, "rad"),
    "m_ballast_pumped": Quantity("ballast_volume", CM3, -1000.0, 1000.0, "cc"),
    "m_de_oil_vol": Quantity("ballast_volume", CM3, -1000.0, 1000.0, "cc"),
    "m_fin": Quantity("rudder_angle", 1.0, -0.8, 0.8, "rad"),
    "sci_water_temp": Quantity("temperature", 1.0, -3.0, 45.0, "degC"),
    "sci_water_cond": Quantity("conductivity", 1.0, 0.0, 7.5, "S/m"),
    "sci_water_pressure": Quantity("pressure", BAR, -0.2, 150.0, "bar"),
}
CTD = ("sci_water_temp", "sci_water_cond", "sci_water_pressure")
RELAYED = frozenset(SENSORS[name].channel for name in CTD)
"""Channels that a navigation file has from the science computer, fewer and later than the science file's own."""
LATITUDE, LONGITUDE, STATUS, VARIATION = "m_gps_lat", "m_gps_lon", "m_gps_status", "m_gps_mag_var"
CURRENT = ("m_water_vx", "m_water_vy")
SATELLITES = "m_gps_num_satellites"
VELOCITY = ("m_gps_speed", "m_gps_heading")
RECEIVER = (SATELLITES, *VELOCITY)
"""What tells whether a position is a fix; by itself no content of a record."""
USED = (*SENSORS, LATITUDE, LONGITUDE, STATUS, VARIATION, *CURRENT, *RECEIVER)
"""Sensors that are decoded for a log."""
LEAST_SATELLITES = 4
MOST_SATELLITES = 100
"""More are no number of satellites, but 69696969, never told."""
DIPPED = 1.5
"""m below the shallowest position of a surfacing, where the antenna is under water."""
SURFACING = 300 * 10**9
"""ns; positions further apart are of another surfacing."""
AT_REST = frozenset(name for name, quantity in SENSORS.items() if quantity.channel in CHANNELS_AT_REST)
"""Sensors of which zero is a reading like others."""
NOTES = {
    "depth": {"depth_note": "m_depth as recorded: the vehicle reckons 10 m to a bar of its own gauge"},
    "mass_position": {"mass_position_zero": "the actuator's own zero (m_battpos), not the model's"},
    "mass_rotation": {"mass_rotation_note": "mass_rotation = -m_battroll, whose positive puts the starboard wing down"},
    "rudder_angle": {"rudder_note": "m_fin as recorded: the yaw rate follows it with the same sign"},
}


class Column(NamedTuple):
    """A sensor in the records of a file, (n,) each.

    sampled : the values, NaN in records without a sample, infinite where a sample is no number. fresh : whether the
    sample is a new value. latest : the last number known in each record, from before the file if need be; of RECEIVER
    NaN after a damage until it is told anew.
    """

    sampled: Array
    fresh: NDArray[np.bool_]
    latest: Array


def channels_of(time_ns: Times, columns: Mapping[str, Column]) -> tuple[list[Channel], dict[str, str], list[str]]:
    """The channels of the sensors of a file, what to know of them, and a warning for each kind of sample left out.

    time_ns : (n,) UTC ns, strictly increasing. columns : by sensor, of those in USED that the file has.
    """
    warnings: list[str] = []
    used = {name: without_sentinels(name, columns[name].sampled, (), warnings) for name in SENSORS if name in columns}
    _without_idle_ctd(used, warnings)
    found = channels_from(time_ns, used, SENSORS, warnings)
    notes = {key: text for name in found for key, text in NOTES.get(name, {}).items()}
    if "heading" in found:
        found["heading"], notes["heading_note"] = _true(found["heading"], time_ns, columns.get(VARIATION), warnings)
    if {LATITUDE, LONGITUDE} <= columns.keys():
        found |= {channel.name: channel for channel in _fixes(time_ns, columns, warnings)}
    if all(name in columns and np.isfinite(columns[name].sampled).any() for name in CURRENT):
        east, north = (float(columns[name].latest[-1]) for name in CURRENT)
        notes["glider_current_note"] = (
            f"the glider's own estimate of the current over its dives, last in the file: m_water_vx {east:.3f}, "
            f"m_water_vy {north:.3f} m/s, y towards its magnetic north"
        )
    return [channel for channel in found.values() if len(channel)], notes, warnings


def _without_idle_ctd(used: dict[str, Array], warnings: list[str]) -> None:
    """Take out what a CTD tells when it did not sample: temperature, conductivity and pressure all exactly zero."""
    if not set(CTD) <= used.keys():
        return
    idle = np.all([used[name] == 0.0 for name in CTD], axis=0)
    if idle.any():
        warnings.append(f"sci_water: {int(idle.sum())} samples of zeros alone left out")
        used |= {name: np.where(idle, np.nan, used[name]) for name in CTD}


def _true(heading: Channel, time_ns: Times, variation: Column | None, warnings: list[str]) -> tuple[Channel, str]:
    """Heading from true north, in 0 to 360 deg, and what was done."""
    turn = np.full(len(time_ns), np.nan) if variation is None else variation.latest
    turn = turn[np.searchsorted(time_ns, heading.time_ns)]
    if not (np.abs(turn) <= HALF).all():
        warnings.append(f"m_heading: {len(heading)} values stay from magnetic north, the file tells no {VARIATION}")
        return heading, f"from magnetic north, m_heading as recorded: the file tells no {VARIATION}"
    turned = (heading.values - turn) % (2.0 * math.pi)
    low, high = (f"{math.degrees(value):.1f}" for value in (turn.min(), turn.max()))
    told = low if low == high else f"{low} to {high}"
    note = (
        f"from true north: m_heading, from magnetic north, less {VARIATION} ({told} deg, negative where magnetic north "
        "lies east); the glider's dead reckoning takes both so"
    )
    return Channel("heading", heading.time_ns, turned), note


def _fixes(time_ns: Times, columns: Mapping[str, Column], warnings: list[str]) -> list[Channel]:
    """Genuine GPS fixes, deg: where latitude and longitude are told together, one of them new, by a receiver that says
    so (m_gps_status 0) and does not extrapolate."""
    place = [columns[name] for name in (LATITUDE, LONGITUDE)]
    latitude, longitude = (degrees(column.sampled) for column in place)
    told = ~np.isnan(place[0].sampled) | ~np.isnan(place[1].sampled)
    fix = (np.abs(latitude) <= 90.0) & (np.abs(longitude) <= 180.0) & ((latitude != 0.0) | (longitude != 0.0))
    fix &= place[0].fresh | place[1].fresh
    if STATUS in columns:
        fix &= (columns[STATUS].latest == 0.0) & ~np.isinf(columns[STATUS].sampled)
    if others := int((told & ~fix).sum()):
        warnings.append(f"m_gps_lat, m_gps_lon: {others} values left out that are no new fix")
    blind, coasting = _extrapolated(time_ns, columns, fix)
    for which, sign in (
        (blind, f"fewer than {LEAST_SATELLITES} satellites, or none known ({SATELLITES})"),
        (coasting, f"under way down, or {' and '.join(VELOCITY)} stand still; {SATELLITES} is not told"),
    ):
        if which.any():
            warnings.append(f"m_gps_lat, m_gps_lon: {int(which.sum())} values left out that are extrapolated: {sign}")
    fix &= ~(blind | coasting)
    return [Channel("latitude", time_ns[fix], latitude[fix]), Channel("longitude", time_ns[fix], longitude[fix])]


def _extrapolated(time_ns: Times, columns: Mapping[str, Column], placed: Mask) -> tuple[Mask, Mask]:
    """Which of some positions, (n,), the receiver only extrapolated: by its satellites; by other signs without them."""
    satellites = np.full(len(time_ns), np.nan)
    if SATELLITES in columns:
        sampled, latest = columns[SATELLITES].sampled, columns[SATELLITES].latest
        lower = np.minimum(latest, np.append(latest[1:], latest[-1:]))  # NaN beside a damage
        satellites = np.where(np.isnan(sampled), lower, latest)
    counted = (satellites >= 0.0) & (satellites < MOST_SATELLITES)
    counted |= np.isnan(satellites) & counted.any()
    blind = placed & counted & ~(satellites >= LEAST_SATELLITES)
    coasting = np.zeros(len(time_ns), dtype=bool)
    if set(VELOCITY) <= columns.keys():
        coasting = columns[VELOCITY[0]].latest > 0.0
        for name in VELOCITY:
            coasting &= np.isfinite(columns[name].sampled) & ~columns[name].fresh
    if "m_depth" in columns:
        coasting |= _dipped(time_ns, columns["m_depth"].latest, placed)
    return blind, placed & ~counted & coasting


def _dipped(time_ns: Times, depth: Array, placed: Mask) -> Mask:
    """Which of some positions, (n,), lie deeper than the shallowest so far of their surfacing by more than DIPPED."""
    dipped = np.zeros(len(time_ns), dtype=bool)
    rows = np.flatnonzero(placed & np.isfinite(depth))
    for surfacing in np.split(rows, np.flatnonzero(np.diff(time_ns[rows]) > SURFACING) + 1):
        dipped[surfacing] = depth[surfacing] > np.minimum.accumulate(depth[surfacing]) + DIPPED
    return dipped
