"""Plain tables with a mapping: times, units, missing cells, rows by named rules; counts confirmed by pandas."""

from __future__ import annotations

import datetime as dt
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT, Run, one_line_error

from glidercli.channels import PHASES
from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.logio import read
from glidercli.logio.report import FileReport
from glidercli.logio.tables import read_table

MAPPING = """
[time]
column = "t"
format = "iso"
[columns]
depth = { column = "Depth", unit = "m" }
pitch = { column = "p", unit = "deg" }
pressure = { column = "P", unit = "dbar" }
[missing]
values = [-9999, 9999]
words = ["NA"]
[file]
origin = "measured"
platform = "orca"
"""
ROWS = [f"2020-01-01T00:00:0{i}Z,{i}.5,-20,{i}.6" for i in range(5)]


def table(tmp_path: Path, *rows: str, head: str = "t,Depth,p,P", mapping: str = MAPPING, name: str = "a.csv") -> Path:
    path = tmp_path / name
    path.write_text("\n".join([head, *rows]) + "\n")
    path.with_suffix(".toml").write_text(mapping)
    return path


def read_one(path: Path) -> tuple[Log, FileReport]:
    part = read_table(path)
    report = part.report
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    assert len(part.record_ns) == report.kept
    return part.log, report


def test_a_table_with_a_mapping_beside_it_is_found_by_itself(tmp_path: Path) -> None:
    reading = read([table(tmp_path, *ROWS)])
    (report,) = reading.files
    assert (report.format, report.records, report.kept, report.dropped, report.warnings) == ("table", 5, 5, (), ())
    assert reading.log["depth"].values.tolist() == [0.5, 1.5, 2.5, 3.5, 4.5]
    assert reading.log["pitch"].values[0] == pytest.approx(np.radians(-20.0), rel=1e-15)
    assert reading.log["pressure"].values[1] == 1.6 * 1e4
    assert reading.log["depth"].time_ns[1] == pd.Timestamp("2020-01-01T00:00:01Z").value
    assert reading.log.metadata["platform"] == "orca"


def test_columns_toml_serves_a_folder(tmp_path: Path) -> None:
    first, second = table(tmp_path, *ROWS[:2]), table(tmp_path, *ROWS[2:], name="b.csv")
    first.with_suffix(".toml").rename(tmp_path / "columns.toml")
    second.with_suffix(".toml").unlink()
    assert len(read([tmp_path]).log["depth"]) == 5


def test_columns_can_be_given(tmp_path: Path, glider_json: Callable[..., Any]) -> None:
    path = table(tmp_path, *ROWS)
    mapping = path.with_suffix(".toml").rename(tmp_path / "elsewhere.toml")
    found = glider_json("replay", path, "--columns", mapping, "-o", "b.nc")
    assert [f["format"] for f in found["files"]] == ["table"]
    again = glider_json("replay", "b.nc")
    assert [c["samples"] for c in again["channels"]] == [c["samples"] for c in found["channels"]]


def test_a_mission_beside_a_table_is_no_mapping(tmp_path: Path) -> None:
    path = table(tmp_path, *ROWS, mapping='name = "yo"\n[[leg]]\nkind = "dive"\n')
    with pytest.raises(InputError, match="is not a log that can be read"):
        read([path])


ISO = "2020-03-01T12:00:00"


@pytest.mark.parametrize(
    ("form", "cells"),
    [
        ("iso", ["2020-03-01T12:00:00Z", "2020-03-01 12:00:01.5", "2020-03-01T13:00:02+01:00"]),
        ("unix", ["1583064000", "1583064001.5", "1583064002"]),
        ("unix_ms", ["1583064000000", "1583064001500", "1583064002000"]),
        ("%d/%m/%Y %H:%M:%S.%f", ["01/03/2020 12:00:00.0", "01/03/2020 12:00:01.5", "01/03/2020 12:00:02.0"]),
        ("seconds since 2020-03-01T12:00:00Z", ["0", "1.5", "2"]),
        ("minutes since 2020-03-01 11:59:00", ["1", "1.025", f"{1 + 1 / 30!r}"]),
        ("matlab", [f"{737851.5 + s / 86400!r}" for s in (0.0, 1.5, 2.0)]),
    ],
)
def test_times_of_every_format(tmp_path: Path, form: str, cells: list[str]) -> None:
    path = table(tmp_path, *(f"{c},1,2,3" for c in cells), mapping=MAPPING.replace('"iso"', f'"{form}"'))
    seconds = (read_one(path)[0]["depth"].time_ns - pd.Timestamp(ISO).value) * 1e-9
    near = 1e-5 if form == "matlab" else 1e-9  # days of a datenum are 10 us apart
    np.testing.assert_allclose(seconds, [0.0, 1.5, 2.0], atol=near)


