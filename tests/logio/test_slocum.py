"""Slocum files: every cycle kept or named, signs and units, samples and dumps, fixes, dives of two computers."""

from __future__ import annotations

import json
import math
import shutil
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT
from slocum_files import NAVIGATION, SAME, SCIENCE, START, Cycle, cast, dive, made, packed

from glidercli.log import Log
from glidercli.logio import read
from glidercli.logio.reader import Part
from glidercli.logio.report import FileReport
from glidercli.logio.slocum import read_slocum, sensors

SPIRAL = ROOT / "logs/slocum-comet-2019"
DATA = ROOT / "tests/data/slocum"
REAL = sorted([*SPIRAL.glob("*.[de]bd"), *DATA.glob("*.[dest]bd")])
CYCLES = {
    "comet-2016-174-05-000.dbd": 229, "comet-2016-174-05-000.ebd": 911, "comet-2019-218-00-032.sbd": 323,
    "comet-2019-218-00-032.tbd": 338, "comet-2019-218-00-033.sbd": 2, "comet-2019-218-00-033.tbd": 3,
    "comet-2019-218-00-034.dbd": 2361, "comet-2019-218-00-034.ebd": 9834, "modena-2015-174-8-0.dbd": 926,
    "modena-2015-174-8-0.ebd": 3300,
}  # fmt: skip
"""One more each than dbdreader 0.6.3 counts times in, which leaves out the first cycle."""
FIRST = "first cycle: the last values of all sensors, however old"


def lawful(part: Part) -> tuple[Log, FileReport]:
    report = part.report
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    assert len(part.record_ns) == report.kept
    assert (np.diff(part.record_ns) > 0).all()
    return part.log, report


@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_records_are_kept_or_dropped(path: Path) -> None:
    log, report = lawful(read_slocum(path))
    assert report.records == CYCLES[path.name]
    assert report.error is None
    assert dict(report.dropped)[FIRST] == 1
    assert log.metadata["platform"] == "Slocum " + path.name.split("-")[0]


def test_real_files_are_there() -> None:
    assert sorted(path.name for path in REAL) == sorted(CYCLES)


def write(folder: Path, cycles: list[Cycle], name: str = "unit-2019-220-0-1.dbd", **options: object) -> Path:
    table = SCIENCE if name[-3] in "ent" else NAVIGATION
    path = folder / name
    path.write_bytes(made(options.pop("table", table), cycles, extension=name[-3:], **options).data)  # type: ignore[arg-type]
    return path


def reading(tmp_path: Path, cycles: list[Cycle], **options: object) -> tuple[Log, FileReport]:
    return lawful(read_slocum(write(tmp_path, cycles, **options)))  # type: ignore[arg-type]


def test_the_spiral_turns_as_it_was_measured() -> None:
    log = read([SPIRAL]).log
    time = log["heading"].time_ns
    depth, pitch = (log[n].values[np.searchsorted(log[n].time_ns, time)] for n in ("depth", "pitch"))
    heading, seconds = np.unwrap(log["heading"].values), time * 1e-9
    inside = (depth > 8.0) & (depth < 30.0)
    legs = np.split(np.arange(len(time)), np.flatnonzero(np.diff(inside.astype(int))) + 1)
    legs = [leg for leg in legs if inside[leg[0]] and len(leg) > 7]
    rates = np.array([math.degrees(np.polyfit(seconds[leg] - seconds[leg[0]], heading[leg], 1)[0]) for leg in legs])
    down = np.array([depth[leg[-1]] > depth[leg[0]] for leg in legs])
    assert (down.sum(), (~down).sum()) == (21, 21)
    # measured before with another reader: mean and spread over the legs, to the digits given
    assert (rates[down].mean(), rates[down].std()) == pytest.approx((0.991, 0.10), abs=0.005)
    assert (rates[~down].mean(), rates[~down].std()) == pytest.approx((0.261, 0.09), abs=0.005)
    inclination = np.degrees(pitch)
    assert np.median(
        inclination[np.concatenate([leg for leg, d in zip(legs, down, strict=True) if d])]
    ) == pytest.approx(-25.6, abs=0.2)
    assert np.median(
        inclination[np.concatenate([leg for leg, d in zip(legs, down, strict=True) if not d])]
    ) == pytest.approx(26.9, abs=0.2)
    assert np.median(log["rudder_angle"].values) == pytest.approx(0.20, abs=0.01)  # spiral.mi asks for 0.20 rad


