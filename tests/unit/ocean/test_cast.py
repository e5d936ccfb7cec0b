import csv
import gzip

import gsw
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from glidercli.errors import InputError
from glidercli.ocean.cast import read_ctd
from glidercli.ocean.cnv import parse_cnv
from glidercli.ocean.source import read_text

TABLE = """depth_m,temperature_degC,salinity,latitude_deg,longitude_deg
1,20,35,11,142
50,15,35.2,11,142
90,9,35.1,11,142
"""


def edited(ctd, write, name, *changes):
    """A copy of a real cast with some text replaced; the name of the original is kept."""
    text = (ctd / name).read_bytes()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return write(name, text)


# Sea-Bird casts ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["dPIRX010.cnv", "CTD_with_sigma_e00.cnv", "press-pass-prDE.cnv"])
def test_every_record_is_kept_or_counted(ctd, name):
    cast = read_ctd(ctd / name)
    with (ctd / name).open(encoding="latin-1", newline="") as stream:
        rows = [row for row in csv.reader(stream, delimiter=" ", skipinitialspace=True) if row]
    data = rows[1 + next(i for i, row in enumerate(rows) if row[0] == "*END*") :]
    assert cast.records == len(data)
    assert (np.diff(cast.depth) > 0.0).all()
    for values in (cast.density, cast.pressure_dbar, cast.temperature, cast.salinity, cast.absolute_salinity):
        assert values.shape == cast.depth.shape
        assert np.isfinite(values).all()


def test_salinity_from_conductivity_agrees_with_the_files_own(ctd, write):
    own = read_ctd(ctd / "dPIRX010.cnv")
    computed = read_ctd(edited(ctd, write, "dPIRX010.cnv", (b"sal00", b"other")))
    common = np.isin(computed.pressure_dbar, own.pressure_dbar)
    assert common.sum() == len(own.depth)
    # the file prints salinity and temperature to 1e-4, conductivity to 1e-6 S/m: 5e-5 + 5e-5 + 1e-5
    assert computed.salinity[common] == pytest.approx(own.salinity, abs=1.5e-4)


def test_the_scale_of_1968_is_converted(ctd):
    # potemp090C of the same file is the potential temperature on ITS-90, at most 0.03 degC below t090 here; left on
    # the scale of 1968, t068C would be 0.0025 to 0.0047 degC too warm. Values are means over 1 dbar, printed to 1e-4.
    cast = read_ctd(ctd / "CTD_with_sigma_e00.cnv")
    file = parse_cnv(cast.source, read_text(cast.source, ""))
    potential = gsw.pt0_from_t(cast.absolute_salinity, cast.temperature, cast.pressure_dbar)
    assert potential == pytest.approx(file.first("potemp090C")[1], abs=3e-4)


def test_density_agrees_with_the_files_own_sigma_theta(ctd):
    cast = read_ctd(ctd / "CTD_with_sigma_e00.cnv")
    file = parse_cnv(cast.source, read_text(cast.source, ""))
    potential = gsw.pt0_from_t(cast.absolute_salinity, cast.temperature, cast.pressure_dbar)
    compression = cast.density - gsw.rho_t_exact(cast.absolute_salinity, potential, 0.0)  # in situ less at the surface
    sigma = cast.density - compression - 1000.0
    # the file uses EOS-80, which knows no regional composition: 0.009 g/kg or 0.007 kg/m3 less in the North Pacific
    assert sigma == pytest.approx(file.first("sigma-\u00e900")[1], abs=0.01)
    assert cast.density == pytest.approx(
        1000.0 + file.first("sigma-\u00e900")[1] + 4.5e-3 * cast.pressure_dbar, abs=0.05
    )
    # sea water gains about 4.5e-3 kg/m3 per dbar (compressibility 4.4e-10 1/Pa); 0.05 for its change with temperature


