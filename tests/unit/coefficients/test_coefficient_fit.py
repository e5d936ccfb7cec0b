"""The fit gives back what forces were made from, with errors that are errors; no order, unit or frame changes it."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_forces import BODY, FLOW, SIZE, forces_of, in_body, table_2, write
from scipy import stats

from glidercli.coefficients.flows.case_table import cases
from glidercli.coefficients.forces.fitting import SYMBOLS, fit_forces
from glidercli.coefficients.forces.munk import of_added_mass
from glidercli.coefficients.forces.result import fit
from glidercli.coefficients.forces.table import read_forces
from glidercli.model import parameters
from glidercli.model.equations import wrench
from glidercli.model.mass import Placement, momentum
from glidercli.model.parameters import Controls
from glidercli.ocean.water import Water
from glidercli.vehicle import load_vehicle
from glidercli.vehicle.vehicle import AddedMass


@pytest.fixture(scope="module")
def columns():
    return table_2()


def values_of(result):
    return {symbol: value for symbol, (value, _, _) in result.fit.values().items()}


def noisy(columns, p, seed=1, share=0.01):
    clean = forces_of(columns, p)
    return clean + np.random.default_rng(seed).normal(size=clean.shape) * share * SIZE


def test_forces_of_table_3_give_table_3_back(tmp_path, columns, p):
    result = fit(write(tmp_path / "f.csv", columns, forces_of(columns, p)))
    assert values_of(result) == pytest.approx({symbol: getattr(p, symbol) for symbol in SYMBOLS}, rel=1e-9)
    assert result.used == 149
    assert result.fit.density == 1025.0
    assert math.degrees(result.fitted_angle) == pytest.approx(12.0)
    for one in result.fit.fitted:
        assert one.r_squared == pytest.approx(1.0, abs=1e-12)


def test_table_2_rows_are_used_as_section_3_3_says(tmp_path, columns, p):
    result = fit(write(tmp_path / "f.csv", columns, forces_of(columns, p)))
    told = {one.equation.unknowns: len(one.rows) for one in result.fit.fitted}
    assert told == {
        ("KD0", "KD"): 25, ("KL0", "Kalpha"): 25, ("KM0", "KM"): 25, ("Kbeta",): 25, ("KMY", "Kr"): 50,
        ("KMR", "Kp"): 50, ("Kq",): 50,
    }  # fmt: skip


def test_estimates_scatter_by_their_standard_errors(tmp_path, columns, p):
    """Pulls of 400 noisy tables have mean 0 and deviation 1.

    A pull is t-distributed, 23 to 49 degrees of freedom: variance at most 23/21. The mean of 400 has deviation 0.052, so
    4.5 deviations are 0.24; the deviation itself has 1/sqrt(800) = 0.037, so 4.5 of it are 0.17 about 1 to 1.05.
    """
    table = read_forces(write(tmp_path / "f.csv", columns, forces_of(columns, p)))
    rng = np.random.default_rng(20130301)
    pulls = []
    for _ in range(400):
        noise = rng.normal(size=table.measured.shape) * 0.02 * SIZE
        found = fit_forces(table._replace(measured=table.measured + noise), 1025.0).values()
        pulls.append([(value - getattr(p, symbol)) / error for symbol, (value, error, _) in found.items()])
    pulls = np.array(pulls)
    assert pulls.shape == (400, 12)
    assert np.abs(pulls.mean(axis=0)).max() < 0.24
    assert pulls.std(axis=0).min() > 0.83
    assert pulls.std(axis=0).max() < 1.22


def test_without_the_carried_covariance_the_error_of_kq_would_be_too_small(tmp_path, columns, p):
    """Its part from KM0 and KM is told apart from scatter by 300 tables: 3 % of a deviation of 1/sqrt(600) = 4 %
    would not do, so the straight cases are made ten times noisier."""
    table = read_forces(write(tmp_path / "f.csv", columns, forces_of(columns, p)))
    share = np.where(table.kind == "straight", 0.2, 0.02)[:, None]
    rng = np.random.default_rng(5)
    estimates, errors = [], []
    for _ in range(300):
        noise = rng.normal(size=table.measured.shape) * share * SIZE
        value, error, _ = fit_forces(table._replace(measured=table.measured + noise), 1025.0).values()["Kq"]
        estimates.append(value)
        errors.append(error)
    scatter = float(np.std(estimates))
    # the second stage's own residuals hold part of the first's error too, so the error may be up to 15 % too large
    assert 0.85 < scatter / float(np.median(errors)) < 1.15


def test_standard_errors_are_those_of_the_textbook(tmp_path, columns, p):
    """scipy's linear regression, where its constant is V^2 at one speed; and the normal equations for a turning set."""
    forces = noisy(columns, p)
    result = fit(write(tmp_path / "f.csv", columns, forces))
    found = result.fit.values()
    straight = (columns["set"] == "straight") & (columns["sideslip_deg"] == 0.0)
    alpha, V2 = np.radians(columns["angle_of_attack_deg"]), columns["speed_m_s"] ** 2
    for symbols, y, x in (
        (("KD0", "KD"), forces[:, 0], alpha**2),
        (("KL0", "Kalpha"), forces[:, 2], alpha),
        (("KM0", "KM"), forces[:, 4], alpha),
    ):
        line = stats.linregress(x[straight], y[straight] / V2[straight])
        assert found[symbols[0]][:2] == pytest.approx((line.intercept, line.intercept_stderr), rel=1e-9)
        assert found[symbols[1]][:2] == pytest.approx((line.slope, line.stderr), rel=1e-9)
        assert found[symbols[0]][2].r_squared == pytest.approx(line.rvalue**2, rel=1e-9)  # a constant: R2 = r^2
    turning = columns["set"] == "about-p3"
    X = np.column_stack([np.radians(columns["sideslip_deg"]) * V2, columns["r_rad_s"] * V2])[turning]
    y = forces[turning, 5]
    inverse = np.linalg.inv(X.T @ X)
    x = inverse @ X.T @ y
    s2 = np.sum((y - X @ x) ** 2) / (50 - 2)
    errors = np.sqrt(s2 * np.diag(inverse))
    assert found["KMY"][:2] == pytest.approx((x[0], errors[0]), rel=1e-8)
    assert found["Kr"][:2] == pytest.approx((x[1], errors[1]), rel=1e-8)
    assert found["Kr"][2].found.correlation == pytest.approx(inverse[0, 1] / np.sqrt(inverse[0, 0] * inverse[1, 1]))


