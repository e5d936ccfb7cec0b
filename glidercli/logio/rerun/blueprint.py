"""How does a Log look in the Rerun viewer? Panels, colours and cameras; and how its bytes are settled.

Rerun gives each chunk, row, panel and store an id made from clock and chance. `identified`, `Settled` and `settle` make
them from the content instead, so that the same Log gives the same bytes.
"""

from __future__ import annotations

import re
import struct
import uuid
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.drawable import hull_size

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["COLOURS", "PHASE_COLOURS", "Settled", "identified", "row", "series_name", "settle"]

Array = NDArray[np.float64]
Colour = tuple[int, int, int]

BLUE, ORANGE, GREEN, RED = (86, 164, 255), (255, 158, 74), (110, 205, 130), (240, 98, 98)
VIOLET, GOLD, GREY, TEAL = (184, 140, 255), (240, 208, 90), (170, 178, 190), (90, 225, 205)
SEA, SEA_LINES, HULL, FINS = (70, 150, 210, 36), (110, 180, 230, 90), (250, 205, 70, 45), (236, 120, 50, 255)

PHASE_COLOURS: dict[str, Colour] = {
    "surface": GREEN, "dive": BLUE, "climb": ORANGE, "hover": VIOLET, "inflection": GOLD,
}  # fmt: skip

PLOTS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("Flight", "depth, m (negative down)", ("depth",)),
    ("Flight", "flight phase", ("phase",)),
    ("Flight", "attitude, deg", ("pitch", "roll")),
    ("Flight", "heading, deg clockwise from north", ("heading",)),
    ("Flight", "speed, m/s", ("speed_through_water", "vertical_speed")),
    ("Actuators", "movable mass position, m", ("mass_position",)),
    ("Actuators", "movable mass rotation, deg", ("mass_rotation",)),
    ("Actuators", "net buoyancy, kg (sinking positive)", ("net_buoyancy",)),
    ("Actuators", "ballast volume, cm3 (floating positive)", ("ballast_volume",)),
    ("Actuators", "rudder angle, deg", ("rudder_angle",)),
    ("Water", "temperature, degC", ("temperature", "conservative_temperature")),
    ("Water", "salinity", ("salinity", "absolute_salinity")),
    ("Water", "density, kg/m3", ("density",)),
    ("Water", "conductivity, S/m", ("conductivity",)),
    ("Water", "pressure, dbar", ("pressure",)),
    ("Current", "current, m/s", ("current_east", "current_north", "current_up")),
    ("Motion", "velocity through water in body axes, m/s", ("u", "v", "w")),
    ("Motion", "flow angles, deg", ("angle_of_attack", "sideslip")),
    ("Motion", "body rates, deg/s", ("p", "q", "r")),
    ("Map", "north, east, down of the origin, m", ("north", "east", "down")),
    ("Map", "latitude, deg", ("latitude",)),
    ("Map", "longitude, deg", ("longitude",)),
)
"""Tab, panel title and channels; a panel whose channels the log lacks is left out, and so is a tab without panels."""

COLOURS = {name: colour for *_, names in PLOTS for name, colour in zip(names, (BLUE, ORANGE, GREEN), strict=False)}


def series_name(channel: str) -> str:
    """Name of a channel's line in a plot, with the unit that it is drawn in."""
    unit = "m (negative down)" if channel == "depth" else CHANNELS[channel].column_unit
    return f"{channel.replace('_', ' ')}, {'practical, no unit' if unit == '1' else unit}"


