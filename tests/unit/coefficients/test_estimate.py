"""Estimates of whole vehicles: limits, scale laws, signs through the model itself, what is refused."""

import dataclasses
import math

import pytest
from test_strips import remus

from glidercli import trim
from glidercli.coefficients.added.added_mass import added_mass
from glidercli.coefficients.flows.reynolds import PAPER_VISCOSITY
from glidercli.coefficients.handbook.estimate import MUNK, SPEED, estimate
from glidercli.coefficients.shape.geometry import Geometry, HullShape, Surface, load_geometry
from glidercli.errors import InputError
from glidercli.model import Controls, parameters
from glidercli.model.equations import equilibrium
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.ocean import Water
from glidercli.vehicle import load_vehicle
from glidercli.vehicle.vehicle import AddedMass

WATER = Water(1025.0, 0.0, 15.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.81)
SYMBOLS = (
    "drag_zero", "drag_attack", "side_sideslip", "lift_zero", "lift_attack", "roll_sideslip", "roll_rate", "pitch_zero",
    "pitch_attack", "pitch_rate", "yaw_sideslip", "yaw_rate",
)  # fmt: skip


def shape(scale=1.0, tail=-0.9, height=0.25, sides="both", wings=True, fin=True, **more):
    """A spheroid of 2 m with wings and a fin; ``tail`` is the middle of the fin's chord."""
    surfaces = {}
    if wings:
        surfaces["wing"] = Surface(
            plane="horizontal", semi_span=0.6 * scale, root_chord=0.15 * scale, tip_chord=0.15 * scale,
            root_position=-0.1 * scale, tip_position=-0.1 * scale,
        )  # fmt: skip
    if fin:
        surfaces["fin"] = Surface(
            plane="vertical", semi_span=height * scale, root_chord=0.1 * scale, tip_chord=0.1 * scale, sides=sides,
            root_position=(tail + 0.05) * scale, tip_position=(tail + 0.05) * scale, root_offset=0.0,
        )  # fmt: skip
    return Geometry(
        "shape", "a test", "none", HullShape(length=2.0 * scale, diameter=0.2 * scale), surfaces,
        centre_of_buoyancy=0.0, **more,
    )  # fmt: skip


def totals(found):
    return {symbol: one.total for symbol, one in found.coefficients.items()}


def vehicle_of(geometry):
    """The Seawing with the estimates and the added mass of a shape."""
    seawing, found = load_vehicle("seawing"), estimate(geometry)
    water = added_mass(geometry).total()
    numbers = {one.row.name: one.total.value for one in found.coefficients.values()}
    added = dataclasses.replace(
        seawing.added_mass, mass=(water.surge, water.sway, water.heave), inertia=(water.roll, water.pitch, water.yaw),
        yaw_from_sway=water.yaw_from_sway, pitch_from_heave=water.pitch_from_heave,
    )  # fmt: skip
    numbers["reference_density"] = geometry.density
    return dataclasses.replace(
        seawing, added_mass=added, hydrodynamics=dataclasses.replace(seawing.hydrodynamics, **numbers)
    )


def moments(geometry, alpha=0.0, beta=0.0, lever=0.0):
    """Roll, pitch and yaw moment of the whole model in steady flow, weights without moment, N m."""
    p = parameters(vehicle_of(geometry))._replace(rs=(0.0, 0.0, 0.0), rb=(0.0, 0.0, 0.0), Rr=0.0)
    found = equilibrium(
        velocity_from_flow(SPEED, alpha, beta), (0.0, 0.0, 1.0), lever, Controls(0.0, 0.0, 0.0), WATER, p
    )
    return found[3:]


def test_every_coefficient_of_a_vehicle_is_there_once():
    assert tuple(one.row.name for one in estimate(shape()).coefficients.values()) == SYMBOLS


@pytest.mark.parametrize("geometry", [shape(), shape(sides="upper"), shape(wings=False), shape(wings=False, fin=False)])
def test_intervals_hold_their_values(geometry):
    for one in estimate(geometry).coefficients.values():
        for part, bounds in one.parts.items():
            assert bounds.lower <= bounds.value <= bounds.upper, (one.row.symbol, part)


def test_a_bare_hull():
    """No Munk moment in K_M and K_MY, which are mirror images, as are lift and side force; damping alike; no roll."""
    found = estimate(shape(wings=False, fin=False))
    t = totals(found)
    assert MUNK not in found.coefficients["K_M"].parts
    munk = found.munk[0]
    assert munk == pytest.approx(-found.munk[1], rel=1e-12)
    assert -0.5 * munk < t["K_M"].value < 0.0
    assert (t["K_M"].value, t["K_alpha"].value) == pytest.approx((-t["K_MY"].value, -t["K_beta"].value), rel=1e-12)
    assert t["K_q"] == t["K_r"]
    assert t["K_p"].value == t["K_MR"].value == t["K_L0"].value == t["K_M0"].value == 0.0
    assert any("bare hull" in line for line in found.warnings)