def test_a_matlab_datenum_is_days_since_the_year_nought() -> None:
    """The definition: datenum(1970, 1, 1) = 719529, and a proleptic day number is 366 less."""
    assert dt.date(1970, 1, 1).toordinal() + 366 == 719529


def test_date_and_time_of_two_columns_in_another_zone(tmp_path: Path) -> None:
    mapping = MAPPING.replace('column = "t"', 'columns = ["d", "t"]\nutc_offset_h = 2.0')
    mapping = mapping.replace('"iso"', '"%d.%m.%Y %H:%M"')
    path = table(tmp_path, "01.03.2020,14:00,1,2,3", head="d,t,Depth,p,P", mapping=mapping)
    assert read_one(path)[0]["depth"].time_ns[0] == pd.Timestamp(ISO).value


def test_german_text_with_lines_before_the_names(tmp_path: Path) -> None:
    mapping = MAPPING.replace("[file]", '[file]\nseparator = ";"\ndecimal = ","\nskip_lines = 2\nencoding = "latin-1"')
    mapping = mapping.replace('"Depth"', '"Tiefe für Log"')
    text = "Gerät\nvon Bord\nt;Tiefe für Log;p;P;Rest\n2020-01-01T00:00:00Z;1,5; -2,5 ;NA;x\n"
    path = table(tmp_path, mapping=mapping)
    path.write_bytes(text.encode("latin-1"))
    log, report = read_one(path)
    assert (log["depth"].values[0], round(np.degrees(log["pitch"].values[0]), 12)) == (1.5, -2.5)
    assert "pressure" not in log
    assert report.warnings == ()


def test_the_line_that_is_shown_is_that_of_the_file(tmp_path: Path) -> None:
    """Lines before the names, rows of another length, blank lines and cells of two lines count as lines."""
    mapping = MAPPING.replace("[file]", "[file]\nskip_lines = 2")
    rows = [ROWS[0], "cut,1", "", '"2020-01-01T00:00:01Z",1,"\n2",3', "soon,1,2,3", "2020-01-01T00:00:06Z,deep,1,2"]
    path = table(tmp_path, *rows, head="a\nb\nt,Depth,p,P", mapping=mapping)
    lines = path.read_text().split("\n")
    _, report = read_one(path)
    time, number = report.warnings
    assert number.endswith(f"line {lines.index(rows[-1]) + 1}: 'deep'")
    assert time.startswith(f"t: 1 times cannot be read, the first in line {lines.index('soon,1,2,3') + 1}: 'soon'; ")
    assert time.endswith('; [time] format = "iso" does not fit')


def test_a_row_after_one_that_has_no_lines_of_its_own_is_still_counted(tmp_path: Path) -> None:
    """A field too long for the reader that counts lines, which that of the cells takes."""
    head = "t,Depth,p,P,note"
    path = table(tmp_path, f"{ROWS[0]},{'x' * 200_000}", "soon,1,2,3,", head=head)
    assert "the first in row 2: 'soon'" in read_one(path)[1].warnings[0]


def test_a_file_without_a_time_that_can_be_read_shows_the_first(tmp_path: Path, glider: Run) -> None:
    path = table(tmp_path, "01/03/2020,1,2,3", "02/03/2020,1,2,3")
    said = "t: 2 times cannot be read, the first in line 2: '01/03/2020'; [time] format = \"iso\" does not fit"
    one_line_error(glider("info", path), "no usable record: 2 time cannot be read", said)


def test_decimal_commas_and_semicolons_are_named(tmp_path: Path, glider: Run) -> None:
    cells = ["2020-01-01T00:00:00Z;1,5;2,5;3", "2020-01-01T00:00:01Z;1,5;2,5;4"]
    path = table(tmp_path, *cells, head="t;Depth;p;P")
    one_line_error(glider("info", path), 'has its columns separated by ;: [file] separator = ";" is needed')
    path.with_suffix(".toml").write_text(MAPPING.replace("[file]", '[file]\nseparator = ";"'))
    done = glider("info", path)
    shown = " ".join(done.stdout.split())
    hint = "Depth: 2 cells left out that are no number, the first in line 2: '1,5' (a decimal comma? [file] decimal = \",\""
    assert hint in shown
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_utf_16_is_named_and_read_where_the_mapping_says_so(tmp_path: Path) -> None:
    path = table(tmp_path, *ROWS)
    path.write_bytes(path.read_text().encode("utf-16"))
    with pytest.raises(
        InputError, match=r'is no text in utf-8; it is in UTF-16, which \[file\] encoding = "utf-16" reads'
    ):
        read([path])
    path.with_suffix(".toml").write_text(MAPPING.replace("[file]", '[file]\nencoding = "utf-16"'))
    assert read_one(path)[0]["depth"].values.tolist() == [0.5, 1.5, 2.5, 3.5, 4.5]


