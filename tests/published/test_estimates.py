"""Estimates against what others measured or computed; the ratios are those of docs/estimates.md.

SUBOFF is measured. Its numbers were at hand when the intervals of the hull's missing force and of surfaces on an
afterbody were set, so that they lie inside is no proof; how far the nominal values are off is.
"""

from __future__ import annotations

import dataclasses
import math

import pytest
from suboff import DENSITY, LENGTH, MEASURED, RESISTANCE, REYNOLDS, SPEED, WETTED, suboff

from glidercli import trim
from glidercli.coefficients.added.added_mass import added_mass
from glidercli.coefficients.base import read_base
from glidercli.coefficients.handbook.bounds import Bounds
from glidercli.coefficients.handbook.estimate import Estimated, estimate
from glidercli.coefficients.handbook.friction import wetted_area
from glidercli.coefficients.handbook.output import vehicle_text
from glidercli.coefficients.shape.geometry import load_geometry
from glidercli.vehicle import Vehicle, load_vehicle

HALF = DENSITY / 2.0

RATIOS = {
    "bare hull": {"Y_v": 2.43, "N_v": 0.74, "N_r": 1.38},
    "hull and sail": {"Y_v": 1.28, "N_v": 0.82, "N_r": 1.26},
    "hull and planes": {"Y_v": 1.88, "N_v": 0.64, "N_r": 1.01},
}
"""Estimate over measured, as docs/estimates.md tells it, to the digits printed there."""

SEAWING = {
    "K_D0": 0.70, "K_D": 1.29, "K_beta": 0.64, "K_alpha": 1.12, "K_p": 7.34, "K_M": 1.52, "K_q": 0.58, "K_MY": 1.76,
    "K_r": 0.71,
}  # fmt: skip
"""Estimate over Table 3, likewise."""


def at_test(configuration: str) -> Estimated:
    """At the model test's speed; slopes at the origin, as Roddy gives them."""
    shape = suboff(configuration)
    return estimate(shape, SPEED, shape.density * SPEED * LENGTH / REYNOLDS, math.radians(0.01))


def slopes(configuration: str) -> dict[str, Bounds]:
    """As Roddy has them: body axes, Munk's moment and what the added mass does in a turn with them."""
    found = at_test(configuration)
    t = {symbol: one.total for symbol, one in found.coefficients.items()}
    carried = added_mass(found.geometry).total().yaw_from_sway
    return {
        "Y_v": (t["K_beta"] + t["K_D0"].times(-1.0)).times(1.0 / (HALF * LENGTH**2)),
        "N_v": (t["K_MY"] + Bounds(*3 * (found.munk[1],))).times(1.0 / (HALF * LENGTH**3)),
        "N_r": (t["K_r"].times(SPEED) + Bounds(*3 * (-carried,))).times(1.0 / (HALF * LENGTH**4)),
    }


def test_suboffs_shape() -> None:
    """Printed wetted area 5.988 m2; the outline here has 120 stations."""
    assert wetted_area(suboff("bare hull").hull) == pytest.approx(WETTED, rel=5e-4)


def test_suboffs_resistance() -> None:
    """Measured 3.15e-3 on the wetted area at 1.2e7: friction line and form factor within 3 %."""
    drag = at_test("bare hull").coefficients["K_D0"].total.value
    assert drag / (HALF * WETTED) == pytest.approx(RESISTANCE, rel=0.03)


@pytest.mark.parametrize("configuration", MEASURED)
@pytest.mark.parametrize("name", ["Y_v", "N_v", "N_r"])
def test_suboffs_slopes(configuration: str, name: str) -> None:
    """The sign, the ratio that the docs tell (half a digit of it), and inside the interval."""
    found, measured = slopes(configuration)[name], MEASURED[configuration][name]
    assert found.value / measured == pytest.approx(RATIOS[configuration][name], abs=0.006)
    assert found.holds(measured)


def test_the_seawing() -> None:
    """The ratios to Table 3 that the docs tell, half a digit; zero where Table 3 has small numbers, and where it has not:
    K_MR."""
    geometry, _ = load_geometry("seawing-estimated")
    found = estimate(geometry, added=load_vehicle("seawing").added_mass)
    printed = dataclasses.asdict(load_vehicle("seawing").hydrodynamics)
    for symbol, one in found.coefficients.items():
        if symbol in SEAWING:
            assert one.total.value / printed[one.row.name] == pytest.approx(SEAWING[symbol], abs=0.006), symbol
        else:
            assert one.total.value == 0.0
    inside = [s for s, one in found.coefficients.items() if one.total.holds(printed[one.row.name])]
    assert inside == ["K_D", "K_L0", "K_alpha", "K_M0"]


def test_the_assumed_seawing_has_the_added_mass_that_it_was_made_for() -> None:
    """docs/coefficients.md: wings of 18.5 kg 0.195 m and fins of 2.20 kg 1.168 m behind; sizes have three digits."""
    strips = added_mass(load_geometry("seawing-estimated")[0]).strips
    wing, tail = strips["wing"], strips["tail"]
    assert (wing.heave, wing.pitch_from_heave / wing.heave) == pytest.approx((18.5, 0.195), rel=0.01)
    assert (tail.sway, -tail.yaw_from_sway / tail.sway) == pytest.approx((2.20, 1.168), rel=0.01)


def test_round_trip(tmp_path, seawing: Vehicle) -> None:  # type: ignore[no-untyped-def]
    """The Seawing with estimates in place of Table 3 glides straight, stably, 25 % faster and 2.6 deg steeper; both are
    told in the docs. With the mass turned it does not spiral as the paper's does: the turn is small, the other way."""
    base = read_base("seawing")
    geometry, _ = load_geometry("seawing-estimated")
    path = tmp_path / "est.toml"
    path.write_text(vehicle_text(estimate(geometry, added=base.added_mass), base, "est")[0], encoding="utf-8")
    made = load_vehicle(path)
    assert (made.mass, made.added_mass, made.actuators) == (seawing.mass, seawing.added_mass, seawing.actuators)
    controls = {"net_buoyancy": 0.3, "mass_position": 0.4216}
    theirs, own = (trim(vehicle, mass_rotation=0.0, **controls) for vehicle in (seawing, made))
    assert own.stable
    assert own.speed / theirs.speed == pytest.approx(1.245, abs=0.006)
    steeper = own.document()["glide_angle_deg"] - theirs.document()["glide_angle_deg"]
    assert steeper == pytest.approx(2.64, abs=0.06)
    assert abs(trim(made, mass_rotation=math.pi / 4, **controls).document()["yaw_rate_deg_s"]) < 0.05
