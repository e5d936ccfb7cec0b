"""What is left of a writer that is killed, or whose disk is full? Nothing under the final name; old files untouched."""

from __future__ import annotations

import os
import random
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from glidercli.files import leftovers
from glidercli.logio import SUFFIXES

GLIDER = Path(sys.executable).with_name("glider")
WRITE = """
import itertools, sys
import numpy as np
from pathlib import Path
from glidercli.log import Channel, Log
from glidercli.logio.writing import saving
import glidercli.logio.mcap.writer, glidercli.logio.own.netcdf_log, glidercli.logio.own.parquet_log, rerun

def piece(start):
    times = 1_600_000_000 * 10**9 + np.arange(start, start + 2000) * 10**9
    values = np.random.default_rng(start).normal(size=2000)
    return Log({n: Channel(n, times, values) for n in ("north", "east", "down", "depth", "roll", "pitch", "heading")}, "measured")

with saving([Path(sys.argv[1])], force=True) as outputs:
    print("begun", flush=True)
    for start in itertools.count(0, 2000):
        outputs.add(piece(start))
"""


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_killed_at_any_moment_it_leaves_the_old_file(suffix: str, tmp_path: Path) -> None:
    """SIGKILL after a random time while it writes; the old file stands, byte by byte, and the part is found."""
    target, moments = tmp_path / f"a{suffix}", random.Random(suffix)
    for _ in range(3):
        target.write_bytes(b"old")
        with subprocess.Popen([sys.executable, "-c", WRITE, target], stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            assert process.stdout.readline() == "begun\n"
            time.sleep(moments.uniform(0.0, 0.3))
            process.send_signal(signal.SIGKILL)
        assert process.returncode == -signal.SIGKILL
        assert target.read_bytes() == b"old"
        part = tmp_path / f".a.part-{process.pid}{suffix}"
        told = [tmp_path / f".a.csv-metadata.part-{process.pid}.json"] if suffix == ".csv" else []
        assert leftovers(target) == [part, *told]
        assert set(tmp_path.iterdir()) == {target, part, *told}
        for path in tmp_path.iterdir():
            path.unlink()


def test_the_next_run_tells_of_the_part_and_how_to_recover_it(tmp_path: Path) -> None:
    gone = subprocess.Popen(["true"])
    gone.wait()
    part = tmp_path / f".a.part-{gone.pid}.mcap"
    part.write_bytes(b"\x89MCAP0\r\n")
    (tmp_path / f".a.part-{os.getpid()}.mcap").write_bytes(b"of one that runs")
    command = [GLIDER, "replay", "logs/seaglider-sg561", "-o", str(tmp_path / "a.mcap")]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    told = [line for line in run.stderr.splitlines() if "killed" in line]
    assert len(told) == 1
    assert str(part) in told[0]
    assert "pymcap-cli recover" in told[0]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_full_disk_is_one_line(suffix: str, tmp_path: Path) -> None:
    """A limit on the size of files stands for it; half a file is nowhere left."""

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (6_000, 6_000))

    command = [GLIDER, "replay", "logs/seaglider-sg561", "-o", str(tmp_path / f"a{suffix}")]
    run = subprocess.run(command, capture_output=True, text=True, check=False, preexec_fn=limited)
    assert run.returncode == 1
    faults = [line for line in run.stderr.splitlines() if "warning" not in line]
    assert len(faults) == 1, run.stderr
    assert faults[0].startswith(f"glider: error: {tmp_path}/a{suffix}")
    assert "cannot be written" in faults[0]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_without_permission_is_one_line(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    command = [GLIDER, "replay", "logs/seaglider-sg561", "-o", str(tmp_path / "a.mcap")]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert "cannot be written: permission denied" in run.stderr
