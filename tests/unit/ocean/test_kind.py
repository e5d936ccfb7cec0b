"""Which files hold profiles, and which are logs: by content alone."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest

from glidercli.ocean.kind import AD2CP, PD0, TEXT, holds_profiles, kind_of

DATA = Path(__file__).parents[2] / "data"
ROOT = DATA.parents[1]


@pytest.mark.parametrize(
    ("rows", "profiles"),
    [
        ("depth_m,salinity\n1,35\n2,35\n1,35\n", True),  # no times: a table that its reader refuses
        ("depth_m,salinity,time_utc\n1,35,a\n2,35,b\n3,35,c\n", True),  # grows, a time for every row
        ("depth_m,salinity,time_utc\n1,35,a\n2,35,b\n1,35,c\n", False),  # down and up
        ("elapsed_s,depth_m,salinity\n0,1,35\n0,2,35\n60,1,35\n60,2,35\n", True),  # rows share a time
        ("elapsed_s;depth_m;salinity\n0;1;35\n10;1;35\n", False),  # stays at its depth for a while
        (
            "elapsed_s,depth_m,salinity\n0,1,35\n5,,35\n10,2,35\n15,,35\n20,1,\n",
            False,
        ),  # rows without a depth say nothing
        ("time_utc,pitch_deg\na,1\nb,2\n", False),  # no depth at all
        ("pressure_dbar\tdensity_kg_m3\n1\t1025\n", True),
        ("hello\n", False),
    ],
)
def test_tables(write, rows, profiles):
    assert holds_profiles(write("t.csv", rows)) is profiles
    assert holds_profiles(write("t.csv.gz", gzip.compress(rows.encode()))) is profiles
    assert holds_profiles(write("bom.csv", b"\xef\xbb\xbf" + rows.encode())) is profiles


def test_real_files():
    assert kind_of(DATA / "adcp" / "RDI_withBT.000") == PD0
    assert kind_of(DATA / "adcp" / "Sig100_avg.ad2cp") == AD2CP
    assert kind_of(DATA / "ctd" / "dPIRX010.cnv") == TEXT
    assert all(holds_profiles(path) for path in (DATA / "ctd").glob("*.cnv"))
    assert not any(holds_profiles(path) for path in (ROOT / "logs" / "seaexplorer-sea035").iterdir())


def test_a_damaged_gzip_file_holds_none(write):
    whole = gzip.compress(b"depth_m,salinity\n" + b"1,35\n" * 100_000)
    assert not holds_profiles(write("cut.gz", whole[:20]))
