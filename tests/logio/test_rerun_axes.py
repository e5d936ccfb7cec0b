"""Axes of plots in Rerun: all that is drawn is on them, nothing narrower than can be told apart, marks to read them by."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from glidercli.channels import CHANNELS
from glidercli.logio.rerun.axes import axis, extent, joined
from glidercli.logio.rerun.contents import Contents
from tests.logio.viewer_logs import full

finite = st.floats(-1e5, 1e5, allow_nan=False)


def test_each_channel_that_is_drawn_has_a_narrowest_axis() -> None:
    for name in CHANNELS:
        if name != "phase":
            ends = axis([name], {name: (1.0, 1.0)}, 4)
            assert ends is not None
            assert ends[0] < 1.0 < ends[1]


@given(st.sampled_from([name for name in CHANNELS if name != "phase"]), finite, finite)
def test_all_that_is_drawn_has_its_place_and_most_of_it(name: str, one: float, other: float) -> None:
    low, high = min(one, other), max(one, other)
    ends = axis([name], {name: (low, high)}, 4)
    assert ends is not None
    assert ends[0] < low
    assert high < ends[1]
    # 1.7 by the stretch to a mark, 0.06 of room at both ends, and at most 0.8 of that again where a mark is near
    if high - low > 2.0:
        assert ends[1] - ends[0] <= 1.7 * (1.0 + 2 * 1.8 * 0.06) * (high - low) * (1.0 + 1e-9)


@pytest.mark.parametrize(
    ("channel", "low", "high", "marks"),
    [
        ("pitch", -72.0, 25.0, (-100.0, 0.0)),
        ("heading", 143.2, 264.0, (200.0, 300.0)),
        ("depth", -97.0, -0.4, (-100.0, 0.0)),
        ("heading", 0.0, 360.0, (0.0, 300.0)),
        ("density", 1027.68, 1028.13, (1027.7, 1028.1)),
        ("heading", 90.0, 90.00000000001, (89.0, 91.0)),
    ],
)
def test_an_axis_has_two_marks(channel: str, low: float, high: float, marks: tuple[float, float]) -> None:
    ends = axis([channel], {channel: (low, high)}, 4)
    assert ends is not None
    assert ends[0] <= marks[0]
    assert marks[1] <= ends[1]


@pytest.mark.parametrize(("low", "high", "mark"), [(-0.5, 0.35, 0.4), (0.3845, 0.418, 0.42)])
def test_a_mark_near_the_end_keeps_room_for_its_label(low: float, high: float, mark: float) -> None:
    ends = axis(["net_buoyancy"], {"net_buoyancy": (low, high)}, 4)
    assert ends is not None
    assert ends[1] < mark or ends[1] - mark > 0.04 * (ends[1] - ends[0])  # some 5 px of 120


def test_noise_of_rounding_does_not_fill_a_plot() -> None:
    ends = axis(["temperature"], {"temperature": (-7e-15, 7e-15)}, 4)
    assert ends is not None
    assert ends[1] - ends[0] > 0.01


def test_several_lines_share_an_axis() -> None:
    extents = {"pitch": (-20.0, 20.0), "roll": (3.0, 45.0)}
    ends = axis(["pitch", "roll"], extents, 4)
    assert ends is not None
    assert ends[0] < -20.0
    assert ends[1] > 45.0
    assert joined([(1.0, 2.0), (-3.0, 1.5)]) == (-3.0, 2.0)


def test_without_values_no_axis() -> None:
    assert axis(["pitch"], {}, 4) is None
    assert extent(np.array([math.nan, 2.0, -1.0])) == (-1.0, 2.0)


def _axes(view: Any) -> list[Any]:
    """The y axes of all plots of a blueprint."""
    found = [view.properties["ScalarAxis"]] if "ScalarAxis" in getattr(view, "properties", {}) else []
    return found + [axis for part in getattr(view, "contents", []) if not isinstance(part, str) for axis in _axes(part)]


def test_axes_of_a_log_that_grows_are_not_set() -> None:
    log = full()
    contents = Contents(log)
    for _ in contents.samples(log):
        pass
    assert len(_axes(contents.whole(log)[1].root_container)) > 3
    assert not _axes(contents.whole(log, grows=True)[1].root_container)
