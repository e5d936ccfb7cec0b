"""Does a Log survive the NetCDF file to the last bit, and are unusable files refused in one line?"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import cftime
import netCDF4
import numpy as np
import pytest
import xarray as xr
from conftest import ROOT
from hypothesis import given, settings
from random_logs import assert_same, logs

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.log import Channel, Event, Log
from glidercli.logio import read, write
from glidercli.logio.netcdf.times import ticks, zero_and_unit
from glidercli.logio.own.netcdf_back import read_own_netcdf
from glidercli.logio.records import NO_TIME

DAY = 86_400_000_000_000


def with_provenance(log: Log) -> Log:
    """Writing adds it where it is missing."""
    return log if "provenance" in log.metadata else log.with_metadata(provenance='{"program": "glidercli"}')


@settings(deadline=None, max_examples=80)  # no deadline: the first example imports netCDF4
@given(log=logs())
def test_a_log_comes_back_to_the_last_bit(log: Log, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("nc") / "a.nc"
    log = with_provenance(log)
    write(log, path)
    assert_same(read_own_netcdf(path).log, log)


def long_log() -> Log:
    """Three years, every time odd to the nanosecond."""
    times = 1_313_000_000_123_456_789 + np.arange(400) * (3 * DAY - 7)
    values = np.random.default_rng(5).uniform(-1.0, 1.0, size=(2, 400))
    channels = [Channel("depth", times, values[0]), Channel("pitch", times[::3], values[1, ::3], "derived")]
    events = (Event("apogee", int(times[7]), 200.25), Event("surfaced", int(times[-1])))
    return Log({c.name: c for c in channels}, "measured", {"provenance": "{}", "title": "t"}, events)


def test_three_years_come_back_through_the_command_s_own_reader(tmp_path: Path) -> None:
    write(long_log(), tmp_path / "a.dat.nc")
    (tmp_path / "a.dat.nc").rename(tmp_path / "a.dat")  # picked by content
    reading = read([tmp_path / "a.dat"])
    assert_same(reading.log, long_log())
    (report,) = reading.files
    assert (report.format, report.records, report.kept, report.dropped) == ("glider-nc", 400, 400, ())


def test_xarray_reads_the_same_samples(tmp_path: Path) -> None:
    log = long_log()
    write(log, tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc") as file:
        assert (file["time_ns"].values.astype("datetime64[ns]").astype(np.int64) == log["depth"].time_ns).all()
        assert file["depth"].values.tobytes() == log["depth"].values.tobytes()
        assert int(file["pitch"].notnull().sum()) == len(log["pitch"])


def test_a_file_of_an_earlier_version_is_read_from_its_float_time(tmp_path: Path) -> None:
    """Fill value 1e37 and no integer time: exact for 48 days."""
    times = 1_313_000_000_123_456_789 + np.arange(48) * (DAY - 7)
    log = Log({"depth": Channel("depth", times, np.arange(48.0))}, "simulated", {"provenance": "{}"})
    write(log, tmp_path / "new.nc")
    with netCDF4.Dataset(tmp_path / "new.nc") as new, netCDF4.Dataset(tmp_path / "old.nc", "w") as old:
        old.createDimension("time", None)
        time = old.createVariable("time", "f8", ("time",))
        time.units = new["time"].units
        time[:] = new["time"][:]
        depth = old.createVariable("depth", "f8", ("time",), fill_value=9.969209968386869e36)
        depth.comment = "simulated"
        depth[:] = new["depth"][:]
        depth[3] = 9.969209968386869e36
        old.glidercli = new.glidercli
    back = read([tmp_path / "old.nc"]).log
    assert back["depth"].time_ns.tolist() == np.delete(times, 3).tolist()


def test_a_row_without_a_sample_is_dropped_and_counted(tmp_path: Path) -> None:
    write(long_log(), tmp_path / "a.nc")
    with netCDF4.Dataset(tmp_path / "a.nc", "a") as file:
        file["depth"][1] = np.nan
    report = read_own_netcdf(tmp_path / "a.nc").report
    assert (report.records, report.kept, report.dropped) == (400, 399, (("no value", 1),))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda f: f.setncattr("glidercli", "{"), "it is no JSON"),
        (lambda f: f.setncattr("glidercli", "[]"), "it holds no object"),
        (lambda f: f["depth"].delncattr("_FillValue") or f["depth"].delncattr("comment"), "damaged"),
    ],
)
def test_what_was_changed_is_refused_in_one_line(tmp_path: Path, change: object, words: str) -> None:
    write(long_log(), tmp_path / "a.nc")
    with netCDF4.Dataset(tmp_path / "a.nc", "a") as file:
        change(file)  # type: ignore[operator]
    with pytest.raises(InputError, match=words) as caught:
        read([tmp_path / "a.nc"])
    assert "\n" not in str(caught.value)


def test_what_is_no_netcdf_of_glider_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.nc").write_text("time_utc,depth_m\n")
    with pytest.raises(InputError, match="is no NetCDF file"):
        read([tmp_path / "a.nc"], format="glider-nc")
    netCDF4.Dataset(tmp_path / "b.nc", "w").close()
    with pytest.raises(InputError, match="that glider did not write"):
        read([tmp_path / "b.nc"], format="glider-nc")


DAMAGE = """
import sys, random, pathlib
from glidercli.errors import InputError
from glidercli.logio import read
source, target, seed = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), int(sys.argv[3])
whole, random_ = source.read_bytes(), random.Random(seed)
for _ in range(12):
    data = bytearray(whole)
    if random_.random() < 0.4:
        data = data[: random_.randrange(len(data))]
    else:
        for _ in range(random_.randint(1, 4)):
            data[random_.randrange(len(data))] ^= 1 << random_.randrange(8)
    target.write_bytes(data)
    try:
        read([target])
    except InputError as error:
        assert "\\n" not in str(error)
