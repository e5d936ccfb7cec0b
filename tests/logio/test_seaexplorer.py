"""SeaExplorer files: every record kept or named, signs, traps; counts confirmed by plain text tools."""

from __future__ import annotations

import csv
import gzip
import tracemalloc
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT

from glidercli.channels import PHASES
from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.logio import read
from glidercli.logio.report import FileReport
from glidercli.logio.seaexplorer import read_seaexplorer

LOGS = ROOT / "logs/seaexplorer-sea035"
REAL = sorted([*LOGS.glob("*.sub.*"), *(ROOT / "tests/data/seaexplorer").glob("*.gz")])
HEAD = "Timestamp;NavState;Heading;Declination;Pitch;Roll;Depth;Lat;Lon;BallastPos;LinPos;AngPos;"


def read_one(path: Path) -> tuple[Log, FileReport]:
    part = read_seaexplorer(path)
    assert len(part.record_ns) == part.report.kept
    return part.log, part.report


def lines_of(path: Path) -> list[str]:
    data = path.read_bytes()
    return (gzip.decompress(data) if path.suffix == ".gz" else data).decode("latin-1").splitlines()


@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_records_are_kept_or_dropped(path: Path) -> None:
    _, report = read_one(path)
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
    log, report = read_one(write(tmp_path, *GOOD))
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
            "clock not set: more than 30 days before the file's other times",
        ),
        ("21/07/2019 10:06:00;0;0;0;0;0;0;0;0;0;0;0;", "all values zero"),
        ("21/07/2019 10:06:00;;;;;;;;;;;;", "no value"),
        ("21/07/2019 10:06:00;9999;9999;9999;-9999;9999;9999;9999;9999;9999;9999;9999;", "no value"),
    ],
)
def test_each_trap_is_dropped_by_name(tmp_path: Path, row: str, reason: str) -> None:
    _, report = read_one(write(tmp_path, *GOOD, row))
    assert (report.records, report.kept) == (7, 6)
    assert report.dropped == ((reason, 1),)


def test_single_cells_are_left_out_and_counted(tmp_path: Path) -> None:
    row = "21/07/2019 10:06:00;100;90.0;16;-200.0;9999;60.0;4854.5;-13036.2;-500;70;20;"
    log, report = read_one(write(tmp_path, *GOOD, row))
    assert report.kept == 7
    assert len(log["pitch"]) == len(log["roll"]) == 6
    assert any("Pitch: 1 values outside -90..90" in warning for warning in report.warnings)


def test_a_position_of_60_minutes_is_none(tmp_path: Path) -> None:
    places = ("4854.500", "4854.600", "4861.000", "4854.800")
    rows = [f"21/07/2019 10:0{i}:00;116;90.0;16;0;0;2.0;{lat};-13036.200;0;70;0;" for i, lat in enumerate(places)]
    log, report = read_one(write(tmp_path, *rows))
    assert log["latitude"].values.tolist() == [pytest.approx(48 + 54.6 / 60), pytest.approx(48 + 54.8 / 60)]
    assert "Lat, Lon: 1 values left out that are no new fix at the surface, 2 kept" in report.warnings
    assert f"Lat, Lon: 1 {IMPOSSIBLE}" in report.warnings


IMPOSSIBLE = "impossible values left out: beyond 90 or 180 deg, 60 minutes or more, 0 in both, or one without the other"


