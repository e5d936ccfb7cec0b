import gzip

import numpy as np
import pytest

from glidercli.errors import InputError
from glidercli.ocean.cnv import is_cnv, parse_cnv
from glidercli.ocean.source import read_text

HEADER = """* Sea-Bird SBE 9 Data File:
* NMEA Latitude = 39 16.23 S
* NMEA Longitude = 150 06.34 W
# nvalues = 3
# name 0 = prDM: Pressure, Digiquartz [db]
# name 1 = t090C: Temperature [ITS-90, deg C]
# name 2 = flag:
# start_time = Jul 12 2013 12:59:29 [NMEA time, first data scan]
# bad_flag = -9.990e-29
*END*
"""
ROWS = """      1.000    27.4365 0.0000e+00
      2.000-9.990e-29  0.0000e+00
   3873.649-4129.20488 0.0000e+00
"""


def parse(path, text=HEADER + ROWS):
    return parse_cnv(path, text)


def test_header_and_rows(tmp_path):
    file = parse(tmp_path, (HEADER + ROWS).replace("-9.990e-29  0", " -9.990e-29 0"))
    assert [c.name for c in file.columns] == ["prDM", "t090C", "flag"]
    assert [c.unit for c in file.columns] == ["db", "ITS-90, deg C", ""]
    assert file.latitude == pytest.approx(-(39 + 16.23 / 60))
    assert file.longitude == pytest.approx(-(150 + 6.34 / 60))
    assert file.time_utc == "2013-07-12T12:59:29Z"
    assert file.announced == 3
    assert np.isnan(file.rows[1, 1])


def test_fields_that_touch_are_eleven_characters_wide(tmp_path):
    touching = "   3873.649-4129.20488 0.0000e+00\n"
    assert len(touching.split()) == 2
    file = parse(tmp_path, HEADER + touching)
    assert file.rows.tolist() == [[3873.649, -4129.20488, 0.0]]
    assert file.unreadable == 0


def test_a_row_cut_short_is_counted_not_guessed(tmp_path):
    file = parse(tmp_path, HEADER + "      1.000    27.4365 0.0000e+00\n      2.000    27.4\n")
    assert (len(file.rows), file.unreadable) == (1, 1)


@pytest.mark.parametrize("start", ["", "# start_time = none\n", "# start_time = \n"])
def test_a_missing_start_time_is_none(tmp_path, start):
    text = "".join(line for line in HEADER.splitlines(True) if "start_time" not in line).replace(
        "*END*", start + "*END*"
    )
    assert parse(tmp_path, text + ROWS[:34]).time_utc is None


def test_a_position_written_by_the_operator(ctd):
    path = ctd / "dPIRX010.cnv"
    file = parse_cnv(path, read_text(path, ""))
    assert file.latitude == pytest.approx(4 + 6.34 / 60)  # its line "**   04 06.34 N"
    assert file.longitude == pytest.approx(-(38 + 0.80 / 60))
    assert file.time_utc == "2008-04-17T00:56:37Z"


@pytest.mark.parametrize("name", ["dPIRX010.cnv", "CTD_with_sigma_e00.cnv", "press-fails.cnv"])
def test_real_files_hold_the_rows_and_spans_that_their_headers_state(ctd, name):
    text = read_text(ctd / name, "")
    file = parse_cnv(ctd / name, text)
    assert len(file.rows) == file.announced
    assert file.unreadable == 0
    spans = [line.split("=")[1] for line in text.splitlines() if line.startswith("# span")]
    for column, span in zip(file.rows.T, spans, strict=True):
        low, high = map(float, span.split(","))
        assert np.nanmin(column) == pytest.approx(low, rel=1e-4)  # spans are printed with as few as five digits
        assert np.nanmax(column) == pytest.approx(high, rel=1e-4)


def test_latin_1_names_are_read(ctd):
    text = read_text(ctd / "CTD_with_sigma_e00.cnv", "")
    assert parse_cnv(ctd, text).first("sigma-\u00e900") is not None


def test_gzip_is_seen_by_content(ctd, write):
    original = ctd / "press-fails.cnv"
    packed = write("cast.cnv", gzip.compress(original.read_bytes()))
    assert read_text(packed, "") == read_text(original, "")
    with pytest.raises(InputError, match="is a damaged gzip file"):
        read_text(write("cut.cnv.gz", gzip.compress(original.read_bytes())[:5000]), "")


def test_what_is_no_cnv():
    assert not is_cnv("depth_m,salinity\n1,35\n")
    assert is_cnv(HEADER)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (HEADER.replace("*END*", ""), "has no line [*]END[*]"),
        (HEADER, "has no row of 3 numbers after [*]END[*]"),
        (HEADER.replace("# name", "# noun") + ROWS, "that name the columns"),
        (HEADER.replace("# nvalues = 3", "# file_type = binary") + ROWS, "is a binary .cnv file"),
        (HEADER.replace("= 39 16.23", "= 93 16.23") + ROWS, "latitude = -93.2705 deg, allowed -90 to 90"),
        (HEADER.replace("= -9.990e-29", "= -9.99e--29") + ROWS, "bad_flag = '-9.99e--29' in the header, a number"),
    ],
)
def test_a_file_that_cannot_be_used(tmp_path, text, message):
    with pytest.raises(InputError, match=message):
        parse(tmp_path, text)
