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
    assert told == f"1 of 2 profiles left out, with fewer than two usable rows: line {line}, {when}"
    assert cast.records == rows.count("\n")


def test_nothing_left_is_an_error_that_names_the_first(write) -> None:
    path = write("casts.csv", HEAD + f"{ONE},80,12,35\n{ONE},90,,35\n{TWO},0,,35\n{TWO},5,,35\n")
    with pytest.raises(InputError, match=r"none of its 2 profiles can be used; the first: line 2: is the only"):
        read_casts(path)


def test_currents_likewise(write) -> None:
    head = "elapsed_s,depth_m,current_east_m_s,current_north_m_s\n"
    path = write("flow.csv", head + "0,0,0,0\n0,500,0,0\n5,0,1,0\n9,0,0,0\n9,500,0,1\n")
    first, second = read_currents(path)
    assert first.warnings[0].endswith("rows: line 4, 5 s")
    assert (first.records + second.records, second.moment.seconds) == (5, 9.0)
    with pytest.raises(InputError, match="line 2: is the only usable bin"):
        read_currents(write("one.csv", head + "0,0,0,0\n"))


def test_a_log_whose_depth_falls_is_no_profile(write) -> None:
    rows = "".join(f"2020-01-01T00:{i // 60:02d}:{i % 60:02d}Z,{abs(50 - i % 100)},20,35\n" for i in range(300))
    assert not holds_profiles(write("log.csv", HEAD + rows))
    assert not holds_profiles(write("short.csv", HEAD + rows[: rows.index("T00:01")].rsplit("\n", 1)[0] + "\n"))


@pytest.mark.parametrize(("depths", "words"), [((0, 10, 5), "5 comes after 10"), ((0, 10, 10), "10 repeats 10")])
def test_of_several_profiles_one_that_goes_up_and_down_is_left_out_by_name(write, depths, words):
    good = "".join(f"2020-05-01T06:00:00Z,{z},10,35\n" for z in (0, 10, 20))
    bad = "".join(f"2020-05-01T07:00:00Z,{z},10,35\n" for z in depths)
    path = write("t.csv", HEAD + good + bad)
    (cast,) = read_casts(path)
    assert cast.depth.tolist() == [0.0, 10.0, 20.0]
    told = "1 of 2 profiles left out, whose depth does not grow from row to row: line 5, 2020-05-01T07:00:00Z"
    assert told in cast.warnings
    assert cast.dropped[0] == ("in a profile whose depth does not grow from row to row", 3)
    assert cast.records == 6
    with pytest.raises(InputError, match=f"line 4: depth_m = {words}"):
        read_casts(write("alone.csv", HEAD + bad))
    with pytest.raises(InputError, match=f"none of its 2 profiles can be used; the first: line 4: depth_m = {words}"):
        read_casts(write("both.csv", HEAD + bad + bad.replace("T07", "T08")))


def test_of_several_currents_one_that_goes_up_and_down_is_left_out_by_name(write):
    head = "time_utc,depth_m,current_east_m_s,current_north_m_s\n"
    rows = [
        f"2020-05-01T0{hour}:00:00Z,{z},0.1,0\n" for hour, zs in ((6, (0, 9)), (7, (9, 0)), (8, (0, 9))) for z in zs
    ]
    first, second = read_currents(write("c.csv", head + "".join(rows)))
    assert "1 of 3 profiles left out, whose depth does not grow from row to row: line 4" in first.warnings[0]
    assert second.moment.seconds - first.moment.seconds == 7200.0


def test_each_fault_of_profiles_is_told_apart(write):
    rows = "".join(
        f"2020-05-01T0{hour}:00:00Z,{z},10,35\n" for hour, zs in ((5, (4,)), (6, (0, 10)), (7, (10, 0))) for z in zs
    )
    (cast,) = read_casts(write("t.csv", HEAD + rows))
    assert [line.split(":")[0] for line in cast.warnings if "left out" in line] == [
        "1 of 3 profiles left out, with fewer than two usable rows",
        "1 of 3 profiles left out, whose depth does not grow from row to row",
    ]
    assert cast.records == 5
