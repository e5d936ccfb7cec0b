"""Nothing derived, simulated or rebuilt is called measured; nothing is lost in silence when files are joined."""

from __future__ import annotations

import json
import math
import re
import shutil
from pathlib import Path

import gsw
import numpy as np
import pytest
from conftest import ROOT, Run, one_line_error

from glidercli.channels import PHASES
from glidercli.errors import InputError, OutputError
from glidercli.log import Channel, Log
from glidercli.logio import overview, read, replay, write
from glidercli.logio.derived.seawater import with_seawater
from glidercli.logio.derived.track import with_track
from glidercli.logio.report import FileReport
from glidercli.logio.seaexplorer import read_seaexplorer

LOGS = ROOT / "logs/seaexplorer-sea035"
GZIP = ROOT / "tests/data/seaexplorer/sea063.22.gli.sub.120.gz"
NAVIGATION = LOGS / "sea035.12.gli.sub.37"
SECOND = 10**9


def read_one(path: Path) -> tuple[Log, FileReport]:
    part = read_seaexplorer(path)
    assert len(part.record_ns) == part.report.kept
    return part.log, part.report


def depth_log(start: int, n: int, origin: str = "measured", **metadata: str) -> Log:
    times = (start + np.arange(n)) * SECOND
    return Log({"depth": Channel("depth", times, np.arange(float(n)), origin)}, origin, metadata)


@pytest.mark.parametrize("ending", [".csv", ".mcap"])
def test_origins_survive_a_round_trip(tmp_path: Path, ending: str) -> None:
    log = read([LOGS]).log
    write(log, tmp_path / f"a{ending}")
    back = read([tmp_path / f"a{ending}"]).log
    assert {n: c.origin for n, c in back.channels.items()} == {n: c.origin for n, c in log.channels.items()}
    assert {"north", "east", "down", "salinity", "vertical_speed"} <= {
        name for name, channel in back.channels.items() if channel.origin == "derived"
    }


def test_the_reconstructed_controls_are_not_called_measured() -> None:
    log = read([ROOT / "logs/south-china-sea-2011/dive.csv"]).log
    assert log.origin == "reconstruction"
    assert {channel.origin for channel in log.channels.values()} == {"reconstruction"}


def test_a_table_is_the_least_that_a_row_says(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("elapsed_s,depth_m,origin\n0,1,measured\n1,2,simulated\n")
    reading = read([tmp_path / "a.csv"])
    assert reading.log.origin == "simulated"
    assert "simulated, measured" in reading.files[0].warnings[0]


def test_a_table_that_says_nothing_is_told_of(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("elapsed_s,depth_m\n0,1\n1,2\n")
    metadata = read([tmp_path / "a.csv"]).log.metadata
    assert "taken as measured" in metadata["origin_note"]
    assert "arbitrary" in metadata["time_note"]


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("{", "no JSON"),
        ("[]", "no object"),
        ("{}", "without a proper origin, metadata, channels, events"),
        ('{"origin": 1, "channels": {}, "metadata": {}, "events": []}', "without a proper origin"),
        ('{"origin": "true", "channels": {}, "metadata": {}, "events": []}', "origins are measured, derived"),
        ('{"origin": "measured", "channels": {"depth": []}, "metadata": {}, "events": []}', "origins are measured"),
        ('{"origin": "measured", "channels": {}, "metadata": {}, "events": [{"name": "apogee"}]}', "event of"),
        ('{"origin": "measured", "channels": {}, "metadata": {}, "events": [], "span_ns": "1"}', "proper span_ns"),
    ],
)
def test_metadata_of_another_kind_are_named(tmp_path: Path, text: str, why: str) -> None:
    (tmp_path / "a.csv").write_text("elapsed_s,depth_m\n0,1\n")
    (tmp_path / "a.csv-metadata.json").write_text(text)
    with pytest.raises(InputError, match=r"a\.csv-metadata\.json is not the metadata of a log's CSV: ") as caught:
        read([tmp_path / "a.csv"])
    assert why in str(caught.value)
    assert str(caught.value).count("a.csv: ") == 1
    assert "Error" not in str(caught.value)


def test_an_unknown_origin_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("elapsed_s,depth_m,origin\n0,1,hearsay\n")
    with pytest.raises(InputError, match=r"line 2: origin = 'hearsay'; allowed: .*measured"):
        read([tmp_path / "a.csv"])


def test_the_same_records_twice_are_counted(tmp_path: Path) -> None:
    for name in ("a.gli", "b.gli"):
        shutil.copy(NAVIGATION, tmp_path / name)
    reading = read([tmp_path])
    once, twice = reading.files
    assert (once.kept, twice.kept) == (504, 0)
    assert twice.dropped == (("time not after the file before it", 504),)
    assert twice.error is not None
    assert len(reading.log["depth"]) == 504
    assert len(read([NAVIGATION, str(NAVIGATION), NAVIGATION.parent / "." / NAVIGATION.name]).files) == 1


