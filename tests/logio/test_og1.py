"""OceanGliders 1.0 files: every row kept or named, units, flags, fixes; samples confirmed by xarray."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray as xr
from conftest import ROOT

from glidercli import netcdf_opening as opening
from glidercli.channels import PHASES
from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.logio import read
from glidercli.logio.netcdf.og1 import is_og1, read_og1
from glidercli.logio.report import FileReport
from glidercli.named_units import conversion

DATA = ROOT / "tests/data/netcdf"
SEAGLIDER, SLOCUM = DATA / "sg033_20100903T182416_first-rows.nc", DATA / "dfo-rosie713-20190615-og10.nc"


def read_one(path: Path) -> tuple[Log, FileReport]:
    part = read_og1(path)
    report = part.report
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    assert len(part.record_ns) == report.kept
    assert (np.diff(part.record_ns) >= 0).all()
    return part.log, report


@pytest.mark.parametrize("path", [SEAGLIDER, SLOCUM], ids=lambda path: path.name)
def test_samples_are_those_that_xarray_sees(path: Path) -> None:
    log, report = read_one(path)
    with xr.open_dataset(path) as file:
        assert report.records == file.sizes["N_MEASUREMENTS"]
        alone = np.isfinite(file["LATITUDE_GPS"]) & ~np.isfinite(file["PITCH"]) & ~np.isfinite(file["PRES"])
        for channel, name, factor in (("pressure", "PRES", 1e4), ("temperature", "TEMP", 1.0)):
            good = np.isfinite(file[name])
            for flag in (3, 4, 8, 9):
                good &= file[f"{name}_QC"] != flag if f"{name}_QC" in file else True
            good &= ~alone
            seen = file[name].values[good].astype(float) * factor
            np.testing.assert_allclose(log[channel].values, seen, rtol=1e-15)  # one rounding
            times = file["TIME"].values[good].astype("datetime64[ns]").astype(np.int64)
            assert np.abs(log[channel].time_ns - times).max() <= 240  # a double of seconds since 1970 tells no more


def test_a_seaglider_mission() -> None:
    log, report = read_one(SEAGLIDER)
    assert report.format == "og1"
    assert log.metadata["platform"] == "sg033"
    assert log.metadata["trajectory"] == "sg033_20100903T182416"
    assert any("TEMP" in w and "flagged 8 (interpolated) left out" in w for w in report.warnings)
    assert any(w.startswith("LATITUDE, LONGITUDE: 3300 positions left out") for w in report.warnings)
    assert "variables not known and not used: DAVG_CURR_EAST, GLIDE_SPEED, DEPTH_Z" in report.warnings
    assert [log[n].origin for n in ("pressure", "temperature", "depth", "salinity", "phase")] == [
        "measured", "measured", "derived", "derived", "derived",
    ]  # fmt: skip
    dive = log["phase"].time_ns[log["phase"].values == PHASES.index("dive")]
    pitch = log["pitch"].values[np.isin(log["pitch"].time_ns, dive)]
    assert -0.4 < np.median(pitch) < -0.2  # nose down


def test_fixes_are_the_gps_rows_alone() -> None:
    log, _ = read_one(SEAGLIDER)
    with xr.open_dataset(SEAGLIDER) as file:
        told = np.isfinite(file["LATITUDE_GPS"].values)
        times = file["TIME"].values[told].astype("datetime64[ns]").astype(np.int64)
        latitudes = file["LATITUDE_GPS"].values[told]
    fresh = np.concatenate([[True], (np.diff(times) > 0) & (np.diff(latitudes) != 0.0)])
    assert log["latitude"].values.tolist() == latitudes[fresh].tolist()
    assert log["latitude"].origin == "measured"


def test_radians_that_are_called_degrees() -> None:
    """Slocum records rad; pyglider 0.0.9's own result calls them degrees."""
    log, report = read_one(SLOCUM)
    assert "HEADING, PITCH, ROLL: called degrees, read as rad: Slocum records rad, and no value exceeds 2 pi" in (
        report.warnings
    )
    assert 0.4 < log["pitch"].values.max() < 0.6  # 25 deg and more
    assert log["pitch"].origin == "derived"  # interpolated to the CTD
    assert len(log["latitude"]) == 20


