"""Against the official check values of TEOS-10 (GSW toolbox, gsw_cv_v3_0, first check cast, 142 E 11 N)."""

import numpy as np
import pytest

from glidercli.errors import InputError
from glidercli.ocean import seawater

# columns of the check values: SP_chck_cast, t_chck_cast, p_chck_cast, C_from_SP, SA_from_SP, CT_from_t, rho, z_from_p
CHECK = np.array(
    [
        [34.306287392599714, 27.962, 0.0, 55.19754712635529, 34.468236430490606, 27.996436412058213,
         1021.8863044505447, 0.0],
        [34.532505000117716, 4.9176, 909.0, 33.382144048823484, 34.70523685435276, 4.8418804148384185,
         1031.4980914996909, -901.8572642972814],
        [34.68456315980326, 1.4752999999999998, 5098.0, 32.043935609111884, 34.86377002371946, 1.0291291795169686,
         1050.5884824364505, -5009.436801740654],
    ]
)  # fmt: skip
SP, T, P, C, SA, CT, RHO, Z = CHECK.T
PLACE = (142.0, 11.0)  # longitude, latitude
PUBLISHED = 1e-7  # the check values' own error bounds are below this in every unit used here


def test_practical_salinity_from_conductivity():
    assert seawater.practical_salinity(C / 10.0, T, P) == pytest.approx(SP, abs=PUBLISHED)


def test_pss78_standard_point():
    # Unesco technical paper 37 (1981): conductivity ratio 1 at 15 degC (IPTS-68) and p = 0 is S = 35, C = 4.2914 S/m
    assert seawater.practical_salinity(4.2914, seawater.t90_from_t68(15.0), 0.0) == pytest.approx(35.0, abs=1e-6)


def test_absolute_salinity():
    assert seawater.absolute_salinity(SP, P, *PLACE) == pytest.approx(SA, abs=PUBLISHED)


def test_absolute_salinity_without_a_place_is_the_reference_salinity():
    assert seawater.absolute_salinity(35.0, 0.0, None, 0.0) == pytest.approx(35.16504)  # the manual's definition


def test_conservative_temperature():
    assert seawater.conservative_temperature(SA, T, P) == pytest.approx(CT, abs=PUBLISHED)


def test_density():
    assert seawater.density(SA, T, P) == pytest.approx(RHO, abs=PUBLISHED)


def test_density_against_the_older_standard():
    # EOS-80 (Unesco technical paper 38): S 35, 25 degC (IPTS-68), 10000 dbar: 1062.53817 kg/m3. The two standards
    # differ by a few parts in a hundred thousand at that pressure.
    absolute = seawater.absolute_salinity(35.0, 1e4, None, 0.0)
    assert seawater.density(absolute, seawater.t90_from_t68(25.0), 1e4) == pytest.approx(1062.53817, abs=0.03)


def test_depth_and_pressure():
    assert seawater.depth_from_pressure(P, PLACE[1]) == pytest.approx(-Z, abs=PUBLISHED)
    assert seawater.pressure_from_depth(-Z, PLACE[1]) == pytest.approx(P, abs=PUBLISHED)


def test_gravity():
    # gsw_cv_v3_0, grav at p = 0, 11 N; GRS80 (Moritz 2000) at the equator and the pole
    assert seawater.gravity(11.0) == pytest.approx(9.782207133388146, abs=PUBLISHED)
    assert seawater.gravity(0.0) == pytest.approx(9.7803267715, abs=1e-6)  # the toolbox rounds the constant
    assert seawater.gravity(-90.0) == pytest.approx(9.8321863685, abs=1e-6)


def test_a_latitude_off_the_globe_is_refused():
    with pytest.raises(InputError, match="latitude: 91 deg, allowed -90 to 90"):
        seawater.gravity(91.0)
