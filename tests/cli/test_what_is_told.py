"""Is what was left out, passed over or not understood told to people, in lines that fit their terminal?"""

from __future__ import annotations

import gzip
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT, Run, one_line_error
from terminals import on_a_terminal

LOGS = ROOT / "logs/seaexplorer-sea035"
SEAGLIDER = ROOT / "logs/seaglider-sg561"
CASTS = ROOT / "tests/data/ctd"


@pytest.mark.parametrize("command", ["info", "replay"])
@pytest.mark.parametrize(("columns", "told"), [(60, None), (80, None), (80, 60), (200, None), (52, None)])
@pytest.mark.parametrize("log", [LOGS, SEAGLIDER])
def test_lines_fit_the_terminal(command: str, columns: int, told: int | None, log: Path) -> None:
    code, lines = on_a_terminal(columns, command, log, "--quiet", told=told)
    assert code == 0
    assert max(map(len, lines)) <= min(told or columns, 80)
    assert any(line.startswith("mass_position_m") for line in lines)
    whole = on_a_terminal(80, command, log, "--quiet")[1]
    assert sorted(" ".join(lines).split()) == sorted(" ".join(whole).split())  # nothing is lost in a narrow one


def test_columns_say_how_wide_a_pipe_may_be(glider: Run) -> None:
    done = glider("info", LOGS, env=os.environ | {"COLUMNS": "60"})
    assert max(map(len, done.stdout.splitlines())) <= 60


def table(path: Path, *cells: str) -> Path:
    rows = [f"2020-01-01T00:00:{i:02d}Z,{i + 1},{cell}" for i, cell in enumerate(cells)]
    path.write_text("\n".join(["time_utc,depth_m,pitch_deg", *rows]) + "\n")
    return path


def test_info_shows_what_was_left_out(glider: Run, tmp_path: Path) -> None:
    table(tmp_path / "a.csv", "1", "12m", "999")
    lines = glider("info", "a.csv").stdout.splitlines()
    start = lines.index("warnings:")
    told = " ".join(" ".join(lines[start:]).split())
    assert "a.csv: pitch_deg: 1 cells left out that are no number, the first in line 3: '12m'" in told
    assert "a.csv: pitch_deg: 1 values outside -90..90 deg left out" in told
    assert max(map(len, lines)) <= 80


def test_many_warnings_are_counted(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    heads = ["depth_m", "pitch_deg", "roll_deg", "temperature_degC", "salinity"]
    for number in range(7):
        rows = [f"2020-01-0{number + 1}T00:00:0{i}Z,{i + 1},1e6,1e6,1e6,1e6" for i in range(2)]
        (tmp_path / f"{number}.csv").write_text("\n".join(["time_utc," + ",".join(heads), *rows]) + "\n")
    entries = glider_json("info", tmp_path)["files"]
    assert {len(entry["warnings"]) for entry in entries} == {5}
    lines = glider("info", tmp_path).stdout.splitlines()
    start = lines.index("warnings:")
    shown = lines[start + 1 : lines.index("", start)]
    assert "  0.csv: ... 2 more warnings (--json has them all)" in shown
    assert shown[-1] == "  ... 10 more warnings of 2 more files (--json has them all)"
    assert len([line for line in shown if not line.startswith("    ")]) == 5 * 4 + 1


@pytest.mark.parametrize("command", ["info", "replay"])
def test_an_empty_name_is_not_the_current_folder(glider: Run, tmp_path: Path, command: str) -> None:
    shutil.copy(LOGS / "sea035.12.gli.sub.37", tmp_path)
    one_line_error(glider(command, ""), "LOG: is an empty name", ". is the current folder")
    one_line_error(glider(command, ".", ""), "LOG: is an empty name")
    assert glider(command, ".").returncode == 0


def test_hidden_files_and_links_are_named(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    name = "sea035.12.gli.sub.37"
    shutil.copy(LOGS / name, tmp_path)
    shutil.copy(LOGS / "sea035.12.gli.sub.38", tmp_path / ".sea035.12.gli.sub.38")
    (tmp_path / "again").symlink_to(tmp_path / name)
    (tmp_path / ".folder").mkdir()
    told = [
        f"{tmp_path}: 1 hidden file: .sea035.12.gli.sub.38",
        f"{tmp_path / 'again'}: the same file as {tmp_path / name}, by a link; read once",
    ]
    for command in ("info", "replay"):
        document = glider_json(command, tmp_path)
        assert document["passed_over"] == told
        assert len(document["files"]) == 1
        assert "not looked at:" in glider(command, tmp_path).stdout
    assert glider_json("info", tmp_path / name, tmp_path / name)["passed_over"] == []
    assert glider_json("info", tmp_path / "again")["passed_over"] == []


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("ctd/*.cnv", ("is a CTD cast of Sea-Bird, not a log", "glider simulate --ctd FILE")),
        ("adcp/*.000", ("is RDI PD0 data of an ADCP", "glider simulate --adcp FILE")),
        ("adcp/*.ad2cp", ("is Nortek .ad2cp data of an ADCP", "glider simulate --adcp FILE")),
    ],
)
def test_water_and_current_are_pointed_to_where_they_belong(
    glider: Run, tmp_path: Path, name: str, words: tuple[str, ...]
) -> None:
    found = sorted((ROOT / "tests/data").glob(name))
    assert found
    shutil.copy(found[0], tmp_path / "a.bin")  # by content, not by name
    for command in ("info", "replay"):
        one_line_error(glider(command, "a.bin"), "a.bin: ", *words)


