"""What do gzip data hold? As far as they are whole, and no more than a log can be."""

from __future__ import annotations

import zlib
from pathlib import Path

from glidercli.errors import InputError

__all__ = ["DAMAGED", "beginning", "is_gzip", "unpacked"]

PIECE = 4096
"""Bytes unpacked at a time, so that what stands before a damage is not lost."""
LEAST, RATIO = 64_000_000, 100
"""Data may unpack to so many bytes, or so many times their own; tables of numbers pack to a tenth, not a hundredth."""
DAMAGED = "gzip data cut short or damaged: only what could be unpacked was read"
"""The error of a file whose gzip data are not whole."""
_GZIP = b"\x1f\x8b"
_WINDOW = 31  # zlib's way to say gzip


def is_gzip(data: bytes) -> bool:
    """Whether data begin as gzip does."""
    return data[:2] == _GZIP


def beginning(data: bytes, most: int) -> bytes:
    """The first bytes that the data hold, unpacked if they are gzip, as far as that goes."""
    if not is_gzip(data):
        return data[:most]
    member, pieces = zlib.decompressobj(wbits=_WINDOW), list[bytes]()
    try:
        for at in range(0, len(data), PIECE):
            pieces.append(member.decompress(data[at : at + PIECE], most))
            most -= len(pieces[-1])
            if most <= 0 or member.eof:
                break
    except zlib.error:
        pass  # what stands before the damage is told
    return b"".join(pieces)


def unpacked(path: Path, data: bytes) -> tuple[bytes, bool]:
    """What gzip data hold as far as they are whole, and whether they are whole; other data as they are.

    Raises InputError where they unpack to far more than any log would.
    """
    if not is_gzip(data):
        return data, True
    most = max(LEAST, RATIO * len(data))
    pieces, size, at = [], 0, 0
    while is_gzip(data[at : at + 2]):  # members of a gzip file follow one another
        member = zlib.decompressobj(wbits=_WINDOW)
        try:
            while at < len(data) and not member.eof:
                piece = member.decompress(data[at : at + PIECE])
                size += len(piece)
                if size > most:
                    raise InputError(path, f"is gzip data that unpack to more than {most / 1e6:.0f} MB; no log does")
                pieces.append(piece)
                at = min(at + PIECE, len(data)) - len(member.unused_data)
        except zlib.error:
            return b"".join(pieces), False
        if not member.eof:
            return b"".join(pieces), False
    return b"".join(pieces), not data[at:].strip(b"\0")
