"""Which units do files name, and how does each become SI? One table for logs, tables, water and current.

Names are those of UDUNITS and of files that were met: "mhos/m" and "decibar" stand in OceanGliders examples, "1e-3"
for practical salinity in those of several groups; "ms-1" without a blank is met in archives of casts.
"""

from __future__ import annotations

from typing import NamedTuple

from glidercli.channels import CHANNELS
from glidercli.units import CENTIMETRE, CM3, DBAR, DEGREE, KNOT, MILLIMETRE

__all__ = ["Conversion", "conversion", "conversion_to", "names_of", "units_of"]


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
        "dbar decibar decibars db": Conversion(DBAR),
        "bar": Conversion(1e5),
        "psi": Conversion(_PSI),
    },
    "degC": {
        "degC Celsius degree_Celsius degrees_Celsius degree_C degrees_C deg_C degreeC degreesC °C C": Conversion(1.0),
        "K kelvin degree_Kelvin": Conversion(1.0, -273.15),
    },
    "S/m": {
        "S/m mho/m mhos/m Sm-1": Conversion(1.0),
        "mS/cm mmho/cm mScm-1": Conversion(0.1),
        "S/cm": Conversion(100.0),
        "mS/m": Conversion(1e-3),
        "uS/cm uScm-1": Conversion(1e-4),
    },
    "rad": {"rad radian radians": Conversion(1.0), "deg degree degrees °": Conversion(DEGREE)},
    "deg": {
        "deg degree degrees ° degree_north degrees_north degree_N degrees_N": Conversion(1.0),
        "degree_east degrees_east degree_E degrees_E": Conversion(1.0),
        "rad radian radians": Conversion(1.0 / DEGREE),
    },
    "rad/s": {"rad/s": Conversion(1.0), "deg/s degrees/s": Conversion(DEGREE)},
    "m/s": {
        "m/s ms-1 meter/sec meters/second": Conversion(1.0),
        "cm/s cms-1": Conversion(CENTIMETRE),
        "mm/s mms-1": Conversion(MILLIMETRE),
        "knot knots kn kt": Conversion(KNOT),
        "km/h": Conversion(1000.0 / 3600.0),
    },
    "m3": {"m3": Conversion(1.0), "cm3 cc ml mL": Conversion(CM3), "l L liter litre": Conversion(1e-3)},
    "kg": {"kg": Conversion(1.0), "g gram": Conversion(1e-3)},
    "kg/m3": {
        "kg/m3 kgm-3": Conversion(1.0),
        "g/cm3 gcm-3 kg/l kg/L": Conversion(1000.0),
        "g/m3 gm-3": Conversion(1e-3),
    },
    # 1e-3: the number is 35 all the same
    "1": {"1 psu PSU PSS PSS-78 PSS78 1e-3 0.001 10-3 ppt o/oo unitless dimensionless": Conversion(1.0)},
    "g/kg": {"g/kg gkg-1": Conversion(1.0), "kg/kg kgkg-1": Conversion(1000.0)},
}
"""By SI unit of the channel: names, and what they mean."""
_BY_NAME = {si: {name: c for names, c in table.items() for name in names.split()} for si, table in _UNITS.items()}


def conversion(unit: str, channel: str) -> Conversion | None:
    """What brings a unit to that of the channel; None for one that is not known or is of something else."""
    return conversion_to(CHANNELS[channel].unit, unit)


def conversion_to(si: str, unit: str) -> Conversion | None:
    """What brings a unit to an SI unit of the table; None for one that is not known or is of something else."""
    table = _BY_NAME[si]
    lower = {known.lower(): c for known, c in table.items()}  # in no table do two units differ by capitals alone
    names = (_one_spelling(unit), unit.replace(" ", ""))
    found = (table.get(name) or lower.get(name.lower()) for name in names)
    return next((c for c in found if c is not None), None)


def units_of(channel: str) -> list[str]:
    """The units that a channel may be recorded in."""
    return names_of(CHANNELS[channel].unit)


def names_of(si: str) -> list[str]:
    """The units that can be brought to an SI unit of the table, each by its first name."""
    return [names.split()[0] for names in _UNITS[si]]


def _one_spelling(unit: str) -> str:
    """A unit with a slash: "m s-1", "m.s-1" and "m s^-1" are m/s, "kg m-3" and "kg/m^3" are kg/m3."""
    text = unit.strip().replace("^", "").replace("**", "").replace(".", " ") if unit.strip() != "0.001" else "0.001"
    parts = text.replace(" / ", "/").split()
    if len(parts) == 2 and "-" in parts[1] and parts[1][-1].isdigit():
        under, power = parts[1].rsplit("-", 1)
        return f"{parts[0]}/{under}" + ("" if power == "1" else power)
    return "_".join(parts)
