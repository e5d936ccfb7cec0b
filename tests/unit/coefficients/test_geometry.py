"""A geometry file is checked whole: what crosses itself, has no volume or no unit is named."""

import numpy as np
import pytest

from glidercli.coefficients.added.added_mass import added_mass
from glidercli.coefficients.shape.geometry import load_geometry, shipped_geometries
from glidercli.errors import InputError

HEAD = 'name = "mine"\ndescription = "a test"\nreference = "none"\n'
ELLIPSOID = '[hull]\nlength = { value = 2.0, unit = "m" }\ndiameter = { value = 0.2, unit = "m" }\n'


def surface(name="wing", plane="horizontal", tip=0.5, root_chord=0.2, tip_chord=0.1, root=0.1, tip_at=0.0, more=""):
    return (
        f'[surface.{name}]\nplane = "{plane}"\nsemi_span = {{ value = {tip}, unit = "m" }}\n'
        f'root_chord = {{ value = {root_chord}, unit = "m" }}\ntip_chord = {{ value = {tip_chord}, unit = "m" }}\n'
        f'root_position = {{ value = {root}, unit = "m" }}\ntip_position = {{ value = {tip_at}, unit = "m" }}\n{more}'
    )


def outline(stations, radii):
    return f'[hull]\nstations = {{ value = {stations}, unit = "m" }}\nradii = {{ value = {radii}, unit = "m" }}\n'


def load(tmp_path, text):
    path = tmp_path / "mine.toml"
    path.write_text(HEAD + text, encoding="utf-8")
    return load_geometry(path)[0]


BAD = [
    (ELLIPSOID.replace("2.0", "0.1"), r"hull\.length = 0\.1 m, allowed: more than its diameter, 0\.2 m"),
    (ELLIPSOID.replace("0.2", "0.0"), r"hull\.diameter = 0\.0 m, allowed 0\.01\.\.5 m"),
    (ELLIPSOID.replace(', unit = "m" }\nd', " }\nd"), r"hull\.length has no unit; m is needed"),
    (ELLIPSOID.replace('"m" }\nd', '"cm" }\nd'), r"hull\.length has unit 'cm', needed is 'm'"),
    (ELLIPSOID.replace("diameter", "width"), r"hull\.width is unknown; known here: length, diameter, nose"),
    ('[hull]\nlength = { value = 2.0, unit = "m" }\n', r"needed are length and diameter of an ellipsoid, or stations and"),
    (outline([1.0, 0.2, 0.5, -1.0], [0.0, 0.1, 0.1, 0.0]), r"station 3 at 0\.5 m does not lie behind station 2 at 0\.2 m: the outline crosses itself"),
    (outline([1.0, 0.0, -1.0], [0.0, -0.1, 0.0]), r"hull\.radii = \[0\.0, -0\.1, 0\.0\] m, allowed a list of numbers, each 0\.\.5 m"),
    (outline([1.0, 0.0, -1.0], [0.0, 0.1]), r"3 stations and 2 radii"),
    (outline([1.0, -1.0], [0.1, 0.1]), r"2 given, at least 3 are needed"),
    (outline([0.1, 0.0, -0.1], [0.0, 0.2, 0.0]), r"hull is 0\.2 m long and 0\.4 m thick; allowed: longer than thick"),
    (ELLIPSOID + surface(tip=0.05), r"surface\.wing does not stick out of the hull: its tip is 0\.05 m from the axis, the hull's radius there 0\.0"),
    (ELLIPSOID + surface(root_chord=-0.2), r"surface\.wing\.root_chord = -0\.2 m, allowed 0\.005\.\.5 m"),
    (ELLIPSOID + surface(plane="diagonal"), r"surface\.wing\.plane = 'diagonal': Input should be 'horizontal' or 'vertical'"),
    (ELLIPSOID + surface(more='sides = "upper"\n'), r"surface\.wing: sides = 'upper', allowed 'both' in the horizontal plane"),
    (ELLIPSOID + surface(more='root_offset = { value = 0.5, unit = "m" }\n'), r"surface\.wing: root_offset = 0\.5 m, allowed: less than semi_span = 0\.5 m"),
    (ELLIPSOID + surface() + surface("tail", root=0.0, tip_at=-0.05), r"surface\.wing and surface\.tail cross each other in the horizontal plane"),
    (ELLIPSOID + "[surface.wing]\n", r"surface\.wing\.plane is missing"),
    ("", r"hull is missing"),
    (outline([1.0, 0.0, -1.0], [0.0, 0.0, 0.0]), r"hull has no volume: its largest radius is 0 m, allowed: 0\.0001 m or more"),
    (outline([1.0, 0.0, -1.0], [0.0, 1e-9, 0.0]), r"hull has no volume: its largest radius is 1e-09 m"),
    (outline([1.0, 0.5, 0.0, -1.0], [0.0, 0.1, 0.0, 0.1]), r"radius 3 is 0 m between nose and tail: the hull falls in two"),
    (outline([1.0, 0.5, 0.0, -1.0], [0.0, 0.1, 1e-9, 0.1]), r"radius 3 is 1e-09 m between nose and tail: the hull falls in two"),
    (ELLIPSOID + surface("hull"), r"surface\.hull: the name stands for another part; hull, further, Munk are taken"),
    ('centre_of_buoyancy = { value = 5.0, unit = "m" }\n' + ELLIPSOID, r"centre_of_buoyancy = 5 m, allowed: in the hull, -1\.\.1 m"),
    ("hull = 3\n", r"hull = 3 is no table; write \[hull\]"),
    ("surface = 3\n" + ELLIPSOID, r"surface = 3 is no table; write \[surface\]"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "told"), BAD)
