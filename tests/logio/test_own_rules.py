"""Are the program's own files read by the rules for recordings? Every record kept or named, nothing impossible kept."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import netCDF4
import numpy as np
import pandas as pd
import pytest
from conftest import Run, one_line_error
from hypothesis import given, settings
from random_logs import AFTER_1970, logs

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.logio import FileReport, read, write
from glidercli.logio.formats import read_file
from glidercli.logio.plausible import quantity_of
from glidercli.logio.reader import Aids, Part

SECOND = 10**9
START = 1_577_836_800 * SECOND
"""2020-01-01."""
ENDINGS = (".csv", ".parquet", ".nc", ".mcap")
METADATA = {"provenance": "{}"}


def read_one(path: Path) -> Part:
    part = read_file(path, None, Aids())
    report = part.report
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    assert len(part.record_ns) == report.kept
    assert (np.diff(part.record_ns) > 0).all()
    return part


@pytest.mark.parametrize("ending", ENDINGS)
@settings(deadline=None, max_examples=40)
@given(log=logs(times=AFTER_1970, absurd=True))
def test_of_an_absurd_log_what_is_possible_comes_back(
    ending: str, log: Log, tmp_path_factory: pytest.TempPathFactory
) -> None:
    if not any(map(len, log.channels.values())):
        return
    path = tmp_path_factory.mktemp("own") / f"a{ending}"
    write(log if "provenance" in log.metadata else log.with_metadata(provenance="{}"), path)
    part = read_one(path)
    times = np.unique(np.concatenate([c.time_ns for c in log.channels.values()]))
    assert part.report.records == len(times)
    for name, channel in log.channels.items():
        low, high = quantity_of(name).low, quantity_of(name).high
        inside = (channel.values >= low) & (channel.values <= high)
        told = [line for line in part.report.warnings if line.startswith(f"{CHANNELS[name].column}: ")]
        outside = f"{CHANNELS[name].column}: {int((~inside).sum())} values outside "
        assert len(told) == (not inside.all())
        assert all(line.startswith(outside) for line in told)
        if ending in (".nc", ".mcap") or inside.any():
            back = part.log[name]
            assert back.time_ns.tolist() == channel.time_ns[inside].tolist()
            if CHANNELS[name].factor == 1.0:
                assert back.values.tolist() == channel.values[inside].tolist()
            if ending in (".nc", ".mcap"):
                assert back.values.tobytes() == channel.values[inside].tobytes()  # bytes: -0.0 is not 0.0


def flight(n: int = 6, origin: str = "measured") -> Log:
    times = START + np.arange(n) * SECOND
    values = {"depth": np.arange(n) + 1.0, "pitch": np.full(n, -0.3), "temperature": np.full(n, 10.0)}
    return Log({name: Channel(name, times, given, origin) for name, given in values.items()}, origin, METADATA)


def spoiled(path: Path, column: str, row: int, value: float) -> Path:
    """The flight in a file that another hand has changed. column : of tables. value : in the unit of the channel."""
    spec = next(spec for spec in CHANNELS.values() if spec.column == column)
    if path.suffix == ".nc":
        write(flight(), path)
        with netCDF4.Dataset(path, "a") as file:
            file[spec.name][row] = value
        return path
    if path.suffix == ".mcap":
        whole = flight()
        values = whole[spec.name].values.copy()
        values[row] = value
        write(whole.with_channels(Channel(spec.name, whole[spec.name].time_ns, values)), path)
        return path
    table = flight().table()
    table.loc[row, column] = value * spec.factor
    if path.suffix == ".csv":
        table.assign(origin="measured").to_csv(path, index=False)
    else:
        table.assign(origin="measured").to_parquet(path)
    return path


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize(
    ("column", "value", "words"),
    [
        ("depth_m", 1e308, "depth_m: 1 values outside -10..12000 m left out"),
        ("depth_m", -1e5, "depth_m: 1 values outside -10..12000 m left out"),
        ("pitch_deg", 50.0, "pitch_deg: 1 values outside -90..90 deg left out"),
        ("temperature_degC", 9999.0, "temperature_degC: 1 values outside -3..45 degC left out"),
    ],
)
def test_what_cannot_be_is_left_out_of_every_format_alike(
    tmp_path: Path, ending: str, column: str, value: float, words: str
) -> None:
    part = read_one(spoiled(tmp_path / f"a{ending}", column, 2, value))
    assert (part.report.records, part.report.kept) == (6, 6)
    assert part.report.warnings == (words,)
    name = next(spec.name for spec in CHANNELS.values() if spec.column == column)
    assert part.log[name].time_ns.tolist() == [START + i * SECOND for i in (0, 1, 3, 4, 5)]
    assert len(part.log["depth" if name != "depth" else "pitch"]) == 6


@pytest.mark.parametrize("ending", [".csv", ".parquet", ".nc"])
def test_a_cell_that_is_no_number_costs_itself_alone(tmp_path: Path, ending: str) -> None:
    part = read_one(spoiled(tmp_path / f"a{ending}", "depth_m", 3, np.inf))
    where = {".csv": ", the first in line 5: 'inf'", ".parquet": ", the first in row 4: 'inf'", ".nc": ""}[ending]
    assert part.report.warnings == (f"depth_m: 1 cells left out that are no number{where}",)
    assert (part.report.kept, len(part.log["depth"]), len(part.log["pitch"])) == (6, 5, 6)


ROWS = [f"2020-01-01T00:00:0{i}Z,{i + 1},dive" for i in range(5)]


def table(path: Path, *rows: str, head: str = "time_utc,depth_m,phase") -> Path:
    """The rows as CSV, or, by the ending of the path, as Parquet with texts for cells."""
    cells = [row.split(",") for row in rows]
    if path.suffix == ".parquet":
        pd.DataFrame([[cell or None for cell in row] for row in cells], columns=head.split(",")).to_parquet(path)
    else:
        path.write_text("\n".join([head, *rows]) + "\n")
    return path


@pytest.mark.parametrize("ending", [".csv", ".parquet"])
@pytest.mark.parametrize(
    ("row", "reason"),
    [
        ("soon,9,dive", "time cannot be read"),
        ("9999-01-01,9,dive", "time cannot be read"),
        (",9,dive", "time cannot be read"),
        ("2020-01-01T00:00:04Z,9,dive", "time repeats"),
        ("2020-01-01T00:00:01Z,9,dive", "time goes back"),
        ("2020-01-01T00:00:05Z,,", "no value"),
        ("2020-01-01T00:00:05Z,12m,", "no value"),
        ("2020-01-01T00:00:05Z,-1e5,", "no usable value"),
    ],
)
def test_a_row_that_cannot_be_used_is_dropped_by_name(tmp_path: Path, ending: str, row: str, reason: str) -> None:
    part = read_one(table(tmp_path / f"a{ending}", *ROWS, row))
    assert (part.report.records, part.report.kept, part.report.dropped) == (6, 5, ((reason, 1),))
    assert part.log["depth"].values.tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]


def test_a_clock_that_runs_ahead_for_a_row_takes_nothing_with_it(tmp_path: Path) -> None:
    part = read_one(table(tmp_path / "a.csv", *ROWS[:2], "2020-05-01T00:00:00Z,9,dive", *ROWS[2:]))
    assert part.report.dropped == (("time runs ahead of those after it", 1),)


@pytest.mark.parametrize("ending", [".csv", ".parquet"])
def test_the_first_of_what_cannot_be_read_is_shown(tmp_path: Path, ending: str) -> None:
    rows = [*ROWS, "soon,9,dive", "later,9,dive", "2020-01-01T00:00:06Z,12m,glide"]
    where = "row" if ending == ".parquet" else "line"
    first = 6 if ending == ".parquet" else 7
    warnings = read_one(table(tmp_path / f"a{ending}", *rows)).report.warnings
    assert f"time_utc: 2 times cannot be read, the first in {where} {first}: 'soon'; needed is UTC in" in warnings[1]
    assert f"depth_m: 1 cells left out that are no number, the first in {where} {first + 2}: '12m'" in warnings
    assert f"phase: 1 cells left out that are no phase, the first in {where} {first + 2}: 'glide'" in warnings


@pytest.mark.parametrize(
    ("change", "dropped"),
    [
        (lambda time_ns: np.where(np.arange(6) == 4, time_ns[3], time_ns), (("time repeats", 1),)),
        (lambda time_ns: np.where(np.arange(6) == 4, time_ns[1] - 5, time_ns), (("time goes back", 1),)),
        (lambda time_ns: np.where(np.arange(6) == 5, -(2**63), time_ns), (("time cannot be read", 1),)),
        (lambda time_ns: time_ns[::-1], (("time runs ahead of those after it", 5),)),
    ],
)
def test_times_of_a_netcdf_file_that_do_not_increase_are_dropped(
    tmp_path: Path, change: Callable[..., np.ndarray], dropped: tuple[tuple[str, int], ...]
) -> None:
    write(flight(), tmp_path / "a.nc")
    with netCDF4.Dataset(tmp_path / "a.nc", "a") as file:
        file["time_ns"][:] = change(file["time_ns"][:].data)
    assert read_one(tmp_path / "a.nc").report.dropped == dropped


def test_a_phase_that_is_none_is_left_out_of_a_netcdf_file(tmp_path: Path) -> None:
    times = START + np.arange(3) * SECOND
    phase = Channel("phase", times, np.array([1.0, 2.0, 0.0]))
    write(flight(3).with_channels(phase), tmp_path / "a.nc")
    with netCDF4.Dataset(tmp_path / "a.nc", "a") as file:
        file["phase"][1] = 17
    part = read_one(tmp_path / "a.nc")
    assert part.report.warnings == ("phase: 1 cells left out that are no phase",)
    assert part.log["phase"].values.tolist() == [1.0, 0.0]


def test_a_flight_of_any_year_from_rest_at_the_surface_comes_back_whole(tmp_path: Path) -> None:
    """Rules for the clocks and zeros of instruments would drop the rows before 1990, and the first."""
    times = np.array([np.datetime64("1953-07-01", "ns").astype(np.int64) + i * 40 * 86400 * SECOND for i in range(4)])
    zero = {name: Channel(name, times, np.arange(4.0) / 100, "simulated") for name in ("depth", "pitch", "down", "p")}
    log = Log(zero, "simulated", METADATA)
    for ending in (".csv", ".parquet", ".nc"):
        write(log, tmp_path / f"a{ending}")
        part = read_one(tmp_path / f"a{ending}")
        assert (part.report.records, part.report.kept, part.report.warnings) == (4, 4, ())


def test_a_three_year_flight_is_within_what_a_channel_can_be() -> None:
    """1e8 s, the longest mission, at 10 m/s, the greatest speed that a channel can have."""
    for name in ("north", "east"):
        assert quantity_of(name).high >= 1e8 * 10.0
    assert quantity_of("speed_through_water").high == pytest.approx(10.0)


def test_a_changed_table_of_our_own_is_still_read(tmp_path: Path) -> None:
    write(flight(), tmp_path / "a.csv")
    text = (tmp_path / "a.csv").read_text().replace(",3,3,", ",3,12m,").splitlines()
    text[3] = text[3].replace("2020-01-01", "2091-01-01")  # a digit that was garbled
    (tmp_path / "a.csv").write_text("\n".join([*text, text[2], ""]))
    part = read_one(tmp_path / "a.csv")
    assert dict(part.report.dropped) == {"time runs ahead of those after it": 1, "time goes back": 1}
    assert part.log.origin == "measured"


@pytest.mark.parametrize("cut", range(1, 9))
def test_a_table_of_our_own_that_ends_within_its_last_word_loses_that_row(tmp_path: Path, cut: int) -> None:
    write(flight(), tmp_path / "a.csv")
    (tmp_path / "a.csv").write_bytes((tmp_path / "a.csv").read_bytes()[: -1 - cut])
    part = read_one(tmp_path / "a.csv")
    assert (part.report.records, part.report.dropped) == (6, (("wrong number of fields", 1),))
    assert part.log.origin == "measured"


def excel(path: Path, separator: str, decimal: str) -> Path:
    """The flight as a spreadsheet program of another country saves it."""
    flight().table().assign(origin="measured").to_csv(path, sep=separator, decimal=decimal, index=False)
    return path


@pytest.mark.parametrize("ending", [".csv", ".txt"])
@pytest.mark.parametrize(
    ("separator", "decimal", "said"),
    [(";", ",", "separated by ;, numbers with a decimal comma"), (";", ".", "separated by ;"),
     ("\t", ",", "separated by tab, numbers with a decimal comma"), ("\t", ".", "separated by tab")],
)  # fmt: skip
def test_tables_of_other_countries_are_read_and_it_is_said(
    tmp_path: Path, ending: str, separator: str, decimal: str, said: str
) -> None:
    part = read_one(excel(tmp_path / f"a{ending}", separator, decimal))
    whole = flight()
    assert part.report.format == "glider-csv"
    assert part.report.warnings == (f"{said}: read so; this program writes commas and decimal points",)
    for name, channel in whole.channels.items():
        assert part.log[name].time_ns.tolist() == channel.time_ns.tolist()
        np.testing.assert_allclose(part.log[name].values, channel.values, rtol=4e-16)  # degrees and back


def test_decimal_commas_between_commas_are_named(tmp_path: Path, glider: Run) -> None:
    excel(tmp_path / "a.csv", ",", ",")  # quoted, as "1,5"
    assert '"-17,' in (tmp_path / "a.csv").read_text()
    with pytest.raises(InputError, match=r"no usable record: 6 no value; depth_m: 6 cells .* \(a decimal comma; a poi"):
        read([tmp_path / "a.csv"])
    one_line_error(glider("info", "a.csv"), "a.csv: no usable record", "a decimal comma; a point is needed")


def test_reports_are_those_of_the_reading(tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", *ROWS, "2020-01-01T00:00:05Z,12m,dive")
    (report,) = read([path]).files
    assert isinstance(report, FileReport)
    assert report == read_one(path).report
