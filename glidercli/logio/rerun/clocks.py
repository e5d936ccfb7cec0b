"""On which clock do logs stand side by side? On UTC where they overlap; where they do not, all start together."""

from __future__ import annotations

from glidercli.log import Log

__all__ = ["CLOCK_NOTE", "aligned"]

CLOCK_NOTE = "clock_note"
"""Key of the metadata that tells of a clock that was shifted."""


def aligned(log: Log, other: Log) -> Log:
    """The other log on a clock on which both can be seen at once; of one that was shifted the metadata tell it."""
    if max(log.start_ns, other.start_ns) <= min(log.end_ns, other.end_ns):
        return other
    shift_ns = log.start_ns - other.start_ns
    told = f"shifted by {shift_ns / 1e9:+.3f} s: it does not overlap in UTC, so both start at elapsed 0"
    return other.shifted(shift_ns).with_metadata(**{CLOCK_NOTE: told})
