"""Is an ADCP's binary whole? Its records are walked by their lengths, and their checksums are added up.

RDI PD0 (WorkHorse Commands and Output Data Format): an ensemble begins with 7F 7F, a record of waves with 7F 79, and
its length in bytes without the checksum, which is the sum of all bytes before it. Nortek .ad2cp (Signature Principles
of Operation, data formats): a record begins with A5, the size of the header, an identifier, a family, the size of the
data and their checksum, the sum of their words from B58C on. Both come out right in every real file at hand.
"""

from __future__ import annotations

import re
import struct

import numpy as np

from glidercli.ocean.kind import PD0

__all__ = ["remarks_on_ends"]

_PD0_MARK, _NORTEK_MARK = re.compile(b"\x7f[\x7f\x79]"), re.compile(b"\xa5")
_NORTEK_HEAD, _NORTEK_LONG_HEAD = 10, 12
_NORTEK_SEED = 0xB58C


def remarks_on_ends(data: bytes, kind: str) -> tuple[str, ...]:
    """What is wrong with the records of a file, a line each; nothing of a whole one."""
    whole, wrong, lost = (_walk_pd0 if kind == PD0 else _walk_nortek)(data)
    remarks = []
    if wrong:
        remarks.append(f"{wrong} of {whole + wrong} records have a wrong checksum")
    if lost:
        remarks.append(f"cut short or damaged: {lost} bytes belong to no whole record")
    return tuple(remarks)


def _find(mark: re.Pattern[bytes], data: bytes, start: int) -> int:
    """Where the next mark stands, or -1."""
    found = mark.search(data, start)
    return found.start() if found else -1


def _walk_pd0(data: bytes) -> tuple[int, int, int]:
    """Whole ensembles, those with a wrong checksum, and bytes outside of both."""
    whole = wrong = covered = 0
    at = _find(_PD0_MARK, data, 0)
    while at >= 0:
        (length,) = struct.unpack_from("<H", data.ljust(at + 4, b"\0"), at + 2)
        end = at + length
        if length < 6 or end + 2 > len(data):
            at = _find(_PD0_MARK, data, at + 1)
            continue
        told = struct.unpack_from("<H", data, end)[0]
        right = int(np.frombuffer(data, np.uint8, length, at).sum(dtype=np.int64)) & 0xFFFF == told
        if not right and end + 2 < len(data) and _find(_PD0_MARK, data, end + 2) != end + 2:
            at = _find(_PD0_MARK, data, at + 1)  # these two bytes began no ensemble
            continue
        whole, wrong, covered = whole + right, wrong + (not right), covered + length + 2
        at = _find(_PD0_MARK, data, end + 2)
    return whole, wrong, len(data) - covered


def _walk_nortek(data: bytes) -> tuple[int, int, int]:
    """Whole records, those with a wrong checksum, and bytes outside of both."""
    whole = wrong = covered = 0
    at = _find(_NORTEK_MARK, data, 0)
    while at >= 0:
        head = data[at + 1] if at + 1 < len(data) else 0
        if head not in (_NORTEK_HEAD, _NORTEK_LONG_HEAD) or at + head > len(data):
            at = _find(_NORTEK_MARK, data, at + 1)
            continue
        size, told = struct.unpack_from("<HH" if head == _NORTEK_HEAD else "<IH", data, at + 4)
        end = at + head + size
        if end > len(data):
            at = _find(_NORTEK_MARK, data, at + 1)
            continue
        right = _nortek_sum(data[at + head : end]) == told
        if not right and end < len(data) and _find(_NORTEK_MARK, data, end) != end:
            at = _find(_NORTEK_MARK, data, at + 1)
            continue
        whole, wrong, covered = whole + right, wrong + (not right), covered + head + size
        at = _find(_NORTEK_MARK, data, end)
    return whole, wrong, len(data) - covered


def _nortek_sum(data: bytes) -> int:
    words = int(np.frombuffer(data, "<u2", len(data) // 2).sum(dtype=np.int64))
    return (_NORTEK_SEED + words + (data[-1] << 8 if len(data) % 2 else 0)) & 0xFFFF
