"""CSV logs: what is written is read back; what cannot be used is named by its line."""

from __future__ import annotations

import io
import json
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from random_logs import possible

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.logio import read, write
from glidercli.logio.own.csv_log import CsvTable

TIMES = st.lists(st.integers(0, 10**18), min_size=1, max_size=12, unique=True).map(sorted)


@st.composite
def logs(draw: st.DrawFn) -> Log:
    names = draw(st.lists(st.sampled_from(sorted(CHANNELS)), min_size=1, max_size=5, unique=True))
    channels = {}
    for name in names:
        times = np.array(draw(TIMES), dtype=np.int64)
        values = draw(st.lists(possible(name), min_size=len(times), max_size=len(times)))
        channels[name] = Channel(name, times, np.array(values))
    return Log(channels, "measured", {"provenance": "{}"})


@settings(deadline=None, max_examples=60)
@given(log=logs())
def test_round_trip(log: Log) -> None:
    with TemporaryDirectory() as folder:
        write(log, Path(folder) / "a.csv")
        back = read([Path(folder) / "a.csv"]).log
    assert set(back.channels) == set(log.channels)
    for name, channel in log.channels.items():
        assert back[name].time_ns.tolist() == channel.time_ns.tolist()
        if CHANNELS[name].factor == 1.0:
            assert back[name].values.tolist() == channel.values.tolist()
        else:  # to the table's unit and back: two roundings of at most 1.1e-16 each; below 1e-300 digits run out
            np.testing.assert_allclose(back[name].values, channel.values, rtol=2.3e-16, atol=1e-300)


def test_the_first_line_is_the_column_names() -> None:
    stream = io.StringIO()
    log = Log({"pitch": Channel("pitch", np.array([0, 10**9]), np.array([0.0, np.pi]))}, "measured")
    CsvTable(stream).add(log)
    assert stream.getvalue().splitlines() == [
        "time_utc,elapsed_s,pitch_deg,origin",
        "1970-01-01T00:00:00.000000000Z,0,0,measured",
        "1970-01-01T00:00:01.000000000Z,1,180,measured",
    ]


def test_provenance_stands_beside(tmp_path: Path) -> None:
    write(Log({"depth": Channel("depth", np.array([0]), np.array([1.0]), "derived")}, "measured"), tmp_path / "a.csv")
    beside = json.loads((tmp_path / "a.csv-metadata.json").read_text(encoding="utf-8"))
    assert beside["origin"] == "measured"
    assert beside["channels"] == {"depth": "derived"}
    assert beside["metadata"]["provenance"]["program"].startswith("glidercli ")


def read_text(tmp_path: Path, text: str) -> tuple[Log, list[tuple[str, int]]]:
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    reading = read([tmp_path / "a.csv"])
    (report,) = reading.files
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    return reading.log, list(report.dropped)


@pytest.mark.parametrize("row", ["1,2", "1,2,3,4", "1"])
def test_a_row_cut_short_or_too_long_is_dropped(tmp_path: Path, row: str) -> None:
    log, dropped = read_text(tmp_path, f"elapsed_s,depth_m,pitch_deg\n0,1,2\n{row}\n")
    assert dropped == [("wrong number of fields", 1)]
    assert log["depth"].values.tolist() == [1.0]


