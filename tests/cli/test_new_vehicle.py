"""The tutorial docs/howto/new-vehicle.md: its commands run as printed, from its files, and give its figures."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT, Run
from made_forces import CASE, FLOW, forces_of

from glidercli.coefficients.forces.munk import of_added_mass
from glidercli.model import parameters
from glidercli.model.hydrodynamics import rotation_body_flow
from glidercli.vehicle import load_vehicle

PAGE = ROOT / "docs" / "howto" / "new-vehicle.md"
FILES = ROOT / "docs" / "howto" / "new-vehicle"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for path in FILES.glob("*.toml"):
        shutil.copy(path, tmp_path)
    return tmp_path


def commands() -> list[list[str]]:
    return [line.split()[1:] for line in re.findall(r"^    (glider .*)$", PAGE.read_text(encoding="utf-8"), re.M)]


def test_every_command_runs_as_printed(glider: Run, folder: Path) -> None:
    for command in commands():
        if "fit" in command:
            made_up(folder)
        done = glider(*command, "--quiet")
        assert done.returncode == 0, (command, done.stderr)
    estimated, fitted = (load_vehicle(folder / f"{name}.toml").hydrodynamics for name in ("plover", "plover-cfd"))
    for name in ("drag_zero", "lift_attack", "pitch_attack", "yaw_sideslip", "yaw_rate"):
        assert getattr(fitted, name) == pytest.approx(getattr(estimated, name), rel=1e-4), (
            name
        )  # six digits are written


def made_up(folder: Path) -> None:
    """The cases with forces that plover.toml has, those of its added mass with them, as CFD would tell them."""
    vehicle = load_vehicle(folder / "plover.toml")
    cases = pd.read_csv(folder / "cases.csv")
    columns = {name: cases[name].to_numpy() for name in CASE}
    V, Omega = (
        cases[list(names)].to_numpy() for names in (("u_m_s", "v_m_s", "w_m_s"), ("p_rad_s", "q_rad_s", "r_rad_s"))
    )
    force, moment = of_added_mass(V, Omega, vehicle.added_mass)
    R = np.array(
        [rotation_body_flow(*np.radians(row)) for row in cases[["angle_of_attack_deg", "sideslip_deg"]].to_numpy()]
    )
    force, moment = (np.einsum("nji,nj->ni", R, item) for item in (force, moment))
    measured = forces_of(columns, parameters(vehicle)) + np.hstack([force * [-1.0, 1.0, -1.0], moment])
    cases[list(FLOW)] = measured
    cases.to_csv(folder / "forces.csv", index=False)


def test_its_figures(glider: Run, folder: Path) -> None:
    """Rounded as the page has them."""
    text = PAGE.read_text(encoding="utf-8")
    made = json.loads(glider("coefficients", "added-mass", "shape.toml", "--json").stdout)
    assert f"{1e3 * made['volume_m3']:.2f} dm³, {made['displaced_mass_kg']:.2f} kg" in text
    assert f"centred {-made['centre_of_buoyancy_m']:.3f} m behind the nose" in text
    for command in commands()[1:3]:
        assert glider(*command).returncode == 0
    pins = ("--net-buoyancy", "0.15", "--pitch", "-30", "--yaw-rate", "0")
    trim = json.loads(glider("trim", "--vehicle", "plover.toml", *pins, "--linearize", "--json").stdout)["trims"][0]
    assert trim["stable"]
    assert f"{trim['speed_m_s']:.3f} m/s and {trim['glide_angle_deg']:.1f}°" in text
    flown = json.loads(glider("simulate", "mission.toml", "--json").stdout)
    surfacing = next(event["time_s"] for event in flown["events"] if event["name"] == "surfacing")
    assert f"reaches {flown['max_depth_m']:.1f} m and is back after {surfacing:.0f} s" in text
    assert f"{flown['distance_m']:.0f} m along" in text


def test_the_masses_balance(folder: Path) -> None:
    mass = load_begun(folder)
    along = mass["static_mass"] * mass["static_position"][0] + mass["movable_mass"] * 0.25
    assert along == pytest.approx(0.0, abs=1.3e-3)  # the position is given to 0.1 mm, 2.6e-3 kg m
    below = mass["static_mass"] * mass["static_position"][2] + mass["movable_mass"] * mass["movable_eccentricity"]
    assert below / mass["displaced_mass"] == pytest.approx(5.5e-3, abs=5e-5)


def load_begun(folder: Path) -> dict[str, float]:
    import tomllib

    table = tomllib.loads((folder / "begun.toml").read_text(encoding="utf-8"))["mass"]
    return {key: entry["value"] for key, entry in table.items()}
