"""What are the viewers' shapes built of? Frames, poses, colours, texts, and scenes of one entity.

Frames follow the draft REP-156: `map` is east, north, up; `map_ned` stands still under it; `base_link_fsd` (forward,
starboard, down) is the moving hull. `base_enu` moves with it and does not turn: a camera that follows it keeps the
surface above (one that follows a place alone keeps how that frame lay when the panel was opened: a hull's z is down).
Submessages are set even where they hold nothing but zeros: viewers need them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from glidercli.logio.mcap.messages import Array, Messages, message, slot, timestamp

__all__ = [
    "AFT", "FORWARD", "HULL", "MAP", "NED", "PLACE", "Colour", "colour", "line", "marked_pose", "point", "points",
    "pose", "scene", "single", "text",
]  # fmt: skip

MAP, NED, HULL, PLACE = "map", "map_ned", "base_link_fsd", "base_enu"
_ROOT = math.sqrt(0.5)
FORWARD = (0.0, _ROOT, 0.0, _ROOT)
"""Quaternion x, y, z, w that lays a cylinder, which stands along z, along x with its top forward."""
AFT = (0.0, -_ROOT, 0.0, _ROOT)
"""The same with its top aft."""

Colour = tuple[float, float, float, float]
"""Red, green, blue and opacity, 0 to 1."""


def point(x: float, y: float, z: float) -> dict[str, float]:
    """A point or a size."""
    return {"x": x, "y": y, "z": z}


def points(rows: Array) -> list[dict[str, float]]:
    """The points of rows, (n, 3)."""
    return [point(*row) for row in rows.tolist()]


def colour(rgba: Colour) -> dict[str, float]:
    """A colour as a submessage."""
    return dict(zip("rgba", rgba, strict=True))


def pose(
    x: float = 0.0, y: float = 0.0, z: float = 0.0, q_xyzw: tuple[float, ...] = (0.0, 0.0, 0.0, 1.0)
) -> dict[str, Any]:
    """A pose as a submessage."""
    return {"position": point(x, y, z), "orientation": dict(zip("xyzw", q_xyzw, strict=True))}


def marked_pose(first: int = 0) -> dict[str, Any]:
    """A pose of a template, with seven marks from ``first`` on: x, y, z, and the quaternion x, y, z, w."""
    x, y, z, *turn = (slot(first + i) for i in range(7))
    return pose(x, y, z, tuple(turn))


def line(rows: Array, rgba: Colour, thickness: float = 2.0, kind: int = 0) -> dict[str, Any]:
    """A line through rows, (n, 3), some pixels thick. kind : 0 strip, 1 closed, 2 one line for each two points."""
    return {
        "type": kind, "pose": pose(), "thickness": thickness, "scale_invariant": True, "color": colour(rgba),
        "points": points(rows),
    }  # fmt: skip


def text(words: str, rgba: Colour, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> dict[str, Any]:
    """Words that face the eye, 14 pixels high."""
    return {
        "pose": pose(x, y, z), "billboard": True, "font_size": 14.0, "scale_invariant": True, "color": colour(rgba),
        "text": words,
    }  # fmt: skip


def single(name: str, time_ns: int, content: Any) -> Messages:
    """A topic of one message."""
    return Messages(name, np.array([time_ns], np.int64), [content])


def scene(time_ns: int | dict[str, int], frame: str, name: str, notes: Mapping[str, str], **drawn: Any) -> Any:
    """A SceneUpdate of one entity that stays until the next of its name, and moves with its frame.

    time_ns : UTC, or the timestamp of a template. notes : what a viewer shows of an entity that is clicked on.
    """
    from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate

    entity = {
        "timestamp": timestamp(time_ns) if isinstance(time_ns, int) else time_ns,
        "frame_id": frame, "id": name, "lifetime": {"seconds": 0}, "frame_locked": True,
        "metadata": [{"key": key, "value": value} for key, value in notes.items()],
        **drawn,
    }  # fmt: skip
    return message(SceneUpdate, entities=[entity])
