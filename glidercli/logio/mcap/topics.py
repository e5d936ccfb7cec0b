"""What do glider's own topics hold? /glider/GROUP, one for each family of channels, and /glider/event.

The messages of glider's own topics are described at run time from the channel table: `timestamp`, one double per
channel in SI units (``pitch_rad``), and a second one for people where tables use another unit (``pitch_deg``); depth is
there as elevation too, negative down, so that a plot has the surface on top. NaN marks a channel without a sample at
that time. Field numbers follow the channel table, so that files agree with each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from glidercli.channels import CHANNELS, ChannelSpec
from glidercli.log import Event, Log
from glidercli.logio.mcap.messages import MARKED_TIME, Messages, Table, all_times, own_class, slot, timestamp

__all__ = ["EVENT_TOPIC", "ChannelTopics", "event_topics", "field_names", "template_of"]

EVENT_TOPIC = "/glider/event"


def field_names(spec: ChannelSpec) -> tuple[str, ...]:
    """Names of a channel's fields: SI first (``pitch_rad``), then that for people, if any (``pitch_deg``)."""
    return tuple(_fields(spec))


def _fields(spec: ChannelSpec) -> dict[str, float]:
    """The channel's fields, and what the SI value is multiplied by for each."""
    si = spec.name if spec.unit == "1" else f"{spec.name}_{spec.unit.replace('/', '_')}"
    if spec.name == "depth":
        return {si: 1.0, "elevation_m": -1.0}
    return {si: 1.0} if spec.factor == 1.0 else {si: 1.0, spec.column: spec.factor}


def template_of(kind: type[Any]) -> tuple[Any, list[str]]:
    """A template of one of glider's own messages, and the names of its doubles in the order of their marks."""
    template = kind(timestamp=MARKED_TIME)
    names = [field.name for field in kind.DESCRIPTOR.fields if field.name != "timestamp"]
    for index, name in enumerate(names):
        setattr(template, name, slot(index))
    return template, names


class ChannelTopics:
    """The topics /glider/GROUP of a log that comes in pieces: one for each family of channels with a sample.

    log : the first piece; the channels that have samples there are the ones that can come. package : of the messages.
    """

    def __init__(self, log: Log, package: str = "glider") -> None:
        from google.protobuf.descriptor_pb2 import FieldDescriptorProto

        double = int(FieldDescriptorProto.TYPE_DOUBLE)
        self._families: list[tuple[str, list[ChannelSpec], Any, dict[str, str]]] = []
        for group in dict.fromkeys(spec.group for spec in CHANNELS.values()):
            family = [spec for spec in CHANNELS.values() if spec.group == group]
            kept = [(i, spec) for i, spec in enumerate(family) if spec.name in log and len(log[spec.name])]
            if not kept:
                continue
            fields, notes = [], {}
            for i, spec in kept:
                for offset, name in enumerate(field_names(spec)):
                    fields.append((name, 2 + 2 * i + offset, double))
                    notes[name] = f"{spec.meaning}; {log[spec.name].origin}"
            template, _ = template_of(own_class(group.capitalize(), fields, package))
            self._families.append((f"/glider/{group}", [spec for _, spec in kept], template, notes))

    def tables(self, piece: Log) -> list[Table]:
        """A piece's messages, at all sample times of each family."""
        found = []
        for topic, family, template, notes in self._families:
            time_ns = all_times([piece[spec.name].time_ns for spec in family])
            columns = []
            for spec in family:
                values = np.full(len(time_ns), np.nan)
                values[np.searchsorted(time_ns, piece[spec.name].time_ns)] = piece[spec.name].values
                columns += [values * factor for factor in _fields(spec).values()]
            found.append(Table(topic, time_ns, template, columns, notes))
        return found


def event_topics(events: Sequence[Event], package: str = "glider") -> list[Messages]:
    """The topic /glider/event, or none without events; depth is NaN where it is unknown."""
    from google.protobuf.descriptor_pb2 import FieldDescriptorProto as F

    fields = [("name", 2, F.TYPE_STRING), ("time_ns", 3, F.TYPE_INT64), ("depth_m", 4, F.TYPE_DOUBLE)]
    kind = own_class("Event", [(name, number, int(type_)) for name, number, type_ in fields], package)
    messages = [
        kind(
            timestamp=timestamp(event.time_ns),
            name=event.name,
            time_ns=event.time_ns,
            depth_m=np.nan if event.depth is None else event.depth,
        )
        for event in events
    ]
    times = np.array([event.time_ns for event in events], np.int64)
    return [Messages(EVENT_TOPIC, times, messages)] if messages else []
