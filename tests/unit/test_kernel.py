"""Compiled code must never be stale: an edit in a lower file changes the answer."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from conftest import ROOT

from glidercli.kernel import sources_hash

PROGRAM = """
from glidercli.kernel import compiled
from glidercli.model.buoyancy import pumped_excess
from glidercli.model.parameters import parameters
from glidercli.vehicle import load_vehicle
print(compiled(pumped_excess)(0.5, 1025.0, parameters(load_vehicle("seawing"))))
"""


def answer(folder: Path, cache: Path) -> float:
    environment = {**os.environ, "PYTHONPATH": str(folder), "GLIDER_CACHE_DIR": str(cache)}
    done = subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, cwd=folder)
    assert done.returncode == 0, done.stderr
    return float(done.stdout)


def test_editing_a_lower_file_changes_the_answer(tmp_path: Path) -> None:
    copy = tmp_path / "src"
    shutil.copytree(ROOT / "glidercli", copy / "glidercli")
    cache = tmp_path / "cache"
    assert answer(copy, cache) == 0.5
    assert any(cache.rglob("*.nbi"))
    lower = copy / "glidercli/model/buoyancy.py"
    lower.write_text(lower.read_text().replace("return mb * density / p.rho_0", "return 2.0 * mb * density / p.rho_0"))
    assert answer(copy, cache) == 1.0


def test_a_cache_that_cannot_be_written_is_left_out(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    assert answer(ROOT, blocked) == 0.5


def test_hash_sees_every_file(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("x = 1\n")
    before = sources_hash(tmp_path)
    (tmp_path / "b.py").write_text("")
    assert sources_hash(tmp_path) != before
