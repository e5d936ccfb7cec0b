"""What stands in an MCAP file? Its messages, by the descriptors that it holds and nothing else."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path
from typing import Any

from google.protobuf.descriptor_pb2 import FileDescriptorSet
from google.protobuf.descriptor_pool import DescriptorPool
from google.protobuf.message_factory import GetMessageClass
from mcap.reader import make_reader

Written = dict[str, list[tuple[int, Any]]]


def messages(path: Path) -> Written:
    """All messages by topic as (log time, message)."""
    kinds: dict[int, Any] = {}
    found: Written = defaultdict(list)
    with path.open("rb") as stream:
        for schema, own, message in make_reader(stream, validate_crcs=True).iter_messages():
            assert schema is not None
            assert message.publish_time == message.log_time
            if schema.id not in kinds:
                pool = DescriptorPool()
                for file in FileDescriptorSet.FromString(schema.data).file:
                    pool.Add(file)
                kinds[schema.id] = GetMessageClass(pool.FindMessageTypeByName(schema.name))
            found[own.topic].append((message.log_time, kinds[schema.id].FromString(message.data)))
    return found