@pytest.mark.parametrize(
    "place",
    ["9999;-13036.2", "4854.5;-9999", "9100.0;-13036.2", "4854.5;18100.0", "4861.0;-13036.2", "4854.5;-13060.0", "0;0",
     "4854.5;", "4854.5;abc"],
)  # fmt: skip
def test_impossible_positions_are_counted_as_such(tmp_path: Path, place: str) -> None:
    """Beside other values in the warnings, alone as a record that is dropped; a position that stands still is neither."""
    good = [f"21/07/2019 10:0{i}:00;116;90.0;16;0;0;2.0;485{i}.5;-13036.2;0;70;0;" for i in range(3)]
    still = "21/07/2019 10:03:00;116;;;;;;4852.5;-13036.2;;;;"
    beside = [f"21/07/2019 10:0{i}:00;116;90.0;16;0;0;2.0;{place};0;70;0;" for i in (4, 5)]
    alone = [f"21/07/2019 10:0{i}:00;;;;;;;{place};;;;" for i in (6, 7, 8)]
    log, report = read_one(write(tmp_path, *good, still, *beside, *alone))
    assert log["latitude"].values.tolist() == [pytest.approx(48 + minutes / 60) for minutes in (51.5, 52.5)]
    assert (report.records, report.kept) == (9, 6)
    if place == "0;0":
        assert report.dropped == (("all values zero", 3),)
        assert f"Lat, Lon: 2 {IMPOSSIBLE}" in report.warnings
    else:
        assert report.dropped == (("impossible value: no such position", 3),)
        assert f"Lat, Lon: 5 {IMPOSSIBLE}" in report.warnings
    assert "Lat, Lon: 2 values left out that are no new fix at the surface, 2 kept" in report.warnings


def test_a_possible_position_alone_that_is_no_fix_is_dropped_under_another_reason(tmp_path: Path) -> None:
    _, report = read_one(write(tmp_path, *GOOD, "21/07/2019 10:06:00;;;;;;;4854.5;-13036.2;;;;"))
    assert report.dropped == (("no usable value", 1),)


def test_only_changed_positions_at_the_surface_are_fixes(tmp_path: Path) -> None:
    rows = [
        "21/07/2019 10:00:00;116;90.0;16;0;0;2.0;4854.500;-13036.200;0;70;0;",
        "21/07/2019 10:01:00;116;90.0;16;0;0;2.0;4854.600;-13036.200;0;70;0;",
        "21/07/2019 10:02:00;116;90.0;16;0;0;2.0;4854.600;-13036.200;0;70;0;",
        "21/07/2019 10:03:00;100;90.0;16;0;0;9.0;4854.700;-13036.200;0;70;0;",
    ]
    log, _ = read_one(write(tmp_path, *rows))
    assert log["latitude"].values.tolist() == [pytest.approx(48.91)]  # 48 deg 54.600 min
    assert log["longitude"].values.tolist() == [pytest.approx(-(130 + 36.2 / 60))]


def test_leading_spaces_and_a_header_alone(tmp_path: Path) -> None:
    spaced = [row.replace(";", "; ") for row in GOOD]
    assert read_one(write(tmp_path, *spaced, head=HEAD.replace(";", "; ")))[1].kept == 6
    with pytest.raises(InputError, match="no usable record"):
        read([write(tmp_path)])


def test_salinity_is_derived_by_teos10() -> None:
    log = read([LOGS]).log
    assert log["salinity"].origin == log["density"].origin == "derived"
    assert log["conductivity"].origin == "measured"
    assert 31.0 < log["salinity"].values.min() < log["salinity"].values.max() < 35.0  # the north-east Pacific


def cells_of(path: Path) -> list[dict[str, str]]:
    """The file by the csv module alone."""
    return list(csv.DictReader((line.replace(" ", "") for line in lines_of(path)), delimiter=";"))


@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_samples_are_those_that_plain_csv_counts(path: Path) -> None:
    log, report = read_one(path)
    rows = cells_of(path)
    assert report.kept == len(rows)  # none of these files holds a line that cannot be used
    ctd = "GPCTD" if "GPCTD_PRESSURE" in rows[0] else "LEGATO"
    if "Pitch" in rows[0]:
        for channel in ("pitch", "roll", "heading", "depth", "ballast_volume", "mass_position", "mass_rotation"):
            assert len(log[channel]) == len(rows)
        fixes = sum(
            row["NavState"] == "116" and (row["Lat"], row["Lon"]) != (before["Lat"], before["Lon"])
            for before, row in pairwise(rows)
        )
        assert len(log.channels.get("latitude", ())) == len(log.channels.get("longitude", ())) == fixes
        assert sum(row["NavState"] == "100" for row in rows) == (log["phase"].values == PHASES.index("dive")).sum()
    else:
        assert len(log["temperature"]) == len(log["pressure"]) == len(rows)
        assert len(log["conductivity"]) == sum(float(row[f"{ctd}_PRESSURE"]) >= 0.5 for row in rows)


