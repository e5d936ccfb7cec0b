"""The contract of ``glider simulate``, from its words alone."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT, Run, one_line_error

CONTROLS = ("--net-buoyancy", "0.3", "--mass-position", "0.4216", "--mass-rotation", "45")
CNV = ROOT / "tests/data/ctd/dPIRX010.cnv"


def table(path: Path, *rows: str) -> Path:
    path.write_text("\n".join(rows) + "\n")
    return path


def test_json_has_the_contracts_keys(glider_json: Callable[..., Any]) -> None:
    document = glider_json("simulate", *CONTROLS, "--duration", "60")
    assert set(document) >= {
        "duration_s", "max_depth_m", "final", "events", "distance_m", "energy_j", "warnings", "wall_s",
        "simulated_seconds_per_second",
    }  # fmt: skip
    assert document["duration_s"] == 60.0
    assert {"depth_m", "pitch_deg", "speed_through_water_m_s", "net_buoyancy_kg"} <= set(document["final"])
    assert all(set(event) == {"name", "time_s", "depth_m"} for event in document["events"])


def test_starts_from_rest_level_heading_north_at_the_start_depth(glider: Run) -> None:
    done = glider("simulate", *CONTROLS, "--duration", "10", "--start-depth", "20", "-o", "-")
    assert done.returncode == 0, done.stderr
    first = next(csv.DictReader(done.stdout.splitlines()))
    assert float(first["depth_m"]) == 20.0
    for name in ("speed_through_water_m_s", "pitch_deg", "roll_deg", "heading_deg", "p_deg_s", "north_m"):
        assert abs(float(first[name])) < 1e-12, name  # exact zeros, save for the rounding of a rotation


def test_every_sets_the_samples(glider: Run) -> None:
    done = glider("simulate", *CONTROLS, "--duration", "10", "--every", "2.5", "-o", "-")
    times = [float(row["elapsed_s"]) for row in csv.DictReader(done.stdout.splitlines())]
    assert times == [0.0, 2.5, 5.0, 7.5, 10.0]


def test_floating_at_the_surface_names_start_depth(glider: Run) -> None:
    one_line_error(glider("simulate", "--net-buoyancy", "-0.3", *CONTROLS[2:]), "--start-depth")


def test_climbing_from_depth_ends_at_the_surface(glider_json: Callable[..., Any]) -> None:
    document = glider_json(
        "simulate", "--net-buoyancy", "-0.3", "--mass-position", "0.3816", "--mass-rotation", "0",
        "--start-depth", "50", "--duration", "2000",
    )  # fmt: skip
    assert document["events"][-1]["name"] == "surfacing"
    assert document["final"]["depth_m"] == pytest.approx(0.0, abs=1e-9)  # the crossing is bisected to rounding
    assert document["duration_s"] < 2000


def test_real_cast_and_current(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    current = table(tmp_path / "c.csv", "depth_m,current_east_m_s,current_north_m_s", "0,0.5,0.1", "900,0.1,0.0")
    document = glider_json("simulate", *CONTROLS, "--ctd", CNV, "--adcp", current, "--duration", "300", "--quiet")
    assert {"density_kg_m3", "temperature_degC", "current_east_m_s"} <= set(document["final"])


@pytest.mark.parametrize(
    ("name", "rows", "words"),
    [
        ("ctd", ("depth_m,temperature_degC", "0,20", "10,19"), ("salinity",)),
        ("ctd", ("depth_m,density_kg_m3", "10,1025", "5,1026"), ("line 3", "depth_m")),
        ("ctd", ("depth_m,density_kg_m3", "10,1025", "10,1026"), ("line 3", "depth_m")),
        ("adcp", ("depth_m,current_east_m_s", "10,0.1"), ("current_north_m_s",)),
        ("adcp", ("depth_m,current_east_m_s,current_north_m_s", "9,0,0", "8,0,0"), ("line 3", "depth_m")),
    ],
)
def test_bad_profiles_are_one_line(glider: Run, tmp_path: Path, name: str, rows: tuple[str, ...], words: Any) -> None:
    bad = table(tmp_path / "bad.csv", *rows)
    one_line_error(glider("simulate", *CONTROLS, f"--{name}", bad, "-o", "o.csv"), "bad.csv", *words)
    assert not (tmp_path / "o.csv").exists()


@pytest.mark.parametrize("name", ["ctd", "adcp"])
def test_files_that_are_none(glider: Run, tmp_path: Path, name: str) -> None:
    (tmp_path / "empty.csv").write_bytes(b"")
    (tmp_path / "binary.csv").write_bytes(bytes(range(256)) * 20)
    (tmp_path / "folder").mkdir()
    for target in ("missing.csv", "empty.csv", "binary.csv", "folder"):
        one_line_error(glider("simulate", *CONTROLS, f"--{name}", tmp_path / target), target)


@pytest.mark.parametrize("option", ["--net-buoyancy", "--mass-position", "--mass-rotation", "--duration", "--every"])
def test_nan_is_refused(glider: Run, option: str) -> None:
    one_line_error(glider("simulate", *CONTROLS, option, "nan"), "nan")


def test_zero_mass_vehicle(glider: Run, tmp_path: Path) -> None:
    text = (ROOT / "glidercli/vehicle/data/seawing.toml").read_text()
    (tmp_path / "zero.toml").write_text(text.replace("static_mass = { value = 54.28", "static_mass = { value = 0"))
    one_line_error(
        glider("simulate", *CONTROLS, "--vehicle", "zero.toml"), "zero.toml", "mass.static_mass", "0 kg", "allowed"
    )


def test_outputs_carry_provenance(glider: Run, tmp_path: Path) -> None:
    done = glider("simulate", *CONTROLS, "--duration", "30", "-o", "a.mcap", "-o", "a.rrd", "-o", "a.csv")
    assert done.returncode == 0, done.stderr
    assert all((tmp_path / name).stat().st_size for name in ("a.mcap", "a.rrd", "a.csv"))
    record = json.loads((tmp_path / "a.csv-metadata.json").read_text())
    assert "glidercli" in json.dumps(record)
    assert "simulated" in json.dumps(record)


def test_shipped_mission_flies_from_any_folder_and_says_what_it_is(glider: Run, tmp_path: Path) -> None:
    done = glider("simulate", "south-china-sea-2011", "-o", "trial.csv")
    assert done.returncode == 0, done.stderr
    assert "RECONSTRUCTION" in done.stdout
    assert "reconstruct" in (tmp_path / "trial.csv-metadata.json").read_text()
    assert glider("replay", "trial.csv").stdout.startswith("SIMULATED FROM A RECONSTRUCTION\n")


def test_unknown_mission_names_the_shipped_ones(glider: Run) -> None:
    one_line_error(glider("simulate", "atlantis"), "atlantis", "south-china-sea-2011")


def test_two_runs_give_the_same_bytes(glider: Run, tmp_path: Path) -> None:
    for name in ("a.csv", "b.csv"):
        assert glider("simulate", *CONTROLS, "--duration", "100", "-o", name).returncode == 0
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()


def test_more_samples_than_memory_are_refused(glider: Run) -> None:
    one_line_error(glider("simulate", *CONTROLS, "--duration", "1e8", "--every", "0.001"), "duration", "samples")


@pytest.mark.parametrize("rtol", ["1", "1e-14", "nan"])
def test_a_tolerance_that_gives_no_answer_is_refused(glider: Run, rtol: str) -> None:
    one_line_error(glider("simulate", *CONTROLS, "--rtol", rtol), "rtol", "1e-13 to 0.001")


def test_more_net_buoyancy_than_mass_is_refused(glider: Run) -> None:
    one_line_error(glider("simulate", "--net-buoyancy", "1e6", *CONTROLS[2:]), "net buoyancy", "65.28 kg")


RECONSTRUCTED = ROOT / "logs/south-china-sea-2011"


@pytest.mark.parametrize("option", [("--ctd", "water.csv"), ("--adcp", "current.csv")])
def test_what_is_made_from_a_reconstruction_says_so(glider: Run, tmp_path: Path, option: tuple[str, str]) -> None:
    flown = glider("simulate", *CONTROLS, "--duration", "20", option[0], RECONSTRUCTED / option[1], "-o", "f.csv")
    assert flown.stdout.startswith("SIMULATED FROM A RECONSTRUCTION: " + option[1])
    assert {row["origin"] for row in csv.DictReader((tmp_path / "f.csv").read_text().splitlines())} == {
        "reconstruction"
    }
    assert "simulated, made with a reconstruction" in glider("compare", "south-china-sea-2011", "f.csv").stdout


def test_a_plan_that_borrows_reconstructed_controls_says_so(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "dive.csv").write_text((RECONSTRUCTED / "dive.csv").read_text())
    plan = 'name = "mine"\ndescription = "a plan"\nduration_s = 60\n[[leg]]\nname = "dive"\ncontrols = "dive.csv"\n'
    (tmp_path / "plan.toml").write_text(plan)
    assert "dive.csv" in glider_json("simulate", "plan.toml")["reconstruction"]


RESPELT = ("Origin", " Reconstruction ")


@pytest.mark.parametrize("option", [("--ctd", "water.csv"), ("--adcp", "current.csv")])
def test_a_reconstruction_is_one_however_it_is_spelt(glider: Run, tmp_path: Path, option: tuple[str, str]) -> None:
    text = (RECONSTRUCTED / option[1]).read_text().replace("origin", RESPELT[0]).replace("reconstruction", RESPELT[1])
    (tmp_path / option[1]).write_text(text)
    done = glider("simulate", *CONTROLS, "--duration", "20", *option)
    assert done.stdout.startswith("SIMULATED FROM A RECONSTRUCTION: " + option[1])
    (tmp_path / option[1]).write_text(text.replace(RESPELT[1], "guess"))
    one_line_error(
        glider("simulate", *CONTROLS, "--duration", "20", *option), "line 2", "origin = 'guess'", "reconstruction"
    )


def test_reconstructed_controls_are_that_however_they_are_spelt(glider: Run, tmp_path: Path) -> None:
    plan = 'name = "mine"\ndescription = "a plan"\nduration_s = 60\n[[leg]]\nname = "dive"\ncontrols = "dive.csv"\n'
    (tmp_path / "plan.toml").write_text(plan)
    text = (RECONSTRUCTED / "dive.csv").read_text().replace("origin", RESPELT[0]).replace("reconstruction", RESPELT[1])
    (tmp_path / "dive.csv").write_text(text)
    assert glider("simulate", "plan.toml").stdout.startswith("SIMULATED FROM A RECONSTRUCTION: dive.csv")
    (tmp_path / "dive.csv").write_text(text.replace(RESPELT[1], "guess"))
    one_line_error(glider("simulate", "plan.toml"), "dive.csv", "line 2", "origin = 'guess'", "reconstruction")


def test_bins_left_out_are_counted_and_named(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    head = "depth_m,current_east_m_s,current_north_m_s"
    table(tmp_path / "adcp.csv", head, "0,0.1,0", "2,nan,0", "4,-32.768,0", "6,99,0", "8,,0", "10,0.2,0")
    warnings = glider_json("simulate", *CONTROLS, "--duration", "20", "--adcp", "adcp.csv")["warnings"]
    (counted,) = [line for line in warnings if "left out" in line]
    assert "4 of 6 bins" in counted
    assert all(reason in counted for reason in ("2 gap", "1 bad-velocity mark", "1 faster than 5 m/s"))
    assert any("interpolated" in line and "10 m" in line for line in warnings)
    cast = glider_json("simulate", *CONTROLS, "--duration", "20", "--ctd", CNV)["warnings"]
    assert any("42 of 1014 samples left out" in line for line in cast)  # as counted from the file by hand


def test_gaps_in_tables_are_warned_of(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    depths = [*range(0, 100, 10), *range(600, 700, 10)]
    table(tmp_path / "c.csv", "depth_m,density_kg_m3", *(f"{z},{1025 + z / 200}" for z in depths))
    table(tmp_path / "a.csv", "depth_m,current_east_m_s,current_north_m_s", *(f"{z},0.1,0" for z in depths))
    flown = glider_json("simulate", *CONTROLS, "--duration", "20", "--ctd", "c.csv", "--adcp", "a.csv")
    for name, what in (("c.csv", "sample"), ("a.csv", "bin")):
        assert any(line.startswith(f"{name}: no {what} between 90.0 to 600.0 m") for line in flown["warnings"])


@pytest.mark.parametrize("salinity", ["0.035", "35"])
def test_salinity_in_kg_per_kg_is_doubted(glider_json: Callable[..., Any], tmp_path: Path, salinity: str) -> None:
    table(tmp_path / "c.csv", "depth_m,temperature_degC,salinity", f"0,10,{salinity}", f"100,9,{salinity}")
    warnings = glider_json("simulate", *CONTROLS, "--duration", "20", "--ctd", "c.csv")["warnings"]
    assert any("0.035 kg/kg" in line for line in warnings) == (salinity == "0.035")


def test_water_that_would_overturn_is_doubted(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    table(tmp_path / "c.csv", "depth_m,density_kg_m3", "0,1026", "50,1024", "100,1025")
    warnings = glider_json("simulate", *CONTROLS, "--duration", "20", "--ctd", "c.csv")["warnings"]
    assert any("falls with depth by up to 2.00 kg/m3" in line for line in warnings)


def test_an_input_as_output_is_refused_before_the_flight(glider: Run, tmp_path: Path) -> None:
    head = "depth_m,current_east_m_s,current_north_m_s"
    table(tmp_path / "adcp.csv", head, "0,0.1,0", "20,0.2,0")
    absurd = ("--duration", "1e8", "--every", "0.001")  # refused itself, but later
    done = glider("simulate", *CONTROLS, *absurd, "--adcp", "adcp.csv", "-o", "adcp.csv", "--force")
    one_line_error(done, "adcp.csv", "input")


def test_an_input_is_never_replaced(glider: Run, tmp_path: Path) -> None:
    head = "depth_m,current_east_m_s,current_north_m_s"
    path = table(tmp_path / "adcp.csv", head, "0,0.1,0", "20,0.2,0")
    before = path.read_bytes()
    done = glider("simulate", *CONTROLS, "--duration", "20", "--adcp", "adcp.csv", "-o", "adcp.csv", "--force")
    one_line_error(done, "adcp.csv", "input")
    assert path.read_bytes() == before
    assert [item.name for item in tmp_path.iterdir()] == ["adcp.csv"]


@pytest.mark.parametrize("force", [(), ("--force",)])
def test_metadata_that_cannot_be_written_stop_every_output(glider: Run, tmp_path: Path, force: tuple[str, ...]) -> None:
    (tmp_path / "b.csv-metadata.json").mkdir()
    outputs = ("-o", "a.mcap", "-o", "b.csv", "-o", "c.rrd")
    done = glider("simulate", *CONTROLS, "--duration", "1e8", "--every", "0.001", *outputs, *force)
    one_line_error(done, "b.csv-metadata.json", "is a folder")
    assert [item.name for item in tmp_path.iterdir()] == ["b.csv-metadata.json"]


def test_outputs_appear_all_or_none(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "closed.rrd").mkdir()
    one_line_error(glider("simulate", *CONTROLS, "--duration", "9", "-o", "a.csv", "-o", "closed.rrd"), "closed.rrd")
    one_line_error(
        glider("simulate", *CONTROLS, "--duration", "9", "-o", "a.csv", "-o", "b" * 250 + ".rrd"), "too long"
    )
    one_line_error(glider("simulate", *CONTROLS, "--duration", "9", "-o", "a.csv", "-o", "/proc/b.rrd"), "/proc/b.rrd")
    assert [item.name for item in tmp_path.iterdir()] == ["closed.rrd"]


def test_the_net_buoyancy_in_the_water_is_told(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    table(tmp_path / "c.csv", "depth_m,density_kg_m3", "0,1025", "100,1027.05")
    uniform = glider_json("simulate", *CONTROLS, "--duration", "20")
    assert uniform["net_buoyancy_in_water_kg"] == pytest.approx(0.3, abs=1e-12)  # rounding
    flown = glider_json("simulate", *CONTROLS, "--duration", "3600", "--ctd", "c.csv")
    density = flown["final"]["density_kg_m3"]
    expected = 0.3 * density / 1025.0 + 65.28 * (1.0 - density / 1025.0)  # rigid hull of 54.28 + 11 kg, Table 1
    assert flown["final"]["net_buoyancy_kg"] == 0.3
    assert flown["net_buoyancy_in_water_kg"] == pytest.approx(
        expected, abs=1e-6
    )  # density is printed to the last digit


def test_no_zero_is_negative(glider: Run, tmp_path: Path) -> None:
    table(tmp_path / "c.csv", "depth_m,current_east_m_s,current_north_m_s", "5,0.5,0.1", "900,0.1,0.0")
    done = glider(
        "simulate", *CONTROLS[:4], "--mass-rotation", "0", "--duration", "9", "--adcp", "c.csv", "-o", "f.csv"
    )
    with (tmp_path / "f.csv").open() as stream:
        assert {row["current_up_m_s"] for row in csv.DictReader(stream)} == {"0"}
    for text in (done.stdout, done.stderr, glider("replay", "f.csv").stdout):
        assert not re.search(r" -0(\.0*)?[ ,\n]", text), text


def test_an_absurd_start_depth_is_refused(glider: Run) -> None:
    one_line_error(glider("simulate", *CONTROLS, "--start-depth", "1e9"), "start depth", "12000")
