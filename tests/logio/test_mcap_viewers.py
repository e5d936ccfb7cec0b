"""Does the MCAP file hold for others? The doctor passes it, and every message decodes by its own embedded schema."""

from __future__ import annotations

import itertools
import json
import math
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_files import Written, messages

from glidercli.channels import CHANNELS, PHASES
from glidercli.live.pacing import between
from glidercli.log import Channel, Event, Log
from glidercli.logio.mcap.contents import statement
from glidercli.logio.mcap.scene import Scene
from glidercli.logio.mcap.writer import write_mcap

PYMCAP = Path(sys.executable).with_name("pymcap-cli")
START = 1_313_000_000_123_456_789
N = 40
TIMES = START + np.arange(N) * 1_000_000_001


def channel(name: str, values: Any, times: Any = TIMES) -> Channel:
    return Channel(name, times, np.broadcast_to(np.asarray(values, float), np.shape(times)).copy(), "simulated")


def full_log() -> Log:
    """Straight to the north-east and down at 45 deg, nose down, in a current to the north."""
    along = np.arange(N) * 0.5
    known = {
        "depth": along, "north": along, "east": along, "down": along, "roll": 0.1, "pitch": -0.4, "heading": math.pi / 4,
        "current_east": 0.0, "current_north": 0.25, "current_up": 0.0, "latitude": 20.0, "longitude": 115.0, "phase": 1.0,
    }  # fmt: skip
    channels = {name: channel(name, known.get(name, np.linspace(-1.0, 1.0, N))) for name in CHANNELS}
    metadata = {
        "hull_length_m": "1.5",
        "hull_diameter_m": "0.2",
        "provenance": '{"seed": 3}',
        "origin_latitude_deg": "20",
        "origin_longitude_deg": "115",
    }
    return Log(channels, "simulated", metadata)


def depth_log() -> Log:
    return Log({"depth": channel("depth", np.arange(N))}, "measured")


