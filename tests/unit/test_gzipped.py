"""Gzip data: whole, cut, damaged, of several members, and bombs."""

from __future__ import annotations

import gzip
import time
import tracemalloc
import zlib
from pathlib import Path

import pytest

from glidercli.errors import InputError
from glidercli.gzipped import LEAST, beginning, unpacked

TEXT = b"".join(b"%d;%d\n" % (i, i * i) for i in range(20_000))
HERE = Path("a.gz")


def test_plain_and_packed_are_the_same() -> None:
    assert unpacked(HERE, TEXT) == (TEXT, True)
    assert unpacked(HERE, gzip.compress(TEXT)) == (TEXT, True)
    assert unpacked(HERE, gzip.compress(TEXT) + gzip.compress(TEXT)) == (TEXT + TEXT, True)
    assert unpacked(HERE, gzip.compress(TEXT) + bytes(512)) == (TEXT, True)  # padding, as on tapes


def test_cut_data_are_given_as_far_as_they_go() -> None:
    packed = gzip.compress(TEXT)
    for size in (30, len(packed) // 2, len(packed) - 1):
        data, whole = unpacked(HERE, packed[:size])
        assert not whole
        assert TEXT.startswith(data)
    assert unpacked(HERE, packed + b"more")[1] is False


def test_a_wrong_checksum_is_no_whole_file() -> None:
    packed = bytearray(gzip.compress(TEXT))
    packed[-5] ^= 1  # of the size, the last four bytes after the checksum
    assert unpacked(HERE, bytes(packed))[1] is False


def test_a_bomb_is_refused_before_it_fills_the_memory() -> None:
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    zeros = bytes(1 << 20)
    bomb = b"".join(packer.compress(zeros) for _ in range(1000)) + packer.flush()
    tracemalloc.start()
    try:
        with pytest.raises(InputError, match="unpack to more than"):
            unpacked(HERE, bomb)
        assert tracemalloc.get_traced_memory()[1] < 2 * max(LEAST, 100 * len(bomb))
    finally:
        tracemalloc.stop()
    assert len(beginning(bomb, 4096)) == 4096


def test_many_small_members_take_no_time() -> None:
    """100,000 members in 2 MB: 0.3 s; copying the rest at each took 8 s, and a hundred times that for 20 MB."""
    data = gzip.compress(b"a") * 100_000
    start = time.process_time()
    assert unpacked(Path("x"), data) == (b"a" * 100_000, True)
    assert time.process_time() - start < 4.0  # not the clock's, which others at work slow down
