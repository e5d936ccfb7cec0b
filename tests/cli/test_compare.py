"""``glider compare`` from the contract's words: what is on stdout, what on stderr, and the exit code."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT
from mcap.reader import make_reader

GLIDER = Path(sys.executable).with_name("glider")
START = np.datetime64("2011-07-20T04:28:00.000", "ms")
FACTS = """
[facts]
source = "A paper"
[[fact]]
name = "maximum depth"
quantity = "max_depth"
value = 300.0
unit = "m"
tolerance = 10.0
place = "p. 11"
[[fact]]
name = "pitch on the dive"
quantity = "mean"
channel = "pitch"
phase = "dive"
value = -40.0
unit = "deg"
tolerance = 2.0
place = "p. 12"
note = "also a control input"
[[fact]]
name = "roll"
quantity = "mean"
channel = "roll"
value = 28.0
unit = "deg"
tolerance = 2.0
place = "p. 13"
"""


def glider(*arguments: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [GLIDER, "compare", *map(str, arguments)], capture_output=True, text=True, cwd=folder, timeout=120
    )


def write_log(path: Path, deeper: float = 0.0, turned: float = 0.0, late: float = 0.0) -> Path:
    """300 m down in 1000 s and up again, a sample every 5 s; heading turns through north."""
    seconds = np.arange(0.0, 2001.0, 5.0)
    depth = np.interp(seconds, [0.0, 1000.0, 2000.0], [0.0, 300.0, 0.0]) + deeper
    origin = "simulated" if path.stem == "simulated" else "measured"
    lines = ["time_utc,elapsed_s,depth_m,pitch_deg,heading_deg,origin"]
    for t, d in zip(seconds, depth, strict=True):
        time = START + np.timedelta64(round((t + late) * 1000), "ms")
        pitch = -30.0 if t <= 1000.0 else 30.0
        lines.append(f"{time}Z,{t},{d},{pitch},{(350.0 + 0.1 * t + turned) % 360.0},{origin}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def logs(tmp_path: Path) -> tuple[Path, Path]:
    return write_log(tmp_path / "measured.csv"), write_log(tmp_path / "simulated.csv", deeper=2.0, turned=20.0)


@pytest.fixture
def facts(tmp_path: Path) -> Path:
    path = tmp_path / "facts.toml"
    path.write_text(FACTS, encoding="utf-8")
    return path


def failed(result: subprocess.CompletedProcess[str], code: int) -> str:
    """The message of a failure: one line on stderr after nothing on stdout, and no traceback."""
    assert result.returncode == code
    assert result.stdout == ""
    assert "Traceback" not in result.stderr
    if code == 1:
        assert result.stderr.startswith("glider: error: ")
        assert result.stderr.count("\n") == 1
    return result.stderr


def test_json_is_one_document_in_the_contracts_form(logs) -> None:
    result = glider(*logs, "--json")
    assert result.returncode == 0, result.stderr
    found = json.loads(result.stdout)
    assert {"align", "channels", "phases", "events", "facts"} <= set(found)
    for name, unit in {"depth": "m", "pitch": "deg", "heading": "deg"}.items():
        one = found["channels"][name]
        assert set(one) >= {"unit", "n", "rmse", "mae", "bias", "std", "max", "correlation", "nrmse"}
        assert (one["unit"], one["n"]) == (unit, 401)
    # the CSV holds every digit of the values: rounding of unit conversions alone
    assert found["channels"]["depth"]["bias"] == pytest.approx(2.0, abs=1e-9)
    assert found["channels"]["heading"]["max"] == pytest.approx(20.0, abs=1e-9)  # across north: not 340
    assert set(found["phases"]) == {"dive", "climb"}
    assert found["phases"]["climb"]["depth"]["bias"] == pytest.approx(2.0, abs=1e-9)


def test_the_table_for_people_says_what_was_compared(logs) -> None:
    result = glider(*logs)
    assert result.returncode == 0, result.stderr
    first = result.stdout.splitlines()[0]
    assert str(logs[0]) in first
    assert str(logs[1]) in first
    assert all(word in result.stdout for word in ("flight:", "dive:", "climb:", "rmse", "depth", "heading"))


def test_align_and_offset(tmp_path: Path, logs) -> None:
    late = write_log(tmp_path / "late.csv", late=7200.0)
    assert "--align start" in failed(glider(logs[0], late), 1)
    for method in ("start", "xcorr"):
        found = json.loads(glider(logs[0], late, "--align", method, "--json").stdout)
        assert found["align"]["shift_s"] == pytest.approx(-7200.0, abs=1e-3)  # the same curves: rounding alone
    found = json.loads(glider(logs[0], late, "--offset", "-7200", "--json").stdout)
    assert found["channels"]["depth"]["rmse"] == pytest.approx(0.0, abs=1e-9)


def test_channels_repeat_or_are_a_pattern(logs) -> None:
    found = json.loads(glider(*logs, "--channels", "depth", "--channels", "pi*", "--json").stdout)
    assert set(found["channels"]) == {"depth", "pitch"}
    assert "depht" in failed(glider(*logs, "--channels", "depht"), 2)


def test_several_simulations(tmp_path: Path, logs) -> None:
    other = write_log(tmp_path / "other.csv", deeper=-1.0)
    found = json.loads(glider(*logs, other, "--json").stdout)
    assert [one["name"] for one in found["simulations"]] == [str(logs[1]), str(other)]


def test_outputs(tmp_path: Path, logs) -> None:
    names = ["errors.csv", "errors.json", "figure.png", "figure.svg", "figure.pdf"]
    options = [option for name in names for option in ("-o", tmp_path / name)]
    result = glider(*logs, *options)
    assert result.returncode == 0, result.stderr
    assert all((tmp_path / name).stat().st_size for name in names)
    with (tmp_path / "errors.csv").open(newline="") as stream:
        assert {"channel", "phase", "rmse"} <= set(next(csv.reader(stream)))
    record = json.loads((tmp_path / "errors.csv-metadata.json").read_text())
    assert [Path(one["path"]).name for one in record["inputs"]] == ["measured.csv", "simulated.csv"]
    assert all(len(one["sha256"]) == 64 for one in record["inputs"])
    assert "exists" in failed(glider(*logs, "-o", tmp_path / "errors.csv"), 1)
    assert glider(*logs, "-o", tmp_path / "errors.csv", "--force").returncode == 0


def test_overlays_appear_with_the_tables_or_none_does(tmp_path: Path, logs) -> None:
    names = ["o.rrd", "o.mcap", "e.csv"]
    outputs = [word for name in names for word in ("-o", name)]
    (tmp_path / "e.csv").write_text("kept")
    assert "e.csv: exists" in failed(glider(*logs, *outputs, folder=tmp_path), 1)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["e.csv", "measured.csv", "simulated.csv"]
    result = glider(*logs, *outputs, "--align", "start", "--force", folder=tmp_path)
    assert result.returncode == 0, result.stderr
    assert all(f"wrote {name}" in result.stderr for name in names)
    told = subprocess.run(
        [GLIDER, "info", tmp_path / "o.mcap", "--json"], capture_output=True, text=True, timeout=120, check=True
    )
    assert "flights beside this one are not read: /beside/1 SIMULATED" in told.stdout
    with (tmp_path / "o.mcap").open("rb") as stream:
        run = next(r.metadata for r in make_reader(stream).iter_metadata() if r.name == "run")
    record = json.loads(run["provenance"])
    assert [Path(one["path"]).name for one in record["inputs"]] == ["measured.csv", "simulated.csv"]
    assert record["command"][1] == "compare"
    assert record["origins"]["measured"]["origin"] == "measured"


def test_nothing_is_written_when_an_overlay_fails(tmp_path: Path, logs) -> None:
    """1950 is no time of an MCAP file; what goes with it does not appear either."""
    for log in logs:
        log.write_text(log.read_text().replace("2011-", "1950-"))
    before = sorted(tmp_path.iterdir())
    outputs = ["-o", tmp_path / "o.rrd", "-o", tmp_path / "o.mcap", "-o", tmp_path / "e.csv"]
    assert "MCAP starts at 1970" in failed(glider(*logs, *outputs), 1)
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize("name", ["o.rrd", "o.mcap"])
def test_published_values_are_no_recording_to_overlay(tmp_path: Path, logs, facts: Path, name: str) -> None:
    line = failed(glider(facts, logs[1], "-o", tmp_path / name, "-o", tmp_path / "e.csv"), 1)
    assert f"{name}: not written: {facts} holds published values, which are no recording to overlay" in line
    assert not (tmp_path / name).exists()
    assert not (tmp_path / "e.csv").exists()


def test_dash_is_json_on_stdout(logs) -> None:
    result = glider(*logs, "-o", "-")
    assert json.loads(result.stdout) == json.loads(glider(*logs, "--json").stdout)


@pytest.mark.parametrize("name", ["report.docx", "overlay.nc", "errors"])
def test_an_unknown_output_lists_what_is_allowed(tmp_path: Path, logs, name: str) -> None:
    assert ".csv .json .png .svg .pdf .html" in failed(glider(*logs, "-o", tmp_path / name), 1)


def test_nothing_is_written_when_the_comparison_fails(tmp_path: Path, logs) -> None:
    late = write_log(tmp_path / "late.csv", late=7200.0)
    failed(glider(logs[0], late, "-o", tmp_path / "errors.csv"), 1)
    assert {path.name for path in tmp_path.iterdir()} == {"measured.csv", "simulated.csv", "late.csv"}


def test_missing_and_empty_files(tmp_path: Path, logs) -> None:
    assert "nowhere.csv" in failed(glider(logs[0], tmp_path / "nowhere.csv"), 1)
    assert "nowhere.toml" in failed(glider(tmp_path / "nowhere.toml", logs[1]), 1)
    (tmp_path / "empty.csv").touch()
    assert "empty.csv" in failed(glider(logs[0], tmp_path / "empty.csv"), 1)


@pytest.mark.parametrize("options", [("--align", "best"), ("--max-gap", "soon"), ("--max-gop", "3")])
def test_wrong_usage(logs, options: tuple[str, ...]) -> None:
    assert options[0] in failed(glider(*logs, *options), 2)


@pytest.mark.parametrize(
    "options", [("--max-gap", "0"), ("--max-gap", "nan"), ("--offset", "inf"), ("--offset", "1e12")]
)
def test_a_number_out_of_range_is_bad_input(logs, options: tuple[str, ...]) -> None:
    assert options[0] in failed(glider(*logs, *options), 1)


def test_a_simulated_log_is_needed(logs) -> None:
    assert glider(logs[0]).returncode == 2


def test_facts(logs, facts: Path) -> None:
    result = glider(facts, logs[1], "--json")
    assert result.returncode == 0, result.stderr
    verdicts = json.loads(result.stdout)["facts"]
    assert all({"name", "published", "simulated", "tolerance", "verdict", "place"} <= set(one) for one in verdicts)
    assert [one["verdict"] for one in verdicts] == ["agrees", "disagrees", "not simulated"]
    assert verdicts[0]["simulated"] == pytest.approx(302.0, abs=1e-9)  # a sample stands at the apogee
    text = glider(facts, logs[1]).stdout
    assert "published values" in text.splitlines()[0]
    assert all(word in text for word in ("300 ± 10", "disagrees", "not simulated", "p. 12", "also a control input"))


def test_facts_with_faults_name_them_all_in_one_line(logs, facts: Path) -> None:
    facts.write_text(FACTS.replace("tolerance = 10.0", "").replace('"deg"', '"rad"'), encoding="utf-8")
    message = failed(glider(facts, logs[1]), 1)
    assert "tolerance: missing" in message
    assert message.count("unit = 'rad'") == 2


def test_outputs_of_facts(tmp_path: Path, logs, facts: Path) -> None:
    result = glider(facts, logs[1], "-o", tmp_path / "facts.csv", "-o", tmp_path / "facts.png")
    assert result.returncode == 0, result.stderr
    with (tmp_path / "facts.csv").open(newline="") as stream:
        assert [row["verdict"] for row in csv.DictReader(stream)] == ["agrees", "disagrees", "not simulated"]
    assert (tmp_path / "facts.png").read_bytes().startswith(b"\x89PNG")


def test_quiet_keeps_stderr_empty(tmp_path: Path, logs) -> None:
    assert glider(*logs, "--quiet", "-o", tmp_path / "a.json").stderr == ""


def test_debug_shows_the_traceback(tmp_path: Path, logs) -> None:
    result = glider(logs[0], tmp_path / "nowhere.csv", "--debug")
    assert result.returncode == 1
    assert "Traceback" in result.stderr


def test_a_folder_with_facts_stands_for_them(logs, facts: Path) -> None:
    found = json.loads(glider(facts.parent, logs[1], "--json").stdout)
    assert [one["name"] for one in found["facts"]] == ["maximum depth", "pitch on the dive", "roll"]


def test_records_dropped_on_reading_are_counted(tmp_path: Path, logs) -> None:
    lines = logs[1].read_text().splitlines(keepends=True)
    dirty = tmp_path / "dirty.csv"
    dirty.write_text("".join([*lines[:5], "garbage\n", *lines[5:]]))
    result = glider(logs[0], dirty)
    assert result.returncode == 0
    assert f"dirty.csv: 1 of {len(lines)} records dropped: 1 wrong number of fields" in result.stderr


def test_a_measured_log_on_the_simulated_side_is_said(logs) -> None:
    assert "measured, and stands here as a simulation" in glider(logs[0], logs[0]).stderr


def test_a_simulated_first_log_is_not_called_measured(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    first, second = write_log(tmp_path / "simulated.csv"), write_log(tmp_path / "a/simulated.csv", deeper=2.0)
    result = glider("simulated.csv", "a/simulated.csv", "-o", "page.html", "-o", "errors.csv", folder=tmp_path)
    assert result.returncode == 0, result.stderr
    assert "measured" not in (result.stdout + result.stderr).lower()
    assert "Note: simulated.csv is simulated; the errors are against it, not against a recording." in result.stdout
    shown = re.sub(r"<(script|style)[^>]*>.*?</\1>", "", (tmp_path / "page.html").read_text(), flags=re.DOTALL)
    shown = re.sub(r'class="[^"]*"', "", shown)  # names of styles are not shown
    assert "measured" not in shown.lower()
    notes = json.loads((tmp_path / "errors.csv-metadata.json").read_text())["notes"]
    assert "measured" not in " ".join(notes)
    assert json.loads(glider(first, second, "--json").stdout)["origins"]["measured"]["origin"] == "simulated"  # a key


def test_a_table_that_lost_its_metadata_is_compared_as_derived(tmp_path: Path, logs) -> None:
    parted = tmp_path / "parted.csv"
    parted.write_text(logs[0].read_text().replace(",measured\n", ",measured and derived\n"))
    result = glider(parted, logs[1])
    assert f"{parted} (derived)" in result.stdout
    assert "parted.csv is derived, and stands here as a simulation" in glider(logs[0], parted).stderr


def test_outputs_are_checked_with_their_metadata(tmp_path: Path, logs) -> None:
    (tmp_path / "b.csv-metadata.json").mkdir()
    before = set(tmp_path.iterdir())
    for other in ("a.json", "b.csv-metadata.json"):
        outputs = ("-o", tmp_path / "b.csv", "-o", tmp_path / other)
        assert "b.csv-metadata.json: is " in failed(glider(*logs, *outputs, "--force"), 1)
    assert set(tmp_path.iterdir()) == before
    (tmp_path / "b.csv-metadata.json").rmdir()
    assert "named twice" in failed(glider(*logs, *outputs), 1)


def test_metadata_of_an_input_are_never_replaced(logs) -> None:
    beside = logs[0].with_name(logs[0].name + "-metadata.json")
    told = {"origin": "measured", "metadata": {}, "channels": {"depth": "measured"}, "events": []}
    beside.write_text(json.dumps(told))
    assert "input" in failed(glider(*logs, "-o", beside, "--force"), 1)


def test_an_input_is_never_replaced(logs) -> None:
    before = logs[1].read_bytes()
    assert "input" in failed(glider(*logs, "-o", logs[1], "--force"), 1)
    assert logs[1].read_bytes() == before


def test_what_cannot_be_read_is_no_input(tmp_path: Path) -> None:
    """A pipe among the files: reading it for its hash would wait for ever."""
    (tmp_path / "d").mkdir()
    shutil.copy(ROOT / "logs/seaexplorer-sea035/sea035.12.gli.sub.36", tmp_path / "d")
    os.mkfifo(tmp_path / "d/pipe")
    done = glider("d", "d/sea035.12.gli.sub.36", "-o", "e.json", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "d/pipe: is no regular file" in done.stderr


@pytest.mark.skipif(sys.platform == "darwin", reason="its file names are UTF-8")
def test_names_that_no_text_holds_are_written_out(tmp_path: Path) -> None:
    """A byte that is no UTF-8, and a control character, in each output."""
    write_log(tmp_path / "measured.csv")
    write_log(tmp_path / "simulated.csv")
    odd = tmp_path / os.fsdecode(b"sim\xff\x1b.csv")
    os.rename(tmp_path / "simulated.csv", odd)
    outputs = [tmp_path / f"out.{kind}" for kind in ("csv", "json", "html", "png", "rrd", "mcap")]
    result = glider(tmp_path / "measured.csv", odd, *(word for path in outputs for word in ("-o", path)))
    assert result.returncode == 0, result.stderr
    assert "\x1b" not in result.stdout + result.stderr
    assert "Warning" not in result.stderr
    assert "sim\\udcff\\x1b.csv" in (tmp_path / "out.csv").read_text(encoding="utf-8")


def test_a_log_that_is_given_twice_is_numbered(logs) -> None:
    measured, simulated = logs
    ranking = json.loads(glider(measured, simulated, simulated, "--json").stdout)["ranking"]
    assert [one["name"] for one in ranking] == [f"{simulated} (1)", f"{simulated} (2)"]
