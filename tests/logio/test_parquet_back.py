"""Does a Log survive Parquet and CSV, and is another program's Parquet table read as a CSV is?"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from random_logs import AFTER_1970, assert_near, assert_same, logs

from glidercli.errors import InputError
from glidercli.log import Channel, Event, Log
from glidercli.logio import read, write
from glidercli.logio.mcap.reader import read_mcap_log
from glidercli.logio.mcap.writer import write_mcap
from glidercli.logio.own.csv_log import read_csv
from glidercli.logio.own.parquet_back import read_own_parquet


@settings(deadline=None, max_examples=80)  # no deadline: the first example imports pyarrow
@given(log=logs())
def test_a_log_comes_back_from_parquet(log: Log, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("pq") / "a.parquet"
    log = log if "provenance" in log.metadata else log.with_metadata(provenance="{}")
    write(log, path)
    assert_near(read_own_parquet(path).log, log)


@settings(deadline=None, max_examples=60)
@given(log=logs(sampled=True))  # a table has no column for a channel that has no sample
def test_a_log_comes_back_from_csv(log: Log, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("csv") / "a.csv"
    log = log if "provenance" in log.metadata else log.with_metadata(provenance="{}")
    write(log, path)
    if log.channels:
        assert_near(read_csv(path).log, log)


@settings(deadline=None, max_examples=60)
@given(log=logs(times=AFTER_1970))
def test_a_log_comes_back_from_mcap(log: Log, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("mcap") / "a.mcap"
    write_mcap(log, path)
    assert_same(read_mcap_log(path), log)


def table() -> pd.DataFrame:
    times = pd.to_datetime(["2020-01-01T00:00:00", "2020-01-01T00:00:01", "2020-01-01T00:00:02"])
    return pd.DataFrame({"time_utc": times, "depth_m": [1.0, np.nan, 3.0], "pitch_deg": [np.nan, np.nan, 45.0]})


def test_a_table_of_pandas_is_taken_as_measured_with_a_warning(tmp_path: Path) -> None:
    table().assign(other=1).to_parquet(tmp_path / "a.parquet")
    reading = read([tmp_path / "a.parquet"])
    (report,) = reading.files
    assert (report.format, report.records, report.kept, report.dropped) == ("glider-parquet", 3, 2, (("no value", 1),))
    assert report.warnings == (
        "columns not known and not used: other",
        "taken as measured: the table does not say where its values come from",
    )
    assert reading.log["pitch"].values.tolist() == [np.pi / 4.0]
    assert reading.log.origin == "measured"


def test_a_column_named_origin_is_heeded(tmp_path: Path) -> None:
    table().assign(origin="simulated").to_parquet(tmp_path / "a.parquet")
    reading = read([tmp_path / "a.parquet"])
    assert (reading.log.origin, reading.files[0].warnings) == ("simulated", ())


@pytest.mark.parametrize("texts", [True, False])
def test_texts_and_seconds_are_times_too(tmp_path: Path, texts: bool) -> None:
    changed = table()
    if texts:
        changed["time_utc"] = ["2020-01-01T00:00:00Z", "2020-01-01T00:00:01Z", "2020-01-01T00:00:02.5Z"]
    else:
        changed = changed.drop(columns="time_utc").assign(elapsed_s=[0.0, 1.0, 2.5])
    changed.to_parquet(tmp_path / "a.parquet")
    depth = read([tmp_path / "a.parquet"]).log["depth"]
    assert depth.time_ns[1] - depth.time_ns[0] == 2_500_000_000
    assert str(depth.time_ns[0].astype("datetime64[ns]"))[:4] == ("2020" if texts else "2000")


@pytest.mark.parametrize(
    ("column", "values", "words"),
    [
        ("depth_m", [[1.0], [2.0], [3.0]], "depth_m is a column of"),
        ("time_utc", ["soon", "later", "9999-01-01"], "no usable record: 3 time cannot be read; .* row 1: 'soon'"),
        ("time_utc", [[1.0], [2.0], [3.0]], "its times are a column of"),
        ("origin", ["seen", "seen", "seen"], "line 1: origin = 'seen'"),
    ],
)
def test_what_cannot_be_used_is_named_by_its_row(tmp_path: Path, column: str, values: list[object], words: str) -> None:
    table().assign(**{column: values}).to_parquet(tmp_path / "a.parquet")
    with pytest.raises(InputError, match=words):
        read([tmp_path / "a.parquet"])


def test_damage_and_strangers_are_one_line(tmp_path: Path) -> None:
    (tmp_path / "a.parquet").write_bytes(b"PAR1 and more")
    with pytest.raises(InputError, match="damaged or cut short"):
        read([tmp_path / "a.parquet"], format="glider-parquet")
    pd.DataFrame({"x": [1]}).to_parquet(tmp_path / "b.parquet")
    with pytest.raises(InputError, match="has no column of times"):
        read([tmp_path / "b.parquet"], format="glider-parquet")


def test_the_samples_are_those_that_pandas_counts(tmp_path: Path) -> None:
    times = np.arange(50) * 10**9
    log = Log(
        {
            "depth": Channel("depth", times, times * 1e-9),
            "roll": Channel("roll", times[::7], times[::7] * 1e-12, "derived"),
        },
        "measured",
        {"provenance": "{}"},
        (Event("apogee", 7, None),),
    )
    write(log, tmp_path / "a.parquet", tmp_path / "a.csv")
    for name, told in (
        ("a.parquet", pd.read_parquet(tmp_path / "a.parquet")),
        ("a.csv", pd.read_csv(tmp_path / "a.csv")),
    ):
        reading = read([tmp_path / name])
        assert reading.files[0].records == reading.files[0].kept == len(told)
        assert {"depth": told["depth_m"].count(), "roll": told["roll_deg"].count()} == {
            n: len(c) for n, c in reading.log.channels.items()
        }
        assert_near(reading.log, log)
