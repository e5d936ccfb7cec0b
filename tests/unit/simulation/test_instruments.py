"""What instruments read of a flight: against the flight itself, geometry, gsw and scipy."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Any

import gsw
import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import TypeAdapter
from scipy.spatial.transform import Rotation

from glidercli import simulate
from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.ocean import seawater
from glidercli.simulation import Simulation, flight
from glidercli.simulation.instruments.models import model_file, models
from glidercli.simulation.instruments.settings import Compass, Ctd, Gps, Instrument, Instruments, Pressure
from glidercli.simulation.mission import Mission

CLASSES: dict[str, type[Instrument]] = {"compass": Compass, "pressure": Pressure, "ctd": Ctd, "gps": Gps}
LEGS = [
    {"kind": "dive", "pitch_deg": -26.0, "mass_rotation_deg": 40.0, "net_buoyancy_kg": 0.3, "until_depth_m": 60.0},
    {"kind": "climb", "pitch_deg": 26.0, "heading_deg": 350.0, "net_buoyancy_kg": -0.3, "until_depth_m": 0.0},
    {"kind": "drift", "duration_s": 120.0},
]


def fly(folder: Path, aboard: dict[str, Any] | None, seed: int = 0, cast: bool = True, **options: Any) -> Simulation:
    given = {"name": "m", "description": "m", "latitude": 20.0, "longitude": 118.0, "leg": LEGS}
    if cast:
        given["ctd"] = "cast.csv"
        depth = np.arange(0.0, 81.0)
        temperature = 25.0 - 10.0 / (1.0 + np.exp(-(depth - 30.0) / 2.0))
        rows = [f"{z:g},{t:.6f},35\n" for z, t in zip(depth, temperature, strict=True)]
        (folder / "cast.csv").write_text("depth_m,temperature_degC,salinity\n" + "".join(rows))
    mission = TypeAdapter(Mission).validate_python(given | options.pop("mission", {}))
    instruments = None if aboard is None else TypeAdapter(Instruments).validate_python(aboard)
    return simulate((mission, folder / "m.toml"), instruments=instruments, seed=seed, **options)


def pairs(truth: Log, log: Log, name: str, of: str = "") -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Readings, and the truth at the same times."""
    read, true = log[name], truth[of or name]
    assert np.isin(read.time_ns, true.time_ns).all()
    return read.values, true.values[np.searchsorted(true.time_ns, read.time_ns)]


@pytest.fixture(scope="module")
def truth(tmp_path_factory: pytest.TempPathFactory) -> Log:
    return fly(tmp_path_factory.mktemp("truth"), None).log


def test_without_errors_the_truth_is_sampled(tmp_path: Path, truth: Log) -> None:
    aboard = {"compass": {}, "pressure": {"period_s": 3.0, "offset_s": 2.0}, "ctd": {"period_s": 2.0}, "gps": {}}
    log = fly(tmp_path, aboard).log
    start = truth.start_ns
    for name in ("heading", "pitch", "roll", "pressure", "temperature"):
        read, true = pairs(truth, log, name)
        assert read.tobytes() == true.tobytes(), name
    for name in ("mass_position", "mass_rotation", "net_buoyancy", "phase"):  # ends of legs lie between the seconds
        np.testing.assert_array_equal(log[name].time_ns, truth[name].time_ns)
        np.testing.assert_array_equal(log[name].values, truth[name].values)
    assert ((log["pressure"].time_ns - start) % (3 * 10**9) == 2 * 10**9).all()
    assert ((log["temperature"].time_ns - start) % (2 * 10**9) == 0).all()
    last = truth["depth"].time_ns[-1] - start
    assert len(log["heading"]) == last // 10**9 + 1
    assert len(log["pressure"]) == (last - 2 * 10**9) // (3 * 10**9) + 1
    read, true = pairs(truth, log, "density")
    np.testing.assert_allclose(read, true, rtol=0, atol=1e-5)  # kg/m3; C and back through PSS-78: 1e-9 of SP
    read, true = pairs(truth, log, "depth")
    np.testing.assert_allclose(read, true, rtol=0, atol=1e-3)  # m; pressure is cubic between the metres of the cast
    assert log.origin == "simulated"
    assert {channel.origin for channel in log.channels.values()} == {"simulated"}
    hidden = {"north", "east", "down", "u", "v", "w", "p", "q", "r", "speed_through_water", "vertical_speed"}
    assert not hidden & set(log.channels)
    assert log.events == truth.events


