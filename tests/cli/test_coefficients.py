"""``glider coefficients cases`` and ``fit``: the contract of the commands, and the way from one to the other."""

from __future__ import annotations

import csv
import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from conftest import Run
from made_forces import FLOW, SIZE, forces_of

from glidercli.coefficients.flows.case_table import COLUMNS
from glidercli.model import Parameters
from glidercli.trim import trim
from glidercli.vehicle import load_vehicle


@pytest.fixture
def forces(glider: Run, tmp_path: Path, p: Parameters) -> Path:
    """The table that ``cases`` writes, with six columns of forces, 1 % noise."""
    assert glider("coefficients", "cases", "-o", "cases.csv").returncode == 0
    table = pd.read_csv(tmp_path / "cases.csv")
    clean = forces_of({name: table[name].to_numpy() for name in table}, p)
    noise = np.random.default_rng(7).normal(size=clean.shape) * 0.01 * SIZE
    table[list(FLOW)] = clean + noise
    table.to_csv(tmp_path / "forces.csv", index=False)
    return tmp_path / "forces.csv"


@pytest.mark.parametrize("command", ["cases", "fit"])
def test_help(glider: Run, command: str) -> None:
    done = glider("coefficients", command, "--help")
    assert done.returncode == 0
    for option in ("--json", "--quiet", "--force", "--debug", "--output", "--vehicle"):
        assert option in done.stdout


