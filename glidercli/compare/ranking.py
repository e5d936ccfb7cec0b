"""Which of several simulations comes closest? The one whose errors, each over the range measured, are least.

Judged is how it flies: by the channels asked for, else by those of position, attitude and motion, each quantity once
and at the samples that all simulations were compared at. What a simulation is given, actuators and water, says nothing
of it; only where there is nothing else it counts.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from glidercli.channels import CHANNELS
from glidercli.compare.errors import statistics

if TYPE_CHECKING:
    from glidercli.compare.comparison import Run

__all__ = ["Ranked", "ranked"]

FLOWN = ("navigation", "attitude", "motion")
"""Groups of channels that tell how it flies."""
TWINS = {"down": "depth", "latitude": "north", "longitude": "east"}
"""Channels that tell again what another does."""


class Ranked(NamedTuple):
    """A simulation's place; equal scores share one.

    score : the mean of the normalised RMSE over the channels ``by``, less is better; for published values the part of
    those judged that agree, those given to a simulation apart, more is better. None where there is none. of : how many
    values were compared, or facts judged.
    """

    rank: int | None
    name: str
    score: float | None
    of: int
    by: tuple[str, ...] = ()


def ranked(runs: Sequence[Run], chosen: Sequence[str] | None = None) -> tuple[Ranked, ...]:
    """The simulations from the closest on, those without a score last. chosen : channels asked for, None for all."""
    if any(run.facts for run in runs):
        found = [_by_facts(run) for run in runs]
        costs = [math.inf if one.score is None else -one.score for one in found]
    else:
        found = _by_errors(runs, chosen)
        costs = [math.inf if one.score is None else one.score for one in found]
    order = sorted(range(len(found)), key=costs.__getitem__)
    least = sorted(costs)
    return tuple(
        found[i] if found[i].score is None else found[i]._replace(rank=1 + least.index(costs[i])) for i in order
    )


def _by_facts(run: Run) -> Ranked:
    judged = [one for one in run.facts if one.verdict != "not simulated" and not one.fact.given]
    agree = sum(one.verdict == "agrees" for one in judged)
    return Ranked(None, run.side.name, agree / len(judged) if judged else None, len(judged))


def _by_errors(runs: Sequence[Run], chosen: Sequence[str] | None) -> list[Ranked]:
    shared = [name for name in runs[0].residuals if all(name in run.residuals for run in runs)]
    if chosen is None:
        flown = [name for name in shared if CHANNELS[name].group in FLOWN and TWINS.get(name) not in shared]
        shared = flown or shared
    scores: list[list[float]] = [[] for _ in runs]
    by, samples = [], 0
    for name in shared:
        left = [run.residuals[name] for run in runs]
        common = left[0].time_ns
        for one in left[1:]:
            common = np.intersect1d(common, one.time_ns, assume_unique=True)
        parts = [
            statistics(one.where(np.isin(one.time_ns, common), np.zeros(len(one.skipped_ns), bool))).nrmse
            for one in left
        ]
        numbers = [part for part in parts if part is not None]
        if len(numbers) == len(runs):
            by.append(name)
            samples += len(common)
            for score, number in zip(scores, numbers, strict=True):
                score.append(number)
    return [
        Ranked(None, run.side.name, math.fsum(score) / len(score) if score else None, samples, tuple(by))
        for run, score in zip(runs, scores, strict=True)
    ]
