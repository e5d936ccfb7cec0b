"""Tables of forces that cannot be used: one line that says what, where, and what is allowed."""

import numpy as np
import pytest
from made_forces import BODY, FLOW, forces_of, in_body, table_2, write

from glidercli.coefficients.forces.result import fit
from glidercli.coefficients.forces.table import read_forces
from glidercli.errors import InputError, UsageError


@pytest.fixture(scope="module")
def columns():
    return table_2()


@pytest.fixture
def lines(tmp_path, columns, p):
    """A good table as lines of text."""
    return write(tmp_path / "good.csv", columns, forces_of(columns, p)).read_text().splitlines()


def saved(tmp_path, lines, end="\n", encoding="utf-8"):
    path = tmp_path / "bad.csv"
    path.write_bytes((end.join(lines) + end).encode(encoding))
    return path


def cell(lines, number, name, text):
    """The table with one cell replaced; number : of the line."""
    at = lines[0].split(",").index(name)
    row = lines[number - 1].split(",")
    row[at] = text
    return [*lines[: number - 1], ",".join(row), *lines[number:]]


def renamed(lines, old, new):
    return [",".join(new if name == old else name for name in lines[0].split(",")), *lines[1:]]


def without(lines, *names):
    keep = [i for i, name in enumerate(lines[0].split(",")) if name not in names]
    return [",".join(row.split(",")[i] for i in keep) for row in lines]


def rows_where(lines, keep):
    head = lines[0].split(",")
    return [lines[0], *(row for row in lines[1:] if keep(dict(zip(head, row.split(","), strict=True))))]


@pytest.mark.parametrize(
    ("end", "encoding", "mark"),
    [
        ("\r\n", "utf-8", ","),
        ("\n", "utf-8-sig", ","),
        ("\n", "utf-8", ";"),
        ("\n", "utf-8", "\t"),
        ("\r", "utf-8", ","),
    ],
)
def test_what_spreadsheets_write_is_read(tmp_path, lines, p, end, encoding, mark):
    result = fit(saved(tmp_path, [line.replace(",", mark) for line in lines], end, encoding))
    assert result.used == 149


@pytest.mark.parametrize("text", ["text", "1,5", "0x10", "1_0", "--", "inf", "-inf", "1e9", "True"])
@pytest.mark.parametrize("name", ["angle_of_attack_deg", "lift_N", "p_rad_s", "density_kg_m3", "speed_m_s"])
def test_a_cell_that_is_no_number_names_its_line(tmp_path, lines, name, text):
    body = [line.replace(",", ";").replace("CELL", text) for line in cell(lines, 7, name, "CELL")]
    with pytest.raises(InputError, match=rf"bad\.csv: line 7: {name} = .*(allowed|needed)"):
        fit(saved(tmp_path, body))


@pytest.mark.parametrize("text", ["", "nan", "NaN"])
@pytest.mark.parametrize("name", ["angle_of_attack_deg", "sideslip_deg", "speed_m_s", "p_rad_s", "density_kg_m3"])
def test_a_gap_in_the_case_itself_is_refused(tmp_path, lines, name, text):
    with pytest.raises(InputError, match=f"line 7: {name} = (empty|nan|NaN), allowed"):
        fit(saved(tmp_path, cell(lines, 7, name, text)))


