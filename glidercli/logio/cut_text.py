"""Does a text end in the middle of a line? Without a line end, and with a last line that lacks fields, it does.

A whole last line without a line end is no fault: editors and some transfers leave it so. Where a cut falls into the
last field of a line nothing shows it.
"""

from __future__ import annotations

__all__ = ["CUT", "ends_open"]

CUT = "ends in the middle of a line: only what stands before it was read"
"""The error of a file that was cut."""


def ends_open(data: bytes) -> bool:
    """Whether something stands behind the last line end."""
    return bool(data) and not data.endswith((b"\n", b"\r"))
