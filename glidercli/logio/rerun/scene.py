"""What does a Log look like in three dimensions? Track, sea surface, fixes, current, hull, movable mass; for Rerun.

A log may come in pieces: `hull` draws what is known from the first, `moving` what moves in each, `still` what stands
still and can be told only after the last.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import quaternion_from_euler_arrays
from glidercli.log import Log
from glidercli.logio.drawable import number
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun import shapes
from glidercli.logio.rerun.settling import columns, row
from glidercli.logio.rerun.shapes import Camera
from glidercli.logio.thinned import Thinned
from glidercli.places import track_of_geodetic

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Scene"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
MOST_POINTS = 20_000
"""Points of a drawn track; longer ones are thinned evenly. The vehicle itself moves through every sample."""
ANGLES = ("roll", "pitch", "heading")


class Still(NamedTuple):
    """What is drawn of the whole of a log."""

    chunks: list[Chunk]
    notes: list[str]
    """What a reader of the pictures should know."""
    camera: Camera | None
    """Where the whole track is seen from; None without one."""
    has_plan: bool
    """Whether there is anything to show from above."""


class Scene:
    """All under /world (NED, m) and /plan (the same from above).

    log : the first piece; what has samples there is what can come.
    zero_ns : where the timeline elapsed begins, UTC ns. has_hull : whether the attitude is known.
    """

    def __init__(self, log: Log) -> None:
        self._log, self.zero_ns = log, log.start_ns
        self._names = ("north", "east", "down" if "down" in log else "depth")
        self.has_hull = len(log.together(*ANGLES)[0]) > 0
        self._track, self._fixed, self._current = (Thinned(MOST_POINTS) for _ in range(3))
        self._phase: float | None = None
        self._held: tuple[Times, Array] | None = None

    def hull(self) -> Iterator[Chunk]:
        """What is known from the start: axes, and the hull with all that moves in it."""
        import rerun as rr

        yield row("/world", rr.ViewCoordinates.FRD)
        if self.has_hull:
            yield from shapes.hull(self._log)

    def moving(self, piece: Log) -> Iterator[Chunk]:
        """The vehicle's place, attitude and movable mass in a piece, which is also kept for ``still``."""
        import rerun as rr

        times, track = piece.together(*self._names)
        places = np.stack(track, axis=-1)
        self._keep(piece, times, places)
        if len(times):
            yield self._over("/world/vehicle", times, rr.Transform3D.columns(translation=places))
            yield self._over("/plan/vehicle", times, rr.Points2D.columns(positions=places[:, 1::-1] * [1, -1]))
        if not self.has_hull:
            return
        times, angles = piece.together(*ANGLES)
        if len(times):
            turn = quaternion_from_euler_arrays(*angles)[:, [1, 2, 3, 0]]
            yield self._over(shapes.BODY, times, rr.Transform3D.columns(quaternion=turn))
        slide, turned = piece.channels.get("mass_position"), piece.channels.get("mass_rotation")
        if slide is not None and len(slide):
            shift = np.outer(slide.values - shapes.slide_zero(self._log), [1, 0, 0])
            yield self._over(shapes.SLIDE, slide.time_ns, rr.Transform3D.columns(translation=shift))
        if turned is not None and len(turned):
            half = turned.values / 2
            spin = np.outer(np.sin(half), [1, 0, 0, 0]) + np.outer(np.cos(half), [0, 0, 0, 1])
            yield self._over(f"{shapes.SLIDE}/turn", turned.time_ns, rr.Transform3D.columns(quaternion=spin))

    def _over(self, entity: str, times: Times, values: Any) -> Chunk:
        return columns(entity, self.zero_ns, times, values)

    def _keep(self, piece: Log, times: Times, places: Array) -> None:
        """Keep of a piece what the track, the fixes and the current are drawn from."""
        codes = np.full(len(times), np.nan if self._phase is None else self._phase)
        if "phase" in piece and len(piece["phase"]):
            phases = piece["phase"]
            at = np.searchsorted(phases.time_ns, times, side="right") - 1
            first = phases.values[0] if self._phase is None else self._phase
            codes = np.where(at < 0, first, phases.values[np.maximum(at, 0)])
            self._phase = float(phases.values[-1])
        self._track.add(np.column_stack([places, codes]))
        self._fixed.add(np.stack(piece.together("latitude", "longitude")[1], axis=-1))
        told, (north, east) = piece.together("current_north", "current_east")
        if self._held is not None:
            times, places = np.concatenate([self._held[0], times]), np.concatenate([self._held[1], places])
        if len(times):
            self._held = times[-1:], places[-1:]
        if len(told) and len(times):
            up = piece.channels.get("current_up")
            down = -np.interp(told, up.time_ns, up.values) if up is not None and len(up) else np.zeros(len(told))
            right = np.clip(np.searchsorted(times, told), min(1, len(times) - 1), len(times) - 1)
            left = np.maximum(right - 1, 0)
            near = np.where(told - times[left] < times[right] - told, left, right)
            self._current.add(np.column_stack([places[near], north, east, down]))

    def still(self, log: Log) -> Still:
        """What is drawn of the whole. log : the last piece, with its metadata."""
        import rerun as rr

        chunks: list[Chunk] = []
        notes = ["Depth is plotted negative down; plots join samples by straight lines."]
        track, fixes = self._track.rows(), self._fixes(log)
        camera = None
        if self._track.count > 1:
            places = track[:, :3]
            bounds = np.stack([np.minimum(places.min(axis=0), [np.inf, np.inf, 0]), places.max(axis=0)])
            size = max(float(np.linalg.norm(bounds[1] - bounds[0])), 1.0)
            camera = shapes.camera(places, bounds, size)
            for draw in (shapes.track(track, size), shapes.surface(bounds), shapes.arrows(self._current.rows(), size)):
                chunks += draw[0]
                notes += draw[1]
        elif self.has_hull:
            notes.append("The log has no track: the hull turns in one place.")
        if len(fixes):
            chunks += shapes.points("fixes", fixes, radii=rr.Radius.ui_points(4), colors=look.VIOLET)
            notes.append(f"Violet points at the surface: {self._fixed.count} recorded positions.")
        if self.has_hull:
            notes += shapes.hull_notes(self._log)
        return Still(chunks, notes, camera, camera is not None or len(fixes) > 0)

    def _fixes(self, log: Log) -> Array:
        """Recorded positions at the surface in NED about the log's origin, m; none where they cannot be placed."""
        latitude, longitude = self._fixed.rows().T if self._fixed.count else (np.array([]), np.array([]))
        told = [number(log, f"origin_{name}_deg") for name in ("latitude", "longitude")]
        unplaced = None in told and self._track.count
        if unplaced or not len(latitude) or self._log["latitude"].origin != "measured":
            return np.empty((0, 3))
        origin = [latitude[0], longitude[0]] if None in told else told
        north, east = track_of_geodetic(latitude, longitude, *origin)
        return np.stack([north, east, np.zeros_like(north)], axis=-1)
