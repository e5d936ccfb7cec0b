"""Vehicle files: every fault at once, with file, key, value and allowed range."""

from __future__ import annotations

from pathlib import Path

import pytest
from conftest import ROOT

from glidercli.errors import InputError
from glidercli.vehicle import load_vehicle

TEXT = (ROOT / "glidercli/vehicle/data/seawing.toml").read_text()


def faults(tmp_path: Path, *changes: tuple[str, str]) -> str:
    text = TEXT
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    path = tmp_path / "v.toml"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        load_vehicle(path)
    return str(caught.value)


def test_all_faults_together(tmp_path: Path) -> None:
    message = faults(
        tmp_path,
        ("static_mass = { value = 54.28", "static_mass = { value = 0"),
        ('drag_zero = { value = 7.19, unit = "kg/m"', 'drag_zero = { value = 7.19, unit = "N"'),
        ("[hull]", "[hull]\nwidth = 3"),
        ("yaw_rate = { value = -389.30", "yaw_rat = { value = -389.30"),
    )
    assert message.startswith(f"{tmp_path / 'v.toml'}: 5 faults: ")
    for part in (
        "mass.static_mass = 0 kg, allowed 0.01..100000 kg",
        "hydrodynamics.drag_zero has unit 'N', needed is 'kg/m'",
        "hull.width is unknown",
        "hydrodynamics.yaw_rate is missing, allowed",
        "hydrodynamics.yaw_rat is unknown",
    ):
        assert part in message
    assert "\n" not in message


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("{ value = 54.28,", "{ value = nan,", "mass.static_mass = nan, allowed"),
        ("{ value = 54.28,", "{ value = true,", "mass.static_mass = True, allowed"),
        ("{ value = 54.28,", '{ value = "54",', "mass.static_mass = '54', allowed"),
        ("value = [0.60, 15.27, 15.32]", "value = [0.60, 15.27]", "3 numbers"),
        ("value = [0.02, 0.16, 0.17]", "value = [0.02, 10.16, 0.17]", "no moment above the sum of the other two"),
        ("displaced_mass = { value = 65.28", "displaced_mass = { value = 70.0", "static_mass + movable_mass"),
        ("minimum = { value = 0.3516", "minimum = { value = 0.44", "must not decrease"),
        ("roll_rate = { value = -19.83", "roll_rate = { value = 19.83", "hydrodynamics.roll_rate = 19.83"),
        ('length = { value = 1.99, unit = "m"', "length = { value = 1.99", "hull.length has no unit"),
        ('symbol = "L_glider"', 'sybmol = "L_glider"', "hull.length has unknown key sybmol"),
    ],
)
def test_each_fault_is_named(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert words in faults(tmp_path, (old, new))


def test_a_bare_number_is_asked_for_its_unit(tmp_path: Path) -> None:
    path = tmp_path / "v.toml"
    path.write_text("[hull]\nlength = 2.0\n")
    with pytest.raises(InputError, match=r"hull\.length = 2\.0 has no unit; write"):
        load_vehicle(path)


def test_files_that_are_none(tmp_path: Path) -> None:
    (tmp_path / "b.toml").write_bytes(b"\xff\xfe\x00")
    (tmp_path / "e.toml").write_bytes(b"")
    (tmp_path / "n.toml").write_text("a = ")
    for name, words in (("b.toml", "text"), ("e.toml", "empty"), ("n.toml", "TOML"), ("x.toml", "no such file")):
        with pytest.raises(InputError, match=words):
            load_vehicle(tmp_path / name)
