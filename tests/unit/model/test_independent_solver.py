"""The simulator against scipy's integrator on eq. (19) as printed, with matrices: other code, other form, other solver."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp
from test_equations import printed
from test_mass import P

from glidercli.frames import quaternion_rate, rotation_ned_body
from glidercli.model import Controls
from glidercli.ocean import Ocean
from glidercli.simulation.flight import fly
from glidercli.simulation.legs import held
from glidercli.simulation.start import Start


def test_a_violent_climb_is_the_same_by_both() -> None:
    """Twice the buoyancy of Table 1, as the trial's climb meets in dense water: roll passes 90 deg within 100 s."""
    c = Controls(0.3816, math.radians(2.0), -0.96)

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        V, Omega, q = tuple(y[:3]), tuple(y[3:6]), tuple(y[6:10] / np.linalg.norm(y[6:10]))
        R = rotation_ned_body(q)
        return np.hstack([printed(V, Omega, R[2], c, P), quaternion_rate(q, Omega), np.array(R) @ np.array(V)])

    start = np.hstack([np.zeros(6), [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 800.0]])
    theirs = solve_ivp(rates, (0.0, 100.0), start, rtol=1e-9, atol=1e-10).y[:, -1]
    legs = [held(c.rrx, c.gamma, c.mb)]
    ours = fly(legs, Ocean.uniform(1025.0, 9.81, 15.0).sea, P, duration=100.0, start=Start(depth=800.0), rtol=1e-10)
    names = ("u", "v", "w", "p", "q", "r", "q_w", "q_x", "q_y", "q_z", "north", "east", "down")
    mine = np.array([ours.column(name)[-1] for name in names])
    np.testing.assert_allclose(mine, theirs, atol=1e-6)  # m, m/s, rad/s: a thousand times the solvers' tolerances
