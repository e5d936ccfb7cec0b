"""``glider coefficients added-mass``: the contract's words, and the Seawing's terms beside Table 3's."""

import csv
import json

import pytest
from conftest import one_line_error

from glidercli.vehicle import load_vehicle

GEOMETRY = """
name = "mine"
description = "a test"
reference = "none"
[hull]
length = { value = 2.0, unit = "m" }
diameter = { value = 0.2, unit = "m" }
[surface.wing]
plane = "horizontal"
semi_span = { value = 0.5, unit = "m" }
root_chord = { value = 0.2, unit = "m" }
tip_chord = { value = 0.1, unit = "m" }
root_position = { value = 0.0, unit = "m" }
tip_position = { value = -0.2, unit = "m" }
"""


@pytest.fixture
def run(glider):
    return lambda *arguments: glider("coefficients", "added-mass", *arguments)


@pytest.fixture
def mine(tmp_path):
    path = tmp_path / "mine-shape.toml"
    path.write_text(GEOMETRY, encoding="utf-8")
    return path


def test_json_is_one_document_of_the_printed_terms(run):
    done = run("seawing", "--vehicle", "seawing", "--json")
    assert done.returncode == 0
    document = json.loads(done.stdout)
    assert document["origin"] == "estimated"
    terms = {term["name"]: term for term in document["terms"]}
    table3 = {"surge": 1.48, "sway": 49.58, "heave": 65.92, "roll": 0.53, "pitch": 7.88, "yaw": 10.18}
    assert {name: terms[name]["vehicle"] for name in table3} == table3
    assert terms["sway"]["corrected"] == pytest.approx(49.30, abs=0.01)  # Lamb's k2 of the printed ellipsoid
    assert terms["sway"]["strips"] == pytest.approx(51.69, abs=0.01)  # rho V
    assert document["left_for_surfaces"]["accounted"]["tail_distance"] == pytest.approx(1.168, abs=1e-3)


def test_text_says_estimated_first(run):
    done = run("seawing")
    assert done.returncode == 0
    assert done.stdout.startswith("ESTIMATED")


def test_outputs_carry_where_they_come_from(run, mine, tmp_path):
    names = ["v.toml", "t.csv", "t.json", "t.parquet", "p.png", "p.svg", "p.pdf"]
    done = run(mine, "--vehicle", "seawing", *[item for name in names for item in ("-o", name)])
    assert done.returncode == 0, done.stderr
    warning, *wrote = done.stderr.splitlines()
    assert "K_M and K_MY stay those of seawing" in warning  # they belong to another added mass
    assert [line.removeprefix("wrote ") for line in wrote] == names
    rows = list(csv.DictReader((tmp_path / "t.csv").read_text().splitlines()))
    assert [row["symbol"] for row in rows][:3] == ["X_u'", "Y_v'", "Z_w'"]
    for row in rows:
        assert float(row["corrected"]) == pytest.approx(float(row["hull_corrected"]) + float(row["wing_corrected"]))
    record = json.loads((tmp_path / "t.csv-metadata.json").read_text())
    assert record["origin"] == "estimated"
    assert [item["path"].rsplit("/", 1)[-1] for item in record["inputs"]] == ["mine-shape.toml", "seawing.toml"]
    vehicle = load_vehicle(tmp_path / "v.toml")
    assert vehicle.name == "v"
    assert vehicle.hull.length == 2.0
    assert vehicle.added_mass.mass[2] == pytest.approx(float(rows[2]["corrected"]), rel=1e-5)
    assert vehicle.hydrodynamics == load_vehicle("seawing").hydrodynamics
    assert "ESTIMATED" in (tmp_path / "p.svg").read_text()


def test_plain_strips_go_to_the_vehicle_where_asked(run, mine, tmp_path):
    done = run(mine, "--vehicle", "seawing", "--plain-strips", "-o", "v.toml", "-o", "t.csv")
    assert done.returncode == 0
    heave = float(list(csv.DictReader((tmp_path / "t.csv").read_text().splitlines()))[2]["strips"])
    assert load_vehicle(tmp_path / "v.toml").added_mass.mass[2] == pytest.approx(heave, rel=1e-5)


def test_a_vehicle_from_nothing_says_what_it_lacks(run, mine, tmp_path):
    done = run(mine, "-o", "new.toml")
    assert done.returncode == 0
    assert "new.toml is no whole vehicle yet; it lacks description, reference, mass, actuators" in done.stderr


def test_csv_on_stdout(run, mine):
    done = run(mine, "-o", "-")
    assert done.returncode == 0
    assert done.stdout.startswith("symbol,unit,strips,hull_strips,wing_strips,corrected,")


def test_failures_are_one_line_and_leave_nothing(run, mine, tmp_path):
    one_line_error(run("squid"), "shipped are")
    one_line_error(run(tmp_path / "none.toml"), "no such file")
    one_line_error(run(mine, "-o", "a.txt"), "unknown output .txt; allowed: .toml .json .csv .parquet .png")
    (tmp_path / "there.csv").write_text("old")
    one_line_error(run(mine, "-o", "there.csv"), "exists; --force replaces it")
    one_line_error(run(mine, "-o", mine, "--force"), "is an input")
    bad = tmp_path / "bad.toml"
    bad.write_text(GEOMETRY.replace("0.2, unit", "9, unit"))
    one_line_error(run(bad, "-o", "new.csv", "-o", "new.toml"), "bad.toml")
    assert not list(tmp_path.glob("new*"))
    one_line_error(run(mine, "--json", "-o", "-"), code=2)


def test_a_base_that_cannot_be_is_named(run, mine, tmp_path):
    base = tmp_path / "base.toml"
    base.write_text('added_mass = "heavy"\n')
    one_line_error(run(mine, "--vehicle", base), "base.toml: added_mass")


def test_shipped_geometries_are_listed(glider, glider_json):
    names = [line.split("  ")[0] for line in glider("coefficients", "geometries").stdout.splitlines()]
    assert "seawing" in names
    assert [item["name"] for item in glider_json("coefficients", "geometries")["geometries"]] == names