@pytest.mark.parametrize("text", ["", "nan", "NaN"])
def test_a_gap_in_a_force_is_left_out_and_said(tmp_path, lines, p, text):
    """A run that diverged: its other forces count, the missing one is no zero."""
    result = fit(saved(tmp_path, cell(lines, 7, "lift_N", text)))
    assert len(result.fit.values()["KL0"][2].rows) == 24
    assert len(result.fit.values()["KD0"][2].rows) == 25
    assert result.fit.values()["Kalpha"][0] == pytest.approx(p.Kalpha, rel=1e-9)
    assert any("1 cases lack a force or a moment" in text and "lines 7" in text for text in result.warnings)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda s: without(s, "angle_of_attack_deg"), r"line 1: angle_of_attack_deg missing; its columns are"),
        (lambda s: without(s, "sideslip_deg", "speed_m_s"), r"sideslip_deg, speed_m_s missing"),
        (lambda s: without(s, "q_rad_s"), r"q_rad_s missing"),
        (lambda s: without(s, *FLOW), r"no force and no moment; needed is one of drag_N"),
        (lambda s: without(s, "density_kg_m3"), r"no density.*column density_kg_m3 or --density"),
        (
            lambda s: without(s, "p_rad_s", "q_rad_s", "r_rad_s", "turning_radius_m"),
            r"turning_radius_m missing beside set",
        ),
        (lambda s: without(s, "p_rad_s", "q_rad_s", "r_rad_s", "set"), r"set missing beside turning_radius_m"),
        (lambda s: without(s, "lift_N"), r"KL0, Kalpha \(lift\): lift_N, or the body's, in 25 cases straight"),
        (
            lambda s: renamed(s, "drag_N", "drag_lbf"),
            r"column drag_lbf: unit lbf is not known; allowed: drag_N drag_mN",
        ),
        (lambda s: renamed(s, "drag_N", "drag"), r"column drag: names no unit; allowed: drag_N"),
        (lambda s: renamed(s, "p_rad_s", "p_rpm"), r"column p_rpm: unit rpm is not known; allowed: p_rad_s p_deg_s"),
        (lambda s: renamed(s, "lift_N", "CL"), r"column CL looks like a coefficient; needed is lift_N"),
        (
            lambda s: renamed(s, "pitch_moment_N_m", "Cm"),
            r"column Cm looks like a coefficient; needed is pitch_moment_N_m",
        ),
        (lambda s: renamed(s, "set", "lift_kN"), r"lift_kN and lift_N are the same quantity|lift_N and lift_kN"),
        (lambda s: renamed(s, "set", "drag_N"), r"column drag_N stands twice"),
        (lambda s: renamed(s, "side_force_N", "body_x_force_N"), r"drag_N and body_x_force_N: one frame is allowed"),
        (lambda s: cell(s, 9, "speed_m_s", "0"), r"line 9: speed_m_s = 0, allowed 0\.001 to 15"),
        (lambda s: cell(s, 9, "speed_m_s", "-0.257"), r"line 9: speed_m_s = -0\.257"),
        (lambda s: cell(s, 9, "angle_of_attack_deg", "95"), r"line 9: angle_of_attack_deg = 95, allowed -90 to 90"),
        (lambda s: cell(s, 9, "density_kg_m3", "1.025"), r"line 9: density_kg_m3 = 1\.025, allowed 900 to 1200"),
        (
            lambda s: cell(s, 60, "r_rad_s", "2.945"),
            r"line 60: p, q, r are not the rates that turning_radius_m and set",
        ),
        (lambda s: cell(s, 60, "set", "spiral"), r"line 60: set = spiral, allowed: straight, about-p3, about-p2"),
        (lambda s: cell(s, 60, "set", "straight"), r"line 60: set = straight, and has a radius"),
        (lambda s: cell(s, 60, "turning_radius_m", ""), r"line 60: set = about-p3, and has no radius"),
        (lambda s: cell(s, 60, "turning_radius_m", "0"), r"line 60: turning_radius_m = 0, allowed"),
        (lambda s: [*s[:8], s[8] + ",1", *s[9:]], r"line 9: has 15 cells for 15 columns|line 9: has 16 cells for 15"),
        (lambda s: s[:1], r"has no rows"),
        (lambda s: ["no table at all", "but text"], r"holds no column names"),
    ],
)
def test_what_is_refused(tmp_path, lines, change, told):
    with pytest.raises(InputError, match=told):
        fit(saved(tmp_path, change(lines)))


def test_radians_called_degrees_are_refused(tmp_path, columns, p):
    wrong = {**columns, "angle_of_attack_deg": np.radians(columns["angle_of_attack_deg"])}
    with pytest.raises(InputError, match=r"angle_of_attack_deg: every angle is within 0\.2094 deg, as if in radians"):
        fit(write(tmp_path / "f.csv", wrong, forces_of(columns, p)))


def test_degrees_called_radians_are_refused(tmp_path, columns, p):
    wrong = {("sideslip_rad" if name == "sideslip_deg" else name): column for name, column in columns.items()}
    with pytest.raises(InputError, match=r"sideslip_rad = -12\.0, allowed -1\.5708 to 1\.5708"):
        fit(write(tmp_path / "f.csv", wrong, forces_of(columns, p)))


