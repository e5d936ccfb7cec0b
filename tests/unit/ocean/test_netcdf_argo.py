"""Argo profile files after the user's manual 3.4: adjusted values, modes, flags, a second sampling of the same time."""

from __future__ import annotations

import netCDF4
import numpy as np
import pytest

from glidercli.ocean.water_file import read_casts

P = np.array([[5.0, 10.0, 20.0], [5.0, 10.0, 20.0], [1.0, 2.0, np.nan]])
T, S = 20.0 - P / 10.0, 35.0 + P / 100.0


def argo(path, modes="DR", juld=(25000.5, 25010.5, 25010.5), adjust=(True, False, False), flags=None):
    with netCDF4.Dataset(path, "w", format="NETCDF3_CLASSIC") as file:
        file.createDimension("N_PROF", 3)
        file.createDimension("N_LEVELS", 3)
        if modes:
            file.createVariable("DATA_MODE", "S1", ("N_PROF",), fill_value=b" ")[:] = np.array(list(modes), "S1")
        units = "days since 1950-01-01 00:00:00 UTC"
        file.createVariable("JULD", "f8", ("N_PROF",), fill_value=999999.0).setncatts(
            {"standard_name": "time", "units": units, "conventions": "Relative julian days"}
        )
        file["JULD"][:] = juld
        for name, place in (("LATITUDE", 30.0), ("LONGITUDE", -40.0)):
            file.createVariable(name, "f8", ("N_PROF",), fill_value=99999.0).standard_name = name.lower()
            file[name][:] = place
        for name, standard, unit, values in (
            ("PRES", "sea_water_pressure", "decibar", P),
            ("TEMP", "sea_water_temperature", "degree_Celsius", T),
            ("PSAL", "sea_water_salinity", "psu", S),
        ):
            for end, shift in (("_ADJUSTED", -0.5), ("", 0.0)):  # even where the adjusted ones come first
                here = file.createVariable(name + end, "f4", ("N_PROF", "N_LEVELS"), fill_value=99999.0)
                here.setncatts({"standard_name": standard, "units": unit})
                here[:] = np.ma.masked_invalid(values + shift)
                qc = file.createVariable(f"{name}{end}_QC", "S1", ("N_PROF", "N_LEVELS"), fill_value=b" ")
                qc.conventions = "Argo reference table 2"
                qc[:] = np.full((3, 3), b"1")
                if end:
                    here[~np.array(adjust)] = np.ma.masked
        for name, row, column, flag in flags or ():
            file[name][row, column] = flag
    return path


def test_adjusted_values_of_the_profiles_that_have_them(tmp_path):
    one, two = read_casts(argo(tmp_path / "d.nc", "DRR"))
    assert one.pressure_dbar.tolist() == (P[0] - 0.5).tolist()
    assert one.temperature == pytest.approx(T[0] - 0.5, abs=1e-5)  # stored in 4 bytes
    assert one.salinity == pytest.approx(S[0] - 0.5, abs=1e-5)
    assert two.pressure_dbar.tolist() == P[1].tolist()
    assert "PRES_ADJUSTED, TEMP_ADJUSTED, PSAL_ADJUSTED are used of 1 of 3 profiles (DATA_MODE D)" in one.warnings
    assert ("in a profile of a further sampling at the same time", 2) in one.dropped
    assert one.records + two.records == 8


def test_what_delayed_mode_emptied_or_flagged_is_not_taken_as_recorded(tmp_path):
    flags = [("PSAL_ADJUSTED", 0, 1, np.ma.masked)]
    (one, _) = read_casts(argo(tmp_path / "d.nc", "DRR", flags=flags))
    assert one.pressure_dbar.tolist() == [4.5, 19.5]
    assert ("without salinity", 1) in one.dropped
    (one, _) = read_casts(
        argo(tmp_path / "q.nc", "ARR", flags=[("TEMP_ADJUSTED_QC", 0, 2, b"4"), ("TEMP_QC", 0, 0, b"4")])
    )
    assert one.pressure_dbar.tolist() == [4.5, 9.5]  # the flags of what is used count
    assert ("flagged bad", 1) in one.dropped


def test_without_modes_the_adjusted_values_that_are_there(tmp_path):
    path = argo(tmp_path / "n.nc", "", juld=(25000.5, 25010.5, 25020.5))
    one, two, three = read_casts(path)
    assert (one.pressure_dbar[0], two.pressure_dbar[0], three.pressure_dbar[0]) == (4.5, 5.0, 1.0)
    assert "PRES_ADJUSTED, TEMP_ADJUSTED, PSAL_ADJUSTED are used of 1 of 3 profiles" in one.warnings


def test_in_real_time_nothing_is_adjusted_and_nothing_is_said(tmp_path):
    one, *_ = read_casts(argo(tmp_path / "r.nc", "RRR", adjust=(False, False, False)))
    assert one.pressure_dbar.tolist() == P[0].tolist()
    assert not [line for line in one.warnings if "ADJUSTED" in line]
