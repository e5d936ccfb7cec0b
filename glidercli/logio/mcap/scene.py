"""What does a viewer show of a log? Foxglove's own messages: transforms, pose, map, log lines and 3D scene.

Frames follow the draft REP-156: `map` is east, north, up; `map_ned` stands still under it; `base_link_fsd` (forward,
starboard, down) is the moving hull. The position is north, east, down, or the depth alone below the origin. Attitude
is there where roll, pitch and heading are sampled at one time. /tf has a transform at each sample of either, from when
all that the log has is known, and repeats the latest of the other, as a viewer would; /glider/pose has only true pairs.

On a seek a viewer restores the last message of a topic, so what belongs together in the scene is one message, and what
stands still is written once, at a time with a transform. Submessages are set even where empty: viewers need them.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import quaternion_from_euler_arrays
from glidercli.log import Log
from glidercli.logio.drawable import hull_size, number
from glidercli.logio.mcap.messages import (
    MARKED_TIME,
    Array,
    Messages,
    Table,
    Times,
    all_times,
    message,
    slot,
    timestamp,
)
from glidercli.places import geodetic_of_track

__all__ = ["remarks", "scene_topics"]

MAP, NED, HULL = "map", "map_ned", "base_link_fsd"
MOST_POINTS = 20_000
"""Points of a drawn track; longer ones are thinned evenly. The samples themselves are in /glider/navigation."""
ARROW_SCALE = 100.0
"""m of arrow for 1 m/s of current: a current of 0.1 m/s is seen beside the hull and does not hide it."""
_ROOT = math.sqrt(0.5)


_Samples = tuple[Times, list[Array]]
"""Times, and the values of some quantities there."""


def scene_topics(log: Log, start_ns: int) -> list[Table | Messages]:
    """The viewers' topics that the log has data for; transforms first. start_ns : time of the log's first message."""
    place, attitude = _place(log), _attitude(log)
    topics: list[Table | Messages] = [*_fixes(log), *_map_track(log, start_ns)]
    motion = _motion(place, attitude)
    if motion is None:
        return topics
    first = int(motion[0][0])
    topics = [_static(start_ns), _transforms(motion), *_poses(place, attitude), *topics]
    topics += [_single("/viz/vehicle", first, _vehicle(log, first)), *_tracks(log, first)]
    return topics if place is None else [*topics, *_currents(log, motion)]


def _sampled(log: Log, *names: str) -> _Samples | None:
    """The samples that these channels have together; None where there are none."""
    times, values = log.together(*names)
    return (times, values) if times.size else None


def _at(log: Log, name: str, times: Times, otherwise: float) -> Array:
    """A channel's samples at these very times; ``otherwise`` where it has none."""
    values = np.full(len(times), otherwise)
    if name in log:
        _, rows, source = np.intersect1d(times, log[name].time_ns, assume_unique=True, return_indices=True)
        values[rows] = log[name].values[source]
    return values


def _held(time_ns: Times, columns: list[Array], at: Times) -> list[Array]:
    """The latest values at or before each time ``at``; the first is not before the first of ``time_ns``."""
    rows = np.searchsorted(time_ns, at, side="right") - 1
    return [column[rows] for column in columns]


def _place(log: Log) -> _Samples | None:
    """Position north, east, down, m; from depth alone below the origin; None where there is neither."""
    track, depth = _sampled(log, "north", "east", "down"), _sampled(log, "depth")
    if track is not None or depth is None:
        return track
    zero = np.zeros(len(depth[0]))
    return depth[0], [zero, zero, *depth[1]]


def _attitude(log: Log) -> _Samples | None:
    """Attitude quaternion x, y, z, w of the hull in `map_ned`, or None."""
    angles = _sampled(log, "roll", "pitch", "heading")
    if angles is None:
        return None
    q_wxyz = quaternion_from_euler_arrays(*angles[1])
    return angles[0], [q_wxyz[:, 1], q_wxyz[:, 2], q_wxyz[:, 3], q_wxyz[:, 0]]


def _motion(place: _Samples | None, attitude: _Samples | None) -> _Samples | None:
    """Position and attitude, n, e, d, x, y, z, w; an unknown position is the origin, an unknown attitude level."""
    known = [pair for pair in (place, attitude) if pair is not None]
    if not known:
        return None
    times = all_times([pair[0] for pair in known])
    times = times[times >= max(int(pair[0][0]) for pair in known)]
    zero, one = np.zeros(len(times)), np.ones(len(times))
    position = [zero, zero, zero] if place is None else _held(*place, times)
    return times, [*position, *([zero, zero, zero, one] if attitude is None else _held(*attitude, times))]


def _of(names: str, *values: float) -> dict[str, float]:
    """A submessage with one-letter fields, as in _of("xyz", 1.0, 2.0, 3.0)."""
    return dict(zip(names, values, strict=True))


