"""The contract of ``glider coefficients estimate``, as a user meets it."""

from __future__ import annotations

import csv
import inspect
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import Run, one_line_error
from pyarrow import parquet

ESTIMATE = ("coefficients", "estimate")
SYMBOLS = ["K_D0", "K_D", "K_beta", "K_L0", "K_alpha", "K_MR", "K_p", "K_M0", "K_M", "K_q", "K_MY", "K_r"]
SHAPE = """name = "mine"
description = "a test"
reference = "none"
[hull]
length = { value = 1.5, unit = "m" }
diameter = { value = 0.2, unit = "m" }
[surface.wing]
plane = "horizontal"
semi_span = { value = 0.5, unit = "m" }
root_chord = { value = 0.1, unit = "m" }
tip_chord = { value = 0.1, unit = "m" }
root_position = { value = 0.0, unit = "m" }
tip_position = { value = 0.0, unit = "m" }
"""


def test_json(glider_json: Callable[..., Any]) -> None:
    told = glider_json(*ESTIMATE, "seawing-estimated", "--vehicle", "seawing")
    assert told["origin"] == "estimated"
    assert told["vehicle"] == "seawing"
    assert told["model_munk_moment_kg_rad"] == pytest.approx({"pitch": 64.44, "yaw": -48.10})  # Table 3
    assert [one["symbol"] for one in told["coefficients"]] == SYMBOLS
    for one in told["coefficients"]:
        assert one["lower"] <= one["value"] <= one["upper"]
        assert one["value"] == pytest.approx(sum(part["value"] for part in one["parts"].values()))
        assert one["vehicle_inside"] is (one["lower"] <= one["vehicle"] <= one["upper"])
        assert one["ratio"] is None or one["ratio"] == pytest.approx(one["value"] / one["vehicle"])
    assert any("drag_area" in line for line in told["warnings"])


def test_text_says_what_it_is(glider: Run) -> None:
    done = glider(*ESTIMATE, "seawing-estimated", "--vehicle", "seawing")
    assert done.returncode == 0
    assert done.stdout.startswith("ESTIMATED from seawing-estimated by handbook formulas")
    assert "docs/estimates.md" in done.stdout
    assert all(
        len(line) <= 80 for line in done.stdout.splitlines() if not line.endswith(".")
    )  # prose wraps on terminals
    assert "glider: warning: drag_area is 0" in done.stderr
    quiet = glider(*ESTIMATE, "seawing-estimated", "--vehicle", "seawing", "--quiet")
    assert (quiet.stderr, quiet.stdout) == ("", done.stdout)


def test_outputs(glider: Run, tmp_path: Path) -> None:
    names = ["est.toml", "est.json", "est.csv", "est.parquet", "est.png", "est.svg", "est.pdf"]
    options = [word for name in names for word in ("-o", name)]
    done = glider(*ESTIMATE, "seawing-estimated", "--vehicle", "seawing", *options)
    assert done.returncode == 0, done.stderr
    assert [line for line in done.stderr.splitlines() if line.startswith("wrote")] == [f"wrote {n}" for n in names]
    table = list(csv.DictReader((tmp_path / "est.csv").read_text(encoding="utf-8").splitlines()))
    assert [row["symbol"] for row in table] == SYMBOLS
    assert {row["origin"] for row in table} == {"estimated"}
    told = json.loads((tmp_path / "est.json").read_text(encoding="utf-8"))
    record = json.loads((tmp_path / "est.csv-metadata.json").read_text(encoding="utf-8"))
    assert told["provenance"] == record
    assert record["origin"] == "estimated"
    assert [Path(item["path"]).name for item in record["inputs"]] == ["seawing-estimated.toml", "seawing.toml"]
    assert parquet.read_table(tmp_path / "est.parquet").column("symbol").to_pylist() == SYMBOLS
    text = (tmp_path / "est.toml").read_text(encoding="utf-8")
    assert (
        text.count("estimated from seawing-estimated by handbook formulas") == len(SYMBOLS) + 3
    )  # density, angle, description
    assert "worked example" in text  # the base's comments stay
    again = glider(*ESTIMATE, "seawing-estimated", "--vehicle", "seawing", "-o", "est.json")
    one_line_error(again, "est.json", "--force")
    assert glider(*ESTIMATE, "seawing-estimated", "-o", "est.json", "--force").returncode == 0


def test_stdout_is_a_table(glider: Run) -> None:
    done = glider(*ESTIMATE, "seawing-estimated", "-o", "-")
    assert [row["symbol"] for row in csv.DictReader(done.stdout.splitlines())] == SYMBOLS
    one_line_error(glider(*ESTIMATE, "seawing-estimated", "-o", "-", "--json"), "--json", code=2)


def test_a_vehicle_that_is_not_whole(glider: Run, tmp_path: Path) -> None:
    """What is there counts: its density and added mass; what is missing is named; it takes what it is given."""
    (tmp_path / "begun.toml").write_text(
        'name = "mine"\n[hydrodynamics]\nreference_density = { value = 1000.0, unit = "kg/m3" }\n', encoding="utf-8"
    )
    done = glider(*ESTIMATE, "seawing-estimated", "--vehicle", "begun.toml", "-o", "new.toml", "--json")
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["reference_density_kg_m3"] == 1000.0
    assert "it lacks description, reference, hull" in done.stderr
    assert "no whole added_mass" in done.stderr
    assert "value = 1000.0" in (tmp_path / "new.toml").read_text(encoding="utf-8")


