"""NetCDF files after published layouts, written by xarray or netCDF4; held against what was written, xarray and gsw."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import gsw
import netCDF4
import numpy as np
import pytest
import xarray as xr

from glidercli.errors import InputError
from glidercli.ocean.kind import holds_profiles
from glidercli.ocean.water_file import read_casts, read_currents

Z = np.array([5.0, 10.0, 20.0, 50.0, 100.0])
T = np.array([[20.0, 19.0, 15.0, 10.0, 8.0], [21.0, 19.5, 15.5, 10.0, 8.0], [22.0, 20.0, 16.0, 10.0, 8.0]])
S = 35.0 + 0.01 * np.arange(5.0) + np.zeros((3, 1))
HOURS = np.array(["2020-05-01T00", "2020-05-01T06", "2020-05-01T12"], dtype="datetime64[ns]")
SECONDS = HOURS.astype(np.int64) / 1e9


def standard(name, units, **more):
    return {"standard_name": name, "units": units, **more}


def save(dataset, path, **options):
    dataset.to_netcdf(path, **options)
    return path


@pytest.fixture
def mooring():
    """OceanSITES: TEMP and PSAL by TIME and DEPTH, flags beside them."""
    flags = np.ones((3, 5), dtype=np.int8)
    flags[1, 2] = 4
    return xr.Dataset(
        {
            "TEMP": (("TIME", "DEPTH"), T, standard("sea_water_temperature", "degree_Celsius", ancillary_variables="TEMP_QC")),
            "TEMP_QC": (("TIME", "DEPTH"), flags, {"flag_values": np.array([1, 4], dtype=np.int8), "flag_meanings": "good bad"}),
            "PSAL": (("TIME", "DEPTH"), S, standard("sea_water_practical_salinity", "1")),
        },
        {
            "TIME": ("TIME", HOURS, {"standard_name": "time"}),
            "DEPTH": ("DEPTH", Z, standard("depth", "meters", positive="down")),
            "LATITUDE": ("LATITUDE", [30.0], standard("latitude", "degrees_north")),
            "LONGITUDE": ("LONGITUDE", [-40.0], standard("longitude", "degrees_east")),
        },
    )  # fmt: skip


def test_a_mooring_is_casts_in_time(mooring, tmp_path):
    path = save(mooring, tmp_path / "m.nc")
    casts = read_casts(path)
    assert [cast.moment.seconds for cast in casts] == SECONDS.tolist()
    assert casts[0].temperature.tolist() == T[0].tolist()
    assert casts[1].depth.tolist() == [5.0, 10.0, 50.0, 100.0]
    assert casts[1].dropped == (("flagged bad", 1),)
    assert sum(cast.records for cast in casts) == 15
    p = gsw.p_from_z(-Z, 30.0)
    assert casts[0].density == pytest.approx(gsw.rho_t_exact(gsw.SA_from_SP(S[0], p, -40.0, 30.0), T[0], p), abs=2e-3)
    with xr.open_dataset(path) as same:
        assert casts[2].salinity.tolist() == same["PSAL"].values[2].tolist()
    assert holds_profiles(path)


@pytest.mark.parametrize("order", [("TIME", "DEPTH"), ("DEPTH", "TIME")])
@pytest.mark.parametrize("up", [False, True])
def test_any_orientation_of_dimensions_and_depths(mooring, tmp_path, order, up):
    turned = mooring.transpose(*order, "LATITUDE", "LONGITUDE")
    if up:
        turned = turned.assign_coords(DEPTH=("DEPTH", -Z, standard("depth", "m", positive="up"))).isel(
            DEPTH=slice(None, None, -1)
        )
    for cast, expected in zip(
        read_casts(save(turned, tmp_path / "t.nc")), read_casts(save(mooring, tmp_path / "m.nc")), strict=True
    ):
        assert cast.depth.tolist() == expected.depth.tolist()
        assert cast.density.tolist() == expected.density.tolist()


def test_casts_of_a_cruise_with_a_pressure_each(tmp_path):
    """CCHDO: N_PROF by N_LEVELS, padded, pressure of its own for each cast."""
    p = np.array([[1.0, 11.0, 21.0, np.nan], [2.0, 12.0, 22.0, 32.0]])
    t = np.array([[20.0, np.nan, 18.0, np.nan], [19.0, 18.0, 17.0, 16.0]])
    made = xr.Dataset(
        {
            "ctd_temperature": (("N_PROF", "N_LEVELS"), t, standard("sea_water_temperature", "degC")),
            "ctd_salinity": (("N_PROF", "N_LEVELS"), np.where(np.isnan(p), np.nan, 35.0), standard("sea_water_practical_salinity", "1")),
            "pressure": (("N_PROF", "N_LEVELS"), p, standard("sea_water_pressure", "dbar", positive="down")),
            "time": ("N_PROF", HOURS[:2], {"standard_name": "time"}),
            "latitude": ("N_PROF", [-60.0, -59.0], standard("latitude", "degrees_north")),
            "longitude": ("N_PROF", [0.0, 1.0], standard("longitude", "degrees_east")),
        },
        attrs={"featureType": "profile"},
    )  # fmt: skip
    one, two = read_casts(save(made, tmp_path / "c.nc"))
    assert one.pressure_dbar.tolist() == [1.0, 21.0]
    assert (one.latitude, two.latitude) == (-60.0, -59.0)
    assert two.depth == pytest.approx(-gsw.z_from_p(p[1], -59.0), abs=1e-9)
    assert one.dropped == (("without temperature", 1),)  # the padding is no sample
    assert one.records + two.records == 7


def test_a_contiguous_ragged_array(tmp_path):
    """World Ocean Database: the samples of all casts behind one another, counted for each variable."""
    path = tmp_path / "wod.nc"
    with netCDF4.Dataset(path, "w") as made:
        made.createDimension("casts", 3)
        made.createDimension("z_obs", 7)
        made.createDimension("Temperature_obs", 7)
        made.createDimension("Salinity_obs", 5)
        for name, dimension, values, attributes in (
            ("z", "z_obs", [0, 10, 20, 0, 5, 0, 7], standard("depth", "m", positive="down")),
            ("Temperature", "Temperature_obs", [20, 19, 18, 17, 16, 15, 14], standard("sea_water_temperature", "degree_C")),
            ("Salinity", "Salinity_obs", [35, 35.1, 35.2, 34, 34.1], standard("sea_water_salinity", "psu")),
            ("z_row_size", "casts", [3, 2, 2], {"sample_dimension": "z_obs"}),
            ("Temperature_row_size", "casts", [3, 2, 2], {"sample_dimension": "Temperature_obs"}),
            ("Salinity_row_size", "casts", [3, 2, 0], {"sample_dimension": "Salinity_obs"}),
            ("lat", "casts", [10, 11, 12], standard("latitude", "degrees_north")),
            ("lon", "casts", [20, 21, 22], standard("longitude", "degrees_east")),
            ("time", "casts", [100.0, 101.5, 103.0], standard("time", "days since 1770-01-01")),
        ):  # fmt: skip
            made.createVariable(name, "f8" if "row" not in name else "i4", (dimension,))[:] = values
            made[name].setncatts(attributes)
    casts = read_casts(path)
    assert [cast.temperature.tolist() for cast in casts] == [[20.0, 19.0, 18.0], [17.0, 16.0]]
    assert [cast.salinity.tolist() for cast in casts] == [[35.0, 35.1, 35.2], [34.0, 34.1]]
    assert casts[1].latitude == 11.0
    first = np.datetime64("1770-01-01") + np.timedelta64(100, "D")
    assert casts[0].moment.seconds == first.astype("datetime64[s]").astype(np.int64)
    assert sum(cast.records for cast in casts) == 7
    assert dict(casts[0].dropped) == {"without salinity": 2}
    assert holds_profiles(path)


def test_a_model_with_potential_temperature(tmp_path):
    """Copernicus Marine: thetao, so, uo, vo by time, depth, latitude and longitude; one place of it."""
    four = ("time", "depth", "latitude", "longitude")
    shape = (3, 5, 1, 1)
    made = xr.Dataset(
        {
            "thetao": (four, T.reshape(shape), standard("sea_water_potential_temperature", "degrees_C")),
            "so": (four, S.reshape(shape), standard("sea_water_salinity", "1e-3")),
            "uo": (four, 0.1 * T.reshape(shape), standard("eastward_sea_water_velocity", "m s-1")),
            "vo": (four, np.full(shape, -10.0), standard("northward_sea_water_velocity", "cm s-1")),
        },
        {
            "time": HOURS,
            "depth": ("depth", Z, standard("depth", "m", positive="down")),
            "latitude": ("latitude", [30.0], standard("latitude", "degrees_north")),
            "longitude": ("longitude", [-40.0], standard("longitude", "degrees_east")),
        },
    )  # fmt: skip
    path = save(made, tmp_path / "model.nc")
    cast = read_casts(path)[0]
    p = gsw.p_from_z(-Z, 30.0)
    SA = gsw.SA_from_SP(S[0], p, -40.0, 30.0)
    assert gsw.pt0_from_t(SA, cast.temperature, p) == pytest.approx(T[0], abs=1e-6)  # its own Newton iteration
    assert (cast.temperature > T[0])[1:].all()  # compression warms
    profile = read_currents(path)[1]
    assert profile.east == pytest.approx(0.1 * T[1], abs=1e-12)
    assert profile.north.tolist() == [-0.1] * 5
    wide = xr.concat([made, made.assign_coords(latitude=[31.0])], "latitude")
    with pytest.raises(InputError, match=r"thetao has the dimensions .*latitude 2.*at one place"):
        read_casts(save(wide, tmp_path / "wide.nc"))


def test_missing_bins_are_gaps_not_zeros(tmp_path):
    path = tmp_path / "gaps.nc"
    with netCDF4.Dataset(path, "w") as made:
        made.createDimension("time", 2)
        made.createDimension("depth", 6)
        made.createVariable("time", "f8", ("time",)).setncatts(standard("time", "seconds since 2020-01-01"))
        made.createVariable("depth", "f4", ("depth",)).setncatts(standard("depth", "m"))
        made["time"][:], made["depth"][:] = [0, 600], [2, 4, 6, 8, 10, 12]
        for name, direction in (("u", "eastward"), ("v", "northward")):
            made.createVariable(name, "i2", ("time", "depth"), fill_value=-999)
            made[name].setncatts(
                standard(f"{direction}_sea_water_velocity", "m s-1", scale_factor=0.001, valid_max=np.int16(20000))
            )
        # a fill value, one above the valid maximum, the mark of a bad velocity, one faster than any sea
        made["u"].set_auto_maskandscale(False)
        made["v"].set_auto_maskandscale(False)
        made["u"][:] = [[100, -999, 25000, -32768, 9000, 200], [100, 110, 120, 130, 140, 150]]
        made["v"][:] = [[0, 0, 0, 0, 0, -300], [0, 0, 0, 0, 0, 0]]
    one, two = read_currents(path)
    assert one.depth.tolist() == [2.0, 12.0]
    assert one.east == pytest.approx([0.1, 0.2], abs=1e-12)
    assert one.north == pytest.approx([0.0, -0.3], abs=1e-12)
    assert dict(one.dropped) == {"gap": 2, "bad-velocity mark -32.768": 1, "faster than 5 m/s": 1}
    assert one.records + two.records == 12
    assert "4 of 12 bins left out" in " ".join(one.warnings)


@pytest.mark.parametrize("where", ["file", "variable"])
@pytest.mark.parametrize("frame", ["beam", "inst", "ship", "principal"])
def test_frames_other_than_earth_are_refused(tmp_path, where, frame):
    told = {"coord_sys": frame}
    made = xr.Dataset(
        {name: (("depth",), [0.1, 0.2], told if where == "variable" else {}) for name in ("u", "v")},
        {"depth": [1.0, 2.0]},
        told if where == "file" else {},
    )
    with pytest.raises(InputError, match=f"coord_sys = {frame}: the current is not in the earth frame"):
        read_currents(save(made, tmp_path / "f.nc"))


def test_a_table_in_another_frame_is_refused(write):
    text = "depth_m,current_east_m_s,current_north_m_s,coordinate_system\n1,0.1,0,{0}\n2,0.1,0,{0}\n"
    (profile,) = read_currents(write("e.csv", text.format("earth")))
    assert not profile.warnings
    with pytest.raises(InputError, match="line 2: coordinate_system = beam: the current is not in the earth frame"):
        read_currents(write("b.csv", text.format("beam")))


def test_what_mhkits_dolfyn_saves_is_read_as_its_binary(tmp_path):
    source = Path(__file__).parents[2] / "data" / "adcp" / "RDI_7f79_2.000"
    code = (
        "import sys; from mhkit.dolfyn.io.api import read, save; save(read(sys.argv[1], userdata=False), sys.argv[2])"
    )
    command = [sys.executable, "-c", code, str(source), str(tmp_path / "out.nc")]  # it leaves files open and warns
    subprocess.run(command, check=True, capture_output=True)
    (own,), (exported,) = read_currents(source), read_currents(tmp_path / "out.nc")
    assert exported.east == pytest.approx(own.east, abs=1e-7)
    assert exported.depth == pytest.approx(own.depth, abs=1e-5)


def test_a_single_profile_without_a_time(tmp_path):
    made = xr.Dataset({"temperature": ("z", T[0]), "salinity": ("z", S[0])}, {"z": ("z", Z)})
    (cast,) = read_casts(save(made, tmp_path / "one.nc"), 30.0, -40.0)
    assert cast.moment is None
    assert any("has no units" in line for line in cast.warnings)
    assert cast.latitude == 30.0


def test_units_are_converted(tmp_path):
    made = xr.Dataset(
        {
            "t": ("z", T[0] + 273.15, standard("sea_water_temperature", "K")),
            "c": ("z", [50.0, 49.0, 45.0, 40.0, 38.0], standard("sea_water_electrical_conductivity", "mS cm-1")),
            "p": ("z", [5e4, 1e5, 2e5, 5e5, 1e6], standard("sea_water_pressure", "Pa")),
        }
    )  # fmt: skip
    (cast,) = read_casts(save(made, tmp_path / "u.nc"))
    assert cast.temperature == pytest.approx(T[0], abs=1e-12)
    assert cast.pressure_dbar == pytest.approx([5.0, 10.0, 20.0, 50.0, 100.0], rel=1e-12)
    assert cast.salinity == pytest.approx(gsw.SP_from_C([50, 49, 45, 40, 38], T[0], cast.pressure_dbar), abs=1e-9)


def test_what_is_not_needed_is_not_read(mooring, tmp_path):
    more = mooring.assign(DENS=(("TIME", "DEPTH"), T + 1.0, standard("sea_water_density", "lb/ft3")))
    assert len(read_casts(save(more, tmp_path / "m.nc"))) == 3
    with pytest.raises(InputError, match="DENS is in 'lb/ft3', allowed: kg/m3"):
        read_casts(save(more.drop_vars(["TEMP", "TEMP_QC"]), tmp_path / "d.nc"))


def test_profiles_without_a_time_or_with_too_few_samples_are_counted(mooring, tmp_path):
    values = mooring.TEMP.values.copy()
    values[0, 1:] = np.nan
    times = mooring.TIME.values.copy()
    times[1] = np.datetime64("NaT")
    made = (
        mooring.drop_vars("TEMP_QC")
        .assign(TEMP=(("TIME", "DEPTH"), values, mooring.TEMP.attrs))
        .assign_coords(TIME=("TIME", times, {"standard_name": "time"}))
    )
    (cast,) = read_casts(save(made, tmp_path / "m.nc"))
    assert cast.temperature.tolist() == T[2].tolist()
    assert cast.records == 15
    assert dict(cast.dropped) == {
        "without temperature": 4,
        "in a profile of fewer than two usable samples": 1,
        "in a profile without a time": 5,
    }


def test_a_record_in_time_is_a_log(tmp_path):
    t = np.arange(40)
    depth = np.concatenate([t[:20], 20 - t[:20]]).astype(float)
    made = xr.Dataset(
        {
            "temperature": ("time", 10.0 + 0.0 * depth, standard("sea_water_temperature", "degC")),
            "salinity": ("time", 35.0 + 0.0 * depth, standard("sea_water_practical_salinity", "1")),
            "depth": ("time", depth, standard("depth", "m")),
        },
        {"time": ("time", t, standard("time", "seconds since 2020-01-01"))},
    )
    path = save(made, tmp_path / "trajectory.nc")
    assert not holds_profiles(path)
    with pytest.raises(InputError, match="its depth goes up and down in time: it holds no profiles"):
        read_casts(path)
    down = save(made.isel(time=slice(0, 20)), tmp_path / "down.nc")
    assert holds_profiles(down)
    assert len(read_casts(down)) == 1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.TEMP.attrs.update(units="furlong"), "TEMP is in 'furlong', allowed: degC, K"),
        (lambda d: d.TIME.attrs.update(units="moons since 2020-01-01"), "TIME: units = 'moons"),
    ],
)
def test_units_that_are_not_known(mooring, tmp_path, change, message):
    if "TIME" in message:
        mooring = mooring.assign_coords(TIME=("TIME", [0.0, 1.0, 2.0], {"standard_name": "time"}))
    change(mooring)
    with pytest.raises(InputError, match=message):
        read_casts(save(mooring, tmp_path / "m.nc"))


def test_files_without_water(mooring, tmp_path, write):
    with pytest.raises(InputError, match="has neither temperature nor density; it has LATITUDE"):
        read_casts(save(mooring[["LATITUDE"]].drop_vars("TEMP", errors="ignore"), tmp_path / "a.nc"))
    with pytest.raises(InputError, match="no water that can be used: needed are temperature with salinity"):
        read_casts(save(mooring[["TEMP"]], tmp_path / "b.nc"))
    with pytest.raises(
        InputError, match="has no profile of two usable samples among 15 samples: 14 without temperature, 1 flagged bad"
    ):
        read_casts(
            save(
                mooring.assign(TEMP=mooring.TEMP * np.nan).assign(
                    TEMP=lambda d: d.TEMP.assign_attrs(mooring.TEMP.attrs)
                ),
                tmp_path / "c.nc",
            )
        )
    with pytest.raises(InputError, match="has no eastward_sea_water_velocity"):
        read_currents(save(mooring, tmp_path / "d.nc"))


@pytest.mark.parametrize("format", ["NETCDF4", "NETCDF3_CLASSIC"])
@pytest.mark.parametrize("part", [0.1, 0.5, 0.9])
def test_damaged_files(mooring, tmp_path, write, format, part):
    data = save(mooring.drop_vars("TEMP_QC"), tmp_path / "m.nc", format=format).read_bytes()
    path = write("cut.nc", data[: int(part * len(data))])
    with pytest.raises(InputError) as caught:
        read_casts(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


def test_a_header_that_announces_more_than_can_be(tmp_path):
    path = tmp_path / "huge.nc"
    with netCDF4.Dataset(path, "w") as made:
        made.createDimension("depth", 2**31)
        for name in ("temperature", "salinity", "depth"):
            made.createVariable(name, "f8", ("depth",), chunksizes=(1024,), zlib=True)
    assert path.stat().st_size < 1e5
    with pytest.raises(InputError, match=r"has 2.1e\+09 values, allowed are 5e\+07"):
        read_casts(path)


def test_of_several_profiles_one_that_goes_up_and_down_is_left_out_by_name(tmp_path):
    depth = np.array([[5.0, 10.0, 20.0], [5.0, 20.0, 10.0], [20.0, 10.0, 5.0]])
    whole = xr.Dataset(
        {
            "TEMP": (("P", "N"), T[:, :3], standard("sea_water_temperature", "degC")),
            "PSAL": (("P", "N"), S[:, :3], standard("sea_water_practical_salinity", "1")),
            "DEPTH": (("P", "N"), depth, standard("depth", "m", positive="down")),
            "TIME": ("P", HOURS, {"standard_name": "time"}),
        }
    )
    casts = read_casts(save(whole, tmp_path / "m.nc"))
    assert [cast.depth.tolist() for cast in casts] == [[5.0, 10.0, 20.0]] * 2  # the last came from the bottom up
    told = "1 of 3 profiles left out, whose depth goes up and down: profile 1, 2020-05-01T06:00:00Z"
    assert casts[0].warnings[0] == told
    assert ("in a profile whose depth goes up and down", 3) in casts[0].dropped
    assert sum(cast.records for cast in casts) == 9
    with pytest.raises(InputError, match="its depth goes up and down; a profile goes one way"):
        read_casts(save(whole.isel(P=[1]), tmp_path / "one.nc"))
    with pytest.raises(
        InputError, match=r"has no profile of two usable .* 6 in a profile whose depth goes up and down"
    ):
        read_casts(save(whole.isel(P=[1, 1]).assign(TIME=("P", HOURS[:2])), tmp_path / "none.nc"))


@pytest.mark.parametrize(("key", "number", "text"), [("scale_factor", 0.5, "0.5"), ("add_offset", -2.0, "-2.0")])
def test_packing_that_is_a_number_in_text_is_taken_and_said(mooring, tmp_path, key, number, text):
    read_of = {}
    for told in (number, text):
        path = save(mooring, tmp_path / f"{type(told).__name__}.nc")
        with netCDF4.Dataset(path, "a") as file:
            file["TEMP"].setncattr(key, told)
        read_of[type(told)] = read_casts(path)
    for as_number, as_text in zip(read_of[float], read_of[str], strict=True):
        assert as_text.temperature.tolist() == as_number.temperature.tolist()
    note = f"TEMP: its {key} is the text '{text}', taken as the number that it spells"
    assert any(note in warning for warning in read_of[str][0].warnings)
    assert not any(note in warning for cast in read_of[float] for warning in cast.warnings)


@pytest.mark.parametrize("told", ["half", "", "nan"])
def test_packing_that_is_no_number_is_an_error(mooring, tmp_path, told):
    path = save(mooring, tmp_path / "m.nc")
    with netCDF4.Dataset(path, "a") as file:
        file["TEMP"].setncattr("scale_factor", told)
    with pytest.raises(InputError, match=f"TEMP: its scale_factor is the text '{told}'; a single finite number is"):
        read_casts(path)
