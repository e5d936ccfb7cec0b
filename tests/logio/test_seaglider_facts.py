"""Seaglider channels against what is known otherwise: signs, turns, motors, TEOS-10, the basestation's own heading."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

import gsw
import netCDF4
import numpy as np
import pytest
from conftest import ROOT
from numpy.typing import NDArray

from glidercli.log import Log
from glidercli.logio import read
from glidercli.logio.seaglider import read_seaglider

Array = NDArray[np.float64]

SG561 = ROOT / "logs/seaglider-sg561"
OTHERS = ROOT / "tests/data/seaglider"
ENGS = [OTHERS / "p5610002.eng", SG561 / "p5610003.eng", OTHERS / "p5610004.eng", OTHERS / "p5610005.eng"]
NCS = [SG561 / "p5610003.nc", OTHERS / "p1710100.nc", OTHERS / "p2490010.nc"]


def log_of(path: Path) -> Log:
    return read_seaglider(path).log


class Turns(NamedTuple):
    """Samples below 10 m of the four dives: deg, deg/s since the sample before."""

    roll: Array
    pitch: Array
    rate: Array
    rotation: Array


def turns() -> Turns:
    found = []
    for path in ENGS:
        log = log_of(path)
        times, (roll, pitch, heading, depth) = log.together("roll", "pitch", "heading", "depth")
        turn = np.diff(np.degrees(np.unwrap(heading)))
        rate = np.append(np.nan, turn / np.diff(times * 1e-9))
        both, (rotation,) = log.together("mass_rotation")
        kept = np.isin(times, both) & (depth > 10.0) & np.isfinite(rate)
        rotation = rotation[np.searchsorted(both, times[kept])]
        found.append([np.degrees(roll[kept]), np.degrees(pitch[kept]), rate[kept], np.degrees(rotation)])
    return Turns(*(np.concatenate(columns) for columns in zip(*found, strict=True)))


@pytest.mark.parametrize(("leg", "slope"), [("dive", -0.032), ("climb", 0.041)])
def test_it_turns_against_its_roll_diving_and_with_it_climbing(leg: str, slope: float) -> None:
    seen = turns()
    on = seen.pitch < -10.0 if leg == "dive" else seen.pitch > 10.0
    fitted = np.polyfit(seen.roll[on], seen.rate[on], 1)[0]
    assert fitted == pytest.approx(slope, abs=1e-3)  # published with three decimals, from the same four dives


def test_roll_is_0_59_of_the_battery_rotation_and_opposes_the_models() -> None:
    seen = turns()
    steep = np.abs(seen.pitch) > 15.0
    slope = np.polyfit(seen.rotation[steep], seen.roll[steep], 1)[0]
    # two printed decimals; some rows are taken while the battery still turns, which moves the slope by another 0.01
    assert slope == pytest.approx(-0.59, abs=0.015)


@pytest.mark.parametrize("path", [*ENGS, *NCS], ids=lambda path: path.name)
def test_the_battery_is_forward_diving_and_oil_is_out_climbing(path: Path) -> None:
    log = log_of(path)
    deep = log["depth"].values > 20.0
    times, pitch = log["depth"].time_ns[deep], log["pitch"].values[deep]
    for leg, sign in ((pitch < np.radians(-10.0), 1.0), (pitch > np.radians(10.0), -1.0)):
        forward, oil = (
            np.interp(times[leg], log[n].time_ns, log[n].values) for n in ("mass_position", "ballast_volume")
        )
        assert sign * np.median(forward) > 0.0
        assert sign * np.median(oil) < 0.0


@pytest.mark.parametrize("path", NCS, ids=lambda path: path.name)
def test_heading_is_the_true_one_of_the_basestation(path: Path) -> None:
    log = log_of(path)
    with netCDF4.Dataset(path) as file:
        true = np.pi / 2.0 - file["polar_heading"][:].filled(np.nan)  # counterclockwise from east
        times = np.round(file["ctd_time"][:].filled(np.nan) * 1e6).astype(np.int64) * 1000
    heading = np.interp(times, log["heading"].time_ns, np.unwrap(log["heading"].values))
    off = np.degrees(np.angle(np.exp(1j * (true - heading))))
    # where a CTD has its own times the basestation interpolates too, some other way round in a fast turn; the magnetic
    # variation would be off by 1.1 to 31 deg if it were left out or had the wrong sign
    assert np.percentile(np.abs(off), 98) < 1e-4
    assert np.median(np.abs(off)) < 1e-6


@pytest.mark.parametrize("path", NCS, ids=lambda path: path.name)
def test_water_agrees_with_teos_10(path: Path) -> None:
    log = log_of(path)
    with netCDF4.Dataset(path) as file:
        latitude, longitude = (float(file[f"avg_{name}"][:]) for name in ("latitude", "longitude"))
        raw = [file[name][:].filled(np.nan) for name in ("conductivity_raw", "temperature_raw", "ctd_pressure")]
        told = file["salinity_raw"][:].filled(np.nan)
        times = np.round(file["ctd_time"][:].filled(np.nan) * 1e6).astype(np.int64) * 1000
    pressure = log["pressure"].values / 1e4
    # the same formula; depth and pressure are printed with all digits
    np.testing.assert_allclose(log["depth"].values, -gsw.z_from_p(pressure, latitude), atol=1e-9)
    np.testing.assert_allclose(gsw.SP_from_C(raw[0] * 10.0, raw[1], raw[2]), told, atol=1e-9)  # so S/m
    at = {name: raw[2][np.searchsorted(times, log[name].time_ns)] for name in ("salinity", "absolute_salinity")}
    absolute = gsw.SA_from_SP(log["salinity"].values, at["salinity"], longitude, latitude)
    # 1e-5 g/kg: the basestation takes the place of each sample, the test that of the dive
    np.testing.assert_allclose(log["absolute_salinity"].values, absolute, atol=1e-5)
    density = gsw.rho(log["absolute_salinity"].values, log["conservative_temperature"].values, at["absolute_salinity"])
    # 75-term polynomial against the Gibbs function: 0.003 kg/m3 at most in the ocean
    picked = log["density"].values[np.searchsorted(log["density"].time_ns, log["absolute_salinity"].time_ns)]
    np.testing.assert_allclose(picked, density, atol=3e-3)


COUNT = {"mass_position": 0.003125763e-2, "ballast_volume": 0.245296e-6, "mass_rotation": np.radians(0.02827)}
"""One A/D count of sg561, by the settings of its .log."""
LATE = np.arange(-20, 21) * 10**8
"""ns; a motor runs up to 2 s away from its recorded time (actuators.py)."""


@pytest.mark.parametrize("path", ENGS, ids=lambda path: path.name)
def test_rows_follow_the_motors_of_the_log(path: Path) -> None:
    rows, motors = log_of(path), log_of(path.with_suffix(".log"))
    for name, count in COUNT.items():
        moved, times = motors[name], rows[name].time_ns
        known = (times > moved.time_ns[0]) & (times < moved.time_ns[-1])
        lines = np.array([np.interp(times[known] + late, moved.time_ns, moved.values) for late in LATE])
        off = np.min(np.abs(lines - rows[name].values[known]), axis=0) / count
        # Masses creep by some counts between events, the valve lets oil through by 15. One row of dive 3 is apart: 4 s
        # before the dive ends the battery still stands to one side, which the line cannot know: it turns back unrecorded.
        assert np.median(off) <= 3.0
        assert np.sort(off)[-2] <= 15.0


def test_motors_start_and_stop_as_recorded() -> None:
    log = log_of(SG561 / "p5610003.log")
    start = np.datetime64("2016-05-04T18:14:19", "ns").astype(np.int64)
    events = [(event.name, round((event.time_ns - start) * 1e-9, 2)) for event in log.events]
    # $GC,794,...: pitch 0.88 s, VBD 80.32 s, roll 2.20 s, one after the other
    expected = [
        ("pitch motor starts", 794.0), ("pitch motor stops", 794.88), ("VBD pump starts", 794.88),
        ("VBD pump stops", 875.2), ("roll motor starts", 875.2), ("roll motor stops", 877.4),
    ]  # fmt: skip
    assert [event for event in events if 793.5 < event[1] < 900.0] == expected
    assert ("VBD valve starts", 14.0) in events  # vbd_secs -71.45
    assert ("VBD valve stops", 85.45) in events
    assert ("VBD pump starts", 1654.0) in events  # $SM_CCo,1654,26.48,...,200.16
    assert log["ballast_volume"].time_ns[-1] == start + round(1518e9)  # which leaves no sample: the last event's
    at = np.searchsorted(log["mass_rotation"].time_ns, start + round(877.4e9))
    assert log["mass_rotation"].values[at] == pytest.approx(-np.radians((3117 - 2050) * 0.028270001))
    at = np.searchsorted(log["mass_position"].time_ns, start + round(794.88e9))
    assert log["mass_position"].values[at] == pytest.approx(-(2878 - 2700) * 0.003125763e-2)


def test_roll_moves_after_pitch_and_pump_in_newer_software_too() -> None:
    log = log_of(OTHERS / "p2490010.nc")
    start = np.datetime64("2024-04-12T18:11:52", "ns").astype(np.int64)
    times = (log["roll"].time_ns - start) * 1e-9
    jump = np.flatnonzero((times > 6250.0) & (np.abs(np.degrees(log["roll"].values)) > 10.0))[0]
    starts, stops = (
        next(
            (e.time_ns - start) * 1e-9
            for e in log.events
            if e.name == f"roll motor {word}" and e.time_ns > start + 6250e9
        )
        for word in ("starts", "stops")
    )
    assert times[jump - 1] - 1.0 < starts < times[jump]  # recorded times are good to about a second
    assert stops < times[jump] + 2.0


def test_centres_of_roll_differ_on_dive_and_climb() -> None:
    log = log_of(OTHERS / "p1710100.nc")
    with netCDF4.Dataset(OTHERS / "p1710100.nc") as file:
        counts, seconds = file["gc_roll_ad"][:].filled(np.nan), file["gc_roll_secs"][:].filled(np.nan)
        begin = file["gc_st_secs"][:].filled(np.nan)
        ran = seconds > 0.0
        centre = np.where(begin < 1716801265.0 + 2426.0, 2650.0, 2450.0)  # "end dive" at 2426 s
        expected = -np.radians((counts - centre)[ran] * 0.028270001)
    stops = [e.time_ns for e in log.events if e.name == "roll motor stops"]
    rotation = log["mass_rotation"]
    np.testing.assert_allclose(rotation.values[np.searchsorted(rotation.time_ns, stops)], expected, atol=1e-9)


@pytest.mark.parametrize("path", NCS, ids=lambda path: path.stem)
def test_drift_and_current_are_near_those_of_the_basestation(path: Path) -> None:
    """Both reckon with the speed of the basestation's flight model; for sg171 we take that of its ADCP."""
    (closure,) = json.loads(read([path]).log.metadata["closures"])
    with netCDF4.Dataset(path) as file:
        told = {name: float(file[name][...]) for name in file.variables if name.startswith(("surface_", "depth_avg_"))
                and file[name].dtype.kind == "f" and file[name].ndim == 0}  # fmt: skip
    for way in ("east", "north"):
        drift = closure["drift_before_m_s"][way]  # the basestation's: the same fixes, cm/s, on a sphere
        assert drift == pytest.approx(told[f"surface_curr_{way}"] / 100.0, abs=0.005)
        # sg561's dive is short: 3 of its 26 min are turns and surfacing, where speed is not told; its own error is 0.11
        near = {"p5610003": 0.04, "p2490010": 0.01, "p1710100": 0.10}[path.stem]
        assert closure[f"current_{way}_m_s"] == pytest.approx(told[f"depth_avg_curr_{way}"], abs=near)
