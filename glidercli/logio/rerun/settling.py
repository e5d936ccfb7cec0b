"""How does the same Log give the same bytes? By ids made from the content; Rerun makes its own from clock and chance.

`row` and `columns` make chunks, `identified` and `Settled` name them and the panels, `settle` puts the finished file
right.
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

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["Settled", "columns", "identified", "row", "settle"]


def row(entity: str, *archetypes: Any, times: Iterable[Any] = ()) -> Chunk:
    """One row of one entity; without times it holds for the whole recording."""
    from rerun.chunk import Chunk

    batches = [batch for archetype in archetypes for batch in archetype.as_component_batches()]
    return Chunk.from_columns(entity, times, [batch.partition([len(batch.as_arrow_array())]) for batch in batches])


def columns(entity: str, start_ns: int, time_ns: NDArray[np.int64], values: Any) -> Chunk:
    """Values of one entity over time, on both timelines."""
    import rerun as rr
    from rerun.chunk import Chunk

    utc = rr.TimeColumn("utc", timestamp=time_ns.astype("datetime64[ns]"))
    elapsed = rr.TimeColumn("elapsed", duration=(time_ns - start_ns).astype("timedelta64[ns]"))
    return Chunk.from_columns(entity, [utc, elapsed], values)


def identified(chunks: Iterable[Chunk], key: str, before: int = 0) -> Iterator[Chunk]:
    """The same chunks with ids made from a key (hexadecimal) and their order, below any that a clock would give today.

    before : how many chunks went before them.
    """
    import pyarrow as pa  # type: ignore[import-untyped, unused-ignore]
    from rerun.chunk import Chunk

    base = int(key[:10], 16) << 16
    for place, chunk in enumerate(chunks, start=before + 1):
        batch = chunk.to_record_batch()
        high = (base + place).to_bytes(8, "big")
        ids = np.empty((batch.num_rows, 2), ">u8")
        ids[:, 0], ids[:, 1] = base + place, np.arange(1, batch.num_rows + 1)
        rows = pa.Array.from_buffers(pa.binary(16), batch.num_rows, [None, pa.py_buffer(ids.tobytes())])
        named = {**batch.schema.metadata, b"rerun:id": f"chunk_{high.hex().upper()}{0:016x}".encode()}
        schema = batch.schema.with_metadata(named)
        yield from Chunk.from_record_batch(pa.RecordBatch.from_arrays([rows, *batch.columns[1:]], schema=schema))


class Settled:
    """A blueprint with ids made from a key, a hash; it serves where rerun takes a blueprint. views : the Blueprint."""

    def __init__(self, views: Any, key: str) -> None:
        self.views, self.key = views, key
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


def settle(path: Path, recording_id: str, key: str) -> None:
    """Put right what is left to chance in a file: ids of stores and of their frames, the order in the footer.

    recording_id : that of the recording while it was written; as much of the key takes its place.

    The file is a header of 12 bytes, then frames (kind and size, u64 each, then protobuf), then a trailer with place,
    size and xxh32 checksum of the footer. A frame of kind 1 names a store; kind 0 is the footer, one manifest a store;
    all others begin with the id of their store.
    """

    def named(data: bytes) -> bytes:
        data = data.replace(recording_id.encode(), key[: len(recording_id)].encode())
        return re.sub(rb"rec_[0-9a-f]{32}", b"rec_" + key[32:].encode(), data)

    with path.open("r+b") as file:
        at = 12
        while True:
            file.seek(at)
            kind, size = struct.unpack("<QQ", file.read(16))
            if kind == 0:
                break
            begins = file.read(min(size, 256))
            right = named(begins)
            if kind == 1:
                right = right[:2] + b"\x09" + bytes(8) + b"\x11" + bytes(8) + right[20:]
            if right != begins:
                file.seek(at + 16)
                file.write(right)
            at += 16 + size
        manifests = [_field(1, _ordered(manifest)) for _, manifest in _fields(named(file.read(size)))]
        footer = b"".join(sorted(manifests))
        trailer = struct.pack("<QQI8sI", at + 16, len(footer), _xxh32(footer), b"RRF2FOOT", 1)
        file.seek(at)
        file.write(struct.pack("<QQ", 0, len(footer)) + footer + trailer)
        file.truncate()


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
