"""How can a file be damaged? One mutation of its bytes at random, by name."""

from __future__ import annotations

import gzip
import re
import zlib
from collections.abc import Callable

import numpy as np

Random = np.random.Generator

HOSTILE = (
    b"\x00" * 64, b"\x1b[31;1mred\x1b[0m", b"../../../etc/passwd", b"%s%n%x" * 20, b"'; DROP TABLE logs; --",
    "\u202egnp.exe".encode(), b"A" * 1_000_000, b"<script>alert(1)</script>", b"\xff\xfe\xfd", b"=cmd|'/c calc'!A1",
)  # fmt: skip
NUMBERS = (
    b"nan",
    b"inf",
    b"-inf",
    b"1e308",
    b"1e999",
    b"99999999999999999999",
    b"-0",
    b"",
    b"0x10",
    b"1,5",
    b"\xd9\xa3",
)
LENGTHS = (b"\xff\xff\xff\x7f", b"\xff\xff\xff\xff", b"\x00\x00\x00\x00", b"\x7f\xff\xff\xff", b"\x00\x00\x00\x80")


def _place(random: Random, data: bytes, size: int = 1) -> int:
    return int(random.integers(0, max(len(data) - size, 0) + 1))


def _block(random: Random, data: bytes) -> slice:
    size = int(random.integers(1, max(min(len(data), 4096), 2)))
    start = _place(random, data, size)
    return slice(start, start + size)


def truncated(random: Random, data: bytes) -> bytes:
    return data[: _place(random, data)]


def flipped(random: Random, data: bytes) -> bytes:
    found = bytearray(data)
    for _ in range(int(random.integers(1, 9))):
        found[int(random.integers(0, len(found)))] ^= 1 << int(random.integers(0, 8))
    return bytes(found)


def overwritten(random: Random, data: bytes) -> bytes:
    where = _block(random, data)
    size = where.stop - where.start
    filling = [bytes(size), b"\xff" * size, random.bytes(size)][int(random.integers(0, 3))]
    return data[: where.start] + filling + data[where.stop :]


def spliced(random: Random, data: bytes) -> bytes:
    block, at = data[_block(random, data)], _place(random, data)
    return data[:at] + block + data[at:]


def cut_out(random: Random, data: bytes) -> bytes:
    where = _block(random, data)
    return data[: where.start] + data[where.stop :]


def swapped(random: Random, data: bytes) -> bytes:
    a, b = sorted((_place(random, data), _place(random, data)))
    return data[:a] + data[b:] + data[a:b]


def lengthened(random: Random, data: bytes) -> bytes:
    at = _place(random, data, 4)
    return data[:at] + LENGTHS[int(random.integers(0, len(LENGTHS)))] + data[at + 4 :]


def hostile(random: Random, data: bytes) -> bytes:
    at = _place(random, data)
    return data[:at] + HOSTILE[int(random.integers(0, len(HOSTILE)))] + data[at:]


def misnumbered(random: Random, data: bytes) -> bytes:
    numbers = list(re.finditer(rb"-?\d+(\.\d+)?", data[: 1 << 20]))
    if not numbers:
        return flipped(random, data)
    match = numbers[int(random.integers(0, len(numbers)))]
    return data[: match.start()] + NUMBERS[int(random.integers(0, len(NUMBERS)))] + data[match.end() :]


def recoded(random: Random, data: bytes) -> bytes:
    text = data.decode("latin-1")
    codes: tuple[Callable[[], bytes], ...] = (
        lambda: text.encode("utf-16"),
        lambda: b"\xef\xbb\xbf" + data,
        lambda: text.encode("utf-8"),
        lambda: data.replace(b"\n", b"\r\n"),
        lambda: data.replace(b"\n", b"\r"),
        lambda: data.replace(b".", b","),
    )
    return codes[int(random.integers(0, len(codes)))]()


def packed(random: Random, data: bytes) -> bytes:
    return gzip.compress(data, 1)


def cut_gzip(random: Random, data: bytes) -> bytes:
    return truncated(random, gzip.compress(data, 1))


def bomb(random: Random, data: bytes) -> bytes:
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    zeros = bytes(1 << 20)
    parts = [packer.compress(data[:2048]), *(packer.compress(zeros) for _ in range(150)), packer.flush()]
    return b"".join(parts)


MUTATIONS: tuple[Callable[[Random, bytes], bytes], ...] = (
    truncated, flipped, overwritten, spliced, cut_out, swapped, lengthened, hostile, misnumbered, recoded, packed, cut_gzip,
)  # fmt: skip
"""Each equally likely; a bomb is rare, since it takes long to make."""


def mutated(random: Random, data: bytes) -> tuple[str, bytes]:
    """The name of a mutation and the data after it."""
    if random.random() < 0.005:
        return "bomb", bomb(random, data)
    mutation = MUTATIONS[int(random.integers(0, len(MUTATIONS)))]
    return mutation.__name__, mutation(random, data)
