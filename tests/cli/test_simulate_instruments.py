"""The contract of ``glider simulate --instruments``: files, marks, seed, and what is said of bad settings."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pandas as pd
import pytest
from conftest import ROOT, Run, one_line_error

PLAN = """name = "plan"
description = "a yo"
latitude = 20.0
longitude = 118.0
{top}
[[leg]]
kind = "dive"
pitch_deg = -26.0
heading_deg = 0.0
net_buoyancy_kg = 0.3
until_depth_m = 40.0
[[leg]]
kind = "climb"
pitch_deg = 26.0
heading_deg = 0.0
net_buoyancy_kg = -0.3
until_depth_m = 0.0
[[leg]]
kind = "drift"
duration_s = 60.0
"""
ALL = """[instruments.compass]
model = "tcm3"
period_s = 1.0
[instruments.pressure]
model = "strain-gauge"
[instruments.ctd]
model = "slocum-gpctd"
[instruments.gps]
model = "gps15"
"""
CAST = "depth_m,temperature_degC,salinity\n" + "".join(f"{z},{25 - 0.1 * z:.2f},35\n" for z in range(60))


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    (tmp_path / "cast.csv").write_text(CAST)
    (tmp_path / "all.toml").write_text(ALL)
    path = tmp_path / "plan.toml"
    path.write_text(PLAN.format(top='ctd = "cast.csv"\nseed = 4') + ALL)
    return path


def test_every_output_is_marked_and_holds_the_same(glider: Run, plan: Path, tmp_path: Path) -> None:
    files = [f"i.{suffix}" for suffix in ("csv", "nc", "parquet", "mcap", "rrd")]
    done = glider("simulate", plan, *(item for file in files for item in ("-o", file)))
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("SIMULATED, AS ITS INSTRUMENTS WOULD RECORD IT\n")
    assert "seed 4" in done.stdout
    table = pd.read_csv(tmp_path / "i.csv")
    assert set(table["origin"]) == {"simulated"}
    for column in ("north_m", "u_m_s", "speed_through_water_m_s", "p_deg_s", "current_east_m_s"):
        assert column not in table
    assert 0 < table["latitude_deg"].count() < 62
    deep = table[(table["depth_m"] > 2.0) & (table["elapsed_s"] % 2 == 0)]  # the CTD samples every other second
    assert len(deep) > 300
    assert deep[["conductivity_S_m", "temperature_degC", "salinity", "density_kg_m3"]].notna().all().all()
    assert table["conductivity_S_m"][table["elapsed_s"] % 2 == 1].isna().all()
    parquet = pd.read_parquet(tmp_path / "i.parquet").drop(columns="time_utc")
    pd.testing.assert_frame_equal(parquet, table.drop(columns=["time_utc", "origin"]), check_dtype=False)
    with netCDF4.Dataset(tmp_path / "i.nc") as file:
        assert file.source == "simulated"
        assert "measured" not in str(file)
        told = json.loads(file.glidercli)["metadata"]
    beside = json.loads((tmp_path / "i.csv-metadata.json").read_text())
    assert beside["metadata"] == told
    assert told["seed"] == "4"
    assert told["provenance"]["seed"] == 4
    assert told["title"].endswith("as its instruments would record it")
    assert told["instruments"].startswith("compass: model = tcm3")
    for name in files[:-1]:
        read = glider("info", name)
        assert read.returncode == 0, read.stderr
        assert read.stdout.startswith("SIMULATED")
        assert "measured" not in read.stdout.lower()
    replayed = json.loads(glider("replay", "i.mcap", "-o", "again.csv", "--json").stdout)
    assert {item["origin"] for item in replayed["channels"]} == {"simulated"}
    again = pd.read_csv(tmp_path / "again.csv")
    assert again["conductivity_S_m"].dropna().tolist() == table["conductivity_S_m"].dropna().tolist()


def test_the_same_seed_makes_the_same_bytes(glider: Run, plan: Path, tmp_path: Path) -> None:
    for seed, name in ((9, "a.csv"), (9, "b.csv"), (10, "c.csv")):
        assert glider("simulate", plan, "--seed", seed, "-o", name).returncode == 0
    a, b, c = ((tmp_path / name).read_bytes() for name in ("a.csv", "b.csv", "c.csv"))
    assert a == b != c


def test_errors_against_the_truth_are_those_of_the_settings(
    glider: Run, glider_json: Callable[..., Any], plan: Path, tmp_path: Path
) -> None:
    sensors = (
        "[instruments.compass]\nnoise_tilt_deg = 0.2\nbias_pitch_deg = 1.5\n[instruments.pressure]\nnoise_dbar = 0.1\n"
    )
    (tmp_path / "s.toml").write_text(sensors)
    assert glider("simulate", plan, "--instruments", "none", "-o", "truth.csv").returncode == 0
    assert glider("simulate", plan, "--instruments", "s.toml", "-o", "seen.csv").returncode == 0
    truth = pd.read_csv(tmp_path / "truth.csv")
    assert {"north_m", "u_m_s"} <= set(truth)
    found = glider_json("compare", "truth.csv", "seen.csv")
    assert found["origins"]["measured"]["origin"] == "simulated"
    assert "truth.csv is simulated; the errors are against it" in found["notes"][0]
    errors = found["phases"]["dive"]  # at the surface the pitch jumps, between two samples
    for name, bias, sigma in (("pitch", 1.5, 0.2), ("roll", 0.0, 0.2), ("pressure", 0.0, 0.1)):
        key = next(key for key in errors if key.startswith(name))
        n = errors[key]["n"]
        assert errors[key]["bias"] == pytest.approx(bias, abs=5.0 * sigma / np.sqrt(n)), name  # five standard errors
        assert errors[key]["std"] == pytest.approx(sigma, abs=5.0 * sigma / np.sqrt(2.0 * n)), name
    assert errors[next(key for key in errors if key.startswith("net_buoyancy"))]["rmse"] == 0.0


def test_json_is_of_the_flight_and_tells_of_the_instruments(glider_json: Callable[..., Any], plan: Path) -> None:
    bare, seen = glider_json("simulate", plan, "--instruments", "none"), glider_json("simulate", plan)
    assert bare["final"] == seen["final"]
    assert bare["events"] == seen["events"]
    assert (bare["instruments"], bare["seed"]) == (None, None)
    assert seen["seed"] == 4
    ctd = seen["instruments"]["ctd"]
    assert ctd["settings"]["model"] == "slocum-gpctd"
    assert set(ctd["drawn_bias"]) == {"temperature", "conductivity", "pressure"}
    assert set(ctd["samples"]) == {"temperature", "conductivity", "salinity", "density"}
    assert seen["instruments"]["gps"]["samples"]["latitude"] > 30


def test_held_controls_have_instruments_too(glider: Run, plan: Path, tmp_path: Path) -> None:
    held = ("--net-buoyancy", "0.3", "--mass-position", "0.4216", "--mass-rotation", "45", "--duration", "60")
    (tmp_path / "c.toml").write_text("[instruments.compass]\nperiod_s = 5.0\n[instruments.pressure]\n")
    assert glider("simulate", *held, "--instruments", "c.toml", "-o", "held.csv").returncode == 0
    table = pd.read_csv(tmp_path / "held.csv")
    assert table["heading_deg"].count() == 13
    assert table["depth_m"].count() == 61
    one_line_error(glider("simulate", *held, "--instruments", "all.toml"), "all.toml: instruments.ctd", "--ctd")


@pytest.mark.parametrize("aboard", ["[instruments.compass]\n", '[instruments.gps]\nmodel = "gps15"\n', ALL])
def test_figures_show_what_there_is(glider: Run, plan: Path, tmp_path: Path, aboard: str) -> None:
    (tmp_path / "s.toml").write_text(aboard)
    done = glider("simulate", plan, "--instruments", "s.toml", "-o", "f.svg")
    assert done.returncode == 0, done.stderr
    drawn = (tmp_path / "f.svg").read_text()
    assert "SIMULATED" in drawn


def test_bad_settings_are_named_in_one_line(glider: Run, plan: Path, tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text('[instruments.compass]\nmodel = "tcm9"\nlag_s = -1\n')
    done = glider("simulate", plan, "--instruments", "bad.toml", "-o", "x.csv")
    one_line_error(done, "bad.toml: 2 faults", "tcm9", "shipped: tcm3", "lag_s = -1")
    assert not (tmp_path / "x.csv").exists()


def test_bad_options_are_named(glider: Run, plan: Path, tmp_path: Path) -> None:
    one_line_error(glider("simulate", plan, "--instruments", "nowhere.toml"), "nowhere.toml", "no such file")
    one_line_error(glider("simulate", plan, "--instruments", "."), "folder")
    one_line_error(glider("simulate", plan, "--seed", "-1"), "seed", "-1", "whole number")
    one_line_error(glider("simulate", plan, "--every", "0.0105"), "every", "whole milliseconds")
    plan.write_text(PLAN.format(top="seed = -1") + "[instruments.gps]\nnoise_m = -1\n")
    one_line_error(glider("simulate", plan), "2 faults", "instruments.gps.noise_m", "seed = -1")
    plan.write_text(PLAN.format(top="") + "[instruments.ctd]\n")
    one_line_error(glider("simulate", plan), "plan.toml: instruments.ctd", "no temperature")


def test_a_reconstruction_stays_one(glider: Run, plan: Path, tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text("[instruments.compass]\nnoise_tilt_deg = 1\n[instruments.pressure]\n")
    done = glider("simulate", "south-china-sea-2011", "--instruments", "c.toml", "-o", "f.nc")
    assert done.stdout.startswith("SIMULATED FROM A RECONSTRUCTION, AS ITS INSTRUMENTS WOULD RECORD IT: ")
    assert glider("info", "f.nc").stdout.startswith("SIMULATED FROM A RECONSTRUCTION")


def test_a_sensor_that_never_reads_leaves_no_channel(glider: Run, plan: Path, tmp_path: Path) -> None:
    (tmp_path / "late.toml").write_text(
        "[instruments.compass]\noffset_s = 5000\n[instruments.gps]\nfirst_fix_s = 3600\n"
    )
    files = [f"f.{suffix}" for suffix in ("csv", "nc", "parquet", "mcap", "rrd")]
    done = glider(
        "simulate", plan, "--instruments", "late.toml", "--every", "5", *(x for file in files for x in ("-o", file))
    )
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "f.csv")
    assert table["phase"].notna().all()
    assert "heading_deg" not in table or table["heading_deg"].isna().all()
    for name in files[:-1]:
        assert glider("info", name).returncode == 0
    assert glider("simulate", plan, "--instruments", "late.toml", "-o", "f.png").returncode == 0


def test_the_page_prints_what_comes_out(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    page = (ROOT / "docs/instruments.md").read_text()
    models = re.findall(r'^(\[instruments\.\w+\])\nmodel = ("[\w-]+")', page, re.MULTILINE)
    assert len(models) == 4
    (tmp_path / "aboard.toml").write_text("".join(f"{table}\nmodel = {name}\n" for table, name in models))
    (tmp_path / "tests").symlink_to(ROOT / "tests")
    section = page[page.index("## Does it read") :]
    commands = [line.split()[1:] for line in section.splitlines() if line.startswith("    glider ")]
    for command in commands[:2]:
        assert glider(*command).returncode == 0
    errors = glider_json(*commands[2])["channels"]
    rows = re.findall(r"^\| (\w+), \w+ \| ([\d,]+) \| (\S+) \| \S+ \| (\S+) \|", section, re.MULTILINE)
    assert len(rows) == 5
    for name, n, bias, std in rows:
        found = next(value for key, value in errors.items() if key.startswith(name))
        assert found["n"] == int(n.replace(",", ""))
        for said, number in ((bias, -found["bias"]), (std, found["std"])):
            half = 0.5 * 10.0 ** -len(said.split(".")[1])  # of the last digit printed
            assert float(said) == pytest.approx(number, abs=1.01 * half), name


def test_what_cannot_be_is_left_out_and_counted(glider: Run, plan: Path, tmp_path: Path) -> None:
    """A compass that leans 100 deg: a pitch beyond 90 deg would be dropped by every reader, this program's with them."""
    (tmp_path / "odd.toml").write_text("[instruments.compass]\nbias_pitch_deg = 100.0\n[instruments.pressure]\n")
    done = glider("simulate", plan, "--instruments", "odd.toml", "-o", "odd.csv", "--json")
    assert done.returncode == 0, done.stderr
    read = json.loads(done.stdout)["instruments"]["compass"]["samples"]
    count = re.search(
        r"instruments\.compass: (\d+) readings of pitch that cannot be are left out, allowed -90 to 90", done.stderr
    )
    assert count is not None
    assert int(count[1]) == read["heading"] - read["pitch"] > 0
    pitch = pd.read_csv(tmp_path / "odd.csv")["pitch_deg"].dropna()
    assert len(pitch) == read["pitch"]
    assert pitch.max() <= 90.0


