"""How does the vehicle move in Rerun? Through every sample of its track, with its attitude and its movable mass.

A log may come in pieces: `hull` draws what is known from the first, `moving` what moves in each. What stands still and
can be told only after the last is drawn from what is kept, which does not grow with the log.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import quaternion_from_euler_arrays
from glidercli.log import Log
from glidercli.logio.drawable import slide_zero
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.chart import on_chart
from glidercli.logio.rerun.hull import hull, rail
from glidercli.logio.rerun.settling import columns, row
from glidercli.logio.stretches import Stretches
from glidercli.logio.thinned import Thinned
from glidercli.places import geodetic_of_track, track_of_geodetic

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["MOST_POINTS", "Scene"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
MOST_POINTS = 20_000
"""Points of a drawn track; longer ones are thinned evenly. The vehicle itself moves through every sample."""
MAPPED = 2_000
"""Places of the vehicle on the map, of a piece at most."""
ANGLES = ("roll", "pitch", "heading")


class Scene:
    """All of one log under an entity of its own, in NED, m.

    log : the first piece; what has samples there is what can come. zero_ns : where elapsed begins, UTC ns.
    world : the entity. about : latitude and longitude, deg, that places are drawn about; default: the log's origin.
    moved : m to the north and to the east that all but the map is drawn away from where it was.
    has_hull : whether the attitude is known. track : Thinned rows of north, east, down, m, the phase's code, and the
    number of the stretch. stretches : of the track. currents : Thinned rows of place and current, north and east.
    positions : Thinned rows of latitude and longitude.
    """

    def __init__(
        self,
        log: Log,
        zero_ns: int,
        world: str = "/world",
        colour: look.Colour | None = None,
        about: tuple[float, float] | None = None,
        moved: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self._log, self._zero_ns, self._world, self._colour = log, zero_ns, world, colour
        own = log.place
        self._about = about if own is not None and about is not None else own
        self._own = None if about is None or about == own else own
        self._moved = np.array([*moved, 0.0])
        self._names = ("north", "east", "down" if "down" in log else "depth")
        self.has_hull = len(log.together(*ANGLES)[0]) > 0
        self.track, self.positions, self.currents = (Thinned(MOST_POINTS) for _ in range(3))
        self.stretches = Stretches(log, self._names[2])
        self._phase: float | None = None
        self._held: tuple[Times, Array] | None = None
        self._slid = (np.inf, -np.inf)

    @property
    def map(self) -> str:
        """Entity of what it shows on the map."""
        return f"/map{self._world.removeprefix('/world')}"

    @property
    def vehicle(self) -> str:
        """Entity of the vehicle."""
        return f"{self._world}/vehicle"

    def hull(self) -> Iterator[Chunk]:
        """What is known from the start: axes, and the hull with all that moves in it."""
        import rerun as rr

        yield row("/world", rr.ViewCoordinates.FRD)
        plumb = rr.LineStrips3D([[[0, 0, 0], [0, 0, -1]]], colors=look.PLUMB, radii=rr.Radius.ui_points(0.8))
        yield row(f"{self.vehicle}/plumb", plumb)
        if self._about is not None:
            style = rr.GeoPoints.from_fields(colors=self._colour or look.GOLD, radii=rr.Radius.ui_points(6))
            yield row(f"{self.map}/vehicle", style)
        if self.has_hull:
            yield from hull(self._log, self.vehicle, self._colour)

    def moving(self, piece: Log) -> Iterator[Chunk]:
        """The vehicle's place, attitude and movable mass in a piece, which is also kept."""
        import rerun as rr

        times, places = self.places(piece)
        self._keep(piece, times, places)
        if len(times):
            yield self._over(self.vehicle, times, rr.Transform3D.columns(translation=places + self._moved))
            tall = np.ones((len(times), 3))
            tall[:, 2] = np.maximum(places[:, 2], 0.01)  # a scale of nothing is none
            yield self._over(f"{self.vehicle}/plumb", times, rr.Transform3D.columns(scale=tall))
            if self._about is not None:
                some = np.unique(np.linspace(0, len(times) - 1, MAPPED).round().astype(np.int64))
                spots = on_chart(places[some, 0], places[some, 1], self._about)
                yield self._over(f"{self.map}/vehicle", times[some], rr.GeoPoints.columns(positions=spots))
        if not self.has_hull:
            return
        times, (roll, pitch, heading) = piece.together(*ANGLES)
        course, none = f"{self.vehicle}/course", np.zeros(len(times))
        if len(times):
            yield self._over(course, times, _turned(none, none, heading))
            yield self._over(f"{course}/body", times, _turned(roll, pitch, none))
        slide, turned = piece.channels.get("mass_position"), piece.channels.get("mass_rotation")
        if slide is not None and len(slide):
            self._slid = min(self._slid[0], float(slide.values.min())), max(self._slid[1], float(slide.values.max()))
            shift = np.outer(slide.values - slide_zero(self._log), [1, 0, 0])
            yield self._over(f"{course}/body/slide", slide.time_ns, rr.Transform3D.columns(translation=shift))
        if turned is not None and len(turned):
            none = np.zeros(len(turned))
            yield self._over(f"{course}/body/slide/turn", turned.time_ns, _turned(turned.values, none, none))

    def places(self, piece: Log) -> tuple[Times, Array]:
        """Times at which the place is known, UTC ns, and the places, (n, 3), north, east, down, m."""
        times, (north, east, down) = piece.together(*self._names)
        if self._own is not None and self._about is not None and len(times):
            north, east = track_of_geodetic(*geodetic_of_track(north, east, *self._own), *self._about)
        return times, np.stack([north, east, down], axis=-1)

    def drawn_track(self) -> Array:
        """Rows of ``track`` as they are drawn."""
        rows = self.track.rows()
        return np.column_stack([rows[:, :3] + self._moved, rows[:, 3:]]) if len(rows) else rows

    def rail(self) -> list[Chunk]:
        """The line that the mass slides on, as far as it slid."""
        return [rail(self._log, self.vehicle, self._slid)] if self.has_hull and self._slid[0] <= self._slid[1] else []

    def fixes(self, log: Log) -> tuple[Array, Array]:
        """Recorded positions: in NED, at the surface, (n, 3), m, and on the map, (n, 2), deg; none without a place.

        log : the last piece, with its metadata.
        """
        rows = self.positions.rows()
        about = self._about or log.place
        if not len(rows) or self._log["latitude"].origin != "measured" or (about is None and self.track.count):
            return np.empty((0, 3)), np.empty((0, 2))
        about = about or (float(rows[0, 0]), float(rows[0, 1]))
        north, east = track_of_geodetic(rows[:, 0], rows[:, 1], *about)
        turned = about[1] + 180.0 - np.mod(180.0 - (rows[:, 1] - about[1]), 360.0)
        return np.stack([north, east, 0.0 * north], axis=-1), np.stack([rows[:, 0], turned], axis=-1)

    def on_map(self) -> tuple[Array, Array]:
        """The track on the map, (n, 2), deg, and the stretch that each place is in, (n,); none without an origin."""
        rows = self.track.rows()
        if not self._about or not len(rows):
            return np.empty((0, 2)), np.empty(0)
        return on_chart(rows[:, 0], rows[:, 1], self._about), rows[:, 4]

    def _over(self, entity: str, times: Times, values: Any) -> Chunk:
        return columns(entity, self._zero_ns, times, values)

    def _keep(self, piece: Log, times: Times, places: Array) -> None:
        """Keep of a piece what the track, the fixes and the current are drawn from."""
        codes = np.full(len(times), np.nan if self._phase is None else self._phase)
        if "phase" in piece and len(piece["phase"]):
            phases = piece["phase"]
            at = np.searchsorted(phases.time_ns, times, side="right") - 1
            first = phases.values[0] if self._phase is None else self._phase
            codes = np.where(at < 0, first, phases.values[np.maximum(at, 0)])
            self._phase = float(phases.values[-1])
        self.track.add(np.column_stack([places, codes, self.stretches.of(times)]))
        self.positions.add(np.stack(piece.together("latitude", "longitude")[1], axis=-1))
        told, (north, east) = piece.together("current_north", "current_east")
        if self._held is not None:
            times, places = np.concatenate([self._held[0], times]), np.concatenate([self._held[1], places])
        if len(times):
            self._held = times[-1:], places[-1:]
        if len(told) and len(times):
            right = np.clip(np.searchsorted(times, told), min(1, len(times) - 1), len(times) - 1)
            left = np.maximum(right - 1, 0)
            near = np.where(told - times[left] < times[right] - told, left, right)
            self.currents.add(np.column_stack([places[near], north, east]))


def _turned(roll: Array, pitch: Array, heading: Array) -> Any:
    """Rotations as columns of transforms; rad."""
    import rerun as rr

    return rr.Transform3D.columns(quaternion=quaternion_from_euler_arrays(roll, pitch, heading)[:, [1, 2, 3, 0]])
