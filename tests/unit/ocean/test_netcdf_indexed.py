"""Indexed ragged arrays of profiles (CF conventions 1.11, section 9.3.4 and H.3.5), and files of a single level."""

from __future__ import annotations

import gsw
import netCDF4
import numpy as np
import pytest

from glidercli.errors import InputError
from glidercli.ocean.kind import holds_profiles
from glidercli.ocean.water_file import read_casts, read_currents


def indexed(path, index, feature="profile", along_time=False):
    with netCDF4.Dataset(path, "w") as file:
        file.featureType = feature
        file.createDimension("profile", 2)
        file.createDimension("obs", len(index))
        file.createVariable("parent", "i4", ("obs",), fill_value=-9).instance_dimension = "profile"
        file["parent"][:] = index
        for name, standard, unit, values in (
            ("z", "depth", "m", [0, 100, 10, 110, 20]),
            ("t", "sea_water_temperature", "degree_C", [20, 10, 19, 9, 18]),
            ("s", "sea_water_practical_salinity", "1", [35, 36, 35.1, 36.1, 35.2]),
        ):
            file.createVariable(name, "f8", ("obs",)).setncatts({"standard_name": standard, "units": unit})
            file[name][:] = values
        file["z"].positive = "down"
        for name, standard, unit, values in (
            ("time", "time", "days since 2020-01-01", [3.0, 1.0]),
            ("lat", "latitude", "degrees_north", [30.0, 31.0]),
        ):
            dimension = "obs" if along_time and name == "time" else "profile"
            file.createVariable(name, "f8", (dimension,)).setncatts({"standard_name": standard, "units": unit})
            file[name][:] = values if dimension == "profile" else np.arange(5.0)
    return path


def test_samples_of_two_profiles_in_turns(tmp_path):
    path = indexed(tmp_path / "i.nc", [0, 1, 0, 1, 0])
    assert holds_profiles(path)
    one, two = read_casts(path)
    assert (one.depth.tolist(), two.depth.tolist()) == ([0.0, 10.0, 20.0], [100.0, 110.0])
    assert (one.temperature.tolist(), two.salinity.tolist()) == ([20.0, 19.0, 18.0], [36.0, 36.1])
    assert (one.latitude, two.latitude) == (30.0, 31.0)
    assert one.moment.seconds - two.moment.seconds == 2 * 86400.0


@pytest.mark.parametrize("wrong", [2, -1, -9])
def test_a_sample_of_no_profile(tmp_path, wrong):
    path = indexed(tmp_path / "i.nc", [0, 1, wrong, 1, 0])
    with pytest.raises(InputError, match=r"parent of sample 2 is -?\d; allowed are the profiles 0 to 1"):
        read_casts(path)


def test_trajectories_are_a_log(tmp_path):
    assert not holds_profiles(indexed(tmp_path / "i.nc", [0, 0, 0, 0, 0], "trajectory", along_time=True))


@pytest.mark.parametrize("dimensions", [("depth",), ("time", "depth"), ("time",)])
def test_a_single_level_is_no_profile(tmp_path, dimensions):
    path = tmp_path / "one.nc"
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("time", 4)
        file.createDimension("depth", 1)
        file.createVariable("depth", "f8", ("depth",)).setncatts({"standard_name": "depth", "units": "m"})
        file["depth"][:] = 5.0
        for name, standard, unit in (("t", "sea_water_temperature", "degC"), ("s", "sea_water_salinity", "1")):
            file.createVariable(name, "f8", dimensions).setncatts({"standard_name": standard, "units": unit})
            file[name][:] = 10.0
    with pytest.raises(InputError, match=r"t is at a single depth \(depth\); a profile needs at least two"):
        read_casts(path)


def test_a_current_at_the_equator_has_its_own_latitude_not_the_flights(tmp_path):
    path = tmp_path / "flow.nc"
    p = np.array([1000.0, 2000.0])
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("p", 2)
        for name, standard, unit, values in (
            ("p", "sea_water_pressure", "dbar", p),
            ("u", "eastward_sea_water_velocity", "m s-1", [0.1, 0.2]),
            ("v", "northward_sea_water_velocity", "m s-1", [0.1, 0.2]),
        ):
            file.createVariable(name, "f8", ("p",)).setncatts({"standard_name": standard, "units": unit})
            file[name][:] = values
        file.createVariable("lat", "f8", ()).setncatts({"standard_name": "latitude", "units": "degrees_north"})
        file["lat"][...] = 0.0
    (flow,) = read_currents(path, latitude=60.0)
    assert flow.depth == pytest.approx(-gsw.z_from_p(p, 0.0), abs=1e-9)