def test_what_is_wrong_is_named(tmp_path, text, told):
    with pytest.raises(InputError, match=told) as caught:
        load(tmp_path, text)
    assert "\n" not in str(caught.value)
    assert str(tmp_path / "mine.toml") in str(caught.value)


def test_all_faults_at_once(tmp_path):
    with pytest.raises(InputError, match=r"2 faults: .*diameter.*tip_chord"):
        load(tmp_path, ELLIPSOID.replace("0.2", "9.0") + surface(tip_chord=-1))


def test_surfaces_that_do_not_touch_are_two(tmp_path):
    text = ELLIPSOID + surface() + surface("tail", root=-0.7, tip_at=-0.75) + surface("fin", "vertical")
    text += surface("keel", "vertical", root=0.5, tip_at=0.5, more='sides = "lower"\n')
    assert set(load(tmp_path, text).surface) == {"wing", "tail", "fin", "keel"}


def test_no_such_geometry_and_no_such_file(tmp_path):
    with pytest.raises(InputError, match=r"squid: is no geometry; shipped are .*seawing"):
        load_geometry("squid")
    with pytest.raises(InputError, match="no such file"):
        load_geometry(tmp_path / "missing.toml")


@pytest.mark.parametrize("name", sorted(shipped_geometries()))
def test_shipped_geometries(name):
    shape, path = load_geometry(name)
    assert shape.name == name == path.stem
    assert 1.0 < shape.hull.length_overall < 5.0
    assert added_mass(shape).total().heave > 0.0


def test_centre_of_buoyancy_is_that_of_the_volume(tmp_path):
    """A wing 10 % thick on an ellipsoid: volumes and moments summed over 10,000 strips of it."""
    shape = load(tmp_path, ELLIPSOID + surface(root=-0.4, tip_at=-0.5))
    s = np.linspace(0.0, 0.5, 10_001)
    chord, lead = 0.2 - 0.2 * s, -0.4 - 0.2 * s
    x = lead - chord / 2.0
    area = np.where(s >= shape.hull.radius(x), 0.685 * 0.1 * chord**2, 0.0)
    volume = 2.0 * np.trapezoid(area, s)
    hull = np.pi / 6.0 * 2.0 * 0.2**2
    found = added_mass(shape)
    assert found.volume == pytest.approx(hull + volume, rel=1e-5)  # of 10,001 strips
    assert found.origin == pytest.approx(2.0 * np.trapezoid(area * x, s) / (hull + volume), rel=2e-4)


def test_hull_from_its_nose(tmp_path):
    text = '[hull]\nlength = { value = 2.0, unit = "m" }\ndiameter = { value = 0.2, unit = "m" }\nnose = { value = 0.0, unit = "m" }\n'
    assert added_mass(load(tmp_path, text)).origin == pytest.approx(-1.0, abs=1e-9)


def test_a_mark_of_utf8_at_the_start_is_no_fault(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("\ufeff" + HEAD + ELLIPSOID, encoding="utf-8")
    assert load_geometry(path)[0].hull.length == 2.0
