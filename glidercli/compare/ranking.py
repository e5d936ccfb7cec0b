"""Which of several simulations comes closest? The one whose errors, each over the range measured, are least."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from glidercli.compare.comparison import Run

__all__ = ["Ranked", "ranked"]


class Ranked(NamedTuple):
    """A simulation's place; equal scores share one.

    score : the mean of the normalised RMSE over the channels that all simulations have one of, less is better; for
    published values the part of those judged that agree, those given to a simulation apart, more is better. None where
    there is none. of : how many channels, or facts.
    """

    rank: int | None
    name: str
    score: float | None
    of: int


def ranked(runs: Sequence[Run]) -> tuple[Ranked, ...]:
    """The simulations from the closest on, those without a score last."""
    facts = any(run.facts for run in runs)
    shared = [
        name for name in runs[0].channels
        if all(name in run.channels and run.channels[name].nrmse is not None for run in runs)
    ]  # fmt: skip
    found: list[tuple[float, Ranked]] = []
    for run in runs:
        parts = [nrmse for name in shared if (nrmse := run.channels[name].nrmse) is not None]
        if facts:
            judged = [one for one in run.facts if one.verdict != "not simulated" and not one.fact.given]
            parts = [1.0 if one.verdict == "agrees" else 0.0 for one in judged]
        score = math.fsum(parts) / len(parts) if parts else None
        cost = math.inf if score is None else -score if facts else score
        found.append((cost, Ranked(None, run.side.name, score, len(parts))))
    found.sort(key=lambda one: one[0])
    costs = [cost for cost, _ in found]
    return tuple(one if one.score is None else one._replace(rank=1 + costs.index(cost)) for cost, one in found)
