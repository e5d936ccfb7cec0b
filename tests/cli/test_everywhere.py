"""The contract of the commands: what holds everywhere."""

from __future__ import annotations

import pytest
from conftest import Run

import glidercli

COMMANDS = ("trim", "simulate", "replay", "compare")
COEFFICIENTS = ("added-mass", "cases", "fit", "estimate")


def test_help_names_every_command(glider: Run) -> None:
    done = glider("--help")
    assert done.returncode == 0
    for command in (*COMMANDS, "coefficients", "vehicles", "missions"):
        assert command in done.stdout


@pytest.mark.parametrize("command", [(name,) for name in COMMANDS] + [("coefficients", name) for name in COEFFICIENTS])
def test_each_command_has_help(glider: Run, command: tuple[str, ...]) -> None:
    done = glider(*command, "--help")
    assert done.returncode == 0
    for option in ("--json", "--quiet", "--force", "--debug"):
        assert option in done.stdout


def test_version(glider: Run) -> None:
    done = glider("--version")
    assert done.returncode == 0
    assert done.stdout.startswith("glider ")


@pytest.mark.parametrize("arguments", [("nosuch",), ("trim", "--nosuch"), ("trim", "--net-buoyancy", "heavy")])
def test_wrong_usage_is_2(glider: Run, arguments: tuple[str, ...]) -> None:
    done = glider(*arguments)
    assert done.returncode == 2
    assert done.stdout == ""
    assert "Traceback" not in done.stderr


def test_vehicles_one_plain_line_each(glider: Run) -> None:
    done = glider("vehicles")
    assert done.returncode == 0
    names = [line.split("  ", 1)[0] for line in done.stdout.splitlines()]
    assert names == ["seaexplorer", "seaglider", "seawing", "slocum"]
    assert all("  " in line for line in done.stdout.splitlines())


def test_missions_one_plain_line_each(glider: Run) -> None:
    done = glider("missions")
    assert done.returncode == 0
    assert any(line.startswith("south-china-sea-2011  ") for line in done.stdout.splitlines())


def test_every_command_is_a_function_of_the_package() -> None:
    for command in COMMANDS:
        assert callable(getattr(glidercli, command))
