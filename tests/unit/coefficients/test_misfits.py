"""Mixed units in a column of forces are named by line; scatter, zeros and a lone wild row are not taken for them."""

import numpy as np
import pytest
from made_forces import FLOW, SIZE, forces_of, table_2, write

from glidercli.coefficients import fit
from glidercli.coefficients.forces.misfits import misfits
from glidercli.errors import InputError
from glidercli.model import parameters
from glidercli.vehicle import load_vehicle

ANGLES = np.radians(np.arange(-12.0, 13.0))
LINE = np.stack([np.ones(25), ANGLES], axis=1)
PARABOLA = np.stack([np.ones(25), ANGLES**2], axis=1)


def made(seed=1):
    columns = table_2()
    forces = forces_of(columns, parameters(load_vehicle("seawing")))
    return columns, forces + np.random.default_rng(seed).normal(size=forces.shape) * 0.01 * SIZE


def test_scatter_is_no_misfit():
    """200 tables of 5 % noise on lines and parabolas: not a row."""
    random = np.random.default_rng(7)
    for _ in range(100):
        for X, x in ((LINE, (-0.02, 29.0)), (PARABOLA, (0.47, 25.5))):
            y = X @ x
            assert misfits(X, y + 0.05 * np.abs(y).max() * random.normal(size=25)) == ({}, [])


@pytest.mark.parametrize(
    ("factor", "told"), [(1000.0, "thousandths"), (1e-3, "thousands"), (1 / 9.80665, "kilograms-force among")]
)
def test_rows_in_another_unit(factor, told):
    y = PARABOLA @ (0.47, 25.5)
    y[[3, 8, 20]] *= factor
    found = misfits(PARABOLA, y)
    assert set(found.other_unit) == {3, 8, 20}
    assert all(told in text for text in found.other_unit.values())


def test_a_wild_row_is_far_off_and_no_other_unit():
    y = LINE @ (-0.02, 29.0)
    y[4] *= 15.0
    assert misfits(LINE, y) == ({}, [4])


@pytest.mark.parametrize("name", FLOW)
def test_a_column_of_two_units_is_refused(tmp_path, name):
    """Every eighth row in thousandths; the lines that are named are among them (rows near zero cannot be told)."""
    columns, forces = made()
    column = list(FLOW).index(name)
    forces[::8, column] *= 1000.0
    with pytest.raises(
        InputError, match=rf"lines? .*: {name}, as if in thousandths of the unit; one unit is allowed"
    ) as caught:
        fit(write(tmp_path / "forces.csv", columns, forces))
    lines = str(caught.value).split("lines ")[1].split(":")[0].split(" and ")[0]
    assert all((int(line) - 2) % 8 == 0 for line in lines.split(", "))


def test_turning_cases_in_another_unit_than_straight_ones(tmp_path):
    columns, forces = made()
    forces[np.asarray(columns["set"]) == "about-p2", 4] *= 1000.0
    with pytest.raises(
        InputError, match=r"pitch_moment_N_m: the largest of the cases turning about p2 is 1\.\d+e\+03 times"
    ):
        fit(write(tmp_path / "forces.csv", columns, forces))


def test_a_wild_row_is_named_and_fitted(tmp_path):
    columns, forces = made()
    forces[5, 0] *= 15.0
    found = fit(write(tmp_path / "forces.csv", columns, forces))
    assert any("line 7: D is far from what the other cases tell (drag)" in text for text in found.warnings)


def test_a_whole_table_in_another_unit_is_told_beside_a_vehicle(tmp_path):
    columns, forces = made()
    found = fit(write(tmp_path / "forces.csv", columns, 1000.0 * forces), vehicle="seawing")
    assert any("times the vehicle's: KD0" in text and "other units" in text for text in found.warnings)


def test_no_drag_at_all_is_refused(tmp_path):
    columns, forces = made()
    forces[:, 0] = 0.0
    with pytest.raises(InputError, match="drag_N: every value is 0"):
        fit(write(tmp_path / "forces.csv", columns, forces))


@pytest.mark.parametrize(
    ("row", "said", "told"), [(3, "strait", "allowed: straight"), (60, "straight", "it is about-p3")]
)
def test_a_set_that_contradicts_the_rates(tmp_path, row, said, told):
    columns, forces = made()
    del columns["turning_radius_m"]
    columns["set"] = np.array(columns["set"], dtype=object)
    columns["set"][row] = said
    with pytest.raises(InputError, match=rf"line {row + 2}: set = {said}, .*{told}"):
        fit(write(tmp_path / "forces.csv", columns, forces))
