"""The contract of missions: ``glider missions``, what a mission file may say, and what is said of a bad one."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from conftest import Run, one_line_error

HEAD = 'name = "mine"\ndescription = "a plan"\n'
DIVE = '[[leg]]\nkind = "dive"\npitch_deg = -30.0\nnet_buoyancy_kg = 0.3\nuntil_depth_m = 100.0\n'
CLIMB = '[[leg]]\nkind = "climb"\npitch_deg = 30.0\nnet_buoyancy_kg = -0.3\nuntil_depth_m = 0.0\n'
SHIPPED = ("south-china-sea-2011", "sawtooth-transect", "station-keeping-spiral", "heading-hold-yoyo")


def plan(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "plan.toml"
    path.write_text(HEAD + text)
    return path


def names(document: Any) -> list[str]:
    return [event["name"] for event in document["events"]]


def test_the_shipped_missions_are_listed(glider: Run, glider_json: Callable[..., Any]) -> None:
    lines = glider("missions").stdout.splitlines()
    assert {line.split("  ", 1)[0] for line in lines} == set(SHIPPED)
    assert {item["name"] for item in glider_json("missions")["missions"]} == set(SHIPPED)


@pytest.mark.parametrize("name", SHIPPED)
def test_the_shipped_missions_fly_from_any_folder(glider_json: Callable[..., Any], name: str) -> None:
    document = glider_json("simulate", name)
    assert document["max_depth_m"] > 150.0
    assert document["origin"] == "simulated"


def test_the_station_is_kept_in_a_current_faster_than_the_glider(glider: Run, tmp_path: Path) -> None:
    assert glider("simulate", "station-keeping-spiral", "-o", "f.parquet").returncode == 0
    table = pd.read_parquet(tmp_path / "f.parquet")
    speed, pitch = table["speed_through_water_m_s"], table["pitch_deg"].map(math.radians).map(math.cos)
    assert table["current_east_m_s"].max() > (speed * pitch).max()
    assert table[["north_m", "east_m"]].map(abs).max().max() < 500.0  # the file's current alone carries it 2 km


def test_a_heading_is_held(glider: Run, tmp_path: Path) -> None:
    assert glider("simulate", "heading-hold-yoyo", "-o", "f.csv").returncode == 0
    table = pd.read_csv(tmp_path / "f.csv")
    events = json.loads((tmp_path / "f.csv-metadata.json").read_text())["events"]
    start = events[0]["time_ns"]
    for wanted in (30.0, 150.0, 270.0):
        end = next((e["time_ns"] - start) / 1e9 for e in events if e["name"] == f"end of dive at {wanted:g} deg")
        at = table["heading_deg"][table["elapsed_s"].searchsorted(end) - 1]
        assert at == pytest.approx(wanted, abs=4.0)  # what a time constant of 200 s leaves of 120 deg after 700 s


def test_legs_end_at_depth_time_altitude_and_turns(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    spiral = (
        '[[leg]]\nkind = "spiral"\npitch_deg = -30.0\nnet_buoyancy_kg = 0.3\nturning_radius_m = 150.0\nturns = 1.0\n'
    )
    low = '[[leg]]\nkind = "dive"\nname = "down"\npitch_deg = -30.0\nnet_buoyancy_kg = 0.3\nuntil_altitude_m = 50.0\n'
    timed = '[[leg]]\nkind = "wait"\nduration_s = 30.0\n'
    document = glider_json("simulate", plan(tmp_path, "bottom_m = 1100.0\n" + DIVE + spiral + timed + low))
    found = {event["name"]: event for event in document["events"]}
    assert found["end of dive"]["depth_m"] == pytest.approx(100.0, abs=1e-6)  # located to rounding
    assert found["end of wait"]["time_s"] - found["end of spiral"]["time_s"] == pytest.approx(30.0, abs=1e-6)
    assert found["end of flight"]["depth_m"] == pytest.approx(1050.0, abs=1e-6)


def test_repeats_hold_repeats(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    dive, climb = (leg.replace("[[leg]]", "[[leg.leg.leg]]") for leg in (DIVE, CLIMB))
    text = f"[[leg]]\nrepeat = 2\n[[leg.leg]]\nrepeat = 2\n{dive}{climb}"
    document = glider_json("simulate", plan(tmp_path, text))
    assert names(document).count("apogee") == 4
    assert document["energy"]["dives"] == 4


def test_grounding_ends_a_dive_and_surfacing_a_climb(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    document = glider_json("simulate", plan(tmp_path, "bottom_m = 60.0\n" + DIVE + CLIMB))
    assert names(document) == ["start", "dive begins", "grounding", "lift-off", "surfacing"]


def test_a_drift_goes_with_the_current(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "c.csv").write_text("depth_m,current_east_m_s,current_north_m_s\n0,0.5,0.0\n100,0.5,0.0\n")
    document = glider_json(
        "simulate", plan(tmp_path, '[[leg]]\nkind = "drift"\nduration_s = 1000.0\n'), "--adcp", "c.csv"
    )
    assert document["final"]["east_m"] == pytest.approx(500.0, rel=1e-12)
    assert document["final"]["depth_m"] == 0.0
    assert document["final"]["phase"] == "surface"


def test_the_rotation_returns_to_zero_at_times(glider: Run, tmp_path: Path) -> None:
    text = DIVE.replace('"dive"', '"spiral"').replace("100.0", "400.0")
    text += "mass_rotation_deg = -60.0\nrotation_on_s = 300.0\nrotation_off_s = 60.0\n"
    assert glider("simulate", plan(tmp_path, text), "-o", "f.csv").returncode == 0
    rotation = pd.read_csv(tmp_path / "f.csv")["mass_rotation_deg"]
    assert rotation[100] == pytest.approx(-60.0)
    assert rotation[350] == pytest.approx(0.0)
    assert rotation[500] == pytest.approx(-60.0)


def test_the_actuators_of_a_mission_are_the_missions(glider: Run, tmp_path: Path) -> None:
    text = "[actuators]\nmass_position_rate_mm_s = 1.0\nreturn_rate_cm3_s = 1.0\n"
    assert glider("simulate", plan(tmp_path, DIVE + CLIMB + text), "-o", "f.csv").returncode == 0
    table = pd.read_csv(tmp_path / "f.csv")
    assert table["mass_position_m"].diff().abs().max() == pytest.approx(1e-3, rel=1e-6)
    assert table["net_buoyancy_kg"].diff().max() == pytest.approx(1025.0 * 1e-6, rel=1e-6)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (DIVE.replace("until_depth_m = 100.0\n", ""), ("leg 1 (dive)", "cannot end", "until_depth_m")),
        (DIVE.replace("-30.0", "30.0"), ("leg 1 (dive)", "pitch_deg = 30", "allowed")),
        (DIVE.replace("0.3", "0.7"), ("leg 1 (dive)", "net_buoyancy_kg = 0.7", "-0.5 to 0.5")),
        (DIVE.replace("-30.0", "-79.0"), ("leg 1 (dive)", "pitch_deg = -79", "allowed")),
        (DIVE + "mass_rotation_deg = 120.0\n", ("leg 1 (dive)", "mass_rotation_deg = 120", "-90 to 90")),
        (DIVE + "heading_deg = 90.0\nturn_rate_deg_s = 0.1\n", ("heading_deg and turn_rate_deg_s",)),
        (DIVE.replace('"dive"', '"spiral"') + "turning_radius_m = 10.0\n", ("turning_radius_m = 10", "m or more")),
        (DIVE.replace('"dive"', '"loop"'), ("leg 1", "kind = 'loop'", "hold-heading")),
        (DIVE + "dept_m = 3\n", ("leg 1 (dive)", "dept_m is unknown", "until_depth_m", "pitch_deg")),
        ("sped = 3\n" + DIVE, ("sped is unknown", "start_depth_m")),
        ("[steering]\ngain = 3.0\n" + DIVE, ("gain is unknown", "heading_gain")),
        (DIVE.replace("until_depth_m = 100.0", "turns = 3.0"), ("leg 1 (dive)", "goes straight", "until_depth_m")),
        ("start_time = 9999-01-01T00:00:00Z\n" + DIVE, ("start_time = 9999", "1700 to 2195")),
        ("start_depth_m = 200.0\n" + DIVE, ("leg 1 (dive)", "200.0 m", "beyond its end")),
        (
            "[actuators]\nmass_position_min_m = 0.5\nmass_position_max_m = 0.4\n" + DIVE,
            ("plan.toml: actuators: mass_position_min_m and mass_position_max_m must increase",),
        ),
        (
            "[actuators]\nmass_rotation_min_deg = 5.0\nmass_rotation_max_deg = 4.0\n" + DIVE,
            ("plan.toml: actuators: mass_rotation_min_deg and mass_rotation_max_deg must not decrease",),
        ),
        (
            "[actuators]\nmass_rotation_min_deg = 0.0\nmass_rotation_max_deg = 0.0\n" + DIVE + "heading_deg = 90.0\n",
            ("leg 1 (dive)", "mass rotation is fixed", "nothing else steers"),
        ),
        (DIVE.replace("until_depth_m", "until_altitude_m"), ("leg 1 (dive)", "bottom_m")),
        ("duration_s = 1e9\n" + DIVE, ("duration_s = 1000000000.0", "100000000")),
        ("duration_s = nan\n" + DIVE, ("duration_s",)),
        (CLIMB.replace("-0.3", "0.3").replace("0.0\n", "0.0\n"), ("leg 1 (climb)", "cannot end", "until_depth_m = 0")),
        (DIVE.replace("0.3", "-0.3"), ("leg 1 (dive)", "cannot end")),
        ("leg = []\n", ("leg",)),
        ("[steering]\nperiod_s = 0.0\n" + DIVE, ("steering.period_s = 0.0",)),
        ("[actuators]\nnet_buoyancy_min_kg = 0.6\n" + DIVE, ("net_buoyancy_min_kg and net_buoyancy_max_kg",)),
    ],
)  # fmt: skip
def test_bad_missions_are_one_line(glider: Run, tmp_path: Path, text: str, words: tuple[str, ...]) -> None:
    start = "" if "climb" not in text else "start_depth_m = 50.0\n"
    one_line_error(glider("simulate", plan(tmp_path, start + text), "-o", "f.csv"), "plan.toml", *words)
    assert not (tmp_path / "f.csv").exists()


def test_every_fault_is_told_at_once(glider: Run, tmp_path: Path) -> None:
    text = "latitude = 95.0\nspeed = 1\n" + DIVE.replace("-30.0", "30.0") + CLIMB.replace("until_depth_m = 0.0\n", "")
    one_line_error(
        glider("simulate", plan(tmp_path, text)), "4 faults", "latitude", "speed", "leg 1 (dive)", "leg 2 (climb)"
    )


def test_unsorted_controls_name_file_and_line(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "c.csv").write_text(
        "elapsed_s,mass_position_m,mass_rotation_deg,net_buoyancy_kg\n0,0.42,0,0.3\n0,0.42,0,0.3\n"
    )
    text = 'duration_s = 60.0\n[[leg]]\nkind = "controls"\ncontrols = "c.csv"\n'
    one_line_error(glider("simulate", plan(tmp_path, text)), "c.csv", "line 3", "elapsed_s")


def test_water_that_holds_the_vehicle_up_is_named(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "w.csv").write_text("depth_m,density_kg_m3\n0,1025\n50,1025\n60,1033\n500,1034\n")
    text = 'ctd = "w.csv"\n' + DIVE.replace("100.0", "400.0")
    one_line_error(glider("simulate", plan(tmp_path, text)), "plan.toml", "leg 1 (dive)", "cannot end", "400")


def test_a_leg_that_begins_beyond_its_end_is_told(glider: Run, tmp_path: Path) -> None:
    high = CLIMB.replace("until_depth_m = 0.0", "until_depth_m = 150.0")
    done = glider("simulate", plan(tmp_path, DIVE + high + CLIMB))
    assert done.returncode == 0
    assert "leg 2 (climb) begins at 100.0 m, beyond its end" in done.stderr


def test_a_leg_of_controls_may_end_after_a_time(glider_json: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "c.csv").write_text(
        "elapsed_s,mass_position_m,mass_rotation_deg,net_buoyancy_kg\n0,0.42,0,0.3\n10,0.42,0,0.3\n"
    )
    text = '[[leg]]\nkind = "controls"\ncontrols = "c.csv"\nduration_s = 60.0\n'
    document = glider_json("simulate", plan(tmp_path, 2 * text))
    assert [event["time_s"] for event in document["events"] if event["name"].startswith("end of")] == [60.0, 120.0]


def test_a_vehicle_with_a_fixed_mass_rotation_flies_straight(glider: Run, tmp_path: Path) -> None:
    """The Slocum of the file has nothing to steer with; straight legs need no steering."""
    (tmp_path / "plan.toml").write_text(HEAD + 'vehicle = "slocum"\n' + DIVE.replace("0.3", "0.2"))
    done = glider("simulate", "plan.toml", "-o", "f.csv")
    assert done.returncode == 0, done.stderr
    flown = pd.read_csv(tmp_path / "f.csv")
    assert flown["heading_deg"].nunique() == 1
    assert flown["depth_m"].iloc[-1] == pytest.approx(100.0, abs=1e-3)
