"""What does the steering command? Mass position for pitch, mass rotation for heading or turn, pump for buoyancy.

Once in a sampling period the controllers read attitude, turn and water, and set commands that the actuators then move
towards (actuators.py).

    pitch          r_rx += a s_z / (m_r cos^2 theta) (theta - theta_wanted)   outside a dead band, once within reach
    heading        gamma = b (psi_wanted - psi)
    turn rate      gamma += b (psidot_wanted - psidot)
    radius         the same, with psidot_wanted = horizontal speed through water / radius

The first is the inverse of static balance, tan theta = -m_r (r_rx - r_0) / s_z, taken by a share a at a time. On
the Seawing b = 1 settles a heading in some 200 s; feeding psidot back as well sets up a swing at a period of 6 s.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from glidercli.frames import dot, rotation_ned_body, times
from glidercli.kernel import kernel
from glidercli.model.buoyancy import hull_excess
from glidercli.model.equations import State
from glidercli.model.mass import Placement, velocity
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.simulation.actuators import Drives, within

__all__ = ["GIVEN", "HEADING", "HELD_PITCH", "IN_WATER", "RADIUS", "TURN_RATE", "Order", "commands", "pumped_for"]

GIVEN = 0
"""The actuator goes where the order says."""
HELD_PITCH = 1
HEADING, TURN_RATE, RADIUS = 1, 2, 3
IN_WATER = 1
"""Net buoyancy is held in the water around, not in the pump."""

_GLIDING = math.tan(math.radians(20.0))
"""Angle of attack, as its tangent, beyond which the vehicle does not glide and its rotation turns it no way in
particular, as between dive and climb: a held turn then waits as it is, a held heading with the mass hanging down."""
OUT_OF_REACH = math.radians(15.0)
"""Pitch error beyond which the vehicle is still turning over: the mass then waits where static balance puts it."""


class Order(NamedTuple):
    """What a leg asks of the steering; SI, rad. ``holds_*`` is GIVEN or what is held; the other fields then say it."""

    holds_buoyancy: int
    net_buoyancy: float
    holds_pitch: int
    mass_position: float
    """Given, or where static balance puts it for the wanted pitch."""
    pitch: float
    pitch_band: float
    pitch_gain: float
    """m/rad a sample."""
    holds_turn: int
    mass_rotation: float
    """Given, or what the leg begins with."""
    wanted: float
    """Heading (rad), turn rate (rad/s) or turning radius (m, starboard positive)."""
    turn_band: float
    """rad; a change of rotation below it is not commanded."""
    gain: float
    """b: rad of rotation for a rad of heading, or for a rad/s of turn rate."""
    time_on: float
    """s that a given rotation is held before it returns to zero; infinite for always."""
    time_off: float
    """s that it then stays there."""
    period: float
    """s between samples; infinite if nothing is held."""


@kernel
def pumped_for(order: Order, water: Water, p: Parameters) -> float:
    """Net buoyancy that the pump must give, kg: as ordered, or so that it is that in the water around."""
    if order.holds_buoyancy == IN_WATER:
        hull = hull_excess(water.density, water.pressure, water.temperature, p)
        return (order.net_buoyancy - hull) * p.rho_0 / water.density
    return order.net_buoyancy


@kernel
def commands(
    order: Order, drives: Drives, s: State, at: Placement, water: Water, p: Parameters, elapsed: float,
    last: tuple[float, float, float],
) -> tuple[float, float, float]:  # fmt: skip
    """Commands (mass position, m; mass rotation, rad; net buoyancy, kg), within the limits of the actuators.

    elapsed : s since the leg began. last : the commands before.
    """
    rrx, gamma, _ = last
    V, Omega = velocity(s.P, s.Pi, at, water.density / p.rho_ref, p)
    R = rotation_ned_body(s.q_wxyz)
    if order.holds_pitch == HELD_PITCH:
        pitch = math.asin(within(-R[2][0], -1.0, 1.0))
        error = pitch - order.pitch
        if order.pitch_band < abs(error) < OUT_OF_REACH:
            rrx += order.pitch_gain * error
    turn = dot(R[2], Omega)
    if order.holds_turn == GIVEN:
        gamma = order.mass_rotation
        if elapsed % (order.time_on + order.time_off) >= order.time_on:
            gamma = 0.0
    elif abs(V[2]) >= _GLIDING * V[0]:
        gamma = 0.0 if order.holds_turn == HEADING else gamma
    elif order.holds_turn == HEADING:
        error = order.wanted - math.atan2(R[1][0], R[0][0])
        error -= 2.0 * math.pi * math.floor(error / (2.0 * math.pi) + 0.5)
        new = within(order.gain * error, drives.gamma_min, drives.gamma_max)
        gamma = new if abs(new - gamma) > order.turn_band else gamma
    else:
        wanted = order.wanted
        if order.holds_turn == RADIUS:
            north, east, _ = times(R, V)
            wanted = math.sqrt(north * north + east * east) / order.wanted
        change = order.gain * (wanted - turn)
        gamma += change if abs(change) > order.turn_band else 0.0
    return (
        within(rrx, drives.rrx_min, drives.rrx_max),
        within(gamma, drives.gamma_min, drives.gamma_max),
        within(pumped_for(order, water, p), drives.mb_min, drives.mb_max),
    )
