"""How does a vehicle turn when its mass is rotated as far as it goes? Flown, not guessed.

Whether the same rotation turns a vehicle the same way on the dive and on the climb, its roll moment decides
(docs/missions.md); a controller must know.
"""

from __future__ import annotations

import math

from glidercli.model.parameters import Parameters
from glidercli.simulation.actuators import Drives
from glidercli.simulation.autopilot import GIVEN, Order
from glidercli.simulation.legs import Leg
from glidercli.simulation.settling import Settled, settled

__all__ = ["turns_of"]


def turns_of(order: Order, drives: Drives, p: Parameters) -> tuple[Settled | None, Settled | None]:
    """Steady flight at the least and the greatest rotation, with the pitch and net buoyancy of an order; None where
    it does not become steady."""
    low, high = (_turn(order, gamma, drives, p) for gamma in (drives.gamma_min, drives.gamma_max))
    return low, high


def _turn(order: Order, gamma: float, drives: Drives, p: Parameters) -> Settled | None:
    held = order._replace(holds_turn=GIVEN, mass_rotation=gamma, time_on=math.inf, time_off=0.0)
    return settled(Leg("turn", order=held), (order.mass_position, gamma, order.net_buoyancy), p, drives)