"""


@pytest.mark.parametrize("ending", [".nc", ".parquet"])
def test_damage_ends_in_one_line_and_never_in_a_crash(tmp_path: Path, ending: str) -> None:
    """In a process of its own, for HDF5 is C."""
    write(long_log(), tmp_path / f"a{ending}")
    for seed in range(3):
        command = [sys.executable, "-c", DAMAGE, tmp_path / f"a{ending}", tmp_path / f"b{ending}", str(seed)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, cwd=ROOT)
        assert done.returncode == 0, done.stderr


def test_a_length_that_no_file_can_hold_allocates_nothing(tmp_path: Path) -> None:
    with netCDF4.Dataset(tmp_path / "a.nc", "w") as file:
        file.createDimension("time", 2**31)
        file.createVariable("time", "f8", ("time",), compression="zlib").units = "seconds since 2000-01-01"
        file.glidercli = '{"origin": "measured", "metadata": {}, "channels": {}, "events": [], "span_ns": null}'
    with pytest.raises(InputError, match="announces 2147483648 records, more than a file of its size can hold"):
        read([tmp_path / "a.nc"])


def test_no_channel_and_empty_channels_come_back(tmp_path: Path) -> None:
    none = np.array([], np.int64)
    for log in (
        Log({}, "derived", {"provenance": "{}"}, (Event("a", 5),)),
        Log({"pitch": Channel("pitch", none, np.array([]), "derived")}, "measured", {"provenance": "{}"}),
    ):
        write(log, tmp_path / "a.nc", force=True)
        assert_same(read_own_netcdf(tmp_path / "a.nc").log, log)


@pytest.mark.parametrize(
    ("units", "value", "time"),
    [
        ("seconds since 1970-01-01T00:00:00Z", 1.5, "1970-01-01T00:00:01.5"),
        ("days since 1950-01-01 00:00:00", 7305.25, "1970-01-01T06:00:00"),
        ("nanoseconds since 2010-09-03 18:24:38.193000192", 8, "2010-09-03T18:24:38.193000200"),
        ("minutes since 1981-1-1 0:0:0 +02:00", 1, "1980-12-31T22:01:00"),
        ("hours since 2000-01-01T00:00:00+00:00", 1, "2000-01-01T01:00:00"),
    ],
)
def test_times_of_any_unit_are_exact(units: str, value: float, time: str) -> None:
    assert ticks(np.array([value]), *zero_and_unit(units)).astype("datetime64[ns]")[0] == np.datetime64(time, "ns")


@pytest.mark.parametrize("calendar", ["standard", "proleptic_gregorian"])
@pytest.mark.parametrize("units", ["days since 0001-01-01", "days since 1582-10-04", "days since 1582-10-15"])
def test_times_since_long_ago_are_those_of_cftime(units: str, calendar: str) -> None:
    """The standard calendar of CF is Julian before 1582-10-15: two days off in the year 1."""
    days = float(cftime.date2num(cftime.datetime(2019, 6, 20, 12, calendar=calendar), units, calendar))
    for values in (np.array([days, np.nan, 1e300]), np.array([int(days), 0, 2**62])):
        found = ticks(values, *zero_and_unit(units, calendar))
        told = cftime.num2date(values[0], units, calendar)
        assert found.astype("datetime64[ns]")[0] == np.datetime64(told.isoformat(), "ns")
        assert (found[1:] == NO_TIME).all()
    assert ticks(np.array([1.0]), *zero_and_unit(units.replace("days", "ns"), calendar))[0] == NO_TIME


@pytest.mark.parametrize("units", ["seconds", "fortnights since 2000-01-01", "seconds since soon", ""])
def test_units_that_tell_no_time_are_refused(units: str) -> None:
    with pytest.raises(ValueError, match="needed is like"):
        zero_and_unit(units)


def test_every_channel_is_in_the_table_of_the_contract() -> None:
    assert not {"time", "time_ns", "trajectory"} & set(CHANNELS)  # the other variables of a file
