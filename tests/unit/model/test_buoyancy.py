"""Net buoyancy in measured water, by hand: density, compression, thermal expansion, and the pumped volume."""

from __future__ import annotations

import pytest

from glidercli.model import Parameters
from glidercli.model.buoyancy import displaced_mass, hull_excess, pumped_excess

RHO_0 = 1025.0


def test_neutral_at_the_reference(p: Parameters) -> None:
    assert hull_excess(RHO_0, 0.0, p.T_0, p) == 0.0
    assert pumped_excess(0.3, RHO_0, p) == 0.3


def test_denser_water_takes_nearly_all_that_the_pump_gives(p: Parameters) -> None:
    """0.7 % of 65.28 kg is 0.457 kg of 0.5 kg."""
    assert hull_excess(1.007 * RHO_0, 0.0, p.T_0, p) == pytest.approx(-0.007 * 65.28, rel=1e-12)  # rounding


def test_a_soft_hull_keeps_weight_with_pressure(p: Parameters) -> None:
    """4e-6 per dbar at 800 dbar: 0.32 % of the hull's volume, 0.209 kg."""
    soft = p._replace(kappa=4e-6 / 1e4)
    assert hull_excess(RHO_0, 800e4, p.T_0, soft) == pytest.approx(65.28 * 0.0032, rel=1e-12)


def test_a_warm_hull_floats(p: Parameters) -> None:
    assert hull_excess(RHO_0, 0.0, p.T_0 + 10.0, p._replace(chi=5e-5)) == pytest.approx(-65.28 * 5e-4, rel=1e-12)


def test_archimedes(p: Parameters) -> None:
    """Displaced mass = density x (hull volume + pumped volume), and weight less it is the excess."""
    density, pressure, mb = 1030.0, 500e4, 0.4
    soft = p._replace(kappa=4e-10)
    volume = (65.28 / RHO_0) * (1.0 - 4e-10 * pressure) - mb / RHO_0
    displaced = displaced_mass(mb, density, pressure, p.T_0, soft)
    assert displaced == pytest.approx(density * volume, rel=1e-12)
    excess = hull_excess(density, pressure, p.T_0, soft) + pumped_excess(mb, density, soft)
    assert 65.28 - displaced == pytest.approx(excess, abs=1e-12)