def made(path: Path, change: Callable[[Any], None] = lambda file: None) -> Path:
    """A file after the published tables: seconds since 1970, -9999.9 as fill value."""
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("N_MEASUREMENTS", 6)

        def put(name: str, values: list[float], units: str, fill: float = -9999.9) -> None:
            variable = file.createVariable(name, "f8", ("N_MEASUREMENTS",), fill_value=fill)
            variable.units = units
            variable.set_auto_maskandscale(False)
            variable[:] = values

        seconds = [1.6e9 + 10.0 * i for i in range(6)]
        put("TIME", seconds, "seconds since 1970-01-01T00:00:00Z", -1.0)
        put("DEPTH", [0.5, 10, 20, 30, 20, 10], "metres")
        put("PRES", [0.6, 10, 20, 30, 20, -9999.9], "decibar")
        put("CNDC", [40, 41, 42, 43, 42, 41], "mS cm-1")
        put("TEMP", [290.15, 290, 289, 288, 289, 290], "K")
        put("PITCH", [0, -0.4, -0.4, 0.4, 0.4, 0.4], "rad")
        put("LATITUDE_GPS", [10.0, -9999.9, -9999.9, 10.1, -9999.9, -9999.9], "degrees_north")
        put("LONGITUDE_GPS", [20.0, -9999.9, -9999.9, 20.1, -9999.9, -9999.9], "degrees_east")
        phase = file.createVariable("PHASE", "i1", ("N_MEASUREMENTS",), fill_value=0)
        phase[:] = [3, 2, 2, 5, 1, 4]
        flags = file.createVariable("TEMP_QC", "i1", ("N_MEASUREMENTS",))
        flags[:] = [0, 1, 2, 3, 5, 8]
        change(file)
    return path


def test_units_flags_and_phases_of_the_published_tables(tmp_path: Path) -> None:
    log, report = read_one(made(tmp_path / "a.nc"))
    assert (report.records, report.kept) == (6, 6)
    assert log["pressure"].values.tolist() == [6000.0, 1e5, 2e5, 3e5, 2e5]
    assert log["conductivity"].values[1] == pytest.approx(4.1)
    assert log["temperature"].values.tolist() == pytest.approx([17.0, 16.85, 15.85, 15.85])
    assert [PHASES[int(v)] for v in log["phase"].values] == ["surface", "dive", "dive", "climb", "hover"]
    assert log["latitude"].values.tolist() == [10.0]  # the other one is told at 30 m
    assert "TEMP: 1 values flagged 5 (changed by its publisher) kept" in report.warnings
    assert "TEMP: 1 values flagged 3 (probably bad) left out" in report.warnings


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda f: f["TEMP"].setncattr("units", "furlong"), "TEMP: left out, the unit 'furlong' is not known for temp"),
        (lambda f: f["TEMP"].delncattr("units"), "TEMP: left out, no unit is told for temperature; known are degC, K"),
        (lambda f: f["DEPTH"].setncatts({"valid_min": 1.0}), "DEPTH: 1 values outside the file's own valid range"),
        (lambda f: f["PITCH"].__setitem__(2, 3.0), "PITCH: 1 values outside -1.5708..1.5708 rad left out"),
    ],
)
def test_what_is_left_out_is_named(tmp_path: Path, change: Callable[[Any], None], words: str) -> None:
    assert any(words in warning for warning in read_one(made(tmp_path / "a.nc", change))[1].warnings)


@pytest.mark.parametrize(
    ("row", "seconds", "reason"),
    [
        (3, 1.6e9 + 20.0, "time repeats"),
        (3, 1.6e9 + 5.0, "time goes back"),
        (3, 0.0, "clock not set: before 1990"),
        (3, 1.9e9, "time more than 30 days after the file's other times"),
        (3, -1.0, "time cannot be read"),  # the fill value
        (3, 1e300, "time cannot be read"),
    ],
)
def test_rows_are_dropped_by_name(tmp_path: Path, row: int, seconds: float, reason: str) -> None:
    path = made(tmp_path / "a.nc", lambda f: f["TIME"].__setitem__(row, seconds))
    _, report = read_one(path)
    assert (report.kept, report.dropped) == (5, ((reason, 1),))