def test_overlapping_files_add_up(tmp_path: Path) -> None:
    write(depth_log(0, 10), tmp_path / "a.csv")
    write(depth_log(6, 10), tmp_path / "b.csv")
    reading = read([tmp_path / "b.csv", tmp_path / "a.csv"])
    later, earlier = reading.files  # in the order given
    assert (earlier.records, earlier.kept, earlier.dropped) == (10, 10, ())
    assert (later.records, later.kept, later.dropped) == (10, 6, (("time not after the file before it", 4),))
    assert reading.log["depth"].time_ns.tolist() == [t * SECOND for t in range(16)]
    assert reading.log["depth"].values.tolist() == [*range(10), *range(4, 10)]


def test_files_far_apart_are_joined_and_it_is_said(tmp_path: Path) -> None:
    write(depth_log(0, 3), tmp_path / "a.csv")
    write(depth_log(5 * 86400, 3), tmp_path / "b.csv")
    assert any("starts 5 days after the end of" in warning for warning in read([tmp_path]).files[1].warnings)
    write(depth_log(763 * 86400, 3), tmp_path / "b.csv", force=True)
    reading = read([tmp_path])
    assert any("starts 2 years and 33 days after" in warning for warning in reading.files[1].warnings)
    silence = overview(reading).silence
    assert silence == (2 * SECOND, 763 * 86400 * SECOND)


def test_origins_do_not_mix(tmp_path: Path) -> None:
    write(depth_log(0, 3), tmp_path / "a.csv")
    write(depth_log(10, 3, "simulated"), tmp_path / "b.csv")
    with pytest.raises(InputError, match=r"b\.csv: is simulated, .*a\.csv is measured"):
        read([tmp_path])


def test_tracks_about_different_places_do_not_mix(tmp_path: Path) -> None:
    for start, latitude in ((0, "48.0"), (10, "49.0")):
        log = depth_log(start, 3, origin_latitude_deg=latitude, origin_longitude_deg="1.0")
        north = Channel("north", log["depth"].time_ns, log["depth"].values, "derived")
        write(log.with_channels(north), tmp_path / f"{start}.csv")
    with pytest.raises(InputError, match="track about another origin"):
        read([tmp_path])


def test_a_damaged_file_of_a_folder_is_named_and_a_note_is_not(tmp_path: Path) -> None:
    shutil.copy(NAVIGATION, tmp_path)
    (tmp_path / "sea035.12.gli.sub.38").write_bytes(bytes(range(256)) * 4)
    (tmp_path / "sea035.12.gli.sub.39").write_bytes(b"")
    (tmp_path / "README.md").write_text("notes\n")
    (tmp_path / "LICENSE-Apache-2.0").write_text("text\n")
    played = replay([tmp_path])
    assert [report.path.name for report in played.broken] == ["sea035.12.gli.sub.38", "sea035.12.gli.sub.39"]
    assert [entry["warnings"] for entry in played.document()["files"]][2] == ["is empty"]
    with pytest.raises(InputError, match=r"sub\.38: .*--strict.*1 more"):
        replay([tmp_path], [tmp_path / "a.csv"], strict=True)
    assert not (tmp_path / "a.csv").exists()


@pytest.mark.parametrize("part", [0.3, 0.6, 0.95])
def test_a_cut_gzip_file_is_read_as_far_as_it_goes(tmp_path: Path, part: float) -> None:
    whole, _ = read_one(GZIP)
    path = tmp_path / "cut.gz"
    path.write_bytes(GZIP.read_bytes()[: int(part * GZIP.stat().st_size)])
    reading = read([path])
    (report,) = reading.files
    assert "gzip" in (report.error or "")
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    n = len(reading.log["depth"])
    assert 0 < n < len(whole["depth"])
    assert reading.log["depth"].values.tolist() == whole["depth"].values[:n].tolist()


def test_a_cut_last_line_is_dropped_whatever_it_ends_in(tmp_path: Path) -> None:
    whole = NAVIGATION.read_bytes().rstrip(b"\n")
    for cut in (1, 3, 40):
        (tmp_path / "a").write_bytes(whole[:-cut])
        _, report = read_one(tmp_path / "a")
        assert (report.records, report.kept) == (504, 503), cut
        assert report.dropped == (("wrong number of fields", 1),)


def test_density_without_a_place_makes_none_up() -> None:
    times = np.array([0, SECOND])
    given = {"conductivity": [4.0, 3.5], "temperature": [15.0, 5.0], "pressure": [1e5, 7e6]}
    water = {name: Channel(name, times, np.array(values)) for name, values in given.items()}
    density = with_seawater(Log(water, "measured"))["density"].values
    practical = gsw.SP_from_C(np.array([40.0, 35.0]), np.array([15.0, 5.0]), np.array([10.0, 700.0]))
    reference = gsw.rho_t_exact(practical * 35.16504 / 35.0, np.array([15.0, 5.0]), np.array([10.0, 700.0]))
    np.testing.assert_allclose(density, reference, rtol=1e-14)  # a few roundings


