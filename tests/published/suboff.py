"""The DARPA SUBOFF model 5470: Groves, Huang & Chang (1989), DTRC/SHD-1298-01; what it measured, and its shape.

Both as public repositories quote the reports, which were not at hand.
"""

from __future__ import annotations

import math

import numpy as np

from glidercli.coefficients.shape.geometry import Geometry, HullShape, Surface

FOOT = 0.3048
LENGTH = 14.291667 * FOOT
DENSITY = 998.0
SPEED, REYNOLDS = 3.046, 1.2e7
RESISTANCE, WETTED = 3.15e-3, 5.988
"""Coefficient on the wetted area, m2, of the bare hull at that Reynolds number: Liu & Huang (1998), table 14."""

MEASURED = {
    "bare hull": {"Y_v": -0.005948, "N_v": -0.012795, "N_r": -0.001597},
    "hull and sail": {"Y_v": -0.023008, "N_v": -0.015534, "N_r": -0.002378},
    "hull and planes": {"Y_v": -0.010494, "N_v": -0.011254, "N_r": -0.003064},
}
"""Slopes at the origin in the horizontal plane, body axes, over rho/2 L^2 V^2, L^3 V^2 and L^4 V: Roddy (1990),
DTRC/SHD-1298-08, table 4, configurations 3, 4 and 5. Static ones are good to 4 to 5 %, rotary ones to 10 % (his page 105)."""


def radius(x: float) -> float:
    """Of the hull, ft, x ft behind the nose: table 1 of Groves, Huang & Chang."""
    largest, r, k0, k1 = 5.0 / 6.0, 0.1175, 10.0, 44.6244
    if x <= 3.333333:
        t = 0.3 * x - 1.0
        inner = 1.126395101 * x * t**4 + 0.442874707 * x * x * t**3 + 1.0 - t**4 * (1.2 * x + 1.0)
        return largest * max(inner, 0.0) ** (1.0 / 2.1)
    if x <= 10.645833:
        return largest
    if x > 13.979167:
        return r * largest * math.sqrt(max(0.0, 1.0 - (3.2 * x - 44.733333) ** 2))
    xi = (13.979167 - x) / 3.333333
    powers = {
        0: r * r, 2: r * k0, 3: 20.0 - 20.0 * r * r - 4.0 * r * k0 - k1 / 3.0,
        4: -45.0 + 45.0 * r * r + 6.0 * r * k0 + k1, 5: 36.0 - 36.0 * r * r - 4.0 * r * k0 - k1,
        6: -10.0 + 10.0 * r * r + r * k0 + k1 / 3.0,
    }  # fmt: skip
    return largest * math.sqrt(sum(factor * xi**power for power, factor in powers.items()))


def suboff(configuration: str) -> Geometry:
    """The model in one of the configurations of ``MEASURED``."""
    x = np.unique(np.r_[
        np.linspace(0.0, 0.3, 31), np.linspace(0.4, 3.333333, 31), 10.645833, np.linspace(10.8, 13.979167, 41),
        np.linspace(13.979167, 14.291667, 21),
    ])  # fmt: skip
    hull = HullShape(stations=tuple(-x * FOOT), radii=tuple(radius(at) * FOOT for at in x))
    surfaces = {}
    if configuration == "hull and planes":  # table 3: chord 0.88859 - 0.466308 y ft, trailing edge at 13.146284 ft
        for plane in ("horizontal", "vertical"):
            surfaces[f"{plane} planes"] = Surface(
                plane=plane, semi_span=5.0 / 6.0 * FOOT, root_chord=0.88859 * FOOT, tip_chord=0.5 * FOOT,
                root_position=-(13.146284 - 0.88859) * FOOT, tip_position=-(13.146284 - 0.5) * FOOT, thickness=0.2,
            )  # fmt: skip
    if configuration == "hull and sail":  # table 2: up to where its cap begins
        surfaces["sail"] = Surface(
            plane="vertical", semi_span=1.507813 * FOOT, root_chord=1.208333 * FOOT, tip_chord=1.208333 * FOOT,
            root_position=-3.032986 * FOOT, tip_position=-3.032986 * FOOT, thickness=0.181, sides="upper",
        )  # fmt: skip
    return Geometry(configuration, "SUBOFF", "Groves, Huang & Chang (1989)", hull, surfaces, density=DENSITY)
