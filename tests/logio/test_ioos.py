"""IOOS glider files: profiles made of real samples by the published template, and a whole deployment of pyglider."""

from __future__ import annotations

from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr
from conftest import ROOT

from glidercli.log import Log
from glidercli.logio import read
from glidercli.logio.netcdf.ioos import read_ioos
from glidercli.logio.report import FileReport

DEPLOYMENT = ROOT / "tests/data/netcdf/dfo-rosie713-20190615_adjusted.nc"
FLAGS = "no_qc_performed good_data probably_good_data bad_data_that_are_potentially_correctable bad_data value_changed not_used not_used interpolated_value missing_value"


@pytest.fixture(scope="module")
def sea035() -> Log:
    """Measured samples of a SeaExplorer."""
    return read([ROOT / "logs/seaexplorer-sea035"]).log


def profile(path: Path, log: Log, rows: slice, number: int, format: str = "NETCDF4") -> Path:
    """A profile by the template IOOS_Glider_NetCDF_v2.0 (ioos/ioosngdac), of measured samples."""
    times = np.intersect1d(log["pressure"].time_ns, log["conductivity"].time_ns)[rows]
    at = {n: log[n].values[np.searchsorted(log[n].time_ns, times)] for n in ("pressure", "temperature", "conductivity")}
    with netCDF4.Dataset(path, "w", format=format) as file:
        file.createDimension("time", len(times))
        file.createDimension("traj_strlen", 20)
        file.setncatts({"format_version": "IOOS_Glider_NetCDF_v2.0.nc", "Conventions": "CF-1.6"})
        trajectory = file.createVariable("trajectory", "S1", ("traj_strlen",))
        trajectory[:] = netCDF4.stringtochar(np.array(["sea035-2019"], "S20"))[0]
        epoch = "seconds since 1970-01-01T00:00:00Z"
        file.createVariable("time", "f8", ("time",)).setncatts({"units": epoch, "calendar": "gregorian"})
        file["time"][:] = times / 1e9
        units = {"pressure": ("dbar", 1e-4), "temperature": ("Celsius", 1.0), "conductivity": ("S m-1", 1.0)}
        for name, (unit, factor) in units.items():
            file.createVariable(name, "f8", ("time",), fill_value=-999.0).units = unit
            file[name][:] = at[name] * factor
            qc = file.createVariable(f"{name}_qc", "i1", ("time",), fill_value=-127)
            qc.setncatts({"flag_values": np.arange(10, dtype="i1"), "flag_meanings": FLAGS})
            qc[:] = 1
        for name, unit in (("lat", "degrees_north"), ("lon", "degrees_east")):
            file.createVariable(name, "f8", ("time",), fill_value=-999.0).units = unit
            file[name][:] = np.linspace(10.0, 10.1, len(times))
        file.createVariable("profile_id", "i4", (), fill_value=-999)[...] = number
        for name, value, unit in (("u", 0.05, "m s-1"), ("v", -0.02, "m s-1"), ("time_uv", times[-1] / 1e9, epoch)):
            file.createVariable(name, "f8", (), fill_value=-999.0).units = unit
            file[name][...] = value
        file.createVariable("platform", "i4", (), fill_value=-999).setncatts({"id": "sea035", "wmo_id": "6801234"})
    return path


def read_one(path: Path) -> tuple[Log, FileReport]:
    part = read_ioos(path)
    report = part.report
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    assert len(part.record_ns) == report.kept
    return part.log, report


@pytest.mark.parametrize("format", ["NETCDF4", "NETCDF3_CLASSIC"])
def test_a_profile_gives_the_samples_that_went_in(tmp_path: Path, sea035: Log, format: str) -> None:
    path = profile(tmp_path / "a.dat", sea035, slice(0, 200), 1, format)
    log, report = read_one(path)
    assert (report.format, report.records, report.kept) == ("ioos", 200, 200)
    times = np.intersect1d(sea035["pressure"].time_ns, sea035["conductivity"].time_ns)[:200]
    at = np.searchsorted(sea035["pressure"].time_ns, times)
    np.testing.assert_allclose(log["pressure"].values, sea035["pressure"].values[at], rtol=4.5e-16)  # to dbar and back
    assert "latitude" not in log
    assert "lat, lon: 200 positions left out, interpolated between fixes and not measured" in report.warnings
    assert [event.name for event in log.events] == ["depth-averaged current 0.050 m/s east, -0.020 m/s north"]
    assert {k: log.metadata[k] for k in ("platform", "wmo_id", "trajectory")} == {
        "platform": "sea035", "wmo_id": "6801234", "trajectory": "sea035-2019",
    }  # fmt: skip