def test_a_sensor_without_a_reading_and_a_seed_for_nobody_are_told(glider: Run, plan: Path, tmp_path: Path) -> None:
    (tmp_path / "deaf.toml").write_text("[instruments.gps]\nantenna_depth_m = -5.0\n[instruments.compass]\n")
    done = glider("simulate", plan, "--instruments", "deaf.toml")
    assert "glider: warning: instruments.gps has no reading in this flight" in done.stderr
    done = glider("simulate", plan, "--instruments", "none", "--seed", "3")
    assert "glider: warning: seed has no effect: no instrument is aboard" in done.stderr
    assert "seed has no effect" not in glider("simulate", plan, "--instruments", "none").stderr


@pytest.mark.parametrize("given", ["1.0", "[0, 0]", '"up"'])
def test_a_place_has_three_numbers(glider: Run, plan: Path, tmp_path: Path, given: str) -> None:
    (tmp_path / "odd.toml").write_text(f"[instruments.pressure]\nposition_m = {given}\n")
    told = "allowed three numbers: forward, starboard, down"
    one_line_error(glider("simulate", plan, "--instruments", "odd.toml"), "instruments.pressure.position_m", told)


def test_info_says_whose_readings_they_are(
    glider: Run, glider_json: Callable[..., Any], plan: Path, tmp_path: Path
) -> None:
    (tmp_path / "aboard.toml").write_text('[instruments.compass]\nmodel = "tcm3"\n[instruments.pressure]\n')
    glider("simulate", plan, "--instruments", "aboard.toml", "-o", "seen.nc")
    glider("simulate", plan, "--instruments", "none", "-o", "flown.nc")
    told = ", as its instruments would record it"
    first = [glider("info", name).stdout.splitlines()[0] for name in ("seen.nc", "flown.nc")]
    assert first == [f"SIMULATED: seawing{told}", "SIMULATED: seawing"]
    assert glider_json("info", "seen.nc")["instruments"].startswith("compass: model = tcm3")
