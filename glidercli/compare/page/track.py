"""Where did each log go? Tracks in one frame, north, east and depth in m, for a page's plots.

The frame's origin is that of the first log that names one (origin_latitude_deg, origin_longitude_deg). A log with
another named origin is moved by the way between the two; one without any starts at the frame's own.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Log
from glidercli.places import track_of_geodetic

__all__ = ["track"]

Array = NDArray[np.float64]


def track(logs: Sequence[Log], most: int) -> dict[str, Any] | None:
    """The tracks for the script, None where no log has one.

    lines : [{log, east, north, depth}], m, at most ``most`` points each, evenly spread, the ends among them.
    exaggeration : by how much depth is drawn larger than the horizontal.
    origin : [latitude, longitude], deg, or null. apart : numbers of the logs without an origin, beside others with one.
    interpolated : numbers of the logs whose depth is taken between its samples. thinned : numbers of logs.
    """
    origins = [log.place for log in logs]
    frame = next((origin for origin in origins if origin is not None), None)
    lines: list[dict[str, Any]] = []
    interpolated, thin, apart = [], [], []
    for number, (log, origin) in enumerate(zip(logs, origins, strict=True)):
        found = _of(log)
        if found is None:
            continue
        north, east, depth, between = found
        if origin is not None and frame is not None:
            way = track_of_geodetic(*origin, *frame)
            north, east = north + way[0], east + way[1]
        elif frame is not None:
            apart.append(number)
        chosen = np.linspace(0, len(north) - 1, min(len(north), most)).round().astype(np.int64)
        if len(chosen) < len(north):
            thin.append(number)
        if between:
            interpolated.append(number)
        columns = {"east": east, "north": north, "depth": depth}
        lines.append({"log": number, **{key: np.round(column[chosen], 2).tolist() for key, column in columns.items()}})
    if not lines:
        return None
    return {
        "lines": lines, "exaggeration": _exaggeration(lines), "origin": None if frame is None else list(frame),
        "apart": apart, "interpolated": interpolated, "thinned": thin,
    }  # fmt: skip


def _of(log: Log) -> tuple[Array, Array, Array, bool] | None:
    """North, east, depth, m, (n,), and whether depth was interpolated; None for a log without a track."""
    for vertical in ("depth", "down"):
        _, columns = log.together("north", "east", vertical)
        if len(columns[0]) > 1:
            return columns[0], columns[1], columns[2], False
    times, columns = log.together("north", "east")
    if len(times) < 2 or "depth" not in log or len(log["depth"]) < 2:
        return None
    depth = log["depth"]
    inside = (times >= depth.time_ns[0]) & (times <= depth.time_ns[-1])
    if inside.sum() < 2:
        return None
    return (
        columns[0][inside], columns[1][inside], np.interp(times[inside], depth.time_ns, depth.values), True,
    )  # fmt: skip


def _exaggeration(lines: list[dict[str, Any]]) -> float:
    """1, 2, 5, 10 ...: the least that makes depth a third of the track's horizontal extent, at most 1000."""
    extent = [
        max(max(line[key]) for line in lines) - min(min(line[key]) for line in lines)
        for key in ("east", "north", "depth")
    ]
    wanted = max(extent[0], extent[1]) / 3.0
    if extent[2] <= 0.0 or wanted <= extent[2]:
        return 1.0
    ratio = wanted / extent[2]
    tens = 10.0 ** math.floor(math.log10(ratio))
    return float(min(next(step for step in (1.0, 2.0, 5.0, 10.0) if step * tens >= ratio) * tens, 1000.0))