def test_a_failing_sensor_is_left_out(ctd):
    cast = read_ctd(ctd / "dPIRX010.cnv")
    reasons = dict(cast.dropped)
    rows = np.loadtxt((ctd / "dPIRX010.cnv").read_text("latin-1").split("*END*")[1].splitlines())
    t, s, t2, s2 = rows[:, 2], rows[:, 8], rows[:, 3], rows[:, 9]
    hot = (t < -3.0) | (t > 45.0)
    salty = (s > 45.0) & ~hot
    apart = ((abs(t - t2) > 0.5) | (abs(s - s2) > 0.2)) & ~hot & ~salty
    assert sorted(reasons.values()) == sorted([hot.sum(), salty.sum(), apart.sum()])
    second = np.interp(cast.pressure_dbar, rows[:, 1], s2)
    assert cast.salinity == pytest.approx(second, abs=0.2)  # the limit to which the two pairs may differ


def test_an_unknown_pressure_name_is_an_error_that_lists_the_columns(ctd):
    with pytest.raises(
        InputError, match=r"press-fails\.cnv: has no column of pressure or depth; its columns are scan,"
    ) as e:
        read_ctd(ctd / "press-fails.cnv")
    assert "prFAILS" in str(e.value)
    assert "prDM" in str(e.value)
    assert "\n" not in str(e.value)


def test_the_unit_in_brackets_decides(ctd, write):
    in_dbar = read_ctd(ctd / "press-pass-prDE.cnv", latitude=40.0)  # psi by its name, [db] in its brackets
    assert in_dbar.pressure_dbar.max() == 14.975  # the header's span
    in_psi = read_ctd(edited(ctd, write, "press-pass-prDE.cnv", (b"Gauge [db]", b"Gauge [psi]")), latitude=40.0)
    assert in_psi.pressure_dbar.max() == pytest.approx(14.975 * 6894.757 / 1e4, rel=1e-6)  # 1 psi = 6894.757 Pa
    unmarked = edited(ctd, write, "press-pass-prDE.cnv", (b"Gauge [db]", b"Gauge"))
    assert read_ctd(unmarked, latitude=40.0).pressure_dbar.max() == in_psi.pressure_dbar.max()
    with pytest.raises(InputError, match="column prDE is in 'kPa', allowed: db, dbar, decibars, psi"):
        read_ctd(edited(ctd, write, "press-pass-prDE.cnv", (b"Gauge [db]", b"Gauge [kPa]")))


def test_millisiemens_become_siemens(ctd):
    cast = read_ctd(ctd / "press-pass-prDE.cnv", latitude=40.0)
    # the row of the greatest pressure: 14.975 dbar, 14.9843 degC, 39.04 mS/cm; gsw takes mS/cm as they stand
    row = next(
        r for line in cast.source.read_text("latin-1").split("*END*")[1].splitlines()
        if len(r := line.split()) > 3 and r[3] == "14.975"
    )  # fmt: skip
    assert cast.salinity[-1] == pytest.approx(gsw.SP_from_C(float(row[2]), float(row[1]), 14.975), abs=1e-9)


def test_the_air_above_the_water_is_no_sea_water(ctd):
    cast = read_ctd(ctd / "press-pass-prDE.cnv", latitude=40.0)
    assert cast.salinity.min() > 20.0
    assert dict(cast.dropped)["in air, or the cell filling"] > 90  # the first 94 rows read 0.003 mS/cm


def test_depth_serves_where_there_is_no_pressure(ctd, write):
    by_depth = read_ctd(
        edited(
            ctd, write, "press-fails.cnv", (b"prFAILS: Pressure, Strain Gauge [db]", b"depSM: Depth [salt water, m]")
        ),
        40.0,
    )
    assert by_depth.depth[-1] == pytest.approx(14.975, abs=1e-9)
    assert by_depth.pressure_dbar[-1] == pytest.approx(14.975 * 1.0076, rel=1e-3)  # about 1.0076 dbar per m at 40 deg


