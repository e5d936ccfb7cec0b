"""Are samples numbered by the gaps between them, whatever the pieces they come in?"""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from glidercli.log import Channel, Log
from glidercli.logio.stretches import Stretches, alone

SECOND = 10**9


def log_of(times: np.ndarray) -> Log:
    return Log({"down": Channel("down", times, np.zeros(len(times)))}, "measured")


@given(
    steps=st.lists(st.sampled_from([10, 20, 100, 101, 3600]), max_size=60),
    cuts=st.lists(st.integers(0, 61), max_size=4),
)
def test_pieces_are_numbered_as_the_whole(steps: list[int], cuts: list[int]) -> None:
    regular = log_of(np.arange(10) * 20 * SECOND)  # five times 20 s is a gap
    times = np.cumsum([0, *steps]).astype(np.int64) * SECOND
    stretches = Stretches(regular, "down")
    found = np.concatenate([stretches.of(piece) for piece in np.split(times, sorted(cuts))])
    wanted, number = [0], 0
    for step in steps:
        number += step > 100
        wanted.append(number)
    assert found.tolist() == wanted
    assert stretches.gaps == number
    assert stretches.told() == (
        f"{number} gap{'s' * (number > 1)} of more than 100 s between its samples" if number else ""
    )
    assert alone(found).tolist() == [i for i, n in enumerate(wanted) if wanted.count(n) == 1]


def test_a_flight_that_is_told_seldom_has_no_gaps() -> None:
    times = np.arange(10) * 600 * SECOND
    assert Stretches(log_of(times), "down").of(times).max() == 0.0
