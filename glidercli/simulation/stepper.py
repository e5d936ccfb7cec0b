"""What is one step of the integrator? Dormand-Prince 5(4) with its error estimate and its continuous extension.

The pair, its step control and its dense output are those of Dormand & Prince (1980) as given in Hairer, Norsett &
Wanner, Solving Ordinary Differential Equations I, section II.5-6.

The state is an array of 16: position (NED, m), attitude q_wxyz, momentum P and Pi through water, energy lost to the
water (J), length of the horizontal track over ground (m), work of the pump against the sea's pressure (J). Nothing
depends on the horizontal position, the energies or the track, so they stay out of the error norm: a uniform current
then changes neither step nor motion.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.kernel import kernel
from glidercli.model.equations import State, rates
from glidercli.model.mass import Placement, placement
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Sea, at_depth
from glidercli.simulation.actuators import drive_pressure

__all__ = [
    "ENERGY", "PUMP_WORK", "SIZE", "TRACK", "WIDTH", "Segment", "controls_at", "dense", "error_norm",
    "segment_of", "slope_into", "stages", "state_of",
]  # fmt: skip

Array = NDArray[np.float64]

SIZE = 16
WIDTH = SIZE + 3
"""Of a row of slopes: the state's, and the velocity through water (m/s, body frame) that they were taken at."""

ENERGY, TRACK, PUMP_WORK = 13, 14, 15
"""Columns of the state after the momentum."""


class Segment(NamedTuple):
    """A stretch of time over which every actuator rests or moves steadily; steps never cross its ends."""

    start: float
    """s."""
    controls: Controls
    """At its start, with the rates of slide and rotation."""
    mb_rate: float
    """kg/s."""
    moving: bool
    at: Placement
    """The masses at its start; all along if nothing moves."""
    oil_rate: float
    """m3/s pumped out of the hull; zero while oil comes in, for that takes no work."""


@kernel
def segment_of(start: float, controls: Controls, mb_rate: float, p: Parameters, full: bool) -> Segment:
    """The segment that begins at a time, s, with these controls and rates."""
    moving = controls.rrx_rate != 0.0 or controls.gamma_rate != 0.0 or mb_rate != 0.0
    out = max(0.0, -mb_rate) / p.rho_0
    return Segment(start, controls, mb_rate, moving, placement(controls, p, full), out)


@kernel
def controls_at(segment: Segment, t: float) -> Controls:
    """The controls at time t, s."""
    c, since = segment.controls, t - segment.start
    return Controls(
        c.rrx + since * c.rrx_rate,
        c.gamma + since * c.gamma_rate,
        c.mb + since * segment.mb_rate,
        c.rrx_rate,
        c.gamma_rate,
    )


@kernel
def state_of(y: Array) -> State:
    """The state array as a State; the attitude is brought to unit length."""
    n = 1.0 / math.sqrt(y[3] * y[3] + y[4] * y[4] + y[5] * y[5] + y[6] * y[6])
    return State(
        (y[0], y[1], y[2]),
        (y[3] * n, y[4] * n, y[5] * n, y[6] * n),
        (y[7], y[8], y[9]),
        (y[10], y[11], y[12]),
    )


@kernel
def slope_into(k: Array, i: int, t: float, y: Array, segment: Segment, sea: Sea, p: Parameters, full: bool) -> None:
    """Write the time derivative of the state array y into row i of k (n, WIDTH)."""
    at = segment.at
    if segment.moving:
        at = placement(controls_at(segment, t), p, full)
    water = at_depth(sea, y[2], t)
    r = rates(state_of(y), at, water, p, full)
    k[i, 0], k[i, 1], k[i, 2] = r.position
    k[i, 3], k[i, 4], k[i, 5], k[i, 6] = r.q_wxyz
    k[i, 7], k[i, 8], k[i, 9] = r.P
    k[i, 10], k[i, 11], k[i, 12] = r.Pi
    k[i, ENERGY] = r.power
    k[i, TRACK] = math.sqrt(r.position[0] * r.position[0] + r.position[1] * r.position[1])
    k[i, PUMP_WORK] = segment.oil_rate * drive_pressure(water, y[2])
    k[i, SIZE], k[i, SIZE + 1], k[i, SIZE + 2] = r.V