def test_the_battery_moves_forward_and_oil_in_on_dives() -> None:
    log = read([SPIRAL]).log
    speed = log["vertical_speed"]
    at = {
        name: log[name].values[np.searchsorted(log[name].time_ns, speed.time_ns)]
        for name in ("depth", "mass_position", "ballast_volume")
    }
    gliding = (np.abs(speed.values) > 0.08) & (at["depth"] > 5.0)  # at the surface the nose is held down to call
    for name, sign in (("mass_position", 1), ("ballast_volume", -1)):
        assert sign * np.corrcoef(at[name][gliding], speed.values[gliding])[0, 1] > 0.95
    assert log["mass_position"].values.max() < 0.05  # m: 1.24 inch


def test_pressure_and_depth_agree_on_the_spiral() -> None:
    log = read([SPIRAL]).log
    deep = log["pressure"].values > 1e5
    depth = np.interp(log["pressure"].time_ns[deep], log["depth"].time_ns, log["depth"].values)
    off = log["pressure"].values[deep] * 0.99e-4 - depth  # 1 dbar is 0.99 m
    assert abs(np.median(off)) < 0.3  # two gauges
    assert np.percentile(np.abs(off), 99) < 0.7  # 0.17 m/s for 4.5 s between samples of depth


def test_units_signs_and_samples(tmp_path: Path) -> None:
    log, report = reading(tmp_path, dive())
    assert (report.records, report.kept, report.dropped) == (12, 11, ((FIRST, 1),))
    assert log["depth"].values.tolist() == [0.5 * i for i in range(1, 12)]
    assert len(log["pitch"]) == 11  # updated with the same value is a sample
    assert log["pitch"].values[2] == log["pitch"].values[1] == pytest.approx(-0.42)
    assert log["pitch"].time_ns[2] - log["pitch"].time_ns[1] == 4 * 10**9
    assert log["latitude"].values.tolist() == [pytest.approx(54 + 40.5 / 60)]
    assert log["longitude"].values.tolist() == [pytest.approx(-(6 + 46.25 / 60))]
    assert log.metadata["mission"] == "TEST.MI"


def test_sensors_gives_any_sensor_in_the_files_own_units(tmp_path: Path) -> None:
    path = write(tmp_path, dive())
    time, latitude = sensors(path, ["m_gps_lat"])["m_gps_lat"]
    assert (time.tolist(), latitude.tolist()) == ([START + 8.0], [5440.5])
    assert list(sensors(path)) == [name for name, _, _ in NAVIGATION]


EVERY = (
    *NAVIGATION,
    ("m_counter", "nodim", 2),
    ("m_flag", "bool", 1),
    ("m_still", "nodim", 4),
    ("m_battroll", "rad", 4),
)


@pytest.mark.parametrize("order", [">", "<"])
def test_both_byte_orders_and_all_sizes(tmp_path: Path, order: str) -> None:
    cycles = [{**cycle, "m_counter": 1000 - 300 * i, "m_flag": -i} for i, cycle in enumerate(dive(6))]
    path = write(tmp_path, cycles, table=EVERY, order=order)
    found = sensors(path)
    assert found["m_counter"][1].tolist() == [1000 - 300 * i for i in range(1, 6)]
    assert found["m_flag"][1].tolist() == [-1, -2, -3, -4, -5]
    assert found["m_depth"][1].tolist() == [0.5, 1.0, 1.5, 2.0, 2.5]
    assert len(found["m_still"][0]) == 0


def test_the_vehicle_reckons_10_m_to_a_bar() -> None:
    told = sensors(SPIRAL / "comet-2019-218-00-034.dbd", ["m_depth", "m_pressure"])
    deep = told["m_depth"][1] > 5.0
    np.testing.assert_allclose(told["m_depth"][1][deep] / told["m_pressure"][1][deep], 10.0, rtol=1e-6)  # 4 bytes
    assert "10 m to a bar" in read([SPIRAL]).log.metadata["depth_note"]


def test_a_dump_of_all_sensors_is_no_sample_of_what_is_unchanged(tmp_path: Path) -> None:
    cycles = dive()
    again = {name: SAME for name, _, _ in EVERY} | {"m_present_time": START + 2.0, "m_depth": 3.0}
    cycles[0] |= {"m_counter": 1, "m_flag": 1, "m_still": 5.0, "m_battroll": 0.0}  # type: ignore[operator]
    log, report = reading(tmp_path, [cycles[0], again, *cycles[1:]], table=EVERY)
    assert log["depth"].values[0] == 3.0
    assert len(log["pitch"]) == 11
    assert "4 unchanged values left out where the file tells every sensor anew: no samples" not in report.warnings
    assert any("unchanged values left out where the file tells every sensor anew" in w for w in report.warnings)
    assert "mass_rotation" not in log
    assert len(sensors(tmp_path / "unit-2019-220-0-1.dbd")["m_still"][0]) == 1  # as the file has it