def _pose(x: float, y: float, z: float, q_xyzw: tuple[float, ...] = (0.0, 0.0, 0.0, 1.0)) -> dict[str, Any]:
    return {"position": _of("xyz", x, y, z), "orientation": _of("xyzw", *q_xyzw)}


def _marked_pose() -> dict[str, Any]:
    """A pose with marks 0 to 6."""
    return _pose(slot(0), slot(1), slot(2), (slot(3), slot(4), slot(5), slot(6)))


def _single(name: str, time_ns: int, content: Any) -> Messages:
    return Messages(name, np.array([time_ns], np.int64), [content])


def _static(start_ns: int) -> Messages:
    """/tf_static: `map_ned` under `map`, half a turn about the line north-east: x and y change places, z turns over."""
    from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

    transform = {
        "timestamp": timestamp(start_ns), "parent_frame_id": MAP, "child_frame_id": NED,
        "translation": _of("xyz", 0.0, 0.0, 0.0), "rotation": _of("xyzw", _ROOT, _ROOT, 0.0, 0.0),
    }  # fmt: skip
    return _single("/tf_static", start_ns, message(FrameTransforms, transforms=[transform]))


def _transforms(motion: _Samples) -> Table:
    """/tf: the hull in `map_ned`."""
    from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform

    pose = _marked_pose()
    template = message(FrameTransform, timestamp=MARKED_TIME, parent_frame_id=NED, child_frame_id=HULL)
    template.MergeFrom(message(FrameTransform, translation=pose["position"], rotation=pose["orientation"]))
    return Table("/tf", motion[0], template, motion[1])


def _poses(place: _Samples | None, attitude: _Samples | None) -> list[Table]:
    """/glider/pose: the hull in `map_ned` at the times that position and attitude share."""
    from foxglove_schemas_protobuf.PoseInFrame_pb2 import PoseInFrame

    if place is None or attitude is None:
        return []
    times = np.intersect1d(place[0], attitude[0], assume_unique=True)
    template = message(PoseInFrame, timestamp=MARKED_TIME, frame_id=NED, pose=_marked_pose())
    columns = [*_held(*place, times), *_held(*attitude, times)]
    return [Table("/glider/pose", times, template, columns)] if times.size else []


def _fixes(log: Log) -> list[Table]:
    """/glider/fix: latitude and longitude where both are sampled; altitude is -depth, NaN where that is not sampled."""
    from foxglove_schemas_protobuf.LocationFix_pb2 import LocationFix

    fixes = _sampled(log, "latitude", "longitude")
    if fixes is None:
        return []
    place = {"latitude": slot(0), "longitude": slot(1), "altitude": slot(2), "position_covariance": [0.0] * 9}
    color = _of("rgba", 1.0, 0.5, 0.0, 1.0)
    template = message(LocationFix, timestamp=MARKED_TIME, frame_id=MAP, color=color, **place)
    return [Table("/glider/fix", fixes[0], template, [*fixes[1], -_at(log, "depth", fixes[0], np.nan)])]


def _thinned(count: int) -> NDArray[np.int64]:
    """Rows of a drawn line: all, or MOST_POINTS evenly spread ones with the first and the last."""
    return np.linspace(0, count - 1, min(count, MOST_POINTS)).round().astype(np.int64)


def _map_track(log: Log, start_ns: int) -> list[Messages]:
    """/map/track: the whole track as GeoJSON, from north and east about the known origin, else from the fixes."""
    from foxglove_schemas_protobuf.GeoJSON_pb2 import GeoJSON

    way, fixes = _sampled(log, "north", "east"), _sampled(log, "latitude", "longitude")
    latitude_0, longitude_0 = number(log, "origin_latitude_deg"), number(log, "origin_longitude_deg")
    if way is not None and latitude_0 is not None and longitude_0 is not None:
        north, east = (column[_thinned(len(column))] for column in way[1])
        latitude, longitude = geodetic_of_track(north, east, latitude_0, longitude_0)
    elif fixes is not None:
        latitude, longitude = (column[_thinned(len(column))] for column in fixes[1])
    else:
        return []
    track = np.stack([longitude, latitude], axis=-1)
    points = track[np.isfinite(track).all(axis=-1)].tolist()
    if not points:
        return []
    kind, places = ("LineString", points) if len(points) > 1 else ("Point", points[0])
    feature = {"type": "Feature", "properties": {"name": "track"}, "geometry": {"type": kind, "coordinates": places}}
    text = json.dumps({"type": "FeatureCollection", "features": [feature]}, allow_nan=False)
    return [_single("/map/track", start_ns, GeoJSON(geojson=text))]