def test_salinity_is_that_of_the_cast(tmp_path: Path) -> None:
    """A cast by the metre: what its interpolation leaves of 35 is small."""
    log = fly(tmp_path, {"ctd": {}}).log
    away = np.abs(log["salinity"].values - 35.0)
    assert away.max() < 0.01  # density and temperature, each cubic, do not fit to 0.002 kg/m3 in a bend of 0.6 K/m
    assert np.median(away) < 1e-4
    t, p, C = (log[name].values for name in ("temperature", "pressure", "conductivity"))
    again = gsw.C_from_SP(log["salinity"].values, t, p / 1e4) / 10.0
    np.testing.assert_allclose(again, C, rtol=0, atol=1e-9)  # the inverse of PSS-78 iterates to 1e-10 in SP


def test_salinity_of_density_inverts_the_equation_of_state() -> None:
    SA, t, p = np.meshgrid([0.0, 0.5, 20.0, 35.0, 41.0], [-1.5, 4.0, 15.0, 32.0], [0.0, 100.0, 6000.0])
    rho = gsw.rho(SA, gsw.CT_from_t(SA, t, p), p)
    np.testing.assert_allclose(seawater.salinity_of_density(rho, t, p), SA, rtol=0, atol=1e-8)  # seven rounds
    assert np.isnan(seawater.salinity_of_density(980.0, 20.0, 0.0))
    fresh = gsw.rho(0.0, gsw.CT_from_t(0.0, 20.0, 0.0), 0.0)
    assert seawater.salinity_of_density(fresh - 0.05, 20.0, 0.0) == 0.0
    assert np.isnan(seawater.salinity_of_density(fresh - 0.2, 20.0, 0.0))
    for place in ((None, 0.0), (118.0, 20.0), (20.0, 58.0)):  # nowhere, South China Sea, Baltic
        SP = seawater.practical_of_absolute(SA[SA > 1.0], p[SA > 1.0], *place)
        back = seawater.absolute_salinity(SP, p[SA > 1.0], *place)
        np.testing.assert_allclose(back, SA[SA > 1.0], rtol=0, atol=1e-9)


def test_noise_and_bias_are_those_of_the_settings(tmp_path: Path, truth: Log) -> None:
    aboard = {
        "compass": {"noise_heading_deg": 0.5, "noise_tilt_deg": 0.2, "bias_heading_deg": 2.0, "bias_roll_deg": -1.0},
        "pressure": {"noise_dbar": 0.05, "bias_dbar": 0.4},
        "ctd": {"temperature_noise_degC": 0.01, "conductivity_noise_S_m": 0.002, "temperature_bias_degC": 0.03},
        "gps": {"noise_m": 6.0, "bias_north_m": 10.0},
    }
    log = fly(tmp_path, aboard).log
    degree = math.pi / 180.0
    metre = 1.0 / 110_700.0  # deg of latitude at 20 deg, within 0.1 %
    for name, bias, sigma, unit in (
        ("heading", 2.0, 0.5, degree), ("pitch", 0.0, 0.2, degree), ("roll", -1.0, 0.2, degree),
        ("pressure", 0.4, 0.05, 1e4), ("temperature", 0.03, 0.01, 1.0), ("latitude", 10.0, 6.0, metre),
    ):  # fmt: skip
        read, true = pairs(truth, log, name)
        error = read - true
        if name == "heading":
            error = (error + math.pi) % (2.0 * math.pi) - math.pi
        error, n = error / unit, len(read)
        assert n > 100
        assert abs(error.mean() - bias) < 5.0 * sigma / math.sqrt(n) + 0.001 * abs(bias), name  # five standard errors
        assert abs(error.std() - sigma) < 5.0 * sigma / math.sqrt(2.0 * n), name
    assert log["heading"].values.min() >= 0.0
    assert log["heading"].values.max() < 2.0 * math.pi


