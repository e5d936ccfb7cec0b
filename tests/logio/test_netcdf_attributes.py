"""NetCDF files whose attributes lack or are of the wrong kind: no units at all, packing told as text."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from conftest import ROOT

from glidercli.errors import InputError
from glidercli.logio import read
from glidercli.netcdf_packing import packing_of

DATA = ROOT / "tests/data/netcdf"
IOOS, OG1 = DATA / "dfo-rosie713-20190615_adjusted.nc", DATA / "dfo-rosie713-20190615-og10.nc"
SEAGLIDER = DATA / "sg033_20100903T182416_first-rows.nc"
AT_SURFACE = DATA / "sg033_20100729T133612_at-surface.nc"
FIXES = ("LATITUDE_GPS", "LONGITUDE_GPS", "TIME_GPS")


def without_units(source: Path, path: Path, blank: tuple[str, ...] = ()) -> Path:
    """A copy whose variables tell no unit, apart from the times. blank : variables that hold no value any more."""
    shutil.copy(source, path)
    with netCDF4.Dataset(path, "a") as file:
        file.set_auto_maskandscale(False)
        for variable in file.variables.values():
            if "units" in variable.ncattrs() and "since" not in variable.units:
                variable.delncattr("units")
        for name in blank:
            file[name][:] = np.nan
    return path


@pytest.mark.parametrize(
    ("source", "blank", "lacking"),
    [
        (IOOS, ("salinity",), {"depth": "m, km, cm", "pressure": "Pa, hPa, kPa, dbar", "temperature": "degC, K"}),
        (OG1, ("PSAL", *FIXES[:2]), {"DEPTH": "m, km, cm", "PRES": "Pa, hPa, kPa, dbar", "PITCH": "rad, deg"}),
    ],
    ids=["ioos", "og1"],
)
def test_without_any_unit_the_error_names_what_lacks_one_and_what_is_allowed(
    tmp_path: Path, source: Path, blank: tuple[str, ...], lacking: dict[str, str]
) -> None:
    path = without_units(source, tmp_path / "a.nc", blank)
    with pytest.raises(InputError) as caught:
        read([path])
    (line,) = str(caught.value).splitlines()
    assert line.startswith(f"{path}: no usable record: ")
    for name, allowed in lacking.items():
        assert f"{name}: no unit is told for {name.lower().replace('pres', 'pressure')[:8]}" in line
        assert f"known are {allowed}" in line


def test_practical_salinity_needs_no_unit(tmp_path: Path) -> None:
    whole, bare = read([IOOS]).log, read([without_units(IOOS, tmp_path / "a.nc")])
    assert "salinity: no unit is told, taken as practical salinity, which has none" in bare.files[0].warnings
    assert list(bare.log.channels) == ["salinity"]
    at = np.isin(bare.log["salinity"].time_ns, whole["salinity"].time_ns)
    np.testing.assert_array_equal(bare.log["salinity"].values[at], whole["salinity"].values)


def with_attribute(path: Path, source: Path, variable: str, **told: Any) -> Path:
    shutil.copy(source, path)
    with netCDF4.Dataset(path, "a") as file:
        file[variable].setncatts(told)
    return path


@pytest.mark.parametrize(("source", "name"), [(IOOS, "temperature"), (OG1, "TEMP"), (SEAGLIDER, "TEMP")])
def test_packing_that_is_a_number_in_text_is_taken_and_said(tmp_path: Path, source: Path, name: str) -> None:
    plain = read([with_attribute(tmp_path / "a.nc", source, name, scale_factor=0.5, add_offset=2.0)])
    text = read([with_attribute(tmp_path / "b.nc", source, name, scale_factor="0.5", add_offset="2.0")])
    np.testing.assert_array_equal(text.log["temperature"].values, plain.log["temperature"].values)
    for key, number in (("scale_factor", "0.5"), ("add_offset", "2.0")):
        note = f"{name}: its {key} is the text '{number}', taken as the number that it spells"
        assert note in text.files[0].warnings
        assert note not in plain.files[0].warnings


@pytest.mark.parametrize(
    ("told", "says"), [("tenths", "the text 'tenths'"), ("nan", "the text 'nan'"), (np.array([1.0, 2.0]), "[1.0, 2.0]"),
                       (np.inf, "[inf]")],
)  # fmt: skip
def test_packing_that_is_no_number_leaves_its_variable_out_by_name(tmp_path: Path, told: Any, says: str) -> None:
    reading = read([with_attribute(tmp_path / "a.nc", IOOS, "temperature", scale_factor=told)])
    assert f"temperature: left out, its scale_factor is {says}; a single finite number is needed" in (
        reading.files[0].warnings
    )
    assert "temperature" not in reading.log
    assert "pressure" in reading.log


def test_a_control_of_a_seaglider_too(tmp_path: Path) -> None:
    name = "eng_pitchCtl"
    bad = read([with_attribute(tmp_path / "a.nc", AT_SURFACE, name, add_offset="none")])
    assert f"{name}: left out, its add_offset is the text 'none'; a single finite number is needed" in (
        bad.files[0].warnings
    )
    assert "mass_position" not in bad.log
    good = read([with_attribute(tmp_path / "b.nc", AT_SURFACE, name, scale_factor="1")])
    np.testing.assert_array_equal(good.log["mass_position"].values, read([AT_SURFACE]).log["mass_position"].values)


def test_numbers_and_nothing_are_packing_without_a_word() -> None:
    assert packing_of({}) == (1.0, 0.0, ())
    assert packing_of({"scale_factor": np.float32(0.25), "add_offset": np.array([3])}) == (0.25, 3.0, ())
