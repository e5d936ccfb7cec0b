"""Positions that are no fixes: the place of absolute salinity, and the track of a log without attitude."""

from __future__ import annotations

import csv
import gzip
import shutil
from pathlib import Path

import gsw
import netCDF4
import numpy as np
import pytest
from conftest import ROOT
from test_ioos import profile

from glidercli.logio import read
from glidercli.logio.records import NO_TIME
from glidercli.logio.whereabouts import joined_whereabouts, whereabouts
from glidercli.ocean.from_log import casts_of_log

SEA063 = ROOT / "tests/data/seaexplorer"


def density_at(log, longitude, latitude):
    times, (s, t, p) = log.together("salinity", "temperature", "pressure")
    p_dbar = np.maximum(p * 1e-4, 0.0)
    assert np.array_equal(times, log["density"].time_ns)
    return gsw.rho_t_exact(gsw.SA_from_SP(s, p_dbar, longitude, latitude), t, p_dbar)


def test_the_reckoned_positions_of_sea063_make_its_density_that_of_the_baltic():
    log = read([SEA063]).log
    assert not {"latitude", "longitude"} & log.channels.keys()
    rows = []
    for path in sorted(SEA063.glob("*.gli.*.gz")):
        with gzip.open(path, "rt") as text:
            rows += [(float(row["Lat"]), float(row["Lon"])) for row in csv.DictReader(text, delimiter=";")]
    latitude, longitude = (
        sum(int(v // 100) + v % 100 / 60 for v in column) / len(rows) for column in zip(*rows, strict=True)
    )
    # the dives go over 0.01 deg; the anomaly of the Baltic, 0.087 (1 - SP / 35) g/kg, does not change with the place
    assert log["density"].values == pytest.approx(density_at(log, longitude, latitude), abs=1e-6)
    assert float(log.metadata["near_latitude_deg"]) == pytest.approx(latitude, abs=0.01)
    assert float(log.metadata["near_longitude_deg"]) == pytest.approx(longitude, abs=0.01)
    s, t, p = log.together("salinity", "temperature", "pressure")[1]
    wrong = gsw.rho_t_exact(gsw.SR_from_SP(s), t, np.maximum(p * 1e-4, 0.0))
    assert 0.035 < np.abs(log["density"].values - wrong).min() < 0.06  # 0.8 kg/m3 for each g/kg
    assert "no fixes" in log.metadata["density_note"]
    casts = casts_of_log(log)
    assert casts[0].longitude == pytest.approx(longitude, abs=0.01)
    assert not [line for cast in casts for line in cast.warnings if "absolute salinity" in line]


def test_a_payload_alone_tells_where_it_was() -> None:
    """NAV_LATITUDE and NAV_LONGITUDE are those of the navigation file: 5529.383 is 55 deg and 29.383 minutes."""
    log = read([SEA063 / "sea063.22.pld1.sub.120.gz"]).log
    assert float(log.metadata["near_latitude_deg"]) == pytest.approx(55.0 + 29.35 / 60.0, abs=0.005)
    assert float(log.metadata["near_longitude_deg"]) == pytest.approx(16.0 + 16.03 / 60.0, abs=0.005)
    assert log["density"].values == pytest.approx(density_at(log, 16.2672, 55.4892), abs=1e-6)
    assert not {"latitude", "longitude"} & log.channels.keys()
    near = float(log.metadata["near_latitude_deg"])
    assert log["depth"].origin == "derived"
    expected = -gsw.z_from_p(log["pressure"].values / 1e4, near)
    np.testing.assert_allclose(log["depth"].values, expected, rtol=1e-9)  # the latitude is told in few digits; 45: 1e-3
    assert "no fixes" in log.metadata["depth_note"]


@pytest.mark.parametrize("names", [("lat", "lon"), ("profile_lat", "profile_lon")])
def test_interpolated_positions_of_ioos_files(tmp_path: Path, names):
    sea035 = read([ROOT / "logs/seaexplorer-sea035"]).log
    path = profile(tmp_path / "a.nc", sea035, slice(0, 200), 1)
    with netCDF4.Dataset(path, "a") as file:
        if names[0] == "lat":
            file["lat"][:], file["lon"][:] = 55.0, 200.0
            for name in names:  # as IOOS flags what it interpolates
                file.createVariable(f"{name}_qc", "i1", ("time",), fill_value=-127)[:] = 8
        else:
            file["lat"][:] = -999.0
            for name, value in zip(names, (55.0, 200.0), strict=True):
                file.createVariable(name, "f8", (), fill_value=-999.0).units = "degrees"
                file[name][...] = value
    log = read([path]).log
    assert "latitude" not in log
    assert log["density"].values == pytest.approx(density_at(log, 200.0, 55.0), abs=1e-9)
    assert (log.metadata["near_latitude_deg"], log.metadata["near_longitude_deg"]) == ("55.0", "-160.0")
    assert {(cast.latitude, cast.longitude) for cast in casts_of_log(log)} == {(55.0, -160.0)}


def test_what_is_no_position_is_left_out_and_one_in_ten_minutes_is_kept():
    nan, minute = np.nan, 60 * 10**9
    times = np.array([30, 0, 1, 2, NO_TIME // minute, 15, 16, 17]) * minute
    times[4] = NO_TIME
    found = whereabouts(times, np.array([3.0, 1, 1.1, 0, 5, nan, 95, 2]), np.array([-179.0, 179, 179, 0, 5, 2, 2, 181]))
    assert found.time_ns.tolist() == [0, minute, 17 * minute, 30 * minute]
    found = found.sparse
    assert found.time_ns.tolist() == [0, 17 * minute, 30 * minute]
    assert found.latitude.tolist() == [1.0, 2.0, 3.0]
    assert found.middle == (2.0, -179.0)
    latitude, longitude = found.at(np.array([0, 30]) * minute)
    assert (latitude.tolist(), np.mod(longitude, 360.0).tolist()) == ([1.0, 3.0], [179.0, 181.0])
    assert whereabouts(times[:1], np.array([nan]), np.array([1.0])) is None
    assert joined_whereabouts([None]) is None
    assert joined_whereabouts([None, found, found]).time_ns.tolist() == found.time_ns.tolist()


def test_positions_of_a_plain_table_that_are_no_fixes(tmp_path: Path):
    (tmp_path / "columns.toml").write_text(
        '[time]\ncolumn = "t"\nformat = "unix"\n[columns]\nlatitude = { column = "y", unit = "deg" }\n'
        'longitude = { column = "x", unit = "deg" }\nsalinity = { column = "s", unit = "1" }\n'
        'depth = { column = "z", unit = "m" }\ntemperature = { column = "c", unit = "degC" }\n'
        'pressure = { column = "p", unit = "dbar" }\n'
    )
    rows = "".join(f"{1.6e9 + i},55.5,16,{10 + i % 3},{20 + i},5,{20 + i}\n" for i in range(9))
    (tmp_path / "dive.csv").write_text("t,y,x,s,z,c,p\n" + rows)
    log = read([tmp_path / "dive.csv"]).log
    assert not {"latitude", "longitude"} & log.channels.keys()
    assert log["density"].values == pytest.approx(density_at(log, 16.0, 55.5), abs=1e-9)


def on_the_ground(log, latitude, longitude):
    """How far the track is from places, m, by the length of a degree at its latitude (0.1 % by these digits)."""
    metres = 111_132.95 - 559.85 * np.cos(np.radians(2.0 * latitude)), 111_412.88 * np.cos(np.radians(latitude))
    metres = metres[0], metres[1] - 93.5 * np.cos(np.radians(3.0 * latitude))
    way = (latitude - latitude[0]) * metres[0].mean(), (longitude - longitude[0]) * metres[1].mean()
    return np.hypot(log["north"].values - way[0], log["east"].values - way[1])


def test_an_ioos_profile_is_drawn_through_its_positions(tmp_path: Path):
    path = profile(tmp_path / "a.nc", read([ROOT / "logs/seaexplorer-sea035"]).log, slice(0, 200), 1)
    log = read([path]).log
    assert "latitude" not in log
    with netCDF4.Dataset(path) as file:
        latitude, longitude = file["lat"][:].data, file["lon"][:].data
    assert log["north"].time_ns.tolist() == log["depth"].time_ns.tolist()
    assert on_the_ground(log, latitude, longitude).max() < 0.002 * 15_000.0  # 0.1 deg each way is 15 km
    assert log["down"].values.tolist() == log["depth"].values.tolist()
    assert {log[name].origin for name in ("north", "east", "down")} == {"derived"}
    assert "drawn through 200 recorded positions" in log.metadata["track_note"]


def test_an_og1_mission_without_heading_is_drawn_through_its_positions(tmp_path: Path):
    source = ROOT / "tests/data/netcdf/sg033_20100903T182416_first-rows.nc"
    shutil.copy(source, tmp_path / "a.nc")
    with netCDF4.Dataset(tmp_path / "a.nc", "a") as file:
        file.renameVariable("HEADING", "UNTOLD")
        file["UNTOLD"].standard_name = "untold"
        latitude, longitude = (file[name][:].filled(np.nan) for name in ("LATITUDE", "LONGITUDE"))
        times = file["TIME"][:].data
    log = read([tmp_path / "a.nc"]).log
    assert "no heading" in log.metadata["track_note"]
    assert len(log["north"]) > 0.9 * len(log["depth"])
    at = np.abs(times[:, np.newaxis] - log["north"].time_ns * 1e-9).argmin(axis=0)
    assert on_the_ground(log, latitude[at], longitude[at]).max() < 20.0  # of some 5 km
    assert len(log["latitude"]) == len(read([source]).log["latitude"])  # fixes alone


def test_a_payload_alone_is_drawn_where_the_vehicle_took_itself_to_be():
    log = read([SEA063 / "sea063.22.pld1.sub.120.gz"]).log
    assert "reckoned by whoever told them" in log.metadata["track_note"]
    assert len(log["north"]) == len(log["depth"])
    both = read([SEA063 / "sea063.22.pld1.sub.120.gz", SEA063 / "sea063.22.gli.sub.120.gz"]).log
    assert "dead reckoned" in both.metadata["track_note"]


def test_order_of_files_with_and_without_attitude_changes_nothing():
    files = [SEA063 / "sea063.22.pld1.sub.120.gz", SEA063 / "sea063.22.gli.sub.120.gz"]
    one, other = read(files).log, read(files[::-1]).log
    assert one["density"].values.tolist() == other["density"].values.tolist()
    assert one.metadata == other.metadata
