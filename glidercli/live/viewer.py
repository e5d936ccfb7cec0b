"""What does anything that shows a log have to do? The one interface of all viewers."""

from __future__ import annotations

from typing import Protocol

from glidercli.log import Log

__all__ = ["Viewer"]


class Viewer(Protocol):
    """Something that shows a log. Each call but ``close`` raises ConnectionError where it has left for good.

    starts_over : whether it shows a track that moved as a new recording, for which it is given all samples anew.
    """

    starts_over: bool

    @property
    def name(self) -> str:
        """What it is, for people."""
        ...

    def begin(self, log: Log, past: Log | None) -> None:
        """Get ready for the channels of a log. past : what was shown before, or None; it is not shown again."""
        ...

    def add(self, piece: Log) -> None:
        """Show a piece."""
        ...

    def whole(self, log: Log, whole: Log, panels: bool) -> None:
        """Show what is known of the whole: its track, notes, metadata.

        log : with all events and metadata. whole : all samples that are to be drawn; those shown, or those to come.
        panels : whether panels and cameras are arranged anew.
        """
        ...

    def clock(self, time_ns: int) -> None:
        """Let it know the log's time, UTC ns."""
        ...

    def check(self) -> None:
        """See whether it is still there."""
        ...

    def close(self, patient: bool) -> None:
        """End it. patient : whether it may first get what waits for it."""
        ...