def test_a_latitude_serves_only_where_the_file_has_none(ctd):
    name = "CTD_with_sigma_e00.cnv"
    assert read_ctd(ctd / name, latitude=10.0).latitude == pytest.approx(39 + 16.23 / 60)
    without = read_ctd(ctd / "press-pass-prDE.cnv")
    assert without.latitude is None
    assert "latitude unknown, 0 deg is used: depth for a pressure is too great" in without.warnings[0]
    given_one = read_ctd(ctd / "press-pass-prDE.cnv", latitude=60.0)
    assert given_one.latitude == 60.0
    assert not any("latitude unknown" in line for line in given_one.warnings)
    with pytest.raises(InputError, match="latitude: 95 deg"):
        read_ctd(ctd / name, latitude=95.0)


def test_the_stated_effect_of_an_unknown_latitude_holds():
    equator, pole = -gsw.z_from_p(1000.0, 0.0), -gsw.z_from_p(1000.0, 90.0)
    assert equator - pole == pytest.approx(5.2, abs=0.05)  # the warning says 5.2 m
    assert (equator - pole) / pole == pytest.approx(0.0053, abs=5e-5)  # and 0.53 %


def test_a_pressure_spike_in_a_real_cast(ctd, write):
    whole = read_ctd(ctd / "dPIRX010.cnv")
    spiked = read_ctd(edited(ctd, write, "dPIRX010.cnv", (b"    401.000 ", b"   7590.000 ")))
    assert dict(spiked.dropped)["pressure spike"] == 1
    assert set(whole.pressure_dbar) - set(spiked.pressure_dbar) == {401.0}


def test_a_file_cut_off_says_so(ctd, write):
    data = (ctd / "dPIRX010.cnv").read_bytes()
    cast = read_ctd(write("cut.cnv", data[: len(data) // 2]))
    assert dict(cast.dropped)["unreadable row"] == 1
    assert "the header announces 1014 rows" in cast.warnings[0]


def test_bad_flags_are_dropped(ctd, write):
    flagged = edited(
        ctd, write, "dPIRX010.cnv", (b"    35.3159    35.7124 0.0000e+00", b"    35.3159    35.7124 -9.990e-29")
    )
    assert dict(read_ctd(flagged).dropped)["bad flag"] == 1


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            [(b"t090C:", b"tempC:"), (b"t190C:", b"tempD:")],
            "has no column of temperature; its columns are timeS, prDM, tempC",
        ),
        ([(b"sal00", b"other"), (b"c0S/m", b"cxS/m")], "has no column of salinity or conductivity; its columns are"),
    ],
)
def test_a_cast_that_lacks_a_quantity(ctd, write, changes, message):
    with pytest.raises(InputError, match=message):
        read_ctd(edited(ctd, write, "dPIRX010.cnv", *changes))


# Plain tables --------------------------------------------------------------------------------------------------------


def test_a_table_is_taken_as_it_stands(write):
    cast = read_ctd(write("cast.txt", TABLE))
    assert cast.depth.tolist() == [1.0, 50.0, 90.0]
    assert cast.temperature.tolist() == [20.0, 15.0, 9.0]
    assert (cast.latitude, cast.longitude, cast.time_utc, cast.dropped, cast.warnings) == (11.0, 142.0, None, (), ())
    pressure = gsw.p_from_z(-cast.depth, 11.0)
    absolute = gsw.SA_from_SP([35.0, 35.2, 35.1], pressure, 142.0, 11.0)
    # rho_t_exact is the Gibbs function itself; the polynomial in use was fitted to it within 1e-3 kg/m3
    assert cast.density == pytest.approx(gsw.rho_t_exact(absolute, [20.0, 15.0, 9.0], pressure), abs=1e-3)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("depth_m", "\ufeffdepth_m"),
        (",", ";"),
        (",", "\t"),
        ("\n", "\r\n"),
        ("\n", "\n\n"),
        (",", " , "),
        ("salinity", '"salinity"'),
    ],
)
def test_spellings_of_one_table(write, old, new):
    plain, other = read_ctd(write("plain.csv", TABLE)), read_ctd(write("other.csv", TABLE.replace(old, new)))
    assert other.density.tolist() == plain.density.tolist()
    assert read_ctd(write("packed.csv.gz", gzip.compress(TABLE.encode()))).density.tolist() == plain.density.tolist()


