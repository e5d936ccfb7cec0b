"""Pressure and depth that contradict each other: told with the likely unit, and nothing changed."""

from __future__ import annotations

import shutil
from pathlib import Path

import netCDF4
import numpy as np
import pytest
from conftest import ROOT

from glidercli.log import Channel, Log
from glidercli.logio import read
from glidercli.logio.gauges import doubt_about_gauges
from glidercli.logio.reading import Reading

SECOND = 10**9
IOOS = ROOT / "tests/data/netcdf/dfo-rosie713-20190615_adjusted.nc"
MAPPING = """[time]
column = "t"
format = "iso"
[columns]
depth = {{ column = "z", unit = "{depth}" }}
pressure = {{ column = "p", unit = "{pressure}" }}
"""


def doubts(reading: Reading) -> list[str]:
    return [warning for report in reading.files for warning in report.warnings if "disagree" in warning]


def log_of(ratio: float, deepest: float = 100.0, every: float = 5.0, later: float = 0.0, count: int = 200) -> Log:
    """A dive; pressure is so many dbar to a metre of depth, and sampled some seconds after it."""
    seconds = every * np.arange(count)
    way = deepest * np.sin(np.linspace(0.0, np.pi, count)), deepest * np.sin(np.linspace(0.0, np.pi, count))
    time_ns = np.round(seconds * SECOND).astype(np.int64)
    depth = Channel("depth", time_ns, way[0])
    return Log(
        {"depth": depth, "pressure": Channel("pressure", time_ns + int(later * SECOND), ratio * 1e4 * way[1])},
        "measured",
    )


@pytest.mark.parametrize(
    ("depth", "pressure", "numbers", "ratio", "likely"),
    [
        ("m", "bar", (1.0, 1.01), "10.1", "pressure in dbar that is called bar or pressure in kPa that is called dbar"),
        ("m", "dbar", (1.0, 0.101), "0.101", "pressure in dbar that is called kPa or pressure in bar that is called dbar"),
        ("m", "dbar", (1.0, 1.47), "1.47", "pressure in psi that is called dbar"),
        ("cm", "dbar", (1.0, 1.01), "101", "pressure in hPa that is called dbar or depth in m that is called cm"),
        ("ft", "dbar", (1.0, 1.01), "3.31", "depth in m that is called ft"),
        ("m", "dbar", (3.28, 1.01), "0.308", "depth in ft that is called m"),
        ("m", "dbar", (1.0, 1.9), "1.9", "no unit that is known explains it"),
    ],
)  # fmt: skip
def test_a_unit_that_the_other_gauge_contradicts_is_told(
    tmp_path: Path, depth: str, pressure: str, numbers: tuple[float, float], ratio: str, likely: str
) -> None:
    way = 80.0 * np.sin(np.linspace(0.0, np.pi, 241))
    rows = [
        f"2020-01-01T00:{i // 12:02d}:{5 * i % 60:02d}Z,{numbers[0] * z:.4f},{numbers[1] * z:.4f}\n"
        for i, z in enumerate(way)
    ]
    (tmp_path / "a.csv").write_text("t,z,p\n" + "".join(rows))
    (tmp_path / "a.toml").write_text(MAPPING.format(depth=depth, pressure=pressure))
    reading = read([tmp_path / "a.csv"])
    (line,) = doubts(reading)
    assert line.startswith("pressure and depth disagree: in the middle of ")
    assert (
        f"a metre of depth is {ratio} dbar of pressure, and is 1 dbar in water; likely: {line.split('likely: ')[1]}"
        in line
    )
    for one in likely.split(" or "):
        assert one in line
    metres, pascals = {"m": 1.0, "cm": 0.01, "ft": 0.3048}[depth], {"dbar": 1e4, "bar": 1e5}[pressure]
    np.testing.assert_allclose(reading.log["depth"].values, np.round(numbers[0] * way, 4) * metres, atol=1e-9)
    np.testing.assert_allclose(reading.log["pressure"].values, np.round(numbers[1] * way, 4) * pascals, atol=1e-5)


