"""How far did a flight go? Depths and angles kept at every step, whatever samples were asked for."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import Quaternion, Vector, rotation_ned_body
from glidercli.kernel import kernel
from glidercli.model.hydrodynamics import flow_angles

__all__ = ["Range", "note_angles", "note_depth", "range_of_none"]

Array = NDArray[np.float64]


class Range(NamedTuple):
    """What a flight reached so far.

    depths : (2, 2), least and greatest depth, m, each with its time, s.
    limits : (3,), rad, magnitudes of angle of attack, sideslip and roll beyond which time is counted.
    slope : tangent of the first two, which are the same.
    angles : (3, 4), for each of these: seconds beyond its limit, first and last time there, s, and the largest
        magnitude, rad.
    """

    depths: Array
    limits: Array
    slope: float
    angles: Array


def range_of_none(depth: float, fitted_angle: float) -> Range:
    """The range of a flight that begins at a depth, m; flow angles count beyond ``fitted_angle``, rad, roll at 90."""
    limits = np.array([fitted_angle, fitted_angle, 0.5 * math.pi])
    slope = math.tan(fitted_angle) if fitted_angle < 0.5 * math.pi else math.inf
    return Range(np.array([[depth, 0.0]] * 2), limits, slope, np.array([[0.0, math.inf, -math.inf, 0.0]] * 3))


@kernel
def note_depth(reached: Range, t: float, depth: float) -> None:
    """Widen the range to a depth, m, reached at time t, s."""
    if depth < reached.depths[0, 0]:
        reached.depths[0, 0], reached.depths[0, 1] = depth, t
    if depth > reached.depths[1, 0]:
        reached.depths[1, 0], reached.depths[1, 1] = depth, t


@kernel
def note_angles(reached: Range, t: float, h: float, V: Vector, q_wxyz: Quaternion) -> None:
    """Note the angles at the end t of a step of h, s, from the velocity through water V, m/s, and the attitude."""
    k_b = rotation_ned_body(q_wxyz)[2]
    if k_b[2] >= 0.0 and V[0] > 0.0 and max(abs(V[1]), abs(V[2])) <= reached.slope * V[0]:
        return  # none is beyond, as nearly always: no tangent is needed to see it
    _, alpha, beta = flow_angles(V)
    for i, angle in enumerate((abs(alpha), abs(beta), abs(math.atan2(k_b[1], k_b[2])))):
        if angle > reached.limits[i]:
            reached.angles[i, 0] += h
            reached.angles[i, 1] = min(reached.angles[i, 1], t)
            reached.angles[i, 2] = max(reached.angles[i, 2], t)
            reached.angles[i, 3] = max(reached.angles[i, 3], angle)