def test_the_vehicles_angle_counts(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "begun.toml").write_text(
        '[hydrodynamics]\nfitted_angle = { value = 6.0, unit = "deg" }\n', encoding="utf-8"
    )
    assert glider_json(*ESTIMATE, "seawing", "--vehicle", "begun.toml")["fitted_angle_deg"] == pytest.approx(6.0)
    given = glider_json(*ESTIMATE, "seawing", "--vehicle", "begun.toml", "--angle", 8)
    assert given["fitted_angle_deg"] == pytest.approx(8.0)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--speed", "0"], ["speed: 0 m/s is not allowed"]),
        (["--speed", "nan"], ["speed: nan"]),
        (["--speed", "-1"], ["speed: -1"]),
        (["--viscosity", "inf"], ["viscosity: inf"]),
        (["--angle", "45"], ["--angle", "0.1 to 30"]),
        (["--vehicle", "none"], ["none", "shipped are"]),
        (["--vehicle", "none.toml"], ["none.toml", "no such file"]),
        (["-o", "est.xyz"], ["est.xyz", ".toml"]),
        (["-o", "no/est.json"], ["folder no does not exist"]),
        (["-o", "."], ["."]),
    ],
)
def test_what_is_refused(glider: Run, tmp_path: Path, options: list[str], words: list[str]) -> None:
    one_line_error(glider(*ESTIMATE, "seawing-estimated", *options), *words)
    assert list(tmp_path.iterdir()) == []


def test_wrong_usage(glider: Run) -> None:
    one_line_error(glider(*ESTIMATE, "seawing-estimated", "--json", "-o", "-"), "stdout", code=2)
    one_line_error(glider(*ESTIMATE, "no-such"), "no-such", "shipped are", "seawing-estimated")


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        ("1.5", "nan", "hull.length"),
        ("1.5", "true", "hull.length"),
        ("1.5", '"1.5"', "hull.length"),
        ("1.5", "-1.5", "hull.length"),
        ("1.5", "1e9", "hull.length"),
        ('plane = "horizontal"', 'plane = "slanted"', "plane"),
        ("semi_span", "span", "span is unknown"),
        (SHAPE, "", "is empty"),
        (SHAPE, "name = ", "TOML"),
        (SHAPE, "name;value\n1,5;2", "TOML"),
    ],
)
def test_geometries_with_faults(glider: Run, tmp_path: Path, old: str, new: str, word: str) -> None:
    (tmp_path / "mine.toml").write_text(SHAPE.replace(old, new), encoding="utf-8")
    one_line_error(glider(*ESTIMATE, "mine.toml", "-o", "est.json"), "mine.toml", word)
    assert not (tmp_path / "est.json").exists()


def test_vehicles_with_faults(glider: Run, tmp_path: Path) -> None:
    text = "[hydrodynamics]\ndrag_zero = 3\n[added_mass]\nmass = { value = [1, 2], unit = 'kg' }\nodd = 1\n"
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    one_line_error(
        glider(*ESTIMATE, "seawing", "--vehicle", "mine.toml"), "mine.toml: 3 faults", "drag_zero", "odd", "mass"
    )
    (tmp_path / "mine.toml").write_text("hydrodynamics = 3\n", encoding="utf-8")
    one_line_error(glider(*ESTIMATE, "seawing", "--vehicle", "mine.toml"), "mine.toml", "hydrodynamics")


def test_an_input_is_no_output(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(SHAPE, encoding="utf-8")
    done = glider(*ESTIMATE, "mine.toml", "--vehicle", "seawing", "-o", "mine.toml", "--force")
    one_line_error(done, "mine.toml", "input")
    assert (tmp_path / "mine.toml").read_text(encoding="utf-8") == SHAPE


def test_windows_line_ends(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_bytes(SHAPE.replace("\n", "\r\n").encode())
    assert glider(*ESTIMATE, "mine.toml", "--quiet").stdout.startswith("ESTIMATED from mine")


def test_a_name_that_looks_like_a_formula(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(SHAPE.replace('"mine"', '"$mine_{ 100 %"'), encoding="utf-8")
    done = glider(*ESTIMATE, "mine.toml", "-o", "est.png", "--vehicle", "seawing", "-o", "new.toml")
    assert done.returncode == 0, done.stderr


def test_a_vehicle_from_nothing_says_what_it_lacks(glider: Run) -> None:
    done = glider(*ESTIMATE, "seawing-estimated", "-o", "new.toml")
    assert done.returncode == 0
    assert "new.toml is no whole vehicle yet; it lacks description, reference, hull, mass" in done.stderr


def test_defaults_are_those_of_the_library() -> None:
    """Written out in the command, so that --help shows them and costs no import."""
    from glidercli.cli.coefficients import cases, estimate
    from glidercli.coefficients.flows.case_table import SPEED
    from glidercli.coefficients.flows.reynolds import PAPER_VISCOSITY

    defaults = [inspect.signature(command).parameters for command in (cases.cases, estimate.estimate)]
    assert [one["speed"].default for one in defaults] == [SPEED, SPEED]
    assert defaults[1]["viscosity"].default == PAPER_VISCOSITY
