"""How does a Log become an MCAP file? All topics merged in time order into compressed, indexed chunks.

A week of samples makes millions of messages, so a chunk is put together from whole arrays: `mcap.writer.Writer` takes
one message at a time and is about ten times slower. Each record kind is still written by `mcap.records`. Metadata and
provenance come first in the file, so that `pymcap-cli recover` keeps them when the end is lost. The bytes depend only
on the Log: no clock, no random number.
"""

from __future__ import annotations

import dataclasses
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from glidercli.errors import OutputError
from glidercli.log import Log
from glidercli.logio.mcap.messages import (
    Messages,
    Table,
    channel_topics,
    event_topics,
    message,
    schema_bytes,
    timestamp,
)
from glidercli.logio.mcap.scene import remarks, scene_topics
from glidercli.provenance import version

if TYPE_CHECKING:
    from mcap.records import ChunkIndex, McapRecord

__all__ = ["FORMAT", "MAGIC", "statement", "write_mcap"]

MAGIC = b"\x89MCAP0\r\n"
FORMAT = "1"
"""Raised when a reader of the earlier layout would misread a file."""
CHUNK_MESSAGES = 6000
"""Messages in a chunk: about 1 MB before compression, so that a seek in a viewer is quick."""
_HEAD = np.dtype(
    [("opcode", "u1"), ("length", "<u8"), ("channel", "<u2"), ("sequence", "<u4"), ("log", "<u8"), ("publish", "<u8")]
)
"""The start of an MCAP message record; the payload follows. length counts from the channel on."""
_HEAD_COUNTED = _HEAD.itemsize - 9

Topic = Table | Messages


def write_mcap(log: Log, path: Path) -> None:
    """Write the log to ``path`` as MCAP; `read_mcap` gives it back equal to the last bit.

    Raises OutputError for a time before 1970, which MCAP cannot hold.
    """
    log = dataclasses.replace(log, events=tuple(sorted(log.events, key=lambda event: event.time_ns)))
    times = [int(c.time_ns[0]) for c in log.channels.values() if len(c)] + [event.time_ns for event in log.events]
    start_ns = min(times, default=0)
    if start_ns < 0:
        raise OutputError(path, f"MCAP times start at 1970; the log starts at {start_ns} ns, before that")
    with np.errstate(over="ignore", invalid="ignore"):  # an absurd sample may overflow in what is only drawn
        shown = [_log_lines(log, start_ns), *scene_topics(log, start_ns)]
        topics: list[Topic] = [*shown, *channel_topics(log), *event_topics(log.events)]
    origins = {channel.name: channel.origin for channel in log.channels.values()}
    notes = {
        "run": dict(log.metadata),
        "origin": {"log": log.origin, "channels": " ".join(log.channels), **origins},
        "version": {"program": f"glidercli {version()}", "format": FORMAT},
    }
    with path.open("wb") as stream:
        _File(stream).write(topics, notes, log.metadata.get("provenance", "{}"), start_ns)


def statement(log: Log) -> str:
    """What the log is, plainly: SIMULATED, MEASURED, RECONSTRUCTION: text."""
    text = log.metadata.get("reconstruction", "")
    if log.origin == "reconstruction":
        return f"RECONSTRUCTION: {text}" if text else "RECONSTRUCTION"
    return f"{log.origin.upper()} FROM A RECONSTRUCTION: {text}" if text else log.origin.upper()


def _log_lines(log: Log, start_ns: int) -> Messages:
    """The topic /log: first what the log is, then remarks, then the events."""
    from foxglove_schemas_protobuf.Log_pb2 import Log as Line

    lines = [(start_ns, statement(log), "glider")]
    lines += [(start_ns, text, "scene") for text in remarks(log)]
    if "track_note" in log.metadata:
        lines.append((start_ns, log.metadata["track_note"], "track"))
    for event in log.events:
        depth = "" if event.depth is None else f" at {event.depth:.1f} m"
        lines.append((event.time_ns, event.name + depth, "event"))
    messages = [
        message(Line, timestamp=timestamp(at), level=Line.INFO, message=text, name=name) for at, text, name in lines
    ]
    return Messages("/log", np.array([at for at, _, _ in lines], np.int64), messages)


