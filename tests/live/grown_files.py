"""Files that grow, for tests: the same bytes in pieces that end anywhere."""

from __future__ import annotations

import random
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from glidercli.log import Channel, Log

DATA = Path(__file__).parent.parent / "data"


def growing(source: Path, target: Path, pieces: int, seed: int) -> Iterator[int]:
    """Append the source to the target, piece by piece; half of them are bursts. Gives the size after each."""
    data, chance = source.read_bytes(), random.Random(seed)
    cuts = sorted(chance.sample(range(1, len(data)), pieces - 1))
    target.touch()
    with target.open("ab") as stream:
        for first, last in zip([0, *cuts], [*cuts, len(data)], strict=True):
            stream.write(data[first:last])
            stream.flush()
            yield last


def appended(pieces: list[Log]) -> dict[str, Channel]:
    """The channels of pieces, one behind the other; raises where times do not increase."""
    channels: dict[str, Channel] = {}
    for name in dict.fromkeys(name for piece in pieces for name in piece.channels):
        parts = [piece[name] for piece in pieces if name in piece.channels]
        channels[name] = Channel(
            name,
            np.concatenate([part.time_ns for part in parts]),
            np.concatenate([part.values for part in parts]),
            parts[-1].origin,
        )
    return {name: channel for name, channel in channels.items() if len(channel)}