def _blueprint(log: Log, camera: tuple[Array, Array] | None, has_hull: bool, has_plan: bool) -> Any:
    """The rerun Blueprint of a log: 3-D on the left, flight plots in the middle, tabs with the rest on the right."""
    import rerun.blueprint as rrb

    def named(channel: str, title: str) -> str:
        derived = channel in log and log[channel].origin == "derived"
        return f"{'DERIVED' if derived else log.kind}: {title}"

    def space(name: str, contents: str, **eye: Any) -> Any:
        style = dict[str, Any](line_grid=False, eye_controls=rrb.EyeControls3D(eye_up=(0, 0, -1), **eye))
        return rrb.Spatial3DView(origin="/world", contents=contents.split(", "), name=name, **style)

    left: list[Any] = []
    if camera is not None:
        contents = "+ /world/**, - /world/vehicle/compass/**, - /world/vehicle/body/**"
        title = named("north", "track, north-east-down, m")
        left.append(space(title, contents, position=camera[0], look_target=camera[1]))
    if has_hull:
        length, _, own = hull_size(log)
        contents = "+ /world/vehicle/**, + /world/track, - /world/vehicle/marker"
        title = named("heading", "camera on the hull" + ("" if own else " (not to scale)"))
        eye, hull = (1.0 if left else 1.6) * length * np.array([-0.72, 0.74, -0.7]), "/world/vehicle/body/hull"
        left.append(space(title, contents, position=eye, look_target=(0, 0, 0), tracking_entity=hull))
    tabs: dict[str, list[Any]] = {}
    for tab, title, names in PLOTS:
        if present := [name for name in names if name in log]:
            alone = len(present) < min(len(names), 2)
            tabs.setdefault(tab, []).append(_plot(series_name(present[0]) if alone else title, present))
    if has_plan:
        plan = rrb.Spatial2DView(origin="/plan", name=named("north", "from above, north up, m"))
        tabs["Map"] = [plan, *tabs.get("Map", [])]
    tabs["About"] = [rrb.TextDocumentView(origin="/about", name="about this recording")]
    if log.events:
        tabs["About"].append(rrb.TextLogView(origin="/events", name="events"))
    columns: list[Any] = [rrb.Vertical(*left)] if left else []
    if flight := tabs.pop("Flight", None):
        heights = [0.45 if isinstance(view, rrb.StateTimelineView) else 1.0 for view in flight]
        columns.append(rrb.Vertical(*flight, row_shares=heights))
    shares = [5.0] * bool(left) + [4.0] * bool(flight) + [3.5]
    columns.append(rrb.Tabs(*(rrb.Vertical(*views, name=tab) for tab, views in tabs.items())))
    pace = dict[str, Any](playback_speed=max(1.0, (log.end_ns - log.start_ns) / 60e9), play_state="paused")
    time = rrb.TimePanel(state="collapsed", timeline="elapsed" if log.origin == "simulated" else "utc", **pace)
    hidden = rrb.BlueprintPanel(state="hidden"), rrb.SelectionPanel(state="hidden")
    return rrb.Blueprint(rrb.Horizontal(*columns, column_shares=shares), time, *hidden)


def _plot(title: str, channels: list[str]) -> Any:
    """A time-series panel over the whole recording, or the band of phases."""
    import rerun as rr
    import rerun.blueprint as rrb

    boundary = rrb.TimeRangeBoundary.infinite()
    axis = rrb.TimeAxis(view_range=rr.TimeRange(start=boundary, end=boundary))
    contents = [f"/{CHANNELS[name].group}/{name}" for name in channels]
    if channels == ["phase"]:
        return rrb.StateTimelineView(origin="/", contents=contents, name=title, time_view=axis)
    legend = rrb.PlotLegend(visible=len(channels) > 1)
    return rrb.TimeSeriesView(origin="/", contents=contents, name=title, axis_x=axis, plot_legend=legend)


def row(entity: str, *archetypes: Any, times: Iterable[Any] = ()) -> Chunk:
    """One row of one entity; without times it holds for the whole recording."""
    from rerun.chunk import Chunk

    batches = [batch for archetype in archetypes for batch in archetype.as_component_batches()]
    return Chunk.from_columns(entity, times, [batch.partition([len(batch.as_arrow_array())]) for batch in batches])


def identified(chunks: Iterable[Chunk], key: str) -> Iterator[Chunk]:
    """The same chunks with ids made from the content and their order, below any that a clock would give today."""
    import pyarrow as pa  # type: ignore[import-untyped, unused-ignore]
    from rerun.chunk import Chunk

    base = int(key[:10], 16) << 16
    for place, chunk in enumerate(chunks, start=1):
        batch = chunk.to_record_batch()
        high = (base + place).to_bytes(8, "big")
        rows = pa.array([high + i.to_bytes(8, "big") for i in range(1, batch.num_rows + 1)], pa.binary(16))
        named = {**batch.schema.metadata, b"rerun:id": f"chunk_{high.hex().upper()}{0:016x}".encode()}
        schema = batch.schema.with_metadata(named)
        yield from Chunk.from_record_batch(pa.RecordBatch.from_arrays([rows, *batch.columns[1:]], schema=schema))


