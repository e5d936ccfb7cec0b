"""The contract of ``glider trim``, from its words alone."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT, Run, one_line_error
from pyarrow import parquet

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
    one_line_error(glider("trim", *PINS, "--speed", "0.3"), "too many", "--speed", code=2)
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


WANTED = ("--speed", "0.49", "--pitch", "-35", "--turning-radius", "100")
TEN = {
    "--speed": "speed_m_s", "--angle-of-attack": "angle_of_attack_deg", "--sideslip": "sideslip_deg",
    "--yaw-rate": "yaw_rate_deg_s", "--roll": "roll_deg", "--pitch": "pitch_deg", "--mass-position": "mass_position_m",
    "--mass-rotation": "mass_rotation_deg", "--net-buoyancy": "net_buoyancy_kg", "--turning-radius": "turning_radius_m",
}  # fmt: skip


def test_controls_for_a_wanted_spiral(glider_json: Callable[..., Any]) -> None:
    first = glider_json("trim", *WANTED)["trims"][0]
    assert first["pitch_deg"] == pytest.approx(-35)
    assert first["turning_radius_m"] == pytest.approx(100)
    again = glider_json(
        "trim", "--net-buoyancy", repr(first["net_buoyancy_kg"]), "--mass-position", repr(first["mass_position_m"]),
        "--mass-rotation", repr(first["mass_rotation_deg"]),
    )["trims"][0]  # fmt: skip
    for name in TEN.values():
        assert again[name] == pytest.approx(first[name], rel=1e-9), name  # both solved to 1e-11 of the weight


@pytest.mark.parametrize("pins", list(itertools.combinations(TEN, 3))[::11])
@pytest.mark.parametrize("equations", ["full", "paper"])
def test_three_pins_pin_the_other_seven(glider_json: Callable[..., Any], pins: tuple[str, ...], equations: str) -> None:
    known = glider_json("trim", *PINS, "--equations", equations)["trims"][0]
    given = [text for pin in pins for text in (pin, repr(known[TEN[pin]]))]
    found = glider_json("trim", *given, "--equations", equations, "--quiet")["trims"]
    best = min(found, key=lambda one: abs(one["mass_rotation_deg"] - 45) + abs(one["pitch_deg"] - known["pitch_deg"]))
    for name in TEN.values():
        assert best[name] == pytest.approx(known[name], rel=1e-5), name  # some pins hold others loosely


def test_yaw_rate_0_asks_for_a_straight_glide(glider_json: Callable[..., Any]) -> None:
    for straight in (("--yaw-rate", "0"), ("--turning-radius", "inf"), ("--roll", "0")):
        trims = glider_json("trim", "--speed", "0.3", "--pitch", "-30", *straight)["trims"]
        assert all(one["turning_radius_m"] is None and one["yaw_rate_rad_s"] == 0.0 for one in trims)
        assert trims[0]["mass_rotation_deg"] == 0.0


@pytest.mark.parametrize(
    ("pins", "words"),
    [
        (("--speed", "0.3", "--pitch", "-30"), ("too few", "--yaw-rate", "complete")),
        (("--speed", "0.3", "--yaw-rate", "0", "--mass-rotation", "0"), ("dependent", "--yaw-rate", "--mass-rotation")),
        (("--angle-of-attack", "2", "--yaw-rate", "0", "--pitch", "-30"), ("dependent", "--angle-of-attack", "--pitch")),
        (("--speed", "0.3", "--yaw-rate", "0", "--mass-rotation", "45"), ("contradictory", "straight")),
        (("--speed", "0.3", "--yaw-rate", "1", "--turning-radius", "-20"), ("contradictory", "same side")),
        (("--speed", "0.3", "--yaw-rate", "1", "--turning-radius", "20"), ("contradictory", "horizontal speed")),
        ((*WANTED, "--roll", "3"), ("too many", "4")),
    ],
)  # fmt: skip
def test_pins_that_make_no_question_are_2(glider: Run, pins: tuple[str, ...], words: tuple[str, ...]) -> None:
    one_line_error(glider("trim", *pins), *words, code=2)


@pytest.mark.parametrize("name", TEN)
@pytest.mark.parametrize("value", ["nan", "1e300"])
def test_a_pin_out_of_range(glider: Run, name: str, value: str) -> None:
    others = [
        text for pin in ("--speed", "--pitch", "--turning-radius", "--roll") if pin != name for text in (pin, "0.5")
    ]
    one_line_error(glider("trim", name, value, *others[:4]), name[2:].replace("-", " "))


@pytest.mark.parametrize(
    ("pins", "words"),
    [
        (("--speed", "0.3", "--pitch", "-90", "--yaw-rate", "0"), ("vertical",)),
        (("--speed", "0.3", "--angle-of-attack", "25", "--yaw-rate", "0"), ("stalled", "18 deg")),
        (("--net-buoyancy", "0.3", "--mass-position", "0.40", "--mass-rotation", "0"), ("stalled",)),
        (("--speed", "1e-9", "--pitch", "-30", "--yaw-rate", "0"), ("speed", "0.001 to 10 m/s")),
    ],
)  # fmt: skip
def test_vertical_and_stalled_flight_are_refused(glider: Run, pins: tuple[str, ...], words: tuple[str, ...]) -> None:
    one_line_error(glider("trim", *pins), *words)


def test_failure_names_the_equation_and_the_nearest_point(glider: Run) -> None:
    done = glider("trim", "--speed", "0.49", "--pitch", "-35", "--turning-radius", "3")
    one_line_error(done, "furthest from zero", "(2", "nearest point", "net buoyancy", "mass rotation")


def test_beyond_the_fitted_range_is_warned(glider: Run) -> None:
    done = glider("trim", "--speed", "0.3", "--angle-of-attack", "14", "--yaw-rate", "0")
    assert done.returncode == 0
    assert "beyond the fitted 12 deg" in done.stderr


def test_linearize_gives_the_modes(glider: Run, glider_json: Callable[..., Any]) -> None:
    trim = glider_json("trim", *PINS, "--linearize")["trims"][0]
    assert len(trim["modes"]) == 8
    for mode in trim["modes"]:
        re, im = mode["eigenvalue"]
        size = math.hypot(re, im)
        assert mode["natural_frequency_rad_s"] == pytest.approx(size)
        assert mode["damping_ratio"] == pytest.approx(-re / size)
        assert mode["time_to_half_s"] == pytest.approx(math.log(2) / -re)
        assert mode["dominant"]
    assert trim["stable"] is all(mode["eigenvalue"][0] < 0 for mode in trim["modes"])
    assert "time to half" in glider("trim", *PINS, "--linearize").stdout
    assert "modes" not in glider_json("trim", *PINS)["trims"][0]


SWEEP = (*PINS[:4], "--sweep", "mass-rotation=0:90:5")


def test_a_sweep_is_a_table_and_a_picture(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    rows = glider_json("trim", *SWEEP)["trims"]
    assert [one["mass_rotation_deg"] for one in rows] == pytest.approx(list(range(0, 91, 5)))
    assert all(set(one) >= KEYS for one in rows)
    alone = glider_json("trim", *PINS)["trims"][0]
    for name in KEYS - {"iterations", "residual", "method"}:
        assert rows[9][name] == pytest.approx(alone[name], rel=1e-9), name
    outputs = [text for name in ("s.csv", "s.json", "s.parquet", "s.png", "s.svg", "s.pdf") for text in ("-o", name)]
    assert glider("trim", *SWEEP, *outputs).returncode == 0
    lines = (tmp_path / "s.csv").read_text().splitlines()
    assert len(lines) == 20
    assert lines[1].split(",")[lines[0].split(",").index("turning_radius_m")] == ""  # straight: no number
    table = parquet.read_table(tmp_path / "s.parquet")
    assert table["speed_m_s"].to_pylist() == [one["speed_m_s"] for one in rows]
    assert b"provenance" in table.schema.metadata
    assert json.loads((tmp_path / "s.json").read_text())["trims"] == rows
    assert (tmp_path / "s.png").read_bytes()[:4] == b"\x89PNG"


def test_two_sweeps_make_a_map(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    over = ("--sweep", "mass-rotation=0:90:30", "--sweep", "net-buoyancy=-0.2:0.4:0.2", "--mass-position", "0.4216")
    document = glider_json("trim", *over, "--quiet")
    assert document["points"] == 16
    placed = {(round(one["mass_rotation_deg"]), round(one["net_buoyancy_kg"], 3)) for one in document["trims"]}
    assert placed == {(g, mb) for g in (0, 30, 60, 90) for mb in (0.2, 0.4)}
    missing = document["missing"]
    assert len(missing) == 8
    assert {one["net_buoyancy_kg"] for one in missing} == {-0.2, 0.0}
    assert all(one["reason"] for one in missing)
    done = glider("trim", *over, "-o", "map.png")
    assert "8 of 16 points have no trim" in done.stderr
    assert (tmp_path / "map.png").stat().st_size > 10_000


def test_a_swept_name_counts_as_a_pin(glider: Run, glider_json: Callable[..., Any]) -> None:
    rows = glider_json("trim", "--speed", "0.4", "--pitch", "-30", "--sweep", "turning-radius=50:150:50")["trims"]
    assert [round(one["turning_radius_m"]) for one in rows] == [50, 100, 150]
    one_line_error(glider("trim", *PINS, "--sweep", "mass-rotation=0:90:5"), "swept", "--mass-rotation", code=2)
    one_line_error(glider("trim", *PINS, "--sweep", "roll=0:9:5"), "too many", code=2)
    one_line_error(glider("trim", "--speed", "0.4", "--sweep", "roll=0:9:5"), "too few", code=2)


@pytest.mark.parametrize(
    ("text", "words", "code"),
    [
        ("mass-rotation=90:0:1", ("reversed",), 1),
        ("mass-rotation=0:90:0", ("step of 0",), 1),
        ("mass-rotation=0:nan:1", ("finite",), 1),
        ("mass-rotation=0:90", ("START:STOP:STEP",), 2),
        ("battery=0:90:1", ("battery", "mass-rotation"), 2),
        ("mass-rotation=0:90:1e-7", ("900,000,001", "1,000,000"), 1),
    ],
)
def test_a_sweep_that_cannot_be(glider: Run, text: str, words: tuple[str, ...], code: int) -> None:
    one_line_error(glider("trim", *PINS[:4], "--sweep", text), *words, code=code)


def test_a_map_of_a_milliard_points_is_refused_with_the_count(glider: Run) -> None:
    done = glider(
        "trim", "--mass-position", "0.42", "--sweep", "mass-rotation=0:90:0.001", "--sweep", "net-buoyancy=0.1:0.5:4e-5"
    )
    one_line_error(done, "90,001 x 10,001 = 900,100,001 points", "1,000,000")


def test_one_trim_makes_no_picture(glider: Run, tmp_path: Path) -> None:
    one_line_error(glider("trim", *PINS, "-o", "t.png", "-o", "t.csv"), "t.png", "--sweep", code=2)
    assert list(tmp_path.iterdir()) == []


def test_polar_has_the_papers_best_glide(glider: Run, glider_json: Callable[..., Any], tmp_path: Path) -> None:
    document = glider_json("trim", "--polar")
    best = document["polar"]["dive"]["best_glide"]
    # NOTES section 3: best lift to drag 4.16 at +7.9 deg and -4.21 at -7.8 deg, from (20) with Table 3; the paper: 7 deg
    assert best["angle_of_attack_deg"] == pytest.approx(7.9, abs=0.05)
    assert best["lift_to_drag"] == pytest.approx(4.16, abs=0.005)
    assert document["polar"]["climb"]["best_glide"]["lift_to_drag"] == pytest.approx(-4.21, abs=0.005)
    assert set(document["trims"][0]) >= KEYS | {"made_good_m_s", "energy_per_km_j"}
    assert glider("trim", "--polar", "--net-buoyancy", "0.3", "-o", "p.png", "-o", "p.csv").returncode == 0
    one_line_error(glider("trim", "--polar", "--speed", "0.3"), "--polar", "--speed", code=2)


def test_polar_against_a_current(glider: Run, glider_json: Callable[..., Any]) -> None:
    dive = glider_json("trim", "--polar", "--current", "0.2", "--hotel-power", "1")["polar"]["dive"]
    cheapest = dive["least_energy"]
    assert cheapest["made_good_m_s"] == pytest.approx(cheapest["horizontal_speed_m_s"] - 0.2)
    power = cheapest["net_buoyancy_kg"] * 9.81 * cheapest["vertical_speed_m_s"] + 1.0
    assert cheapest["energy_per_km_j"] == pytest.approx(1000 * power / cheapest["made_good_m_s"])
    station = dive["holds_station"]
    assert station["made_good_m_s"] >= 0.0
    assert station["made_good_m_s"] == pytest.approx(0.0, abs=0.005)  # a step of the search in net buoyancy: 0.25 %
    assert station["power_w"] < cheapest["power_w"]
    strong = glider_json("trim", "--polar", "--current", "2", "--quiet")["polar"]["dive"]
    assert strong["least_energy"] is None
    assert "2 m/s" in strong["why_none"]
    one_line_error(glider("trim", *PINS, "--current", "0.2"), "--current", "--polar", code=2)
    one_line_error(glider("trim", "--polar", "--current", "nan"), "current")


@pytest.mark.parametrize(
    ("old", "new", "pins", "words"),
    [
        ("value = 440.99", "value = 0.0", WANTED, ("furthest from zero",)),  # no lift: it only sinks
        ("value = 440.99", "value = 0.0", ("--polar",), ("no straight glide",)),
        ("[-0.0814, 0.0, 0.0032]", "[-0.0814, 0.0006, 0.0032]", ("--polar",), ("to one side",)),
        ("[-0.0814, 0.0, 0.0032]", "[-0.0814, 0.0, -0.02]", PINS, ("furthest from zero",)),  # top-heavy
    ],
)
def test_odd_vehicles_are_answered_in_words(
    glider: Run, tmp_path: Path, old: str, new: str, pins: tuple[str, ...], words: tuple[str, ...]
) -> None:
    text = (ROOT / "glidercli/vehicle/data/seawing.toml").read_text()
    lines = [line if "K_L0" in line else line.replace(old, new) for line in text.splitlines()]
    assert "\n".join(lines) != text
    if new == "value = 0.0":
        lines = [line.replace("value = -0.36", "value = 0.0") for line in lines]
    (tmp_path / "odd.toml").write_text("\n".join(lines))
    one_line_error(glider("trim", "--vehicle", "odd.toml", *pins), *words)


def test_polar_of_a_vehicle_whose_lift_is_reversed(
    glider: Run, tmp_path: Path, glider_json: Callable[..., Any]
) -> None:
    text = (ROOT / "glidercli/vehicle/data/seawing.toml").read_text().replace("value = 440.99", "value = -440.99")
    (tmp_path / "odd.toml").write_text(text)
    best = glider_json("trim", "--vehicle", "odd.toml", "--polar", "--quiet")["polar"]["dive"]["best_glide"]
    assert best["angle_of_attack_deg"] < -7.0