def event_log() -> Log:
    events = (Event("apogee", int(TIMES[N // 2]), 19.5), Event("gps fix", int(TIMES[-1]) + 5))
    return Log(depth_log().channels, "reconstruction", {"reconstruction": "wind guessed"}, events)


def attitude_log() -> Log:
    """Attitude at other times than depth, as in field logs."""
    angles = [channel(name, 0.2, TIMES[3:] + 500_000_000) for name in ("roll", "pitch", "heading")]
    return depth_log().with_channels(*angles, channel("temperature", 12.0, TIMES - 10**9))


LOGS = [full_log, depth_log, event_log, attitude_log]


def written(log: Log, path: Path) -> Written:
    """What is written of a log."""
    write_mcap(log, path)
    return messages(path)


def stamps(message: Any) -> list[int]:
    """Every timestamp of a message, ns."""
    holders = list(getattr(message, "transforms", [])) + list(getattr(message, "entities", [])) or [message]
    return [h.timestamp.seconds * 10**9 + h.timestamp.nanos for h in holders if hasattr(h, "timestamp")]


@pytest.mark.parametrize("log", LOGS)
def test_the_doctor_passes_it(log: Callable[[], Log], tmp_path: Path) -> None:
    write_mcap(log(), tmp_path / "a.mcap")
    command = [PYMCAP, "doctor", "--strict-message-order", "--format", "jsonl", tmp_path / "a.mcap"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    severities = {json.loads(line).get("severity") for line in done.stdout.splitlines()}
    assert not severities & {"warning", "error"}, done.stdout


@pytest.mark.parametrize("log", LOGS)
def test_an_empty_log_and_all_others_say_what_they_are_first(log: Callable[[], Log], tmp_path: Path) -> None:
    lines = written(log(), tmp_path / "a.mcap")["/log"]
    expected = {"simulated": "SIMULATED", "measured": "MEASURED", "reconstruction": "RECONSTRUCTION: wind guessed"}
    assert lines[0][1].message == expected[log().origin]
    empty = Log({}, log().origin, log().metadata)
    assert written(empty, tmp_path / "b.mcap")["/log"][0][1].message == expected[log().origin]


def test_a_simulation_of_a_reconstruction_says_so() -> None:
    log = Log({}, "simulated", {"reconstruction": "wind guessed"})
    assert statement(log) == "SIMULATED FROM A RECONSTRUCTION: wind guessed"


@pytest.mark.parametrize("log", LOGS)
def test_timestamps_are_the_log_times(log: Callable[[], Log], tmp_path: Path) -> None:
    for topic, sent in written(log(), tmp_path / "a.mcap").items():
        for time_ns, message in sent:
            assert all(stamp == time_ns for stamp in stamps(message)), topic


def test_own_topics_hold_every_sample(tmp_path: Path) -> None:
    log = full_log().with_channels(channel("pitch", [-0.0, 0.3], TIMES[[2, 5]]))
    found = written(log, tmp_path / "a.mcap")
    pitch = [(t, m.pitch_rad, m.pitch_deg) for t, m in found["/glider/attitude"] if not math.isnan(m.pitch_rad)]
    assert [t for t, _, _ in pitch] == TIMES[[2, 5]].tolist()
    assert np.array([v for _, v, _ in pitch]).tobytes() == np.array([-0.0, 0.3]).tobytes()
    assert pitch[1][2] == pytest.approx(math.degrees(0.3), rel=1e-15)  # one rounding of a product
    speeds = [m.speed_through_water_m_s for _, m in found["/glider/motion"]]
    assert speeds == log["speed_through_water"].values.tolist()
    groups = {f"/glider/{spec.group}" for spec in CHANNELS.values()}
    assert groups <= found.keys()


@pytest.mark.parametrize("log", LOGS)
def test_a_transform_stands_before_all_that_is_drawn(log: Callable[[], Log], tmp_path: Path) -> None:
    found = written(log(), tmp_path / "a.mcap")
    first = found["/tf"][0][0]
    drawn = [(topic, t) for topic, messages in found.items() if topic.startswith("/viz/") for t, _ in messages]
    assert drawn
    assert found["/tf_static"][0][0] <= first
    assert all(t >= first for _, t in drawn)


def rotated(q: Any, v: list[float]) -> np.ndarray:
    """v' = v + 2 r x (r x v + w v) for q = (r, w)."""
    r = np.array([q.x, q.y, q.z])
    return np.array(v) + 2.0 * np.cross(r, np.cross(r, v) + q.w * np.array(v))


def test_the_scene_faces_the_right_way(tmp_path: Path) -> None:
    found = written(full_log(), tmp_path / "a.mcap")
    static = found["/tf_static"][0][1].transforms[0]
    move = found["/tf"][-1][1]
    assert (static.parent_frame_id, static.child_frame_id) == ("map", "map_ned")
    assert (move.parent_frame_id, move.child_frame_id) == ("map_ned", "base_link_fsd")
    bow = rotated(static.rotation, rotated(move.rotation, [1.0, 0.0, 0.0]).tolist())
    level = math.cos(-0.4)
    expected = [level * math.sqrt(0.5), level * math.sqrt(0.5), math.sin(-0.4)]  # east, north, up: nose down
    np.testing.assert_allclose(bow, expected, atol=1e-15 * 8)  # a few roundings of numbers below 1
    assert move.translation.z == full_log()["down"].values[-1]
    level = found["/tf_place"][-1][1]
    assert (level.parent_frame_id, level.child_frame_id) == ("map", "base_enu")
    place = [move.translation.x, move.translation.y, move.translation.z]
    in_map = rotated(static.rotation, place)
    np.testing.assert_allclose([level.translation.x, level.translation.y, level.translation.z], in_map, rtol=1e-14)
    assert [level.rotation.x, level.rotation.y, level.rotation.z, level.rotation.w] == [0.0, 0.0, 0.0, 1.0]
    arrow = found["/viz/current"][-1][1].entities[0].arrows[0]
    np.testing.assert_allclose(rotated(arrow.pose.orientation, [1.0, 0.0, 0.0]), [0.0, 1.0, 0.0], atol=1e-15 * 8)
    assert arrow.shaft_length + arrow.head_length == pytest.approx(100.0 * 0.25, rel=1e-15)  # the scale it states
    assert arrow.pose.position.z == -full_log()["down"].values[-1]


def test_hull_track_and_map(tmp_path: Path) -> None:
    found = written(full_log(), tmp_path / "a.mcap")
    hull = found["/viz/vehicle"][0][1].entities[0]
    ends = [
        (part.pose.position.x - 0.5 * part.size.z, part.pose.position.x + 0.5 * part.size.z) for part in hull.cylinders
    ]
    bow = hull.spheres[0].pose.position.x + 0.5 * hull.spheres[0].size.x
    assert (min(start for start, _ in ends), bow) == pytest.approx((-0.75, 0.75), abs=1e-15)  # a sum of two
    assert max(end for _, end in ends) == pytest.approx(bow - 0.1, abs=1e-15)  # half of the nose is beyond the barrel
    assert {hull.cylinders[0].size.x, hull.cylinders[0].size.y, hull.spheres[0].size.x} == {0.2}
    line = found["/viz/track"][0][1].entities[0]
    assert [point.y for point in line.lines[0].points] == full_log()["east"].values.tolist()
    (feature,) = json.loads(found["/map/track"][0][1].geojson)["features"]
    longitude, latitude = feature["geometry"]["coordinates"][-1][-1]
    metres = 0.5 * (N - 1)
    # On the ground a degree of latitude at 20 deg north is 110.7 km, one of longitude 104.6 km: 0.1 % by these digits.
    assert latitude - 20.0 == pytest.approx(metres / 110_700.0, rel=1e-3)
    assert longitude - 115.0 == pytest.approx(metres / 104_600.0, rel=1e-3)
    fix = found["/glider/fix"][-1][1]
    assert (fix.latitude, fix.longitude, fix.altitude) == (20.0, 115.0, -metres)
    assert fix.HasField("color")


def test_only_what_the_log_has(tmp_path: Path) -> None:
    found = written(depth_log(), tmp_path / "a.mcap")
    assert found.keys() == {
        "/log",
        "/tf_static",
        "/tf",
        "/tf_place",
        "/viz/vehicle",
        "/viz/surface",
        "/glider/navigation",
    }
    assert [m.translation.z for _, m in found["/tf"]] == depth_log()["depth"].values.tolist()
    assert any("not to scale" in m.message for _, m in found["/log"])
    assert any("no attitude" in m.message for _, m in found["/log"])
    assert "/glider/pose" not in written(attitude_log(), tmp_path / "b.mcap")  # no time with both


def test_events_are_told_and_kept(tmp_path: Path) -> None:
    found = written(event_log(), tmp_path / "a.mcap")
    assert [m.message for _, m in found["/log"] if m.name == "event"] == ["apogee at 19.5 m", "gps fix"]
    assert [(m.name, m.time_ns) for _, m in found["/glider/event"]] == [(e.name, e.time_ns) for e in event_log().events]


def test_metadata_and_attachment(tmp_path: Path) -> None:
    write_mcap(full_log(), tmp_path / "a.mcap")
    with (tmp_path / "a.mcap").open("rb") as stream:
        reader = make_reader(stream)
        records = {record.name: record.metadata for record in reader.iter_metadata()}
        (attachment,) = reader.iter_attachments()
    assert records.keys() == {"run", "origin", "version"}
    assert records["run"] == full_log().metadata
    assert records["origin"]["log"] == records["origin"]["depth"] == "simulated"
    assert (attachment.name, json.loads(attachment.data)) == ("provenance.json", {"seed": 3})


def moved(pose: Any, point: Any) -> np.ndarray:
    """A point of a shape, in the shape's frame."""
    place = np.array([pose.position.x, pose.position.y, pose.position.z])
    return place + rotated(pose.orientation, [point.x, point.y, point.z])


def moving_log(**told: str) -> Log:
    """The mass slides forward and turns to 45 deg, the rudder goes to 0.3 rad; attitude is level."""
    along = np.linspace(0.40, 0.42, N)
    channels = [channel(name, 0.0) for name in ("roll", "pitch", "heading")]
    channels += [
        channel("mass_position", along),
        channel("mass_rotation", np.linspace(0.0, math.pi / 4, N)[:5], TIMES[:5]),
    ]
    return depth_log().with_channels(*channels, channel("rudder_angle", 0.3)).with_metadata(**told)


def test_the_movable_mass_slides_and_turns_in_the_hull(tmp_path: Path) -> None:
    told = {"hull_length_m": "2", "hull_diameter_m": "0.2", "movable_nominal_position_m": "0.4"}
    found = written(moving_log(**told, movable_eccentricity_m="0.014"), tmp_path / "a.mcap")
    masses = found["/viz/movable_mass"]
    assert [t for t, _ in masses] == TIMES.tolist()
    entity = masses[-1][1].entities[0]
    assert entity.frame_id == "base_link_fsd"
    (mass,), rod = entity.cylinders, entity.lines[0]
    gamma = np.linspace(0.0, math.pi / 4, N)[4]  # held after its last sample
    arm = 0.25 * 0.2
    expected = [0.42, -arm * math.sin(gamma), arm * math.cos(gamma)]  # (r_rx, -Rr sin gamma, Rr cos gamma)
    centre = [mass.pose.position.x, mass.pose.position.y, mass.pose.position.z]
    np.testing.assert_allclose(centre, expected, atol=1e-15 * 4)  # a few roundings of numbers below 1
    np.testing.assert_allclose(rotated(mass.pose.orientation, [0.0, 0.0, 1.0]), [1.0, 0.0, 0.0], atol=1e-15 * 8)
    ends = [[p.x, p.y, p.z] for p in rod.points]
    assert ends == [[0.42, 0.0, 0.0], centre]
    told_lines = [m.message for _, m in found["/log"]]
    assert any("drawn exaggerated: 0.050 m for a true 0.014 m" in text for text in told_lines)


def test_a_mass_with_an_unknown_zero_is_drawn_about_its_middle_and_told(tmp_path: Path) -> None:
    found = written(moving_log(mass_position_zero="the actuator's own"), tmp_path / "a.mcap")
    along = [m.entities[0].cylinders[0].pose.position.x for _, m in found["/viz/movable_mass"]]
    assert (min(along), max(along)) == pytest.approx((-0.01, 0.01), abs=1e-15)  # a difference of numbers below 1
    assert any("about the middle of its range" in m.message for _, m in found["/log"])


def test_the_rudder_goes_to_the_side_that_the_glider_turns_to(tmp_path: Path) -> None:
    found = written(moving_log(), tmp_path / "a.mcap")
    blade = found["/viz/rudder"][-1][1].entities[0].triangles[0]
    corners = np.array([moved(blade.pose, point) for point in blade.points])
    hinge = np.array([blade.pose.position.x, 0.0, 0.0])
    aft = corners[corners[:, 0].argmin()] - hinge
    assert math.atan2(aft[1], -aft[0]) == pytest.approx(0.3, abs=1e-12)  # starboard, behind the hinge
    assert (corners[:, 0] <= hinge[0] + 1e-12).all()


def test_the_sea_surface_lies_at_depth_zero(tmp_path: Path) -> None:
    """A log whose origin is 3 m deep has its surface 3 m above that, wherever its samples begin."""
    log = full_log().with_channels(
        channel("depth", np.arange(N) * 0.5 + 2.0), channel("down", np.arange(N) * 0.5 - 1.0)
    )
    drawn = written(log.with_metadata(bottom_depth_m="250.0"), tmp_path / "a.mcap")
    ground = drawn["/viz/bottom"][0][1].entities[0]
    assert {p.z for p in ground.triangles[0].points} == {247.0}
    assert ground.texts[0].text.startswith("bottom, 250 m")
    assert "/viz/bottom" not in written(log, tmp_path / "b.mcap")
    sheet = drawn["/viz/surface"][0][1].entities[0]
    assert sheet.frame_id == "map_ned"
    corners = np.array([[p.x, p.y, p.z] for p in sheet.triangles[0].points])
    assert set(corners[:, 2]) == {-3.0}
    assert {p.z for line in sheet.lines for p in line.points} == {-3.0}
    north = log["north"].values
    assert corners[:, 0].min() <= north.min()
    assert corners[:, 0].max() >= north.max()


def test_the_track_is_broken_at_gaps(tmp_path: Path) -> None:
    late = TIMES.copy()
    late[20] += 3600 * 10**9
    late[21:] += 57_600 * 10**9
    log = full_log()
    log = Log({n: Channel(n, late, c.values, c.origin) for n, c in log.channels.items()}, log.origin, log.metadata)
    found = written(log, tmp_path / "a.mcap")
    entity = found["/viz/track"][0][1].entities[0]
    east = log["east"].values
    assert [[point.y for point in line.points] for line in entity.lines] == [east[:20].tolist(), east[21:].tolist()]
    assert [len(line.colors) for line in entity.lines] == [20, N - 21]
    assert {line.type for line in entity.lines} == {0}  # LINE_STRIP
    assert [(ball.pose.position.x, ball.pose.position.y, ball.pose.position.z) for ball in entity.spheres] == [
        (log["north"].values[20], east[20], log["down"].values[20])
    ]
    (feature,) = json.loads(found["/map/track"][0][1].geojson)["features"]
    assert [len(line) for line in feature["geometry"]["coordinates"]] == [20, N - 21]
    told = "2 gaps of more than 60 s between its samples"
    assert {entry.key: entry.value for entry in entity.metadata}["broken at"] == told
    assert any(f"the track is broken at {told}" in message.message for _, message in found["/log"])


def test_the_track_has_the_colours_of_its_phases(tmp_path: Path) -> None:
    codes = np.where(np.arange(N) < N // 2, PHASES.index("dive"), PHASES.index("climb"))
    found = written(full_log().with_channels(channel("phase", codes)), tmp_path / "a.mcap")
    line = found["/viz/track"][0][1].entities[0].lines[0]
    colours = [(c.r, c.g, c.b) for c in line.colors]
    assert len(colours) == len(line.points) == N
    assert len(set(colours[: N // 2])) == len(set(colours[N // 2 :])) == 1
    assert colours[0] != colours[-1]
    words = [(t, m.value) for t, m in found["/viz/phase"]]
    assert words == [(TIMES[0], "dive"), (TIMES[N // 2], "climb"), (TIMES[-1], "climb")]  # the end, for viewers


def test_fixes_stand_at_their_places(tmp_path: Path) -> None:
    place = {"latitude": np.array([20.0, 20.01]), "longitude": np.array([115.0, 115.02])}
    fixes = [Channel(name, TIMES[[1, 30]], values, "measured") for name, values in place.items()]
    found = written(full_log().with_channels(*fixes), tmp_path / "a.mcap")
    balls = [s.pose.position for s in found["/viz/fixes"][0][1].entities[0].spheres]
    # a degree of latitude at 20 deg north is 110.7 km, one of longitude 104.6 km: 0.1 % by these digits
    assert [(b.x, b.y, b.z) for b in balls] == [(0.0, 0.0, 0.0), pytest.approx((1107.0, 2092.0, 0.0), rel=1e-3)]
    simulated = [Channel(name, TIMES[[1, 30]], values, "simulated") for name, values in place.items()]
    assert "/viz/fixes" not in written(full_log().with_channels(*simulated), tmp_path / "b.mcap")


def test_current_arrows_point_along_the_current(tmp_path: Path) -> None:
    log = full_log().with_channels(
        channel("current_east", 0.3), channel("current_north", 0.4), channel("current_up", -1.2)
    )
    found = written(log, tmp_path / "a.mcap")
    arrows = found["/viz/current_profile"][0][1].entities[0].arrows
    assert len(arrows) == 40
    for arrow in (arrows[0], arrows[-1]):
        way = rotated(arrow.pose.orientation, [1.0, 0.0, 0.0])
        np.testing.assert_allclose(way, np.array([0.4, 0.3, 1.2]) / 1.3, atol=1e-15 * 8)  # north, east, down
    (told,) = [m.message for _, m in found["/log"] if "fastest" in m.message]
    scale = float(told.split(" m for 1 m/s")[0].split()[-1])
    assert arrows[0].shaft_length + arrows[0].head_length == pytest.approx(1.3 * scale, rel=1e-3)  # its four digits


def test_depth_is_there_as_elevation_and_other_units_beside_si(tmp_path: Path) -> None:
    found = written(full_log(), tmp_path / "a.mcap")
    message = found["/glider/navigation"][3][1]
    assert message.elevation_m == -message.depth_m == -1.5
    water, actuators = found["/glider/water"][3][1], found["/glider/actuators"][3][1]
    assert water.pressure_dbar == pytest.approx(water.pressure_Pa * 1e-4, rel=1e-15)
    assert actuators.ballast_volume_cm3 == pytest.approx(actuators.ballast_volume_m3 * 1e6, rel=1e-15)


@pytest.mark.parametrize("log", [full_log(), moving_log(), Log({}, "reconstruction", {}, event_log().events)])
def test_what_is_simulated_or_remade_is_said_in_the_scene(log: Log, tmp_path: Path) -> None:
    found = written(log, tmp_path / "a.mcap")
    assert found["/log"][0][1].message.startswith(log.kind)
    if "/viz/vehicle" in found:
        hull = found["/viz/vehicle"][0][1].entities[0]
        assert [text.text for text in hull.texts] == [log.kind]
        assert {pair.key: pair.value for pair in hull.metadata}["log"] == log.kind


def test_a_way_beyond_reason_is_drawn_without_a_surface(tmp_path: Path) -> None:
    log = full_log().with_channels(channel("north", np.linspace(-1e300, 1e300, N)))
    assert "/viz/surface" not in written(log, tmp_path / "a.mcap")


def test_depth_averaged_currents_stand_above_their_dives(tmp_path: Path) -> None:
    """Those of the closures, where they are told; what is no closure is left out."""
    middle = [np.datetime_as_string(np.datetime64(int(TIMES[i]), "ns"), unit="ms") + "Z" for i in (10, 20)]
    good = {"start": middle[0], "end": middle[1], "current_north_m_s": 0.3, "current_east_m_s": -0.4}
    closures = [good, {**good, "end": "?"}, {**good, "current_north_m_s": float("nan")}, 7, "x", None]
    told = {"depth_averaged_current_north_m_s": "1.0", "depth_averaged_current_east_m_s": "0.0"}
    found = written(full_log().with_metadata(closures=json.dumps(closures), **told), tmp_path / "a.mcap")
    (arrow,), (label,) = (
        getattr(found["/viz/current_average"][0][1].entities[0], kind) for kind in ("arrows", "texts")
    )
    np.testing.assert_allclose(rotated(arrow.pose.orientation, [1.0, 0.0, 0.0]), [0.6, -0.8, 0.0], atol=1e-15 * 8)
    assert label.text == "0.50 m/s"
    assert (arrow.pose.position.x, arrow.pose.position.z) == (pytest.approx(7.5, abs=1e-2), 0.0)  # times of 1 ms
    own = written(full_log().with_metadata(closures="{", **told), tmp_path / "b.mcap")
    (arrow,) = own["/viz/current_average"][0][1].entities[0].arrows
    np.testing.assert_allclose(rotated(arrow.pose.orientation, [1.0, 0.0, 0.0]), [1.0, 0.0, 0.0], atol=1e-15 * 8)
    assert any("as the vehicle's own software tells it" in m.message for _, m in own["/log"])


def test_what_moves_in_the_hull_is_there_where_nothing_tells_a_place(tmp_path: Path) -> None:
    """A piece with samples of the movable mass alone, as a play at a slow pace makes them."""
    log = moving_log()
    times = np.append(log["mass_position"].time_ns, log.end_ns + np.arange(1, 4) * 10**9)
    log = log.with_channels(Channel("mass_position", times, np.linspace(0.3, 0.4, len(times)), "simulated"))
    scene = Scene(log)
    pieces = [log.sliced(None, int(times[-3])), log.sliced(int(times[-3]), None)]
    assert "depth" not in pieces[1].channels or not len(pieces[1]["depth"])
    drawn = [topic for piece in pieces for topic in scene.topics(piece) if topic.name == "/viz/movable_mass"]
    assert np.concatenate([topic.time_ns for topic in drawn])[-3:].tolist() == times[-3:].tolist()


def test_the_map_goes_on_at_180_degrees(tmp_path: Path) -> None:
    log = full_log()
    log = log.with_channels(
        channel("longitude", (179.9998 + np.arange(N) * 1e-5 + 180.0) % 360.0 - 180.0),
    )
    log = Log({name: c for name, c in log.channels.items() if name not in ("north", "east")}, log.origin, {})
    (feature,) = json.loads(written(log, tmp_path / "a.mcap")["/map/track"][0][1].geojson)["features"]
    lines = feature["geometry"]["coordinates"]
    assert (len(lines), sum(map(len, lines))) == (2, N)
    assert all(abs(b[0] - a[0]) < 1.0 for line in lines for a, b in itertools.pairwise(line))


def test_what_was_told_before_the_first_place_counts_in_pieces_too() -> None:
    """The mass has its only position before anything tells a place; its rotation comes after."""
    times = full_log()["depth"].time_ns
    log = Log(
        {
            "mass_position": Channel("mass_position", times[:1], np.array([0.4]), "simulated"),
            "depth": Channel("depth", times[5:], np.zeros(N - 5), "simulated"),
            "mass_rotation": Channel("mass_rotation", times[6:], np.zeros(N - 6), "simulated"),
        },
        "simulated",
        {},
    )
    whole, cut = Scene(log), Scene(log)
    at = int(times[3])
    pieces = [between(log, int(times[0]), at), between(log, at, int(times[-1]) + 1)]
    found = [
        np.concatenate([t.time_ns for piece in part for t in scene.topics(piece) if t.name == "/viz/movable_mass"])
        for scene, part in ((whole, [log]), (cut, pieces))
    ]
    assert found[0].tolist() == found[1].tolist() == times[6:].tolist()