def gliding(phase: str, **fixes: Channel) -> Log:
    times = np.arange(0, 1001, 10) * SECOND
    values = {"depth": 0.2 * times / SECOND, "pitch": np.full(len(times), math.radians(-30.0)), "heading": 0.0 * times}
    channels = {name: Channel(name, times, value) for name, value in values.items()}
    channels["phase"] = Channel("phase", times, np.full(len(times), float(PHASES.index(phase))), "derived")
    return Log({**channels, **fixes}, "measured")


def test_nothing_is_reckoned_at_the_surface() -> None:
    assert np.abs(with_track(gliding("surface"))["north"].values).max() == 0.0
    assert with_track(gliding("dive"))["north"].values[-1] > 300.0  # 200 m down at 30 deg: 346 m


def test_what_no_fix_corrects_is_told() -> None:
    at = np.array([100, 300]) * SECOND
    fixes = {
        "latitude": Channel("latitude", at, np.array([48.9, 48.901])),
        "longitude": Channel("longitude", at, at * 0.0),
    }
    note = with_track(gliding("dive", **fixes)).metadata["track_note"]
    assert "in the 100 s before the first fix, 1970-01-01T00:01:40Z" in note
    assert "in the 700 s after the last fix, 1970-01-01T00:05:00Z" in note
    assert note.count("depth-averaged current") == 1


def test_the_shipped_log_says_that_its_last_dive_has_no_closing_fix(glider: Run) -> None:
    done = glider("replay", LOGS)
    assert done.returncode == 0
    assert "not corrected for current in the 9435 s after the last fix, 2019-07-22T02:46:39Z" in done.stdout


def test_the_vehicles_own_dead_reckoning_runs_along_the_recorded_heading() -> None:
    """Why heading is taken as true: with 6 deg of Declination to add, the course would lie 6 deg beside Heading."""
    import gzip

    path = ROOT / "tests/data/seaexplorer/sea063.22.gli.sub.121.gz"
    rows = [line.split(";") for line in gzip.decompress(path.read_bytes()).decode().splitlines()]
    columns = {name: [row[i] for row in rows[1:]] for i, name in enumerate(rows[0])}
    assert {float(text) for text in columns["Declination"]} == {6.0}

    def minutes(text: str) -> float:
        value = float(text)
        return math.copysign(abs(value) // 100 * 60 + abs(value) % 100, value)

    latitude, longitude = (np.array([minutes(text) for text in columns[name]]) for name in ("Lat", "Lon"))
    heading = np.radians([float(text) for text in columns["Heading"]])
    way = np.diff(latitude) + 1j * np.diff(longitude) * math.cos(math.radians(latitude[0] / 60.0))
    beside = np.angle((way * np.exp(-1j * heading[1:])).sum())
    assert abs(math.degrees(beside)) < 2.0  # the steps are rounded to 1.9 m; of 6 m each, over 50 of them: 1 deg


def test_strict_is_one_line(glider: Run, tmp_path: Path) -> None:
    shutil.copy(NAVIGATION, tmp_path)
    (tmp_path / "bad").write_bytes(b"\x00")
    one_line_error(glider("replay", NAVIGATION.name, "bad", "--strict", "--json", "-o", "o.mcap"), "bad")
    assert not (tmp_path / "o.mcap").exists()
    document = json.loads(glider("replay", NAVIGATION.name, "bad", "--json").stdout)
    assert document["files"][1]["records"] == document["files"][1]["kept"] == 0
    assert document["files"][1]["warnings"]


@pytest.mark.parametrize("taken", ["b.csv-metadata.json", "b.csv"])
def test_outputs_are_refused_before_any_is_written(tmp_path: Path, taken: str) -> None:
    (tmp_path / taken).write_text("mine")
    with pytest.raises(OutputError, match=rf"{re.escape(taken)}: exists; --force"):
        replay([NAVIGATION], [tmp_path / "a.mcap", tmp_path / "b.csv"])
    assert [path.name for path in tmp_path.iterdir()] == [taken]
    assert (tmp_path / taken).read_text() == "mine"


def test_a_table_whose_metadata_cannot_be_written_leaves_no_other_output(tmp_path: Path) -> None:
    (tmp_path / "b.csv-metadata.json").mkdir()
    with pytest.raises(OutputError, match=r"metadata\.json: is a folder"):
        write(depth_log(0, 3), *(tmp_path / name for name in ("a.mcap", "b.csv", "c.mcap")), force=True)
    assert [path.name for path in tmp_path.iterdir()] == ["b.csv-metadata.json"]


@pytest.mark.parametrize("name", ["a.csv", "a.mcap"])
def test_every_output_carries_provenance(tmp_path: Path, name: str) -> None:
    write(depth_log(0, 3), tmp_path / name)
    record = json.loads(read([tmp_path / name]).log.metadata["provenance"])
    assert record["program"].startswith("glidercli ")
    assert record["origin"] == "measured"


def test_two_vehicles_are_not_one_log() -> None:
    with pytest.raises(InputError, match=r"is of SeaExplorer sea063, .* of SeaExplorer sea035; read them one by one"):
        read([ROOT / "logs/seaexplorer-sea035", ROOT / "tests/data/seaexplorer"])