def test_a_netcdf_file_that_says_bar(tmp_path: Path) -> None:
    path = tmp_path / "a.nc"
    shutil.copy(IOOS, path)
    assert doubts(read([path])) == []
    with netCDF4.Dataset(path, "a") as file:
        file["pressure"].units = "bar"
    reading = read([path])
    (line,) = doubts(reading)
    assert reading.files[0].warnings[0] == line  # `glider info` shows the first three alone
    assert "is 10.1 dbar of pressure" in line
    assert "pressure in dbar that is called bar" in line


def test_depth_in_one_file_and_pressure_in_another(tmp_path: Path) -> None:
    """A line at the file that holds the pressure, once."""
    for name, column, unit, numbers in (("nav", "z", "m", 1.0), ("ctd", "p", "bar", 1.01)):
        way = 80.0 * np.sin(np.linspace(0.0, np.pi, 241)) * numbers
        rows = [f"2020-01-01T00:{i // 12:02d}:{5 * i % 60:02d}Z,{z:.4f}\n" for i, z in enumerate(way)]
        (tmp_path / f"{name}.csv").write_text(f"t,{column}\n" + "".join(rows))
        kept = "depth" if column == "z" else "pressure"
        mapping = MAPPING.format(depth="m", pressure=unit).splitlines()
        lines = [line for line in mapping if line.startswith(kept) or not line.startswith(("depth", "pressure"))]
        (tmp_path / f"{name}.toml").write_text("\n".join(lines) + '\n[file]\nplatform = "one"\n')
    reading = read([tmp_path / "nav.csv", tmp_path / "ctd.csv"])
    assert len(doubts(reading)) == 1
    (report,) = [report for report in reading.files if any("disagree" in warning for warning in report.warnings)]
    assert report.path.name == "ctd.csv"


@pytest.mark.parametrize("ratio", [0.84, 0.985, 1.013, 1.19])
def test_gauges_that_may_be_right_raise_no_doubt(ratio: float) -> None:
    assert doubt_about_gauges(log_of(ratio)) == ""


@pytest.mark.parametrize("ratio", [0.82, 1.22])
def test_the_bound(ratio: float) -> None:
    assert doubt_about_gauges(log_of(ratio)).startswith("pressure and depth disagree")


def test_samples_that_are_not_at_one_time_are_paired_while_they_are_near() -> None:
    assert doubt_about_gauges(log_of(1.01, every=4.0, later=2.0)) == ""
    assert "that is called bar" in doubt_about_gauges(log_of(10.1, every=4.0, later=2.0))
    assert doubt_about_gauges(log_of(10.1, later=86400.0)) == ""


def test_neither_the_surface_nor_a_few_samples_nor_a_simulation_tell() -> None:
    assert doubt_about_gauges(log_of(1.5, deepest=3.0)) == ""
    assert doubt_about_gauges(log_of(10.0, count=9)) == ""
    simulated = Log(log_of(10.0).channels, "simulated")
    assert doubt_about_gauges(simulated) == ""
    assert doubt_about_gauges(Log({"depth": log_of(1.0)["depth"]}, "measured")) == ""


@pytest.mark.parametrize(
    "paths",
    ["logs/seaglider-sg561", "logs/slocum-comet-2019", "logs/seaexplorer-sea035", "tests/data/seaexplorer",
     "tests/data/seaglider/p1710100.nc", "tests/data/seaglider/p2490010.nc", "tests/data/slocum/modena-2015-174-8-0.dbd",
     "tests/data/netcdf/sg033_20100903T182416_first-rows.nc"],
)  # fmt: skip
def test_no_real_log_is_doubted(paths: str) -> None:
    reading = read([ROOT / paths])
    assert {"depth", "pressure"} <= reading.log.channels.keys()
    assert doubts(reading) == []
