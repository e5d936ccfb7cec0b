"""Which units do recordings name, and how does each become SI? One table for NetCDF attributes and column mappings.

Names are those of UDUNITS and of files that were met: "mhos/m" and "decibar" stand in OceanGliders examples, "1e-3"
for practical salinity in those of several groups.
"""

from __future__ import annotations

from typing import NamedTuple

from glidercli.channels import CHANNELS
from glidercli.units import CENTIMETRE, CM3, DBAR, DEGREE, KNOT, MILLIMETRE

__all__ = ["Conversion", "conversion", "units_of"]


class Conversion(NamedTuple):
    """SI value = factor x recorded value + offset."""

    factor: float
    offset: float = 0.0


_PSI = 6894.757293168361  # Pa, pound-force (4.4482216152605 N) per square inch (0.0254 m)^2
_UNITS: dict[str, dict[str, Conversion]] = {
    "m": {
        "m meter metre meters metres": Conversion(1.0),
        "km kilometer kilometre": Conversion(1000.0),
        "cm centimeter centimetre": Conversion(CENTIMETRE),
        "mm millimeter millimetre": Conversion(MILLIMETRE),
        "in inch inches": Conversion(0.0254),
        "ft foot feet": Conversion(0.3048),
    },
    "Pa": {
        "Pa pascal": Conversion(1.0),
        "hPa mbar millibar": Conversion(100.0),
        "kPa kilopascal": Conversion(1000.0),
        "dbar decibar decibars": Conversion(DBAR),
        "bar": Conversion(1e5),
        "psi": Conversion(_PSI),
    },
    "degC": {
        "degC Celsius degree_Celsius degrees_Celsius degree_C degrees_C deg_C °C": Conversion(1.0),
        "K kelvin": Conversion(1.0, -273.15),
    },
    "S/m": {
        "S/m mho/m mhos/m": Conversion(1.0),
        "mS/cm mmho/cm": Conversion(0.1),
        "S/cm": Conversion(100.0),
        "mS/m": Conversion(1e-3),
        "uS/cm": Conversion(1e-4),
    },
    "rad": {"rad radian radians": Conversion(1.0), "deg degree degrees °": Conversion(DEGREE)},
    "deg": {
        "deg degree degrees ° degree_north degrees_north degree_east degrees_east": Conversion(1.0),
        "rad radian radians": Conversion(1.0 / DEGREE),
    },
    "rad/s": {"rad/s": Conversion(1.0), "deg/s degrees/s": Conversion(DEGREE)},
    "m/s": {
        "m/s": Conversion(1.0),
        "cm/s": Conversion(CENTIMETRE),
        "mm/s": Conversion(MILLIMETRE),
        "knot knots kn kt": Conversion(KNOT),
        "km/h": Conversion(1000.0 / 3600.0),
    },
    "m3": {"m3": Conversion(1.0), "cm3 cc ml mL": Conversion(CM3), "l L liter litre": Conversion(1e-3)},
    "kg": {"kg": Conversion(1.0), "g gram": Conversion(1e-3)},
    "kg/m3": {"kg/m3": Conversion(1.0), "g/cm3 kg/l kg/L": Conversion(1000.0)},
    "1": {"1 psu PSU PSS-78 PSS78 1e-3 0.001": Conversion(1.0)},  # 1e-3: the number is 35 all the same
    "g/kg": {"g/kg": Conversion(1.0)},
}
"""By SI unit of the channel: names, and what they mean."""
_BY_NAME = {si: {name: c for names, c in table.items() for name in names.split()} for si, table in _UNITS.items()}


def conversion(unit: str, channel: str) -> Conversion | None:
    """What brings a unit to that of the channel; None for one that is not known or is of something else."""
    table = _BY_NAME[CHANNELS[channel].unit]
    name = _one_spelling(unit)
    lower = {known.lower(): c for known, c in table.items()}
    return table.get(name) or (lower.get(name.lower()) if len(name) > 2 else None)  # mS is not MS


def units_of(channel: str) -> list[str]:
    """The units that a channel may be recorded in."""
    return [names.split()[0] for names in _UNITS[CHANNELS[channel].unit]]


def _one_spelling(unit: str) -> str:
    """A unit with a slash: "m s-1", "m.s-1" and "m s^-1" are m/s, "kg m-3" and "kg/m^3" are kg/m3."""
    text = unit.strip().replace("^", "").replace("**", "").replace(".", " ") if unit.strip() != "0.001" else "0.001"
    parts = text.replace(" / ", "/").split()
    if len(parts) == 2 and "-" in parts[1] and parts[1][-1].isdigit():
        under, power = parts[1].rsplit("-", 1)
        return f"{parts[0]}/{under}" + ("" if power == "1" else power)
    return "_".join(parts)
