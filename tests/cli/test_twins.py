"""Twins of recorded dives: the commands of docs/twins.md as printed, its figures, and the way of the recorded flight."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from conftest import GLIDER, ROOT, Run

from glidercli.log import Log
from glidercli.logio import read

DOC = (ROOT / "docs/twins.md").read_text()
TWINS = ("sg561", "sea035")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the commands of the page have run; outputs of the comparisons as JSON beside them."""
    folder: Path = tmp_path_factory.mktemp("twins")
    (folder / "logs").symlink_to(ROOT / "logs")
    for line in re.findall(r"^    glider (.*)$", DOC, re.MULTILINE):
        words = [*shlex.split(line), "--quiet", "--json"]
        done = subprocess.run([GLIDER, *words], cwd=folder, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stderr
        if words[0] == "compare":
            (folder / f"{Path(words[4]).stem}.json").write_text(done.stdout)
    return folder


def compared(folder: Path, name: str) -> Any:
    return json.loads((folder / f"{name}-twin.json").read_text())


def rows(section: str) -> dict[str, list[str]]:
    """The first table of a section: cells by channel."""
    text = DOC.split(f"## {section}")[1]
    table = text[text.index("| channel") :].split("\n\n")[0].splitlines()[2:]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in table]
    return {line[0]: line[1:] for line in cells}


def flight(folder: Path, name: str) -> tuple[Log, Log]:
    measured = "logs/seaglider-sg561" if name == "sg561" else "logs/seaexplorer-sea035/*.37"
    return read([folder / measured]).log, read([folder / f"{name}-twin.nc"]).log


@pytest.mark.parametrize("name", TWINS)
def test_the_figures_of_the_page_are_those_of_the_program(folder: Path, name: str) -> None:
    """Three digits are printed, so half a unit of the last is at most 0.5 %; as much again for other machines' rounding
    through a tumble at the surface. Biases near zero are held against the channel's rmse."""
    document = compared(folder, name)
    whole, dive, climb = document["channels"], document["phases"]["dive"], document["phases"]["climb"]
    table = rows(name)
    assert len(table) >= 6
    for channel, (unit, *printed) in table.items():
        assert unit == whole[channel]["unit"]
        values = [whole[channel][key] for key in ("rmse", "bias", "correlation")]
        values += [phase[channel][key] for phase in (dive, climb) for key in ("rmse", "bias")]
        slack = 0.01 * whole[channel]["rmse"]
        for text, value in zip(printed, values, strict=True):
            assert float(text) == pytest.approx(value, rel=0.01, abs=min(slack, 0.01)), (channel, text)


@pytest.mark.parametrize(("name", "correlation", "deepest"), [("sg561", 0.98, 0.75), ("sea035", 0.7, 0.85)])
def test_a_twin_goes_down_and_up_with_the_glider(folder: Path, name: str, correlation: float, deepest: float) -> None:
    """Depth goes along with the recorded one, and nearly as deep. Bounds are below what starting values gave (0.994 and
    84 %; 0.763 and 90 %): a change of sign of any control makes the correlation negative or the way a quarter."""
    document = compared(folder, name)
    assert document["channels"]["depth"]["correlation"] > correlation
    assert document["channels"]["vertical_speed"]["correlation"] > 0.9
    measured, twin = flight(folder, name)
    assert deepest < twin["depth"].values.max() / measured["depth"].values.max() < 1.0 / deepest
    times = measured["depth"].time_ns[[int(measured["depth"].values.argmax())]]
    turn = twin["depth"].time_ns[int(twin["depth"].values.argmax())]
    assert abs(int(times[0]) - int(turn)) < 60e9  # it turns with the recorded pump; two samples of sg561


@pytest.mark.parametrize("name", TWINS)
def test_pitch_and_roll_have_the_signs_of_the_recorded_ones(folder: Path, name: str) -> None:
    document = compared(folder, name)
    assert document["channels"]["pitch"]["correlation"] > 0.8  # nose down on the dive, up on the climb
    assert document["channels"]["roll"]["correlation"] > 0.8  # it follows the battery; 0.935, 0.957


@pytest.mark.parametrize("name", TWINS)
def test_it_turns_to_the_side_that_the_glider_turns_to(folder: Path, name: str) -> None:
    """Heading rate against roll, over the samples of the glider rolled by 8 deg or more: port for starboard down on the
    dive, starboard on the climb, both of them. The glider's own asymmetry (3 deg of roll on sea035) is less than 8 deg."""
    for log in flight(folder, name):
        for phase, sign in (("dive", -1.0), ("climb", 1.0)):
            assert sign * turn_per_roll(log, phase) > 0.0, phase


def turn_per_roll(log: Log, phase: str) -> float:
    """Sum of heading rate times roll over the steady part of a phase, where the vehicle is rolled."""
    table = pd.DataFrame({"t": log["heading"].time_ns / 1e9, "psi": np.unwrap(log["heading"].values)})
    depth = np.interp(table["t"], log["depth"].time_ns / 1e9, log["depth"].values)
    roll = np.interp(table["t"], log["roll"].time_ns / 1e9, log["roll"].values)
    bottom = table["t"][int(depth.argmax())]
    part = (table["t"] < bottom - 60.0) if phase == "dive" else (table["t"] > bottom + 60.0)
    rate = np.gradient(table["psi"], table["t"])
    use = part.to_numpy() & (depth > 20.0) & (np.abs(roll) > np.radians(8.0))
    return float(np.sum(rate[use] * roll[use]))


def test_a_vehicle_of_that_name_is_a_twin(glider: Run) -> None:
    log = ROOT / "logs/seaglider-sg561"
    for vehicle, said in (("seaglider", False), ("slocum", True)):
        done = glider("simulate", "--vehicle", vehicle, "--controls", log, "--initial", log)
        assert ("no twin of that flight" in done.stderr) == said
