"""Sweeps against single questions, the polar against the six equations and its optimum against a search by scipy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import minimize

import glidercli
from glidercli.errors import GliderError, InputError, UsageError
from glidercli.model.parameters import Parameters
from glidercli.ocean.water import Water
from glidercli.trim.atlas import atlas
from glidercli.trim.polars import BEST, Journey
from glidercli.trim.steady import six
from glidercli.trim.straight import glides
from glidercli.trim.sweeping import axis
from glidercli.vehicle import Vehicle

WATER = Water(1025.0, 0.0, 15.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.81)


def test_a_map_is_its_single_questions() -> None:
    """Compiled and by the hundred, or plain and one by one: controls that have one flight, two, and none."""
    axes = (axis("mass-rotation=-80:80:10"), axis("net-buoyancy=-0.5:0.5:0.04"))
    found = glidercli.trim.sweep("seawing", axes, mass_position=0.3976)
    for number in range(0, found.points, 23):
        at = found.at(number)
        pins = {"mass_rotation": math.radians(at["mass_rotation_deg"]), "net_buoyancy": at["net_buoyancy_kg"]}
        rows = np.flatnonzero(found.point == number)
        try:
            alone = glidercli.trim.trims(**pins, mass_position=0.3976)
        except GliderError:
            alone = []
        assert len(alone) == len(rows), at
        for row, trim in zip(rows, alone, strict=True):
            for name, value in trim.document().items():
                if isinstance(value, float):
                    assert found.table[name][row] == pytest.approx(value, rel=1e-6, abs=1e-9), (at, name)
                elif name != "iterations":
                    assert found.table[name][row] == value, (at, name)


def test_inverse_maps_too() -> None:
    found = glidercli.trim.sweep("seawing", (axis("turning-radius=80:200:40"), axis("pitch=-45:-20:5")), speed=0.4)
    assert not found.missing
    assert found.grid("turning_radius_m") == pytest.approx(np.repeat([[80.0, 120, 160, 200]], 6, 0).T)
    assert found.grid("pitch_deg") == pytest.approx(np.repeat([[-45.0, -40, -35, -30, -25, -20]], 4, 0))
    alone = glidercli.trim(speed=0.4, pitch=math.radians(-30), turning_radius=120.0)
    assert found.grid("mass_rotation_deg")[1, 3] == pytest.approx(math.degrees(alone.mass_rotation), rel=1e-9)


def test_a_sweep_through_straight_flight_has_it() -> None:
    found = glidercli.trim.sweep("seawing", (axis("yaw-rate=-0.3:0.3:0.1"),), speed=0.4, pitch=math.radians(-30))
    radius = found.grid("turning_radius_m")
    assert np.isinf(radius[3])
    assert radius[:3] == pytest.approx(-radius[:3:-1])
    assert found.grid("mass_rotation_deg")[3] == 0.0


def test_pins_that_contradict_at_some_points_only() -> None:
    found = glidercli.trim.sweep("seawing", (axis("yaw-rate=-0.4:0.6:0.2"),), turning_radius=100.0, speed=0.45)
    assert sorted(found.missing) == [0, 1, 2, 4, 5]  # 0.4 deg/s on 100 m is 0.70 m/s
    assert "same side" in found.missing[0]
    assert "straight glide" in found.missing[2]
    with pytest.raises(UsageError, match="same side"):
        glidercli.trim.sweep("seawing", (axis("yaw-rate=-0.4:-0.2:0.2"),), turning_radius=100.0, speed=0.45)


def test_straight_glides_in_a_map_are_exactly_straight() -> None:
    found = glidercli.trim.sweep("seawing", (axis("pitch=-60:-20:1.7"), axis("speed=0.2:0.6:0.037")), yaw_rate=0.0)
    assert np.isinf(found.table["turning_radius_m"]).all()
    assert (found.table["roll_deg"] == 0.0).all()


def test_axis_counts_its_stop_where_a_step_meets_it() -> None:
    assert len(axis("pitch=-60:-10:0.1").values) == 501
    assert np.degrees(axis("mass-rotation=0:10:3").values) == pytest.approx([0, 3, 6, 9])
    assert axis("net-buoyancy=-0.3:0.3:0.1").values[3] == 0.0
    assert np.degrees(axis("pitch=0:-20:-10").values) == pytest.approx([0, -10, -20])
    for text in ("pitch=0:10:-1", "pitch=0:10:inf"):
        with pytest.raises(InputError):
            axis(text)
    with pytest.raises(UsageError):
        axis("pitch:0:10:1")


def test_straight_glides_in_closed_form_are_trims(p: Parameters) -> None:
    alpha = np.radians([0.5, 2.0, 7.9, 11.0, -0.5, -2.0, -7.8, -11.0])
    mb = np.array([0.1, 0.5, 0.3, 0.2, -0.1, -0.5, -0.3, -0.2])
    q = p._replace(rb=(0.02, 0.0, -0.01))  # a term that the Seawing leaves at zero
    for x in glides(alpha, mb, WATER, q).tolist():
        assert max(map(abs, six(tuple(x), WATER, q))) < 1e-13  # a few operations on moments of some N m
    assert np.isnan(glides(np.array([-0.2]), np.array([0.3]), WATER, p)).all()  # lift would push a sinking glider down


def test_least_energy_is_that_of_an_optimiser(seawing: Vehicle, p: Parameters) -> None:
    journey = Journey(current=0.15, hotel_power=0.5, pump_efficiency=0.6)
    found = glidercli.trim.polar(seawing, journey=journey).document()["dive"]["least_energy"]

    def energy(z: np.ndarray) -> float:
        x = glides(np.array([z[0]]), np.array([z[1]]), WATER, p)[0]
        path = x[5] - x[1]
        made_good = x[0] * math.cos(path) - 0.15
        if not 0.0 < z[1] <= 0.5 or not made_good > 0.0:
            return math.inf
        power = z[1] * 9.81 * x[0] * -math.sin(path) / 0.6 + 0.5
        return 1000.0 * power / made_good

    best = minimize(energy, (0.04, 0.3), method="Nelder-Mead", options={"xatol": 1e-6, "fatol": 1e-6})
    # the grid of the search has steps of 0.5 % in net buoyancy, where the energy is flat
    assert found["energy_per_km_j"] == pytest.approx(best.fun, rel=1e-4)
    assert found["net_buoyancy_kg"] == pytest.approx(best.x[1], rel=0.01)


def test_polar_curves_lie_within_the_fitted_range() -> None:
    found = glidercli.trim.polar(net_buoyancy=0.3)
    curve = found.curve != BEST
    assert np.abs(found.table["angle_of_attack_deg"][curve]).max() == pytest.approx(12.0)
    assert set(found.best) == {"dive"}
    with pytest.raises(InputError, match="hotel power"):
        glidercli.trim.polar(journey=Journey(hotel_power=-1.0))


def test_atlas_is_kept_and_a_spoilt_one_made_anew(
    seawing: Vehicle, p: Parameters, tmp_path, monkeypatch: pytest.MonkeyPatch
) -> None:  # type: ignore[no-untyped-def]
    from glidercli import kernel

    monkeypatch.setenv("GLIDER_CACHE_DIR", str(tmp_path))
    kernel.cache_folder.cache_clear()
    try:
        first = atlas(seawing.actuators, False, WATER, p)
        [kept] = tmp_path.rglob("atlas-*.npz")
        again = atlas(seawing.actuators, False, WATER, p)
        assert all(np.array_equal(a, b) for a, b in zip(first, again, strict=True))
        kept.write_bytes(kept.read_bytes()[:1000])
        anew = atlas(seawing.actuators, False, WATER, p)
        assert all(np.array_equal(a, b) for a, b in zip(first, anew, strict=True))
        other = atlas(seawing.actuators, False, WATER._replace(gravity=9.8), p)
        assert not np.array_equal(first.trims, other.trims)
    finally:
        kernel.cache_folder.cache_clear()
