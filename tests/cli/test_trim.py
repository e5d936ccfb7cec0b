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


FLOW = ("--method", "recursion", "--speed", "0.49", "--angle-of-attack", "1.2671", "--sideslip", "-1.2831")


def test_recursion_lists_every_solution_the_wanted_one_first(glider_json: Callable[..., Any]) -> None:
    trims = glider_json("trim", *FLOW)["trims"]
    assert all(set(one) >= KEYS and one["method"] == "recursion" for one in trims)
    assert len(trims) > 1
    first = trims[0]
    # Fig. 9 prints these; from V, alpha and beta to the printed digits the controls come out to 1 %
    assert first["mass_rotation_deg"] == pytest.approx(45.0, rel=0.01)
    assert first["mass_position_m"] == pytest.approx(0.4216, rel=0.01)
    assert first["net_buoyancy_kg"] == pytest.approx(0.3, rel=0.01)
    assert first["within_limits"] is True
    assert first["stable"] is True
    order = [(not one["within_limits"], not one["stable"]) for one in trims]
    assert order == sorted(order)


def test_trace_prints_the_iterates(glider: Run, glider_json: Callable[..., Any]) -> None:
    document = glider_json("trim", *FLOW, "--trace")
    assert set(document) == {"trims", "trace"}
    last = document["trace"][0]["iterates"][-1]
    assert last["mass_rotation_deg"] == pytest.approx(document["trims"][0]["mass_rotation_deg"], abs=1e-9)
    text = glider("trim", *FLOW, "--trace").stdout
    assert sum(len(one["iterates"]) for one in document["trace"]) == sum(
        line[:4].strip().isdigit() for line in text.splitlines()
    )


def test_recursion_implies_the_papers_equations(glider: Run, glider_json: Callable[..., Any]) -> None:
    assert glider_json("trim", *FLOW)["trims"][0]["equations"] == "paper"
    one_line_error(glider("trim", *FLOW, "--equations", "full"), "recursion", "full", code=2)


def test_pins_of_another_method_are_2(glider: Run) -> None:
    one_line_error(glider("trim", *FLOW, "--net-buoyancy", "0.3"), "--net-buoyancy", code=2)
    one_line_error(glider("trim", *PINS, "--speed", "0.3"), "--speed", code=2)
    one_line_error(glider("trim", *PINS, "--trace"), "--trace", "recursion", code=2)
    one_line_error(glider("trim", *FLOW[:-2]), "--sideslip", code=2)


@pytest.mark.parametrize(("name", "value"), [("--speed", "0"), ("--speed", "nan"), ("--sideslip", "90")])
def test_an_impossible_flow(glider: Run, name: str, value: str) -> None:
    one_line_error(glider("trim", *FLOW, name, value), name[2:])


def test_a_flow_that_no_mass_can_hold(glider: Run) -> None:
    one_line_error(glider("trim", *FLOW[:-1], "40"), "furthest from zero", "roll moment (29)")


def test_the_printed_recursion_says_that_it_fails(glider: Run) -> None:
    one_line_error(
        glider("trim", "--method", "recursion-printed", *FLOW[2:]), "furthest from zero", "--method recursion"
    )