def test_the_seed_makes_the_noise(tmp_path: Path) -> None:
    aboard = {"compass": {"noise_heading_deg": 0.5, "bias_heading_sigma_deg": 1.0}, "pressure": {"noise_dbar": 0.1}}
    one, same, other = (fly(tmp_path, aboard, seed=seed) for seed in (7, 7, 8))
    alone = fly(tmp_path, {"compass": aboard["compass"]}, seed=7)
    for name in ("heading", "pressure"):
        assert one.log[name].values.tobytes() == same.log[name].values.tobytes()
        assert one.log[name].values.tobytes() != other.log[name].values.tobytes()
    assert one.log["heading"].values.tobytes() == alone.log["heading"].values.tobytes()
    assert one.log.metadata["seed"] == "7"
    drawn = one.document()["instruments"]["compass"]["drawn_bias"]["heading"]
    assert f"drawn bias of heading = {drawn:.6g}" in one.log.metadata["instruments"]
    assert one.document()["instruments"]["pressure"]["samples"]["pressure"] == len(one.log["pressure"])
    assert one.document()["seed"] == 7
    assert fly(tmp_path, None).document()["instruments"] is None


def test_the_flight_is_the_same_with_and_without(tmp_path: Path) -> None:
    bare, seen = fly(tmp_path, None).document(), fly(tmp_path, {"compass": {"period_s": 0.3}}).document()
    for key in ("final", "events", "duration_s", "max_depth_m", "distance_m", "energy_j"):
        assert repr(bare[key]) == repr(seen[key])  # also where an angle is nan


@pytest.mark.parametrize("length", [7, 100, 601])
def test_pieces_make_no_difference(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, length: int) -> None:
    aboard = {
        "compass": {"model": "tcm3", "period_s": 0.5, "mount_roll_deg": 3.0},
        "pressure": {"model": "strain-gauge", "lag_s": 2.0, "position_m": [0.5, 0.0, 0.1]},
        "ctd": {"model": "slocum-gpctd", "offset_s": 0.25, "position_m": [0.0, 0.0, -0.3]},
        "gps": {"model": "gps15"},
    }
    pieces: list[Log] = []
    monkeypatch.setattr(flight, "_PIECE", length)
    monkeypatch.setattr(flight, "STRETCH", 30.0)
    small = fly(tmp_path, aboard, piece=pieces.append)
    assert len(pieces) > 5
    monkeypatch.undo()
    monkeypatch.setattr(flight, "STRETCH", 30.0)  # steps end there: another flight by rounding
    whole = fly(tmp_path, aboard).log
    for name, channel in whole.channels.items():
        assert np.concatenate([piece[name].time_ns for piece in pieces]).tobytes() == channel.time_ns.tobytes(), name
        assert np.concatenate([piece[name].values for piece in pieces]).tobytes() == channel.values.tobytes(), name
    assert small.log.events == whole.events


def test_a_turned_compass_reads_the_turned_axes(tmp_path: Path, truth: Log) -> None:
    mount = {"mount_roll_deg": 20.0, "mount_pitch_deg": -35.0, "mount_heading_deg": 110.0}
    log = fly(tmp_path, {"compass": mount}).log
    read, true = (
        Rotation.from_euler("ZYX", np.column_stack(angles))
        for angles in zip(*(pairs(truth, log, name) for name in ("heading", "pitch", "roll")), strict=True)
    )
    turned = Rotation.from_euler("ZYX", [110.0, -35.0, 20.0], degrees=True)
    assert np.ptp(log["heading"].values) > 1.0  # it turns
    assert (read * turned.inv() * true.inv()).magnitude().max() < 1e-9  # rounding, near no pole here


def test_iron_deflects_the_heading(tmp_path: Path, truth: Log) -> None:
    log = fly(tmp_path, {"compass": {"deviation_sin_deg": 3.0, "deviation_cos_deg": -2.0, "bias_heading_deg": 1.0}}).log
    read, true = pairs(truth, log, "heading")
    error = np.degrees((read - true + math.pi) % (2.0 * math.pi) - math.pi)
    np.testing.assert_allclose(error, 1.0 + 3.0 * np.sin(true) - 2.0 * np.cos(true), rtol=0, atol=1e-9)


def test_a_slow_compass_passes_north_the_short_way(tmp_path: Path) -> None:
    west = {"heading_deg": 320.0}
    truth = fly(tmp_path, None, mission=west).log
    read, true = pairs(truth, fly(tmp_path, {"compass": {"lag_s": 4.0}}, mission=west).log, "heading")
    assert true.min() < 0.2
    assert true.max() > 6.2  # the flight passes north
    error = (read - true + math.pi) % (2.0 * math.pi) - math.pi
    rate = np.abs(truth["r"].values).max() / math.cos(math.radians(60.0))
    assert np.abs(error).max() < 4.0 * rate  # lag times rate; the long way round would be rad


