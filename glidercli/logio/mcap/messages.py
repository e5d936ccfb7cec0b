"""How does a table become protobuf messages, and back? Whole arrays at once, exact to the last bit.

A message whose fields are all fixed64 always has the same length. So one *template* message is filled with marked
values (`slot`), serialised once, and the columns of a table are laid over the marks: one row of bytes per message.
A timestamp keeps its length too, because both of its varints are written five bytes long (any decoder accepts a varint
with leading zero groups; five bytes hold every time from 1970 to 2262). Reading lays the same template over the rows.
"""

from __future__ import annotations

import dataclasses
import struct
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from google.protobuf.descriptor import Descriptor

Array = NDArray[np.float64]
Times = NDArray[np.int64]
Rows = NDArray[np.uint8]

__all__ = [
    "MARKED_TIME",
    "Messages",
    "Table",
    "all_times",
    "decoded",
    "message",
    "message_class",
    "own_class",
    "schema_bytes",
    "slot",
    "timestamp",
]

BILLION = 1_000_000_000
MARKED_TIME = {"seconds": (1 << 34) + 1_234_567_891, "nanos": 987_654_321}
"""The timestamp of a template: both values need five varint bytes."""
_STAMP_LENGTH = 12


def slot(index: int) -> float:
    """The marked value of column ``index`` (0 to 255) of a template; a finite number that nothing else is."""
    return float(struct.unpack("<d", _mark(index))[0])


def _mark(index: int) -> bytes:
    return b"glide" + bytes([index, 0x5A, 0x7F])


def timestamp(time_ns: int) -> dict[str, int]:
    """Seconds and nanos of a google.protobuf.Timestamp."""
    seconds, nanos = divmod(time_ns, BILLION)
    return {"seconds": seconds, "nanos": nanos}


def message(kind: Callable[..., Any], **fields: Any) -> Any:
    """A message of a class; submessages may be dictionaries, which protobuf takes though its stubs do not say so."""
    return kind(**fields)


def _varints(values: NDArray[np.uint64]) -> Rows:
    """Five-byte varints, (n, 5), of values below 2**35."""
    groups = (values[:, None] >> np.arange(0, 35, 7, dtype=np.uint64)) & np.uint64(0x7F)
    return groups.astype(np.uint8) | np.array([0x80, 0x80, 0x80, 0x80, 0], np.uint8)


def _stamps(time_ns: Times) -> Rows:
    """Serialised google.protobuf.Timestamp messages, (n, 12)."""
    seconds, nanos = np.divmod(time_ns.astype(np.uint64), np.uint64(BILLION))
    rows = np.empty((len(time_ns), _STAMP_LENGTH), np.uint8)
    rows[:, 0], rows[:, 1:6], rows[:, 6], rows[:, 7:] = 0x08, _varints(seconds), 0x10, _varints(nanos)
    return rows


def _stamp_place(raw: bytes) -> int:
    """Where a serialised template has its timestamp."""
    from google.protobuf.timestamp_pb2 import Timestamp

    return raw.index(message(Timestamp, **MARKED_TIME).SerializeToString())


def _encoded(template: Any, time_ns: Times, columns: Sequence[Array]) -> Rows:
    """The messages of a table, one per row: the template with its marks replaced."""
    raw = template.SerializeToString(deterministic=True)
    rows = np.empty((len(time_ns), len(raw)), np.uint8)
    rows[:] = np.frombuffer(raw, np.uint8)
    at = _stamp_place(raw)
    rows[:, at : at + _STAMP_LENGTH] = _stamps(time_ns)
    for index, column in enumerate(columns):
        at = raw.index(_mark(index))
        rows[:, at : at + 8] = np.ascontiguousarray(column, "<f8").view(np.uint8).reshape(-1, 8)
    return rows


def decoded(template: Any, rows: Rows, count: int) -> list[Array] | None:
    """The ``count`` columns of messages of a template, one message per row; None where the rows are of another kind."""
    raw = template.SerializeToString(deterministic=True)
    if rows.shape[1] != len(raw):
        return None
    fixed = np.ones(len(raw), bool)
    stamp = _stamp_place(raw)
    fixed[stamp : stamp + _STAMP_LENGTH] = False
    columns = []
    for index in range(count):
        at = raw.index(_mark(index))
        fixed[at : at + 8] = False
        columns.append(np.ascontiguousarray(rows[:, at : at + 8]).view("<f8")[:, 0].astype(np.float64))
    return columns if (rows[:, fixed] == np.frombuffer(raw, np.uint8)[fixed]).all() else None