class _File:
    """An MCAP file in the making."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._stream = stream
        self._crc = 0
        self._at = 0

    def _put(self, data: bytes) -> tuple[int, int]:
        """Append bytes; their offset and length."""
        offset = self._at
        self._stream.write(data)
        self._crc = zlib.crc32(data, self._crc)
        self._at += len(data)
        return offset, len(data)

    def write(self, topics: Sequence[Topic], notes: dict[str, dict[str, str]], provenance: str, start_ns: int) -> None:
        """The whole file. notes : metadata records by name. provenance : JSON for the attachment."""
        from mcap import records as r

        self._put(MAGIC)
        self._put(_bytes(r.Header(profile="", library=f"glidercli {version()}")))
        metadata_index: list[McapRecord] = []
        for name, entries in notes.items():
            offset, length = self._put(_bytes(r.Metadata(name=name, metadata=entries)))
            metadata_index.append(r.MetadataIndex(offset=offset, length=length, name=name))
        about: dict[str, Any] = {"log_time": start_ns, "create_time": 0, "name": "provenance.json"}
        about["media_type"] = "application/json"
        data = provenance.encode()
        offset, length = self._put(_bytes(r.Attachment(data=data, **about)))
        attachment = r.AttachmentIndex(offset=offset, length=length, data_size=len(data), **about)

        schemas, channels = _declared(topics)
        chunks = self._chunks(topics, b"".join(_bytes(record) for record in [*schemas, *channels]))
        self._put(_bytes(r.DataEnd(self._crc)))
        counts = {i: len(topic.time_ns) for i, topic in enumerate(topics, 1)}
        statistics = r.Statistics(
            attachment_count=1,
            channel_count=len(channels),
            channel_message_counts=counts,
            chunk_count=len(chunks),
            message_count=sum(counts.values()),
            message_end_time=max(int(topic.time_ns[-1]) for topic in topics),
            message_start_time=start_ns,
            metadata_count=len(notes),
            schema_count=len(schemas),
        )
        self._summary([schemas, channels, [statistics], chunks, [attachment], metadata_index])

    def _summary(self, groups: Sequence[Sequence[McapRecord]]) -> None:
        """The summary, where each of its groups starts, and the footer; the checksum runs up to the footer's own."""
        from mcap import records as r

        start, self._crc = self._at, 0
        offsets = []
        for group in groups:
            data = b"".join(_bytes(record) for record in group)
            offset, length = self._put(data)
            offsets.append(r.SummaryOffset(group_opcode=data[0], group_start=offset, group_length=length))
        offset_start = self._at
        for item in offsets:
            self._put(_bytes(item))
        open_end = _bytes(r.Footer(summary_start=start, summary_offset_start=offset_start, summary_crc=0))[:-4]
        crc = zlib.crc32(open_end, self._crc)
        self._put(_bytes(r.Footer(summary_start=start, summary_offset_start=offset_start, summary_crc=crc)) + MAGIC)

    def _chunks(self, topics: Sequence[Topic], declarations: bytes) -> list[ChunkIndex]:
        """All messages in time order, topics in the given order at one time; the declarations lead the first chunk."""
        every = np.sort(np.concatenate([topic.time_ns for topic in topics]), kind="stable")
        bounds = np.unique(every[CHUNK_MESSAGES::CHUNK_MESSAGES])
        cuts = [[0, *np.searchsorted(topic.time_ns, bounds).tolist(), len(topic.time_ns)] for topic in topics]
        index: list[ChunkIndex] = []
        for k in range(len(bounds) + 1):
            parts = [(i, topic, cut[k], cut[k + 1]) for i, (topic, cut) in enumerate(zip(topics, cuts, strict=True), 1)]
            kept = [part for part in parts if part[3] > part[2]]
            if kept:
                index.append(self._chunk(kept, b"" if index else declarations))
        return index

    def _chunk(self, parts: Sequence[tuple[int, Topic, int, int]], declarations: bytes) -> ChunkIndex:
        """One chunk with its message indexes. parts : channel, topic, first row, last row (exclusive)."""
        import zstandard
        from mcap import records as r
        from mcap.opcode import Opcode

        found = [_records(channel, topic, first, last) for channel, topic, first, last in parts]
        times = np.concatenate([topic.time_ns[first:last] for _, topic, first, last in parts]).astype("<u8")
        channels = np.concatenate([np.full(last - first, channel) for channel, _, first, last in parts])
        unsorted = [record for part in found for record in part]
        order = np.argsort(times, kind="stable")
        ordered = [unsorted[row] for row in order.tolist()]
        lengths = np.fromiter(map(len, ordered), np.int64, len(ordered))
        offsets = (len(declarations) + np.cumsum(lengths) - lengths).astype("<u8")
        times, channels = times[order], channels[order]

        block = declarations + b"".join(ordered)
        packed = zstandard.compress(block)
        span = {"message_start_time": int(times[0]), "message_end_time": int(times[-1])}
        chunk = r.Chunk(
            compression="zstd", data=packed, uncompressed_crc=zlib.crc32(block), uncompressed_size=len(block), **span
        )
        start, length = self._put(_bytes(chunk))
        places = {}
        for channel, _, _, _ in parts:
            mine = channels == channel
            entries = np.stack([times[mine], offsets[mine]], axis=-1).tobytes()
            head = channel.to_bytes(2, "little") + len(entries).to_bytes(4, "little")
            record = bytes([Opcode.MESSAGE_INDEX]) + (len(head) + len(entries)).to_bytes(8, "little") + head + entries
            places[channel] = self._put(record)[0]
        return r.ChunkIndex(
            chunk_start_offset=start,
            chunk_length=length,
            message_index_offsets=places,
            message_index_length=self._at - start - length,
            compression="zstd",
            compressed_size=len(packed),
            uncompressed_size=len(block),
            **span,
        )