def test_kq_with_its_carried_error_written_out(tmp_path, columns, p):
    """var Kq = s2/(q.q) + g C g, g = -(q.Z)/(q.q): the same two stages in plain normal equations."""
    forces = noisy(columns, p)
    found = fit(write(tmp_path / "f.csv", columns, forces)).fit.values()
    alpha, V2 = np.radians(columns["angle_of_attack_deg"]), columns["speed_m_s"] ** 2
    straight = (columns["set"] == "straight") & (columns["sideslip_deg"] == 0.0)
    upright = columns["set"] == "about-p2"
    Z = np.column_stack([V2, alpha * V2])
    inverse = np.linalg.inv(Z[straight].T @ Z[straight])
    k = inverse @ Z[straight].T @ forces[straight, 4]
    C = inverse * np.sum((forces[straight, 4] - Z[straight] @ k) ** 2) / (25 - 2)
    q = (columns["q_rad_s"] * V2)[upright]
    y = forces[upright, 4] - Z[upright] @ k
    Kq = q @ y / (q @ q)
    g = -(q @ Z[upright]) / (q @ q)
    variance = np.sum((y - Kq * q) ** 2) / (50 - 1) / (q @ q) + g @ C @ g
    assert found["Kq"][:2] == pytest.approx((Kq, np.sqrt(variance)), rel=1e-9)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_the_order_of_rows_changes_nothing(tmp_path_factory, seed):
    p = parameters(load_vehicle("seawing"))
    columns, folder = table_2(), tmp_path_factory.mktemp("order")
    forces = noisy(columns, p)
    order = np.random.default_rng(seed).permutation(149)
    mixed = {name: column[order] for name, column in columns.items()}
    one = fit(write(folder / "a.csv", columns, forces)).fit.values()
    other = fit(write(folder / "b.csv", mixed, forces[order])).fit.values()
    for symbol in SYMBOLS:  # sums in another order: rounding
        assert other[symbol][:2] == pytest.approx(one[symbol][:2], rel=1e-9)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), body=st.booleans(), units=st.booleans(), velocity=st.booleans())