def test_profiles_of_a_deployment_join_in_time_order(tmp_path: Path, sea035: Log) -> None:
    profile(tmp_path / "b.nc", sea035, slice(0, 150), 1)
    profile(tmp_path / "a.nc", sea035, slice(150, 300), 2)
    reading = read([tmp_path])
    assert [report.kept for report in reading.files] == [150, 150]
    whole = np.intersect1d(sea035["pressure"].time_ns, sea035["conductivity"].time_ns)[:300]
    assert np.abs(reading.log["pressure"].time_ns - whole).max() < 400  # doubles of seconds since 1970 are 238 ns apart
    assert len(reading.log.events) == 2


def test_of_the_same_profile_twice_the_fuller_is_read(tmp_path: Path, sea035: Log) -> None:
    profile(tmp_path / "delayed.nc", sea035, slice(0, 150), 1)
    profile(tmp_path / "real-time.nc", sea035, slice(0, 150, 5), 1)
    reports = {report.path.name: report for report in read([tmp_path]).files}
    assert reports["real-time.nc"].dropped == (("its recording is in delayed.nc", 30),)


def test_positions_are_fixes_where_flags_tell_them_from_interpolated_ones(tmp_path: Path, sea035: Log) -> None:
    path = profile(tmp_path / "a.nc", sea035, slice(0, 100), 1)
    with netCDF4.Dataset(path, "a") as file:
        for name in ("lat_qc", "lon_qc"):
            file.createVariable(name, "i1", ("time",), fill_value=-127)[:] = [1, 1, *[8] * 97, 2]
    log, _ = read_one(path)
    with xr.open_dataset(path) as file:
        assert log["latitude"].values.tolist() == file["lat"].values[[0, 1, 99]].tolist()


def test_flagged_values_are_left_out_and_counted(tmp_path: Path, sea035: Log) -> None:
    path = profile(tmp_path / "a.nc", sea035, slice(0, 100), 1)
    with netCDF4.Dataset(path, "a") as file:
        file["temperature_qc"][:7] = [3, 4, 4, 8, 9, 5, 0]
        file["temperature"][50] = -999.0
    log, report = read_one(path)
    assert len(log["temperature"]) == 94
    for words in ("1 values flagged 3 (probably bad)", "2 values flagged 4 (bad)", "1 values flagged 8 (interpolated)"):
        assert any(words in warning for warning in report.warnings), words


def test_a_deployment_of_pyglider() -> None:
    log, report = read_one(DEPLOYMENT)
    assert (report.records, report.kept) == (1167, 1167)
    with xr.open_dataset(DEPLOYMENT) as file:
        flagged = file["conductivity_QC"] == 4
        seen = np.isfinite(file["conductivity"]) & ~flagged & (file["pressure"] >= 0.5)
        assert len(log["conductivity"]) == int(seen.sum())
        assert len(log["temperature"]) == int(np.isfinite(file["temperature"]).sum())
        np.testing.assert_array_equal(log["depth"].values, file["depth"].values[np.isfinite(file["depth"])])
    assert log["depth"].origin == log["pitch"].origin == "derived"
    assert log["temperature"].origin == "measured"
    assert log.metadata["platform"] == "dfo-rosie"


def test_a_grid_is_no_recording(tmp_path: Path, sea035: Log) -> None:
    path = profile(tmp_path / "a.nc", sea035, slice(0, 10), 1)
    with netCDF4.Dataset(path, "a") as file:
        file.createDimension("depth", 5)
    with pytest.raises(Exception, match="is a grid of profiles; the measurements along time are needed"):
        read([path])
