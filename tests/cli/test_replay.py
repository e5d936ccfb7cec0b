"""The contract of ``glider replay``, from its words alone."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from conftest import ROOT, Run, one_line_error
from terminals import on_a_terminal

LOGS = ROOT / "logs/seaexplorer-sea035"


def test_json_has_the_contracts_form(glider_json: Callable[..., Any]) -> None:
    document = glider_json("replay", LOGS, "-o", "a.mcap")
    assert set(document) == {"files", "channels", "outputs", "part", "passed_over"}
    for entry in document["files"]:
        assert {"path", "format", "records", "kept", "dropped", "warnings"} <= set(entry)
        assert entry["records"] == entry["kept"] + sum(item["count"] for item in entry["dropped"])
    names = {channel["name"] for channel in document["channels"]}
    assert names >= {
        "depth_m", "pitch_deg", "roll_deg", "heading_deg", "mass_position_m", "mass_rotation_deg", "ballast_volume_cm3",
        "temperature_degC", "conductivity_S_m", "pressure_dbar", "latitude_deg", "longitude_deg", "north_m", "east_m",
        "down_m",
    }  # fmt: skip
    for channel in document["channels"]:
        assert {"name", "unit", "samples", "first", "last", "minimum", "maximum"} <= set(channel)
    assert document["outputs"] == ["a.mcap"]


def test_outputs_pass_independent_checks(glider: Run, tmp_path: Path) -> None:
    assert glider("replay", LOGS, "-o", "a.mcap", "-o", "a.rrd").returncode == 0
    for tool in (["pymcap-cli", "doctor", "a.mcap"], ["rerun", "rrd", "verify", "a.rrd"]):
        command = [str(Path(sys.executable).with_name(tool[0])), *tool[1:]]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, (tool, done.stdout, done.stderr)


def test_a_broken_file_is_named_and_strict_makes_it_1(glider: Run, tmp_path: Path) -> None:
    shutil.copy(LOGS / "sea035.12.gli.sub.37", tmp_path)
    (tmp_path / "broken.txt").write_text("no log\n")
    done = glider("replay", "sea035.12.gli.sub.37", "broken.txt")
    assert done.returncode == 0
    assert "broken.txt" in done.stderr
    one_line_error(glider("replay", "sea035.12.gli.sub.37", "broken.txt", "--strict"), "broken.txt")


def test_start_and_end(glider_json: Callable[..., Any]) -> None:
    document = glider_json("replay", LOGS, "--start", "2019-07-22T00:00:00Z", "--end", "2019-07-22T01:00:00Z")
    for channel in document["channels"]:
        assert channel["first"] >= "2019-07-22T00:00:00"
        assert channel["last"] < "2019-07-22T01:00:00"


def test_bad_input_is_one_line(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "empty").write_bytes(b"")
    (tmp_path / "folder").mkdir()
    for target in ("missing", "empty", "folder", "*.none"):
        one_line_error(glider("replay", target, "-o", "o.mcap"), target)
    assert not (tmp_path / "o.mcap").exists()


def test_wrong_usage_is_2(glider: Run) -> None:
    one_line_error(glider("replay", LOGS, "--start", "later"), "--start", "ISO 8601", code=2)
    one_line_error(glider("replay", LOGS, "--end", "nan"), "--end", code=2)
    one_line_error(glider("replay", LOGS, "--format", "floppy"), "floppy", "seaexplorer", code=2)
    one_line_error(glider("replay", LOGS, "--json", "-o", "-"), "stdout", code=2)


def test_nothing_between_start_and_end_is_a_failure(glider: Run) -> None:
    one_line_error(glider("replay", LOGS, "--start", "10", "--end", "5"), "--start, --end", "2019-07-21T23:24:49")


def test_seconds_count_from_the_logs_start(glider_json: Callable[..., Any]) -> None:
    document = glider_json("replay", LOGS, "--start", "60", "--end", "120")
    assert min(channel["first"] for channel in document["channels"]) >= "2019-07-21T23:25:49"
    assert max(channel["last"] for channel in document["channels"]) < "2019-07-21T23:26:49"


def test_stdout_can_be_the_table(glider: Run) -> None:
    done = glider("replay", LOGS, "-o", "-", "--quiet")
    assert done.returncode == 0
    assert done.stdout.startswith("time_utc,elapsed_s,")
    assert done.stderr == ""


def test_people_see_files_and_channels(glider: Run) -> None:
    done = glider("replay", LOGS)
    assert [line.split()[1:4] for line in done.stdout.splitlines() if line.startswith("sea035.12.gli.sub.37")] == [
        ["seaexplorer", "504", "504"]
    ]
    assert any(line.startswith("pitch_deg ") for line in done.stdout.splitlines())


def test_inputs_are_all_that_was_read_and_no_more(glider: Run, tmp_path: Path) -> None:
    """The cache of a Slocum, the mapping of a table, the .log that tells true heading of a Seaglider's .eng."""
    slocum = ROOT / "tests/data/slocum/comet-2016-174-05-000.dbd"
    shutil.copy(ROOT / "tests/data/seaglider/p5610004.eng", tmp_path)
    shutil.copy(ROOT / "tests/data/seaglider/p5610004.log", tmp_path)
    (tmp_path / "t.csv").write_text("t,z\n1600000001,5\n1600000002,6\n")
    (tmp_path / "t.toml").write_text(
        '[time]\ncolumn = "t"\nformat = "unix"\n[columns]\ndepth = {column = "z", unit = "m"}\n'
    )
    wanted = [(slocum, [slocum.name, "11d38bfd.cac"]), ("p5610004.eng", ["p5610004.eng", "p5610004.log"])]
    wanted.append(("t.csv", ["t.csv", "t.toml"]))
    for name, files in wanted:
        assert glider("replay", name, "-o", "o.csv", "--force").returncode == 0
        told = json.loads((tmp_path / "o.csv-metadata.json").read_text())["metadata"]["provenance"]
        assert [Path(entry["path"]).name for entry in told["inputs"]] == files


