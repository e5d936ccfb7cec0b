import math

import pytest

from glidercli.errors import InputError
from glidercli.kernel import compiled
from glidercli.ocean import Ocean, at_depth, read_adcp, read_ctd

ADCP = "depth_m,current_east_m_s,current_north_m_s,current_up_m_s\n10,0.1,0.5,0.01\n30,0.3,0.1,0.03\n"
ROUND_OFF = 1e-12  # a few operations in double precision on values of order one


@pytest.fixture
def sheared(write):
    """A current that is linear between 10 and 30 m."""
    return read_adcp(write("adcp.csv", ADCP))


def test_uniform_water_is_the_same_everywhere():
    ocean = Ocean.uniform(1025.0)
    assert (ocean.gravity, ocean.stratified, ocean.has_temperature) == (9.81, False, False)
    for z in (0.0, 500.0):
        water = ocean.at(z)
        assert (water.density, water.pressure) == (1025.0, 0.0)
        assert water.current == water.shear == (0.0, 0.0, 0.0)
        assert math.isnan(water.temperature)
    assert Ocean.uniform(1025.0, temperature_reference=15.0).at(3.0).temperature == 15.0
    assert ocean.beyond(0.0, 6000.0) == []


def test_gravity_follows_the_latitude_that_the_caller_gives(ctd):
    cast = read_ctd(ctd / "CTD_with_sigma_e00.cnv")
    assert Ocean.build(1025.0, cast).gravity == 9.81
    assert Ocean.build(1025.0, cast, latitude=90.0).gravity == pytest.approx(9.832186, abs=1e-6)  # GRS80 at the pole
    with pytest.raises(InputError, match="latitude: 91 deg, allowed -90 to 90"):
        Ocean.build(1025.0, latitude=91.0)


def test_the_cast_comes_back_at_its_own_depths(ctd):
    cast = read_ctd(ctd / "CTD_with_sigma_e00.cnv")
    ocean = Ocean.build(1025.0, cast)
    assert ocean.stratified
    assert ocean.has_temperature
    assert ocean.inputs == (cast.source,)
    for i in (0, 17, 100, 198):
        water = ocean.at(cast.depth[i])
        assert water.density == pytest.approx(cast.density[i], abs=1e-9)  # cubic terms cancel at the last knot
        assert water.pressure == pytest.approx(1e4 * cast.pressure_dbar[i], abs=1e-5)
        assert water.temperature == pytest.approx(cast.temperature[i], abs=1e-9)


def test_current_becomes_north_east_down(sheared):
    water = Ocean.build(1025.0, currents=sheared).at(15.0)
    assert water.current == pytest.approx((0.4, 0.15, -0.015), abs=ROUND_OFF)
    assert water.shear == pytest.approx((-0.02, 0.01, -0.001), abs=ROUND_OFF)
    assert water.density == 1025.0


def test_beyond_the_current_profile_it_is_held(sheared):
    ocean = Ocean.build(1025.0, currents=sheared)
    assert ocean.at(0.0).current == pytest.approx((0.5, 0.1, -0.01), abs=ROUND_OFF)
    assert ocean.at(99.0).current == pytest.approx((0.1, 0.3, -0.03), abs=ROUND_OFF)
    assert ocean.at(99.0).shear == (0.0, 0.0, 0.0)


def test_a_flight_beyond_the_profiles_is_said_with_its_range(ctd, sheared):
    ocean = Ocean.build(1025.0, read_ctd(ctd / "CTD_with_sigma_e00.cnv"), sheared)
    assert ocean.beyond(12.0, 28.0) == []
    assert ocean.beyond(12.0, 40.0) == [
        "the flight spans 12.0 to 40.0 m, the current profile 10.0 to 30.0 m; its end values are held beyond"
    ]
    assert len(ocean.beyond(0.0, 300.0)) == 2
    assert "spans 0.0 to" in ocean.beyond(-1e-9, 40.0)[0]


def test_a_cast_without_temperature_gives_the_reference(write):
    cast = read_ctd(write("cast.csv", "depth_m,density_kg_m3\n0,1021\n100,1025.5\n"), latitude=20.0)
    ocean = Ocean.build(1025.0, cast, temperature_reference=12.0)
    assert not ocean.has_temperature
    assert ocean.at(40.0).temperature == pytest.approx(12.0, abs=ROUND_OFF)
    assert math.isnan(Ocean.build(1025.0, cast).at(40.0).temperature)


def test_warnings_name_their_file(ctd):
    ocean = Ocean.build(1025.0, read_ctd(ctd / "press-pass-prDE.cnv"))
    assert ocean.warnings[0].startswith(f"{ctd / 'press-pass-prDE.cnv'}: latitude unknown")
    assert len(ocean.warnings) == len(set(ocean.warnings)) == 3


def test_compiled_and_plain_agree(ctd, sheared):
    ocean = Ocean.build(1025.0, read_ctd(ctd / "CTD_with_sigma_e00.cnv"), sheared)
    fast = compiled(at_depth)
    for z in (0.0, 10.0, 15.3, 199.0, 500.0):
        plain, quick = ocean.at(z), fast(ocean.sea, z, 0.0)
        assert quick[:3] == pytest.approx(plain[:3], rel=ROUND_OFF)
        assert quick.current == pytest.approx(plain.current, abs=ROUND_OFF)
        assert quick.shear == pytest.approx(plain.shear, abs=ROUND_OFF)


@pytest.mark.parametrize("density", [0.0, -1.0, math.nan])
def test_a_density_that_is_none_is_refused(density):
    with pytest.raises(InputError, match=r"ocean: density = .* a positive number is needed"):
        Ocean.uniform(density)
