"""An installed wheel flies the shipped trial from any folder: its files are inside."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

from conftest import ROOT


def test_the_trial_flies_from_a_wheel(tmp_path: Path) -> None:
    build = [
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "--no-deps",
        "--no-build-isolation",
        "-q",
        "-w",
        str(tmp_path),
        str(ROOT),
    ]
    done = subprocess.run(build, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    installed = tmp_path / "site"
    zipfile.ZipFile(next(tmp_path.glob("*.whl"))).extractall(installed)
    program = "import glidercli, sys; print(glidercli.__file__); from glidercli.cli import main; sys.argv[0] = 'glider'; main()"
    command = [sys.executable, "-c", program, "simulate", "south-china-sea-2011", "--quiet", "-o", "trial.csv"]
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    environment = {**os.environ, "PYTHONPATH": str(installed)}
    done = subprocess.run(command, capture_output=True, text=True, cwd=elsewhere, env=environment)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[0].startswith(str(installed))
    assert (elsewhere / "trial.csv").stat().st_size > 0
    command[3:] = ["compare", "south-china-sea-2011", "trial.csv", "--quiet", "-o", "page.html"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=elsewhere, env=environment)
    assert done.returncode == 0, done.stderr
    assert "plotly.js" in (elsewhere / "page.html").read_text(encoding="utf-8")
