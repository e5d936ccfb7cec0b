"""What any right integration of any right model has: order, energy with a moving mass, no trouble at the poles."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from glidercli.frames import dot, rotation_ned_body
from glidercli.model import Parameters
from glidercli.model.mass import first_moment, momentum, movable_position
from glidercli.model.parameters import Controls
from glidercli.ocean import Ocean, Sea
from glidercli.ocean.profile import pchip
from glidercli.simulation.flight import Flight, fly, scales_of
from glidercli.simulation.legs import Leg, held
from glidercli.simulation.start import Start
from glidercli.simulation.stepper import SIZE, WIDTH, error_norm, segment_of, slope_into, stages

STILL = Ocean.uniform(1025.0, temperature_reference=15.0).sea
SPIRAL = Controls(0.4216, math.radians(45.0), 0.3)


def test_the_pair_converges_with_its_fifth_order(p: Parameters) -> None:
    """Fixed steps over 20 s of a spiral from rest: half the step, a 32nd of the error."""
    segment = segment_of(0.0, SPIRAL, 0.0, p, True)

    def end(n: int) -> np.ndarray:
        y, k, new = np.zeros(SIZE), np.zeros((7, WIDTH)), np.empty(SIZE)
        y[2], y[3] = 100.0, 1.0
        for i in range(n):
            slope_into(k, 0, 20.0 * i / n, y, segment, STILL, p, True)
            stages(y, 20.0 * i / n, 20.0 / n, k, new, segment, STILL, p, True)
            y = new.copy()
        return y[:13]

    best = end(1280)
    errors = [float(np.abs(end(n) - best).max()) for n in (80, 160, 320)]
    orders = [math.log2(a / b) for a, b in itertools.pairwise(errors)]
    assert min(orders) > 4.6  # 5 as the step goes to zero
    assert errors[-1] < 1e-6


def test_the_error_is_in_proportion_to_the_tolerance(p: Parameters) -> None:
    """Where the steps are bounded by the error: from rest, the first minutes."""
    legs = [held(*SPIRAL[:3])]
    best = fly(legs, STILL, p, duration=100.0, rtol=1e-13).samples[-1]
    errors = [np.abs(fly(legs, STILL, p, duration=100.0, rtol=rtol).samples[-1] - best)[:13].max()
              for rtol in (1e-5, 1e-7, 1e-9)]  # fmt: skip
    assert errors[0] > 3.0 * errors[1] > 9.0 * errors[2]
    assert errors[2] < 1e-8


def total(p: Parameters, flight: Flight, i: int, c: Controls) -> float:
    """Kinetic energy, that of the actuator's own motion included, and the height of the centre of mass, J."""
    V, Omega = (tuple(float(flight.column(name)[i]) for name in names) for names in ("uvw", "pqr"))
    q = tuple(float(flight.column(f"q_{name}")[i]) for name in "wxyz")
    P, Pi = momentum(V, Omega, c, 1.0, p)
    rate = np.array([c.rrx_rate, -p.Rr * math.cos(c.gamma) * c.gamma_rate, -p.Rr * math.sin(c.gamma) * c.gamma_rate])
    kinetic = 0.5 * (dot(P, V) + dot(Pi, Omega))
    carried = np.array(V) + np.cross(Omega, movable_position(c, p))
    kinetic += 0.5 * p.mr * rate @ rate + p.mr * rate @ carried
    kinetic += 0.5 * p.Ir0[0] * c.gamma_rate**2 + p.Ir0[0] * c.gamma_rate * Omega[0]
    return kinetic - 9.81 * dot(first_moment(c, p), rotation_ned_body(q)[2])


def test_energy_balances_while_the_mass_slides(p: Parameters) -> None:
    """Work of the net weight and of the actuator = energy lost to the water + what the motion gained.

    The actuator's force on the mass is m_r times the mass's acceleration, less gravity; here from the motion alone, by
    differences of the mass's velocity over 5 ms.
    """
    rate, span, step = 2e-3, 10.0, 5e-3
    leg = Leg("slide", np.array([0.0, span]), np.array([[0.4016, 0.3, 0.3], [0.4016 + rate * span, 0.3, 0.3]]))
    flight = fly([leg], STILL, p, duration=span, start=Start(depth=50.0), every=step, rtol=1e-11)
    n = len(flight.times)
    at = [Controls(0.4016 + rate * t, 0.3, 0.3, rate, 0.0) for t in flight.times]
    R = [np.array(rotation_ned_body(tuple(flight.samples[i, 3:7]))) for i in range(n)]
    V, Omega = flight.samples[:, 7:10], flight.samples[:, 10:13]
    over_ground = np.array(
        [R[i] @ (V[i] + np.cross(Omega[i], movable_position(at[i], p)) + [rate, 0.0, 0.0]) for i in range(n)]
    )
    acceleration = np.gradient(over_ground, step, axis=0, edge_order=2)
    force = [p.mr * R[i].T @ (acceleration[i] - [0.0, 0.0, 9.81]) for i in range(n)]
    work = float(np.trapezoid([f[0] * rate for f in force], dx=step))
    work += 0.3 * 9.81 * float(flight.column("down")[-1] - flight.column("down")[0])
    # the mass gets its speed at once: the jump in energy at the start and at the end is the actuator's, too
    gained = total(p, flight, n - 1, at[-1]) - total(p, flight, 0, at[0])
    assert float(flight.column("energy")[-1]) + gained == pytest.approx(work, rel=2e-5)  # of the differences


