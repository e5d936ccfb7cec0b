"""Every sample of every sensor as dbdreader reads it. That sets the locale on import, so it runs in its own process."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT

from glidercli.logio.slocum import read_slocum, sensors
from glidercli.logio.slocum.packing import unpacked

SPIRAL = ROOT / "logs/slocum-comet-2019"
DATA = ROOT / "tests/data/slocum"
SPEC = importlib.util.find_spec("dbdreader")
assert SPEC is not None
assert SPEC.origin is not None
THEIRS = Path(SPEC.origin).parent / "data"
"""Files that come with dbdreader; of these the ones whose lists of sensors stand in them, or that are there twice."""
INLINE = [
    "amadeus-2014-203-00-000.TBD", "amadeus-2014-204-05-000.ebd", "amadeus-2014-204-05-000.tbd",
    "amadeus-2014-204-05-001.tbd", "amadeus-2014-204-05-002.tbd", "ammonite-2008-028-01-000.mbd",
    "sebastian-2014-204-05-000.ebd", "sebastian-2014-204-05-001.ebd",
]  # fmt: skip
FILES = sorted([*SPIRAL.glob("*.[de]bd"), *DATA.glob("*.[dest]bd"), *(THEIRS / name for name in INLINE)])

SCRIPT = """
import json, sys
import numpy as np
import dbdreader
for number, (path, cache) in enumerate(json.load(sys.stdin)):
    file = dbdreader.DBD(path, cacheDir=cache)
    names = file.parameterNames
    got = file.get(*names, decimalLatLon=False, discardBadLatLon=False)
    counts = [len(time) for time, _ in got]
    np.savez(f"{sys.argv[1]}/{number}.npz", names=names, counts=counts, times=np.concatenate([t for t, _ in got]),
             values=np.concatenate([v for _, v in got]))
"""


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> dict[Path, dict[str, tuple[np.ndarray, np.ndarray]]]:
    """Times and values of all sensors of all files, by dbdreader."""
    folder = tmp_path_factory.mktemp("dbdreader")
    request = json.dumps([[str(path), str(path.parent)] for path in FILES])
    subprocess.run([sys.executable, "-c", SCRIPT, str(folder)], input=request, text=True, check=True, timeout=300)
    found = {}
    for number, path in enumerate(FILES):
        with np.load(folder / f"{number}.npz") as got:
            ends = np.cumsum(got["counts"])[:-1]
            pairs = zip(np.split(got["times"], ends), np.split(got["values"], ends), strict=True)
            found[path] = dict(zip(got["names"].tolist(), pairs, strict=True))
    return found


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_every_sample_of_every_sensor_is_the_same(
    path: Path, told: dict[Path, dict[str, tuple[np.ndarray, np.ndarray]]]
) -> None:
    ours = sensors(path)
    assert list(ours) == list(told[path])
    for name, (time, values) in told[path].items():
        np.testing.assert_array_equal(ours[name][0], time, err_msg=name)
        np.testing.assert_array_equal(ours[name][1], values, err_msg=name)
    assert sum(len(time) for time, _ in ours.values()) > 0


@pytest.mark.parametrize("name", INLINE)
def test_gliders_of_2008_and_2014_are_read(name: str) -> None:
    part = read_slocum(THEIRS / name)
    assert part.report.error is None
    assert part.report.records == part.report.kept + sum(count for _, count in part.report.dropped)
    assert len(part.record_ns) == part.report.kept > 0


@pytest.mark.parametrize(("packed", "plain"), [("01600001.dcd", "01600001.dbd"), ("01600000.ecd", "01600000.ebd"), ("01600001.ecd", "01600001.ebd")])  # fmt: skip
def test_compressed_files_of_a_glider_unpack_to_what_the_maker_unpacked(packed: str, plain: str) -> None:
    data, damaged = unpacked((THEIRS / packed).read_bytes())
    assert damaged is None
    assert data == (THEIRS / plain).read_bytes()


@pytest.mark.parametrize(("name", "byte"), [("02380108.ecd", 415901), ("02450137.tcd", 0)])
def test_files_that_were_damaged_on_their_way_are_told(name: str, byte: int) -> None:
    assert unpacked((THEIRS / name).read_bytes())[1] == byte
