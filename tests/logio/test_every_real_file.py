"""Every real file in the repository: recognised, and every record of it kept or named.

That the counts are right is held by each family's own tests, against plain text tools, netCDF4, xarray and dbdreader.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT

from glidercli.logio.companions import is_companion
from glidercli.logio.formats import format_of, read_file
from glidercli.logio.reader import Aids

FAMILIES = {
    "logs/seaexplorer-sea035": "seaexplorer", "logs/slocum-comet-2019": "slocum", "logs/seaglider-sg561": "seaglider",
    "tests/data/seaexplorer": "seaexplorer", "tests/data/slocum": "slocum", "tests/data/seaglider": "seaglider",
    "tests/data/seaexplorer-sea035": "seaexplorer", "tests/data/netcdf": "",
}  # fmt: skip
FILES = [
    path for folder in FAMILIES for path in sorted((ROOT / folder).iterdir())
    if format_of(path, Aids()) or not is_companion(path)
]  # fmt: skip


def test_there_are_many() -> None:
    assert len(FILES) == 36


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_records_are_kept_or_named(path: Path) -> None:
    expected = FAMILIES[str(path.parent.relative_to(ROOT))]
    format = format_of(path, Aids())
    assert format == expected or (not expected and format in ("og1", "ioos"))
    part = read_file(path, None, Aids())
    report = part.report
    assert report.error is None
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    assert all(count > 0 and reason for reason, count in report.dropped)
    assert report.kept == len(part.record_ns) > 0
    assert (np.diff(part.record_ns) >= 0).all()
    assert part.log.origin == "measured"
    for channel in part.log.channels.values():
        assert len(channel) > 0
        assert np.isfinite(channel.values).all()