A = np.array([
    [1 / 5, 0, 0, 0, 0, 0],
    [3 / 40, 9 / 40, 0, 0, 0, 0],
    [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
    [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
    [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
    [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
])  # fmt: skip
"""The pair's tableau; the last row makes the new state."""
C = np.array([1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1])
"""Its nodes."""
E1, E3, E4, E5, E6, E7 = 71 / 57600, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40
"""Fifth-order less fourth-order weights."""
D1, D3, D4 = -12715105075 / 11282082432, 87487479700 / 32700410799, -10690763975 / 1880347072
D5, D6, D7 = 701980252875 / 199316789632, -1453857185 / 822651844, 69997945 / 29380423
"""Last term of the continuous extension."""


@kernel
def stages(
    y: Array, t: float, h: float, k: Array, new: Array, segment: Segment, sea: Sea, p: Parameters, full: bool
) -> None:
    """One step of h, s: k[0] given, k[1] to k[6] and ``new`` filled.

    The right-hand side stands in one place, in a loop: it is inlined there, and six copies take seconds to compile.
    """
    for i in range(1, 7):  # no NaN of a step that was refused may count, not even times zero
        for j in range(SIZE):
            k[i, j] = 0.0
    for i in range(6):
        a1, a2, a3, a4, a5, a6 = A[i, 0], A[i, 1], A[i, 2], A[i, 3], A[i, 4], A[i, 5]
        for j in range(SIZE):
            new[j] = y[j] + h * (
                a1 * k[0, j] + a2 * k[1, j] + a3 * k[2, j] + a4 * k[3, j] + a5 * k[4, j] + a6 * k[5, j]
            )
        slope_into(k, i + 1, t + C[i] * h, new, segment, sea, p, full)


_GLIDING = 0.5  # m/s, from where on momentum counts in full
_LEAST_FORCE = 0.003  # share of it at rest
_DAMPED = 9.0  # times more that a body rate may be off at speed; its error is gone in a tenth of the time


@kernel
def error_norm(y: Array, new: Array, h: float, k: Array, rtol: float, scales: Array) -> float:
    """Largest estimated error over tolerance, rtol (scale + |y|); columns of infinite scale do not count.

    Momentum counts by what the water's forces, which go with V^2, make of it: all but at rest, between dive and climb,
    an error grows a thousandfold while the vehicle turns over; at speed the body rates are damped so well that an error
    of theirs is gone before it has turned the vehicle.
    """
    V2 = k[6, SIZE] * k[6, SIZE] + k[6, SIZE + 1] * k[6, SIZE + 1] + k[6, SIZE + 2] * k[6, SIZE + 2]
    force = min(1.0, V2 / _GLIDING**2 + _LEAST_FORCE)
    worst = 0.0
    for j in range(2, 13):
        e = h * (E1 * k[0, j] + E3 * k[2, j] + E4 * k[3, j] + E5 * k[4, j] + E6 * k[5, j] + E7 * k[6, j])
        size = scales[j] * (1.0 + _DAMPED * force if j >= 10 else 1.0) + max(abs(y[j]), abs(new[j]))
        ratio = abs(e) / (rtol * size * (force if j >= 7 else 1.0))
        if not ratio < math.inf:  # a NaN or an overflow: the step is refused
            return math.inf
        worst = max(worst, ratio)
    return worst


@kernel
def dense(out: Array, y: Array, new: Array, h: float, k: Array, share: float) -> None:
    """The state a share of the step after its start: the pair's continuous extension of fourth order."""
    rest = 1.0 - share
    for j in range(SIZE):
        change = new[j] - y[j]
        bend = h * k[0, j] - change
        last = h * (D1 * k[0, j] + D3 * k[2, j] + D4 * k[3, j] + D5 * k[4, j] + D6 * k[5, j] + D7 * k[6, j])
        out[j] = y[j] + share * (change + rest * (bend + share * (change - h * k[6, j] - bend + rest * last)))
