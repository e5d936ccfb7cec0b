"""Several profiles in one table: a profile that is too short does not take the others with it."""

import pytest

from glidercli.errors import InputError
from glidercli.ocean.kind import holds_profiles
from glidercli.ocean.water_file import read_casts, read_currents

HEAD = "time_utc,depth_m,temperature_degC,salinity\n"
ONE, TWO = "2011-07-20T04:28:00Z", "2011-07-20T10:00:00Z"
WHOLE = f"{TWO},0,20,35\n{TWO},50,15,35\n{TWO},100,10,35.2\n"


@pytest.mark.parametrize(
    ("rows", "line"),
    [
        (f"{ONE},80,12,35\n" + WHOLE, 2),
        (f"{ONE},80,12,35\n{ONE},90,,35\n" + WHOLE, 2),
        (WHOLE + "2011-07-21T00:00:00Z,3,20,35\n", 5),
    ],
)
def test_a_profile_of_one_sample_is_left_out_and_named(write, rows, line) -> None:
    path = write("casts.csv", HEAD + rows)
    assert holds_profiles(path)
    (cast,) = read_casts(path)
    assert cast.depth.tolist() == [0.0, 50.0, 100.0]
    (told,) = [text for text in cast.warnings if "profiles left out" in text]
    when = ONE if line == 2 else "2011-07-21T00:00:00Z"
    assert told == f"1 of 2 profiles left out, with fewer than two usable rows each: line {line}, {when}"
    assert cast.records == rows.count("\n")


def test_nothing_left_is_an_error_that_names_the_first(write) -> None:
    path = write("casts.csv", HEAD + f"{ONE},80,12,35\n{ONE},90,,35\n{TWO},0,,35\n{TWO},5,,35\n")
    with pytest.raises(InputError, match=r"none of its 2 profiles has two usable rows; the first: line 2: is the only"):
        read_casts(path)


def test_currents_likewise(write) -> None:
    head = "elapsed_s,depth_m,current_east_m_s,current_north_m_s\n"
    path = write("flow.csv", head + "0,0,0,0\n0,500,0,0\n5,0,1,0\n9,0,0,0\n9,500,0,1\n")
    first, second = read_currents(path)
    assert first.warnings[0].endswith("each: line 4, 5 s")
    assert (first.records + second.records, second.moment.seconds) == (5, 9.0)
    with pytest.raises(InputError, match="line 2: is the only usable bin"):
        read_currents(write("one.csv", head + "0,0,0,0\n"))


def test_a_log_whose_depth_falls_is_no_profile(write) -> None:
    rows = "".join(f"2020-01-01T00:{i // 60:02d}:{i % 60:02d}Z,{abs(50 - i % 100)},20,35\n" for i in range(300))
    assert not holds_profiles(write("log.csv", HEAD + rows))
    assert not holds_profiles(write("short.csv", HEAD + rows[: rows.index("T00:01")].rsplit("\n", 1)[0] + "\n"))
