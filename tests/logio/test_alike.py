"""Files of two vehicles are refused; one that tells no vehicle is named, and refused where it was at another depth."""

from __future__ import annotations

import dataclasses
import itertools
import shutil
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, Run

from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.logio import overview, read
from glidercli.logio.alike import alike
from glidercli.logio.reader import Part
from glidercli.logio.report import FileReport

SEA035 = ROOT / "logs/seaexplorer-sea035"
SEA063 = ROOT / "tests/data/seaexplorer"
NAVIGATION = SEA035 / "sea035.12.gli.sub.37"
SECOND = 10**9


def part(name: str, start: int, depth: list[float], vehicle: str = "", **more: list[float]) -> Part:
    """A sample each 10 s."""
    ns = (start + 10 * np.arange(len(depth))) * SECOND
    channels = {key: Channel(key, ns, np.array(values)) for key, values in {"depth": depth, **more}.items()}
    log = Log(channels, "measured", {"platform": vehicle} if vehicle else {})
    return Part(log, FileReport(Path(name), "made", len(ns), len(ns)), ns)


def test_a_file_that_tells_no_vehicle_is_named(tmp_path: Path, glider: Run) -> None:
    shutil.copy(NAVIGATION, tmp_path)
    shutil.copy(SEA063 / "sea063.22.gli.sub.120.gz", tmp_path / "nav.gz")
    reading = read([tmp_path])
    nameless = next(report for report in reading.files if report.path.name == "nav.gz")
    assert "tells no vehicle, in its name or inside; joined with files of SeaExplorer sea035" in nameless.warnings
    assert "the vehicle of nav.gz, joined with SeaExplorer sea035" in overview(reading).missing
    assert "the vehicle of nav.gz" in glider("info", str(tmp_path)).stdout


def test_files_that_all_tell_none_say_nothing(tmp_path: Path) -> None:
    shutil.copy(NAVIGATION, tmp_path / "a")
    shutil.copy(SEA035 / "sea035.12.gli.sub.38", tmp_path / "b")
    reading = read([tmp_path])
    assert not any("vehicle" in warning for report in reading.files for warning in report.warnings)
    assert not reading.nameless


def test_another_depth_at_the_same_time_is_refused(tmp_path: Path) -> None:
    """The dive of sea063 with the days and hours of sea035."""
    shutil.copy(NAVIGATION, tmp_path)
    lines = NAVIGATION.read_text("latin-1").split("\n")
    place = lines[0].split(";").index("Depth")
    for number, line in enumerate(lines[1:-1], 1):
        cells = line.split(";")
        cells[place] = f"{abs(700.0 - float(cells[place])):.1f}"
        lines[number] = ";".join(cells)
    (tmp_path / "other").write_text("\n".join(lines), "latin-1")
    with pytest.raises(InputError, match=r"other: tells no vehicle, and at 2019-07-21T23:37:42Z it was at 691 m where"):
        read([tmp_path])


def test_a_payload_of_the_same_dive_contradicts_nothing(tmp_path: Path) -> None:
    shutil.copy(NAVIGATION, tmp_path)
    shutil.copy(SEA035 / "sea035.12.pld1.sub.37", tmp_path / "payload")
    together = read([tmp_path]).log
    assert len(together["pressure"]) == len(read([SEA035 / "sea035.12.pld1.sub.37"]).log["pressure"])


def test_a_copy_that_tells_no_vehicle_gives_way(tmp_path: Path) -> None:
    shutil.copy(NAVIGATION, tmp_path)
    shutil.copy(NAVIGATION, tmp_path / "a")
    copy, named = read([tmp_path]).files
    assert (copy.kept, named.kept) == (0, 504)


def test_of_two_known_vehicles_none_hides_behind_one_that_tells_none() -> None:
    parts = [part("a", 0, [0.0]), part("b", 100, [0.0], "sea035"), part("c", 200, [0.0], "sea063")]
    for given in itertools.permutations(parts):
        with pytest.raises(InputError, match="c: is of sea063, b of sea035"):
            alike(list(given))


@pytest.mark.parametrize("vehicles", [("", ""), ("x", ""), ("", "x")])
def test_what_contradicts(vehicles: tuple[str, str]) -> None:
    one = part("a", 0, [100.0] * 20, vehicles[0])
    with pytest.raises(InputError, match="tells no vehicle, and at"):
        alike([one, part("b", 5, [200.0] * 20, vehicles[1])])
    alike([one, part("b", 5, [103.0] * 20, vehicles[1])])  # another gauge
    alike([one, part("b", 5, [103.0] * 18 + [900.0] * 2, vehicles[1])])  # garbled cells
    alike([one, part("b", 1000, [200.0] * 20, vehicles[1])])  # later


def test_pressure_stands_for_depth() -> None:
    deep = part("a", 0, [900.0] * 9, "x")
    log = Log({"pressure": Channel("pressure", deep.record_ns, np.full(9, 910e4))}, "measured")
    other = dataclasses.replace(deep, log=log, report=dataclasses.replace(deep.report, path=Path("b")))
    alike([deep, other])
    shallow = dataclasses.replace(log["pressure"], values=np.full(9, 1e5))
    with pytest.raises(InputError, match="b: tells no vehicle, and at 1970-01-01T00:00:00Z it was at 10 m where a was"):
        alike([deep, dataclasses.replace(other, log=log.with_channels(shallow))])
