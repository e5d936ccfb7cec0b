"""SeaExplorer files: every record kept or named, signs, traps; counts confirmed by plain text tools."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT

from glidercli.errors import InputError
from glidercli.logio import read
from glidercli.logio.seaexplorer import read_seaexplorer

LOGS = ROOT / "logs/seaexplorer-sea035"
REAL = sorted([*LOGS.glob("*.sub.*"), *(ROOT / "tests/data/seaexplorer").glob("*.gz")])
HEAD = "Timestamp;NavState;Heading;Declination;Pitch;Roll;Depth;Lat;Lon;BallastPos;LinPos;AngPos;"


def lines_of(path: Path) -> list[str]:
    data = path.read_bytes()
    return (gzip.decompress(data) if path.suffix == ".gz" else data).decode("latin-1").splitlines()


@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_records_are_kept_or_dropped(path: Path) -> None:
    _, report = read_seaexplorer(path)
    assert report.records == sum(bool(line.strip()) for line in lines_of(path)[1:])
    assert report.records == report.kept + sum(count for _, count in report.dropped)


def test_real_files_are_there() -> None:
    assert len(REAL) == 10


def write(tmp_path: Path, *rows: str, head: str = HEAD) -> Path:
    path = tmp_path / "sea001.1.gli.sub.1"
    path.write_text("\n".join([head, *rows]) + "\n", encoding="latin-1")
    return path


GOOD = [f"21/07/2019 10:0{i}:00;100;90.0;16;-20.0;5.0;{10 * i}.0;4854.5;-13036.2;-500;70;20;" for i in range(6)]


def test_units_and_signs(tmp_path: Path) -> None:
    log, report = read_seaexplorer(write(tmp_path, *GOOD))
    assert (report.records, report.kept, report.dropped) == (6, 6, ())
    assert log["pitch"].values[0] == pytest.approx(np.radians(-20.0))
    assert log["mass_position"].values[0] == pytest.approx(0.070)
    assert log["mass_rotation"].values[0] == pytest.approx(np.radians(-20.0))
    assert log["ballast_volume"].values[0] == pytest.approx(-500e-6)
    assert log["depth"].time_ns[1] - log["depth"].time_ns[0] == 60 * 10**9


def test_roll_follows_the_rotating_battery_on_real_dives() -> None:
    log = read([LOGS]).log
    deep = np.intersect1d(log["depth"].time_ns[log["depth"].values > 30.0], log["roll"].time_ns)
    pick = lambda name: log[name].values[np.searchsorted(log[name].time_ns, deep)]  # noqa: E731
    assert np.corrcoef(pick("roll"), pick("mass_rotation"))[0, 1] < -0.9  # the model: positive rotation, negative roll


@pytest.mark.parametrize(
    ("row", "reason"),
    [
        ("21/07/2019 10:06:00;100;90.0;16;-20.0", "wrong number of fields"),
        ("soon;100;90.0;16;-20.0;5.0;60.0;4854.5;-13036.2;-500;70;20;", "time cannot be read"),
        (GOOD[5], "time repeats"),
        (GOOD[2], "time goes back"),
        (
            "21/07/2018 10:06:00;100;90.0;16;-20.0;5.0;60.0;4854.5;-13036.2;-500;70;20;",
            "clock not set: more than 30 days from the file's median time",
        ),
        ("21/07/2019 10:06:00;0;0;0;0;0;0;0;0;0;0;0;", "all values zero"),
        ("21/07/2019 10:06:00;;;;;;;;;;;;", "no value"),
        ("21/07/2019 10:06:00;9999;9999;9999;-9999;9999;9999;9999;9999;9999;9999;9999;", "no value"),
    ],
)
def test_each_trap_is_dropped_by_name(tmp_path: Path, row: str, reason: str) -> None:
    _, report = read_seaexplorer(write(tmp_path, *GOOD, row))
    assert (report.records, report.kept) == (7, 6)
    assert report.dropped == ((reason, 1),)


def test_single_cells_are_left_out_and_counted(tmp_path: Path) -> None:
    row = "21/07/2019 10:06:00;100;90.0;16;-200.0;9999;60.0;4854.5;-13036.2;-500;70;20;"
    log, report = read_seaexplorer(write(tmp_path, *GOOD, row))
    assert report.kept == 7
    assert len(log["pitch"]) == len(log["roll"]) == 6
    assert any("Pitch: 1 values outside -90..90" in warning for warning in report.warnings)


def test_only_changed_positions_at_the_surface_are_fixes(tmp_path: Path) -> None:
    rows = [
        "21/07/2019 10:00:00;116;90.0;16;0;0;2.0;4854.500;-13036.200;0;70;0;",
        "21/07/2019 10:01:00;116;90.0;16;0;0;2.0;4854.600;-13036.200;0;70;0;",
        "21/07/2019 10:02:00;116;90.0;16;0;0;2.0;4854.600;-13036.200;0;70;0;",
        "21/07/2019 10:03:00;100;90.0;16;0;0;9.0;4854.700;-13036.200;0;70;0;",
    ]
    log, _ = read_seaexplorer(write(tmp_path, *rows))
    assert log["latitude"].values.tolist() == [pytest.approx(48.91)]  # 48 deg 54.600 min
    assert log["longitude"].values.tolist() == [pytest.approx(-(130 + 36.2 / 60))]


def test_leading_spaces_and_a_header_alone(tmp_path: Path) -> None:
    spaced = [row.replace(";", "; ") for row in GOOD]
    assert read_seaexplorer(write(tmp_path, *spaced, head=HEAD.replace(";", "; ")))[1].kept == 6
    with pytest.raises(InputError, match="no usable record"):
        read([write(tmp_path)])


def test_salinity_is_derived_by_teos10() -> None:
    log = read([LOGS]).log
    assert log["salinity"].origin == log["density"].origin == "derived"
    assert log["conductivity"].origin == "measured"
    assert 31.0 < log["salinity"].values.min() < log["salinity"].values.max() < 35.0  # the north-east Pacific
