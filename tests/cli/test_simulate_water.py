"""--ctd FILE|LOG and --adcp FILE|LOG: files, folders, globs, repeated; casts in time; a dive in its own water."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT, Run, one_line_error
from scipy.interpolate import pchip_interpolate

HELD = ("--net-buoyancy", "0.3", "--mass-position", "0.4216", "--mass-rotation", "45", "--duration", "60")
DATED = (
    'name = "m"\ndescription = "d"\nstart_time = {start}\nlatitude = 20.0\nlongitude = 118.0\nduration_s = {length}\n'
    '[[leg]]\nkind = "dive"\npitch_deg = -28.0\nnet_buoyancy_kg = 0.35\nuntil_depth_m = 60.0\n'
    '[[leg]]\nkind = "climb"\npitch_deg = 28.0\nnet_buoyancy_kg = -0.35\nuntil_depth_m = 5.0\n'
)
CNV = ROOT / "tests/data/ctd"
SEA035 = ROOT / "logs/seaexplorer-sea035"
ADCP = ROOT / "tests/data/adcp"


def mission(folder: Path, start: str = "2020-05-01T06:00:00Z", length: float = 3000.0) -> str:
    (folder / "m.toml").write_text(DATED.format(start=start, length=length))
    return "m.toml"


def cast(path: Path, time: str | None, surface: float = 1024.0) -> Path:
    head, end = ("depth_m,density_kg_m3", "") if time is None else ("depth_m,density_kg_m3,time_utc", f",{time}")
    rows = [f"{z},{surface + 0.01 * z}{end}" for z in (0, 50, 200)]
    path.write_text("\n".join([head, *rows]) + "\n")
    return path


# Several files -------------------------------------------------------------------------------------------------------


def flown_density(glider: Run, folder: Path, *options: object) -> pd.DataFrame:
    done = glider("simulate", mission(folder), *options, "-o", "f.csv", "--force", "--quiet")
    assert done.returncode == 0, done.stderr
    return pd.read_csv(folder / "f.csv")


def test_several_casts_are_casts_in_time(glider: Run, tmp_path: Path) -> None:
    for name, time, surface in (("a", "2020-05-01T06:00:00Z", 1024.0), ("b", "2020-05-01T06:30:00Z", 1024.5)):
        cast(tmp_path / f"{name}.csv", time, surface)
    (tmp_path / "casts").mkdir()
    for name in ("a", "b"):
        shutil.copy(tmp_path / f"{name}.csv", tmp_path / "casts")
    (tmp_path / "casts" / "README.md").write_text("notes\n")
    ways = [("--ctd", "b.csv", "--ctd", "a.csv"), ("--ctd", "[ab].csv"), ("--ctd", "casts")]
    tables = [flown_density(glider, tmp_path, *way) for way in ways]
    t, z = tables[0]["elapsed_s"], tables[0]["depth_m"]
    expected = 1024.0 + 0.5 * np.minimum(t / 1800.0, 1.0) + 0.01 * z
    np.testing.assert_allclose(tables[0]["density_kg_m3"], expected, atol=1e-9)  # linear in both: exact
    for table in tables[1:]:
        pd.testing.assert_frame_equal(table, tables[0])


def test_casts_without_a_time_or_of_the_same_time_are_refused(glider: Run, tmp_path: Path) -> None:
    cast(tmp_path / "a.csv", "2020-05-01T06:00:00Z")
    cast(tmp_path / "none.csv", None)
    cast(tmp_path / "same.csv", "2020-05-01T08:00:00+02:00")
    name = mission(tmp_path)
    one_line_error(
        glider("simulate", name, "--ctd", "a.csv", "--ctd", "none.csv"), "none.csv: has no time, and 2 casts"
    )
    one_line_error(
        glider("simulate", name, "--ctd", "a.csv", "--ctd", "same.csv"),
        "same time as cast 1 (0.0 to 200.0 m)",
        "of a.csv",
        "06:00",
    )
    one_line_error(glider("simulate", *HELD, "--ctd", "a.csv", "--ctd", "b*.csv"), "b*.csv: no file matches")
    cast(tmp_path / "b.csv", "2020-05-01T07:00:00Z")
    one_line_error(
        glider("simulate", *HELD, "--ctd", "a.csv", "--ctd", "b.csv"),
        "its casts have times in UTC, from 2020-05-01T06:00:00Z",
        "write start_time = 2020-05-01T06:00:00Z",
    )
    (tmp_path / "empty").mkdir()
    one_line_error(glider("simulate", *HELD, "--ctd", "empty"), "empty: holds no log")


def test_currents_in_several_files(glider: Run, tmp_path: Path) -> None:
    head = "depth_m,current_east_m_s,current_north_m_s,time_utc"
    for name, hour, east in (("a", "06:00", 0.1), ("b", "06:40", 0.3)):
        rows = [f"{z},{east},0,2020-05-01T{hour}:00Z" for z in (0, 100)]
        (tmp_path / f"{name}.csv").write_text("\n".join([head, *rows]) + "\n")
    table = flown_density(glider, tmp_path, "--adcp", "a.csv", "--adcp", "b.csv")
    expected = 0.1 + 0.2 * np.minimum(table["elapsed_s"] / 2400.0, 1.0)
    np.testing.assert_allclose(table["current_east_m_s"], expected, atol=1e-12)


def test_real_casts_by_their_own_start_times(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    files = [item for name in ("dPIRX010.cnv", "CTD_with_sigma_e00.cnv") for item in ("--ctd", CNV / name)]
    warnings = glider_json("simulate", mission(tmp_path), *files)["warnings"]
    assert any("the casts from" in line for line in warnings)  # a flight years after both


# Logs ----------------------------------------------------------------------------------------------------------------


def test_a_dive_in_the_water_that_its_own_glider_measured(glider: Run, tmp_path: Path) -> None:
    """Density and current of a simulated flight, logged, are those of the flight in them, but for medians of 1 m."""
    z = np.arange(0, 101, 5)
    rho = 1023.0 + 2.0 * np.tanh(z / 40.0)
    pd.DataFrame({"depth_m": z, "density_kg_m3": rho}).to_csv(tmp_path / "water.csv", index=False)
    east = 0.3 * np.exp(-z / 30.0)
    pd.DataFrame({"depth_m": z, "current_east_m_s": east, "current_north_m_s": 0.1}).to_csv(
        tmp_path / "current.csv", index=False
    )
    first = flown_density(glider, tmp_path, "--ctd", "water.csv", "--adcp", "current.csv")
    (tmp_path / "f.csv").rename(tmp_path / "flown.csv")
    (tmp_path / "f.csv-metadata.json").rename(tmp_path / "flown.csv-metadata.json")
    second = flown_density(glider, tmp_path, "--ctd", "flown.csv", "--adcp", "flown.csv")
    assert len(second) == len(first)
    # A median over a bin of 1 m differs from the value at its median depth by its curvature, 2e-3 / 40^2 x 0.5^2 kg/m3
    # and less than 1e-4 m/s; above the first bin (of the climb 5 m deep) and below
    # the last one end values are held.
    depth = second["depth_m"]
    for name, law, within, beyond in (
        ("density_kg_m3", rho, 5e-4, 0.03),
        ("current_east_m_s", east, 1e-4, 5e-3),
    ):
        apart = abs(second[name] - pchip_interpolate(z, law, depth))
        assert apart[(depth > 6.0) & (depth < 65.0)].max() < within, name
        assert apart.max() < beyond, name
    assert abs(second["depth_m"] - first["depth_m"]).max() < 0.1
    done = glider("simulate", mission(tmp_path), "--ctd", "flown.csv")
    assert "2 descents and ascents by depth" in done.stderr
    assert "medians, derived" in done.stderr


def test_a_field_log_is_water(glider: Run, tmp_path: Path) -> None:
    done = glider("simulate", *HELD, "--ctd", SEA035)
    assert done.returncode == 0, done.stderr
    assert "has no start time: of its 6 descents and ascents the first that goes near the greatest depth" in done.stderr
    assert "43 of 719 samples left out: 43 without salinity" in done.stderr
    done = glider(
        "simulate", "--controls", SEA035, "--initial", SEA035, "--ctd", SEA035, "--every", "20", "-o", "f.csv"
    )
    assert done.returncode == 0, done.stderr
    assert "no start time" not in done.stderr
    assert "the casts from" in done.stderr  # the first and the last are held before and after their mid times
    table = pd.read_csv(tmp_path / "f.csv")
    assert table["temperature_degC"].between(4.2, 15.8).all()  # what the glider measured: 4.23 to 15.76


def test_a_log_without_water_or_current(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "log.csv").write_text(
        "time_utc,depth_m\n2020-05-01T06:00:00Z,0\n2020-05-01T06:00:10Z,9\n2020-05-01T06:00:20Z,1\n"
    )
    one_line_error(
        glider("simulate", *HELD, "--ctd", "log.csv"), "log.csv: ", "temperature with salinity", "it has depth"
    )
    one_line_error(glider("simulate", *HELD, "--adcp", "log.csv"), "log.csv: has no current_east and no current_north")
    one_line_error(glider("simulate", *HELD, "--adcp", SEA035), "seaexplorer-sea035: has no current_east")


def test_the_log_is_an_input(glider: Run, tmp_path: Path) -> None:
    t = np.arange(0, 400, 10)
    table = pd.DataFrame({"elapsed_s": t, "depth_m": 50 - abs(t / 4.0 - 50), "density_kg_m3": 1025.0 + 0.001 * t})
    table.to_csv(tmp_path / "log.csv", index=False)
    done = glider("simulate", *HELD, "--ctd", "log.csv", "-o", "log.csv", "--force")
    one_line_error(done, "log.csv", "input")
    done = glider("simulate", *HELD, "--ctd", "log.csv", "-o", "f.csv")
    assert done.returncode == 0, done.stderr
    assert "log.csv" in (tmp_path / "f.csv-metadata.json").read_text()


# Other files ---------------------------------------------------------------------------------------------------------


def test_binaries_and_netcdf(glider: Run, tmp_path: Path) -> None:
    done = glider("simulate", *HELD, "--adcp", ADCP / "RDI_7f79_2.000")
    assert done.returncode == 0, done.stderr
    assert "3 of 40 bins left out" in done.stderr
    one_line_error(glider("simulate", *HELD, "--ctd", ADCP / "RDI_7f79_2.000"), "holds current, not water")
    one_line_error(glider("simulate", *HELD, "--adcp", CNV / "dPIRX010.cnv"), "dPIRX010.cnv")
    (tmp_path / "cut.nc").write_bytes(b"\x89HDF\r\n\x1a\n" + b"\0" * 100)
    for option in ("--ctd", "--adcp"):
        one_line_error(glider("simulate", *HELD, option, "cut.nc"), "cut.nc: is a NetCDF file that cannot be read")
        one_line_error(glider("simulate", *HELD, option, "nowhere.nc"), "nowhere.nc: no such file")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("press-fails.cnv", "has no column of pressure or depth"),
        ("press-pass-prDE.cnv", None),
        ("dPIRX010.cnv", None),
        ("CTD_with_sigma_e00.cnv", None),
    ],
)
def test_every_real_cast_flies_or_says_why_not(glider: Run, name: str, words: str | None) -> None:
    done = glider("simulate", *HELD, "--ctd", CNV / name)
    if words is None:
        assert done.returncode == 0, done.stderr
    else:
        one_line_error(done, name, words)
