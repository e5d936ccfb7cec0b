"""The contract of what ``glider simulate`` leaves behind: NetCDF, Parquet, pictures, long flights, interruptions."""

from __future__ import annotations

import json
import signal
import subprocess
import time
from pathlib import Path

import netCDF4
import numpy as np
import pandas as pd
import pytest
from conftest import GLIDER, Run, one_line_error
from pyarrow import parquet

HELD = ("--net-buoyancy", "0.3", "--mass-position", "0.4216", "--mass-rotation", "45")
YO = """name = "yo"
description = "yos for a long time"
start_time = 2020-05-06T07:08:09.5Z
latitude = 20.0
longitude = 118.0
duration_s = {duration}
[[leg]]
repeat = 1000
[[leg.leg]]
kind = "dive"
pitch_deg = -26.0
heading_deg = 90.0
net_buoyancy_kg = 0.3
until_depth_m = 200.0
[[leg.leg]]
kind = "climb"
pitch_deg = 26.0
heading_deg = 90.0
net_buoyancy_kg = -0.3
until_depth_m = 5.0
"""


def test_tables_of_every_kind_hold_the_same(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "yo.toml").write_text(YO.format(duration=120000.5))  # longer than one piece
    done = glider("simulate", "yo.toml", "-o", "f.csv", "-o", "f.parquet", "-o", "f.nc")
    assert done.returncode == 0, done.stderr
    text, table = pd.read_csv(tmp_path / "f.csv"), pd.read_parquet(tmp_path / "f.parquet")
    assert len(text) == len(table) > 120002  # every second, the end of every leg and of the flight
    assert list(table.columns) == [name for name in text.columns if name != "origin"]
    assert str(table["time_utc"].dt.tz) == "UTC"
    assert text["elapsed_s"].iloc[-1] == table["elapsed_s"].iloc[-1] == 120000.5
    with netCDF4.Dataset(tmp_path / "f.nc") as file:
        for name, factor in (("depth", 1.0), ("pitch", 180.0 / np.pi), ("latitude", 1.0), ("net_buoyancy", 1.0)):
            column = next(c for c in table if c == name or c.startswith(name + "_"))
            np.testing.assert_array_equal(table[column], text[column])  # the CSV has every digit
            np.testing.assert_array_equal(table[column], np.asarray(file[name][:]) * factor)
        told = json.loads(file.glidercli)
        assert (file.featureType, file.source) == ("trajectory", "simulated")
    in_parquet = json.loads(parquet.read_metadata(tmp_path / "f.parquet").metadata[b"glidercli"])
    beside = json.loads((tmp_path / "f.csv-metadata.json").read_text())
    del beside["table_sha256"]
    assert told == in_parquet == beside
    assert told["metadata"]["provenance"]["inputs"][0]["path"] == "yo.toml"
    assert glider("replay", "f.csv").returncode == 0


def test_the_netcdf_follows_cf(glider: Run, tmp_path: Path) -> None:
    from compliance_checker.runner import CheckSuite, ComplianceChecker

    for arguments, name in ((("sawtooth-transect",), "placed.nc"), ((*HELD, "--duration", "50"), "nowhere.nc")):
        assert glider("simulate", *arguments, "-o", name).returncode == 0
        CheckSuite.load_all_available_checkers()
        report = tmp_path / "report.txt"
        passed, errors = ComplianceChecker.run_checker(
            str(tmp_path / name), ["cf:1.10"], 0, "strict", output_filename=str(report), output_format="text"
        )
        assert passed, report.read_text()
        assert not errors, report.read_text()


