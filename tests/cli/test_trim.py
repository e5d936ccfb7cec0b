"""The contract of ``glider trim``, from its words alone."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import Run, one_line_error

PINS = ("--net-buoyancy", "0.3", "--mass-position", "0.4216", "--mass-rotation", "45")
KEYS = {
    "speed_m_s", "angle_of_attack_deg", "sideslip_deg", "yaw_rate_rad_s", "yaw_rate_deg_s", "roll_deg", "pitch_deg",
    "mass_position_m", "mass_rotation_deg", "net_buoyancy_kg", "turning_radius_m", "vertical_speed_m_s",
    "horizontal_speed_m_s", "glide_angle_deg", "lift_to_drag", "residual", "iterations", "method", "stable",
    "within_limits",
}  # fmt: skip


def test_json_is_a_list_of_trims_with_every_key(glider_json: Callable[..., Any]) -> None:
    document = glider_json("trim", *PINS)
    assert list(document) == ["trims"]
    assert set(document["trims"][0]) >= KEYS


def test_starboard_turn_is_positive_and_port_negative(glider_json: Callable[..., Any]) -> None:
    starboard = glider_json("trim", *PINS)["trims"][0]
    port = glider_json("trim", *PINS[:-1], "-45")["trims"][0]
    assert starboard["turning_radius_m"] > 0
    assert starboard["yaw_rate_deg_s"] > 0
    assert port["turning_radius_m"] < 0
    assert port["yaw_rate_deg_s"] < 0


def test_a_straight_glide_has_null_radius(glider_json: Callable[..., Any]) -> None:
    straight = glider_json("trim", *PINS[:-1], "0")["trims"][0]
    assert straight["turning_radius_m"] is None
    assert straight["yaw_rate_rad_s"] == 0.0
    assert straight["roll_deg"] == 0.0


def test_within_limits_is_said(glider_json: Callable[..., Any]) -> None:
    assert glider_json("trim", *PINS)["trims"][0]["within_limits"] is True
    beyond = glider_json("trim", "--net-buoyancy", "0.6", *PINS[2:], "--quiet")["trims"][0]
    assert beyond["within_limits"] is False


def test_too_few_pins_is_2_and_says_what_completes_them(glider: Run) -> None:
    one_line_error(glider("trim", *PINS[:4]), "--mass-rotation", code=2)


@pytest.mark.parametrize("value", ["nan", "inf", "-inf"])
def test_a_control_that_is_not_finite(glider: Run, value: str) -> None:
    one_line_error(glider("trim", "--net-buoyancy", value, *PINS[2:]), "net buoyancy", value, "finite")


def test_neutral_buoyancy_has_no_trim(glider: Run) -> None:
    one_line_error(glider("trim", "--net-buoyancy", "0", *PINS[2:]), "neutral")


def test_missing_vehicle_file(glider: Run) -> None:
    one_line_error(glider("trim", *PINS, "--vehicle", "none.toml"), "none.toml", "no such file")


def test_unknown_vehicle_names_the_shipped_ones(glider: Run) -> None:
    one_line_error(glider("trim", *PINS, "--vehicle", "nautilus"), "nautilus", "seawing")


def test_outputs_whole_with_provenance_and_only_forced_over(glider: Run, tmp_path: Path) -> None:
    assert glider("trim", *PINS, "-o", "t.csv", "-o", "t.json").returncode == 0
    assert (tmp_path / "t.csv").read_text().splitlines()[0].startswith("speed_m_s,")
    beside = json.loads((tmp_path / "t.csv-metadata.json").read_text())
    inside = json.loads((tmp_path / "t.json").read_text())["provenance"]
    for record in (beside, inside):
        assert record["program"].startswith("glidercli ")
        assert "trim" in record["command"]
    one_line_error(glider("trim", *PINS, "-o", "t.csv"), "t.csv", "--force")
    assert glider("trim", *PINS, "-o", "t.csv", "--force").returncode == 0


def test_unknown_output_suffix(glider: Run, tmp_path: Path) -> None:
    one_line_error(glider("trim", *PINS, "-o", "t.xyz"), "t.xyz", ".csv")
    assert list(tmp_path.iterdir()) == []


def test_an_upside_down_solution_is_no_answer(glider: Run) -> None:
    """The mass far aft of a sinking vehicle: the one equilibrium has the hull past the vertical."""
    one_line_error(
        glider("trim", "--net-buoyancy", "0.3", "--mass-position", "0.3", "--mass-rotation", "0"), "no steady"
    )


def test_more_net_buoyancy_than_mass_is_refused(glider: Run) -> None:
    one_line_error(glider("trim", "--net-buoyancy", "1e6", *PINS[2:]), "net buoyancy", "65.28 kg")


@pytest.mark.parametrize(("buoyancy", "position", "needed"), [("0.3", "0.15", "forward"), ("-0.3", "0.6", "aft")])
def test_a_mass_on_the_wrong_side_is_explained(glider: Run, buoyancy: str, position: str, needed: str) -> None:
    done = glider("trim", "--net-buoyancy", buoyancy, "--mass-position", position, "--mass-rotation", "0")
    one_line_error(done, f"needs the mass {needed} of 0.4016 m")
