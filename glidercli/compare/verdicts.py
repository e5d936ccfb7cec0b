"""Does a simulated log agree with published values? Each fact gets its simulated value and one of three verdicts."""

from __future__ import annotations

import dataclasses
from typing import Literal

import numpy as np

from glidercli.compare.facts import Fact, Facts
from glidercli.compare.quantities import Missing, quantity
from glidercli.dives import Interval, phases
from glidercli.log import Log
from glidercli.residuals import on_circle

__all__ = ["FactVerdict", "Verdict", "judged"]

Verdict = Literal["agrees", "disagrees", "not simulated"]


@dataclasses.dataclass(frozen=True)
class FactVerdict:
    """A fact, the same quantity of the simulated log, and whether |difference| <= tolerance.

    simulated, difference : in the fact's unit; None when not simulated, and ``reason`` says why. difference is
        simulated - published; for angles on the circle in (-180, 180] deg, simulated then being published + difference.
    """

    fact: Fact
    simulated: float | None
    difference: float | None
    verdict: Verdict
    reason: str = ""


def judged(facts: Facts, log: Log) -> tuple[FactVerdict, ...]:
    """The verdict on every fact."""
    intervals = phases(log)
    return tuple(_judged(fact, log, intervals) for fact in facts.facts)


def _judged(fact: Fact, log: Log, intervals: tuple[Interval, ...]) -> FactVerdict:
    try:
        simulated = quantity(fact.quantity, fact.channel, fact.phase, log, intervals)
    except Missing as missing:
        return FactVerdict(fact, None, None, "not simulated", str(missing))
    difference = simulated - fact.value
    if fact.channel is not None and on_circle(fact.channel) and fact.quantity != "range":
        difference -= 360.0 * np.ceil(difference / 360.0 - 0.5)
        simulated = fact.value + float(difference)
    verdict: Verdict = "agrees" if abs(difference) <= fact.tolerance else "disagrees"
    return FactVerdict(fact, simulated, float(difference), verdict)