def test_lines_that_end_in_cr_alone_are_counted(tmp_path: Path) -> None:
    path = table(tmp_path, *ROWS, "soon,1,2,3", head="before\nt,Depth,p,P")
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r"))
    path.with_suffix(".toml").write_text(MAPPING.replace("[file]", "[file]\nskip_lines = 1"))
    log, report = read_one(path)
    assert len(log["depth"]) == 5
    assert "in line 8: 'soon'" in report.warnings[0]


def test_scale_offset_and_phases(tmp_path: Path) -> None:
    mapping = MAPPING.replace('unit = "deg" }', 'unit = "deg", scale = -2.0, offset = 1.0 }').replace(
        "[missing]", 'phase = { column = "mode", phases = { D = "dive", C = "climb" } }\n[missing]'
    )
    rows = ["2020-01-01T00:00:00Z,1,10,1,D", "2020-01-01T00:00:01Z,2,10,2,C", "2020-01-01T00:00:02Z,2,10,2,X"]
    log, report = read_one(table(tmp_path, *rows, head="t,Depth,p,P,mode", mapping=mapping))
    assert np.degrees(log["pitch"].values).tolist() == pytest.approx([-19.0] * 3)
    assert [PHASES[int(v)] for v in log["phase"].values] == ["dive", "climb"]
    assert "mode: 1 cells left out that are no phase of the mapping (X)" in report.warnings


@pytest.mark.parametrize("phase", PHASES)
def test_every_phase_is_possible(tmp_path: Path, phase: str) -> None:
    mapping = MAPPING.replace("[missing]", 'phase = { column = "mode" }\n[missing]')
    rows = [f"{row},{phase}" for row in ROWS]
    log, _ = read_one(table(tmp_path, *rows, head="t,Depth,p,P,mode", mapping=mapping))
    assert [PHASES[int(value)] for value in log["phase"].values] == [phase] * 5


@pytest.mark.parametrize(
    ("row", "reason"),
    [
        ("2020-01-01T00:00:05Z,1", "wrong number of fields"),
        ("2020-01-01T00:00:05Z,1,2,3,4", "wrong number of fields"),
        ("soon,1,2,3", "time cannot be read"),
        (ROWS[4], "time repeats"),
        (ROWS[1], "time goes back"),
        ("1970-01-01T00:00:05Z,1,2,3", "clock not set: before 1990"),
        ("2020-01-01T00:00:05Z,0,0,0", "all values zero"),
        ("2020-01-01T00:00:05Z,,NA,nan", "no value"),
        ("2020-01-01T00:00:05Z,,9999,-9999", "no value"),
        ("2020-01-01T00:00:05Z,99999,,", "no usable value"),
    ],
)
def test_each_trap_is_dropped_by_name(tmp_path: Path, row: str, reason: str) -> None:
    _, report = read_one(table(tmp_path, *ROWS, row))
    assert (report.records, report.kept, report.dropped) == (6, 5, ((reason, 1),))


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ("2020-01-01T00:00:05Z,x,2,3", "Depth: 1 cells left out that are no number, the first in line 7: 'x'"),
        ("2020-01-01T00:00:05Z,inf,2,3", "Depth: 1 cells left out that are no number, the first in line 7: 'inf'"),
        ("2020-01-01T00:00:05Z,-9999,2,3", "Depth: 1 cells of 9999 or -9999 left out, no value"),
        ("2020-01-01T00:00:05Z,1e308,2,3", "Depth: 1 values outside -10..12000 m left out"),
        ("2020-01-01T00:00:05Z,1,200,3", "p: 1 values outside -1.5708..1.5708 rad left out"),
    ],
)
def test_cells_left_out_are_told_of(tmp_path: Path, row: str, words: str) -> None:
    _, report = read_one(table(tmp_path, *ROWS, row))
    assert report.kept == 6
    assert words in report.warnings