def test_values_computed_from_a_bad_conductivity_go_with_it(tmp_path: Path) -> None:
    def change(file: Any) -> None:
        salinity = file.createVariable("PSAL", "f4", ("N_MEASUREMENTS",))
        salinity.units = "1e-3"
        salinity[:] = 35.0
        file["CNDC"][2] = 900.0

    log, report = read_one(made(tmp_path / "a.nc", change))
    assert len(log["salinity"]) == len(log["conductivity"]) == 4  # a row has no pressure, one an impossible value
    assert log["salinity"].values.tolist() == [35.0] * 4
    assert "salinity: 2 values left out, their conductivity is left out or missing" in report.warnings


def test_no_rows_give_no_log(tmp_path: Path) -> None:
    with netCDF4.Dataset(tmp_path / "a.nc", "w") as file:
        file.createDimension("N_MEASUREMENTS", None)
        for name, units in (("TIME", "seconds since 1970-01-01"), ("DEPTH", "m")):
            file.createVariable(name, "f8", ("N_MEASUREMENTS",)).units = units
    assert read_one(tmp_path / "a.nc")[1].records == 0
    with pytest.raises(InputError, match="no usable record"):
        read([tmp_path / "a.nc"])


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda f: f["TIME"].setncattr("units", "seconds"), "TIME: 'seconds' is no unit of times"),
        (lambda f: f["TIME"].setncattr("calendar", "noleap"), "TIME counts in the calendar noleap; allowed: standard"),
    ],
)
def test_times_that_cannot_be_told_are_refused(tmp_path: Path, change: Callable[[Any], None], words: str) -> None:
    with pytest.raises(InputError, match=words):
        read([made(tmp_path / "a.nc", change)])


def test_other_netcdf_is_refused_with_what_is_readable(tmp_path: Path) -> None:
    with netCDF4.Dataset(tmp_path / "a.nc", "w", format="NETCDF3_CLASSIC") as file:
        file.createDimension("x", 3)
    with pytest.raises(
        InputError, match=r"is NetCDF, but none of the kinds that can be read; readable are .*og1, ioos"
    ):
        read([tmp_path / "a.nc"])
    with pytest.raises(InputError, match=r"no variable TIME along N_MEASUREMENTS"):
        read([tmp_path / "a.nc"], format="og1")