def test_a_table_of_profiles_is_pointed_to_where_it_belongs(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("depth_m,temperature_degC,salinity\n1,20,35\n9,19,35\n")
    one_line_error(glider("info", "a.csv"), "holds profiles by depth, not a log", "--ctd FILE", "--adcp FILE")


def test_the_console_log_of_a_slocum_says_what_to_give(glider: Run, tmp_path: Path) -> None:
    text = b"the8x3_filename:    01600000\nfull_filename:    x-2023-107-0-0\n 13.67  2 01600000.mlg LOG FILE OPENED\n"
    (tmp_path / "a.mlg").write_bytes(text)
    (tmp_path / "a.mcg").write_bytes(b"\x00\x20" + b"\xf0\x09" + text[:24] + b"\x01\x00" + text[24:])  # as LZ4 has it
    for name in ("a.mlg", "a.mcg"):
        one_line_error(glider("info", name), "is the console log of a Slocum", "give the .dbd and .ebd")


TEXTS = [
    LOGS / "sea035.12.gli.sub.37", LOGS / "sea035.12.pld1.sub.37", SEAGLIDER / "p5610003.eng",
    SEAGLIDER / "p5610003.log", ROOT / "logs/south-china-sea-2011/dive.csv",
]  # fmt: skip


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.name)
@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_utf_16_is_named(glider: Run, tmp_path: Path, path: Path, encoding: str) -> None:
    data = path.read_text(encoding="latin-1").encode(encoding)
    (tmp_path / path.name).write_bytes(data)
    one_line_error(glider("info", path.name), "is text in UTF-16", "iconv -f UTF-16 -t UTF-8")
    one_line_error(glider("info", path.name, "--format", "seaexplorer"), "is text in UTF-16")
    (tmp_path / "a.gz").write_bytes(gzip.compress(data))
    one_line_error(glider("info", "a.gz"), "is text in UTF-16")


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.name)
def test_lines_that_end_in_cr_alone_are_read_or_named(
    glider: Run, glider_json: Callable[..., Any], tmp_path: Path, path: Path
) -> None:
    (tmp_path / path.name).write_bytes(path.read_bytes().replace(b"\r\n", b"\n").replace(b"\n", b"\r"))
    if path.parent == LOGS:
        one_line_error(glider("info", path.name), "has lines that end in CR alone", r"tr '\r' '\n'")
        return
    shutil.copy(path, tmp_path / "whole")
    whole, cr = glider_json("info", "whole"), glider_json("info", path.name)
    assert [c["samples"] for c in cr["channels"]] == [c["samples"] for c in whole["channels"]]


def test_a_cast_in_utf_16_is_named(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes("depth_m,temperature_degC,salinity\n1,20,35\n9,19,35\n".encode("utf-16"))
    one_line_error(
        glider("simulate", "south-china-sea-2011", "--duration", "10", "--ctd", "a.csv"), "is text in UTF-16"
    )


def test_a_log_that_was_used_is_not_missing(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    for ending in ("eng", "log"):
        shutil.copy(SEAGLIDER / f"p5610003.{ending}", tmp_path)
    assert not [line for line in glider_json("info", "p5610003.eng")["missing"] if "log" in line]
    assert any("eng, which goes with" in line for line in glider_json("info", "p5610003.log")["missing"])
    (tmp_path / "p5610003.log").unlink()
    assert any("log, which goes with" in line for line in glider_json("info", "p5610003.eng")["missing"])


def test_a_part_says_that_records_are_counted_of_whole_files(glider: Run, glider_json: Callable[..., Any]) -> None:
    part = ("--start", "2019-07-22T00:00:00Z", "--end", "7200")
    document, whole = glider_json("replay", LOGS, *part), glider_json("replay", LOGS)
    assert document["files"] == whole["files"]
    assert document["part"] == {"start": "2019-07-22T00:00:00.000Z", "end": "2019-07-22T01:24:49.000Z"}
    assert whole["part"] is None
    assert glider_json("replay", LOGS, "--end", "60")["part"]["start"] is None
    shown = glider("replay", LOGS, *part).stdout
    assert "records above are of whole files; samples below from 2019-07-22T00:00:00.000Z to 2019-07-22T01:24" in shown
    assert "records above" not in glider("replay", LOGS).stdout
    assert "records are counted of whole files" in " ".join(glider("replay", "--help").stdout.split())
