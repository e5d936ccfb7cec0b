"""How long may a step be, whatever its error? As long as the motion is stable, and up to where the water bends."""

from __future__ import annotations

import math

from glidercli.frames import Vector, dot
from glidercli.kernel import kernel
from glidercli.model.parameters import Parameters
from glidercli.ocean.profile import interval
from glidercli.ocean.water import Sea
from glidercli.simulation.stepper import Segment

__all__ = ["LARGEST_STEP", "damped_step", "smooth_depths"]

LARGEST_STEP = 30.0  # s: a tenth of the shortest leg that anybody flies
_DECAYS = 3.0  # time constants of a decay: the pair allows 3.3, coupling and density take some of the difference
_SWINGS = 2.5  # rad of a swing: the pair allows 2.7 with a damping ratio of 0.1, more with more; coupling the same


@kernel
def damped_step(V: Vector, segment: Segment, gravity: float, p: Parameters) -> float:
    """Largest step, s, at which the fastest motions stay what they are: decay of the body rates, swing of the roll.

    Explicit steps of this pair are stable up to a bound. Step control by the error alone hovers there, and a steady
    flight then trembles by more than its tolerance.
    """
    I, s = segment.at.I, segment.at.s  # noqa: E741
    roll, pitch, yaw = I[0][0] + p.IA[0], I[1][1] + p.IA[1], I[2][2] + p.IA[2]
    damping = max(-p.Kp / roll, -p.Kq / pitch, -p.Kr / yaw) * dot(V, V)
    swing = math.sqrt(gravity * math.sqrt(dot(s, s)) / roll)
    return min(_DECAYS / max(damping, 1e-9), _SWINGS / max(swing, 1e-9))


@kernel
def smooth_depths(z: float, sea: Sea, full: bool) -> tuple[float, float]:
    """Depths, m, between which the water around depth z, m, is smooth: samples at which a profile bends.

    Without ``full`` a current bends no motion, only the track.
    """
    i = interval(sea.water.bends, z)
    above, below = sea.water.bends[i], sea.water.bends[i + 1]
    if full:
        i = interval(sea.current.bends, z)
        above, below = max(above, sea.current.bends[i]), min(below, sea.current.bends[i + 1])
    return above, below
