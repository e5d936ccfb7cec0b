"""The contract of ``glider info``: what a log holds, as replay would read it."""

from __future__ import annotations

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
