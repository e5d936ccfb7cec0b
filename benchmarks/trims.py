"""How long does a trim take, and how long a peer's? Side by side on the same machine, as ratios; two minutes.

Run: python benchmarks/trims.py [--peer PYTHON], PYTHON being an interpreter that has jsbsim (pip install jsbsim in an
environment of its own). JSBSim trims and linearises an aircraft of its own, the Cessna 172: another model, the same
question. What is compared is what a user waits for.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import glidercli
from glidercli.trim import Trim, trims
from glidercli.vehicle import load_vehicle

GLIDER = str(Path(sys.executable).with_name("glider"))
CONTROLS = {"net_buoyancy": 0.3, "mass_position": 0.4216, "mass_rotation": math.radians(45.0)}
WANTED = {"speed": 0.49, "pitch": math.radians(-35.0), "turning_radius": 100.0}
MAPS = {
    "map of 100,122 trims from the controls": (
        "--sweep", "mass-rotation=0:90:0.2", "--sweep", "net-buoyancy=0.1:0.4985:0.0018", "--mass-position", "0.4216",
    ),
    "map of 100,651 from speed, pitch, radius": (
        "--speed", "0.45", "--sweep", "pitch=-60:-20:0.1", "--sweep", "turning-radius=40:290:1",
    ),
}  # fmt: skip
PEER = """
import json, os, statistics, sys, tempfile, time
import jsbsim
os.chdir(tempfile.mkdtemp())
fdm = jsbsim.FGFDMExec(None)
fdm.set_debug_level(0)
fdm.load_model("c172x")
fdm["ic/h-sl-ft"], fdm["ic/vc-kts"] = 4000, 100
times = []
for _ in range(30):
    fdm.run_ic()
    fdm["propulsion/set-running"] = -1
    began = time.perf_counter()
    fdm.do_trim(1)
    times.append(time.perf_counter() - began)
began = time.perf_counter()
jsbsim.FGLinearization(fdm)
linearised = time.perf_counter() - began
print("RESULT " + json.dumps([jsbsim.__version__, statistics.median(times), linearised]))
"""


def median(function: Callable[[], object], repeats: int, calls: int) -> float:
    """Median seconds of a call, over repeats of so many calls."""
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        for _ in range(calls):
            function()
        times.append((time.perf_counter() - began) / calls)
    return statistics.median(times)


def whole(options: tuple[str, ...], cache: str | None = None) -> float:
    """Seconds of ``glider trim`` as a whole process, its table written to a file."""
    with tempfile.TemporaryDirectory() as folder:
        command = [GLIDER, "trim", *options, "--quiet", "-o", f"{folder}/map.csv"]
        environment = {**os.environ, **({"GLIDER_CACHE_DIR": cache} if cache else {})}
        began = time.perf_counter()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
        return time.perf_counter() - began


def peer(python: str) -> tuple[str, float, float] | None:
    """JSBSim's version, seconds of a trim and of a linearisation; None where that Python has none."""
    done = subprocess.run([python, "-c", PEER], capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
    return tuple(json.loads(lines[-1].removeprefix("RESULT "))) if lines else None


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--peer", default=sys.executable)
    vehicle = load_vehicle("seawing")

    def forward() -> Trim:
        return glidercli.trim(vehicle, **CONTROLS)

    def inverse() -> list[Trim]:
        return trims(vehicle, **WANTED)

    print(f"{'':<46}{'ms':>10}")
    print(f"{'one trim from the controls, plain code':<46}{1e3 * median(forward, 5, 10):>10.3f}")
    for _ in range(60):
        forward()  # compiled from the 101st call on
    warm = median(forward, 15, 100)
    print(f"{'one trim from the controls, after start-up':<46}{1e3 * warm:>10.3f}")
    one = forward()
    linear = median(one.modes, 15, 50)
    print(f"{'its modes, from the linear model that it holds':<46}{1e3 * linear:>10.3f}")
    print(f"{'one trim from speed, pitch, turning radius':<46}{1e3 * median(inverse, 5, 1):>10.1f}")
    other = peer(parser.parse_args().peer)
    if other is None:
        print("JSBSim: not there; pip install jsbsim in an environment of its own, and name it with --peer")
    else:
        version, trimmed, linearised = other
        print(f"{f'JSBSim {version}, trim of its Cessna 172':<46}{1e3 * trimmed:>10.3f}   x {trimmed / warm:,.0f}")
        ratio = linearised / (warm + linear)
        print(f"{'JSBSim, linearisation':<46}{1e3 * linearised:>10.1f}   x {ratio:,.0f} of a trim with its modes")
    print(f"\n{'whole processes':<46}{'s':>10}{'us a trim':>12}")
    for name, options in MAPS.items():
        count = int(name.split()[2].replace(",", ""))
        with tempfile.TemporaryDirectory() as cache:
            first = whole(options, cache)
            later = statistics.median(whole(options, cache) for _ in range(3))
        print(f"{name:<46}{later:>10.2f}{1e6 * later / count:>12.1f}   the first run, that compiles: {first:.1f} s")


if __name__ == "__main__":
    main()