def test_two_runs_give_the_same_bytes_in_every_format(glider: Run, tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        outputs = [part for kind in ("csv", "parquet", "png", "svg", "mcap") for part in ("-o", f"f.{kind}")]
        command = [str(GLIDER), "simulate", "heading-hold-yoyo", *outputs]
        subprocess.run(command, cwd=tmp_path / name, check=True, capture_output=True, timeout=300)
    for path in (tmp_path / "a").iterdir():
        assert path.read_bytes() == (tmp_path / "b" / path.name).read_bytes(), path.name


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_a_flight_is_drawn(glider: Run, tmp_path: Path, kind: str) -> None:
    assert glider("simulate", *HELD, "--duration", "300", "-o", f"f.{kind}").returncode == 0
    start = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[kind]
    data = (tmp_path / f"f.{kind}").read_bytes()
    assert data.startswith(start)
    if kind == "svg":
        text = data.decode()
        assert "SIMULATED" in text
        assert "provenance" not in text.split("<defs>")[-1]


@pytest.mark.parametrize("by", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_an_interruption_leaves_nothing_and_says_how_far_it_came(tmp_path: Path, by: signal.Signals) -> None:
    (tmp_path / "yo.toml").write_text(YO.format(duration=2592000.0))
    command = [str(GLIDER), "simulate", "yo.toml", "-o", "f.csv", "-o", "f.nc"]
    running = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for _ in range(600):  # until it writes: compiling may come first
        time.sleep(0.1)
        if any(path.name.endswith(".csv") and path.stat().st_size > 0 for path in tmp_path.glob(".f*")):
            break
    running.send_signal(by)
    out, error = running.communicate(timeout=60)
    assert running.returncode == 130
    assert out == ""
    assert "interrupted after" in error.splitlines()[-1]
    assert "Traceback" not in error
    assert [path.name for path in tmp_path.iterdir()] == ["yo.toml"]


def test_current_in_time(glider: Run, tmp_path: Path) -> None:
    head = "elapsed_s,depth_m,current_east_m_s,current_north_m_s\n"
    rows = [f"{t},{z},{e},0" for t, e in ((0, 0.0), (1000, 0.4), (1500, 0.4)) for z in (0, 500)]
    (tmp_path / "c.csv").write_text(head + "\n".join(rows) + "\n")
    done = glider("simulate", *HELD, "--duration", "2000", "--adcp", "c.csv", "-o", "f.csv")
    assert done.returncode == 0, done.stderr
    assert "the current profiles from 0 to 1500 s" in done.stderr
    table = pd.read_csv(tmp_path / "f.csv")
    assert table["current_east_m_s"][500] == pytest.approx(0.2, abs=1e-12)
    for text, words in (
        (head + "0,0,0,0\n0,500,0,0\n0,0,1,0\n0,500,1,0\n", ("line 4", "depth_m")),
        (head + "9,0,0,0\n9,500,0,0\n5,0,1,0\n5,500,1,0\n", ("line 4", "elapsed_s = 5")),
        (head.replace("elapsed_s", "time_utc") + "2020-01-01,0,0,0\n2020-01-01,500,0,0\n2020-01-02,0,1,0\n"
         "2020-01-02,500,1,0\n", ("start_time",)),
        (head + "0,0,0,0\n0,500,0,0\nnan,0,1,0\nnan,500,1,0\n", ("line 4", "elapsed_s = nan", "number of seconds")),
        (head + ",0,0,0\n0,500,0,0\n", ("line 2", "elapsed_s = empty")),
        (head.replace("elapsed_s", "time_utc") + "once,0,0,0\nonce,500,0,0\n", ("line 2", "time_utc = once", "ISO 8601")),
        ("time_utc," + head + "2020-01-01T00:00,0,0,0,0\n2020-01-01T00:00,0,500,0,0\n2020-01-01T00:10,60,0,0,0\n"
         "2020-01-01T00:10,60,500,0,0\n", ("line 4", "elapsed_s and time_utc contradict each other")),
    ):  # fmt: skip
        (tmp_path / "bad.csv").write_text(text)
        one_line_error(glider("simulate", *HELD, "--adcp", "bad.csv"), "bad.csv", *words)


def test_a_profile_of_one_point_is_refused(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "c.csv").write_text("depth_m,density_kg_m3\n5,1025\n")
    one_line_error(glider("simulate", *HELD, "--ctd", "c.csv"), "c.csv", "line 2", "at least two")


def test_a_link_stays_and_what_it_points_to_is_replaced(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "kept.csv").touch()
    (tmp_path / "link.csv").symlink_to("kept.csv")
    assert glider("simulate", *HELD, "--duration", "10", "-o", "link.csv", "--force").returncode == 0
    assert (tmp_path / "link.csv").is_symlink()
    assert len(pd.read_csv(tmp_path / "kept.csv")) == 11


def test_standard_output_takes_one_document(glider: Run) -> None:
    one_line_error(glider("simulate", *HELD, "-o", "-", "-o", "-"), "twice")


def test_a_time_that_alone_makes_too_many_samples_is_refused_at_once(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "long.toml").write_text('name = "l"\ndescription = "l"\n[[leg]]\nkind = "drift"\nduration_s = 1e8\n')
    one_line_error(glider("simulate", "long.toml", "-o", "f.csv"), "1e+08 s by 1 s", "allowed 1e+07")
