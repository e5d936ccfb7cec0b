"""Are the global heaps of an HDF5 file whole? They are walked before the library opens it.

The HDF5 library (2.0 and before) walks a heap by the sizes written in it, and goes round for ever at an object 0 of no
size, as a block of zeros makes one. Layout: HDF5 File Format Specification 3.0, III.E "Global Heap": "GCOL", version 1,
three reserved bytes, size of the collection; then objects of an index (2 bytes), a count (2), 4 reserved bytes, a size
(8) and as many bytes, padded to 8. Object 0 is the free space; its size counts from its own begin.
"""

from __future__ import annotations

import mmap
import struct

__all__ = ["check_heaps"]

MARK = b"GCOL\x01\x00\x00\x00"
HEAD = 16
"""Bytes of the head of a collection, and of that of an object."""


def check_heaps(data: bytes | mmap.mmap) -> None:
    """Raise ValueError where a global heap of an HDF5 file does not add up."""
    start = data.find(MARK)
    while start >= 0:
        _check(data, start)
        start = data.find(MARK, start + HEAD)


def _check(data: bytes | mmap.mmap, start: int) -> None:
    if start + HEAD > len(data):
        raise ValueError("a global heap is cut short")
    (size,) = struct.unpack_from("<Q", data, start + 8)
    end, at = start + size, start + HEAD
    if size < HEAD or end > len(data):
        raise ValueError("a global heap should reach beyond the end of the file")
    while end - at >= HEAD:
        index, _, _, length = struct.unpack_from("<HHIQ", data, at)
        step = HEAD + length + -length % 8 if index else length
        if step < HEAD or at + step > end:
            raise ValueError("a global heap holds an object that does not fit in it")
        at += step
