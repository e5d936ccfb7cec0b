"""The scalar equations of the paper against the vector form (28), (29), and each solved form against its equation."""

from __future__ import annotations

import math

import pytest
from conftest import WORKED_EXAMPLE
from hypothesis import given
from hypothesis import strategies as st

import glidercli
from glidercli.frames import dot, down_in_body
from glidercli.model.equations import equilibrium
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.mass import movable_position
from glidercli.model.parameters import Controls, parameters, without_coupling
from glidercli.ocean.water import Water
from glidercli.trim.printed import printed_recursions
from glidercli.trim.scalar import (
    Spiral,
    eq35,
    eq36,
    eq37,
    eq39,
    eq40,
    eq41,
    eq42,
    eq45,
    eq46,
    eq47,
    eq49,
    gamma_from_40,
    rrx_from_37,
)
from glidercli.vehicle import load_vehicle

P = without_coupling(parameters(load_vehicle("seawing")))
WATER = Water(P.rho_0, 0.0, P.T_0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.81)
ROUND_OFF = 1e-12  # dozens of operations on terms of up to 100 N and N m

SPIRALS = st.builds(
    Spiral,
    V=st.floats(0.05, 1.0), alpha=st.floats(-0.2, 0.2), beta=st.floats(-0.2, 0.2), theta=st.floats(-1.2, 1.2),
    phi=st.floats(-1.2, 1.2), mb=st.floats(-0.5, 0.5), gamma=st.floats(-1.57, 1.57), omega3=st.floats(-0.3, 0.3),
    rrx=st.floats(0.35, 0.45), g=st.just(9.81),
)  # fmt: skip


@given(SPIRALS)
def test_each_is_its_part_of_the_vector_form(x: Spiral) -> None:
    c = Controls(x.rrx, x.gamma, x.mb)
    six = equilibrium(velocity_from_flow(x.V, x.alpha, x.beta), down_in_body(x.phi, x.theta), x.omega3, c, WATER, P)
    assert eq35(x, P) == pytest.approx(six[0], abs=ROUND_OFF)
    assert eq36(x, P) == pytest.approx(six[1], abs=ROUND_OFF)
    assert eq37(x, P) == pytest.approx(six[4], abs=ROUND_OFF)
    assert eq40(x, P) == pytest.approx(dot(six[3:], movable_position(c, P)), abs=ROUND_OFF)


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("degrees", [-70, -20, 20, 45, 70])
def test_each_solved_form_stands_still_at_a_trim(way: int, degrees: int) -> None:
    t = glidercli.trim(
        net_buoyancy=0.3 * way,
        mass_position=0.4016 + 0.02 * way,
        mass_rotation=math.radians(degrees),
        equations="paper",
    )
    x = Spiral(
        t.speed, t.angle_of_attack, t.sideslip, t.pitch, t.roll, t.net_buoyancy, t.mass_rotation, t.yaw_rate,
        t.mass_position,
    )  # fmt: skip
    solved = {
        "theta": eq45, "phi": eq46, "gamma": eq47, "rrx": eq49, "mb": eq41, "omega3": eq42,
    }  # fmt: skip
    for name, equation in solved.items():
        assert equation(x, P) == pytest.approx(getattr(x, name), abs=1e-10), name  # the trim's own residual, magnified
    assert eq39(x, P) == pytest.approx(x.omega3, abs=1e-10)
    assert rrx_from_37(x, P) == pytest.approx(x.rrx, abs=1e-10)
    assert gamma_from_40(x, P) == pytest.approx(x.gamma, abs=1e-10)


def test_the_term_that_is_not_printed_matters() -> None:
    t = glidercli.trim(**WORKED_EXAMPLE, equations="paper")
    x = Spiral(
        t.speed, t.angle_of_attack, t.sideslip, t.pitch, t.roll, t.net_buoyancy, t.mass_rotation, t.yaw_rate,
        t.mass_position,
    )  # fmt: skip
    assert abs(eq49(x, P, restored=False) - x.rrx) > 1e-4  # 0.3 mm of the 20 mm that steer pitch


def test_as_printed_the_worked_example_is_not_found() -> None:
    t = glidercli.trim(**WORKED_EXAMPLE, equations="paper")
    sequences = printed_recursions(t.speed, t.angle_of_attack, t.sideslip, 0.4016, WATER, P)
    assert len(sequences) == 4
    assert not any(one.converged for one in sequences)