def test_a_library_that_does_not_come_back_is_not_waited_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the HDF5 library does with some damaged files."""
    path = made(tmp_path / "a.nc")
    monkeypatch.setattr(opening, "LONGEST", 0.3)
    monkeypatch.setattr(netCDF4, "Dataset", lambda path: time.sleep(60))
    opening._opens.cache_clear()
    start = time.monotonic()
    assert not is_og1(path)
    with pytest.raises(InputError, match="damaged or cut short"):
        read([path])
    assert time.monotonic() - start < 5.0
    opening._opens.cache_clear()


@pytest.mark.parametrize(
    ("unit", "channel", "factor", "offset"),
    [
        ("dbar", "pressure", 1e4, 0.0), ("decibar", "pressure", 1e4, 0.0), ("psi", "pressure", 6894.757293168361, 0.0),
        ("mhos/m", "conductivity", 1.0, 0.0), ("mS.cm-1", "conductivity", 0.1, 0.0), ("S m-1", "conductivity", 1.0, 0.0),
        ("degrees_Celsius", "temperature", 1.0, 0.0), ("kelvin", "temperature", 1.0, -273.15),
        ("kg m^-3", "density", 1.0, 0.0), ("kg/m^3", "density", 1.0, 0.0), ("psu", "salinity", 1.0, 0.0),
        ("0.001", "salinity", 1.0, 0.0), ("degree", "pitch", np.pi / 180, 0.0), ("cc", "ballast_volume", 1e-6, 0.0),
        ("Inches", "mass_position", 0.0254, 0.0), ("cm s-1", "vertical_speed", 0.01, 0.0),
    ],
)  # fmt: skip
def test_units_by_their_many_names(unit: str, channel: str, factor: float, offset: float) -> None:
    assert conversion(unit, channel) == (pytest.approx(factor, rel=1e-15), offset)


@pytest.mark.parametrize(
    ("unit", "channel"), [("MS/cm", "temperature"), ("m", "pressure"), ("", "depth"), ("g/m^2", "density")]
)
def test_a_unit_of_something_else_is_none(unit: str, channel: str) -> None:
    assert conversion(unit, channel) is None


AT_SURFACE = DATA / "sg033_20100729T133612_at-surface.nc"


def test_positions_without_a_unit_are_degrees() -> None:
    log, report = read_one(AT_SURFACE)
    with xr.open_dataset(AT_SURFACE) as file:
        told = np.isfinite(file["LATITUDE_GPS"].values)
        places = file["LATITUDE_GPS"].values[told], file["LONGITUDE_GPS"].values[told]
    assert log["latitude"].values.tolist() == places[0].tolist()
    assert log["longitude"].values.tolist() == places[1].tolist()
    assert "LATITUDE_GPS: no unit is told, taken as degrees of latitude" in report.warnings
    assert report.dropped == ()


def test_another_unit_of_a_position_is_still_refused_by_name(tmp_path: Path) -> None:
    def change(file: Any) -> None:
        file["LATITUDE_GPS"].units = "furlong"
        file["DEPTH"][0] = 0.0
        for name in ("PRES", "CNDC", "TEMP", "PITCH"):
            file[name][0] = -9999.9

    log, report = read_one(made(tmp_path / "a.nc", change))
    assert "latitude" not in log
    assert any(w.startswith("LATITUDE_GPS: left out, the unit 'furlong' is not known") for w in report.warnings)
    assert "all values zero" not in dict(report.dropped)


def test_the_controls_of_a_seaglider() -> None:
    log, report = read_one(AT_SURFACE)
    with xr.open_dataset(AT_SURFACE) as file:
        seen = {n: file[n].values[np.isfinite(file[n].values)] for n in ("eng_pitchCtl", "eng_rollCtl", "eng_vbdCC")}
    # sums of products differ in the last bits
    np.testing.assert_allclose(log["mass_position"].values, -0.01 * seen["eng_pitchCtl"], rtol=1e-14)
    np.testing.assert_allclose(log["mass_rotation"].values, -np.radians(seen["eng_rollCtl"]), rtol=1e-14)
    np.testing.assert_allclose(log["ballast_volume"].values, 1e-6 * seen["eng_vbdCC"], rtol=1e-14)
    _, (position, pitch) = log.together("mass_position", "pitch")
    assert np.corrcoef(position, pitch)[0, 1] < -0.8  # the battery forward, the nose down, here among waves
    assert "eng_vbdCC: no unit is told; taken as the cm3 of a Seaglider's vbdCC" in report.warnings
    assert log["mass_position"].origin == "measured"
    assert log.metadata["mass_position_zero"].startswith("the vehicle's own centre")


@pytest.mark.parametrize(
    ("model", "unit", "values", "says"),
    [
        ("Teledyne Slocum G3", "", [0.5] * 6, "the file does not say that it is of a Seaglider"),
        ("Seaglider M1", "counts", [2100.0] * 6, "in counts, and the file tells no centre and conversion"),
        ("Seaglider M1", "furlong", [0.5] * 6, "the unit 'furlong' is not known"),
        ("Seaglider M1", "counts", [0.5] * 6, ""),
        ("Seaglider M1", "cm", [0.5] * 6, ""),
    ],
)
def test_controls_that_cannot_be_told_are_named(
    tmp_path: Path, model: str, unit: str, values: list[float], says: str
) -> None:
    def change(file: Any) -> None:
        file.PLATFORM_MODEL = model
        file.createVariable("PITCH_CTL", "f8", ("N_MEASUREMENTS",))[:] = values
        if unit:
            file["PITCH_CTL"].units = unit

    log, report = read_one(made(tmp_path / "a.nc", change))
    assert ("mass_position" in log) == (not says)
    if says:
        assert any(w.startswith("PITCH_CTL: left out") and says in w for w in report.warnings)
    else:
        assert log["mass_position"].values.tolist() == [-0.005] * 6


def test_a_magnetic_heading_is_told() -> None:
    log, report = read_one(SEAGLIDER)
    assert log.metadata["heading_note"].startswith("from magnetic north, HEADING as recorded")
    assert any(w.endswith("values stay from magnetic north") for w in report.warnings)
    assert "heading_note" not in read_one(SLOCUM)[0].metadata
