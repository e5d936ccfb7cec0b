"""What does a Log look like in three dimensions? Track, sea surface, fixes, current, hull, movable mass; for Rerun."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import quaternion_from_euler_arrays
from glidercli.log import Log
from glidercli.logio.drawable import hull_size, number
from glidercli.logio.rerun import blueprint as look
from glidercli.places import track_of_geodetic

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Scene", "columns"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

ARROWS = 30  # depth bins with one current arrow each


def columns(entity: str, start_ns: int, time_ns: Times, values: Any) -> Chunk:
    """Values of one entity over time, on both timelines."""
    import rerun as rr
    from rerun.chunk import Chunk

    utc = rr.TimeColumn("utc", timestamp=time_ns.astype("datetime64[ns]"))
    elapsed = rr.TimeColumn("elapsed", duration=(time_ns - start_ns).astype("timedelta64[ns]"))
    return Chunk.from_columns(entity, [utc, elapsed], values)


class Scene:
    """Everything under /world (NED, m) and /plan (the same from above), as chunks.

    bounds : (2, 3) least and greatest corner of the track and the surface above it, NED, m; None without a track.
    camera : the eye that sees the whole track, and the point that it looks at, NED, m; None without a track.
    has_hull, has_plan : whether the attitude is known, and anything to show from above.
    """

    def __init__(self, log: Log) -> None:
        self.log = log
        self.chunks: list[Chunk] = []
        self.times, track = log.together("north", "east", "down" if "down" in log else "depth")
        self.track = np.stack(track, axis=-1)
        self.attitude_times, self.attitude = log.together("roll", "pitch", "heading")
        self.fixes = self._fixes()
        self.has_hull, self.has_plan = len(self.attitude_times) > 0, len(self.times) > 1 or len(self.fixes) > 0
        self.bounds: Array | None = None
        self.camera: tuple[Array, Array] | None = None
        if len(self.times) > 1:
            self.bounds = np.stack([np.minimum(self.track.min(axis=0), [np.inf, np.inf, 0]), self.track.max(axis=0)])
            self.size = max(float(np.linalg.norm(self.bounds[1] - self.bounds[0])), 1.0)
            self.camera = self._camera(self.bounds)

    def _camera(self, bounds: Array) -> tuple[Array, Array]:
        """An eye above the water that sees a long track from its southern side, a compact one from the south-west."""
        level = self.track[:, :2] - self.track[:, :2].mean(axis=0)
        spread, axes = np.linalg.eigh(level.T @ level)
        eye = np.array([-0.6, -0.6, -0.71])
        if spread[0] < 0.3 * spread[1]:
            along = axes[:, 1] if axes[1, 1] > 0 else -axes[:, 1]  # eastward
            across = np.array([-abs(along[1]), np.sign(along[1]) * along[0]])  # southward
            eye = np.array([*(0.9 * across - 0.33 * along), -0.51])
        middle = bounds.mean(axis=0)
        return middle + self.size * eye, middle

    def draw(self) -> list[str]:
        """Draw all that the log has the channels for; returns what a reader of the pictures should know."""
        import rerun as rr

        notes = ["Depth is plotted negative down; plots join samples by straight lines."]
        self._add("/world", rr.ViewCoordinates.FRD)
        if self.bounds is not None:
            notes += [*self._draw_track(), self._draw_surface(self.bounds), *self._draw_current()]
        elif self.has_hull:
            notes.append("The log has no track: the hull turns in one place.")
        if len(self.fixes):
            self._points("fixes", self.fixes, radii=rr.Radius.ui_points(4), colors=look.VIOLET)
            notes.append(f"Violet points at the surface: {len(self.fixes)} recorded positions.")
        return notes + self._draw_hull() if self.has_hull else notes

    def _add(self, entity: str, *archetypes: Any) -> None:
        self.chunks.append(look.row(entity, *archetypes))

    def _points(self, name: str, places: Array, **style: Any) -> None:
        """The same points in /world and, seen from above (east right, north up), in /plan."""
        import rerun as rr

        self._add(f"/world/{name}", rr.Points3D(places, **style))
        self._add(f"/plan/{name}", rr.Points2D(places[:, 1::-1] * [1, -1], **style))

    def _over_time(self, entity: str, times: Times, values: Any) -> None:
        self.chunks.append(columns(entity, self.log.start_ns, times, values))

    def _fixes(self) -> Array:
        """Recorded positions at the surface in NED about the log's origin, m; none where they cannot be placed."""
        _, (latitude, longitude) = self.log.together("latitude", "longitude")
        told = [number(self.log, f"origin_{name}_deg") for name in ("latitude", "longitude")]
        unplaced = None in told and len(self.times)
        if unplaced or not len(latitude) or self.log["latitude"].origin != "measured":
            return np.empty((0, 3))
        origin = [latitude[0], longitude[0]] if None in told else told
        north, east = track_of_geodetic(latitude, longitude, *origin)
        return np.stack([north, east, np.zeros_like(north)], axis=-1)

    def _draw_track(self) -> list[str]:
        """The track in the colours of its phases, or of depth; its ends; a marker at the vehicle's place."""
        import rerun as rr

        codes, colours, note = self._track_colours()
        edges = [0, *(np.flatnonzero(np.diff(codes)) + 1), len(codes) - 1]
        pieces = [(a, b) for a, b in itertools.pairwise(edges) if b > a]
        strips, paint = [self.track[a : b + 1] for a, b in pieces], [colours[codes[a]] for a, _ in pieces]
        style: dict[str, Any] = {"colors": paint, "radii": rr.Radius.ui_points(1.2)}
        self._add("/world/track", rr.LineStrips3D(strips, **style))
        self._add("/plan/track", rr.LineStrips2D([strip[:, 1::-1] * [1, -1] for strip in strips], **style))
        near = np.linalg.norm(self.track[0] - self.track[-1]) < 0.25 * self.size
        ends = {"labels": ["start", "" if near else "end"], "colors": [look.GREEN, look.RED]}
        self._points("ends", self.track[[0, -1]], radii=rr.Radius.ui_points(5), **ends)
        self._over_time("/world/vehicle", self.times, rr.Transform3D.columns(translation=self.track))
        marker: dict[str, Any] = {"radii": rr.Radius.ui_points(7), "colors": look.GOLD}
        self._add("/world/vehicle/marker", rr.Points3D([[0, 0, 0]], **marker))
        self._over_time("/plan/vehicle", self.times, rr.Points2D.columns(positions=self.track[:, 1::-1] * [1, -1]))
        self._add("/plan/vehicle", rr.Points2D.from_fields(**marker))
        return [f"{note} It starts at the green point and ends at the red one."]

    def _track_colours(self) -> tuple[NDArray[np.int64], list[look.Colour], str]:
        """A colour code for each point of the track, the colours, and what they mean."""
        phases = self.log.channels.get("phase")
        if phases is not None:
            at = np.maximum(np.searchsorted(phases.time_ns, self.times, side="right") - 1, 0)
            meaning = "Track: dive blue, climb orange, surface green, hover violet, inflection gold."
            return phases.values[at].astype(np.int64), [*look.PHASE_COLOURS.values()], meaning
        deepest = max(float(self.track[:, 2].max()), 1.0)
        colours = [(200 - 4 * i, 240 - 6 * i, 245 - 2 * i) for i in range(32)]
        meaning = f"Track coloured by depth, light at the surface, dark at {deepest:.0f} m."
        return np.clip(self.track[:, 2] / deepest * 31, 0, 31).astype(np.int64), colours, meaning

    def _draw_surface(self, bounds: Array) -> str:
        """The sea surface over the track, translucent, with a grid."""
        import rerun as rr

        middle, extent = bounds.mean(axis=0)[:2], bounds[1] - bounds[0]
        side = np.maximum(np.maximum(1.1 * extent[:2], 0.4 * extent.max()) / 2, 1.0)
        power = 10.0 ** np.floor(np.log10(side.max() / 3))
        spacing = float(power * max(step for step in (1, 2, 5) if step * power <= side.max() / 3))
        south, west = np.floor((middle - side) / spacing) * spacing
        north, east = np.ceil((middle + side) / spacing) * spacing
        corners = [(south, west, 0), (north, west, 0), (north, east, 0), (south, east, 0)]
        plane = dict[str, Any](vertex_positions=corners, triangle_indices=[[0, 1, 2], [0, 2, 3]])
        self._add("/world/surface", rr.Mesh3D(albedo_factor=look.SEA, **plane))
        lines = [[(n, west, 0), (n, east, 0)] for n in np.arange(south, north + spacing / 2, spacing)]
        lines += [[(south, e, 0), (north, e, 0)] for e in np.arange(west, east + spacing / 2, spacing)]
        self._add("/world/surface/grid", rr.LineStrips3D(lines, colors=look.SEA_LINES, radii=rr.Radius.ui_points(0.5)))
        return f"The sea surface carries a grid of {spacing:g} m."

    def _draw_current(self) -> list[str]:
        """One arrow in each of the depth bins, at the track's nearest point in time."""
        import rerun as rr

        times, (north, east) = self.log.together("current_north", "current_east")
        if not len(times):
            return []
        up = self.log.channels.get("current_up")
        down = -np.interp(times, up.time_ns, up.values) if up is not None else np.zeros(len(times))
        right = np.clip(np.searchsorted(self.times, times), 1, len(self.times) - 1)
        origins = self.track[right - (times - self.times[right - 1] < self.times[right] - times)]
        _, kept = np.unique((origins[:, 2] / max(origins[:, 2].max(), 1e-9) * ARROWS).astype(int), return_index=True)
        vectors = np.stack([north, east, down], axis=-1)[kept]
        fastest = float(np.linalg.norm(vectors, axis=1).max())
        vectors *= 0.13 * self.size / max(fastest, 1e-9)
        places = dict[str, Any](vectors=vectors, origins=origins[kept], radii=rr.Radius.ui_points(1.5))
        self._add("/world/current", rr.Arrows3D(colors=look.TEAL, **places))
        return [f"Teal arrows: current, one in each of {ARROWS} depth bins; the longest is {fastest:.2f} m/s."]

    def _draw_hull(self) -> list[str]:
        """Hull, wings, tail and movable mass in the body frame, and a compass that stays level."""
        import rerun as rr

        length, diameter, own = hull_size(self.log)
        half, body = diameter / 2, "/world/vehicle/body"
        turn = quaternion_from_euler_arrays(*self.attitude)[:, [1, 2, 3, 0]]
        self._over_time(body, self.attitude_times, rr.Transform3D.columns(quaternion=turn))
        place: dict[str, Any] = {"translations": [[half - length / 2, 0, 0]], "fill_mode": "solid"}
        place["rotation_axis_angles"] = rr.RotationAxisAngle(axis=[0, 1, 0], degrees=90)
        self._add(f"{body}/hull", rr.Capsules3D(lengths=length - diameter, radii=half, colors=look.HULL, **place))
        tip, top = half + 0.3 * length, -1.3 * diameter
        wing = [(-0.10, half, 0), (-0.23, half, 0), (-0.31, tip, 0), (-0.26, tip, 0)]
        fin = [(-0.34, 0, 0), (-0.48, 0, 0), (-0.54, 0, top), (-0.46, 0, top)]
        corners = np.array([*wing, *((x, -y, z) for x, y, z in wing), *fin], dtype=float) * [length, 1, 1]
        triangles = [(base, base + i, base + i + 1) for base in (0, 4, 8) for i in (1, 2)]
        mesh = dict[str, Any](vertex_positions=corners, triangle_indices=triangles)
        self._add(f"{body}/fins", rr.Mesh3D(albedo_factor=look.FINS, **mesh))
        edges = [corners[[*range(base, base + 4), base]] for base in (0, 4, 8)]  # they show where a fin is seen edge on
        self._add(f"{body}/fins/edges", rr.LineStrips3D(edges, colors=look.FINS, radii=rr.Radius.ui_points(1.5)))
        angle = np.linspace(0.0, 2 * np.pi, 73)
        ring = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1) * 0.62 * length
        ticks = [np.stack([point, 1.06 * point]) for point in ring[:-1:6]]
        style = dict[str, Any](colors=look.GREY, radii=rr.Radius.ui_points(0.7))
        self._add("/world/vehicle/compass", rr.LineStrips3D([ring, *ticks], **style))
        self._add(
            "/world/vehicle/compass/names",
            rr.Points3D(1.15 * ring[:-1:18], labels=list("NESW"), show_labels=True, **style),
        )
        doubt = "" if own else " NOT TO SCALE: the log does not say the vehicle's size."
        note = f"Hull drawn {length:g} m x {diameter:g} m; wings and tail are only a sketch.{doubt}"
        moves = {"mass_position", "mass_rotation"} & self.log.channels.keys()
        return [note, *(self._draw_mass(f"{body}/slide", length, diameter) if moves else [])]

    def _draw_mass(self, entity: str, length: float, diameter: float) -> list[str]:
        """The movable mass at (r_rx, -Rr sin gamma, Rr cos gamma): one frame slides, one inside it turns."""
        import rerun as rr

        slide, turn = self.log.channels.get("mass_position"), self.log.channels.get("mass_rotation")
        true, drawn = number(self.log, "movable_eccentricity_m"), 0.32 * diameter
        told = (
            f"exaggerated: {drawn:.3f} m for a true {true:g} m" if true is not None else "not to scale: it is unknown"
        )
        notes = [f"Red: the movable mass. Its distance from the hull's axis is drawn {told}."]
        if slide is not None:
            zero = 0.0
            if "mass_position_zero" in self.log.metadata or number(self.log, "movable_nominal_position_m") is None:
                zero = 0.5 * (slide.values.min() + slide.values.max())
                notes.append("Where its zero lies in the hull is unknown: it is drawn about the middle of its range.")
            places = np.outer(slide.values - zero, [1, 0, 0])
            self._over_time(entity, slide.time_ns, rr.Transform3D.columns(translation=places))
        if turn is not None:
            spin = np.outer(np.sin(turn.values / 2), [1, 0, 0, 0]) + np.outer(np.cos(turn.values / 2), [0, 0, 0, 1])
            self._over_time(f"{entity}/turn", turn.time_ns, rr.Transform3D.columns(quaternion=spin))
        size = dict[str, Any](half_sizes=[[0.08 * length, 0.17 * diameter, 0.17 * diameter]], fill_mode="solid")
        self._add(f"{entity}/turn/mass", rr.Ellipsoids3D(centers=[[0, 0, drawn]], colors=look.RED, **size))
        return notes
