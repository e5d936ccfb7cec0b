"""Which channel does a CF standard name stand for? Names as published in the CF standard name table."""

from __future__ import annotations

__all__ = ["STANDARD_NAMES"]

STANDARD_NAMES = {
    "depth": "depth",
    "sea_water_pressure": "pressure",
    "sea_water_pressure_due_to_sea_water": "pressure",
    "sea_water_temperature": "temperature",
    "sea_water_electrical_conductivity": "conductivity",
    "sea_water_practical_salinity": "salinity",
    "sea_water_salinity": "salinity",
    "sea_water_absolute_salinity": "absolute_salinity",
    "sea_water_conservative_temperature": "conservative_temperature",
    "sea_water_density": "density",
    "platform_pitch": "pitch",
    "platform_pitch_angle": "pitch",
    "platform_pitch_fore_up": "pitch",
    "platform_roll": "roll",
    "platform_roll_angle": "roll",
    "platform_roll_starboard_down": "roll",
    "platform_orientation": "heading",
}
"""Channel by standard name; pyglider writes platform_pitch_angle and platform_roll_angle."""