@dataclasses.dataclass(frozen=True)
class Table:
    """A topic with one message per row of a table.

    time_ns : (n,) increasing. template : message with marks. columns : (n,) each, of mark 0, 1, ... notes : what fields
    mean, for people.
    """

    name: str
    time_ns: Times
    template: Any
    columns: Sequence[Array]
    notes: Mapping[str, str] = dataclasses.field(default_factory=dict)

    @property
    def descriptor(self) -> Descriptor:
        """The kind of message."""
        return self.template.DESCRIPTOR  # type: ignore[no-any-return]

    def payloads(self, first: int, last: int) -> list[bytes]:
        """The serialised messages of rows first to last (exclusive)."""
        rows = _encoded(self.template, self.time_ns[first:last], [column[first:last] for column in self.columns])
        length, block = rows.shape[1], rows.tobytes()
        return [block[at : at + length] for at in range(0, len(block), length)]


@dataclasses.dataclass(frozen=True)
class Messages:
    """A topic with a few messages of any length. time_ns : (n,), not decreasing. messages : n of one kind, n > 0."""

    name: str
    time_ns: Times
    messages: Sequence[Any]
    notes: Mapping[str, str] = dataclasses.field(default_factory=dict)

    @property
    def descriptor(self) -> Descriptor:
        """The kind of message."""
        return self.messages[0].DESCRIPTOR  # type: ignore[no-any-return]

    def payloads(self, first: int, last: int) -> list[bytes]:
        """The serialised messages first to last (exclusive)."""
        return [item.SerializeToString(deterministic=True) for item in self.messages[first:last]]


def schema_bytes(descriptor: Descriptor) -> bytes:
    """The serialised FileDescriptorSet of a message: its file and all that it imports, imported ones first."""
    from google.protobuf.descriptor_pb2 import FileDescriptorSet

    files = FileDescriptorSet()
    seen = set()

    def add(file: Any) -> None:
        if file.name not in seen:
            seen.add(file.name)
            for needed in file.dependencies:
                add(needed)
            file.CopyToProto(files.file.add())

    add(descriptor.file)
    return files.SerializeToString(deterministic=True)


def message_class(schema: bytes, name: str) -> type[Any]:
    """The message class of a serialised FileDescriptorSet."""
    from google.protobuf.descriptor_pb2 import FileDescriptorSet
    from google.protobuf.descriptor_pool import DescriptorPool
    from google.protobuf.message_factory import GetMessageClass

    pool = DescriptorPool()
    for file in FileDescriptorSet.FromString(schema).file:
        pool.Add(file)
    return GetMessageClass(pool.FindMessageTypeByName(name))


def all_times(times: Sequence[Times]) -> Times:
    """The union of increasing times; arrays that equal the union so far, as in a table, cost nothing."""
    union = times[0]
    for more in times[1:]:
        if not np.array_equal(union, more):
            union = np.union1d(union, more)
    return union


def own_class(name: str, fields: Sequence[tuple[str, int, int]], package: str = "glider") -> type[Any]:
    """A message class PACKAGE.NAME of a timestamp and fields (name, number, type)."""
    from google.protobuf import timestamp_pb2
    from google.protobuf.descriptor_pb2 import FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet

    file = FileDescriptorProto(name=f"{package}/{name}.proto", package=package, syntax="proto3")
    file.dependency.append("google/protobuf/timestamp.proto")
    described = file.message_type.add(name=name)
    single = FieldDescriptorProto.LABEL_OPTIONAL
    stamp = FieldDescriptorProto.TYPE_MESSAGE
    described.field.add(name="timestamp", number=1, type=stamp, label=single, type_name=".google.protobuf.Timestamp")
    for field, number, kind in fields:
        described.field.add(name=field, number=number, type=FieldDescriptorProto.Type.ValueType(kind), label=single)
    files = FileDescriptorSet()
    timestamp_pb2.DESCRIPTOR.CopyToProto(files.file.add())
    files.file.append(file)
    return message_class(files.SerializeToString(), f"{package}.{name}")
