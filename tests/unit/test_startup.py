"""What a process imports: one trim must not pay for libraries that it does not use."""

from __future__ import annotations

import subprocess
import sys

import pytest

HEAVY = ("scipy", "scipy.optimize", "numba", "pandas", "gsw", "matplotlib", "rerun", "mcap")
LISTED = "\nimport sys; print(' '.join(m for m in {heavy} if m in sys.modules))"
TRIM = "import glidercli; glidercli.trim(net_buoyancy=0.3, mass_position=0.4216, mass_rotation=0.7854)"


@pytest.mark.parametrize("program", ["import glidercli", "import glidercli.cli.app", TRIM])
def test_nothing_heavy_is_imported(program: str) -> None:
    command = [sys.executable, "-c", program + LISTED.format(heavy=HEAVY)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