def test_a_battery_that_puts_the_starboard_wing_down_rotates_against_the_models(tmp_path: Path) -> None:
    # the makers, in spiral.mi: C_BATTROLL(rad) >0 puts stbd wing down; positive rotation of the model is to port
    cycles = [{**cycle, "m_battroll": 0.1 * i} for i, cycle in enumerate(dive())]
    log, _ = reading(tmp_path, cycles, table=EVERY)
    np.testing.assert_allclose(log["mass_rotation"].values, -0.1 * np.arange(1, 12), rtol=1e-6)  # of 4 bytes


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"m_present_time": math.nan}, "time cannot be read"),
        ({"m_present_time": 1e300}, "time cannot be read"),
        ({"m_present_time": 86400.0}, "clock not set: before 2001, when the format began"),
        ({"m_present_time": START - 40 * 86400.0}, "clock not set: more than 30 days before the file's other times"),
        ({"m_present_time": START + 40 * 86400.0}, "time more than 30 days after the file's other times"),
        ({"m_present_time": START + 20.0}, "time repeats"),
        ({"m_present_time": START + 13.0}, "time goes back"),
        ({"m_present_time": START + 3000.0}, "time runs ahead of those after it"),
        ({"m_depth": 0.0, "m_pitch": 0.0}, "all values zero"),
        ({"m_depth": None, "m_pitch": None}, "no value"),
        ({"m_depth": math.nan, "m_pitch": math.inf}, "no value"),
        ({"m_depth": 9000.0, "m_pitch": 2.0}, "no usable value"),
    ],
)
def test_each_trap_is_dropped_by_name(tmp_path: Path, changes: dict[str, float], reason: str) -> None:
    cycles = dive()
    cycles[6] = {**cycles[6], **changes}
    cycles[5] = {**cycles[5], "m_pitch": -0.45}
    _, report = reading(tmp_path, cycles)
    assert dict(report.dropped) == {FIRST: 1, reason: 1}


def test_impossible_values_and_no_numbers_are_counted(tmp_path: Path) -> None:
    cycles = dive()
    cycles[4] = {**cycles[4], "m_pitch": math.nan}
    cycles[5] = {**cycles[5], "m_pitch": 1.6}
    cycles[7] = {**cycles[7], "m_depth": -6.0}
    log, report = reading(tmp_path, cycles)
    assert (len(log["pitch"]), len(log["depth"])) == (8, 10)  # the sixth repeats the fifth
    assert "m_pitch: 1 cells left out that are no number" in report.warnings
    assert "m_pitch: 2 values outside -1.5708..1.5708 rad left out" in report.warnings
    assert "m_depth: 1 values outside -5..1500 m left out" in report.warnings


def test_only_new_fixes_of_a_receiver_that_says_so_count(tmp_path: Path) -> None:
    cycles = dive(9)
    place = {"m_gps_lat": 5440.5, "m_gps_lon": 646.25}
    cycles[3] |= {"m_gps_lat": SAME, "m_gps_lon": SAME}  # type: ignore[operator]
    cycles[4] |= {"m_gps_status": 2, "m_gps_lat": 5440.6, "m_gps_lon": 646.25}  # type: ignore[operator]
    cycles[5] |= {"m_gps_status": 0, "m_gps_lat": 69696969.0, "m_gps_lon": 69696969.0}  # type: ignore[operator]
    cycles[6] |= {"m_gps_lat": 5460.1, "m_gps_lon": 646.25}  # type: ignore[operator]
    cycles[7] |= {"m_gps_lat": 5440.9, "m_gps_lon": math.nan}  # type: ignore[operator]
    cycles[8] |= place | {"m_depth": 0.5}  # type: ignore[operator]
    log, report = reading(tmp_path, cycles)
    assert (log["latitude"].time_ns * 1e-9 - START).tolist() == pytest.approx([8.0, 32.0], abs=1e-3)
    assert "m_gps_lat, m_gps_lon: 5 values left out that are no new fix" in report.warnings


