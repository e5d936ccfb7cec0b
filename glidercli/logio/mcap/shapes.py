"""What do the viewers' messages look like? Foxglove's own: transforms, poses, fixes, phases, the map and the current.

On a seek a viewer restores the last message of a topic, so what belongs together is one message.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from glidercli.log import Log
from glidercli.logio.mcap.messages import MARKED_TIME, Array, Messages, Table, Times, message, slot, timestamp
from glidercli.logio.mcap.primitives import HULL, MAP, NED, PLACE, colour, marked_pose, point, scene, single
from glidercli.logio.mcap.side import ALONE, Side
from glidercli.places import geodetic_of_track

__all__ = ["Samples", "current", "fixes", "map_track", "phases", "places", "poses", "static", "transforms"]

Samples = tuple[Times, list[Array]]
"""Times, and the values of some quantities there."""

ARROW_SCALE = 100.0
"""m of arrow for 1 m/s of current: a current of 0.1 m/s is seen beside the hull and does not hide it."""
_ROOT = math.sqrt(0.5)


def static(time_ns: int) -> Messages:
    """/tf_static: `map_ned` under `map`, half a turn about the line north-east: x and y change places, z turns over."""
    from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

    transform = {
        "timestamp": timestamp(time_ns), "parent_frame_id": MAP, "child_frame_id": NED,
        "translation": point(0.0, 0.0, 0.0), "rotation": dict(zip("xyzw", (_ROOT, _ROOT, 0.0, 0.0), strict=True)),
    }  # fmt: skip
    return single("/tf_static", time_ns, message(FrameTransforms, transforms=[transform]))


def transforms(motion: Samples, side: Side = ALONE) -> Table:
    """/tf: the hull in `map_ned`; columns north, east, down, x, y, z, w."""
    from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform

    pose = marked_pose()
    template = message(FrameTransform, timestamp=MARKED_TIME, parent_frame_id=NED, child_frame_id=side.frame(HULL))
    template.MergeFrom(message(FrameTransform, translation=pose["position"], rotation=pose["orientation"]))
    return Table("/tf", motion[0], template, motion[1])


def places(motion: Samples, side: Side = ALONE) -> Table:
    """/tf_place: where the hull is in `map`, not how it lies; columns north, east, down and others."""
    from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform

    (north, east, down), zero, one = motion[1][:3], np.zeros(len(motion[0])), np.ones(len(motion[0]))
    pose = marked_pose()
    template = message(FrameTransform, timestamp=MARKED_TIME, parent_frame_id=MAP, child_frame_id=side.frame(PLACE))
    template.MergeFrom(message(FrameTransform, translation=pose["position"], rotation=pose["orientation"]))
    return Table("/tf_place", motion[0], template, [east, north, -down, zero, zero, zero, one])


def poses(motion: Samples) -> Table:
    """/glider/pose: the hull in `map_ned`; columns north, east, down, x, y, z, w."""
    from foxglove_schemas_protobuf.PoseInFrame_pb2 import PoseInFrame

    template = message(PoseInFrame, timestamp=MARKED_TIME, frame_id=NED, pose=marked_pose())
    return Table("/glider/pose", motion[0], template, motion[1])


def fixes(found: Samples, altitude: Array) -> Table:
    """/glider/fix: latitude and longitude, deg; altitude, m, is -depth, NaN where that is not sampled."""
    from foxglove_schemas_protobuf.LocationFix_pb2 import LocationFix

    place = {"latitude": slot(0), "longitude": slot(1), "altitude": slot(2), "position_covariance": [0.0] * 9}
    color = colour((1.0, 0.5, 0.0, 1.0))
    template = message(LocationFix, timestamp=MARKED_TIME, frame_id=MAP, color=color, **place)
    return Table("/glider/fix", found[0], template, [*found[1], altitude])


def map_track(log: Log, way: Array, fixed: Array, time_ns: int, side: Side = ALONE) -> list[Messages]:
    """/map/track: the whole track as GeoJSON, from north and east about the known origin, else from the fixes.

    way : (n, 3) north and east, m, and the number of the stretch; the line is broken between stretches. fixed : (n, 2)
    latitude and longitude, deg.
    """
    from foxglove_schemas_protobuf.GeoJSON_pb2 import GeoJSON

    about = log.place
    if about is not None and len(way):
        latitude, longitude = geodetic_of_track(way[:, 0], way[:, 1], *about)
        kind, stretches = log["north"].origin, way[:, 2]
    elif len(fixed):
        latitude, longitude = fixed.T
        kind, stretches = log["latitude"].origin, np.zeros(len(fixed))
    else:
        return []
    line = np.stack([longitude, latitude], axis=-1)
    finite = np.isfinite(line).all(axis=-1)
    points = line[finite]
    if not len(points):
        return []
    parted = np.diff(stretches[finite]) != 0.0
    parted |= np.abs(np.diff(points[:, 0])) > 180.0  # it goes on at 180 degrees
    parts = np.split(points, np.flatnonzero(parted) + 1)
    if lines := [part.tolist() for part in parts if len(part) > 1]:
        geometry: dict[str, Any] = {"type": "MultiLineString", "coordinates": lines}
    else:
        geometry = {"type": "Point", "coordinates": points[0].tolist()}
    shade = "#3399ff" if side.colour is None else "#" + "".join(f"{round(255 * part):02x}" for part in side.colour[:3])
    style = {"color": shade, "weight": 3}
    told = {"name": f"track ({log.kind if kind == log.origin else kind.upper()})", "style": style}
    feature = {"type": "Feature", "properties": told, "geometry": geometry}
    text = json.dumps({"type": "FeatureCollection", "features": [feature]}, allow_nan=False)
    return [single("/map/track", time_ns, GeoJSON(geojson=text))]


def phases(times: Times, words: list[str]) -> Messages:
    """/viz/phase: the flight phase, from each change on."""
    from foxglove_schemas_protobuf.KeyValuePair_pb2 import KeyValuePair

    return Messages("/viz/phase", times, [message(KeyValuePair, key="phase", value=word) for word in words])


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
        "pose": marked_pose(), "shaft_length": slot(7), "head_length": slot(8), "shaft_diameter": 0.04,
        "head_diameter": 0.3, "color": colour((0.1, 0.8, 0.7, 1.0)),
    }  # fmt: skip
    template = scene(MARKED_TIME, MAP, "current", {"scale": f"{ARROW_SCALE:.0f} m for 1 m/s"}, arrows=[arrow])
    return Table("/viz/current", times, template, [east, north, -down, *q_xyzw, 0.8 * length, 0.2 * length])
