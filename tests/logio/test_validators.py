"""Do the checkers of others pass what viewers get? pymcap-cli, Rerun's own, the TypeScript reader, and back to arrays.

None of them shares code with the writers: pymcap-cli and Rerun's checker are by other people, @mcap/core is the
reference reader in another language, which decodes every message by the schema that the file itself holds.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from mcap.reader import make_reader
from rrd_files import rerun_program, samples, told_by_the_verifier
from viewer_logs import LOGS

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.mcap.reader import read_mcap_log
from glidercli.logio.mcap.writer import write_mcap
from glidercli.logio.rerun.writer import write_rerun

BIN = Path(sys.executable).parent
NODE = Path(__file__).parents[1] / "node"


class Saved(NamedTuple):
    """A log, and what was written of it; no .rrd where it has no sample."""

    log: Log
    mcap: Path
    rrd: Path | None


@pytest.fixture(scope="module", params=LOGS)
def saved(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Saved]:
    folder = tmp_path_factory.mktemp("saved")
    log = LOGS[request.param]()
    write_mcap(log, folder / "a.mcap")
    if log.channels:
        write_rerun(log, folder / "a.rrd")
    yield Saved(log, folder / "a.mcap", folder / "a.rrd" if log.channels else None)
    shutil.rmtree(folder)


def ran(*command: Any, **options: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=300, **options)


def test_the_doctor_finds_nothing(saved: Saved) -> None:
    done = ran(BIN / "pymcap-cli", "doctor", "--strict-message-order", "--format", "jsonl", saved.mcap)
    assert done.returncode == 0, done.stdout + done.stderr
    found = [json.loads(line) for line in done.stdout.splitlines()]
    assert [item for item in found if item.get("severity") in ("warning", "error")] == []
    assert found[-1]["complete"]


def test_rerun_finds_no_fault_in_the_mcap(saved: Saved, tmp_path: Path) -> None:
    done = rerun_program(tmp_path, "mcap", "check", saved.mcap)
    assert done.returncode == 0, done.stdout + done.stderr
    rows = [line.split() for line in done.stdout.splitlines() if "/" in line and not line.startswith("/tmp")]
    assert {row[3]: row[0] for row in rows if row[0] in ("ok", "warn", "error")} == dict.fromkeys(topics(saved), "ok")


def topics(saved: Saved) -> dict[str, int]:
    """Messages by topic, as the Python reader counts them."""
    with saved.mcap.open("rb") as stream:
        counts: dict[str, int] = {}
        for _, channel, _ in make_reader(stream, validate_crcs=True).iter_messages():
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
    return counts


@pytest.mark.skipif(shutil.which("node") is None, reason="Node.js is not on this machine")
@pytest.mark.skipif(not (NODE / "node_modules").is_dir(), reason="`make test` installs tests/node where npm is")
def test_the_typescript_reader_decodes_every_message(saved: Saved) -> None:
    done = ran("node", NODE / "check.cjs", saved.mcap)
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["topics"] == topics(saved)
    assert told["messages"] == sum(told["topics"].values())
    assert set(told["metadata"]) == {"run", "origin", "version"}
    assert told["attachments"] == (["provenance.json"] if "provenance" in saved.log.metadata else [])


@pytest.mark.skipif(shutil.which("node") is None, reason="Node.js is not on this machine")
@pytest.mark.skipif(not (NODE / "node_modules").is_dir(), reason="`make test` installs tests/node where npm is")
def test_the_typescript_reader_sees_a_changed_byte(tmp_path: Path) -> None:
    """So that what it passes means something."""
    write_mcap(LOGS["full"](), tmp_path / "a.mcap")
    data = bytearray((tmp_path / "a.mcap").read_bytes())
    data[len(data) // 2] ^= 1
    (tmp_path / "a.mcap").write_bytes(data)
    done = ran("node", NODE / "check.cjs", tmp_path / "a.mcap")
    assert (done.returncode, "CRC" in done.stderr) == (1, True), done.stderr


def test_the_mcap_is_the_log_to_the_last_bit(saved: Saved) -> None:
    back = read_mcap_log(saved.mcap)
    assert list(back.channels) == list(saved.log.channels)
    for name, channel in saved.log.channels.items():
        assert back[name].time_ns.tobytes() == channel.time_ns.tobytes(), name
        assert back[name].values.tobytes() == channel.values.tobytes(), name
        assert back[name].origin == channel.origin
    assert (back.origin, back.metadata, back.events) == (saved.log.origin, dict(saved.log.metadata), saved.log.events)


def test_rerun_verifies_the_rrd(saved: Saved, tmp_path: Path) -> None:
    if saved.rrd is None:
        pytest.skip("a log without a sample is refused as .rrd")
    assert "without error" in told_by_the_verifier(saved.rrd, tmp_path)


def test_the_rrd_is_the_log(saved: Saved) -> None:
    """Each channel's times and, in the unit for people, its values: equal, with depth negative down."""
    if saved.rrd is None:
        pytest.skip("a log without a sample is refused as .rrd")
    for name, channel in saved.log.channels.items():
        if name == "phase" or not len(channel):
            continue
        factor = -1.0 if name == "depth" else CHANNELS[name].factor
        time_ns, _, values = samples(saved.rrd, f"/{CHANNELS[name].group}/{name}")
        np.testing.assert_array_equal(time_ns, channel.time_ns, name)
        np.testing.assert_array_equal(values, channel.values * factor, name)