def test_a_rounded_heading_is_less_than_a_full_circle(tmp_path: Path) -> None:
    north = {"leg": [{**LEGS[0], "mass_rotation_deg": 0.0}]}
    compass = {"noise_heading_deg": 0.2, "resolution_heading_deg": 0.1, "period_s": 0.1}
    read = np.degrees(fly(tmp_path, {"compass": compass}, mission=north).log["heading"].values)
    assert (read == 0.0).sum() > 100  # north, where 360.0 and 0.0 are the same
    assert read[read > 180.0].max() == pytest.approx(359.9, abs=1e-9)  # the greatest that a TCM3 prints


def test_the_port_of_a_pitched_vehicle_is_elsewhere(tmp_path: Path, truth: Log) -> None:
    arm = (0.8, -0.1, 0.3)
    log = fly(tmp_path, {"pressure": {"position_m": list(arm)}}).log
    depth, down = pairs(truth, log, "depth")
    rows = np.searchsorted(truth["depth"].time_ns, log["depth"].time_ns)
    angles = np.column_stack([truth[name].values[rows] for name in ("heading", "pitch", "roll")])
    expected = np.maximum(down + Rotation.from_euler("ZYX", angles).apply(arm)[:, 2], 0.0)
    np.testing.assert_allclose(depth, expected, rtol=0, atol=1e-3)  # as without an arm
    assert np.ptp(expected - down) > 0.5


def test_uniform_water_presses_by_its_weight(tmp_path: Path) -> None:
    bare = fly(tmp_path, None, cast=False).log
    log = fly(tmp_path, {"pressure": {}}, cast=False).log
    depth, true = pairs(bare, log, "depth")
    np.testing.assert_allclose(depth, true, rtol=1e-14, atol=0)
    weight = 1025.0 * seawater.gravity(20.0)  # the Seawing's neutral density
    np.testing.assert_allclose(log["pressure"].values, weight * true, rtol=1e-12)


def test_temperature_steps_through_a_thermocline(tmp_path: Path) -> None:
    """10 K within a centimetre: what follows is 1 - exp(-t / tau)."""
    water = "depth_m,temperature_degC,salinity\n0,25,35\n30,25,35\n30.01,15,35\n80,15,35\n"
    tau = 8.0
    (tmp_path / "step.csv").write_text(water)
    bare, log = (
        fly(tmp_path, aboard, ctd=tmp_path / "step.csv", every=0.1).log
        for aboard in (None, {"ctd": {"period_s": 0.1, "temperature_lag_s": tau}})
    )
    read, true = pairs(bare, log, "temperature")
    crossing = int(np.argmax(true < 20.0))
    after = slice(crossing, crossing + 400)
    since = 0.1 * np.arange(400) + 0.05  # it is crossed within a tenth of a second
    left = (read[after] - 15.0) / 10.0
    np.testing.assert_allclose(left, np.exp(-since / tau), rtol=0, atol=0.05 / tau)  # half a sample at most


def test_a_late_thermometer_makes_spikes_of_salinity(tmp_path: Path) -> None:
    """Going down into cold water a late temperature is too warm: salinity too low; going up the reverse."""
    log = fly(tmp_path, {"ctd": {"temperature_lag_s": 3.0}}).log
    phase = log["phase"].values[np.searchsorted(log["phase"].time_ns, log["salinity"].time_ns)]
    steep = np.abs(log["depth"].values - 30.0) < 4.0
    down, up = (log["salinity"].values[steep & (phase == code)] - 35.0 for code in (1, 2))
    assert down.min() < -0.2
    assert down.max() < 0.02
    assert up.max() > 0.2
    assert up.min() > -0.02
    # dS/dT at constant C is some -0.95 / K here; the lag is 3 s x 0.2 m/s x 1.25 K/m = 0.75 K at most
    assert down.min() > -1.2