def test_a_depth_of_nought_alone_is_a_record(tmp_path: Path) -> None:
    mapping = "\n".join(line for line in MAPPING.splitlines() if not line.startswith(("pitch", "pressure")))
    assert read_one(table(tmp_path, "2020-01-01T00:00:00Z,0,0,0", mapping=mapping))[1].kept == 1


def test_without_an_origin_it_is_taken_as_measured_with_a_warning(tmp_path: Path) -> None:
    path = table(tmp_path, *ROWS, mapping=MAPPING.replace('origin = "measured"', ""))
    log, report = read_one(path)
    assert log.origin == "measured"
    assert "taken as measured: the mapping does not say" in report.warnings[0]


def test_only_changed_positions_at_the_surface_are_fixes(tmp_path: Path) -> None:
    mapping = MAPPING.replace(
        "[missing]", 'latitude = {column = "la", unit = "deg"}\nlongitude = {column = "lo", unit = "deg"}\n[missing]'
    )
    rows = [
        f"2020-01-01T00:0{i}:00Z,{z},1,2,{a},20" for i, (z, a) in enumerate([(0.5, 10), (0.5, 10), (30, 11), (1, 12)])
    ]
    log, report = read_one(table(tmp_path, *rows, head="t,Depth,p,P,la,lo", mapping=mapping))
    assert log["latitude"].values.tolist() == [10.0, 12.0]
    assert "latitude, longitude: 2 positions left out that are no new fix at the surface" in report.warnings


FAULTY = """
[time]
column = "t"
columns = ["t"]
format = "when"
[columns]
deep = { column = "Depth", unit = "m" }
pitch = { column = "p", unit = "dbar", scal = 2.0 }
pressure = { column = "P" }
roll = { column = "p", unit = "deg", scale = 0.0 }
[file]
encoding = "klingon"
colour = "blue"
"""


def test_every_fault_of_a_mapping_is_told_at_once(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        read([table(tmp_path, *ROWS, mapping=FAULTY)])
    for words in (
        "time.format = 'when': allowed: iso, unix, unix_ms, matlab",
        "columns.pitch.scal is unknown; known here: column, unit, scale, offset, phases, origin",
        "time: needs one of column and columns",
        "columns: deep is no channel; channels are depth, pressure",
        "columns: pitch: unit = 'dbar', allowed: rad, deg",
        "columns: pressure: has no unit, allowed: Pa, hPa",
        "columns.roll.scale = 0.0: a number other than 0 is needed",
        "9 faults: ",
        "file.encoding = 'klingon': allowed: names of text encodings",
        "file.colour is unknown; known here: separator, skip_lines, decimal, encoding, platform, title, origin",
    ):
        assert words in str(caught.value), caught.value
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('column = "t"', 'column = "t"\ncolumns = ["t"]', "time: needs one of column and columns"),
        ("depth =", "deep =", "columns: deep is no channel; channels are depth, pressure"),
        ('unit = "deg"', 'unit = "dbar"', "pitch: unit = 'dbar', allowed: rad, deg"),
        ('"Depth", unit = "m"', '"Depth"', "depth: has no unit, allowed: m, km, cm"),
        ("[missing]", "[misssing]", "misssing is unknown; known here: time, columns, missing, file"),
        ('"iso"', '"seconds since soon"', "'soon' is no date"),
        ('{ column = "Depth", unit = "m" }', "3", "columns.depth is no table; known in it: column, unit"),
        ("[file]", "[file]\nskip_lines = -1", "file.skip_lines = -1"),
        ('unit = "deg"', 'unit = "deg", scale = 0', "columns.pitch.scale = 0: a number other than 0"),
        ('unit = "deg"', 'unit = "deg", scale = nan', "columns.pitch.scale = nan"),
        ('{ column = "p", unit = "deg" }', "3", "columns.pitch is no table"),
        ("[time]", "[time", "is not valid TOML"),
    ],
)
def test_each_fault_says_what_is_allowed(tmp_path: Path, old: str, new: str, words: str) -> None:
    path = table(tmp_path, *ROWS, mapping=MAPPING.replace(old, new))
    with pytest.raises(InputError) as caught:
        read([path], columns=path.with_suffix(".toml"))
    assert words in str(caught.value)