def _records(channel: int, topic: Topic, first: int, last: int) -> list[bytes]:
    """The message records of some rows of a topic."""
    from mcap.opcode import Opcode

    payloads = topic.payloads(first, last)
    heads = np.zeros(last - first, _HEAD)
    heads["opcode"], heads["channel"] = Opcode.MESSAGE, channel
    heads["length"] = np.fromiter(map(len, payloads), np.int64, len(payloads)) + _HEAD_COUNTED
    heads["log"] = heads["publish"] = topic.time_ns[first:last]
    block, size = heads.tobytes(), _HEAD.itemsize
    return [block[i * size : (i + 1) * size] + payload for i, payload in enumerate(payloads)]


def _declared(topics: Sequence[Topic]) -> tuple[list[McapRecord], list[McapRecord]]:
    """Schema and channel records; a schema for each kind of message, channel ids 1, 2, ... in the order of topics."""
    from mcap import records as r

    schemas: dict[str, Any] = {}
    channels: list[McapRecord] = []
    for i, topic in enumerate(topics, 1):
        kind = topic.descriptor
        if kind.full_name not in schemas:
            schemas[kind.full_name] = r.Schema(
                id=len(schemas) + 1, name=kind.full_name, encoding="protobuf", data=schema_bytes(kind)
            )
        schema_id = schemas[kind.full_name].id
        channels.append(
            r.Channel(
                id=i, topic=topic.name, message_encoding="protobuf", metadata=dict(topic.notes), schema_id=schema_id
            )
        )
    return list(schemas.values()), channels


def _bytes(record: McapRecord) -> bytes:
    """A record as the library writes it."""
    from mcap.data_stream import RecordBuilder

    builder: Any = RecordBuilder()
    record.write(builder)
    return bytes(builder.end())
