"""Are units understood alike in logs, tables and files of water? Every spelling that either ever knew."""

from __future__ import annotations

import pytest

from glidercli.channels import CHANNELS
from glidercli.named_units import conversion, conversion_to, names_of

KNOWN = {
    "m": {1.0: "m metre metres meter meters M", 0.01: "cm CM", 1000.0: "km", 0.0254: "in inch", 0.3048: "ft"},
    "Pa": {1e4: "dbar decibar decibars db dBar DB", 1e5: "bar", 1.0: "pa Pa", 1000.0: "kpa kPa", 100.0: "hPa mbar"},
    "degC": {
        1.0: "degc degC deg_c degree_c degrees_c celsius degree_celsius degrees_celsius degreec degreesc °c c C",
    },
    "S/m": {1.0: "s/m S/m sm-1 s.m-1 mho/m", 0.1: "ms/cm mS/cm mscm-1 mmho/cm", 1e-4: "us/cm uscm-1"},
    "1": {1.0: "1 psu pss pss-78 pss78 1e-3 0.001 10^-3 ppt o/oo unitless dimensionless"},
    "g/kg": {1.0: "g/kg gkg-1 g.kg-1", 1000.0: "kg/kg kgkg-1 kg.kg-1"},
    "kg/m3": {1.0: "kg/m3 kgm-3 kg.m-3 kg/m^3", 1000.0: "g/cm3 gcm-3 kg/L", 1e-3: "g/m3 g/m^3 gm-3"},
    "m/s": {
        1.0: "m/s ms-1 m.s-1 ms^-1 meter/sec meters/second", 0.01: "cm/s cms-1 cm.s-1", 1e-3: "mm/s mms-1",
        1852.0 / 3600.0: "knot knots kn kt KT",
    },
    "deg": {1.0: "degrees_north degree_north degrees_n degrees_east degree_east degrees_e degrees degree deg"},
}  # fmt: skip
CASES = [(si, unit, factor) for si, table in KNOWN.items() for factor, units in table.items() for unit in units.split()]


@pytest.mark.parametrize(("si", "unit", "factor"), CASES)
def test_every_spelling_has_one_meaning(si: str, unit: str, factor: float) -> None:
    assert conversion_to(si, unit) == (pytest.approx(factor, rel=1e-15), 0.0)
    for channel, spec in CHANNELS.items():
        if spec.unit == si:
            assert conversion(unit, channel) == conversion_to(si, unit)


@pytest.mark.parametrize(
    ("si", "unit"), [("m/s", "m / s"), ("m/s", "m /s"), ("m/s", "m s^-1"), ("kg/m3", "kg m-3"), ("degC", "Deg C")]
)
def test_blanks_make_no_difference(si: str, unit: str) -> None:
    assert conversion_to(si, unit) == (1.0, 0.0)


@pytest.mark.parametrize("unit", ["K", "k", "kelvin", "degree_Kelvin"])
def test_kelvin_has_an_offset(unit: str) -> None:
    assert conversion_to("degC", unit) == (1.0, -273.15)


@pytest.mark.parametrize(("si", "unit"), [("m", "s"), ("Pa", "m"), ("1", "g/kg"), ("degC", ""), ("S/m", "mS/cm2")])
def test_what_is_of_something_else_is_none(si: str, unit: str) -> None:
    assert conversion_to(si, unit) is None


def test_no_two_units_differ_by_capitals_alone() -> None:
    from glidercli.named_units import _BY_NAME

    for si, table in _BY_NAME.items():
        meanings: dict[str, set[tuple[float, float]]] = {}
        for name, meant in table.items():
            meanings.setdefault(name.lower(), set()).add(tuple(meant))
        assert all(len(found) == 1 for found in meanings.values()), si
        assert all(conversion_to(si, name) for name in names_of(si))