def test_one_angle_in_two_units_is_refused(tmp_path, columns, p):
    twice = {**columns, "sideslip_rad": np.radians(columns["sideslip_deg"])}
    with pytest.raises(InputError, match="sideslip_deg and sideslip_rad are the same quantity; one is allowed"):
        fit(write(tmp_path / "f.csv", twice, forces_of(columns, p)))


def test_a_velocity_against_its_angles_is_refused(tmp_path, columns, p):
    wrong = {
        **columns,
        "u_m_s": columns["speed_m_s"],
        "v_m_s": 0.0 * columns["speed_m_s"],
        "w_m_s": 0.0 * columns["speed_m_s"],
    }
    with pytest.raises(InputError, match="line 2: u, v, w are not the velocity that the angles and the speed tell; 1%"):
        fit(write(tmp_path / "f.csv", wrong, forces_of(columns, p)))


def test_columns_of_another_sort_are_named_and_left_alone(tmp_path, lines):
    head = lines[0] + ",Iterations,CL,drag_uncertainty_N,lift_to_drag"
    result = fit(saved(tmp_path, [head, *(line + ",500,0.1,x,3" for line in lines[1:])]))
    assert result.forces.ignored == ["Iterations", "CL", "drag_uncertainty_N", "lift_to_drag"]
    assert "columns not used: Iterations, CL, drag_uncertainty_N, lift_to_drag" in result.warnings


@pytest.mark.parametrize(
    ("keep", "told"),
    [
        (lambda r: r["set"] == "straight", r"KMY, Kr \(yaw moment\): no case turning about p3; at least 3 with 2 sideslips and 2 radii are needed.*KMR, Kp.*Kq.*--partial"),
        (lambda r: r["set"] != "straight", r"KD0, KD \(drag\): no case straight.*Kbeta"),
        (lambda r: r["set"] != "straight" or (abs(float(r["angle_of_attack_deg"])) <= 1 and float(r["angle_of_attack_deg"]) != 1), r"KD0, KD \(drag\): 24 cases|2 of 3 angles of attack"),
        (lambda r: r["set"] != "about-p3" or r["turning_radius_m"] == "5.0", r"KMY, Kr \(yaw moment\): 10 cases turning about p3, with 1 of 2 radii needed"),
        (lambda r: r["set"] != "about-p2" or r["sideslip_deg"] == "0.0", r"KMR, Kp \(roll moment\): 25 cases turning about p2 \(or p1\), with 1 of 2 sideslips"),
    ],
)  # fmt: skip
def test_missing_cases_are_named(tmp_path, lines, keep, told):
    with pytest.raises(InputError, match=told):
        fit(saved(tmp_path, rows_where(lines, keep)))


def test_angles_that_do_not_tell_the_coefficients_apart_are_named(tmp_path, lines):
    """Drag goes with alpha^2: -5 and 5 deg with many repeats are one angle to it."""
    five = rows_where(lines, lambda r: r["set"] != "straight" or r["angle_of_attack_deg"] in ("-5.0", "5.0") or r["sideslip_deg"] != "0.0")  # fmt: skip
    with pytest.raises(InputError, match=r"KD0, KD \(drag\): 2 cases straight, sideslip 0, with 2 of 3 angles"):
        fit(saved(tmp_path, five))


def test_a_bare_hull_in_a_tow_tank(tmp_path, lines, p):
    """Straight cases, drag, lift and pitch moment alone: the rest is the vehicle's, and said to be."""
    bare = without(
        rows_where(lines, lambda r: r["set"] == "straight"), "p_rad_s", "q_rad_s", "r_rad_s", "turning_radius_m", "set",
        "side_force_N", "roll_moment_N_m", "yaw_moment_N_m",
    )  # fmt: skip
    path = saved(tmp_path, bare)
    with pytest.raises(InputError, match="--partial fits the others"):
        fit(path)
    result = fit(path, partial=True, vehicle="seawing")
    assert list(result.fit.values()) == ["KD0", "KD", "KL0", "Kalpha", "KM0", "KM"]
    assert result.kept == ["Kbeta", "KMY", "Kr", "KMR", "Kp", "Kq"]
    assert result.fit.values()["KM"][0] == pytest.approx(p.KM, rel=1e-9)
    assert len(result.fit.lacking) == 4
    alone = fit(path, partial=True)
    assert alone.absent == ["Kbeta", "KMY", "Kr", "KMR", "Kp", "Kq"]
    used = sum(map(len, alone.unused.values())) + alone.used
    assert used == 49  # every row is accounted for