@pytest.mark.parametrize("pitch", [90.0, -90.0, 89.999])
def test_pitch_passes_through_90_degrees(p: Parameters, pitch: float) -> None:
    """Tumbling about the pitch axis without water forces, free fall: the axis keeps its direction, the rate its size."""
    zero = (0.0, 0.0, 0.0)
    none = dict.fromkeys(
        ("Nv", "Mw", "KD0", "KD", "Kbeta", "KL0", "Kalpha", "KMR", "Kp", "KM0", "KM", "Kq", "KMY", "Kr"), 0.0
    )
    bare = p._replace(MA=zero, IA=zero, **none)
    start = Start(depth=500.0, pitch=math.radians(pitch), heading=1.0, Omega=(0.0, 0.5, 0.0))
    weightless = Ocean.uniform(1025.0, gravity=1e-12, temperature_reference=15.0).sea
    flight = fly([held(0.4016, 0.0, 0.0)], weightless, bare, duration=60.0, start=start, rtol=1e-10, every=0.5)
    assert np.isfinite(flight.samples).all()
    assert np.abs(flight.column("q") - flight.column("q")[0]).max() < 1e-7
    for row in flight.samples:
        east_axis = np.array(rotation_ned_body(tuple(row[3:7])))[:, 1]
        assert east_axis == pytest.approx([-math.sin(1.0), math.cos(1.0), 0.0], abs=1e-7)


def test_standing_still_and_far_beyond_the_fit_is_flown_and_flagged(p: Parameters) -> None:
    """Released at rest on its side, tail first, rolling over: no step fails, and what is beyond the fit is told."""
    for start in (
        Start(depth=50.0),
        Start(50.0, 3.0, 1.4, 0.5),
        Start(50.0, 0.0, 0.0, 0.0, (-0.5, 0.3, 0.4), (1.0, 1.0, 1.0)),
    ):
        flight = fly([held(0.4416, 1.5, 0.4)], STILL, p, duration=900.0, start=start, fitted_angle=math.radians(12.0))
        assert np.isfinite(flight.samples).all()
        assert "angle of attack" in [e.name for e in flight.excursions]


def test_an_error_that_is_not_a_number_refuses_the_step(p: Parameters) -> None:
    k = np.zeros((7, WIDTH))
    k[3, 8] = math.nan
    assert error_norm(np.zeros(SIZE), np.zeros(SIZE), 0.1, k, 1e-6, scales_of(p)) == math.inf


@pytest.mark.parametrize("kappa", [0.0, 4e-10, -1.0])
def test_the_dive_ends_where_the_vehicle_is_neutral(p: Parameters, kappa: float) -> None:
    """ "Before it became neutrally buoyant": the trial's own limit, here where the formula of the buoyancy says.

    Water 0.9 % denser at 1000 m, half a degree colder for every 50 m; kappa per Pa, or thermal expansion where -1.
    """
    hull = p._replace(rho_0=1022.0, kappa=max(kappa, 0.0), chi=6e-5 if kappa < 0.0 else 0.0)
    depth = np.linspace(0.0, 3000.0, 31)
    density, pressure, temperature = 1022.0 * (1.0 + 9e-6 * depth), 1e4 * depth, 25.0 - depth / 100.0
    sea = Sea(pchip(depth, np.column_stack([density, pressure, temperature])), STILL.current, 9.81)

    def excess(z: float) -> float:
        ratio = 1.0 + 9e-6 * z
        volume = 1.0 - hull.kappa * 1e4 * z + hull.chi * (25.0 - z / 100.0 - hull.T_0)
        return 65.28 * (1.0 - ratio * volume) + 0.5 * ratio

    neutral = brentq(excess, 0.0, 3000.0)
    flight = fly([held(0.4216, 0.0, 0.5)], sea, hull, duration=40000.0, every=100.0)
    assert flight.column("down")[-1] == pytest.approx(neutral, abs=1.0)  # it still swings by some cm
    assert abs(flight.excess) < 1e-3
