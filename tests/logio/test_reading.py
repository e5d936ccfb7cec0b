"""Files, folders and globs; CSV round trip; outputs whole."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, Run

from glidercli.errors import InputError, OutputError, UsageError
from glidercli.log import Channel, Event, Log
from glidercli.logio import read, replay, write

LOGS = ROOT / "logs/seaexplorer-sea035"


def sample() -> Log:
    t = np.array([0, 10**9, 3 * 10**9], dtype=np.int64) + 1_563_000_000 * 10**9
    return Log(
        {
            "depth": Channel("depth", t, np.array([1.0, 2.5, 1 / 3]), "simulated"),
            "pitch": Channel("pitch", t[1:], np.array([-0.1, 0.7]), "simulated"),
            "phase": Channel("phase", t[:2], np.array([1.0, 2.0]), "simulated"),
        },
        "simulated",
        {"title": 'a, "b"', "provenance": "{}"},
        (Event("apogee", int(t[1]), 2.5),),
    )


def test_csv_round_trip(tmp_path: Path) -> None:
    log = sample()
    write(log, tmp_path / "a.csv")
    back = read([tmp_path / "a.csv"]).log
    assert back.origin == "simulated"
    assert back.events == log.events
    assert back.metadata["title"] == log.metadata["title"]
    for name, channel in log.channels.items():
        assert (back[name].time_ns == channel.time_ns).all()
        np.testing.assert_allclose(back[name].values, channel.values, rtol=4e-16)  # degrees and back: two roundings


def test_mcap_and_csv_read_by_content_not_by_name(tmp_path: Path) -> None:
    write(sample(), tmp_path / "a.mcap")
    os.rename(tmp_path / "a.mcap", tmp_path / "b.bin")
    assert read([tmp_path / "b.bin"]).files[0].format == "glider-mcap"


def test_folder_glob_and_files_are_the_same_log() -> None:
    folder, pattern = read([LOGS]), read([str(LOGS / "*.sub.*")])
    single = read(sorted(LOGS.glob("*.sub.*")))
    for other in (pattern, single):
        assert {n: len(c) for n, c in other.log.channels.items()} == {n: len(c) for n, c in folder.log.channels.items()}
    assert len(folder.files) == 6


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("e.csv", b"", "is empty"),
        ("b.csv", bytes(range(256)), "not a log that can be read"),
        ("t.csv", b"time_utc,depth_m\n2020-01-01T00:00:00Z,deep\n", "no number, the first in line 2: 'deep'"),
        ("n.csv", b"elapsed_s,depth_m\nnan,1\n", "1 times cannot be read, the first in line 2: 'nan'"),
    ],
)
def test_bad_files_are_named(tmp_path: Path, name: str, data: bytes, words: str) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(InputError, match=words):
        read([tmp_path / name])


def test_missing_file_empty_folder_and_empty_glob(tmp_path: Path) -> None:
    for target in (tmp_path / "none.csv", tmp_path, str(tmp_path / "*.csv")):
        with pytest.raises(InputError):
            read([target])


def test_outputs_are_whole_or_not_there(tmp_path: Path) -> None:
    write(sample(), tmp_path / "a.csv")
    before = (tmp_path / "a.csv").read_bytes()
    with pytest.raises(OutputError, match="--force"):
        write(sample(), tmp_path / "a.csv")
    assert (tmp_path / "a.csv").read_bytes() == before
    write(sample(), tmp_path / "a.csv", force=True)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.csv", "a.csv-metadata.json"]


def test_outputs_beside_recordings_are_passed_over(tmp_path: Path) -> None:
    for name in ("sea035.12.gli.sub.36", "sea035.12.pld1.sub.36"):
        shutil.copy(LOGS / name, tmp_path)
    alone = read([tmp_path])
    write(alone.log, tmp_path / "out.csv", tmp_path / "out.mcap")
    again = read([tmp_path])
    outputs = [report for report in again.files if report.path.stem == "out"]
    assert [(r.kept, r.dropped[-1][0]) for r in outputs] == [(0, "an output of this program beside recordings")] * 2
    assert again.log.channels.keys() == alone.log.channels.keys()
    assert len(read([tmp_path / "out.csv"]).log["depth"]) == len(alone.log["depth"])  # by itself it is read


def test_impossible_values_of_a_strangers_table_are_counted(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("elapsed_s,depth_m,salinity\n0,1,35\n1,-70,35\n2,9999999,-9\n3,4,\n")
    (report,) = read([tmp_path / "a.csv"]).files
    assert [w for w in report.warnings if "outside" in w] == [
        "depth_m: 2 values outside -10..12000 m left out",
        "salinity: 1 values outside 0..45 1 left out",
    ]
    assert (report.records, report.kept, report.dropped) == (4, 3, (("no usable value", 1),))


def test_a_folder_that_cannot_be_used_says_why(tmp_path: Path) -> None:
    (tmp_path / "inside").mkdir()
    with pytest.raises(InputError, match=r"holds no log \(1 folders in it are not looked into\)"):
        read([tmp_path])
    (tmp_path / "a.gz").write_bytes(b"\x1f\x8b damaged")
    with pytest.raises(InputError, match=r"a\.gz: is gzip data that unpack to no log"):
        read([tmp_path])
    with pytest.raises(InputError, match="is no folder"):
        read([LOGS], cache=tmp_path / "none")
    with pytest.raises(InputError, match="no such file"):
        read([LOGS], columns=tmp_path / "none.toml")


def test_names_cannot_write_to_the_terminal(glider: Run, tmp_path: Path) -> None:
    shutil.copy(LOGS / "sea035.12.gli.sub.36", tmp_path / "a\x1b[31mred\nline")
    shutil.copy(LOGS / "sea035.12.gli.sub.37", tmp_path / "b")
    (tmp_path / "c\x1b").write_text("no log\n")
    for command in ("info", "replay"):
        done = glider(command, tmp_path)
        assert done.returncode == 0
        assert "\x1b" not in done.stdout + done.stderr
        assert r"a\x1b[31mred\nline" in done.stdout


def test_files_stand_in_the_order_of_their_numbers(tmp_path: Path) -> None:
    for number in (100, 1000, 99, 101, 1001):
        shutil.copy(LOGS / "sea035.12.gli.sub.37", tmp_path / f"sea035.12.gli.sub.{number}")
    for given in (tmp_path, str(tmp_path / "*.sub.*")):
        assert [report.path.suffix for report in read([given]).files] == [".99", ".100", ".101", ".1000", ".1001"]


def test_a_glob_that_only_folders_match_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match="no file matches"):
        read([str(tmp_path / "fold*")])


@pytest.mark.parametrize("text", ["9999-01-01", "1500-01-01T00:00:00Z", "07/08/2019", "nan"])
def test_a_moment_is_iso_8601_within_what_can_be_told(text: str) -> None:
    with pytest.raises(UsageError, match="ISO 8601"):
        replay([LOGS], start=text)


def test_tables_with_times_of_another_age_are_named(tmp_path: Path) -> None:
    import pandas as pd

    pd.DataFrame({"time_utc": ["2604-02-06T09:40:00Z"], "depth_m": [1.0]}).to_parquet(tmp_path / "a.parquet")
    with pytest.raises(InputError, match="1 times cannot be read, the first in row 1: '2604-02-06T09:40:00Z'"):
        read([tmp_path / "a.parquet"])


@pytest.mark.parametrize("link", ["symlink_to", "hardlink_to"])
def test_a_file_with_two_names_is_read_once_under_its_own(tmp_path: Path, link: str) -> None:
    """A link that sorts first does not hide the name that tells the vehicle."""
    name = "sea063.22.gli.sub.121.gz"
    shutil.copy(ROOT / "tests/data/seaexplorer" / name, tmp_path)
    getattr(tmp_path / "z.gz", link)(tmp_path / name)
    (tmp_path / "a.gz").symlink_to(tmp_path / name)
    for given in ([tmp_path], [tmp_path / "z.gz", tmp_path / name, tmp_path / "a.gz"]):
        files = read(given).files
        assert len(files) == 1
        assert link == "hardlink_to" or files[0].path == tmp_path / name


def test_a_file_in_reverse_is_doubted(tmp_path: Path) -> None:
    rows = [f"2020-01-01T00:00:{second:02d}Z,{second}.5,measured" for second in reversed(range(50))]
    (tmp_path / "a.csv").write_text("\n".join(["time_utc,depth_m,origin", *rows]) + "\n")
    (report,) = read([tmp_path / "a.csv"]).files
    assert report.kept == 1
    assert "49 of 50 records are not in the order of time" in report.warnings[0]