def remarks(log: Log) -> list[str]:
    """What a viewer of the scene must know: a hull or an attitude that is not from the log."""
    if _motion(_place(log), _attitude(log)) is None:
        return []
    length, diameter, to_scale = hull_size(log)
    said = [] if to_scale else [f"the hull is drawn {length} m x {diameter} m: not to scale"]
    return said if _attitude(log) else [*said, "no attitude in this log: the hull is drawn level, heading north"]


def _scene(time_ns: int | dict[str, int], frame: str, name: str, notes: dict[str, str], **shapes: Any) -> Any:
    """A SceneUpdate of one entity that stays until the next of its name."""
    from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate

    entity = {
        "timestamp": timestamp(time_ns) if isinstance(time_ns, int) else time_ns,
        "frame_id": frame, "id": name, "lifetime": {"seconds": 0}, "frame_locked": True,
        "metadata": [{"key": key, "value": value} for key, value in notes.items()],
        **shapes,
    }  # fmt: skip
    return message(SceneUpdate, entities=[entity])


def _vehicle(log: Log, time_ns: int) -> Any:
    """A hull along x with a red nose and wings; the wings only show which way it lies."""
    length, diameter, to_scale = hull_size(log)
    hull = {
        "pose": _pose(0.0, 0.0, 0.0, (0.0, _ROOT, 0.0, _ROOT)), "size": _of("xyz", diameter, diameter, length),
        "bottom_scale": 1.0, "top_scale": 1.0, "color": _of("rgba", 1.0, 0.8, 0.0, 1.0),
    }  # fmt: skip
    red, grey = _of("rgba", 0.9, 0.1, 0.1, 1.0), _of("rgba", 0.3, 0.3, 0.3, 1.0)
    nose = {"pose": _pose(0.5 * length, 0.0, 0.0), "size": _of("xyz", diameter, diameter, diameter), "color": red}
    span = _of("xyz", 0.1 * length, 0.6 * length, 0.1 * diameter)
    wings = {"pose": _pose(0.0, 0.0, 0.0), "size": span, "color": grey}
    notes = {"hull": "to scale" if to_scale else "not to scale", "wings": "not to scale"}
    return _scene(time_ns, HULL, "vehicle", notes, cylinders=[hull], spheres=[nose], cubes=[wings])


def _tracks(log: Log, time_ns: int) -> list[Messages]:
    """/viz/track: the whole track as one line."""
    track = _sampled(log, "north", "east", "down")
    if track is None:
        return []
    rows = _thinned(len(track[0]))
    points = np.stack(track[1], axis=-1)[rows].tolist()
    line = {
        "pose": _pose(0.0, 0.0, 0.0), "thickness": 2.0, "scale_invariant": True,
        "color": _of("rgba", 0.2, 0.6, 1.0, 1.0), "points": [_of("xyz", *point) for point in points],
    }  # fmt: skip
    notes = {"points": f"{len(rows)} of {len(track[0])}", "origin": log["north"].origin}
    return [_single("/viz/track", time_ns, _scene(time_ns, NED, "track", notes, lines=[line]))]


def _currents(log: Log, motion: _Samples) -> list[Table]:
    """/viz/current: an arrow from the hull's place along the current, in `map`; an unsampled upward part is zero."""
    current = _sampled(log, "current_east", "current_north")
    if current is None:
        return []
    after = current[0] >= motion[0][0]
    times, east, north = current[0][after], current[1][0][after], current[1][1][after]
    up = _at(log, "current_up", times, 0.0)
    way_north, way_east, way_down = _held(motion[0], motion[1][:3], times)
    half_turn, half_rise = 0.5 * np.arctan2(north, east), 0.5 * np.arctan2(up, np.hypot(east, north))
    sin_turn, cos_turn, sin_rise, cos_rise = np.sin(half_turn), np.cos(half_turn), np.sin(half_rise), np.cos(half_rise)
    q_xyzw = [sin_turn * sin_rise, -cos_turn * sin_rise, sin_turn * cos_rise, cos_turn * cos_rise]  # x axis to current
    length = ARROW_SCALE * np.sqrt(east**2 + north**2 + up**2)
    arrow = {
        "pose": _marked_pose(), "shaft_length": slot(7), "head_length": slot(8), "shaft_diameter": 0.2,
        "head_diameter": 0.6, "color": _of("rgba", 0.1, 0.8, 0.7, 1.0),
    }  # fmt: skip
    template = _scene(MARKED_TIME, MAP, "current", {"scale": f"{ARROW_SCALE:.0f} m for 1 m/s"}, arrows=[arrow])
    columns = [way_east, way_north, -way_down, *q_xyzw, 0.8 * length, 0.2 * length]
    return [Table("/viz/current", times, template, columns)] if times.size else []
