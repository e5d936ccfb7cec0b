"""New numbers get into a copy of a vehicle file, and the copy is the vehicle that it says."""

import dataclasses

import pytest

from glidercli.errors import InputError
from glidercli.vehicle import load_vehicle, shipped_vehicles
from glidercli.vehicle.writing import Number, revised

SEAWING = shipped_vehicles()["seawing"]


def written(tmp_path, text):
    path = tmp_path / "new.toml"
    path.write_text(text, encoding="utf-8")
    return load_vehicle(path)


def test_a_new_number_is_the_only_change(tmp_path):
    text, missing = revised(
        SEAWING,
        {
            "hydrodynamics": {"drag_zero": Number(8.0, "a test"), "fitted_angle": Number(0.25, "a test", "alpha")},
            "added_mass": {"mass": Number((1.0, 2.0, 3.0), "a test")},
        },
        name="new",
        changed="two numbers",
    )
    assert missing == []
    new, old = written(tmp_path, text), load_vehicle("seawing")
    assert new.name == "new"
    assert new.hydrodynamics.drag_zero == 8.0
    assert new.hydrodynamics.fitted_angle == pytest.approx(0.25, rel=1e-5)  # six digits are written
    assert new.added_mass.mass == (1.0, 2.0, 3.0)
    assert new.description == f"{old.description}; two numbers"
    same = dataclasses.replace(
        new, name=old.name, description=old.description, hydrodynamics=old.hydrodynamics, added_mass=old.added_mass
    )
    assert same == old
    assert "worked example" in text  # comments stay


def test_what_a_file_still_lacks_is_named(tmp_path):
    base = tmp_path / "begun.toml"
    base.write_text('name = "mine"\ndescription = "begun"\nreference = "none"\n', encoding="utf-8")
    text, missing = revised(
        base, {"added_mass": {"mass": Number((1.0, 2.0, 3.0), "a test")}}, name="other", changed="a test"
    )
    assert 'name = "mine"' in text
    assert {"hull", "mass", "actuators", "hydrodynamics", "ballast", "added_mass.inertia"} <= set(missing)


def test_a_number_that_no_vehicle_can_have_is_refused():
    with pytest.raises(InputError, match=r"hydrodynamics\.roll_rate = 2\.0 kg s/rad, allowed -1e\+06\.\.0"):
        revised(SEAWING, {"hydrodynamics": {"roll_rate": Number(2.0, "a test")}}, name="new", changed="a test")


def test_a_table_that_is_none_is_refused(tmp_path):
    base = tmp_path / "odd.toml"
    base.write_text("added_mass = 3\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"added_mass = 3 is no table"):
        revised(base, {"added_mass": {"mass": Number((1.0, 2.0, 3.0), "a test")}}, name="new", changed="a test")
