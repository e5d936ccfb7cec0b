"""The recursion gives back the controls of a trim from speed, angle of attack and sideslip alone."""

from __future__ import annotations

import itertools
import math

import pytest

import glidercli
from glidercli.errors import NoSolutionError
from glidercli.frames import add, cross, dot, scale
from glidercli.model import Parameters
from glidercli.model.equations import equilibrium
from glidercli.model.hydrodynamics import forces_and_moments, velocity_from_flow
from glidercli.model.mass import first_moment, momentum
from glidercli.model.parameters import Controls, without_coupling
from glidercli.ocean.water import Water
from glidercli.trim import Trim, trims_by_recursion
from glidercli.trim.recursion import Iterate, Recursion, gravity_and_buoyancy, mass_placement, turning_rate

WATER = Water(1025.0, 0.0, 15.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.81)
V = velocity_from_flow(0.49, math.radians(1.27), math.radians(-1.28))
STILL = (0.0, 0.0, 0.0)
ROUND_OFF = 1e-12  # a few operations on forces and moments of some N


def distance(a: Trim, b: Trim) -> float:
    """Largest difference of the controls: kg, m, rad."""
    return max(
        abs(a.net_buoyancy - b.net_buoyancy), abs(a.mass_position - b.mass_position),
        abs(a.mass_rotation - b.mass_rotation),
    )  # fmt: skip


@pytest.mark.parametrize("quadrant", list(itertools.product((1, -1), (1, -1))))
def test_every_point_of_the_four_quadrants_is_recovered(quadrant: tuple[int, int]) -> None:
    """The root solver, which works on the equations as a whole, makes the points: another way to the same six zeros."""
    way, turn = quadrant
    for degrees, mb, offset in itertools.product((2, 23, 45, 67, 88), (0.1, 0.3, 0.5), (0.005, 0.02, 0.048)):
        point = glidercli.trim(
            net_buoyancy=way * mb, mass_position=0.4016 + way * offset, mass_rotation=math.radians(turn * degrees),
            equations="paper",
        )  # fmt: skip
        found = trims_by_recursion(speed=point.speed, angle_of_attack=point.angle_of_attack, sideslip=point.sideslip)
        assert all(one.residual < 1e-9 for one in found)  # none is silently wrong
        best = min(found, key=lambda one: distance(one, point))
        assert distance(best, point) < 1e-6, (degrees, mb, offset)  # the figure
        assert best.iterations <= 25
        if point.stable:
            assert found[0] is best, (degrees, mb, offset)


def test_each_step_solves_its_own_equation(p: Parameters) -> None:
    """Force balance, moment about the vertical, whole moment: what each step is to bring to zero, written out anew."""
    q = without_coupling(p)
    before = Iterate((0.5, -0.2, math.sqrt(0.71)), 0.3, 0.004, 0.7, 0.42, True)
    c = Controls(before.rrx, before.gamma, before.mb)
    s = first_moment(c, q)
    u, _ = momentum(V, STILL, c, 1.0, q)
    F, _ = forces_and_moments(V, STILL, 1.0, q)

    k_b, mb = gravity_and_buoyancy(F, u, s, before, 1, WATER)
    turning = add(
        scale(before.omega3, cross(u, k_b)), scale(-(before.omega3**2), cross(cross(s, before.k_b), before.k_b))
    )
    force = add(add(turning, scale(mb * 9.81, k_b)), F)
    assert max(map(abs, force)) < ROUND_OFF
    assert dot(k_b, k_b) == pytest.approx(1.0, abs=ROUND_OFF)

    omega3 = turning_rate(V, k_b, c, WATER, q)
    Omega = scale(omega3, k_b)
    P, Pi = momentum(V, Omega, c, 1.0, q)
    _, T = forces_and_moments(V, Omega, 1.0, q)
    assert abs(dot(add(cross(P, V), T), k_b)) < ROUND_OFF

    for root in (1, -1):
        gamma, rrx, met = mass_placement(V, k_b, mb, omega3, c, root, WATER, q)
        assert met
        placed = first_moment(Controls(rrx, gamma, mb), q)
        moment = add(add(cross(Pi, Omega), cross(P, V)), add(T, scale(9.81, cross(placed, k_b))))
        assert max(map(abs, moment)) < ROUND_OFF


def test_a_straight_glide_by_both_routes() -> None:
    glide = glidercli.trim(net_buoyancy=0.3, mass_position=0.4216, mass_rotation=0.0, equations="paper")
    found = trims_by_recursion(speed=glide.speed, angle_of_attack=glide.angle_of_attack, sideslip=0.0)
    assert found[0].yaw_rate == 0.0
    assert distance(found[0], glide) < 1e-9  # Newton stops at 1e-11 of the weight
    assert found[0].pitch == pytest.approx(glide.pitch, abs=1e-9)


def test_the_twin_is_inverted(p: Parameters) -> None:
    """(k_b, omega_3, m_b) to their negatives leaves (28) and (39) as they are: two families, one of them on its back."""
    sequences: list[Recursion] = []
    found = trims_by_recursion(
        speed=0.49, angle_of_attack=math.radians(1.27), sideslip=math.radians(-1.28), look=sequences.extend
    )
    assert len(found) == 4
    assert {math.copysign(1.0, one.net_buoyancy) for one in found} == {1.0, -1.0}
    for one in sequences:
        six = equilibrium(V, one.last.k_b, one.last.omega3, one.controls, WATER, without_coupling(p))
        assert max(map(abs, six)) < ROUND_OFF


def test_no_mass_can_hold_some_flows() -> None:
    with pytest.raises(NoSolutionError, match=r"roll moment \(29\) stays furthest from zero"):
        trims_by_recursion(speed=0.49, angle_of_attack=0.02, sideslip=0.7)