def test_positions_that_a_receiver_extrapolates_under_water_are_no_fixes() -> None:
    """comet 2016, first surfacing: it dives from 17:52:11 on, and the receiver goes on to the east at 5.7 m/s."""
    path = DATA / "comet-2016-174-05-000.dbd"
    log, report = lawful(read_slocum(path))
    found = sensors(path, ["m_gps_num_satellites", "m_gps_lat"])
    time, satellites = found["m_gps_num_satellites"]
    few = np.intersect1d(time[satellites < 4], found["m_gps_lat"][0])
    assert len(few) == 6
    fixes = log["latitude"].time_ns * 1e-9
    assert np.abs(fixes[:, None] - few).min() > 1.0
    assert any(
        w == "m_gps_lat, m_gps_lon: 7 values left out that are extrapolated: fewer than 4 satellites, or none known "
        "(m_gps_num_satellites)"  # six, and one between 10 and 3 satellites that tells no number
        for w in report.warnings
    )
    assert len(fixes) == 17  # of 24 new positions
    (closure,) = json.loads(read([path]).log.metadata["closures"])
    # the two dives after it have 0.05 to 0.08 m/s to the west; with the extrapolated positions it was 0.36
    assert -0.08 < closure["current_east_m_s"] < -0.05


def test_the_spiral_keeps_the_fixes_of_a_receiver_with_satellites() -> None:
    path = SPIRAL / "comet-2019-218-00-034.dbd"
    log, _ = lawful(read_slocum(path))
    found = sensors(path, ["m_gps_num_satellites", "m_gps_lat", "m_depth"])
    time, satellites = found["m_gps_num_satellites"]
    good = np.intersect1d(time[satellites >= 4], found["m_gps_lat"][0])
    fixes = log["latitude"].time_ns * 1e-9
    assert len(good) == len(fixes) == 23
    assert np.abs(fixes - good).max() < 1e-6  # rounding of the sensor's double


COASTING = (*NAVIGATION, ("m_gps_speed", "m/s", 4), ("m_gps_heading", "rad", 4))


@pytest.mark.parametrize("sign", ["depth", "velocity"])
def test_without_a_number_of_satellites_other_signs_count(tmp_path: Path, sign: str) -> None:
    cycles: list[Cycle] = []
    for i in range(9):
        under = i > 5
        moving = SAME if under and sign == "velocity" else 0.3 + 0.1 * i
        cycles.append(
            {
                "m_present_time": START + 4.0 * i, "m_depth": 0.2 + (0.9 * (i - 4) if under and sign == "depth" else 0.0),
                "m_pitch": -0.1, "m_gps_status": 0, "m_gps_lat": 5440.5 + 0.001 * i, "m_gps_lon": 646.25,
                "m_gps_speed": moving, "m_gps_heading": moving,
            }
        )  # fmt: skip
    log, report = reading(tmp_path, cycles, table=COASTING)
    assert (log["latitude"].time_ns * 1e-9 - START).tolist() == pytest.approx([4.0, 8.0, 12.0, 16.0, 20.0], abs=1e-3)
    assert any("3 values left out that are extrapolated: under way down" in w for w in report.warnings)


def test_a_depth_of_zero_at_the_surface_is_a_sample(tmp_path: Path) -> None:
    cycles = dive(6)
    cycles[2] = {"m_present_time": START + 8.0, "m_depth": 0.0}
    cycles[4] = {"m_present_time": START + 16.0, "m_depth": 0.0, "m_pitch": 0.0}
    log, report = reading(tmp_path, cycles)
    assert log["depth"].values.tolist() == [0.5, 0.0, 1.5, 2.5]
    assert ("all values zero", 1) in report.dropped


TURNING = (*NAVIGATION[:3], ("m_heading", "rad", 4), ("m_gps_mag_var", "rad", 4))


def test_the_variation_brings_the_heading_to_true_north(tmp_path: Path) -> None:
    cycles = [{**cycle, "m_heading": 6.25} for cycle in dive(5)]
    cycles[0]["m_gps_mag_var"] = -0.0681  # magnetic north lies 3.9 deg east of true north, as in the Baltic
    log, _ = reading(tmp_path, cycles, table=TURNING)
    np.testing.assert_allclose(log["heading"].values, 6.25 + 0.0681 - 2.0 * math.pi, atol=1e-6)  # 4-byte numbers
    assert "m_gps_mag_var (-3.9 deg" in log.metadata["heading_note"]
    log, report = reading(tmp_path, cycles, table=TURNING[:4])
    np.testing.assert_allclose(log["heading"].values, 6.25, atol=1e-6)
    assert log.metadata["heading_note"].startswith("from magnetic north")
    assert any("values stay from magnetic north" in warning for warning in report.warnings)


