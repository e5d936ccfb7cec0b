"""What does the paper's recursion do as it is printed? Eq. (44) with (41), (42), (45), (46), (47) and (49) in turn.

It is kept for the record: hardly anything comes to rest under it. recursion.py is the form that works. ``Assignment``
tries the repairs that leave the scalar equations in place; benchmarks/recursion.py counts what each recovers.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from glidercli.frames import down_in_body
from glidercli.model.hydrodynamics import velocity_from_flow
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.trim.recursion import CONVERGED, Iterate, Recursion, change, ended
from glidercli.trim.scalar import Spiral, eq39, eq41, eq42, eq45, eq46, eq47, eq49, gamma_from_40, rrx_from_37

__all__ = ["PRINTED", "Assignment", "printed_recursions"]

PASSES = 200
QUADRANTS = {"DL": (1, -1), "DR": (1, 1), "AR": (-1, 1), "AL": (-1, -1)}
"""Table 4: sinking or rising, and the sign of gamma and omega_3."""


class Assignment(NamedTuple):
    """Which equation gives what. restored : (40) with the term that is not printed. share : of each change made."""

    rate_from_39: bool = False
    swapped: bool = False
    """r_rx from (37) and gamma from (40), not the other way round."""
    restored: bool = False
    share: float = 1.0


PRINTED = Assignment()


def printed_recursions(
    speed: float, alpha: float, beta: float, nominal: float, water: Water, p: Parameters, how: Assignment = PRINTED
) -> list[Recursion]:
    """The sequences of a speed, m/s, angle of attack and sideslip, rad, one from each quadrant of Table 4.

    The paper says that a proper start is needed, and gives its signs alone; the numbers here are those of the middle of
    the envelope.
    """
    V = velocity_from_flow(speed, alpha, beta)
    found = []
    for quadrant, (way, turn) in QUADRANTS.items():
        x = Spiral(
            speed, alpha, beta, theta=-0.6 * way, phi=-0.2 * way * turn, mb=0.3 * way, gamma=0.8 * turn,
            omega3=0.004 * turn, rrx=nominal + 0.02 * way, g=water.gravity,
        )  # fmt: skip
        iterates, stands = [_iterate(x)], False
        while len(iterates) <= PASSES and not stands:
            x = _passed(x, p, how)
            if not all(map(math.isfinite, x)):
                break
            iterates.append(_iterate(x))
            stands = change(*iterates[-2:]) < CONVERGED
        found.append(ended(quadrant, iterates[1:] or iterates, stands, V, water, p))
    return found


def _passed(old: Spiral, p: Parameters, how: Assignment) -> Spiral:
    """One pass of (44); each equation takes what those before it gave."""
    x = old._replace(mb=eq41(old, p))
    x = x._replace(omega3=eq39(x, p) if how.rate_from_39 else eq42(x, p))
    x = x._replace(theta=eq45(x, p))
    x = x._replace(phi=eq46(x, p))
    if how.swapped:
        x = x._replace(rrx=rrx_from_37(x, p))
        x = x._replace(gamma=gamma_from_40(x, p, how.restored))
    else:
        x = x._replace(gamma=eq47(x, p))
        x = x._replace(rrx=eq49(x, p, how.restored))
    return Spiral(*(a + how.share * (b - a) for a, b in zip(old, x, strict=True)))


def _iterate(x: Spiral) -> Iterate:
    return Iterate(down_in_body(x.phi, x.theta), x.mb, x.omega3, x.gamma, x.rrx, True)
