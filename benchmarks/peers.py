"""How does the simulator stand beside another? The same four half-yos by gliderflight's dynamic model.

gliderflight solves two states, the horizontal and the vertical speed, with the pitch given; it gets the depth, pitch
and buoyancy that this simulator flew. It is MIT and no dependency of this project: pip install gliderflight, then
python benchmarks/peers.py. One core each; medians of the runs.
"""

from __future__ import annotations

import importlib.util
import statistics
import time

import numpy as np
from simulate import DURATION, case, half_yos

from glidercli.frames import euler_from_quaternion_arrays
from glidercli.simulation.flight import Flight, fly

RUNS = 5


def gliderflight(flight: Flight) -> float:
    """Simulated seconds per second of gliderflight's dynamic model."""
    from gliderflight import DynamicGliderModel

    quaternions = np.column_stack([flight.column(f"q_{axis}") for axis in "wxyz"])
    data = {
        "time": flight.times,
        "pressure": flight.column("pressure") / 1e5,  # bar
        "pitch": euler_from_quaternion_arrays(quaternions)[1],
        "buoyancy_change": -flight.column("net_buoyancy") / 1026.0 * 1e6,  # cm3
        "density": flight.column("density"),
    }
    walls = []
    for _ in range(RUNS):
        model = DynamicGliderModel(dt=1.0, rho0=1026.0, k1=0.02, k2=0.92, max_CPUs=1)
        model.define(mg=65.28, Vg=65.28 / 1026.0, Cd0=0.15)
        began = time.perf_counter()
        model.solve(dict(data))
        walls.append(time.perf_counter() - began)
    return float(flight.times[-1]) / statistics.median(walls)


def main() -> None:
    p, sea = case()
    flights = [fly(half_yos(), sea, p, duration=DURATION) for _ in range(RUNS)]
    exact = fly(half_yos(), sea, p, duration=DURATION, rtol=1e-11)
    ours = float(flights[0].times[-1]) / statistics.median(flight.wall for flight in flights)
    error = float(np.linalg.norm(flights[0].samples[-1, :3] - exact.samples[-1, :3]))
    print(f"{'this simulator, 12 states':<32}{ours:12,.0f} simulated s/s, {error:.1e} m from rtol 1e-11")
    if importlib.util.find_spec("gliderflight") is None:
        print("gliderflight is not installed")
        return
    theirs = gliderflight(flights[0])
    print(f"{'gliderflight, 2 states':<32}{theirs:12,.0f} simulated s/s; this simulator {ours / theirs:.0f} times")


if __name__ == "__main__":
    main()
