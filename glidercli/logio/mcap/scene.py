"""What does a viewer show of a log? The vehicle with all that moves in it, its way, the sea surface, the current.

The position is north, east, down, or the depth alone below the origin. Attitude is there where roll, pitch and heading
are sampled at one time. /tf has a transform at each sample of either, from when all that the log has is known, and
repeats the latest of the other, as a viewer would; /glider/pose has only true pairs. What stands still is written once,
at a time with a transform: what is known from the first piece with it, what only the whole can tell at the end.
"""

from __future__ import annotations

import numpy as np

from glidercli.channels import PHASES
from glidercli.frames import quaternion_from_euler_arrays
from glidercli.log import Log
from glidercli.logio.drawable import bottom, hull_size, mass_notes, slide_zero
from glidercli.logio.mcap import hull, shapes, still
from glidercli.logio.mcap.averages import averages
from glidercli.logio.mcap.file import Topic
from glidercli.logio.mcap.latest import FOREVER, Latest, at_these, moving
from glidercli.logio.mcap.messages import Array
from glidercli.logio.mcap.shapes import Samples
from glidercli.logio.mcap.side import ALONE, Side
from glidercli.logio.stretches import Stretches
from glidercli.logio.thinned import Thinned
from glidercli.places import track_of_geodetic

__all__ = ["Scene"]

MOST_POINTS = 20_000
"""Points of a drawn track; longer ones are thinned evenly. The samples themselves are in /glider/navigation."""
TRACK, ANGLES = ("north", "east", "down"), ("roll", "pitch", "heading")
LEVEL = (0.0, 0.0, 0.0, 1.0)
"""Quaternion x, y, z, w of a hull that is level and heads north."""