def test_the_gliders_own_dead_reckoning_runs_along_the_magnetic_heading() -> None:
    found = sensors(
        SPIRAL / "comet-2019-218-00-034.dbd", ["m_vx_lmc", "m_vy_lmc", "m_heading", "m_gps_mag_var", "x_utm_to_lmc_01"]
    )
    time = np.intersect1d(found["m_vx_lmc"][0], found["m_vy_lmc"][0])
    at = lambda name: found[name][1][np.searchsorted(found[name][0], time)]  # noqa: E731
    moving = np.hypot(at("m_vx_lmc"), at("m_vy_lmc")) > 0.05
    off = np.arctan2(at("m_vx_lmc"), at("m_vy_lmc")) - at("m_heading")
    # 4-byte numbers of a velocity, so 1e-6 rad; some cycles tell the heading of the cycle before
    assert np.median(np.abs(np.angle(np.exp(1j * off[moving])))) < 1e-6


def test_idle_ctd_and_air_in_the_cell(tmp_path: Path) -> None:
    cycles = cast()
    cycles[3] = {**cycles[3], "sci_water_temp": 0.0, "sci_water_cond": 0.0, "sci_water_pressure": 0.0}
    log, report = reading(tmp_path, cycles, name="unit-2019-220-0-1.ebd")
    assert dict(report.dropped) == {FIRST: 1, "all values zero": 1}
    assert (len(log["temperature"]), len(log["pressure"])) == (6, 6)
    assert log["pressure"].values[0] == pytest.approx(0.2e5)
    assert log["conductivity"].values[-1] == pytest.approx(4.47)


RELAYING = (*NAVIGATION[:3], *SCIENCE[1:])


def test_two_computers_of_one_dive_make_one_log(tmp_path: Path) -> None:
    relayed = [{**cycle, "sci_water_temp": 1.0, "sci_water_cond": 1.0, "sci_water_pressure": 0.2} for cycle in dive()]
    write(tmp_path, relayed, "a.dbd", table=RELAYING)
    write(tmp_path, cast(), "b.ebd")
    found = read([tmp_path])
    assert found.log["temperature"].values.max() < 18.0 < found.log["temperature"].values.max() + 0.2
    assert found.log["temperature"].values.min() > 17.0  # none of the relayed ones
    assert len(found.log["depth"]) == 11
    (tmp_path / "b.ebd").unlink()
    assert read([tmp_path]).log["temperature"].values.max() == 1.0


def test_the_fullest_file_of_a_recording_is_read(tmp_path: Path) -> None:
    for name in ("a.sbd", "a.mbd", "a.dbd"):
        write(tmp_path, dive(), name)
    reports = {report.path.name: report for report in read([tmp_path]).files}
    assert reports["a.dbd"].kept == 11
    assert reports["a.sbd"].dropped[-1] == reports["a.mbd"].dropped[-1] == ("its recording is in a.dbd", 11)


def test_compressed_files_hold_the_same(tmp_path: Path) -> None:
    source = SPIRAL / "comet-2019-218-00-034.ebd"
    packed_file = tmp_path / "a.ecd"
    packed_file.write_bytes(packed(source.read_bytes()))
    (tmp_path / "537A6A61.CCC").write_bytes(packed((SPIRAL / "537a6a61.cac").read_bytes()))
    whole, again = lawful(read_slocum(source)), lawful(read_slocum(packed_file))
    assert again[1].records == whole[1].records
    for name, channel in whole[0].channels.items():
        np.testing.assert_array_equal(again[0][name].values, channel.values)
        np.testing.assert_array_equal(again[0][name].time_ns, channel.time_ns)


def test_a_folder_with_companions_names_no_broken_file(tmp_path: Path) -> None:
    for path in SPIRAL.iterdir():
        shutil.copy(path, tmp_path / path.name.upper())
    found = read([tmp_path])
    assert sorted(report.path.name[-3:] for report in found.files) == ["DBD", "EBD"]
    assert all(report.error is None for report in found.files)


@pytest.mark.parametrize(
    ("name", "vehicle"),
    [
        ("unit-2019-220-0-1", "unit"),
        ("unit_887-2021-321-3-0", "unit_887"),
        ("dfo-rosie713-2019-220-0-1", "dfo-rosie713"),
    ],
)
def test_a_vehicle_with_a_hyphen_in_its_name(name: str, vehicle: str, tmp_path: Path) -> None:
    """Two vehicles of one owner were one, "dfo", and were joined."""
    path = tmp_path / "renamed.dbd"
    path.write_bytes(made(NAVIGATION, dive(), name=name).data)
    assert read([path]).log.metadata["platform"] == f"Slocum {vehicle}"
