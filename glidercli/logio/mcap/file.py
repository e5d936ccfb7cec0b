"""What is an MCAP file made of? Its records in order: chunks of messages as they come, then the summary.

A week of samples makes millions of messages, so a chunk is put together from whole arrays: `mcap.writer.Writer` takes
one message at a time and is about ten times slower. Each record kind is still written by `mcap.records`. Nothing but
the index stays in memory: a long log needs no more than a short one. The bytes depend on what is written alone: no
clock, no random number.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from glidercli.errors import InputError
from glidercli.logio.mcap.messages import Messages, Table, schema_bytes
from glidercli.provenance import version

if TYPE_CHECKING:
    from mcap.records import ChunkIndex, McapRecord

__all__ = ["MAGIC", "McapFile", "Topic"]

MAGIC = b"\x89MCAP0\r\n"
CHUNK_MESSAGES = 6000
"""Messages in a chunk: about 1 MB before compression, so that a seek in a viewer is quick."""
BLOCK = 1 << 20
"""bytes of an attachment that are in memory at once."""
_HEAD = np.dtype(
    [("opcode", "u1"), ("length", "<u8"), ("channel", "<u2"), ("sequence", "<u4"), ("log", "<u8"), ("publish", "<u8")]
)
"""The start of an MCAP message record; the payload follows. length counts from the channel on."""
_HEAD_COUNTED = _HEAD.itemsize - 9

Topic = Table | Messages


class McapFile:
    """An MCAP file in the making; ``finish`` makes it whole."""

    def __init__(self, stream: IO[bytes]) -> None:
        from mcap import records as r

        self._stream = stream
        self._crc = 0
        self._at = 0
        self._schemas: dict[str, Any] = {}
        self._channels: dict[str, Any] = {}
        self._counts: dict[int, int] = {}
        self._span: tuple[int, int] | None = None
        self._chunks: list[ChunkIndex] = []
        self._metadata: list[McapRecord] = []
        self._attachments: list[McapRecord] = []
        self._put(MAGIC)
        self._put(_bytes(r.Header(profile="", library=f"glidercli {version()}")))

    def metadata(self, name: str, entries: Mapping[str, str]) -> None:
        """Add a metadata record; of two of one name the later counts."""
        from mcap import records as r

        offset, length = self._put(_bytes(r.Metadata(name=name, metadata=dict(entries))))
        self._metadata.append(r.MetadataIndex(offset=offset, length=length, name=name))

    def attach(self, name: str, source: bytes | Path, media_type: str, time_ns: int) -> None:
        """Add an attachment, a file block by block. time_ns : UTC, that it belongs to."""
        from mcap import records as r

        size = len(source) if isinstance(source, bytes) else source.stat().st_size
        about: dict[str, Any] = {"log_time": time_ns, "create_time": 0, "name": name, "media_type": media_type}
        empty = _bytes(r.Attachment(data=b"", **about))
        counted, start = len(empty) + size - 9, self._at
        head = empty[9:-12] + size.to_bytes(8, "little")  # without the length of no data and its checksum
        self._put(empty[:1] + counted.to_bytes(8, "little") + head)
        crc = zlib.crc32(head)
        for block in _blocks(source, size):
            self._put(block)
            crc = zlib.crc32(block, crc)
        self._put(crc.to_bytes(4, "little"))
        self._attachments.append(r.AttachmentIndex(offset=start, length=self._at - start, data_size=size, **about))

    def add(self, topics: Sequence[Topic]) -> None:
        """Add messages, in chunks: all in time order, topics in the given order at one time.

        A topic may come again; its messages are then later ones, of the same kind.
        """
        topics = [topic for topic in topics if len(topic.time_ns)]
        if not topics:
            return
        declared = b"".join(_bytes(record) for topic in topics for record in self._declare(topic))
        every = np.sort(np.concatenate([topic.time_ns for topic in topics]), kind="stable")
        first, last = int(every[0]), int(every[-1])
        self._span = (min(first, self._span[0]), max(last, self._span[1])) if self._span else (first, last)
        bounds = np.unique(every[CHUNK_MESSAGES::CHUNK_MESSAGES])
        cuts = [[0, *np.searchsorted(topic.time_ns, bounds).tolist(), len(topic.time_ns)] for topic in topics]
        for k in range(len(bounds) + 1):
            parts = [(topic, cut[k], cut[k + 1]) for topic, cut in zip(topics, cuts, strict=True)]
            kept = [part for part in parts if part[2] > part[1]]
            if kept:
                self._chunk(kept, declared)
                declared = b""

    def finish(self) -> None:
        """Write the end: statistics, indexes, checksums."""
        from mcap import records as r

        self._put(_bytes(r.DataEnd(self._crc)))
        first, last = self._span or (0, 0)
        statistics = r.Statistics(
            attachment_count=len(self._attachments),
            channel_count=len(self._channels),
            channel_message_counts=self._counts,
            chunk_count=len(self._chunks),
            message_count=sum(self._counts.values()),
            message_end_time=last,
            message_start_time=first,
            metadata_count=len(self._metadata),
            schema_count=len(self._schemas),
        )
        declared = [list(self._schemas.values()), list(self._channels.values())]
        self._summary([*declared, [statistics], self._chunks, self._attachments, self._metadata])

    def _put(self, data: bytes) -> tuple[int, int]:
        """Append bytes; their offset and length."""
        offset = self._at
        self._stream.write(data)
        self._crc = zlib.crc32(data, self._crc)
        self._at += len(data)
        return offset, len(data)

    def _summary(self, groups: Sequence[Sequence[McapRecord]]) -> None:
        """The summary, where each of its groups starts, and the footer; the checksum runs up to the footer's own."""
        from mcap import records as r

        start, self._crc = self._at, 0
        offsets = []
        for group in filter(None, groups):
            data = b"".join(_bytes(record) for record in group)
            offset, length = self._put(data)
            offsets.append(r.SummaryOffset(group_opcode=data[0], group_start=offset, group_length=length))
        offset_start = self._at
        for item in offsets:
            self._put(_bytes(item))
        open_end = _bytes(r.Footer(summary_start=start, summary_offset_start=offset_start, summary_crc=0))[:-4]
        crc = zlib.crc32(open_end, self._crc)
        self._put(_bytes(r.Footer(summary_start=start, summary_offset_start=offset_start, summary_crc=crc)) + MAGIC)

    def _declare(self, topic: Topic) -> list[McapRecord]:
        """The records that name a topic, if they are not yet written: its channel, and the schema of a new kind."""
        from mcap import records as r

        if topic.name in self._channels:
            return []
        kind = topic.descriptor
        found: list[McapRecord] = []
        if kind.full_name not in self._schemas:
            self._schemas[kind.full_name] = r.Schema(
                id=len(self._schemas) + 1, name=kind.full_name, encoding="protobuf", data=schema_bytes(kind)
            )
            found.append(self._schemas[kind.full_name])
        self._channels[topic.name] = r.Channel(
            id=len(self._channels) + 1,
            topic=topic.name,
            message_encoding="protobuf",
            metadata=dict(topic.notes),
            schema_id=self._schemas[kind.full_name].id,
        )
        return [*found, self._channels[topic.name]]

    def _chunk(self, parts: Sequence[tuple[Topic, int, int]], declared: bytes) -> None:
        """One chunk with its message indexes. parts : topic, first row, last row (exclusive)."""
        import zstandard
        from mcap import records as r
        from mcap.opcode import Opcode

        ids = [self._channels[topic.name].id for topic, _, _ in parts]
        unsorted = [record for channel, part in zip(ids, parts, strict=True) for record in _records(channel, *part)]
        times = np.concatenate([topic.time_ns[first:last] for topic, first, last in parts]).astype("<u8")
        channels = np.repeat(ids, [last - first for _, first, last in parts])
        order = np.argsort(times, kind="stable")
        ordered = [unsorted[row] for row in order.tolist()]
        lengths = np.fromiter(map(len, ordered), np.int64, len(ordered))
        offsets = (len(declared) + np.cumsum(lengths) - lengths).astype("<u8")
        times, channels = times[order], channels[order]

        block = declared + b"".join(ordered)
        packed = zstandard.compress(block)
        span = {"message_start_time": int(times[0]), "message_end_time": int(times[-1])}
        chunk = r.Chunk(
            compression="zstd", data=packed, uncompressed_crc=zlib.crc32(block), uncompressed_size=len(block), **span
        )
        start, length = self._put(_bytes(chunk))
        places = {}
        for channel in ids:
            mine = channels == channel
            entries = np.stack([times[mine], offsets[mine]], axis=-1).tobytes()
            head = channel.to_bytes(2, "little") + len(entries).to_bytes(4, "little")
            record = bytes([Opcode.MESSAGE_INDEX]) + (len(head) + len(entries)).to_bytes(8, "little") + head + entries
            places[channel] = self._put(record)[0]
            self._counts[channel] = self._counts.get(channel, 0) + int(mine.sum())
        self._chunks.append(
            r.ChunkIndex(
                chunk_start_offset=start,
                chunk_length=length,
                message_index_offsets=places,
                message_index_length=self._at - start - length,
                compression="zstd",
                compressed_size=len(packed),
                uncompressed_size=len(block),
                **span,
            )
        )


def _blocks(source: bytes | Path, size: int) -> Iterator[bytes]:
    """The bytes of an attachment, a block at a time; of a file that grows as many as it had."""
    if isinstance(source, bytes):
        yield source
        return
    with source.open("rb") as stream:
        for left in range(size, 0, -BLOCK):
            block = stream.read(min(BLOCK, left))
            if len(block) < min(BLOCK, left):
                raise InputError(source, f"became shorter than its {size} bytes while it was attached")
            yield block


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


def _bytes(record: McapRecord) -> bytes:
    """A record as the library writes it."""
    from mcap.data_stream import RecordBuilder

    builder: Any = RecordBuilder()
    record.write(builder)
    return bytes(builder.end())