def test_units_frames_and_spelling_of_the_flow_change_nothing(tmp_path_factory, seed, body, units, velocity):
    p = parameters(load_vehicle("seawing"))
    columns, folder = table_2(), tmp_path_factory.mktemp("same")
    forces = noisy(columns, p, seed)
    one = fit(write(folder / "a.csv", columns, forces)).fit.values()
    new, names = dict(columns), BODY if body else FLOW
    shown = in_body(columns, forces) if body else forces
    if units:
        for name in ("angle_of_attack", "sideslip"):
            new[f"{name}_rad"] = np.radians(new.pop(f"{name}_deg"))
        for name in "pqr":
            new[f"{name}_deg_s"] = np.degrees(new.pop(f"{name}_rad_s"))
        names = tuple(name.replace("_N_m", "_mN_m").replace("force_N", "force_mN").replace("drag_N", "drag_mN")
                      .replace("lift_N", "lift_mN") for name in names)  # fmt: skip
        shown = 1000.0 * shown
    elif velocity:
        full = cases(load_vehicle("seawing").hull)
        for name in ("angle_of_attack_deg", "sideslip_deg", "speed_m_s"):
            del new[name]
        new.update({name: full.columns[name] for name in ("u_m_s", "v_m_s", "w_m_s")})
    other = fit(write(folder / "b.csv", new, shown, names)).fit.values()
    for symbol in SYMBOLS:  # 1e-8: residuals of 1 % amplify the rounding of conversions
        assert other[symbol][:2] == pytest.approx(one[symbol][:2], rel=1e-8)


def test_the_radius_alone_tells_the_rates(tmp_path, columns, p):
    forces = noisy(columns, p)
    short = {name: column for name, column in columns.items() if name not in ("p_rad_s", "q_rad_s", "r_rad_s")}
    one, other = fit(write(tmp_path / "a.csv", columns, forces)), fit(write(tmp_path / "b.csv", short, forces))
    assert values_of(other) == pytest.approx(values_of(one), rel=1e-9)


def test_density_scales_forces(tmp_path, columns, p):
    """Two waters in one table: the coefficients hold at the mean density, and forces go with rho."""
    columns = {**columns, "density_kg_m3": np.where(np.arange(149) % 2, 1000.0, 1050.0)}
    result = fit(write(tmp_path / "f.csv", columns, forces_of(columns, p)))
    mean = columns["density_kg_m3"].mean()
    assert result.fit.density == pytest.approx(mean)
    assert values_of(result)["KD"] == pytest.approx(p.KD * mean / 1025.0, rel=1e-9)


def test_density_as_an_option(tmp_path, columns, p):
    bare = {name: column for name, column in columns.items() if name != "density_kg_m3"}
    result = fit(write(tmp_path / "f.csv", bare, forces_of(columns, p)), density=1025.0)
    assert values_of(result) == pytest.approx({symbol: getattr(p, symbol) for symbol in SYMBOLS}, rel=1e-9)


def test_a_held_coefficient_stays_and_its_partner_is_fitted(tmp_path, columns, p):
    forces = noisy(columns, p)
    free = fit(write(tmp_path / "a.csv", columns, forces), vehicle="seawing").fit.values()
    held = fit(tmp_path / "a.csv", vehicle="seawing", hold=["roll_rate"])
    assert "Kp" not in held.fit.values()
    assert held.kept == ["Kp"]
    value, error, _ = held.fit.values()["KMR"]
    assert error < free["KMR"][1]  # one unknown less
    x = np.radians(columns["sideslip_deg"]) * columns["speed_m_s"] ** 2
    y = forces[:, 3] - p.Kp * columns["p_rad_s"] * columns["speed_m_s"] ** 2
    upright = columns["set"] == "about-p2"
    assert value == pytest.approx(x[upright] @ y[upright] / (x[upright] @ x[upright]), rel=1e-9)


