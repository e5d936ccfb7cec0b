"""How fast and how exact is the simulator? Four half-yos from rest in stratified water with a current of 60 knots.

Each tolerance is set against the same flight at 1e-11: simulated seconds per second of integration, calls of the
right-hand side per simulated second, and how far the end lies from that flight's. Run: python benchmarks/simulate.py
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from glidercli.model import Parameters, parameters
from glidercli.ocean import Ocean, Sea
from glidercli.ocean.current import CurrentProfile
from glidercli.ocean.profile import pchip
from glidercli.simulation.flight import Flight, fly
from glidercli.simulation.legs import Leg
from glidercli.units import DBAR
from glidercli.vehicle import load_vehicle

DURATION = 6000.0  # s
RUNS = 7


def half_yos() -> list[Leg]:
    """Down to 400 m and up to 50 m, turned over in 20 s, the mass rotated by 45 deg; the last goes on to the end."""
    legs = []
    for number in range(4):
        sign = 1.0 if number % 2 == 0 else -1.0
        before = -sign if number else 0.0
        controls = [[0.4016 + 0.02 * s, math.radians(45.0), 0.3 * s] for s in (before, sign)]
        controls[0][2] = controls[0][2] or 0.3
        until = math.nan if number == 3 else 400.0 if sign > 0 else 50.0
        legs.append(Leg(f"half-yo {number + 1}", np.array([0.0, 20.0]), np.array(controls), until))
    return legs


def case() -> tuple[Parameters, Sea]:
    """The vehicle and the sea of the benchmark."""
    p = parameters(load_vehicle("seawing"))._replace(rho_0=1026.0, kappa=4e-10)
    depth = np.linspace(0.0, 800.0, 60)
    wobble = np.random.default_rng(1).normal(scale=0.03, size=(2, 60))
    east, north = 0.3 * np.sin(depth / 90.0) + wobble[0], 0.2 * np.cos(depth / 120.0) + wobble[1]
    current = CurrentProfile(depth, east, north, np.zeros(60), Path("made"), dropped=(), warnings=())
    levels = np.linspace(0.0, 1000.0, 101)
    density = 1024.0 + 3.0 * np.tanh(levels / 150.0) + 0.0045 * levels
    still = Ocean.build(1026.0, currents=current, temperature_reference=15.0)
    water = pchip(levels, np.column_stack([density, levels * DBAR, np.full(101, 15.0)]))
    return p, Sea(water, still.current, still.gravity)


def main() -> None:
    p, sea = case()

    def flown(rtol: float) -> Flight:
        return fly(half_yos(), sea, p, duration=DURATION, rtol=rtol)

    exact = flown(1e-11)
    print(f"{'rtol':>6} {'simulated s/s':>14} {'calls per s':>12} {'error at the end':>17}")
    for rtol in (1e-4, 1e-5, 1e-6, 1e-7, 1e-8):
        runs = [flown(rtol) for _ in range(RUNS)]
        wall = sorted(run.wall for run in runs)[RUNS // 2]
        error = float(np.linalg.norm(runs[0].samples[-1, :3] - exact.samples[-1, :3]))
        time = float(runs[0].times[-1])
        print(f"{rtol:6.0e} {time / wall:14,.0f} {runs[0].evaluations / time:12.1f} {error:15.1e} m")


if __name__ == "__main__":
    main()
