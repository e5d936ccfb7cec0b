"""The shipped trial: its tables are what the script makes, each row says what it is, and nothing is called measured."""

from __future__ import annotations

import csv
import runpy
import shutil
from pathlib import Path

import pytest
from conftest import ROOT

from glidercli import shipped
from glidercli.compare import read_facts
from glidercli.simulation import simulate

TRIAL = ROOT / "logs/south-china-sea-2011"
TABLES = ("water.csv", "current.csv", "dive.csv", "climb.csv")


def test_tables_are_made_by_the_script(tmp_path: Path) -> None:
    shutil.copy(TRIAL / "reconstruct.py", tmp_path)
    runpy.run_path(str(tmp_path / "reconstruct.py"), run_name="__main__")
    for name in TABLES:
        assert (tmp_path / name).read_text() == (TRIAL / name).read_text()


@pytest.mark.parametrize("name", TABLES)
def test_every_row_says_that_it_is_a_reconstruction(name: str) -> None:
    rows = list(csv.DictReader((TRIAL / name).read_text().splitlines()))
    assert rows
    assert {row["origin"] for row in rows} == {"reconstruction"}


def test_found_by_name() -> None:
    assert shipped.find("south-china-sea-2011") is not None
    assert shipped.find("nowhere") is None


def test_the_log_is_simulated_from_a_reconstruction() -> None:
    log = simulate("south-china-sea-2011", every=60.0).log
    assert log.kind == "SIMULATED FROM A RECONSTRUCTION"
    assert {channel.origin for channel in log.channels.values()} == {"simulated"}


def test_facts_have_a_place_and_a_reason_for_their_tolerance() -> None:
    facts = read_facts(TRIAL / "facts.toml").facts
    published = {fact.name: fact.value for fact in facts}
    assert published["depth reached"] == 800.0
    assert published["pitch on the dive"] == -40.0
    assert published["roll on the dive"] == 28.0
    assert published["turn on the dive"] == -100.0
    assert published["time window"] == 6120.0  # 12:28 to 14:10
    for fact in facts:
        assert fact.place
        assert fact.tolerance_reason
