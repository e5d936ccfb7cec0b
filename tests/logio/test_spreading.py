"""A file that the disk refuses is named and costs no other; a reading process that is killed is told in one line."""

from __future__ import annotations

import dataclasses
import os
import shutil
from pathlib import Path

import pytest
from conftest import ROOT

from glidercli.errors import InputError
from glidercli.logio import read, spreading
from glidercli.logio.formats import FORMATS
from glidercli.logio.reader import Aids, Part

SEA035 = ROOT / "logs/seaexplorer-sea035"


def test_a_file_that_the_disk_refuses_costs_no_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for number in (36, 37):
        shutil.copy(SEA035 / f"sea035.12.gli.sub.{number}", tmp_path)
    whole = FORMATS["seaexplorer"].read

    def refused(path: Path, aids: Aids) -> Part:
        if path.name.endswith(".36"):
            raise OSError(5, "Input/output error", str(path))
        return whole(path, aids)

    monkeypatch.setitem(FORMATS, "seaexplorer", dataclasses.replace(FORMATS["seaexplorer"], read=refused))
    bad, good = read([tmp_path]).files
    assert (bad.error, bad.kept) == ("cannot be read: Input/output error", 0)
    assert good.kept == 504


def killed(path: Path, format: str | None, aids: Aids) -> None:
    os._exit(9)


def test_a_killed_process_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spreading, "LARGE", 0)
    monkeypatch.setattr(spreading, "read_one", killed)
    with pytest.raises(InputError, match=r"sea035.*: a process that read it or a file after it was killed: is memory"):
        read([SEA035], workers=2)