def test_rows_all_longer_than_the_head_give_nothing_wrong(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no usable record: 2 wrong number of fields"):
        read_text(tmp_path, "elapsed_s,depth_m\n0,1,7\n1,2,7\n")


def test_a_row_without_a_value_is_dropped(tmp_path: Path) -> None:
    log, dropped = read_text(tmp_path, "elapsed_s,depth_m,phase\n0,1,\n1,,\n2,NaN,dive\n\n")
    assert dropped == [("no value", 1)]
    assert len(log["depth"]) == len(log["phase"]) == 1


def test_spaces_and_a_byte_order_mark_do_no_harm(tmp_path: Path) -> None:
    log, _ = read_text(tmp_path, "\ufeffelapsed_s , depth_m, note\r\n0, 1 ,a\r\n1, 2 ,b\r\n")
    assert log["depth"].values.tolist() == [1.0, 2.0]
    assert str(log["depth"].time_ns[0].astype("datetime64[ns]")).startswith("2000-01-01T00:00:00")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("elapsed_s,depth_m\n0,inf\n", "no usable record: 1 no value; depth_m: 1 cells left out that are no number"),
        (
            "time_utc,depth_m\n0001-01-01T00:00:00Z,1\n",
            "no usable record: 1 time cannot be read; time_utc: 1 times cannot be read, the first in line 2: '0001-01-01",
        ),
        ("elapsed_s,depth_m,depth_m\n0,1,2\n", "line 1: column depth_m stands there twice"),
        ('elapsed_s,depth_m\n0,"1\n1,2\n', "is not a CSV table"),
    ],
)
def test_what_cannot_be_used_is_named_by_its_line(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_text(tmp_path, text)


def test_a_format_given_wrongly_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("Timestamp;NavState;\n21/07/2019 10:00:00;100;\n")
    with pytest.raises(InputError, match="line 1: no column of times; time_utc or elapsed_s is needed"):
        read([tmp_path / "a"], format="glider-csv")


@pytest.mark.parametrize(
    ("origin", "metadata", "read_as"),
    [
        ("measured", {}, "measured"),
        ("simulated", {}, "simulated"),
        ("simulated", {"reconstruction": "invented water"}, "reconstruction"),
    ],
)
def test_a_table_parted_from_its_metadata_is_not_taken_for_more(
    tmp_path: Path, origin: str, metadata: dict[str, str], read_as: str
) -> None:
    with (tmp_path / "a.csv").open("w") as stream:
        CsvTable(stream).add(Log({"depth": Channel("depth", np.array([0]), np.array([1.0]), origin)}, origin, metadata))
    log = read([tmp_path / "a.csv"]).log
    assert log.origin == log["depth"].origin == read_as


def test_an_origin_is_one_however_it_is_spelt(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("time_utc,depth_m, Origin\n2020-01-01T00:00:00Z,1, Simulated \n")
    reading = read([tmp_path / "a.csv"])
    assert (reading.log.origin, reading.files[0].warnings) == ("simulated", ())


def test_a_table_that_does_not_say_is_warned_of(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("elapsed_s,depth_m\n0,1\n")
    reading = read([tmp_path / "a.csv"])
    assert reading.files[0].warnings == (
        "the date, from 2000-01-01 on, is arbitrary: the table has elapsed_s alone",
        "taken as measured: the table does not say where its values come from",
    )


def mixed() -> Log:
    times = np.array([0, 10**9], np.int64)
    depth, north = (
        Channel(name, times, np.array([1.0, 2.0]), kind) for name, kind in (("depth", "measured"), ("north", "derived"))
    )
    return Log({"depth": depth, "north": north}, "measured", {"provenance": "{}"})


def test_a_table_parted_from_its_metadata_calls_nothing_derived_measured(tmp_path: Path) -> None:
    write(mixed(), tmp_path / "a.csv")
    whole = read([tmp_path / "a.csv"]).log
    assert [whole[name].origin for name in ("depth", "north")] == ["measured", "derived"]
    (tmp_path / "a.csv-metadata.json").unlink()
    parted = read([tmp_path / "a.csv"])
    assert [parted.log[name].origin for name in ("depth", "north")] == ["derived", "derived"]
    assert parted.log.origin == "derived"
    assert parted.log.kind == "DERIVED"
    assert any("which channels are derived is not known" in line for line in parted.files[0].warnings)


def test_metadata_of_another_table_are_refused(tmp_path: Path) -> None:
    write(mixed(), tmp_path / "a.csv")
    made = {name: Channel(name, c.time_ns, c.values, "simulated") for name, c in mixed().channels.items()}
    write(Log(made, "simulated", {"provenance": "{}"}), tmp_path / "b.csv")
    (tmp_path / "b.csv-metadata.json").write_bytes((tmp_path / "a.csv-metadata.json").read_bytes())
    with pytest.raises(InputError, match=r"rows say simulated, b\.csv-metadata\.json says measured and derived"):
        read([tmp_path / "b.csv"])


def table_of(path: Path, seconds: int, *names: str) -> Path:
    times = np.arange(seconds) * 10**9
    write(Log({n: Channel(n, times, np.arange(float(seconds)), "simulated") for n in names}, "simulated"), path)
    return path.with_name(path.name + "-metadata.json")


@pytest.mark.parametrize(
    ("seconds", "names", "why"),
    [(9, ("depth",), "it ends at 1970-01-01T00:00:04"), (5, ("depth", "pitch"), "it tells nothing of pitch")],
)
def test_metadata_of_another_table_of_the_same_origin_are_refused(
    tmp_path: Path, seconds: int, names: tuple[str, ...], why: str
) -> None:
    other = table_of(tmp_path / "a.csv", 5, "depth")
    own = table_of(tmp_path / "b.csv", seconds, *names)
    own.write_bytes(other.read_bytes())
    with pytest.raises(InputError, match=rf"b\.csv: b\.csv-metadata\.json is of another table: {why}"):
        read([tmp_path / "b.csv"])


def test_metadata_of_an_earlier_version_tell_no_times(tmp_path: Path) -> None:
    beside = table_of(tmp_path / "a.csv", 5, "depth")
    told = json.loads(beside.read_text())
    del told["span_ns"]
    told["table_sha256"] = "0"
    beside.write_text(json.dumps(told))
    assert "has changed" in read([tmp_path / "a.csv"]).files[0].warnings[0]


def test_a_table_changed_since_is_said(tmp_path: Path) -> None:
    write(mixed(), tmp_path / "a.csv")
    assert read([tmp_path / "a.csv"]).files[0].warnings == ()
    text = (tmp_path / "a.csv").read_text().splitlines(keepends=True)
    (tmp_path / "a.csv").write_text("".join(text[:-1]))
    (warning,) = read([tmp_path / "a.csv"]).files[0].warnings
    assert "has changed since a.csv-metadata.json was written" in warning