def test_rolling_cases_tell_the_roll_damping(tmp_path, columns, p):
    """Section 3.3's cases leave Kp all but unknown; a few turning about p1 settle it."""
    roll = {name: column[:6].copy() for name, column in columns.items()}
    roll.update(
        angle_of_attack_deg=np.zeros(6), sideslip_deg=np.zeros(6), p_rad_s=np.array([-0.3, -0.2, -0.1, 0.1, 0.2, 0.3])
    )
    roll["set"] = np.array(["about-p1"] * 6)
    bare = {name: column for name, column in columns.items() if name != "turning_radius_m"}
    more = {name: np.concatenate([bare[name], roll[name]]) for name in bare}
    without = fit(write(tmp_path / "a.csv", bare, noisy(bare, p))).fit.values()["Kp"]
    value, error, _ = fit(write(tmp_path / "b.csv", more, noisy(more, p))).fit.values()["Kp"]
    assert error < 0.2 * without[1]
    assert abs(value - p.Kp) < 4.0 * error


def added_mass_wrench(V, Omega, dense, p):
    """What eq. (19) itself adds to F and T for a hull without mass of its own: its right-hand side at F = T = 0."""
    massless = p._replace(ms=0.0, mr=0.0, Is=(0.0,) * 3, Ir0=(0.0,) * 3)
    zero = (0.0, 0.0, 0.0)
    P, Pi = momentum(V, Omega, Controls(0.0, 0.0, 0.0), dense, massless)
    at = Placement(zero, (zero, zero, zero), zero, zero, 0.0)
    water = Water(
        density=dense * p.rho_ref, pressure=0.0, temperature=p.T_0, gravity=0.0, current=zero, shear=zero, change=zero
    )
    return wrench(V, Omega, P, Pi, zero, zero, (0.0, 0.0, 1.0), at, water, massless)


def test_the_part_of_added_mass_is_that_of_the_equations(p):
    rng = np.random.default_rng(3)
    V, Omega = rng.normal(size=(20, 3)), rng.normal(size=(20, 3))
    added = AddedMass(p.MA, p.IA, p.Nv, p.Mw)
    force, moment = of_added_mass(V, Omega, added)
    for i in range(20):
        f, m = added_mass_wrench(tuple(V[i]), tuple(Omega[i]), 1.0, p)
        np.testing.assert_allclose(force[i], f, rtol=1e-12, atol=1e-11)
        np.testing.assert_allclose(moment[i], m, rtol=1e-12, atol=1e-11)


def measured_with_added_mass(columns, p):
    """Forces as a towed hull has them: eq. (20) and what the equations add, in the body frame."""
    body = in_body(columns, forces_of(columns, p))
    c = cases(load_vehicle("seawing").hull).columns
    for i in range(len(body)):
        V = tuple(float(c[name][i]) for name in ("u_m_s", "v_m_s", "w_m_s"))
        Omega = tuple(float(c[name][i]) for name in ("p_rad_s", "q_rad_s", "r_rad_s"))
        f, m = added_mass_wrench(V, Omega, 1.0, p)
        body[i] += [*f, *m]
    return body


def test_with_subtract_munk_the_model_adds_up_to_what_was_measured(tmp_path, columns, p):
    path = write(tmp_path / "f.csv", columns, measured_with_added_mass(columns, p), BODY)
    result = fit(path, vehicle="seawing", subtract_munk=True)
    assert values_of(result) == pytest.approx({symbol: getattr(p, symbol) for symbol in SYMBOLS}, rel=1e-8)


def test_without_it_the_moments_hold_the_munk_moment_twice_and_a_note_says_so(tmp_path, columns, p):
    path = write(tmp_path / "f.csv", columns, measured_with_added_mass(columns, p), BODY)
    result = fit(path, vehicle="seawing")
    # sin a cos a for a: up to 3 % off at 12 deg
    assert values_of(result)["KM"] == pytest.approx(p.KM + p.MA[2] - p.MA[0], abs=0.03 * 64.44)
    note = [text for text in result.warnings if "Munk" in text]
    assert len(note) == 1
    assert "+64.44 alpha beside KM" in note[0]
    assert "-48.1 beta beside KMY" in note[0]
    assert "--subtract-munk" in note[0]
