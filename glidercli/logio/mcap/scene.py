"""What does a viewer show of a log? Where the hull is and how it lies, the way that it took, the current about it.

The position is north, east, down, or the depth alone below the origin. Attitude is there where roll, pitch and heading
are sampled at one time. /tf has a transform at each sample of either, from when all that the log has is known, and
repeats the latest of the other, as a viewer would; /glider/pose has only true pairs. What stands still is written once,
at a time with a transform.
"""

from __future__ import annotations

import numpy as np

from glidercli.frames import quaternion_from_euler_arrays
from glidercli.log import Log
from glidercli.logio.drawable import hull_size
from glidercli.logio.mcap import shapes
from glidercli.logio.mcap.file import Topic
from glidercli.logio.mcap.messages import Array, Times, all_times
from glidercli.logio.mcap.shapes import Samples
from glidercli.logio.thinned import Thinned

__all__ = ["Scene"]

MOST_POINTS = 20_000
"""Points of a drawn track; longer ones are thinned evenly. The samples themselves are in /glider/navigation."""
TRACK, ANGLES = ("north", "east", "down"), ("roll", "pitch", "heading")
FOREVER = np.iinfo(np.int64).max


class Scene:
    """What viewers draw of a log that comes in pieces.

    log : the first piece; what has samples there is what can come.
    """

    def __init__(self, log: Log) -> None:
        placed = [len(log.together(*names)[0]) for names in (TRACK, ("depth",))]
        self._place, self._attitude = _Latest(any(placed)), _Latest(len(log.together(*ANGLES)[0]) > 0)
        self._log_ns = log.start_ns if any(map(len, log.channels.values())) else 0
        self._hull = hull_size(log)
        self._start_ns: int | None = None  # of all that moves
        self._track, self._way, self._fixes = (Thinned(MOST_POINTS) for _ in range(3))

    def topics(self, piece: Log) -> list[Topic]:
        """A piece's messages of the topics that the log has data for; transforms first."""
        fixes = piece.together("latitude", "longitude")
        self._track.add(np.stack(piece.together(*TRACK)[1], axis=-1))
        self._way.add(np.stack(piece.together(*TRACK[:2])[1], axis=-1))
        self._fixes.add(np.stack(fixes[1], axis=-1))
        topics: list[Topic] = []
        if fixes[0].size:
            topics.append(shapes.fixes(fixes, -_at(piece, "depth", fixes[0], np.nan)))
        place, attitude = _place(piece), _attitude(piece)
        motion = self._motion(place, attitude)
        if motion is None:
            return topics
        topics = [shapes.transforms(motion), *_poses(place, attitude), *topics]
        if self._start_ns is None:
            self._start_ns = int(motion[0][0])
            topics = [shapes.static(self._log_ns), *topics, shapes.vehicle(self._hull, self._start_ns)]
        return [*topics, *self._current(piece, self._start_ns)]

    def lines(self, log: Log, start_ns: int) -> list[Topic]:
        """The topics that show the whole way, when the last piece is there. log : that piece, with its metadata."""
        track = self._track.rows()
        topics: list[Topic] = [*shapes.map_track(log, self._way.rows(), self._fixes.rows(), start_ns)]
        if len(track) and self._start_ns is not None:
            topics.append(shapes.track(track, self._track.count, log["north"].origin, self._start_ns))
        return topics

    def remarks(self) -> list[str]:
        """What a viewer of the scene must know: a hull or an attitude that is not from the log."""
        if self._start_ns is None:
            return []
        length, diameter, to_scale = self._hull
        said = [] if to_scale else [f"the hull is drawn {length} m x {diameter} m: not to scale"]
        level = "no attitude in this log: the hull is drawn level, heading north"
        return said if self._attitude.known else [*said, level]

    def _motion(self, place: Samples, attitude: Samples) -> Samples | None:
        """Position and attitude, n, e, d, x, y, z, w; an unknown position is the origin, an unknown attitude level."""
        self._place.add(place)
        self._attitude.add(attitude)
        known = [side for side in (self._place, self._attitude) if side.known]
        times = all_times([place[0], attitude[0]])
        times = times[times >= max((side.start_ns for side in known), default=FOREVER)]
        if not times.size:
            return None
        zero, one = np.zeros(len(times)), np.ones(len(times))
        position = self._place.at(times) if self._place.known else [zero, zero, zero]
        return times, [*position, *(self._attitude.at(times) if self._attitude.known else [zero, zero, zero, one])]

    def _current(self, piece: Log, start_ns: int) -> list[Topic]:
        """The current about the hull; an unsampled upward part is zero."""
        times, current = piece.together("current_east", "current_north")
        moving = times >= start_ns
        times = times[moving]
        if not times.size or not self._place.known:
            return []
        east, north = (column[moving] for column in current)
        return [shapes.current(times, self._place.at(times), [east, north, _at(piece, "current_up", times, 0.0)])]


class _Latest:
    """The latest sample of a quantity at any time. known : whether the log has samples of it at all."""

    def __init__(self, known: bool) -> None:
        self.known = known
        self.start_ns = FOREVER
        self._times: Times = np.array([], np.int64)
        self._columns: list[Array] = []

    def add(self, samples: Samples) -> None:
        """Take those of a piece; of those before the last is kept."""
        times, columns = samples
        if not times.size:
            return
        if self._times.size:
            times = np.concatenate([self._times[-1:], times])
            columns = [np.concatenate([old[-1:], new]) for old, new in zip(self._columns, columns, strict=True)]
        self.start_ns = min(self.start_ns, int(times[0]))
        self._times, self._columns = times, columns

    def at(self, times: Times) -> list[Array]:
        """The latest values at or before each of these times, of which none is before ``start_ns``."""
        rows = np.searchsorted(self._times, times, side="right") - 1
        return [column[rows] for column in self._columns]


def _at(log: Log, name: str, times: Times, otherwise: float) -> Array:
    """A channel's samples at these very times; ``otherwise`` where it has none."""
    values = np.full(len(times), otherwise)
    if name in log:
        _, rows, source = np.intersect1d(times, log[name].time_ns, assume_unique=True, return_indices=True)
        values[rows] = log[name].values[source]
    return values


def _place(log: Log) -> Samples:
    """Position north, east, down, m; from depth alone below the origin where there is no track."""
    if set(TRACK) <= log.channels.keys():
        return log.together(*TRACK)
    times, depth = log.together("depth")
    zero = np.zeros(len(times))
    return times, [zero, zero, *depth]


def _attitude(log: Log) -> Samples:
    """Attitude quaternion x, y, z, w of the hull in `map_ned`."""
    times, angles = log.together(*ANGLES)
    q_wxyz = quaternion_from_euler_arrays(*angles)
    return times, [q_wxyz[:, 1], q_wxyz[:, 2], q_wxyz[:, 3], q_wxyz[:, 0]]


def _poses(place: Samples, attitude: Samples) -> list[Topic]:
    """/glider/pose: the hull in `map_ned` at the times that position and attitude share."""
    times = np.intersect1d(place[0], attitude[0], assume_unique=True)
    columns = [column[np.searchsorted(at, times)] for at, values in (place, attitude) for column in values]
    return [shapes.poses((times, columns))] if times.size else []
