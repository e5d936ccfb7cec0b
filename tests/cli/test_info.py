"""The contract of ``glider info``: what a log holds, as replay would read it."""

from __future__ import annotations

import gzip
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from conftest import ROOT, Run, one_line_error

LOGS = ROOT / "logs/seaexplorer-sea035"


def test_it_holds_what_replay_reads(glider_json: Callable[..., Any]) -> None:
    info, replay = glider_json("info", LOGS), glider_json("replay", LOGS)
    assert info["files"] == replay["files"]
    pick = ("name", "unit", "samples", "first", "last", "minimum", "maximum", "origin")
    assert [{key: c[key] for key in pick} for c in info["channels"]] == [
        {key: c[key] for key in pick} for c in replay["channels"]
    ]


def test_spans_gaps_and_sampling(glider_json: Callable[..., Any]) -> None:
    info = glider_json("info", LOGS)
    assert (info["kind"], info["platform"]) == ("MEASURED", "SeaExplorer sea035")
    assert info["start"] < info["end"]
    channels = {c["name"]: c for c in info["channels"]}
    assert channels["depth_m"]["interval_s"] == 20.0  # as sea035 was set to sample
    assert channels["depth_m"]["longest_gap_s"] > 300.0
    assert channels["latitude_deg"]["gaps"] > 0
    assert [round(d["deepest_m"]) for d in info["dives"]] == [30, 702, 702]


def test_it_fits_a_terminal(glider: Run) -> None:
    done = glider("info", LOGS)
    assert done.returncode == 0
    assert max(map(len, done.stdout.splitlines())) <= 80
    assert done.stdout.startswith("MEASURED: SeaExplorer sea035\n")


def test_missing_parts_are_named(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    for number in ("36", "38"):
        shutil.copy(LOGS / f"sea035.12.gli.sub.{number}", tmp_path)
    shutil.copy(LOGS / "sea035.12.pld1.sub.36", tmp_path)
    (tmp_path / "sea035.12.pld1.sub.40").write_text("PLD_REALTIMECLOCK;GPCTD_TEMPERATURE;\nnever;4.0;\n")
    missing = glider_json("info", tmp_path)["missing"]
    assert "sea035.12.pld1.38, which goes with sea035.12.gli.sub.38, is not among the files" in missing
    assert "dives 37 of sea035.12 are not among the files" in missing
    assert any(line.startswith("sea035.12.pld1.sub.40: ") for line in missing)
    assert "sea035.12.pld1.38" in glider("info", tmp_path).stdout


def test_what_is_no_log_is_one_line(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("nothing\n")
    one_line_error(glider("info", "a.txt"), "a.txt", "not a log that can be read", "--columns", "docs/columns.md")
    one_line_error(glider("info", "none"), "none", "no such file")
    assert "Usage: glider info" in glider("info").stdout + glider("info").stderr


def test_a_simulated_log_says_so(glider: Run) -> None:
    assert glider("simulate", "south-china-sea-2011", "--duration", "300", "-o", "a.mcap", "--quiet").returncode == 0
    assert glider("info", "a.mcap").stdout.startswith("SIMULATED FROM A RECONSTRUCTION: ")


def test_columns_that_are_not_read_are_named(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    head = "PLD_REALTIMECLOCK;GPCTD_TEMPERATURE;AROD_FT_DO;FLBBCD_CHL_COUNT;"
    (tmp_path / "a").write_text(f"{head}\n21/07/2019 10:00:00.000;4.0;251.3;9999;\n")
    assert glider_json("info", "a")["not_read"] == ["AROD_FT_DO"]
    assert "not read, 1 column with data: AROD_FT_DO" in glider("info", "a").stdout
    (tmp_path / "b.csv").write_text("elapsed_s,depth_m,oxygen,blank\n0,1,251,\n1,2,251,\n")
    assert glider_json("info", "b.csv")["not_read"] == ["oxygen"]
    text = glider("info", ROOT / "tests/data/slocum/comet-2016*").stdout
    assert "more (--json has them all)" in text.replace("\n  ", " ")
    assert max(map(len, text.splitlines())) <= 80


def test_own_files_in_gzip_say_what_to_do(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("time_utc,depth_m\n2020-01-01T00:00:00Z,1\n")
    for name, data in (("a.csv.gz", (tmp_path / "a.csv").read_bytes()), ("a.mcap.gz", b"\x89MCAP0\r\n"),
                       ("a.parquet.gz", b"PAR1"), ("a.nc.gz", b"CDF\x01")):  # fmt: skip
        (tmp_path / name).write_bytes(gzip.compress(data))
        one_line_error(glider("info", name), name, "in gzip", "gunzip it first")


def test_files_of_years_apart_are_told_as_such(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    for number, year in ((37, "2019"), (38, "2021")):
        name = f"sea035.12.gli.sub.{number}"
        text = (ROOT / "logs/seaexplorer-sea035" / name).read_bytes()
        (tmp_path / name).write_bytes(text.replace(b"/2019 ", f"/{year} ".encode()))
    shown = glider("info", str(tmp_path)).stdout
    assert "2019-07-21 23:37:42 to 2021-07-22 05:23:54 UTC, 2.0 yr" in shown
    assert "nothing recorded from 2019-07-22 02:28:55 to 2021-07-22 02:29:15" in shown
    document = glider_json("info", str(tmp_path))
    assert document["silence"] == {"start": "2019-07-22T02:28:55.000Z", "end": "2021-07-22T02:29:15.000Z"}
    # each file lasts 171 and 175 min, with some time at the surface
    assert all(150.0 < dive["duration_s"] / 60.0 < 171.0 for dive in document["dives"])
    assert len(document["dives"]) == 2
    warnings = [warning for report in document["files"] for warning in report["warnings"]]
    assert "starts 2 years and 1 day after the end of the files before it; joined all the same" in warnings
    assert max(map(len, shown.splitlines())) <= 80