def test_what_the_vehicles_own_added_mass_does():
    """Another added mass moves K_M and K_MY alone, by what the model's Munk moments differ: the sums stay."""
    geometry = shape()
    own = added_mass(geometry).total()
    mass = (own.surge + 1.0, own.sway + 4.0, own.heave + 10.0)
    other = AddedMass(mass, (own.roll, own.pitch, own.yaw), own.yaw_from_sway, own.pitch_from_heave)
    one, two = totals(estimate(geometry)), totals(estimate(geometry, added=other))
    assert two["K_M"].value - one["K_M"].value == pytest.approx(-9.0, rel=1e-9)
    assert two["K_MY"].value - one["K_MY"].value == pytest.approx(3.0, rel=1e-9)
    assert {k: v for k, v in one.items() if k not in ("K_M", "K_MY")} == {
        k: v for k, v in two.items() if k not in ("K_M", "K_MY")
    }


def test_a_wings_moment_is_left_in_the_middle_of_its_chord():
    """Thin-airfoil theory: lift at a quarter of the chord is the added mass's moment and lift at half of it. Of an
    endless wing exactly; of one of A = 40, with hull's factor and section slope left out, within 6 %."""
    wing = Surface(
        plane="horizontal", semi_span=2.0, root_chord=0.1, tip_chord=0.1, root_position=0.05, tip_position=0.05
    )
    needle = HullShape(stations=(2.0, 0.0, -2.0), radii=(1e-4, 1e-4, 1e-4))
    geometry = Geometry("wing", "", "", needle, {"wing": wing}, centre_of_buoyancy=0.0)
    parts = estimate(geometry).coefficients["K_M"].parts
    assert parts["wing"].upper > 0.0
    whole = 2.0 * math.pi / 2.0 * 1025.0 * 0.4 * 0.025  # rho/2 S 2 pi c/4, of an endless wing
    assert -parts[MUNK].value == pytest.approx(whole, rel=0.06)


@pytest.mark.parametrize("scale", [0.5, 2.0])
def test_scale_at_one_reynolds_number(scale):
    """Lengths times n, the same speed, viscosity times n: forces n^2, moments n^3, damping n^4."""
    one = totals(estimate(shape()))
    two = totals(estimate(shape(scale), viscosity=PAPER_VISCOSITY * scale))
    powers = {"K_D0": 2, "K_D": 2, "K_beta": 2, "K_alpha": 2, "K_M": 3, "K_MY": 3, "K_p": 4, "K_q": 4, "K_r": 4}
    for symbol, power in powers.items():
        assert two[symbol].value == pytest.approx(one[symbol].value * scale**power, rel=1e-9), symbol


def test_speed():
    """Damping goes with one over the speed; forces across the flow do not know it; friction falls with it."""
    slow, fast = (totals(estimate(shape(), speed=speed)) for speed in (0.25, 0.5))
    for symbol in ("K_p", "K_q", "K_r"):
        assert slow[symbol].value == pytest.approx(2.0 * fast[symbol].value, rel=1e-12)
    assert slow["K_MR"] == fast["K_MR"]
    assert slow["K_D0"].value > fast["K_D0"].value


def test_damping_goes_with_the_arm_squared():
    """A fin far off the hull's flow, moved from 1.5 to 3 m behind: four times the damping, twice the moment; the centre
    of pressure stands a quarter of the chord before the middle, 0.025 m."""
    near, far = (estimate(shape(tail=-arm)).coefficients for arm in (1.5, 3.0))
    assert far["K_r"].parts["fin"].value == pytest.approx(4.0 * near["K_r"].parts["fin"].value, rel=1e-9)
    assert far["K_MY"].parts["fin"].value == pytest.approx(
        near["K_MY"].parts["fin"].value * (3.0 - 0.025) / (1.5 - 0.025), rel=1e-9
    )
    assert far["K_beta"].parts["fin"] == near["K_beta"].parts["fin"]


def test_a_fin_aft_turns_the_nose_into_the_flow():
    """Through the model with its Munk moment: a hull alone turns away from a flow that comes from starboard (beta > 0),
    one with a large fin aft turns to it, one with the fin ahead turns away all the more."""
    beta = math.radians(3.0)
    bare, aft, ahead = (
        moments(item, beta=beta)[2]
        for item in (shape(fin=False), shape(tail=-1.4, height=0.5), shape(tail=1.4, height=0.5))
    )
    assert aft > 0.0 > bare > ahead


def test_wings_aft_push_the_nose_down():
    """Likewise in pitch: with the flow from below (alpha > 0) the bare hull turns nose up, wings well aft turn it down."""
    wing = Surface(
        plane="horizontal", semi_span=0.6, root_chord=0.15, tip_chord=0.15, root_position=-0.8, tip_position=-0.8
    )
    aft = dataclasses.replace(shape(wings=False), surface={"wing": wing})
    alpha = math.radians(3.0)
    assert moments(aft, alpha=alpha)[1] < 0.0 < moments(shape(wings=False, fin=False), alpha=alpha)[1]