def test_density_alone_is_enough(write):
    cast = read_ctd(write("cast.csv", "depth_m,density_kg_m3\n0,1021\n100,1025.5\n"), latitude=20.0)
    assert cast.density.tolist() == [1021.0, 1025.5]
    assert cast.temperature is None
    assert cast.salinity is None
    assert cast.absolute_salinity is None
    assert cast.warnings == ()


def test_the_three_measures_of_salt_agree(write):
    head = "pressure_dbar,temperature_degC,latitude_deg,longitude_deg,"
    # official check value of TEOS-10, 142 E 11 N: see test_seawater.py
    place = "909,4.9176,11,142,"
    for column, cell in (
        ("salinity", "34.532505000117716"),
        ("absolute_salinity_g_kg", "34.70523685435276"),
        ("conductivity_S_m", "3.3382144048823484"),
    ):
        cast = read_ctd(write(f"{column}.csv", f"{head}{column}\n{place}{cell}\n{place.replace('909', '999')}{cell}\n"))
        assert cast.density[0] == pytest.approx(1031.4980914996909, abs=1e-7)
        assert cast.depth[0] == pytest.approx(901.8572642972814, abs=1e-7)


def test_a_row_that_lacks_a_value_is_left_out_and_counted(write):
    text = TABLE + "100,,35,11,142\n,9,35,11,142\n110,NaN,,11,142\n120,9,nan,11,142\n,,,,\n200,8,35,11,142\n"
    cast = read_ctd(write("cast.csv", text))
    assert cast.depth.tolist() == [1.0, 50.0, 90.0, 200.0]
    assert cast.dropped == (("without depth_m", 2), ("without temperature_degC", 2), ("without salinity", 1))
    assert cast.records == 9
    assert cast.warnings == (
        "5 of 9 samples left out: 2 without depth_m, 2 without temperature_degC, 1 without salinity",
    )


def test_a_place_told_once_is_the_casts(write):
    cast = read_ctd(write("cast.csv", TABLE.replace("9,35.1,11,142", "9,35.1,,nan")))
    assert (cast.latitude, cast.longitude, len(cast.depth), cast.dropped) == (11.0, 142.0, 3, ())
    table = TABLE.replace("1,20,35,11,142", "1,20,35,11,179.9").replace("15,35.2,11,142", "15,35.2,11,")
    cast = read_ctd(write("pacific.csv", table.replace("9,35.1,11,142", "9,35.1,11,-179.9")))
    assert abs(cast.longitude) == pytest.approx(180.0)  # not at Greenwich
    cast = read_ctd(write("nowhere.csv", TABLE.replace(",11,142\n", ",,\n")))
    assert (cast.latitude, cast.longitude) == (None, None)


def test_a_density_at_odds_with_the_rest_is_named(write):
    cast = read_ctd(write("cast.csv", TABLE.replace("salinity", "salinity,density_kg_m3").replace(",35", ",35,1030")))
    assert any("density_kg_m3 differs from TEOS-10 by up to" in line for line in cast.warnings)