class Scene:
    """What viewers draw of a log that comes in pieces.

    log : the first piece; what has samples there is what can come. side : which of the flights in the file it is. Of
    one that stands beside another the surroundings are not drawn: those of the first are there.
    """

    def __init__(self, log: Log, side: Side = ALONE) -> None:
        self._side = side
        placed = any(len(log.together(*names)[0]) for names in (TRACK, ("depth",)))
        self._place, self._attitude = Latest(placed), Latest(len(log.together(*ANGLES)[0]) > 0)
        self._slide, self._turn, self._phase = (
            Latest(name in log and len(log[name]) > 0) for name in ("mass_position", "mass_rotation", "phase")
        )
        self._log_ns = log.start_ns if any(map(len, log.channels.values())) else 0
        self._size, self._kind, self._zero = hull_size(log), log.kind, slide_zero(log)
        self._mass_notes, self._steered = mass_notes(log), "rudder_angle" in log and len(log["rudder_angle"]) > 0
        self._start_ns: int | None = None  # of all that moves
        self._changed_ns = 0  # when the phase did so last
        self._bounds = np.array([[np.inf] * 3, [-np.inf] * 3])
        self._level = 0.0  # of the sea surface in map_ned, m
        self._told: list[str] = []
        self._stretches, self._on_map = Stretches(log, "down"), Stretches(log, "north")
        self._track, self._way, self._fixes, self._currents = (Thinned(MOST_POINTS) for _ in range(4))

    def topics(self, piece: Log) -> list[Topic]:
        """A piece's messages of the topics that the log has data for; transforms first."""
        topics: list[Topic] = self._phases(piece)
        fixes = piece.together("latitude", "longitude")
        self._keep(piece, fixes)
        if fixes[0].size:
            topics.append(shapes.fixes(fixes, -at_these(piece, "depth", fixes[0], np.nan)))
        place, attitude = _place(piece), _attitude(piece)
        times = moving([(self._place, place), (self._attitude, attitude)])
        if times.size:
            motion = times, [*self._place.at(times, (0.0, 0.0, 0.0)), *self._attitude.at(times, LEVEL)]
            moved = shapes.transforms(motion, self._side), shapes.places(motion, self._side)
            topics = [*moved, *_poses(place, attitude), *topics]
            if self._start_ns is None:
                self._start_ns = int(times[0])
                vehicle = hull.vehicle(self._size, self._kind, self._start_ns, self._side)
                topics = [shapes.static(self._log_ns), *topics, vehicle]
        start_ns = FOREVER if self._start_ns is None else self._start_ns
        return [*topics, *self._inside(piece, start_ns), *self._current(piece, start_ns)]

    def lines(self, log: Log, start_ns: int) -> list[Topic]:
        """The topics that show the whole way, when the last piece is there. log : that piece, with its metadata."""
        topics: list[Topic] = [*shapes.map_track(log, self._way.rows(), self._fixes.rows(), start_ns, self._side)]
        if self._phase.known and self._phase.last_ns > self._changed_ns:  # viewers draw a phase up to its next message
            end = np.array([self._phase.last_ns])
            topics.append(shapes.phases(end, [_word(code) for code in self._phase.at(end)[0].tolist()]))
        if self._start_ns is None:
            return topics
        size = float(np.linalg.norm(self._bounds[1] - self._bounds[0])) if self._place.known else 0.0
        if self._track.count:
            way = self._track.rows(), self._track.count, log["north"].origin
            topics.append(still.track(*way, self._stretches.told(), self._start_ns, self._side))
        if self._side.place:
            return topics
        if self._place.known:
            topics += still.surface(self._bounds, self._level, self._start_ns)
            if (depth := bottom(log)) is not None:
                topics += still.bottom(self._bounds, self._level, depth, self._start_ns)
        marks = self._marks(log)
        if len(marks):
            topics.append(still.fix_marks(marks, self._fixes.count, size, self._start_ns))
        profile, told = still.current_profile(self._currents.rows(), size, self._start_ns)
        average, also = self._average(log, size, self._start_ns)
        self._told = [words for words in (told, also) if words]
        return [*topics, *profile, *average]

    def remarks(self) -> list[str]:
        """What a viewer of the scene must know: what in it is not from the log, or not to scale."""
        if self._start_ns is None:
            return []
        length, diameter, to_scale = self._size
        scale = "" if to_scale else ": not to scale"
        said = [f"the hull is drawn {length} m x {diameter} m{scale}; wings, fin and rudder are a sketch"]
        if not self._attitude.known:
            said.append("no attitude in this log: the hull is drawn level, heading north")
        if self._currents.count:
            said.append(f"the arrow at the hull is the current, {shapes.ARROW_SCALE:.0f} m long for 1 m/s")
        if gaps := self._stretches.told():
            said.append(f"the track is broken at {gaps}")
        return [*said, *self._mass_notes, *self._told]

    @property
    def bounds(self) -> Array:
        """Least and greatest north, east, down of the flight so far, (2, 3), m; infinite without a place."""
        return self._bounds

    def make_room(self, bounds: Array) -> None:
        """Let the sea surface reach over another flight, too. bounds : of that, (2, 3), m."""
        if self._place.known:
            self._bounds = np.stack([np.minimum(self._bounds[0], bounds[0]), np.maximum(self._bounds[1], bounds[1])])

    def _keep(self, piece: Log, fixes: Samples) -> None:
        """Keep of a piece what the whole way is drawn from."""
        times, track = piece.together(*TRACK)
        codes = self._phase.at(times, (np.nan,))[0]
        self._track.add(np.column_stack([*track, codes, times, self._stretches.of(times)]))
        level_ns, level = piece.together(*TRACK[:2])
        self._way.add(np.column_stack([*level, self._on_map.of(level_ns)]))
        self._fixes.add(np.stack(fixes[1], axis=-1))
        places = np.stack(_place(piece)[1], axis=-1)
        if len(places):
            if np.isinf(self._bounds).all():
                _, (down, depth) = piece.together("down", "depth")
                self._level = float(down[0] - depth[0]) if len(down) else 0.0
            least, most = places.min(axis=0), places.max(axis=0)
            least[2], most[2] = min(least[2], self._level), max(most[2], self._level)  # the surface is part of it
            self._bounds = np.stack([np.minimum(self._bounds[0], least), np.maximum(self._bounds[1], most)])

    def _phases(self, piece: Log) -> list[Topic]:
        """/viz/phase: each change of the phase, in words."""
        if "phase" not in piece or not len(piece["phase"]):
            return []
        times, codes = piece["phase"].time_ns, piece["phase"].values
        before = self._phase.at(times[:1], (np.nan,))[0]
        self._phase.add((times, [codes]))
        changed = np.flatnonzero(codes != np.concatenate([before, codes[:-1]]))
        if not changed.size:
            return []
        self._changed_ns = int(times[changed[-1]])
        return [shapes.phases(times[changed], [_word(code) for code in codes[changed].tolist()])]

    def _inside(self, piece: Log, start_ns: int) -> list[Topic]:
        """What moves in the hull, or at it: the movable mass and the rudder."""
        topics: list[Topic] = []
        slide, turn = piece.together("mass_position"), piece.together("mass_rotation")
        times = moving([(self._slide, slide), (self._turn, turn)], start_ns)
        if times.size:
            (position,), (rotation,) = self._slide.at(times, (self._zero,)), self._turn.at(times, (0.0,))
            topics.append(hull.movable_mass(times, position - self._zero, rotation, self._size, self._side))
        if self._steered:
            times, (angle,) = piece.together("rudder_angle")
            seen = times >= start_ns
            if seen.any():
                topics.append(hull.rudder(times[seen], angle[seen], self._size, self._side))
        return topics

    def _current(self, piece: Log, start_ns: int) -> list[Topic]:
        """The current about the hull; an unsampled upward part is zero."""
        times, current = piece.together("current_east", "current_north")
        seen = times >= start_ns
        times = times[seen]
        if not times.size or not self._place.known or self._side.place:
            return []
        east, north = (column[seen] for column in current)
        up, place = at_these(piece, "current_up", times, 0.0), self._place.at(times)
        self._currents.add(np.column_stack([*place, north, east, -up]))
        return [shapes.current(times, place, [east, north, up])]

    def _average(self, log: Log, size: float, time_ns: int) -> tuple[list[Topic], str]:
        """Depth-averaged currents that the log tells, at the surface above the middle of their dives."""
        (rows, origin), track = averages(log), self._track.rows()
        if not len(rows) or not len(track):
            return [], ""
        middle = 0.5 * (track[0, 4] + track[-1, 4])
        at = np.where(np.isnan(rows[:, 0]), middle, rows[:, 0])
        inside = (at >= track[0, 4]) & (at <= track[-1, 4])
        north, east = (np.interp(at[inside], track[:, 4], track[:, i]) for i in (0, 1))
        flat = np.zeros(len(north))
        placed = np.column_stack([north, east, flat + self._level, rows[inside, 1:], flat])
        drawn, told = still.current_average(placed, origin, size, time_ns)
        return list(drawn), told

    def _marks(self, log: Log) -> Array:
        """Measured fixes as north and east of the origin, (n, 2), m; none where they cannot be placed."""
        counted_from, fixes = log.place, self._fixes.rows()
        if not len(fixes) or log["latitude"].origin != "measured":
            return np.empty((0, 2))
        if counted_from is None:
            if self._track.count:
                return np.empty((0, 2))
            counted_from = tuple(fixes[0].tolist())
        places = np.stack(track_of_geodetic(fixes[:, 0], fixes[:, 1], *counted_from), axis=-1)
        return places[np.isfinite(places).all(axis=-1)]


def _word(code: float) -> str:
    """A phase in words."""
    return PHASES[int(code)] if code in range(len(PHASES)) else "unknown"


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