def test_a_wrong_column_lists_those_there_are(tmp_path: Path, glider: Run) -> None:
    path = table(tmp_path, *ROWS, mapping=MAPPING.replace('"Depth"', '"Tiefe"'))
    one_line_error(glider("replay", path), "a.csv: has no column Tiefe; its columns are t, Depth, p, P")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (b"\n", "line 1 holds no names of columns"),
        (b"t,Depth,p,P\n2020-01-01T00:00:00Z,\xff\xfe,2,3\n", "is no text in utf-8"),
        (b"t,Depth,p,P\n", "no usable record"),
        (b"t,Depth,p,P,P\n", "has the column P twice"),
        (b"PAR1 and no more", "is Parquet data that cannot be read"),
        (bytes(range(256)) * 50, "table.*text|has no column|holds no names|is no text"),
    ],
)
def test_what_is_no_table_is_one_line(tmp_path: Path, data: bytes, words: str) -> None:
    path = table(tmp_path)
    path.write_bytes(data)
    with pytest.raises(InputError, match=words) as caught:
        read([path])
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text_times", [True, False])
def test_parquet_goes_the_same_way(tmp_path: Path, text_times: bool) -> None:
    path = table(tmp_path, *ROWS)
    whole = pd.read_csv(path)
    if not text_times:
        whole["t"] = pd.to_datetime(whole["t"])
    whole.to_parquet(tmp_path / "b.parquet")
    (tmp_path / "b.toml").write_text(MAPPING)
    from_csv, from_parquet = read([path]).log, read([tmp_path / "b.parquet"]).log
    for name, channel in from_csv.channels.items():
        assert channel.time_ns.tolist() == from_parquet[name].time_ns.tolist()
        assert channel.values.tolist() == from_parquet[name].values.tolist()


def test_the_worked_example_of_the_docs(tmp_path: Path) -> None:
    blocks = re.findall(r"```(?:toml|text)\n(.*?)```", (ROOT / "docs/columns.md").read_text(), re.DOTALL)
    (tmp_path / "cast.toml").write_text(blocks[0])
    (tmp_path / "cast.csv").write_text(blocks[1], encoding="latin-1")
    log, report = read_one(tmp_path / "cast.csv")
    assert (report.records, report.kept, report.dropped) == (4, 3, (("time repeats", 1),))
    assert report.warnings == ("Tiefe: 1 cells of -9999 left out, no value",)
    assert log["depth"].values.tolist() == [1.5, 9.25]
    assert np.degrees(log["pitch"].values).tolist() == pytest.approx([-20.5, -21.0, -21.5])


def test_a_real_recording_gives_what_its_own_reader_gives(tmp_path: Path) -> None:
    """A SeaExplorer payload file as a plain table; pandas counts the same cells."""
    source = sorted((ROOT / "logs/seaexplorer-sea035").glob("*.pld*"))[0]
    (tmp_path / "a.csv").write_bytes(source.read_bytes())
    (tmp_path / "columns.toml").write_text(
        '[time]\ncolumn = "PLD_REALTIMECLOCK"\nformat = "%d/%m/%Y %H:%M:%S.%f"\n'
        '[columns]\npressure = { column = "GPCTD_PRESSURE", unit = "dbar" }\n'
        'temperature = { column = "GPCTD_TEMPERATURE", unit = "degC" }\n'
        '[missing]\nvalues = [9999, -9999]\n[file]\nseparator = ";"\norigin = "measured"\n'
    )
    log, report = read_one(tmp_path / "a.csv")
    own = read([source]).log
    told = pd.read_csv(source, sep=";")
    assert report.records == len(told)
    assert len(log["temperature"]) == int(told["GPCTD_TEMPERATURE"].notna().sum())
    for name in ("pressure", "temperature"):
        assert log[name].time_ns.tolist() == own[name].time_ns.tolist()
        assert log[name].values.tolist() == own[name].values.tolist()


def test_lines_may_end_in_cr_alone(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(
        '[time]\ncolumn = "t"\nformat = "iso"\n[columns]\ndepth = { column = "z", unit = "m" }\n'
    )
    (tmp_path / "a.csv").write_bytes(b"t,z\r2020-01-01T00:00:00Z,1\r2020-01-01T00:00:01Z,2\r")
    assert read([tmp_path / "a.csv"]).log["depth"].values.tolist() == [1.0, 2.0]


def test_every_phase_can_be_mapped(tmp_path: Path) -> None:
    phases = ", ".join(f'{phase} = "{phase}"' for phase in PHASES)
    mapping = MAPPING.replace("[missing]", f'phase = {{ column = "mode", phases = {{ {phases} }} }}\n[missing]')
    rows = [f"{row},{phase}" for row, phase in zip(ROWS, PHASES, strict=True)]
    log, report = read_one(table(tmp_path, *rows, head="t,Depth,p,P,mode", mapping=mapping))
    assert [PHASES[int(v)] for v in log["phase"].values] == list(PHASES)
    assert report.warnings == ()