def test_notes_are_wrapped_for_a_terminal_alone(glider: Run, tmp_path: Path) -> None:
    piped = glider("replay", LOGS).stdout
    assert max(map(len, piped.splitlines())) > 200
    code, lines = on_a_terminal(80, "replay", LOGS, "--quiet")
    assert code == 0
    assert max(map(len, lines)) <= 80
    assert " ".join(" ".join(lines).split()) == " ".join(piped.split())


def test_attach_puts_the_raw_files_into_the_mcap(glider: Run, tmp_path: Path) -> None:
    from mcap.reader import make_reader

    assert glider("replay", LOGS, "-o", "a.mcap", "--attach", "--quiet").returncode == 0
    with (tmp_path / "a.mcap").open("rb") as stream:
        found = {item.name: item.data for item in make_reader(stream, validate_crcs=True).iter_attachments()}
    read = {Path(entry["path"]).name for entry in json.loads(found.pop("provenance.json"))["inputs"]}
    assert found.keys() == read
    assert found == {name: (LOGS / name).read_bytes() for name in read}
    done = glider("replay", LOGS, "-o", "a.csv", "--attach")
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert "--attach" in done.stderr
    assert not (tmp_path / "a.csv").exists()


def test_with_puts_logs_side_by_side_in_rerun(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    from rerun.chunk import RrdReader

    controls = ("--net-buoyancy", "0.3", "--mass-position", "0.42", "--mass-rotation", "30", "--duration", "600")
    assert glider("simulate", *controls, "-o", "one.csv", "--quiet").returncode == 0
    told = glider_json("replay", LOGS, "--with", "one.csv", "--with", LOGS, "-o", "two.rrd")
    assert [Path(entry["path"]).name for entry in told["files"]].count("one.csv") == 1
    entities = {chunk.entity_path for chunk in RrdReader(tmp_path / "two.rrd").stream().to_chunks()}
    assert {"/navigation/depth", "/beside/1/navigation/depth", "/beside/2/navigation/depth"} <= entities
    assert {"/difference/1/depth", "/difference/2/depth"} <= entities
    for outputs in (["-o", "two.csv"], []):
        done = glider("replay", LOGS, "--with", "one.csv", *outputs)
        assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
        assert "--with" in done.stderr
    assert not (tmp_path / "two.csv").exists()
    one_line_error(glider("replay", LOGS, "--with", "gone.csv", "-o", "a.rrd"), "gone.csv")
    one_line_error(glider("replay", LOGS, "--with", "two.rrd", "-o", "two.rrd", "--force"), "two.rrd")
