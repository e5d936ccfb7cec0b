"""Does the MCAP file hold for others? The doctor passes it, and every message decodes by its own embedded schema."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from google.protobuf.descriptor_pool import DescriptorPool
from google.protobuf.message_factory import GetMessageClass
from mcap.reader import make_reader

from glidercli.channels import CHANNELS
from glidercli.log import Channel, Event, Log
from glidercli.logio.mcap.contents import statement
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


Written = dict[str, list[tuple[int, Any]]]
LOGS = [full_log, depth_log, event_log, attitude_log]


def written(log: Log, path: Path) -> Written:
    """All messages by topic as (log time, message), decoded by the descriptors in the file and nothing else."""
    write_mcap(log, path)
    kinds: dict[int, Any] = {}
    found: Written = defaultdict(list)
    with path.open("rb") as stream:
        for schema, own, message in make_reader(stream, validate_crcs=True).iter_messages():
            assert schema is not None
            assert message.publish_time == message.log_time
            if schema.id not in kinds:
                pool = DescriptorPool()
                for file in FileDescriptorSet.FromString(schema.data).file:
                    pool.Add(file)
                kinds[schema.id] = GetMessageClass(pool.FindMessageTypeByName(schema.name))
            found[own.topic].append((message.log_time, kinds[schema.id].FromString(message.data)))
    return found


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
    for topic, messages in written(log(), tmp_path / "a.mcap").items():
        for time_ns, message in messages:
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
    arrow = found["/viz/current"][-1][1].entities[0].arrows[0]
    np.testing.assert_allclose(rotated(arrow.pose.orientation, [1.0, 0.0, 0.0]), [0.0, 1.0, 0.0], atol=1e-15 * 8)
    assert arrow.shaft_length + arrow.head_length == pytest.approx(100.0 * 0.25, rel=1e-15)  # the scale it states
    assert arrow.pose.position.z == -full_log()["down"].values[-1]


def test_hull_track_and_map(tmp_path: Path) -> None:
    found = written(full_log(), tmp_path / "a.mcap")
    hull = found["/viz/vehicle"][0][1].entities[0]
    assert (hull.cylinders[0].size.z, hull.cylinders[0].size.x) == (1.5, 0.2)
    line = found["/viz/track"][0][1].entities[0]
    assert [point.y for point in line.lines[0].points] == full_log()["east"].values.tolist()
    (feature,) = json.loads(found["/map/track"][0][1].geojson)["features"]
    longitude, latitude = feature["geometry"]["coordinates"][-1]
    metres = 0.5 * (N - 1)
    # On the ground a degree of latitude at 20 deg north is 110.7 km, one of longitude 104.6 km: 0.1 % by these digits.
    assert latitude - 20.0 == pytest.approx(metres / 110_700.0, rel=1e-3)
    assert longitude - 115.0 == pytest.approx(metres / 104_600.0, rel=1e-3)
    fix = found["/glider/fix"][-1][1]
    assert (fix.latitude, fix.longitude, fix.altitude) == (20.0, 115.0, -metres)
    assert fix.HasField("color")


def test_only_what_the_log_has(tmp_path: Path) -> None:
    found = written(depth_log(), tmp_path / "a.mcap")
    assert found.keys() == {"/log", "/tf_static", "/tf", "/viz/vehicle", "/glider/navigation"}
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
