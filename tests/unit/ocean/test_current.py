import numpy as np
import pytest

from glidercli.errors import InputError
from glidercli.ocean.current import read_adcp

HEAD = "depth_m,current_east_m_s,current_north_m_s\n"


def test_a_plain_profile(write):
    profile = read_adcp(write("adcp.csv", HEAD + "5,0.1,-0.2\n15,0.3,0.0\n"))
    assert profile.depth.tolist() == [5.0, 15.0]
    assert profile.east.tolist() == [0.1, 0.3]
    assert profile.north.tolist() == [-0.2, 0.0]
    assert profile.up.tolist() == [0.0, 0.0]
    assert (profile.dropped, profile.warnings, profile.records) == ((), (), 2)


def test_gaps_marks_and_wild_values_are_dropped_by_reason(write):
    text = (
        HEAD.strip()
        + ",current_up_m_s\n5,0.1,0.2,0.01\n10,,0.2,0\n15,NaN,,0\n20,-32.768,-32.768,-32.768\n25,4,4,0\n30,inf,0,0\n35,0.1,0.2,0.02\n"
    )
    profile = read_adcp(write("adcp.csv", text))
    assert profile.depth.tolist() == [5.0, 35.0]
    assert profile.up.tolist() == [0.01, 0.02]
    assert dict(profile.dropped) == {"gap (empty or NaN)": 2, "bad-velocity mark -32.768": 1, "faster than 5 m/s": 2}
    assert profile.records == 7


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (HEAD + "5,0.1,0.2\n15,0,0\n10,0,0\n", "line 4: depth_m = 10 comes after 15"),
        (HEAD + "5,0.1,0.2\n5,0,0\n", "line 3: depth_m = 5 repeats 5"),
        (HEAD + "5,0.1,0.2\n,0,0\n", "line 3: depth_m = empty, allowed 0 to 12000"),
        (HEAD + "5,fast,0.2\n", "line 2: current_east_m_s = 'fast', a number"),
        (HEAD + "5,,0.2\n", "has no usable bin among 1: 1 gap"),
        (HEAD + "5,0.1,0.2\n", "line 2: is the only usable bin of its profile; at least two are needed"),
        (HEAD + "5,0.1\n", "line 2: has 2 cells for 3 columns"),
        (
            "* Sea-Bird SBE 9 Data File:\n1,2\n",
            "line 1: holds no column names .* a current profile is a table with depth_m",
        ),
        (HEAD, "has no rows below its column names"),
        (
            "depth_m,current_east_m_s\n5,0.1\n",
            "has no column current_north_m_s; its columns are depth_m, current_east_m_s",
        ),
    ],
)
def test_a_table_that_cannot_be_used(write, text, message):
    with pytest.raises(InputError, match=message) as caught:
        read_adcp(write("adcp.csv", text))
    assert "\n" not in str(caught.value)


def test_a_misspelt_column_is_named(write):
    profile = read_adcp(write("adcp.csv", HEAD.replace("\n", ",curent_up_m_s\n") + "5,0.1,0.2,0.3\n9,0.1,0.2,0.3\n"))
    assert "curent_up_m_s" in profile.warnings[0]
    assert np.all(profile.up == 0.0)