class Settled:
    """The blueprint of a log with ids made from the content (key, a hash); it serves where rerun takes a blueprint.

    camera : eye and target of the view of the whole track, NED, m; None without a track.
    has_hull, has_plan : whether the attitude is known, and anything to show from above.
    """

    def __init__(self, log: Log, camera: tuple[Array, Array] | None, has_hull: bool, has_plan: bool, key: str) -> None:
        self.views, self.key = _blueprint(log, camera, has_hull, has_plan), key
        self.chunks: list[Chunk] = []
        self._name(self.views.root_container, key)

    def _name(self, node: Any, name: str) -> None:
        """Name a container or a view and all that it contains."""
        node.id = uuid.uuid5(uuid.NAMESPACE_OID, name)
        for place, child in enumerate(node.contents if hasattr(node, "kind") else ()):
            self._name(child, f"{name}/{place}")

    def to_blueprint(self) -> Settled:
        """Itself, as rerun asks."""
        return self

    def log(self, entity: str, archetype: Any, static: bool = False) -> None:
        """Take one row of the blueprint, as a recording would."""
        import rerun as rr

        self.chunks.append(row(entity, archetype, times=[] if static else [rr.TimeColumn("blueprint", sequence=[0])]))

    def _log_to_stream(self, stream: Any) -> None:
        import rerun as rr

        self.views._log_to_stream(self)
        rr.send_chunks(identified(self.chunks, self.key), recording=stream)


def settle(path: Path, key: str) -> None:
    """Put right what is left to chance in a file: the blueprint's id, ids of store frames, the order in the footer.

    The file is a header of 12 bytes, then frames (kind and size, u64 each, then protobuf), then a trailer with place,
    size and xxh32 checksum of the footer. A frame of kind 1 names a store; kind 0 is the footer, one manifest a store.
    """
    data = bytearray(re.sub(rb"rec_[0-9a-f]{32}", b"rec_" + key[32:].encode(), path.read_bytes()))
    at = 12
    while (frame := struct.unpack_from("<QQ", data, at))[0]:
        if frame[0] == 1:
            data[at + 18 : at + 36] = b"\x09" + bytes(8) + b"\x11" + bytes(8)
        at += 16 + frame[1]
    footer = b"".join(sorted(_field(1, _ordered(manifest)) for _, manifest in _fields(bytes(data[at + 16 : -32]))))
    trailer = struct.pack("<QQI8sI", at + 16, len(footer), _xxh32(footer), b"RRF2FOOT", 1)
    path.write_bytes(data[:at] + struct.pack("<QQ", 0, len(footer)) + footer + trailer)


def _ordered(manifest: bytes) -> bytes:
    """A manifest with the fields of its Arrow schema (field 2) in the order of their names."""
    import pyarrow as pa  # type: ignore[import-untyped, unused-ignore]

    parts = dict(_fields(manifest))
    ((_, schema),) = _fields(parts[2])
    fields = sorted(pa.ipc.read_schema(pa.py_buffer(schema)), key=lambda field: str(field.name))
    sink = pa.BufferOutputStream()
    pa.ipc.new_stream(sink, pa.schema(fields)).close()
    parts[2] = _field(1, sink.getvalue().to_pybytes())
    return b"".join(_field(number, content) for number, content in parts.items())


def _fields(message: bytes) -> list[tuple[int, bytes]]:
    """Number and content of each field of a protobuf message of fields with a length."""
    from google.protobuf.empty_pb2 import Empty
    from google.protobuf.unknown_fields import UnknownFieldSet

    found = UnknownFieldSet(Empty.FromString(message))
    return [(found[i].field_number, found[i].data) for i in range(len(found))]


def _field(number: int, content: bytes) -> bytes:
    """One protobuf field with a length; BytesValue is a message with just that as its field 1."""
    from google.protobuf.wrappers_pb2 import BytesValue

    return bytes([number << 3 | 2]) + BytesValue(value=content).SerializeToString()[1:]


def _xxh32(data: bytes, seed: int = 7850921) -> int:
    """Checksum XXH32 as its specification has it, with the seed of Rerun's trailer."""
    one, two, three, four, five = 2654435761, 2246822519, 3266489917, 668265263, 374761393
    mask = 0xFFFFFFFF

    def turned(x: int, bits: int) -> int:
        return (x << bits | x >> 32 - bits) & mask

    words = struct.unpack_from(f"<{len(data) // 4}I", data)
    striped = len(data) // 16 * 4
    lanes = [(seed + one + two) & mask, (seed + two) & mask, seed, (seed - one) & mask]
    for i, word in enumerate(words[:striped]):
        lanes[i & 3] = turned((lanes[i & 3] + word * two) & mask, 13) * one & mask
    total = (sum(map(turned, lanes, (1, 7, 12, 18))) if striped else seed + five) + len(data) & mask
    for word in words[striped:]:
        total = turned((total + word * three) & mask, 17) * four & mask
    for byte in data[len(words) * 4 :]:
        total = turned((total + byte * five) & mask, 11) * one & mask
    total = (total ^ total >> 15) * two & mask
    total = (total ^ total >> 13) * three & mask
    return total ^ total >> 16
