"""What tests share: the command as users run it, and the vehicle of the paper."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from glidercli.model import Parameters, parameters
from glidercli.vehicle import Vehicle, load_vehicle

GLIDER = Path(sys.executable).with_name("glider")
ROOT = Path(__file__).parent.parent

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def glider(tmp_path: Path) -> Run:
    """Run ``glider`` in an empty folder, as a user would."""

    def run(*arguments: object, **options: Any) -> subprocess.CompletedProcess[str]:
        command = [str(GLIDER), *(str(item) for item in arguments)]
        return subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=300, **options)

    return run


@pytest.fixture
def glider_json(glider: Run) -> Callable[..., Any]:
    """Run ``glider`` with --json and give the document; stdout must hold nothing else."""

    def run(*arguments: object) -> Any:
        done = glider(*arguments, "--json")
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return run


@pytest.fixture(scope="session")
def seawing() -> Vehicle:
    return load_vehicle("seawing")


@pytest.fixture(scope="session")
def p(seawing: Vehicle) -> Parameters:
    return parameters(seawing)


WORKED_EXAMPLE = {"net_buoyancy": 0.3, "mass_position": 0.4216, "mass_rotation": math.radians(45.0)}
"""The controls of Fig. 9 (SI, rad)."""


def one_line_error(done: subprocess.CompletedProcess[str], *words: str, code: int = 1) -> str:
    """Check the contract of a failure and give its line."""
    lines = [line for line in done.stderr.splitlines() if not line.startswith(("glider: warning:", "compiling the"))]
    assert done.returncode == code, (done.returncode, done.stdout, done.stderr)
    assert len(lines) == 1, done.stderr
    assert lines[0].startswith("glider: error: "), lines
    assert "Traceback" not in done.stderr
    for word in words:
        assert word in lines[0], (word, lines[0])
    return lines[0]