def test_cases_as_csv_json_parquet_and_stdout(glider: Run, tmp_path: Path) -> None:
    done = glider("coefficients", "cases", "-o", "c.csv", "-o", "c.json", "-o", "c.parquet", "--json")
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    assert document["counts"] == {"straight": 49, "about-p3": 50, "about-p2": 50}
    assert document["cases"][0]["turning_radius_m"] is None
    record = json.loads((tmp_path / "c.csv-metadata.json").read_text())
    assert record["origin"] == "computed"
    assert record["command"][1:3] == ["coefficients", "cases"]
    with (tmp_path / "c.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert tuple(rows[0]) == COLUMNS
    assert len(rows) == 149
    assert rows[0]["turning_radius_m"] == ""
    kept = json.loads((tmp_path / "c.json").read_text())
    assert kept["provenance"] == {**record, "command": kept["provenance"]["command"]}
    assert kept["cases"] == document["cases"]
    table = pd.read_parquet(tmp_path / "c.parquet")
    assert list(table) == list(COLUMNS)
    assert table["p_rad_s"].to_numpy() == pytest.approx(np.array([float(row["p_rad_s"]) for row in rows]), abs=0.0)
    piped = glider("coefficients", "cases", "-o", "-")
    assert piped.stdout == (tmp_path / "c.csv").read_text()


def test_cases_on_a_terminal_are_a_summary(glider: Run) -> None:
    done = glider("coefficients", "cases")
    assert done.returncode == 0
    assert "149 cases for seawing\nstraight         49" in done.stdout
    assert "Reynolds number 4.32e+05" in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_water_by_temperature(glider_json: Any) -> None:
    """Independent: seawater at 15 degC, 35 psu, has 1.2201e-3 Pa s (ITTC), 1025.97 kg/m3 (UNESCO EOS-80)."""
    one = glider_json("coefficients", "cases", "--temperature", 15)["cases"][0]
    assert one["viscosity_Pa_s"] == pytest.approx(1.2201e-3, rel=1e-3)
    assert one["density_kg_m3"] == pytest.approx(1025.97, abs=0.02)


def test_the_range_of_the_turbulence_models_is_a_warning(glider: Run) -> None:
    done = glider("coefficients", "cases", "--speed", 0.03, "--json")
    assert done.returncode == 0
    assert "outside 1e+05 to 1e+06" in done.stderr
    assert "outside 1e+05 to 1e+06" in json.loads(done.stdout)["warnings"][0]
    assert glider("coefficients", "cases", "--speed", 0.03, "--quiet").stderr == ""


@pytest.mark.parametrize(
    ("arguments", "code", "told"),
    [
        (("--radius", 1.9), 1, "radius: 1.9 m is not allowed; more than 1.98 m is needed"),
        (("--speed", 0), 1, "speed: 0 m/s is not allowed"),
        (("--vehicle", "nosuch"), 1, "nosuch: is no vehicle"),
        (("--temperature", 90), 1, "temperature: 90 degC"),
        (("--temperature", 15, "--salinity", 99), 1, "--salinity: 99 is not allowed; 0 to 42"),
        (("--salinity", 35), 2, "--salinity is part of --temperature"),
        (("--temperature", 15, "--density", 1000, "--viscosity", 1e-3), 2, "--temperature gives density"),
        (("-o", "c.txt"), 1, "c.txt: unknown output .txt; allowed: .json .csv .parquet"),
        (("-o", "c.png"), 1, "c.png: unknown output .png"),
        (("-o", "-", "--json"), 2, "both want stdout"),
        (("-o", "no/c.csv"), 1, "folder no does not exist"),
        (("--speed", "fast"), 2, ""),
    ],
)
def test_cases_refused(glider: Run, tmp_path: Path, arguments: tuple[Any, ...], code: int, told: str) -> None:
    done = glider("coefficients", "cases", *arguments)
    assert done.returncode == code
    assert told in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""
    assert list(tmp_path.iterdir()) == []
    if code == 1:
        assert done.stderr.startswith("glider: error: ")
        assert done.stderr.count("\n") == 1


def test_an_output_is_replaced_with_force_alone(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "c.csv").write_text("mine")
    refused = glider("coefficients", "cases", "-o", "c.csv", "-o", "c.json")
    assert refused.returncode == 1
    assert "c.csv: exists; --force replaces it" in refused.stderr
    assert (tmp_path / "c.csv").read_text() == "mine"
    assert not (tmp_path / "c.json").exists()
    assert glider("coefficients", "cases", "-o", "c.csv", "--force").returncode == 0
    assert (tmp_path / "c.csv").read_text().startswith("case,")


def test_from_cases_to_a_vehicle_that_flies(glider: Run, tmp_path: Path, forces: Path, p: Parameters) -> None:
    done = glider(
        "coefficients", "fit", forces.name, "--vehicle", "seawing",
        *("-o", "new.toml", "-o", "fit.png", "-o", "fit.svg", "-o", "fit.pdf", "-o", "fit.csv", "-o", "fit.json", "-o", "fit.parquet"),
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "149 cases, 149 used" in done.stdout
    new, old = load_vehicle(tmp_path / "new.toml"), load_vehicle("seawing")
    assert new.name == "new"
    assert new.mass == old.mass
    assert new.added_mass == old.added_mass
    text = (tmp_path / "new.toml").read_text()
    assert "fitted to 25 cases of forces.csv (straight, sideslip 0), standard error" in text
    assert "sha256" in text
    document = json.loads((tmp_path / "fit.json").read_text())
    by_name = {one["name"]: one for one in document["coefficients"]}
    for name, one in by_name.items():  # written to six digits
        assert getattr(new.hydrodynamics, name) == pytest.approx(one["value"], rel=1e-5)
        assert abs(one["value"] - getattr(old.hydrodynamics, name)) < 4.5 * one["standard_error"]
        assert one["difference_in_standard_errors"] == pytest.approx(
            (one["value"] - getattr(old.hydrodynamics, name)) / one["standard_error"]
        )
    assert document["provenance"]["inputs"][0]["path"] == "forces.csv"
    assert (tmp_path / "fit.csv-metadata.json").exists()
    rows = pd.read_csv(tmp_path / "fit.csv")
    assert list(rows["symbol"]) == [one["symbol"] for one in document["coefficients"]]
    assert (tmp_path / "fit.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "fit.pdf").read_bytes().startswith(b"%PDF")
    flown = trim(str(tmp_path / "new.toml"), net_buoyancy=0.3, mass_position=0.4216, mass_rotation=0.785398)
    assert flown.speed == pytest.approx(0.49, rel=0.05)  # the worked example's; coefficients within 1 %


def test_the_same_command_gives_the_same_bytes(glider: Run, tmp_path: Path, forces: Path) -> None:
    outputs = ("-o", "f.png", "-o", "f.json", "-o", "f.toml", "-o", "f.csv")
    once = []
    for _ in range(2):
        assert glider("coefficients", "fit", forces.name, "--vehicle", "seawing", *outputs, "--force").returncode == 0
        once.append([(tmp_path / name).read_bytes() for name in outputs[1::2]])
    assert once[0] == once[1]


def test_json_of_a_fit(glider_json: Any, forces: Path) -> None:
    document = glider_json("coefficients", "fit", forces.name)
    assert document["cases"] == {"records": 149, "used": 149, "unused": []}
    assert document["reference_density_kg_m3"] == 1025.0
    assert document["fitted_angle_deg"] == pytest.approx(12.0)
    assert [one["symbol"] for one in document["coefficients"]] == [
        "KD0", "KD", "KL0", "Kalpha", "KM0", "KM", "Kbeta", "KMY", "Kr", "KMR", "Kp", "Kq",
    ]  # fmt: skip
    for one in document["equations"]:
        residual = np.array(one["table_values"]) - np.array(one["fitted_values"])
        assert one["rms_residual"] == pytest.approx(np.sqrt(np.mean(residual**2)))
        assert one["largest_residual"]["value"] == pytest.approx(residual[np.abs(residual).argmax()])
        assert one["largest_residual"]["line"] == one["lines"][int(np.abs(residual).argmax())]
        assert one["degrees_of_freedom"] == one["cases"] - len(one["coefficients"])


def test_a_partial_table_names_what_stays_the_vehicles(glider: Run, tmp_path: Path, forces: Path) -> None:
    table = pd.read_csv(forces)
    table[table["set"] == "straight"].to_csv(tmp_path / "tank.csv", index=False)
    refused = glider("coefficients", "fit", "tank.csv", "--vehicle", "seawing", "-o", "tank.toml")
    assert refused.returncode == 1
    assert refused.stderr.count("\n") == 1
    assert "KMY, Kr (yaw moment): no case turning about p3" in refused.stderr
    assert not (tmp_path / "tank.toml").exists()
    done = glider("coefficients", "fit", "tank.csv", "--vehicle", "seawing", "--partial", "-o", "tank.toml")
    assert done.returncode == 0
    assert "Not fitted, of seawing.toml: KMY, Kr, KMR, Kp, Kq" in done.stdout
    assert load_vehicle(tmp_path / "tank.toml").hydrodynamics.yaw_rate == -389.30


def test_what_stays_of_the_base_is_brought_to_the_density_of_the_table(
    glider: Run, tmp_path: Path, forces: Path
) -> None:
    """In fresh water: coefficients and added mass hold at one density, so a kept one is scaled with the rest."""
    table = pd.read_csv(forces)
    table = table[table["set"] == "straight"].assign(density_kg_m3=1000.0)
    table.to_csv(tmp_path / "tank.csv", index=False)
    done = glider("coefficients", "fit", "tank.csv", "--vehicle", "seawing", "--partial", "-o", "tank.toml")
    assert done.returncode == 0, done.stderr
    new, old = load_vehicle(tmp_path / "tank.toml"), load_vehicle("seawing")
    assert new.hydrodynamics.reference_density == 1000.0
    assert new.hydrodynamics.yaw_rate == pytest.approx(old.hydrodynamics.yaw_rate * 1000 / 1025, rel=1e-5)
    assert new.added_mass.mass == pytest.approx([m * 1000 / 1025 for m in old.added_mass.mass], rel=1e-5)


def test_a_vehicle_that_is_still_being_made(glider: Run, tmp_path: Path, forces: Path) -> None:
    (tmp_path / "mine.toml").write_text('name = "mine"\ndescription = "begun"\nreference = "none"\n')
    done = glider("coefficients", "fit", forces.name, "--vehicle", "mine.toml", "-o", "next.toml")
    assert done.returncode == 0, done.stderr
    assert "next.toml is no whole vehicle yet; it lacks hull, mass" in done.stderr
    assert 'name = "mine"' in (tmp_path / "next.toml").read_text()


def test_driving_damping_makes_no_vehicle(glider: Run, tmp_path: Path, forces: Path) -> None:
    table = pd.read_csv(forces)
    table["yaw_moment_N_m"] *= -1.0
    table.to_csv(tmp_path / "wrong.csv", index=False)
    done = glider("coefficients", "fit", "wrong.csv", "--vehicle", "seawing", "-o", "wrong.toml")
    assert done.returncode == 1
    assert "wrong.csv: Kr = 38" in done.stderr
    assert "damping is never positive; --hold Kr leaves it at the vehicle's value" in done.stderr
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "wrong.toml").exists()
    looked = glider("coefficients", "fit", "wrong.csv", "--vehicle", "seawing")
    assert looked.returncode == 0
    assert "damping is never positive" in looked.stderr


@pytest.mark.parametrize(
    ("arguments", "code", "told"),
    [
        (("nosuch.csv",), 1, "nosuch.csv: no such file"),
        ((".",), 1, ".: is a folder"),
        (("empty.csv",), 1, "empty.csv: is empty"),
        (("binary.csv",), 1, "binary.csv: is not a text file"),
        (("forces.csv", "-o", "new.toml"), 2, "a vehicle file needs --vehicle"),
        (("forces.csv", "-o", "a.toml", "-o", "b.toml", "--vehicle", "seawing"), 2, "one vehicle file"),
        (("forces.csv", "-o", "f.nc"), 1, "f.nc: unknown output .nc; allowed: .json .csv .parquet .toml .png"),
        (("forces.csv", "-o", "forces.csv", "--force"), 1, "forces.csv: is an input of this very command"),
        (("forces.csv", "-o", "-", "--json"), 2, "both want stdout"),
        (("forces.csv", "--vehicle", "nosuch"), 1, "nosuch: is no vehicle"),
        (("forces.csv", "--subtract-munk"), 2, "--subtract-munk"),
        (("forces.csv", "--density", "1000"), 2, "--density is for tables without"),
        ((), 2, ""),
    ],
)
def test_fit_refused(
    glider: Run, tmp_path: Path, forces: Path, arguments: tuple[Any, ...], code: int, told: str
) -> None:
    (tmp_path / "empty.csv").write_bytes(b"")
    (tmp_path / "binary.csv").write_bytes(os.urandom(64) + b"\0")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    done = glider("coefficients", "fit", *arguments)
    assert done.returncode == code
    assert told in done.stderr
    assert "Traceback" not in done.stderr
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
    if code == 1:
        assert done.stderr.startswith("glider: error: ")
        assert done.stderr.count("\n") == 1


def test_what_forces_are_is_said_everywhere(glider: Run, tmp_path: Path, forces: Path) -> None:
    table = pd.read_csv(forces).assign(origin="simulated")
    table.to_csv(tmp_path / "cfd.csv", index=False)
    done = glider("coefficients", "fit", "cfd.csv", "--vehicle", "seawing", "-o", "new.toml", "-o", "f.json")
    assert "149 simulated cases" in done.stdout
    assert "fitted to 25 simulated cases of cfd.csv" in (tmp_path / "new.toml").read_text()
    assert json.loads((tmp_path / "f.json").read_text())["origin"] == ["simulated"]
    table.assign(origin="guessed").to_csv(tmp_path / "odd.csv", index=False)
    refused = glider("coefficients", "fit", "odd.csv")
    assert refused.returncode == 1
    assert "line 2: origin = 'guessed'; allowed: reconstruction" in refused.stderr


def test_quiet_says_nothing_but_the_answer(glider: Run, forces: Path) -> None:
    assert glider("coefficients", "fit", forces.name, "--vehicle", "seawing", "--quiet").stderr == ""
