"""Where published values stand in a figure: first and last values at their end, what no log holds nowhere."""

from __future__ import annotations

import numpy as np
import pytest
from analytic_flights import log, vee
from matplotlib.figure import Figure

from glidercli.compare import compare
from glidercli.compare.bands import draw_facts
from glidercli.compare.facts import OTHER, Fact, Facts

T = np.arange(0.0, 2001.0, 5.0)
FLIGHT = log(T, "simulated", depth=vee(300.0, 1000.0, 1000.0)(T), pitch=np.where(T < 1000.0, -30.0, 30.0))


def drawn(*facts: Fact):
    """The pitch panel with facts, and the line on those not drawn; the time axis in s from the flight's start."""
    axes = Figure().add_subplot()
    runs = compare(Facts("s", "", facts), FLIGHT).runs
    return axes, draw_facts({"pitch": axes}, runs, FLIGHT.start_ns, 1e-9)


@pytest.mark.parametrize(("quantity", "phase", "time"), [("first", "flight", 0.0), ("last", "flight", 2000.0)])
def test_first_and_last_values_stand_at_their_end(quantity: str, phase: str, time: float) -> None:
    axes, undrawn = drawn(Fact("x", quantity, -25.0, "deg", 4.0, "p", phase=phase, channel="pitch"))
    ((line, _, bars),) = axes.containers
    assert line.get_xdata() == pytest.approx([time], abs=1e-6)
    assert line.get_ydata() == pytest.approx([-25.0])
    assert bars[0].get_segments()[0][:, 1] == pytest.approx([-29.0, -21.0])
    assert undrawn == []


def test_a_level_spans_its_phase() -> None:
    axes, _ = drawn(Fact("x", "median", -25.0, "deg", 4.0, "p", phase="dive", channel="pitch"))
    (band,) = axes.collections
    corners = band.get_paths()[0].vertices
    assert (corners[:, 1].min(), corners[:, 1].max()) == (-29.0, -21.0)
    assert corners[:, 0].max() == pytest.approx(1000.0, abs=20.0)  # the turn's samples belong to neither leg
    assert not axes.containers


def test_what_no_log_holds_is_not_missed() -> None:
    axes, undrawn = drawn(
        Fact("sampling", OTHER, 6.0, "s", 0.5, "p", note="none"),
        Fact("roll", "mean", 1.0, "deg", 1.0, "p", channel="roll"),
    )
    assert undrawn == ["Published, not drawn: roll."]
    assert not axes.containers
    assert not axes.collections