def test_the_wall_of_the_cell_gives_back_heat(tmp_path: Path) -> None:
    """Going down the cell is too warm, conductivity and salinity too high; the size follows Lueck (1990)."""
    share, time = 0.05, 10.0
    clean, log = (fly(tmp_path, {"ctd": {"cell_share": a, "cell_time_s": time}}).log for a in (0.0, share))
    t = (clean["temperature"].time_ns - clean.start_ns) / 1e9
    T, p = clean["temperature"].values, clean["pressure"].values / 1e4
    stored = np.zeros(len(T))  # share x (T - slow T), by the recursion of Lueck and Picklo (1990), bilinear
    for i in range(1, len(T)):
        h = t[i] - t[i - 1]
        stored[i] = ((2.0 * time - h) * stored[i - 1] + 2.0 * time * share * (T[i] - T[i - 1])) / (2.0 * time + h)
    C = gsw.C_from_SP(clean["salinity"].values, T - stored, p) / 10.0
    assert np.abs(stored).max() > 0.05
    np.testing.assert_allclose(
        log["conductivity"].values, C, rtol=0, atol=2e-5
    )  # h^2 / 12 tau^2 of 0.05 K, x 0.1 S/m/K


def test_the_gps_sees_the_sky_only(tmp_path: Path, truth: Log) -> None:
    log = fly(tmp_path, {"gps": {"first_fix_s": 30.0, "position_m": [0.0, 0.0, -0.2]}}).log
    start = truth.start_ns
    surfaced = next(event.time_ns for event in log.events if event.name == "surfacing")
    fixes = log["latitude"].time_ns
    assert len(fixes) > 50
    assert fixes[0] - surfaced >= 29 * 10**9  # the antenna may be up a second before the origin
    assert fixes[0] - surfaced <= 31 * 10**9
    assert (np.diff(fixes) == 10**9).all()
    at_start = fly(tmp_path, {"gps": {"position_m": [0.0, 0.0, -0.2]}}).log["latitude"].time_ns
    assert at_start[0] == start  # the flight begins at the surface
    depth = truth["depth"].values[np.searchsorted(truth["depth"].time_ns, at_start)]
    assert depth.max() <= 0.2 + 1e-9
    deep = np.setdiff1d(truth["depth"].time_ns[truth["depth"].values > 0.2], at_start)
    assert len(deep) == (truth["depth"].values > 0.2).sum()
    whole = fly(tmp_path, {"gps": {"resolution_deg": 1e-4}}).log
    assert np.abs(np.round(whole["latitude"].values / 1e-4) * 1e-4 - whole["latitude"].values).max() < 1e-12


def test_an_intake_out_of_the_water_reads_nothing(tmp_path: Path) -> None:
    log = fly(tmp_path, {"ctd": {"position_m": [0.0, 0.0, -0.5]}, "pressure": {}}).log
    depth = log["depth"].values[np.searchsorted(log["depth"].time_ns, log["temperature"].time_ns)]
    assert depth.min() > 0.2
    assert len(log["temperature"]) < len(log["pressure"])


def test_every_model_is_good_and_says_where_its_figures_are_from() -> None:
    found = {kind: models(kind) for kind in CLASSES}
    assert {name for names in found.values() for name in names} >= {"tcm3", "slocum-gpctd", "strain-gauge", "gps15"}
    for kind, cls in CLASSES.items():
        keys = {field.name for field in dataclasses.fields(cls)}
        for name in found[kind]:
            told = model_file(kind, name)
            assert told.pop("description")
            assert set(told) <= keys
            for key, entry in told.items():
                assert set(entry) == {"value", "source"}, (name, key)
                assert len(entry["source"]) >= len("page")
            made = getattr(TypeAdapter(Instruments).validate_python({kind: {"model": name, "period_s": 9.0}}), kind)
            assert made.period_s == 9.0
            assert made.model == name


@pytest.mark.parametrize(
    ("aboard", "words"),
    [
        ({"ctd": {}}, ("instruments.ctd", "no temperature")),
        ({"compass": {"period_s": 1.003}}, ("greatest common divisor", "1 ms")),
    ],
)
def test_what_the_flight_cannot_offer_is_named(tmp_path: Path, aboard: dict[str, Any], words: tuple[str, ...]) -> None:
    with pytest.raises(InputError) as error:
        fly(tmp_path, aboard, cast=False)
    assert all(word in str(error.value) for word in words)


@pytest.mark.parametrize("seed", [-1, 2**63, True, 1.5])
def test_seeds_are_whole_numbers(tmp_path: Path, seed: Any) -> None:
    with pytest.raises(InputError, match="seed"):
        fly(tmp_path, {"compass": {}}, seed=seed)


