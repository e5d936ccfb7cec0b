"""Zhang et al. (2013), Tables 1 and 3, against the shipped Seawing: every number, its unit, its source."""

from __future__ import annotations

import math
import tomllib

import pytest
from conftest import ROOT

from glidercli.model import Parameters
from glidercli.vehicle import Vehicle

TABLES = {
    "ms": 54.28, "rs": (-0.0814, 0.0, 0.0032), "Is": (0.60, 15.27, 15.32), "mr": 11.0, "Rr": 0.014,
    "Ir0": (0.02, 0.16, 0.17), "rb": (0.0, 0.0, 0.0), "MA": (1.48, 49.58, 65.92), "IA": (0.53, 7.88, 10.18),
    "Nv": 2.57, "Mw": 3.61, "KD0": 7.19, "KD": 386.29, "Kbeta": -115.65, "KL0": -0.36, "Kalpha": 440.99,
    "KMR": -58.27, "Kp": -19.83, "KM0": 0.28, "KM": -65.84, "Kq": -205.64, "KMY": 34.10, "Kr": -389.30,
    "rho_ref": 1025.0,
}  # fmt: skip


@pytest.mark.parametrize("symbol", TABLES)
def test_every_number(p: Parameters, symbol: str) -> None:
    assert getattr(p, symbol) == TABLES[symbol]


def test_limits(seawing: Vehicle) -> None:
    a = seawing.actuators
    assert (a.mass_position.minimum, a.mass_position.maximum) == (0.3516, 0.4516)
    assert (a.net_buoyancy.minimum, a.net_buoyancy.maximum) == (-0.5, 0.5)
    assert (a.mass_rotation.minimum, a.mass_rotation.maximum) == (-math.pi / 2, math.pi / 2)
    assert (seawing.hull.length, seawing.hull.diameter) == (1.99, 0.22)


def test_neutral_and_level_at_nominal(seawing: Vehicle) -> None:
    m = seawing.mass
    assert m.static_mass + m.movable_mass == pytest.approx(m.displaced_mass, rel=1e-12)  # a sum of printed digits
    moment = m.static_mass * m.static_position[0] + m.movable_mass * seawing.actuators.mass_position.nominal
    assert abs(moment) < 0.5e-4 * (m.static_mass + m.movable_mass)  # half a printed digit of each position


def test_every_number_has_unit_and_source_and_restored_signs_a_reason() -> None:
    tables = tomllib.loads((ROOT / "glidercli/vehicle/data/seawing.toml").read_text())
    entries = []

    def walk(node: object, path: str) -> None:
        if isinstance(node, dict):
            if "value" in node:
                entries.append((path, node))
            else:
                for key, item in node.items():
                    walk(item, f"{path}.{key}")

    walk(tables, "")
    assert len(entries) >= 30
    for path, entry in entries:
        assert entry["unit"], path
        assert entry["source"], path
    reasons = {path for path, entry in entries if "restored" in entry}
    for name in ("side_sideslip", "lift_zero", "roll_sideslip", "roll_rate", "pitch_attack", "pitch_rate", "yaw_rate"):
        assert f".hydrodynamics.{name}" in reasons
    assert ".mass.movable_inertia" in reasons
    assert ".mass.static_position" in reasons
