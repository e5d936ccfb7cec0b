"""The channels that a log may hold: name, SI unit, meaning, and how tables name and scale each.

Inside the program a channel is in SI units and radians. Tables and JSON name a channel with its unit, angles in
degrees (``pitch_deg``); ``factor`` brings the SI value to the table's unit. Signs follow frames.py: depth and vertical
speed positive down, nose up positive, heading clockwise from true north, net buoyancy positive sinking.
"""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["CHANNELS", "PHASES", "ChannelSpec", "by_column"]

_DEG = 180.0 / math.pi


class ChannelSpec(NamedTuple):
    """One entry of the channel table."""

    name: str
    unit: str
    """SI unit; "1" where there is none."""
    meaning: str
    column: str
    """Name in tables and JSON, with the table's unit."""
    column_unit: str
    factor: float
    """Table value = factor x SI value."""
    group: str
    """Family that viewers show together: navigation, attitude, motion, actuators, water, current."""
    cf_name: str
    """CF standard name, or "" where there is none."""

    @property
    def circular(self) -> bool:
        """Whether values lie on a circle, so that differences wrap at 360 deg."""
        return self.name in ("heading", "roll", "mass_rotation")


def _spec(
    name: str, unit: str, meaning: str, column: str, group: str, cf_name: str = "", factor: float = 1.0, table: str = ""
) -> ChannelSpec:
    return ChannelSpec(name, unit, meaning, column, table or unit, factor, group, cf_name)


def _angle(name: str, meaning: str, group: str, cf_name: str = "", rate: bool = False) -> ChannelSpec:
    unit, table, ending = ("rad/s", "deg/s", "_deg_s") if rate else ("rad", "deg", "_deg")
    return ChannelSpec(name, unit, meaning, name + ending, table, _DEG, group, cf_name)


CHANNELS: dict[str, ChannelSpec] = {
    spec.name: spec
    for spec in (
        _spec("depth", "m", "depth below the surface, positive down", "depth_m", "navigation", "depth"),
        _spec(
            "pressure", "Pa", "sea pressure (absolute less 10.1325 dbar)", "pressure_dbar", "water",
            "sea_water_pressure_due_to_sea_water", 1e-4, "dbar",
        ),
        _spec("latitude", "deg", "latitude, positive north", "latitude_deg", "navigation", "latitude"),
        _spec("longitude", "deg", "longitude, positive east", "longitude_deg", "navigation", "longitude"),
        _spec("north", "m", "way made good to true north of the log's origin", "north_m", "navigation"),
        _spec("east", "m", "way made good to the east of the log's origin", "east_m", "navigation"),
        _spec("down", "m", "way made good down from the log's origin", "down_m", "navigation"),
        _angle("roll", "roll, starboard side down positive", "attitude", "platform_roll"),
        _angle("pitch", "pitch, nose up positive", "attitude", "platform_pitch"),
        _angle("heading", "heading, clockwise from true north", "attitude", "platform_orientation"),
        _angle("p", "roll rate about the body x axis", "attitude", rate=True),
        _angle("q", "pitch rate about the body y axis", "attitude", rate=True),
        _angle("r", "yaw rate about the body z axis", "attitude", rate=True),
        _spec("u", "m/s", "velocity through water along the body x axis, forward", "u_m_s", "motion"),
        _spec("v", "m/s", "velocity through water along the body y axis, starboard", "v_m_s", "motion"),
        _spec("w", "m/s", "velocity through water along the body z axis, down", "w_m_s", "motion"),
        _spec("speed_through_water", "m/s", "speed through water", "speed_through_water_m_s", "motion"),
        _spec("vertical_speed", "m/s", "rate of change of depth, positive down", "vertical_speed_m_s", "motion"),
        _angle("angle_of_attack", "angle of attack, flow from below positive", "motion"),
        _angle("sideslip", "sideslip, flow from starboard positive", "motion"),
        _spec("mass_position", "m", "movable mass along the body x axis, forward", "mass_position_m", "actuators"),
        _angle("mass_rotation", "rotation of the movable mass about the body x axis", "actuators"),
        _spec("net_buoyancy", "kg", "net buoyancy as excess mass, sinking positive", "net_buoyancy_kg", "actuators"),
        _spec(
            "ballast_volume", "m3", "pumped oil volume outside the hull, floating positive", "ballast_volume_cm3",
            "actuators", "", 1e6, "cm3",
        ),
        _angle("rudder_angle", "rudder angle, turning to starboard positive", "actuators"),
        _spec("temperature", "degC", "in-situ temperature, ITS-90", "temperature_degC", "water", "sea_water_temperature"),
        _spec(
            "conductivity", "S/m", "electrical conductivity", "conductivity_S_m", "water",
            "sea_water_electrical_conductivity",
        ),
        _spec("salinity", "1", "practical salinity, PSS-78", "salinity", "water", "sea_water_practical_salinity"),
        _spec(
            "absolute_salinity", "g/kg", "absolute salinity, TEOS-10", "absolute_salinity_g_kg", "water",
            "sea_water_absolute_salinity",
        ),
        _spec(
            "conservative_temperature", "degC", "conservative temperature, TEOS-10", "conservative_temperature_degC",
            "water", "sea_water_conservative_temperature",
        ),
        _spec("density", "kg/m3", "in-situ density of the water", "density_kg_m3", "water", "sea_water_density"),
        _spec("current_east", "m/s", "current to the east", "current_east_m_s", "current", "eastward_sea_water_velocity"),
        _spec(
            "current_north", "m/s", "current to the north", "current_north_m_s", "current",
            "northward_sea_water_velocity",
        ),
        _spec("current_up", "m/s", "current upward", "current_up_m_s", "current", "upward_sea_water_velocity"),
        _spec("phase", "1", "flight phase, an index into PHASES", "phase", "navigation"),
    )
}  # fmt: skip

PHASES = ("surface", "dive", "climb", "hover", "inflection")
"""Flight phases; the phase channel holds indices, tables hold the words."""

_BY_COLUMN = {spec.column: spec for spec in CHANNELS.values()}


def by_column(column: str) -> ChannelSpec | None:
    """The channel that a table column of this name holds, or None."""
    return _BY_COLUMN.get(column)
