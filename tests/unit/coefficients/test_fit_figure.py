"""The picture of a fit shows what the table has: every case, every residual, and no panel without data."""

import numpy as np
from made_forces import FLOW, forces_of, table_2, write

from glidercli.coefficients.forces.figure import figure
from glidercli.coefficients.forces.result import fit


def titles(drawing):
    return [axes.get_title(loc="left")[4:] for axes in drawing.axes if axes.get_title(loc="left")]


def test_the_nine_panels_of_fig_8(tmp_path, p):
    columns = table_2()
    drawing = figure(fit(write(tmp_path / "f.csv", columns, forces_of(columns, p))))
    assert titles(drawing) == [
        "lift over drag", "drag", "lift", "pitch moment, straight", "pitch moment, turning", "side force", "yaw moment",
        "roll moment", "roll moment",
    ]  # fmt: skip
    yaw = next(axes for axes in drawing.axes if axes.get_title(loc="left").endswith("yaw moment"))
    dots = [line for line in yaw.lines if line.get_marker() == "."]
    assert sum(len(line.get_xdata()) for line in dots) == 50
    assert not any("hollow" in text.get_text() for text in drawing.texts)


def test_nose_down_is_told_apart(tmp_path, p):
    columns = table_2()
    down = columns["set"] == "about-p2"
    more = {name: np.concatenate([column, column[down]]) for name, column in columns.items()}
    for name in ("p_rad_s", "q_rad_s", "r_rad_s", "turning_radius_m"):
        more[name][149:] *= -1.0
    drawing = figure(fit(write(tmp_path / "f.csv", more, forces_of(more, p))))
    assert any("hollow: turning nose down" in text.get_text() for text in drawing.texts)
    roll = next(axes for axes in drawing.axes if axes.get_title(loc="left") == "(h) roll moment")
    hollow = [line for line in roll.lines if line.get_markerfacecolor() == "white"]
    assert sum(len(line.get_xdata()) for line in hollow) == 50


def test_a_table_of_drag_alone_makes_one_panel(tmp_path, p):
    columns = table_2()
    path = write(tmp_path / "f.csv", columns, forces_of(columns, p)[:, :1], FLOW[:1])
    assert titles(figure(fit(path, partial=True))) == ["drag"]