def test_a_gps_needs_a_place(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="latitude and longitude"):
        fly(tmp_path, {"gps": {}}, mission={"longitude": None})


def test_water_of_no_salinity_is_named(tmp_path: Path) -> None:
    (tmp_path / "light.csv").write_text("depth_m,temperature_degC,density_kg_m3\n0,20,990\n80,20,990.4\n")
    with pytest.raises(InputError, match="which no salinity gives"):
        fly(tmp_path, {"ctd": {}}, ctd=tmp_path / "light.csv", mission={"neutral_density_kg_m3": 990.0})


def test_long_periods_are_looked_at_every_second(tmp_path: Path, truth: Log) -> None:
    """A lag of 2 s needs more than a sample in 30 s, or its input would not be what it passed through."""
    slow = {"compass": {"period_s": 30.0, "lag_s": 2.0}}
    fine = {"compass": {"period_s": 1.0, "lag_s": 2.0}}
    one, other = (fly(tmp_path, aboard, every=every).log["pitch"] for aboard, every in ((slow, 30.0), (fine, 1.0)))
    rows = np.searchsorted(other.time_ns, one.time_ns)
    np.testing.assert_array_equal(one.values, other.values[rows])


BAD = [
    ("", ("is empty",)),
    ("[instruments]\n", ("instruments is empty", ".gps")),
    ("instruments = 3\n", ("instruments = 3", "table")),
    ("[instruments.sonar]\n", ("instruments.sonar is unknown", "compass, pressure, ctd, gps")),
    ('[instruments.compass]\nmodel = "tcm9"\nlag_s = -1\n', ("2 faults", "tcm9", "shipped: tcm3", "lag_s = -1")),
    ("[instruments.compass]\nmodel = 3\n", ("compass.model = 3",)),
    ("[instruments.compass]\ncolour = 1\n", ("compass.colour is unknown", "noise_tilt_deg")),
    ("[instruments.compass]\nperiod_s = 0\n", ("compass.period_s = 0",)),
    ("[instruments.compass]\nperiod_s = 0.0105\n", ("whole milliseconds",)),
    ("[instruments.compass]\nperiod_s = 1.001\n", ("greatest common divisor", "10 ms")),
    ("[instruments.compass]\noffset_s = -1\n", ("offset_s = -1",)),
    ("[instruments.compass]\nnoise_heading_deg = nan\n", ("noise_heading_deg = nan",)),
    ("[instruments.compass]\nnoise_tilt_deg = true\n", ("noise_tilt_deg = True",)),
    ("[instruments.compass]\nmount_pitch_deg = 91\n", ("mount_pitch_deg = 91",)),
    ('[instruments.pressure]\nnoise_dbar = "0.1"\n', ("noise_dbar = '0.1'",)),
    ("[instruments.pressure]\nresolution_dbar = -0.1\n", ("resolution_dbar = -0.1",)),
    ("[instruments.pressure]\nposition_m = [0, 1]\n", ("position_m = [0, 1]", "three numbers")),
    ("[instruments.pressure]\nposition_m = [0, 1, inf]\n", ("position_m.2 = inf",)),
    ("[instruments.ctd]\ncell_share = 1.5\n", ("cell_share = 1.5",)),
    ("[instruments.ctd]\nconductivity_noise_S_m = -1\n", ("conductivity_noise_S_m = -1",)),
    ("[instruments.ctd]\ntemperature_lag_s = 1e9\n", ("temperature_lag_s = 1000000000.0",)),
    ("[instruments.gps]\nfirst_fix_s = -1\n", ("first_fix_s = -1",)),
    ("[instruments.gps]\nnoise_m = 1e9\n", ("noise_m",)),
    ("seed = 1\n[instruments.gps]\n", ("seed is unknown",)),
    ("name = 3 = 4", ("TOML",)),
]


@pytest.mark.parametrize(("text", "words"), BAD)
def test_bad_settings_are_named(tmp_path: Path, text: str, words: tuple[str, ...]) -> None:
    (tmp_path / "bad.toml").write_text(text)
    with pytest.raises(InputError) as error:
        simulate("sawtooth-transect", instruments=tmp_path / "bad.toml")
    said = str(error.value)
    assert said.startswith(str(tmp_path / "bad.toml"))
    assert "\n" not in said
    assert all(word in said for word in words), said
