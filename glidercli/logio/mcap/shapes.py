"""What do the viewers' messages look like? Foxglove's own: transforms, poses, fixes, map, and shapes in 3D.

Frames follow the draft REP-156: `map` is east, north, up; `map_ned` stands still under it; `base_link_fsd` (forward,
starboard, down) is the moving hull. On a seek a viewer restores the last message of a topic, so what belongs together
in the scene is one message. Submessages are set even where empty: viewers need them.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from glidercli.log import Log
from glidercli.logio.drawable import number
from glidercli.logio.mcap.messages import MARKED_TIME, Array, Messages, Table, Times, message, slot, timestamp
from glidercli.places import geodetic_of_track

__all__ = [
    "Samples", "current", "fixes", "map_track", "poses", "static", "track", "transforms", "vehicle",
]  # fmt: skip

Samples = tuple[Times, list[Array]]
"""Times, and the values of some quantities there."""

MAP, NED, HULL = "map", "map_ned", "base_link_fsd"
ARROW_SCALE = 100.0
"""m of arrow for 1 m/s of current: a current of 0.1 m/s is seen beside the hull and does not hide it."""
_ROOT = math.sqrt(0.5)


def static(time_ns: int) -> Messages:
    """/tf_static: `map_ned` under `map`, half a turn about the line north-east: x and y change places, z turns over."""
    from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

    transform = {
        "timestamp": timestamp(time_ns), "parent_frame_id": MAP, "child_frame_id": NED,
        "translation": _of("xyz", 0.0, 0.0, 0.0), "rotation": _of("xyzw", _ROOT, _ROOT, 0.0, 0.0),
    }  # fmt: skip
    return _single("/tf_static", time_ns, message(FrameTransforms, transforms=[transform]))


def transforms(motion: Samples) -> Table:
    """/tf: the hull in `map_ned`; columns north, east, down, x, y, z, w."""
    from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform

    pose = _marked_pose()
    template = message(FrameTransform, timestamp=MARKED_TIME, parent_frame_id=NED, child_frame_id=HULL)
    template.MergeFrom(message(FrameTransform, translation=pose["position"], rotation=pose["orientation"]))
    return Table("/tf", motion[0], template, motion[1])


def poses(motion: Samples) -> Table:
    """/glider/pose: the hull in `map_ned`; columns north, east, down, x, y, z, w."""
    from foxglove_schemas_protobuf.PoseInFrame_pb2 import PoseInFrame

    template = message(PoseInFrame, timestamp=MARKED_TIME, frame_id=NED, pose=_marked_pose())
    return Table("/glider/pose", motion[0], template, motion[1])


def fixes(found: Samples, altitude: Array) -> Table:
    """/glider/fix: latitude and longitude, deg; altitude, m, is -depth, NaN where that is not sampled."""
    from foxglove_schemas_protobuf.LocationFix_pb2 import LocationFix

    place = {"latitude": slot(0), "longitude": slot(1), "altitude": slot(2), "position_covariance": [0.0] * 9}
    color = _of("rgba", 1.0, 0.5, 0.0, 1.0)
    template = message(LocationFix, timestamp=MARKED_TIME, frame_id=MAP, color=color, **place)
    return Table("/glider/fix", found[0], template, [*found[1], altitude])


def map_track(log: Log, way: Array, fixed: Array, time_ns: int) -> list[Messages]:
    """/map/track: the whole track as GeoJSON, from north and east about the known origin, else from the fixes.

    way : (n, 2) north and east, m. fixed : (n, 2) latitude and longitude, deg.
    """
    from foxglove_schemas_protobuf.GeoJSON_pb2 import GeoJSON

    latitude_0, longitude_0 = number(log, "origin_latitude_deg"), number(log, "origin_longitude_deg")
    if len(way) and latitude_0 is not None and longitude_0 is not None:
        latitude, longitude = geodetic_of_track(way[:, 0], way[:, 1], latitude_0, longitude_0)
    elif len(fixed):
        latitude, longitude = fixed.T
    else:
        return []
    line = np.stack([longitude, latitude], axis=-1)
    points = line[np.isfinite(line).all(axis=-1)].tolist()
    if not points:
        return []
    kind, places = ("LineString", points) if len(points) > 1 else ("Point", points[0])
    feature = {"type": "Feature", "properties": {"name": "track"}, "geometry": {"type": kind, "coordinates": places}}
    text = json.dumps({"type": "FeatureCollection", "features": [feature]}, allow_nan=False)
    return [_single("/map/track", time_ns, GeoJSON(geojson=text))]


def vehicle(size: tuple[float, float, bool], time_ns: int) -> Messages:
    """/viz/vehicle: a hull along x with a red nose and wings; the wings only show which way it lies.

    size : as ``hull_size`` gives it.
    """
    length, diameter, to_scale = size
    hull = {
        "pose": _pose(0.0, 0.0, 0.0, (0.0, _ROOT, 0.0, _ROOT)), "size": _of("xyz", diameter, diameter, length),
        "bottom_scale": 1.0, "top_scale": 1.0, "color": _of("rgba", 1.0, 0.8, 0.0, 1.0),
    }  # fmt: skip
    red, grey = _of("rgba", 0.9, 0.1, 0.1, 1.0), _of("rgba", 0.3, 0.3, 0.3, 1.0)
    nose = {"pose": _pose(0.5 * length, 0.0, 0.0), "size": _of("xyz", diameter, diameter, diameter), "color": red}
    span = _of("xyz", 0.1 * length, 0.6 * length, 0.1 * diameter)
    wings = {"pose": _pose(0.0, 0.0, 0.0), "size": span, "color": grey}
    notes = {"hull": "to scale" if to_scale else "not to scale", "wings": "not to scale"}
    content = _scene(time_ns, HULL, "vehicle", notes, cylinders=[hull], spheres=[nose], cubes=[wings])
    return _single("/viz/vehicle", time_ns, content)


def track(points: Array, count: int, origin: str, time_ns: int) -> Messages:
    """/viz/track: the whole track as one line. points : (n, 3) of the ``count`` samples, north, east, down, m."""
    line = {
        "pose": _pose(0.0, 0.0, 0.0), "thickness": 2.0, "scale_invariant": True,
        "color": _of("rgba", 0.2, 0.6, 1.0, 1.0), "points": [_of("xyz", *point) for point in points.tolist()],
    }  # fmt: skip
    notes = {"points": f"{len(points)} of {count}", "origin": origin}
    return _single("/viz/track", time_ns, _scene(time_ns, NED, "track", notes, lines=[line]))


def current(times: Times, place: list[Array], velocity: list[Array]) -> Table:
    """/viz/current: an arrow from the hull's place along the current, in `map`.

    place : north, east, down, m. velocity : east, north, up, m/s.
    """
    north, east, down = place
    u_east, u_north, u_up = velocity
    half_turn, half_rise = 0.5 * np.arctan2(u_north, u_east), 0.5 * np.arctan2(u_up, np.hypot(u_east, u_north))
    sin_turn, cos_turn, sin_rise, cos_rise = np.sin(half_turn), np.cos(half_turn), np.sin(half_rise), np.cos(half_rise)
    q_xyzw = [sin_turn * sin_rise, -cos_turn * sin_rise, sin_turn * cos_rise, cos_turn * cos_rise]  # x axis to current
    length = ARROW_SCALE * np.sqrt(u_east**2 + u_north**2 + u_up**2)
    arrow = {
        "pose": _marked_pose(), "shaft_length": slot(7), "head_length": slot(8), "shaft_diameter": 0.2,
        "head_diameter": 0.6, "color": _of("rgba", 0.1, 0.8, 0.7, 1.0),
    }  # fmt: skip
    template = _scene(MARKED_TIME, MAP, "current", {"scale": f"{ARROW_SCALE:.0f} m for 1 m/s"}, arrows=[arrow])
    return Table("/viz/current", times, template, [east, north, -down, *q_xyzw, 0.8 * length, 0.2 * length])


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


def _scene(time_ns: int | dict[str, int], frame: str, name: str, notes: dict[str, str], **drawn: Any) -> Any:
    """A SceneUpdate of one entity that stays until the next of its name."""
    from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate

    entity = {
        "timestamp": timestamp(time_ns) if isinstance(time_ns, int) else time_ns,
        "frame_id": frame, "id": name, "lifetime": {"seconds": 0}, "frame_locked": True,
        "metadata": [{"key": key, "value": value} for key, value in notes.items()],
        **drawn,
    }  # fmt: skip
    return message(SceneUpdate, entities=[entity])