def test_a_misspelt_column_is_named(write):
    cast = read_ctd(write("cast.csv", TABLE.replace("longitude_deg", "longtude_deg")))
    assert any("longtude_deg" in line for line in cast.warnings)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (TABLE.replace("\n50,", "\n0.5,"), "line 3: depth_m = 0.5 comes after 1; a profile must grow deeper"),
        (TABLE.replace("\n50,", "\n1,"), "line 3: depth_m = 1 repeats 1"),
        (TABLE.replace(",15,", ",warm,"), "line 3: temperature_degC = 'warm', a number"),
        (
            TABLE.replace(",", ";").replace(";15;", ";15,5;"),
            "line 3: temperature_degC = '15,5', a number with a decimal point",
        ),
        (TABLE.replace(",35.2,", ",350,"), "line 3: salinity = 350, allowed 0 to 45"),
        (TABLE.replace("depth_m", "depth"), "has no column depth_m or pressure_dbar; its columns are depth,"),
        (
            TABLE.replace("salinity", "salt"),
            "has no column salinity, absolute_salinity_g_kg, conductivity_S_m or density_kg_m3",
        ),
        (TABLE.replace("temperature_degC", "temp"), "has no column temperature_degC; its columns are depth_m, temp,"),
        (TABLE.replace("salinity", "depth_m"), "line 1: column depth_m stands twice"),
        (TABLE.replace("\n1,20", "\n20"), "line 2: has 4 cells for 5 columns"),
        (TABLE.replace("depth_m,", "depth_m;"), "line 1: column names are separated in more than one way"),
        ("depth_m,density_kg_m3\n1,25.3\n", "line 2: density_kg_m3 = 25.3, allowed 990 to 1100"),
        (TABLE.splitlines()[0], "has no rows below its column names"),
        ("\n\n", "is empty"),
        ("", "is empty"),
        ('salinity,"depth\nm"\n35,1\n', "its columns are salinity, depth m"),
        ("depth_m,absolute_salinity_g_kg\n1,35\n", "has no column temperature_degC; its columns are"),
        (
            "depth_m,pressure_dbar,density_kg_m3\n0,0,1025\n100,10.1,1026\n",
            "line 3: pressure_dbar = 10.1 at depth_m = 100",
        ),
        ("depth_m,density_kg_m3\n1,\n,1025\n", "sample among 2: 1 without depth_m, 1 without density_kg_m3; at least"),
        (TABLE.replace(",15,35.2", ",,salty"), "line 3: salinity = 'salty', a number"),
        (
            b"\x89PNG\r\n\x1a\n\0\0\0",
            "is not a text file; a CTD cast is a Sea-Bird .cnv file, a NetCDF file or a table",
        ),
    ],
)
def test_a_table_that_cannot_be_used(write, text, message):
    with pytest.raises(InputError, match=message) as caught:
        read_ctd(write("cast.csv", text))
    assert "\n" not in str(caught.value)


def test_a_missing_file_and_a_folder(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read_ctd(tmp_path / "none.cnv")
    with pytest.raises(InputError, match="is a folder"):
        read_ctd(tmp_path)


@given(st.binary(min_size=1, max_size=200) | st.text(',;\t\n\r" 1.-adehmpt_*#', min_size=1).map(str.encode))
def test_any_bytes_are_a_cast_or_one_line(tmp_path_factory, data):
    path = tmp_path_factory.getbasetemp() / "any"
    path.write_bytes(data)
    with pytest.raises(InputError) as caught:  # random bytes never spell the columns of a cast
        read_ctd(path)
    assert len(str(caught.value).splitlines()) == 1


def test_without_a_latitude_the_warning_names_what_was_computed(write):
    by_depth = read_ctd(write("cast.csv", "depth_m,density_kg_m3\n0,1021\n1000,1025.5\n"))
    assert by_depth.warnings == (
        "latitude unknown, 0 deg is used: pressure for a depth is too small by up to 0.53 % (5.4 dbar at 1000 m, at "
        "the poles)",
    )
    at_the_pole = read_ctd(write("cast.csv", "depth_m,density_kg_m3\n0,1021\n1000,1025.5\n"), latitude=90.0)
    least, most = by_depth.pressure_dbar[-1], at_the_pole.pressure_dbar[-1]
    assert most - least == pytest.approx(5.4, abs=0.05)  # as many digits as the message has
    assert most / least - 1.0 == pytest.approx(0.0053, abs=5e-5)
    both = read_ctd(write("cast.csv", "depth_m,pressure_dbar,density_kg_m3\n0,0,1021\n1000,1010,1025.5\n"))
    assert both.warnings == ()
