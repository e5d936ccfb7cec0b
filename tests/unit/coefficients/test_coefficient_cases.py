"""The case table: Table 2's counts, eqs (23)-(27) against independent rotations, the printed Reynolds numbers."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from glidercli.coefficients.flows.case_table import COLUMNS, cases
from glidercli.coefficients.flows.reynolds import PAPER_VISCOSITY, reynolds_number, seawater_viscosity, turbulence
from glidercli.errors import InputError
from glidercli.vehicle import load_vehicle


@pytest.fixture(scope="module")
def table():
    return cases(load_vehicle("seawing").hull)


def stacked(columns, *names):
    return np.stack([columns[name] for name in names], axis=1)


def test_the_counts_of_table_2(table):
    assert table.counts() == {"straight": 49, "about-p3": 50, "about-p2": 50}
    assert tuple(table.columns) == COLUMNS
    straight = table.columns["set"] == "straight"
    pairs = set(
        zip(table.columns["angle_of_attack_deg"][straight], table.columns["sideslip_deg"][straight], strict=True)
    )
    assert pairs == {(a, 0.0) for a in range(-12, 13)} | {(0.0, b) for b in range(-12, 13)}
    assert set(table.columns["turbulence_model"][straight]) == {"k-epsilon"}
    assert set(table.columns["turbulence_model"][~straight]) == {"k-omega"}
    for kind in ("about-p3", "about-p2"):
        of_kind = table.columns["set"] == kind
        for radius in (5, 10, 20, 30, 40):
            here = of_kind & (table.columns["turning_radius_m"] == radius)
            flown = sorted(
                zip(table.columns["angle_of_attack_deg"][here], table.columns["sideslip_deg"][here], strict=True)
            )
            printed = [(0, b) for b in (-3, 0, 3, 6, 9, 12)] + [(a, 0) for a in (-3, 3, 6, 9)]
            assert flown == sorted(printed)


def test_velocity_and_rates_are_rotated_as_scipy_does(table):
    """R_BC is a sideslip turn about z inside an angle of attack turn about -y; 1e-15 is rounding."""
    c = table.columns
    angles = np.radians(stacked(c, "sideslip_deg", "angle_of_attack_deg"))
    R = Rotation.from_euler("y", -angles[:, [1]]) * Rotation.from_euler("z", angles[:, [0]])
    speed = np.stack([c["speed_m_s"], *2 * [np.zeros(len(c["case"]))]], axis=1)
    np.testing.assert_allclose(stacked(c, "u_m_s", "v_m_s", "w_m_s"), R.apply(speed), atol=1e-15)
    about = np.zeros((len(c["case"]), 3))
    about[c["set"] == "about-p3", 2] = 1.0
    about[c["set"] == "about-p2", 1] = 1.0
    omega = (c["speed_m_s"] / c["turning_radius_m"])[:, None] * about  # (24)
    np.testing.assert_allclose(stacked(c, "p_rad_s", "q_rad_s", "r_rad_s"), R.apply(omega), atol=1e-15)


def test_the_printed_components(table):
    """(26) and (27) as printed, with the signs that the print lost restored by (21)."""
    c = table.columns
    a, b, w = np.radians(c["angle_of_attack_deg"]), np.radians(c["sideslip_deg"]), c["angular_speed_rad_s"]
    flat, upright = c["set"] == "about-p3", c["set"] == "about-p2"
    p = np.where(flat, -w * np.sin(a), np.where(upright, -w * np.cos(a) * np.sin(b), 0.0))
    q = np.where(upright, w * np.cos(b), 0.0)
    r = np.where(flat, w * np.cos(a), np.where(upright, -w * np.sin(a) * np.sin(b), 0.0))
    np.testing.assert_allclose(stacked(c, "p_rad_s", "q_rad_s", "r_rad_s"), np.stack([p, q, r], axis=1), atol=1e-16)


def test_the_velocity_turns_about_the_centre_of_curvature(table):
    """V = Omega x (-c), c rotated to the body frame."""
    c = table.columns
    turning = c["set"] != "straight"
    angles = np.radians(stacked(c, "sideslip_deg", "angle_of_attack_deg"))[turning]
    R = Rotation.from_euler("y", -angles[:, [1]]) * Rotation.from_euler("z", angles[:, [0]])
    centre = R.apply(stacked(c, "centre_p1_m", "centre_p2_m", "centre_p3_m")[turning])
    Omega = stacked(c, "p_rad_s", "q_rad_s", "r_rad_s")[turning]
    V = stacked(c, "u_m_s", "v_m_s", "w_m_s")[turning]
    np.testing.assert_allclose(np.cross(Omega, -centre), V, atol=1e-15)
    flat = c["set"] == "about-p3"
    assert (c["centre_p2_m"][flat] > 0.0).all()  # starboard
    assert (c["centre_p3_m"][c["set"] == "about-p2"] < 0.0).all()  # above: nose up


def test_the_domain_and_its_inlet(table):
    c = table.columns
    assert c["domain_length_m"][0] == pytest.approx(5 * 1.99)
    assert c["domain_width_m"][0] == c["domain_height_m"][0] == pytest.approx(18 * 0.22)
    assert c["inlet_distance_m"][0] == pytest.approx(1.5 * 1.99)
    sharp = c["turning_radius_m"] == 5.0
    assert c["inlet_speed_inner_m_s"][sharp] == pytest.approx(0.257 / 5 * (5 - 9 * 0.22))
    assert c["inlet_speed_outer_m_s"][sharp] == pytest.approx(0.257 / 5 * (5 + 9 * 0.22))
    straight = c["set"] == "straight"
    for place in ("inner", "centre", "outer"):
        assert (c[f"inlet_speed_{place}_m_s"][straight] == 0.257).all()


def test_the_printed_reynolds_numbers(table):
    assert f"{table.columns['reynolds_number'][0]:.2e}" == "4.32e+05"
    assert f"{reynolds_number(0.514, 1.99, 1025.0, PAPER_VISCOSITY):.2e}" == "8.65e+05"
    assert table.warnings == []


def test_the_range_of_the_turbulence_models():
    hull = load_vehicle("seawing").hull
    assert [bool(turbulence(number)) for number in (1e5, 5e5, 1e6)] == [True, False, True]
    (told,) = cases(hull, speed=0.7).warnings
    assert "outside 1e+05 to 1e+06" in told


@pytest.mark.parametrize(
    ("temperature", "salinity", "published", "tolerance"),
    [
        (15.0, 35.165, 1.1892e-6 * 1026.021, 1e-3),  # ITTC 7.5-02-01-03 (2011), nu rho; another formula, 5 digits
        (20.0, 0.0, 1.0016e-3, 1e-3),  # IAPWS 2008, to which the pure-water part was fitted
        (25.0, 40.0, 9.6541e-4, 0.015),  # Millero (1974), a source of the fit: within its stated 1.5 %
        (10.0, 30.14, 1.383779e-3, 0.015),  # Dorsey (1940) at S = 30, independent of the fit
    ],
)
def test_viscosity_of_seawater_against_others(temperature, salinity, published, tolerance):
    assert seawater_viscosity(temperature, salinity) == pytest.approx(published, rel=tolerance)


def test_the_default_viscosity_is_that_of_seawater_at_15_deg():
    assert seawater_viscosity(15.25, 35.165) == pytest.approx(PAPER_VISCOSITY, rel=1e-4)  # as its docstring says


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"radii": [1.98]}, r"1\.98 m .* more than 1\.98 m .*half width.*inner edge would pass the centre"),
        ({"radii": [-5.0]}, "-5 m"),
        ({"radii": [float("nan")]}, "nan m"),
        ({"radii": [float("inf")]}, "inf m"),
        ({"radii": [5.0, 5.0]}, "given twice"),
        ({"speed": 0.0}, "speed: 0 m/s is not allowed"),
        ({"speed": float("nan")}, "speed: nan"),
        ({"viscosity": -1.0}, "viscosity: -1 Pa s"),
        ({"density": float("inf")}, "density: inf"),
    ],
)
def test_what_is_refused(given, told):
    with pytest.raises(InputError, match=told):
        cases(load_vehicle("seawing").hull, **given)


def test_viscosity_outside_the_sea_is_refused():
    with pytest.raises(InputError, match="temperature: 80 degC"):
        seawater_viscosity(80.0, 35.0)
