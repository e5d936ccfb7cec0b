"""Does its net buoyancy carry a leg to the depth that ends it?"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.kernel import kernel, warmed
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Sea, at_depth
from glidercli.simulation.actuators import Drives, within
from glidercli.simulation.autopilot import Order, pumped_for
from glidercli.simulation.holding import net_excess
from glidercli.simulation.legs import Leg

__all__ = ["check_reach"]

Array = NDArray[np.float64]

_LOOKS = 500  # depths at which the net buoyancy is looked at
_FAST = 0.6  # m/s; gliders of this kind sink no faster, and do not coast further


def check_reach(leg: Leg, order: Order, drives: Drives, y: Array, t: float, sea: Sea, p: Parameters) -> None:
    """Refuse a steered leg that begins with a state y at a time, s, if its net buoyancy does not carry it to its end.

    Water that moves up or down may carry it anywhere, and is not judged.
    """
    if (sea.current.coefficients[:, :, 2] != 0.0).any():
        return
    energy = 0.5 * float(y[7:10] @ y[7:10]) / (p.ms + p.mr)
    z, excess = warmed(stuck)(order, drives, float(y[2]), leg.until_depth, t, energy, sea, p)
    if excess != 0.0:
        raise InputError(
            leg.place or f"leg {leg.name}",
            f"cannot end: at {z:.1f} m its net buoyancy in the water is {excess:.3g} kg (sinking positive), which "
            f"does not carry it to until_depth_m = {leg.until_depth:g}",
        )


@kernel
def stuck(
    order: Order, drives: Drives, depth: float, until: float, t: float, energy: float, sea: Sea, p: Parameters
) -> tuple[float, float]:
    """Depth, m, on the way from a depth to another at which a vehicle gets no further, and its net buoyancy there, kg;
    zeros if it comes through.

    It coasts through a layer that lifts it as far as its kinetic energy goes: ``energy``, J, at the start, and that of
    a fast glider once its net buoyancy has driven it.
    """
    way = 1.0 if until > depth else -1.0
    work = 0.0  # J, against it
    for i in range(_LOOKS):
        z = depth + (until - depth) * i / (_LOOKS - 1)
        water = at_depth(sea, z, t)
        mb = within(pumped_for(order, water, p), drives.mb_min, drives.mb_max)
        excess = net_excess(mb, water, p)
        work = max(0.0, work - way * excess * water.gravity * abs(until - depth) / _LOOKS)
        if way * excess > 0.0:
            energy = 0.5 * (p.ms + p.mr + max(p.MA[0], p.MA[1], p.MA[2])) * _FAST**2
        if work > energy:
            return z, excess
    return 0.0, 0.0
