"""The simulator settles on the trim; and how far the paper's equations are from the whole model."""

from __future__ import annotations

import itertools
import math

import pytest

import glidercli
from glidercli.trim import trims

NOMINAL = 0.4016
QUADRANTS = list(itertools.product((1, -1), (1, -1)))
DEEP = 12_000.0  # m; a climb must not reach the surface


def points(way: int, turn: int) -> list[dict[str, float]]:
    """Controls over a quadrant, SI and rad."""
    return [
        {
            "net_buoyancy": way * mb,
            "mass_position": NOMINAL + way * offset,
            "mass_rotation": turn * math.radians(degrees),
        }
        for degrees, mb, offset in itertools.product((2, 45, 88), (0.1, 0.5), (0.005, 0.02, 0.048))
    ]


@pytest.mark.parametrize(("way", "turn"), QUADRANTS)
def test_the_simulator_settles_on_the_stable_trim(way: int, turn: int) -> None:
    for controls in points(way, turn):
        trim = next(one for one in trims(**controls) if one.stable)
        seconds = min(max(40.0 / -trim.growth_rate, 1000.0), 12_000.0)  # e^-40 of the start is left, or rounding
        flight = glidercli.simulate(**controls, start_depth=DEEP, duration=seconds, every=seconds)
        final, wanted = flight.document()["final"], trim.document()
        assert final["speed_through_water_m_s"] == pytest.approx(wanted["speed_m_s"], rel=1e-6), controls
        for name in ("angle_of_attack_deg", "sideslip_deg", "roll_deg", "pitch_deg", "vertical_speed_m_s"):
            # 1e-6 is the figure; angles below a degree are held to 1e-6 of a degree
            assert final[name] == pytest.approx(wanted[name], rel=1e-6, abs=1e-6), (controls, name)


@pytest.mark.parametrize(("way", "turn"), QUADRANTS)
def test_the_papers_five_percent(way: int, turn: int) -> None:
    """The paper: "within 5 % of the simulation results based on the full glider dynamics"; docs/trim.md has the table."""
    for controls in points(way, turn):
        full, paper = (trims(**controls, equations=form)[0] for form in ("full", "paper"))
        assert paper.speed == pytest.approx(full.speed, rel=0.05)
        assert paper.roll == pytest.approx(full.roll, rel=0.05)
        assert paper.pitch == pytest.approx(full.pitch, rel=0.05, abs=math.radians(1.0))  # it passes zero in climbs
        # with eq. (33) a tight climb is up to 10.8 % off; as horizontal speed over yaw rate 5.2 % at most, in dives
        helix = [one.horizontal_speed / one.yaw_rate for one in (full, paper)]
        assert helix[1] == pytest.approx(helix[0], rel=0.053)
