"""Which straight glides are there? All of them by angle of attack, in closed form; and a first guess from the controls.

With the mass not rotated the glider flies straight. Gravity on the shifted centre of mass sets the pitch,
tan theta = -s_x / s_z; along and across the path m_b g sin(-xi) = D and m_b g cos(xi) = L with xi = theta - alpha.
"""

from __future__ import annotations

import math

import numpy as np

from glidercli.kernel import kernel
from glidercli.model.mass import first_moment
from glidercli.model.parameters import Controls, Parameters
from glidercli.ocean.water import Water
from glidercli.trim.steady import Array

__all__ = ["first_guess", "glides", "position_of_pitch"]


@kernel
def first_guess(rrx: float, mb: float, gravity: float, p: Parameters) -> tuple[float, float, float]:
    """Speed (m/s), angle of attack and pitch (rad) near the straight glide of r_rx, m, and m_b, kg."""
    s = first_moment(Controls(rrx, 0.0, mb, 0.0, 0.0), p)
    pitch = -math.atan2(s[0], s[2])
    down = math.copysign(1.0, mb)
    pitch = -down * min(max(abs(pitch), math.radians(8.0)), math.radians(80.0))
    alpha = 0.0
    for _ in range(20):  # D / L = tan(alpha - theta), solved for alpha in L
        slope = math.tan(min(max(abs(pitch - alpha), math.radians(10.0)), math.radians(80.0)))
        if p.Kalpha != 0.0:
            alpha = ((p.KD0 + p.KD * alpha * alpha) / slope * down - p.KL0) / p.Kalpha
        alpha = min(max(alpha, -0.2), 0.2)
    drag = p.KD0 + p.KD * alpha * alpha
    return math.sqrt(abs(mb) * gravity * math.sin(abs(pitch - alpha)) / drag), alpha, pitch


def position_of_pitch(pitch: float, p: Parameters) -> float:
    """Mass position, m, at which gravity alone holds a pitch, rad, with the mass not rotated."""
    s = first_moment(Controls(0.0, 0.0, 0.0), p)
    return (-math.tan(pitch) * s[2] - s[0]) / p.mr


def glides(alpha: Array, mb: Array, water: Water, p: Parameters) -> Array:
    """Straight glides (n, 9) of angles of attack, rad, and net buoyancies, kg, each (n,), in closed form.

    Without turning (28) reads m_b g k_b = -F, which gives speed and pitch; the pitch moment of (29) then places the
    mass: (s + m_b r_b) x g k_b = -(P x V + T). Rows are NaN where lift would push the wrong way. For a vehicle that is
    alike to port and starboard, in water of its reference density.
    """
    g = water.gravity
    ca, sa = np.cos(alpha), np.sin(alpha)
    D, L = p.KD0 + p.KD * alpha**2, p.KL0 + p.Kalpha * alpha
    Fx, Fz = -D * ca + L * sa, -D * sa - L * ca  # over V^2
    V2 = np.abs(mb) * g / np.hypot(Fx, Fz)
    kx, kz = -Fx * V2 / (mb * g), -Fz * V2 / (mb * g)
    P1, P3 = (p.ms + p.mr + p.MA[0]) * ca, (p.ms + p.mr + p.MA[2]) * sa  # over V
    M2 = (P3 * ca - P1 * sa + p.KM0 + p.KM * alpha) * V2
    sz = p.ms * p.rs[2] + p.mr * p.Rr + mb * p.rb[2]
    with np.errstate(divide="ignore", invalid="ignore"):
        sx = (sz * kx + M2 / g) / kz
    rrx = (sx - p.ms * p.rs[0] - mb * p.rb[0]) / p.mr
    none = np.zeros_like(alpha)
    x = np.column_stack([np.sqrt(V2), alpha, none, none, none, -np.arcsin(np.clip(kx, -1.0, 1.0)), rrx, none, mb])
    x[kz <= 0.0] = np.nan
    return x