def test_turning_is_damped():
    """A turn to starboard meets a yaw moment to port, beyond what the added mass does by itself."""
    rate = 0.02
    geometry = shape(tail=-1.4)
    p = parameters(vehicle_of(geometry))._replace(rs=(0.0, 0.0, 0.0), rb=(0.0, 0.0, 0.0), Rr=0.0)
    level, controls = (0.0, 0.0, 1.0), Controls(0.0, 0.0, 0.0)
    with_it, without = (
        equilibrium(velocity_from_flow(SPEED, 0.0, 0.0), level, rate, controls, WATER, one)[5]
        for one in (p, p._replace(Kr=0.0))
    )
    assert with_it - without < 0.0


def test_a_fin_above_rolls_and_one_below_rolls_back():
    """Side force to port at a height above the axis rolls to port (T1 < 0), as K_MR of Table 3; its drag pitches up."""
    above, below = (totals(estimate(shape(sides=side))) for side in ("upper", "lower"))
    assert above["K_MR"].value < 0.0 < above["K_M0"].value
    assert above["K_MR"].value == pytest.approx(-below["K_MR"].value, rel=1e-12)
    assert above["K_M0"].value == pytest.approx(-below["K_M0"].value, rel=1e-12)
    assert moments(shape(sides="upper"), beta=0.05)[0] < 0.0


def test_a_large_fin_flies_straight():
    """With a large fin the estimated vehicle glides stably; without one its sideslip grows, by the Munk moment."""
    steady = {"net_buoyancy": 0.3, "mass_position": 0.4216, "mass_rotation": 0.0}
    stable, unstable = (trim(vehicle_of(one), **steady) for one in (shape(tail=-1.4, height=0.4), shape(fin=False)))
    assert all(mode.eigenvalue.real < 0.0 for mode in stable.modes())
    assert [mode.dominant for mode in unstable.modes() if mode.eigenvalue.real > 0.0] == ["sideslip"]


def test_drag_area_and_density():
    plain, more = estimate(shape()), estimate(shape(drag_area=0.004))
    assert totals(more)["K_D0"].value - totals(plain)["K_D0"].value == pytest.approx(1025.0 / 2.0 * 0.004, rel=1e-9)
    dense = totals(estimate(shape(density=1127.5), viscosity=1.1 * PAPER_VISCOSITY))  # the same Reynolds number
    for symbol, bounds in totals(plain).items():
        assert dense[symbol].value == pytest.approx(1.1 * bounds.value, rel=1e-9), symbol


@pytest.mark.parametrize("given", [{"speed": 0.0}, {"speed": -1.0}, {"speed": math.nan}, {"viscosity": 0.0},
    {"viscosity": math.inf}, {"angle": 0.0}, {"angle": 1.0}])  # fmt: skip
def test_numbers_that_no_estimate_can_be_made_for(given):
    with pytest.raises(InputError, match=rf"{next(iter(given))}: .* is not allowed"):
        estimate(shape(), **given)


def test_what_the_formulas_are_not_for_is_said():
    assert any("Reynolds number" in line for line in estimate(shape(), viscosity=0.1).warnings)
    ball = dataclasses.replace(shape(), hull=HullShape(length=0.5, diameter=0.4), surface={})
    assert any("1.2 times as long as thick" in line for line in estimate(ball).warnings)
    two = dataclasses.replace(
        shape(),
        surface={"wing": shape().surface["wing"], "stern": Surface(
            plane="horizontal", semi_span=0.3, root_chord=0.1, tip_chord=0.1, root_position=-0.8, tip_position=-0.8)},
    )  # fmt: skip
    assert any("wash" in line for line in estimate(two).warnings)
    assert any("drag_area" in line for line in estimate(load_geometry("seawing-estimated")[0]).warnings)


def test_remus_as_prestero_has_it():
    """Prestero (2001): handbook estimates of his own, brought to sea trials by hand, as public code quotes them; the ratios
    are those of docs/estimates.md, to their digits. Velocities there are in body axes, Munk's moment is in N_uv."""
    speed = 1.54
    found = estimate(remus(), speed, 1.05e-6 * remus().density, math.radians(0.01))
    t = totals(found)
    carried = added_mass(remus()).total().yaw_from_sway
    estimated = {
        "X_uu": -t["K_D0"].value, "Y_uv": t["K_beta"].value - t["K_D0"].value, "N_uv": t["K_MY"].value + found.munk[1],
        "N_ur": t["K_r"].value * speed - carried,
    }  # fmt: skip
    printed = {"X_uu": -1.62, "Y_uv": -28.6, "N_uv": -24.0, "N_ur": -2.0}
    ratios = {"X_uu": 1.12, "Y_uv": 1.19, "N_uv": 0.31, "N_ur": 6.2}
    for name, value in estimated.items():
        assert value / printed[name] == pytest.approx(ratios[name], rel=0.02), name
