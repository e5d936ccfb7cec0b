"""Where does a straight glide start? A first guess of speed, angle of attack and pitch from statics and lift over drag.

With the mass not rotated the glider flies straight. Gravity on the shifted centre of mass sets the pitch,
tan theta = -s_x / s_z; along and across the path m_b g sin(-xi) = D and m_b g cos(xi) = L with xi = theta - alpha.
"""

from __future__ import annotations

import math

from glidercli.kernel import kernel
from glidercli.model.mass import first_moment
from glidercli.model.parameters import Controls, Parameters

__all__ = ["first_guess", "position_of_pitch"]


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
        alpha = ((p.KD0 + p.KD * alpha * alpha) / slope * down - p.KL0) / p.Kalpha
        alpha = min(max(alpha, -0.2), 0.2)
    drag = p.KD0 + p.KD * alpha * alpha
    return math.sqrt(abs(mb) * gravity * math.sin(abs(pitch - alpha)) / drag), alpha, pitch


def position_of_pitch(pitch: float, p: Parameters) -> float:
    """Mass position, m, at which gravity alone holds a pitch, rad, with the mass not rotated."""
    s = first_moment(Controls(0.0, 0.0, 0.0), p)
    return (-math.tan(pitch) * s[2] - s[0]) / p.mr
