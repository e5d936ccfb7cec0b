"""Start-up as whole processes, side by side with Python alone: ratios, not timed tests.

Run: python benchmarks/startup.py [RUNS]. Targets: --help within 0.25 s, one trim within 0.5 s, the whole trial within
1.5 s, and within 12 s where it must be compiled first; one trim imports neither scipy.optimize nor numba.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

GLIDER = str(Path(sys.executable).with_name("glider"))
TRIM = ["trim", "--net-buoyancy", "0.3", "--mass-position", "0.4216", "--mass-rotation", "45"]
TRIAL = ["simulate", "south-china-sea-2011", "--json", "--quiet"]
FIRST_RUNS = 3
COMMANDS = {
    "python -c pass": [sys.executable, "-c", "pass"],
    "glider --help": [GLIDER, "--help"],
    "glider trim": [GLIDER, *TRIM],
    "glider simulate south-china-sea-2011": [GLIDER, *TRIAL],
    "python -c 'import scipy.optimize, typer'": [sys.executable, "-c", "import scipy.optimize, typer"],
}
IMPORTED = """
import sys
import glidercli
glidercli.trim(net_buoyancy=0.3, mass_position=0.4216, mass_rotation=0.7854)
print(", ".join(name for name in ("scipy.optimize", "numba", "pandas", "gsw") if name in sys.modules) or "none of them")
"""


def seconds(command: list[str], **environment: str) -> float:
    began = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env={**os.environ, **environment})
    return time.perf_counter() - began


def first_run() -> float:
    """The trial on a machine that has compiled nothing yet."""
    with tempfile.TemporaryDirectory() as empty:
        return seconds([GLIDER, *TRIAL], GLIDER_CACHE_DIR=empty)


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    found: dict[str, list[float]] = {name: [] for name in COMMANDS}
    for name, command in COMMANDS.items():
        seconds(command)
        found[name].clear()
    for _ in range(runs):
        for name, command in COMMANDS.items():
            found[name].append(seconds(command))
    found["the same, first run on a machine"] = [first_run() for _ in range(FIRST_RUNS)]
    base = statistics.median(found["python -c pass"])
    print(f"{'command':<42}{'median s':>9}{'min':>8}{'max':>8}{'x python':>10}")
    for name, times in found.items():
        middle = statistics.median(times)
        print(f"{name:<42}{middle:>9.3f}{min(times):>8.3f}{max(times):>8.3f}{middle / base:>10.1f}")
    done = subprocess.run([sys.executable, "-c", IMPORTED], check=True, capture_output=True, text=True)
    print(f"of scipy.optimize, numba, pandas, gsw one trim imports {done.stdout.strip()}")


if __name__ == "__main__":
    main()