@pytest.mark.parametrize("yo", [120, 121])
def test_salinity_is_that_of_the_instrument(yo: int) -> None:
    path = ROOT / f"tests/data/seaexplorer/sea063.22.pld1.sub.{yo}.gz"
    told = [float(row["LEGATO_SALINITY"]) for row in cells_of(path)]
    # four decimals of conductivity, temperature and salinity make 1e-4, the instrument's own arithmetic the rest;
    # IPTS-68 taken for ITS-90 would be 7e-4 off, a wrong unit of conductivity by more than the whole
    np.testing.assert_allclose(read([path]).log["salinity"].values, told, atol=5e-4, rtol=0.0)


def test_a_clock_set_late_in_the_file_is_the_one_that_counts(tmp_path: Path) -> None:
    unset = [f"01/01/2018 00:00:{i:02d};100;90;16;-20;5;{i};4854.5;-13036.2;-500;70;20;" for i in range(30)]
    log, report = read_one(write(tmp_path, *unset, *GOOD))
    assert report.dropped == (("clock not set: more than 30 days before the file's other times", 30),)
    assert report.kept == len(log["depth"]) == 6
    assert str(log["depth"].time_ns[0].astype("datetime64[ns]")).startswith("2019-07-21T10:00:00")


def test_a_garbled_date_ahead_moves_no_clock(tmp_path: Path) -> None:
    garbled = GOOD[5].replace("21/07/2019", "21/07/2091")
    _, report = read_one(write(tmp_path, *GOOD[:5], garbled))
    assert report.dropped == (("time more than 30 days after the file's other times", 1),)
    assert report.kept == 5


@pytest.mark.parametrize(
    ("old", "new", "words", "channel"),
    [
        ("-20.0;5.0", "abc;5.0", "Pitch: 1 cells left out that are no number", "pitch"),
        ("-20.0;5.0", "inf;5.0", "Pitch: 1 cells left out that are no number", "pitch"),
        ("-20.0;5.0", "-9999;5.0", "Pitch: 1 cells of 9999 or -9999 left out, no value", "pitch"),
        ("-20.0;5.0", "-91;5.0", "Pitch: 1 values outside -90..90 deg left out", "pitch"),
        (";100;90.0", ";105;90.0", "NavState: 1 values left out that are no phase of flight (105)", "phase"),
    ],
)
def test_cells_left_out_are_told_of(tmp_path: Path, old: str, new: str, words: str, channel: str) -> None:
    log, report = read_one(write(tmp_path, *GOOD[:5], GOOD[5].replace(old, new)))
    assert report.records == report.kept == 6
    assert words in report.warnings
    assert len(log[channel]) == 5


def test_no_position_is_no_fix_and_a_blank_makes_none(tmp_path: Path) -> None:
    places = ["4854.500;-13036.200", "0;0", "4854.500;-13036.200", ";", "4854.500;-13036.200", "4854.700;-13036.200"]
    rows = [f"21/07/2019 10:0{i}:00;116;90.0;16;0;0;2.0;{place};0;70;0;" for i, place in enumerate(places)]
    log, report = read_one(write(tmp_path, *rows))
    assert log["latitude"].values.tolist() == [pytest.approx(48 + 54.7 / 60)]
    assert report.warnings == (
        f"Lat, Lon: 1 {IMPOSSIBLE}",
        "Lat, Lon: 3 values left out that are no new fix at the surface, 1 kept",
    )


PAYLOAD = "PLD_REALTIMECLOCK;NAV_DEPTH;GPCTD_CONDUCTIVITY;GPCTD_TEMPERATURE;GPCTD_PRESSURE;"


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ("0.0;0.0;0.0", "GPCTD: 1 samples of zeros alone left out"),
        ("0.01;12.0;0.1", "conductivity: 1 values at less than 0.5 dbar left out: the cell may be in air"),
        ("4.0;12.0;", "conductivity: 1 values without a pressure left out: the cell may be in air"),
    ],
)
def test_conductivity_out_of_the_water_is_left_out(tmp_path: Path, row: str, words: str) -> None:
    rows = ["21/07/2019 10:00:00.125;9;4.0;12.0;9.0;", f"21/07/2019 10:00:30.000;9;{row};"]
    reading = read([write(tmp_path, *rows, head=PAYLOAD)])
    assert len(reading.log["conductivity"]) == len(reading.log["salinity"]) == 1
    assert words in reading.files[0].warnings
    assert reading.files[0].records == reading.files[0].kept + sum(n for _, n in reading.files[0].dropped) == 2


