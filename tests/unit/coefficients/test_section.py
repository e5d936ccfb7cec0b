"""The section of hull and fins against closed forms and a panel method of its own."""

import numpy as np
import pytest

from glidercli.coefficients.added.section import section


def test_closed_forms():
    circle, plate, half = section([0.3, 0.0, 0.0], [0.3, 0.7, 0.7], [0.3, 0.7, 0.0]).across
    assert circle == pytest.approx(np.pi * 0.3**2, rel=1e-14)
    assert plate == pytest.approx(np.pi * 0.7**2, rel=1e-14)
    assert half == pytest.approx(np.pi * 0.35**2, rel=1e-14)
    a, t = 0.3, np.array([0.31, 0.5, 2.0])  # Nielsen, Missile Aerodynamics (1960): circle with a pair of fins
    assert section(a, t, t).across == pytest.approx(np.pi * (t**2 - a**2 + a**4 / t**2), rel=1e-14)


def test_turning_of_plates():
    """A plate of half-length t about its middle, pi t^4/8 (Lamb art. 71); one of length t about its end adds
    its mass times (t/2)^2, and couples by its mass times t/2."""
    t = 0.7
    middle, end = (section(0.0, t, other) for other in (t, 0.0))
    assert middle.turning[0] == pytest.approx(np.pi * t**4 / 8.0, rel=1e-12)
    assert middle.coupling[0] == pytest.approx(0.0, abs=1e-12)
    mass = np.pi * (t / 2.0) ** 2
    assert end.turning[0] == pytest.approx(np.pi * (t / 2.0) ** 4 / 8.0 + mass * (t / 2.0) ** 2, rel=1e-12)
    assert end.coupling[0] == pytest.approx(mass * t / 2.0, rel=1e-12)
    assert section(0.4, 0.4, 0.4).turning[0] == pytest.approx(0.0, abs=1e-12)  # a circle turns freely


def panels(outline):
    """Added mass of moving along n, of turning, and their coupling, of a closed outline (s, n), anticlockwise: constant
    sources on straight panels, the potential at their middles."""
    p, q = outline, np.roll(outline, -1, axis=0)
    middle, along = (p + q) / 2.0, q - p
    length = np.linalg.norm(along, axis=1)
    tangent = along / length[:, None]
    normal = np.column_stack([tangent[:, 1], -tangent[:, 0]])
    d = middle[:, None] - p[None]
    x = (d * tangent[None]).sum(-1)
    y = (d * normal[None]).sum(-1)
    r1, r2 = x**2 + y**2, (x - length) ** 2 + y**2
    angle = np.arctan2(y, x - length) - np.arctan2(y, x)
    angle[np.diag_indices(len(p))] = np.pi
    u, v = 0.5 * np.log(r1 / r2), angle
    flow = u * (tangent[None] * normal[:, None]).sum(-1) + v * (normal[None] * normal[:, None]).sum(-1)
    potential = 0.5 * (x * np.log(r1) - (x - length) * np.log(r2)) - length + y * angle
    turn = middle[:, 0] * normal[:, 1] - middle[:, 1] * normal[:, 0]
    wanted = np.column_stack([normal[:, 1], turn])
    phi = potential @ np.linalg.solve(flow, wanted)
    return -(phi * length[:, None]).T @ wanted


def outline(a, one, other, thin, count):
    """A circle with fins of half thickness ``thin`` at the root that run out to nothing; ``count`` points on a fin."""
    root = np.arcsin(thin / a)
    t = (1.0 - np.cos(np.linspace(0.0, np.pi, count))) / 2.0

    def upper(tip):
        return np.column_stack(
            [a * np.cos(root) + (tip - a * np.cos(root)) * t, thin * np.sqrt(np.maximum(1.0 - t, 0.0))]
        )

    def arc(start, end):
        angle = np.linspace(start, end, 2 * count)
        return a * np.column_stack([np.cos(angle), np.sin(angle)])

    right = [upper(one)[::-1], upper(one) * [1.0, -1.0]]  # from the tip back to the circle, and out again below
    if not other > a:
        parts = [right[0], arc(root, 2.0 * np.pi - root), right[1]]
    else:
        left = upper(other) * [-1.0, 1.0]
        back = [left, left[::-1] * [1.0, -1.0]]
        parts = [right[0], arc(root, np.pi - root), *back, arc(np.pi + root, 2.0 * np.pi - root), right[1]]
    return np.vstack([part[:-1] for part in parts])


@pytest.mark.parametrize(("one", "other"), [(0.8, 0.8), (0.8, 0.3), (0.9, 0.5)])
def test_a_panel_method_agrees(one, other):
    """Extrapolated from two numbers of panels the method is right to some 1 %, and fins of 2 % thickness at the root
    are not quite flat: 2 %."""
    a = 0.3
    found = section(a, one, other)
    coarse, fine = (panels(outline(a, one, other, 0.01, count)) for count in (100, 200))
    wanted = 2.0 * fine - coarse
    assert found.across[0] == pytest.approx(wanted[0, 0], rel=0.02)
    assert found.turning[0] == pytest.approx(wanted[1, 1], rel=0.02)
    assert found.coupling[0] == pytest.approx(wanted[0, 1], rel=0.02, abs=1e-9)