def test_body_components_in_the_plane_are_enough_without_sideslip(tmp_path, columns, p):
    """x, z and the moment about y make drag, lift and T2 where sideslip is zero; no y force is invented elsewhere."""
    path = write(tmp_path / "f.csv", columns, in_body(columns, forces_of(columns, p)), BODY)
    path = saved(
        tmp_path, without(path.read_text().splitlines(), "body_y_force_N", "body_x_moment_N_m", "body_z_moment_N_m")
    )
    measured = read_forces(path).measured
    slipping = columns["sideslip_deg"] != 0.0
    assert np.isfinite(measured[~slipping][:, [0, 2, 4]]).all()
    assert np.isnan(measured[slipping][:, [0, 1]]).all()
    result = fit(path, partial=True)
    assert result.fit.values()["Kalpha"][0] == pytest.approx(p.Kalpha, rel=1e-9)


def test_nothing_to_fit_is_an_error_with_partial_too(tmp_path, lines):
    with pytest.raises(InputError, match="too little for KD0"):
        fit(saved(tmp_path, lines[:2]), partial=True)


def test_a_copied_row_counts_once(tmp_path, lines):
    result = fit(saved(tmp_path, [*lines, lines[3], lines[70]]))
    assert result.unused == {"the same as another line": [151, 152]}
    assert result.used == 149


def test_one_case_with_other_forces_is_refused(tmp_path, lines):
    with pytest.raises(InputError, match=r"lines 4 and 151: one case, and lift -5\.1\d+ and 2;.*within 10%"):
        fit(saved(tmp_path, [*lines, cell(lines, 4, "lift_N", "2")[3]]))


def test_repeats_that_scatter_are_kept_and_named(tmp_path, lines):
    lift = float(lines[3].split(",")[lines[0].split(",").index("lift_N")])
    result = fit(saved(tmp_path, [*lines, cell(lines, 4, "lift_N", repr(lift + 0.05))[3]]))
    assert result.used == 150
    assert any("lines 4 and 151" in text for text in result.warnings)


def test_rows_that_no_coefficient_needs_are_named(tmp_path, columns, p):
    """Both angles at once, and turning about an axis between."""
    more = {
        name: np.append(column, column[-2:])
        for name, column in columns.items()
        if name not in ("set", "turning_radius_m")
    }
    for name, values in {"angle_of_attack_deg": (4.0, 0.0), "sideslip_deg": (4.0, 0.0), "p_rad_s": (0.0, 0.05),
        "q_rad_s": (0.0, 0.05), "r_rad_s": (0.0, 0.05)}.items():  # fmt: skip
        more[name][-2:] = values
    result = fit(write(tmp_path / "f.csv", more, forces_of(more, p)))
    assert result.unused == {
        "straight, with angle of attack and sideslip at once": [151],
        "turning about another axis than p1, p2, p3": [152],
    }
    assert result.used == 149


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"hold": ["Kp"]}, "--hold .* needs --vehicle"),
        ({"hold": ["Kx"], "vehicle": "seawing"}, "--hold Kx: is no coefficient; allowed: KD0"),
        ({"subtract_munk": True}, "--subtract-munk .* needs --vehicle"),
        ({"density": 1000.0}, "--density is for tables without"),
    ],
)
def test_options_without_a_sense(tmp_path, lines, options, told):
    with pytest.raises(UsageError, match=told):
        fit(saved(tmp_path, lines), **options)


@pytest.mark.parametrize("density", [1.025, -1.0, float("nan")])
def test_a_density_that_no_water_has(tmp_path, lines, density):
    with pytest.raises(InputError, match=r"--density: .* 900 to 1200"):
        fit(saved(tmp_path, without(lines, "density_kg_m3")), density=density)
