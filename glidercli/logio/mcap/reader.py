"""How does an MCAP file that glider wrote become the Log again? The own topics are read, the viewers' are skipped."""

from __future__ import annotations

import dataclasses
import math
import os
import struct
import zlib
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.log import Event, Log, Origin
from glidercli.logio.mcap.beside import BESIDE
from glidercli.logio.mcap.file import MAGIC
from glidercli.logio.mcap.messages import Array, decoded, message_class
from glidercli.logio.mcap.topics import EVENT_TOPIC, field_names, template_of
from glidercli.logio.mcap.writer import AT_THE_END, FORMATS
from glidercli.logio.netcdf.times import FIRST, LAST
from glidercli.logio.own.rules import channels_of, unusable
from glidercli.logio.reader import Part
from glidercli.logio.records import NO_TIME
from glidercli.logio.report import FileReport

if TYPE_CHECKING:
    from mcap.summary import Summary

__all__ = ["Together", "is_mcap", "read_mcap", "read_mcap_log", "together_in"]

_MESSAGE, _FOOTER, _DATA_END = 0x05, 0x02, 0x0F  # opcodes
_HEAD = 31  # bytes of a message record before its payload; its log time stands at byte 15
_DATA_END_SIZE, _FOOTER_SIZE = 13, 29  # bytes of the whole records

Notes = Mapping[str, Mapping[str, str]]


class _Damaged(Exception):
    """The bytes are not what they should be."""


class Together(NamedTuple):
    """What a file of several flights holds beside the first: names by number, from 1 on, and the topics of the file."""

    names: Mapping[int, str]
    topics: frozenset[str]


class _Found(NamedTuple):
    """The messages of a topic: their kind and, with the 31 bytes before each, the records."""

    kind: type[Any]
    records: list[bytes]


def is_mcap(path: Path) -> bool:
    """Whether the file starts as an MCAP file does; False where it cannot be read."""
    try:
        with path.open("rb") as stream:
            return stream.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


def read_mcap(path: Path) -> Part:
    """The Log that `write_mcap` wrote, equal to the last bit, and its account: a record is a time of its messages.

    Of a file of several flights it is the first; a warning names the others.

    Records and values that cannot be used are dropped, left out and counted by the rules of ``own/rules.py``.
    Raises InputError for a file that is no MCAP, was not written by glider, or is cut short or damaged.
    """
    readable_file(path)
    if not is_mcap(path):
        raise InputError(path, "is no MCAP file: it does not start with the MCAP magic bytes")
    import zstandard
    from google.protobuf.message import DecodeError
    from mcap.exceptions import McapError
    from mcap.reader import SeekingReader

    try:
        with path.open("rb") as stream:
            _check_sums(stream)
            stream.seek(0)
            reader = SeekingReader(stream)
            notes: dict[str, dict[str, str]] = {}
            for record in reader.iter_metadata():
                name = record.name.removesuffix(AT_THE_END)
                notes[name] = record.metadata if name == record.name else {**notes.get(name, {}), **record.metadata}
            _check_written_by_glider(path, notes)
            summary = reader.get_summary()
            if summary is None:
                raise _Damaged("no summary")
            part = _part(path, notes, _topics(stream, summary))
            return part if not (others := _others(notes)) else _with_warning(part, others)
    except (
        _Damaged, McapError, zstandard.ZstdError, DecodeError, struct.error, ValueError, KeyError, IndexError, TypeError
    ) as fault:  # fmt: skip
        raise InputError(
            path, "is truncated or damaged; a whole MCAP file is needed (`pymcap-cli recover` may save most of it)"
        ) from fault


def read_mcap_log(path: Path) -> Log:
    """The Log of ``read_mcap``."""
    return read_mcap(path).log


def together_in(path: Path) -> Together | None:
    """What a file holds beside the first flight; None where it is no MCAP file of several flights."""
    if not path.is_file() or not is_mcap(path):
        return None
    from mcap.reader import SeekingReader

    with path.open("rb") as stream:
        reader = SeekingReader(stream)
        names = _others({record.name: record.metadata for record in reader.iter_metadata()})
        summary = reader.get_summary()
    if summary is None or not names:
        return None
    return Together(names, frozenset(channel.topic for channel in summary.channels.values()))


def _others(notes: Notes) -> dict[int, str]:
    """What each flight beside the first is called, by its number."""
    found = {int(name[len(BESIDE) :]): told["short_name"] for name, told in notes.items() if name.startswith(BESIDE)}
    return dict(sorted(found.items()))


def _with_warning(part: Part, others: Mapping[int, str]) -> Part:
    """The part of a file of several flights, with the others named."""
    told = "; ".join(f"/beside/{number} {name}" for number, name in others.items())
    warnings = (f"flights beside this one are not read: {told}", *part.report.warnings)
    return dataclasses.replace(part, report=dataclasses.replace(part.report, warnings=warnings))


def _check_written_by_glider(path: Path, notes: Notes) -> None:
    told = notes.get("version", {})
    if not told.get("program", "").startswith("glidercli ") or not {"run", "origin"} <= notes.keys():
        raise InputError(path, "is an MCAP file that glider did not write; one made by glider -o NAME.mcap is needed")
    if told.get("format") not in FORMATS:
        allowed = " and ".join(FORMATS)
        raise InputError(path, f"has layout {told.get('format')} of {told['program']}; layouts {allowed} can be read")