def test_a_second_ctd_is_not_mixed_with_the_first(tmp_path: Path) -> None:
    head = "PLD_REALTIMECLOCK;GPCTD_TEMPERATURE;LEGATO_TEMPERATURE;"
    log, report = read_one(write(tmp_path, "21/07/2019 10:00:00;5;6;", head=head))
    assert log["temperature"].values.tolist() == [5.0]
    assert report.warnings == ("LEGATO_TEMPERATURE: 1 values left out, another column gives temperature",)


def test_bytes_that_are_no_text_make_no_extra_records(tmp_path: Path) -> None:
    path = write(tmp_path, *GOOD)
    path.write_bytes(path.read_bytes() + b"\x85\x0b\x0c\x1c;\x85\n")
    _, report = read_one(path)
    assert (report.records, report.kept, report.dropped) == (7, 6, (("wrong number of fields", 1),))


def test_files_put_one_behind_the_other_are_read_on(tmp_path: Path) -> None:
    _, report = read_one(write(tmp_path, *GOOD[:3], HEAD, *GOOD[3:], HEAD.replace(";", "; "), HEAD[:-1]))
    assert (report.records, report.kept, report.error) == (9, 6, None)
    assert report.dropped == (("repeated header", 3),)
    _, report = read_one(write(tmp_path, *GOOD, HEAD, *GOOD))
    assert (report.records, report.kept) == (13, 6)
    assert report.dropped == (("repeated header", 1), ("time goes back", 5), ("time repeats", 1))


def test_a_header_with_other_columns_ends_the_reading(tmp_path: Path) -> None:
    """Were the lines behind it read by the first header, roll would stand in pitch."""
    swapped = HEAD.replace("Pitch;Roll", "Roll;Pitch")
    log, report = read_one(write(tmp_path, *GOOD[:3], "", swapped, *GOOD[3:]))
    assert (report.records, report.kept, len(log["pitch"])) == (7, 3, 3)
    assert report.dropped == (("behind a header with other columns", 4),)
    assert report.error == "line 6: a header with other columns; only what stands before it was read"


def test_a_column_that_is_named_twice_is_told(tmp_path: Path) -> None:
    head = HEAD.replace("Roll", "Pitch")
    with pytest.raises(InputError, match="line 1: column Pitch stands there twice; each may once"):
        read([write(tmp_path, *GOOD, head=head)])


def test_a_year_that_no_clock_can_hold_is_no_time(tmp_path: Path) -> None:
    """In 64 bits of ns the beginning of 2604 stands where July 2019 does."""
    row = GOOD[5].replace("21/07/2019 10:05:00", "06/02/2604 09:40:00")
    _, report = read_one(write(tmp_path, *GOOD[:5], row))
    assert report.dropped == (("time cannot be read", 1),)


def test_a_line_of_millions_of_cells_costs_no_memory(tmp_path: Path) -> None:
    """A few kB of gzip unpack to it; taken apart it would be a list of 20 million texts, 320 MB."""
    path = tmp_path / "a.gz"
    path.write_bytes(gzip.compress(f"{HEAD}\n".encode() + b";" * 20_000_000 + b"\n"))
    tracemalloc.start()
    _, report = read_one(path)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert report.dropped == (("wrong number of fields", 1),)
    assert most < 200e6  # the text as bytes, as a text and as lines


def test_capitals_make_no_other_vehicle(tmp_path: Path) -> None:
    for name in ("sea035.12.gli.sub.36", "sea035.12.gli.sub.37"):
        source = ROOT / "logs/seaexplorer-sea035" / name
        (tmp_path / (name.upper() if name.endswith("37") else name)).write_bytes(source.read_bytes())
    assert read([tmp_path]).log.metadata["platform"] == "SeaExplorer sea035"
