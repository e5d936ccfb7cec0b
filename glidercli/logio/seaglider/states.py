"""In which phase of flight was a Seaglider, and when did phases begin? From the states of its control.

A .log tells them as $STATE,seconds,begin dive; a .nc as numbers in gc_state_state, which count STATES.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.log import Channel, Event
from glidercli.logio.seaglider.gathering import Gathering

__all__ = ["STATES", "States", "held", "number_of", "phase", "take_states"]

Times = NDArray[np.int64]
Numbers = NDArray[np.int64]

_NAMES = ("dive", "climb", "apogee", "loiter", "surface coast", "subsurface finish", "recovery", "surface")
STATES = tuple(f"{word} {name}" for name in _NAMES for word in ("begin", "end"))
"""As gc_state_state of the basestation's .nc numbers them from 0; the .log and the .nc of sg561 show it."""
_PHASES = {
    "dive": "dive",
    "climb": "climb",
    "apogee": "inflection",
    "loiter": "hover",
    "subsurface finish": "hover",
    "surface coast": "surface",
    "recovery": "surface",
    "surface": "surface",
}
PHASE_OF_STATE = np.array([PHASES.index(_PHASES[name]) for name in _NAMES], dtype=float)


class States(NamedTuple):
    """Begins of states: times, (n,) UTC ns, increasing, and numbers, (n,); and when the dive ended, if told."""

    time_ns: Times
    numbers: Numbers
    end_of_dive_ns: int | None


def number_of(words: str) -> int:
    """The number of a state, -1 where there is none of this name."""
    return STATES.index(words) if words in STATES else -1


def phase(states: States, at_ns: Times) -> Channel:
    """Phase, derived: at the begin of each state, and at other times by the state in force.

    at_ns : (m,), increasing; before the first state there is no sample.
    """
    starts = states.time_ns
    times = np.unique(np.concatenate([starts, at_ns[at_ns >= starts[0]] if len(starts) else starts]))
    force = np.searchsorted(starts, times, side="right") - 1
    return Channel("phase", times, PHASE_OF_STATE[states.numbers[force] // 2], "derived")


def held(phase: Channel, at_ns: Times, until_ns: int) -> Channel:
    """The phase of a .log at the times of other rows, derived: each sample of it holds until the next.

    at_ns : (m,), UTC ns, increasing; before the first sample there is none, nor after until_ns, where a .log that was
    cut tells no more.
    """
    known = (at_ns >= phase.time_ns[0]) & (at_ns <= until_ns)
    force = np.searchsorted(phase.time_ns, at_ns[known], side="right") - 1
    return Channel("phase", at_ns[known], phase.values[force], "derived")


def take_states(gathering: Gathering, kind: str, time_ns: Times, states: Numbers) -> States:
    """Take the events of the states and count the records; the begins that can be used, and the end of the dive.

    time_ns : (n,), UTC ns, NO_TIME where it cannot be read. states : (n,), their numbers, -1 where unknown.
    """
    order = np.argsort(time_ns, kind="stable")
    time_ns, states = time_ns[order], states[order]
    known = (states >= 0) & (states < len(STATES))
    begin = known & (states % 2 == 0)
    gathering.records += int((~begin).sum())
    gathering.drop(kind, "unknown state", int((~known).sum()))
    gathering.drop(kind, "the end of a state, an event and no sample", int((known & ~begin).sum()))
    good = gathering.usable(kind, time_ns[begin], {"state": states[begin] + 1.0})
    starts, numbers = time_ns[begin][good], states[begin][good]
    gathering.keep(kind, starts, np.ones(len(starts), dtype=bool))
    if not len(starts):
        return States(starts, numbers, None)
    told = known & (time_ns >= starts[0]) & (time_ns <= starts[-1])
    pairs = zip(time_ns[told].tolist(), states[told].tolist(), strict=True)
    gathering.events += [Event(STATES[state], time) for time, state in pairs]
    ended = time_ns[told & (states == number_of("end dive"))]
    return States(starts, numbers, int(ended[0]) if len(ended) else None)