def _check_sums(stream: IO[bytes]) -> None:
    """Raise where the end is missing or a checksum of the data section or the summary is wrong; zero is none."""
    end = stream.seek(0, os.SEEK_END) - len(MAGIC)
    tail = _bytes_of(stream, max(end - _FOOTER_SIZE, 0), end + len(MAGIC))
    opcode, _, summary, _, summary_crc = struct.unpack_from("<BQQQI", tail)
    if opcode != _FOOTER or tail[_FOOTER_SIZE:] != MAGIC:
        raise _Damaged("no footer")
    if summary == 0:
        return
    if not _DATA_END_SIZE < summary <= end - _FOOTER_SIZE:
        raise _Damaged("a summary outside of the file")
    opcode, _, data_crc = struct.unpack("<BQI", _bytes_of(stream, summary - _DATA_END_SIZE, summary))
    if opcode != _DATA_END or data_crc not in (0, _sum_of(stream, 0, summary - _DATA_END_SIZE)):
        raise _Damaged("wrong checksum of the data section")
    if summary_crc not in (0, _sum_of(stream, summary, end - 4)):
        raise _Damaged("wrong checksum of the summary")


def _bytes_of(stream: IO[bytes], start: int, end: int) -> bytes:
    stream.seek(start)
    return stream.read(end - start)


def _sum_of(stream: IO[bytes], start: int, end: int) -> int:
    """CRC-32 of the bytes from start to end (exclusive)."""
    crc, step = 0, 1 << 22
    for at in range(start, end, step):
        crc = zlib.crc32(_bytes_of(stream, at, min(at + step, end)), crc)
    return crc


def _topics(stream: IO[bytes], summary: Summary) -> dict[str, _Found]:
    """The messages of glider's own topics."""
    from mcap.data_stream import ReadDataStream
    from mcap.records import Chunk
    from mcap.stream_reader import get_chunk_data_stream

    found, by_channel = {}, {}
    for channel in summary.channels.values():
        schema = summary.schemas[channel.schema_id]
        if schema.name.startswith("glider."):
            found[channel.topic] = _Found(message_class(schema.data, schema.name), [])
            by_channel[channel.id] = found[channel.topic].records
    for index in summary.chunk_indexes:
        stream.seek(index.chunk_start_offset + 9)
        data, length = get_chunk_data_stream(Chunk.read(ReadDataStream(stream)), validate_crc=True)
        block = data.read(length)
        at, head = 0, struct.Struct("<BQH")
        while at < length:
            opcode, size, channel_id = head.unpack_from(block, at)
            if opcode == _MESSAGE and channel_id in by_channel:
                by_channel[channel_id].append(block[at : at + 9 + size])
            at += 9 + size
    return found


def _part(path: Path, notes: Notes, topics: Mapping[str, _Found]) -> Part:
    """The Log of metadata records and messages. A message at the time of another of its topic is dropped."""
    told: dict[str, tuple[NDArray[np.int64], Array]] = {}
    dropped: Counter[str] = Counter()
    for topic, found in topics.items():
        if topic != EVENT_TOPIC and found.records:
            columns, repeated = _columns(found)
            told.update(columns)
            dropped.update({"time repeats": repeated} if repeated else {})
    origins = notes["origin"]
    names = {name: field_names(CHANNELS[name])[0] for name in origins["channels"].split()}
    time_ns = np.unique(np.concatenate([np.array([], np.int64), *(times for times, _ in told.values())]))
    values = {name: np.full(len(time_ns), np.nan) for name in names}
    for name, field in names.items():
        if field in told:
            times, column = told[field]
            values[name][np.searchsorted(time_ns, times)] = column
    records = len(time_ns) + dropped.total()
    warnings: list[str] = []
    of_channels = {name: cast(Origin, origins[name]) for name in names}
    time_ns = np.where((time_ns > FIRST) & (time_ns < LAST), time_ns, NO_TIME)
    channels, kept_ns = channels_of(time_ns, values, of_channels, dropped, warnings)
    events = _events(topics[EVENT_TOPIC]) if EVENT_TOPIC in topics else ()
    log = Log(channels, cast(Origin, origins["log"]), dict(notes["run"]), events)
    error = None if len(kept_ns) or not records else unusable(dropped, warnings)
    reasons = tuple(sorted(dropped.items()))
    return Part(log, FileReport(path, "glider-mcap", records, len(kept_ns), reasons, tuple(warnings), error), kept_ns)


def _columns(found: _Found) -> tuple[dict[str, tuple[NDArray[np.int64], Array]], int]:
    """Times and values of each field of a topic, in time order, NaN where there is no sample; and how many messages
    repeat a time, of which the first counts."""
    if len(set(map(len, found.records))) != 1:
        raise _Damaged("messages of unequal length")
    rows = np.frombuffer(b"".join(found.records), np.uint8).reshape(len(found.records), -1)
    time_ns = np.ascontiguousarray(rows[:, 15:23]).view("<i8")[:, 0].astype(np.int64)
    template, names = template_of(found.kind)
    values = decoded(template, rows[:, _HEAD:], len(names))
    if values is None:
        raise _Damaged("messages that do not fit their schema")
    times, first = np.unique(time_ns, return_index=True)
    columns = {name: (times, column[first]) for name, column in zip(names, values, strict=True)}
    return columns, len(time_ns) - len(times)


def _events(found: _Found) -> tuple[Event, ...]:
    """The events in the order of the file."""
    messages = [found.kind.FromString(record[_HEAD:]) for record in found.records]
    return tuple(Event(m.name, m.time_ns, None if math.isnan(m.depth_m) else m.depth_m) for m in messages)
