"""The contract of --controls, --initial and --trim, from its words alone."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT, Run, one_line_error

SEA035 = ROOT / "logs/seaexplorer-sea035"
HELD = ("--net-buoyancy", "0.3", "--mass-position", "0.4216", "--mass-rotation", "45")
ACTUATORS = ["time_utc", "mass_position_m", "mass_rotation_deg", "net_buoyancy_kg"]


@pytest.fixture
def flown(glider: Run, tmp_path: Path) -> pd.DataFrame:
    """A flight that moves all three actuators, with a place and a date, as flown.csv."""
    (tmp_path / "c.csv").write_text(
        "elapsed_s,mass_position_m,mass_rotation_deg,net_buoyancy_kg\n0,0.4216,0,0.3\n300,0.4216,45,0.3\n600,0.42,-20,0.35\n"
    )
    (tmp_path / "m.toml").write_text(
        'name = "m"\ndescription = "d"\nduration_s = 900.0\nstart_time = 2020-05-06T07:08:09.5Z\nlatitude = 20.0\n'
        'longitude = 118.0\nheading_deg = 70.0\n[[leg]]\nkind = "controls"\ncontrols = "c.csv"\n'
    )
    assert glider("simulate", "m.toml", "-o", "flown.csv").returncode == 0
    (tmp_path / "flown.csv-metadata.json").unlink()  # a plain table, as anybody has them
    table = pd.read_csv(tmp_path / "flown.csv").drop(columns="origin")
    table.to_csv(tmp_path / "flown.csv", index=False)
    return table


def test_a_recorded_flight_is_flown_again(glider: Run, flown: pd.DataFrame, tmp_path: Path) -> None:
    done = glider("simulate", "--controls", "flown.csv", "--initial", "flown.csv", "-o", "again.csv")
    assert done.returncode == 0, done.stderr
    again = pd.read_csv(tmp_path / "again.csv")
    assert list(again["time_utc"]) == list(flown["time_utc"])  # the log's clock goes on
    assert again["elapsed_s"].iloc[-1] == 900.0  # to the last control sample
    for name in ("depth_m", "north_m", "east_m", "latitude_deg", "longitude_deg", "pitch_deg"):
        # tables of angles in degrees round to 1e-14; the two tables of controls part the steps differently, within
        # the tolerance of 1e-6
        np.testing.assert_allclose(again[name], flown[name], atol=2e-3, err_msg=name)


def test_only_actuators_are_read_from_controls(glider: Run, flown: pd.DataFrame, tmp_path: Path) -> None:
    flown[ACTUATORS].to_csv(tmp_path / "stripped.csv", index=False)
    for name in ("flown", "stripped"):
        for more, out in (((), "alone"), (("--initial", "flown.csv"), "both")):
            done = glider("simulate", "--controls", f"{name}.csv", *more, "-o", f"{name}-{out}.csv")
            assert done.returncode == 0, done.stderr
    for out in ("alone", "both"):
        assert (tmp_path / f"flown-{out}.csv").read_bytes() == (tmp_path / f"stripped-{out}.csv").read_bytes()


def test_elapsed_is_zero_at_the_first_depth(glider: Run, flown: pd.DataFrame, tmp_path: Path) -> None:
    flown.loc[:99, "depth_m"] = np.nan
    flown.to_csv(tmp_path / "late.csv", index=False)
    done = glider("simulate", "--controls", "late.csv", "--initial", "late.csv", "-o", "f.csv")
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "f.csv")
    assert table["time_utc"][0] == flown["time_utc"][100]
    assert table["elapsed_s"].iloc[-1] == 800.0
    for name in ("depth_m", "heading_deg", "pitch_deg", "roll_deg", "latitude_deg"):
        assert table[name][0] == pytest.approx(flown[name][100], abs=1e-9)  # through radians and a quaternion
    assert table["mass_rotation_deg"][10] == pytest.approx(flown["mass_rotation_deg"][110], abs=1e-12)


def test_what_is_not_plausible_is_a_trims_and_a_warning(
    glider: Run, glider_json: Callable[..., Any], tmp_path: Path
) -> None:
    (tmp_path / "i.csv").write_text(
        "elapsed_s,depth_m,heading_deg,pitch_deg,roll_deg\n0,40,70,89.9,-13\n1,41,70,89.9,-13\n"
    )
    done = glider("simulate", *HELD, "--initial", "i.csv", "--duration", "1", "-o", "f.csv")
    assert done.returncode == 0, done.stderr
    warnings = [line for line in done.stderr.splitlines() if "initial" in line]
    assert [any(word in line for line in warnings) for word in ("pitch", "speed through water", "roll")] == [
        True, True, False,
    ]  # fmt: skip
    first = pd.read_csv(tmp_path / "f.csv").iloc[0]
    (trim,) = glider_json("trim", *HELD)["trims"][:1]
    assert (first["depth_m"], first["roll_deg"]) == (40.0, pytest.approx(-13.0))
    assert first["pitch_deg"] == pytest.approx(trim["pitch_deg"], abs=0.05)  # settled for 1500 s, not solved
    assert first["speed_through_water_m_s"] == pytest.approx(trim["speed_m_s"], rel=1e-3)


def test_the_surface_holds_a_run_from_a_log(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    rows = ["elapsed_s,mass_position_m,mass_rotation_deg,net_buoyancy_kg"]
    rows += ["0,0.4216,0,-0.3", "100,0.4216,0,-0.3", "101,0.4216,0,0.3", "400,0.4216,0,0.3", "401,0.3816,0,-0.3"]
    rows += ["2000,0.3816,0,-0.3"]
    (tmp_path / "c.csv").write_text("\n".join(rows) + "\n")
    document = glider_json("simulate", "--controls", "c.csv")
    events = [event["name"] for event in document["events"]]
    assert events == ["start", "dive begins", "apogee", "surfacing", "end of flight"]
    assert document["duration_s"] == 2000.0
    assert document["final"]["depth_m"] == 0.0


def test_a_field_log_is_flown(glider: Run, tmp_path: Path) -> None:
    done = glider("simulate", "--controls", SEA035, "--initial", SEA035, "-o", "f.csv")
    assert done.returncode == 0, done.stderr
    for word in ("ballast volume", "own zero", "beyond the limits of seawing"):
        assert word in done.stderr
    assert pd.read_csv(tmp_path / "f.csv")["latitude_deg"].notna().all()


def test_a_mass_position_is_counted_from_the_reading_of_the_vehicle(glider: Run, tmp_path: Path) -> None:
    """A SeaExplorer's slide reads 63.5 mm where its file is level; the log's own 70 mm are then 6.5 mm forward."""
    done = glider("simulate", "--vehicle", "seaexplorer", "--controls", SEA035, "--initial", SEA035, "-o", "f.csv")
    assert done.returncode == 0, done.stderr
    assert "0 m, is taken at 0.0635 m of it" in done.stderr
    assert "no twin of that flight" not in done.stderr
    flown, log = pd.read_csv(tmp_path / "f.csv"), glider_log(tmp_path, glider)
    assert flown["mass_position_m"].max() == pytest.approx(log["mass_position_m"].max() - 0.0635, abs=1e-6)
    assert flown["mass_position_m"].min() == pytest.approx(log["mass_position_m"].min() - 0.0635, abs=1e-6)


def glider_log(folder: Path, glider: Run) -> pd.DataFrame:
    assert glider("replay", SEA035, "-o", "log.csv").returncode == 0
    return pd.read_csv(folder / "log.csv")


def test_a_trim_is_flown_on(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    text = glider("trim", *HELD, "--json").stdout
    (tmp_path / "t.json").write_text(text)
    trim = json.loads(text)["trims"][0]
    for arguments, options in ((("--trim", "t.json"), {}), (("--trim", "-"), {"input": text})):
        done = glider("simulate", *arguments, "--start-depth", "10", "--duration", "500", "--json", **options)
        assert done.returncode == 0, done.stderr
        final = json.loads(done.stdout)["final"]
        assert final["depth_m"] == pytest.approx(10.0 + 500.0 * trim["vertical_speed_m_s"], abs=1e-3)  # 1e-6 of V
        assert final["speed_through_water_m_s"] == pytest.approx(trim["speed_m_s"], abs=1e-6)
        assert final["pitch_deg"] == pytest.approx(trim["pitch_deg"], abs=1e-4)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", ("no JSON",)),
        ('{"trims": []}', ("no trim",)),
        ('{"trims": [{"speed_m_s": null}]}', ("trims[0].speed_m_s", "finite number")),
        ("[1]", ("no trim",)),
    ],
)
def test_a_bad_trim_is_one_line(glider: Run, tmp_path: Path, text: str, words: tuple[str, ...]) -> None:
    (tmp_path / "t.json").write_text(text)
    one_line_error(glider("simulate", "--trim", "t.json"), "t.json", *words)


def test_what_contradicts_is_wrong_usage(glider: Run, flown: pd.DataFrame, tmp_path: Path) -> None:
    (tmp_path / "t.json").write_text(glider("trim", *HELD, "--json").stdout)
    for arguments in (
        ("m.toml", "--controls", "flown.csv"),
        ("m.toml", *HELD),
        ("--trim", "t.json", *HELD),
        ("--trim", "t.json", "--initial", "flown.csv"),
        ("--initial", "flown.csv"),
        HELD[:2],
    ):
        one_line_error(glider("simulate", *arguments), code=2)


def test_controls_without_an_actuator(glider: Run, flown: pd.DataFrame, tmp_path: Path) -> None:
    flown[["time_utc", "depth_m", "mass_position_m", "mass_rotation_deg"]].to_csv(tmp_path / "a.csv", index=False)
    one_line_error(glider("simulate", "--controls", "a.csv"), "net_buoyancy", "--net-buoyancy")
    assert glider("simulate", "--controls", "a.csv", "--net-buoyancy", "0.3").returncode == 0
    flown[["time_utc", "depth_m"]].to_csv(tmp_path / "b.csv", index=False)
    one_line_error(glider("simulate", "--controls", "b.csv", *HELD), "b.csv", "no actuator")
    flown[["time_utc", "mass_position_m"]].to_csv(tmp_path / "d.csv", index=False)
    one_line_error(glider("simulate", *HELD, "--initial", "d.csv"), "d.csv", "depth")
    one_line_error(glider("simulate", "--controls", "none.csv"), "none.csv")


@pytest.mark.parametrize("option", ["--controls", "--initial"])
def test_what_is_flown_from_a_reconstruction_says_so(
    glider: Run, flown: pd.DataFrame, tmp_path: Path, option: str
) -> None:
    flown.assign(origin="reconstruction").to_csv(tmp_path / "remade.csv", index=False)
    more = () if option == "--controls" else ("--controls", "flown.csv")
    done = glider("simulate", option, "remade.csv", *more, "-o", "f.csv")
    assert done.stdout.startswith("SIMULATED FROM A RECONSTRUCTION: remade.csv")
    assert set(pd.read_csv(tmp_path / "f.csv")["origin"]) == {"reconstruction"}


def test_a_mission_flown_on_from_a_trim_begins_with_its_actuators(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "t.json").write_text(glider("trim", *HELD, "--json").stdout)
    assert (
        glider("simulate", "heading-hold-yoyo", "--trim", "t.json", "--start-depth", "20", "-o", "f.csv").returncode
        == 0
    )
    first = pd.read_csv(tmp_path / "f.csv").iloc[0]
    assert (first["mass_position_m"], first["net_buoyancy_kg"]) == (0.4216, 0.3)
    assert first["mass_rotation_deg"] == pytest.approx(45.0)


def test_controls_of_another_day_are_refused(glider: Run, flown: pd.DataFrame, tmp_path: Path) -> None:
    later = flown.assign(time_utc=flown["time_utc"].str.replace("2020-05", "2021-05"))
    later.to_csv(tmp_path / "later.csv", index=False)
    for controls, initial, word in (("later", "flown", "365.0 days after"), ("flown", "later", "365.0 days before")):
        done = glider("simulate", "--controls", f"{controls}.csv", "--initial", f"{initial}.csv")
        one_line_error(done, f"{controls}.csv", word, "within a day")


def test_a_depth_above_the_surface_is_told(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "i.csv").write_text("elapsed_s,depth_m,heading_deg\n0,-2,70\n1,1,70\n")
    done = glider("simulate", *HELD, "--initial", "i.csv", "--duration", "10")
    assert done.returncode == 0
    assert "initial depth of -2 m is above the surface; taken is 0 m" in done.stderr


def test_a_log_without_dates_does_not_go_with_one_that_has_them(
    glider: Run, flown: pd.DataFrame, tmp_path: Path
) -> None:
    flown.drop(columns="time_utc").to_csv(tmp_path / "undated.csv", index=False)
    for controls, initial in (("undated", "flown"), ("flown", "undated")):
        done = glider("simulate", "--controls", f"{controls}.csv", "--initial", f"{initial}.csv")
        one_line_error(done, "undated.csv", "has times since its start only", "same clock")


def test_a_battery_that_does_not_last_is_told(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "m.toml").write_text(
        'name = "m"\ndescription = "d"\n[[leg]]\nkind = "drift"\nduration_s = 2.2e7\n'
    )  # at 0.5 W 11 MJ of 10
    done = glider("simulate", "m.toml", "--every", "1e5")
    assert done.returncode == 0
    assert "needs 11 MJ, and the battery holds 10 MJ" in done.stderr
