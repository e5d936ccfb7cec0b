"""Which records are kept: the rules against brute force."""

from __future__ import annotations

from collections import Counter
from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from glidercli.logio.records import NO_TIME, in_order, usable

DAY = 86400 * 10**9
NOW = 1_563_000_000 * 10**9


@given(st.lists(st.integers(0, 6), max_size=9))
def test_as_many_as_can_be_are_kept_in_order(times: list[int]) -> None:
    dropped: Counter[str] = Counter()
    kept = in_order(np.array(times, np.int64), dropped)
    chosen = [time for time, keep in zip(times, kept, strict=True) if keep]
    assert all(a < b for a, b in pairwise(chosen))
    assert len(times) == len(chosen) + dropped.total()
    most = max(
        (n for n in range(len(times) + 1) for c in combinations(times, n) if all(a < b for a, b in pairwise(c))),
        default=0,
    )
    assert len(chosen) == most


@pytest.mark.parametrize(
    ("times", "kept", "reasons"),
    [
        ([1, 2, 2, 3], [1, 1, 0, 1], {"time repeats": 1}),
        ([1, 2, 3, 2, 4], [1, 1, 1, 0, 1], {"time goes back": 1}),
        ([1, 2, 90, 3, 4], [1, 1, 0, 1, 1], {"time runs ahead of those after it": 1}),
        ([5, 6, 1, 7, 8], [1, 1, 0, 1, 1], {"time goes back": 1}),
    ],
)
def test_each_reason(times: list[int], kept: list[int], reasons: dict[str, int]) -> None:
    dropped: Counter[str] = Counter()
    assert in_order(np.array(times, np.int64), dropped).tolist() == [bool(k) for k in kept]
    assert dropped == reasons


def test_a_clock_that_jumps_ahead_takes_nothing_with_it() -> None:
    """Ten records from a clock 5 days ahead in the middle of a thousand: ten are lost, not five hundred."""
    times = NOW + np.arange(1000) * 10**9
    times[500:510] += 5 * DAY
    dropped: Counter[str] = Counter()
    assert usable(times, {"a": np.ones(1000)}, dropped).sum() == 990
    assert dropped == {"time runs ahead of those after it": 10}


def test_1970_and_blank_and_zero_records() -> None:
    times = NOW + np.arange(8) * 10**9
    times[0] = 12 * 10**9
    times[1] = NO_TIME
    values = np.array([1.0, 1.0, np.nan, 0.0, 2.0, 3.0, 4.0, 5.0])
    dropped: Counter[str] = Counter()
    good = usable(times, {"a": values, "b": np.full(8, np.nan)}, dropped)
    assert good.tolist() == [False] * 4 + [True] * 4
    assert dropped == {
        "time cannot be read": 1,
        "clock not set: before 1990": 1,
        "no value": 1,
        "all values zero": 1,
    }


def test_nothing_in_nothing_out() -> None:
    assert usable(np.array([], np.int64), {}, Counter()).tolist() == []


def test_zeros_are_readings_where_a_record_tells_of_nothing_else() -> None:
    """Depth at the surface, phase 0 and an actuator at rest; not what a CTD tells that did not sample."""
    nan = np.nan
    cells = {
        "depth": np.array([0.0, 0.0, 0.0, nan, 0.0]),
        "phase": np.array([nan, 0.0, nan, nan, nan]),
        "pitch": np.array([nan, nan, 0.0, nan, 0.1]),
        "temperature": np.array([nan, nan, nan, 0.0, nan]),
    }
    dropped: Counter[str] = Counter()
    kept = usable(NOW + np.arange(5, dtype=np.int64), cells, dropped)
    assert kept.tolist() == [True, True, False, False, True]
    assert dropped == {"all values zero": 2}


DAY = 86400 * 10**9


@pytest.mark.parametrize(
    ("days", "kept"),
    [
        ([0] * 200 + [9000] * 3 + [0] * 300, [True] * 200 + [False] * 3 + [True] * 300),  # a garbled date in the middle
        ([-5000] * 400 + [0] * 20, [False] * 400 + [True] * 20),  # set at the end, and it stays so
        ([0] * 300 + [-5000] * 100, [True] * 300 + [False] * 100),  # lost on the way
        ([-5000] * 300 + [0] * 100 + [-5000] * 50, [False] * 300 + [True] * 100 + [False] * 50),  # set, and lost
    ],
)
def test_the_clock_that_was_set_counts(days: list[int], kept: list[bool]) -> None:
    time_ns = NOW + np.array(days, np.int64) * DAY + np.arange(len(days)) * 10**9
    assert usable(time_ns, {"depth": np.ones(len(days))}, Counter()).tolist() == kept
