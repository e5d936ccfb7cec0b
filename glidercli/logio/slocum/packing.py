"""How are the compressed files of a Slocum unpacked? Blocks of LZ4, each preceded by its length in two bytes.

Compressed are the files of which the middle letter of the ending is c: dcd, ecd, mcd, ncd, scd, tcd and the caches ccc.
The length is big-endian, a block unpacks to BLOCK bytes, the last one to what is left. Seen in files of 2023 and 2025.
"""

from __future__ import annotations

__all__ = ["LABEL", "is_packed", "unpacked"]

LABEL = b"dbd_label:"
"""How a data file begins."""
BLOCK = 32768
"""Bytes that a block unpacks to at most; a damaged one cannot ask for more."""


def is_packed(head: bytes, begins: bytes) -> bool:
    """Whether a file is compressed, by its first 16 bytes. begins : how it begins when it is not.

    The first block repeats nothing yet, so that the text stands in it as it is, after length and token.
    """
    return not head.startswith(begins) and begins in head[:16]


def unpacked(data: bytes) -> tuple[bytes, int | None]:
    """The bytes of a compressed file as far as they go, and where a damaged or cut block begins, or None."""
    import lz4.block

    pieces: list[bytes] = []
    at = 0
    while at < len(data):
        size = int.from_bytes(data[at : at + 2], "big")
        block = data[at + 2 : at + 2 + size]
        if size == 0 or len(block) < size:
            return b"".join(pieces), at
        try:
            pieces.append(lz4.block.decompress(block, uncompressed_size=BLOCK))
        except (lz4.block.LZ4BlockError, ValueError):
            return b"".join(pieces), at
        at += 2 + size
    return b"".join(pieces), None
