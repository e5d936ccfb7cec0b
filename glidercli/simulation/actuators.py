"""How do the actuators move? Each at its own rate towards what is commanded; the pump slower against pressure."""

from __future__ import annotations

import math
from typing import NamedTuple

from glidercli.kernel import kernel
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water

__all__ = ["Drives", "drive_pressure", "moving_controls", "time_to_move", "within"]


class Drives(NamedTuple):
    """Limits and rates of the three actuators; SI, rad. A rate may be infinite only where nothing is commanded."""

    rrx_min: float
    rrx_max: float
    rrx_rate: float
    """m/s of the slide."""
    gamma_min: float
    gamma_max: float
    gamma_rate: float
    """rad/s of the rotation."""
    mb_min: float
    mb_max: float
    pump_rate: float
    """m3/s of oil pumped out at the surface."""
    pump_slowing: float
    """Share of that rate lost per Pa of sea pressure."""
    bleed_rate: float
    """m3/s of oil let in."""
    refresh: float
    """s after which the rate of a running pump is taken anew from the pressure."""


@kernel
def drive_pressure(water: Water, depth: float) -> float:
    """Sea pressure that the pump works against, Pa; hydrostatic in uniform water, which has no pressure of its own."""
    return water.pressure if water.pressure > 0.0 else water.density * water.gravity * max(0.0, depth)


@kernel
def pump_rate(mb: float, command: float, pressure: float, drives: Drives, p: Parameters) -> float:
    """Rate of net buoyancy, kg/s: negative while oil is pumped out, slower with pressure, down to a tenth."""
    if command < mb:
        return -drives.pump_rate * max(0.1, 1.0 - drives.pump_slowing * pressure) * p.rho_0
    return drives.bleed_rate * p.rho_0


@kernel
def rate_towards(value: float, command: float, rate: float) -> float:
    """The rate with its sign: towards the command, zero there."""
    return math.copysign(rate, command - value) if value != command else 0.0


@kernel
def time_to_move(value: float, command: float, rate: float) -> float:
    """Time until the command is reached, s; infinite if it is there."""
    return (command - value) / rate if rate != 0.0 else math.inf


@kernel
def within(value: float, least: float, greatest: float) -> float:
    """The value brought between two limits."""
    return max(least, min(greatest, value))


@kernel
def moving_controls(
    rrx: float, gamma: float, mb: float, commands: tuple[float, float, float], pressure: float, drives: Drives,
    p: Parameters,
) -> tuple[Controls, float]:  # fmt: skip
    """The controls with the rates at which they move towards the commands, and the rate of net buoyancy, kg/s."""
    rate = 0.0 if mb == commands[2] else pump_rate(mb, commands[2], pressure, drives, p)
    return Controls(
        rrx,
        gamma,
        mb,
        rate_towards(rrx, commands[0], drives.rrx_rate),
        rate_towards(gamma, commands[1], drives.gamma_rate),
    ), rate
