"""What does a flight remember beside its state? The places of an array that goes on from stretch to stretch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.kernel import kernel

Array = NDArray[np.float64]

FIRST_STEP = 0.05  # s; a fraction of the roll mode's period, the fastest there is

GOING_ON, AT_DEPTH, AT_TIME, TURNED, SURFACED, GROUNDED, STEP_TOO_SMALL = range(7)
"""How a stretch ended."""

FREE, AT_SURFACE, ON_BOTTOM = 0.0, 1.0, 2.0
"""What holds the vehicle."""

(
    T, STEP, ERROR, RRX, GAMMA, MB, COMMAND_RRX, COMMAND_GAMMA, COMMAND_MB, LEG_START, SAMPLES, HEADING, TURN, HELD,
    RESTED, RRX_RATE, GAMMA_RATE, ROW, SLID, ROTATED, PUMPED, EVALUATIONS, LOGGED, LIMITS,
) = range(24)  # fmt: skip
"""What a flight remembers beside its state: time (s), next step (s), last error; actuators and commands (SI); start of
the leg (s), samples of the controllers in it; where turns end it, heading at the last step and turn since it began
(rad); what holds the vehicle, and whether it has come to rest there; rates of slide and rotation up to now (SI); next
row to record; travel of the slide (m) and of the rotation (rad), oil pumped out (m3); calls of the right-hand side;
events logged, and which limits were met in this leg (a sum of 1, 2, 4)."""

EVENTS = (
    "apogee", "surfacing", "grounding", "dive begins", "lift-off", "mass position at its limit",
    "mass rotation at its limit", "oil at its limit",
)  # fmt: skip
APOGEE, SURFACING, GROUNDING, DIVES, LIFTS, SLIDE_LIMIT, ROTATION_LIMIT, OIL_LIMIT = range(8)


def new_memory(controls: tuple[float, float, float]) -> Array:
    """The memory of a flight that begins with these actuators (SI)."""
    m = np.zeros(24)
    m[STEP], m[ERROR] = FIRST_STEP, 1e-4
    m[RRX], m[GAMMA], m[MB] = m[COMMAND_RRX], m[COMMAND_GAMMA], m[COMMAND_MB] = controls
    m[ROW] = 1.0
    return m


@kernel
def note_event(log: Array, m: Array, kind: int, t: float, depth: float) -> None:
    """Add an event to the log (n, 3), unless it is full."""
    n = int(m[LOGGED])
    if n < log.shape[0]:
        log[n, 0], log[n, 1], log[n, 2] = kind, t, depth
    m[LOGGED] += 1.0
