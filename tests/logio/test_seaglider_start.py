"""The start of a Seaglider's dive against its fixes, and that of the .eng against that of the .log."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT

from glidercli.errors import InputError
from glidercli.logio import read
from glidercli.logio.report import FileReport
from glidercli.logio.seaglider import read_seaglider

SG561 = ROOT / "logs/seaglider-sg561"
LOGS = [SG561 / "p5610003.log", *sorted((ROOT / "tests/data/seaglider").glob("*.log"))]
START = "start: 5 4 116 18 14 19"


def report_of(path: Path, start: str) -> FileReport:
    """Of dive 3 of sg561 with another start; $GPS2 is at 18:13:56, $GPS at 18:43:09, the last state at 18:41:37."""
    path.write_bytes((SG561 / "p5610003.log").read_bytes().replace(START.encode(), start.encode(), 1))
    report = read_seaglider(path).report
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    return report


def doubts(report: FileReport) -> list[str]:
    return [warning for warning in report.warnings if warning.startswith("start")]


@pytest.mark.parametrize("path", LOGS, ids=lambda path: path.name)
def test_a_real_start_raises_no_doubt(path: Path) -> None:
    assert doubts(read_seaglider(path).report) == []
    eng = path.with_suffix(".eng")
    assert doubts(read_seaglider(eng).report) == []


@pytest.mark.parametrize(
    ("clock", "says"),
    [
        ("18 12 19", "2016-05-04T18:12:19Z is 97 s before $GPS2"),
        ("18 04 19", "2016-05-04T18:04:19Z is 577 s before $GPS2"),
        ("10 14 19", "2016-05-04T10:14:19Z is 28777 s before $GPS2"),
        ("18 16 19", "2016-05-04T18:16:19Z brings the last state or motor run 28 s after $GPS"),
        ("19 14 19", "2016-05-04T19:14:19Z brings the last state or motor run 3508 s after $GPS"),
    ],
)
def test_a_start_that_the_fixes_contradict_is_told(tmp_path: Path, clock: str, says: str) -> None:
    (line,) = doubts(report_of(tmp_path / "p5610003.log", f"start: 5 4 116 {clock}"))
    assert line.startswith(f"start: {says}")


@pytest.mark.parametrize("clock", ["18 13 50", "18 14 19", "18 15 50"])
def test_what_lies_between_the_fixes_is_not(tmp_path: Path, clock: str) -> None:
    assert doubts(report_of(tmp_path / "p5610003.log", f"start: 5 4 116 {clock}")) == []


def test_a_fix_that_is_no_later_than_the_one_before_the_dive_tells_nothing(tmp_path: Path) -> None:
    """As of a dive that ended under ice."""
    data = (SG561 / "p5610003.log").read_bytes().replace(b"$GPS,040516,184309", b"$GPS,040516,181356", 1)
    (tmp_path / "p5610003.log").write_bytes(data)
    assert doubts(read_seaglider(tmp_path / "p5610003.log").report) == []


def test_of_all_flipped_bits_only_those_between_the_fixes_go_unnoticed(tmp_path: Path) -> None:
    """A flip moves every time by the same; beyond the spans between start and fixes it is told or refused."""
    path = tmp_path / "p5610003.log"
    good = read_seaglider(SG561 / "p5610003.log")
    unnoticed = []
    for at in range(len("start: "), len(START)):
        for bit in range(8):
            line = bytearray(START.encode())
            line[at] ^= 1 << bit
            try:
                path.write_bytes((SG561 / "p5610003.log").read_bytes().replace(START.encode(), bytes(line), 1))
                part = read_seaglider(path)
            except InputError:
                continue
            if part.report.warnings == good.report.warnings and part.report.dropped == good.report.dropped:
                unnoticed.append((int(part.log["phase"].time_ns[0] - good.log["phase"].time_ns[0])) / 1e9)
    moved = np.array([seconds for seconds in unnoticed if seconds])
    assert 1 <= len(moved) <= 10
    assert moved.min() >= -33.0  # 23 s to $GPS2, 10 s for the clock
    assert moved.max() <= 102.0  # 92 s from the last state to $GPS, 10 s for the clock


def test_a_eng_that_starts_at_another_time_than_its_log_is_told(tmp_path: Path) -> None:
    for name in ("p5610003.eng", "p5610003.log"):
        data = (SG561 / name).read_bytes()
        (tmp_path / name).write_bytes(data.replace(b"%start: 05 04 116 18 14 19", b"%start: 05 04 116 18 14 59", 1))
    reports = {report.path.name: report for report in read([tmp_path]).files}
    (line,) = doubts(reports["p5610003.eng"])
    assert line.startswith("start: 2016-05-04T18:14:59Z, in p5610003.log 2016-05-04T18:14:19Z, 40 s apart")
    assert doubts(reports["p5610003.log"]) == []
