"""How does a Log reach a Rerun viewer that runs? Over its local connection, the same chunks that a file holds."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from glidercli.log import Log
from glidercli.logio.rerun.contents import Contents

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["RerunStream"]

LONGEST = 10.0
"""s that a viewer may take to accept what was sent."""


class RerunStream:
    """One recording, sent to a viewer. url : of the viewer, which must listen already: rerun+http://HOST:PORT/proxy.

    Every call raises ConnectionError where the viewer has left.
    """

    def __init__(self, url: str) -> None:
        os.environ.setdefault("RUST_LOG", "off")  # faults are ours to tell
        import rerun as rr

        rr.set_strict_mode(True)
        self._recording = rr.RecordingStream("glider", send_properties=False)
        self._recording.set_log_time_enabled(False)
        self._recording.connect_grpc(url)
        self._times = 0

    def begin(self, contents: Contents) -> None:
        """Send how things are drawn."""
        self._send(contents.styles())

    def samples(self, contents: Contents, piece: Log) -> None:
        """Send the samples and events of a piece."""
        if any(map(len, piece.channels.values())):
            for chunks in contents.samples(piece):
                self._send(chunks)
        self._send(contents.events(piece.events))

    def whole(self, contents: Contents, log: Log, following: bool, panels: bool) -> None:
        """Send what shows the whole, but events.

        following : whether the viewer's clock goes with what comes. panels : whether they are arranged anew, and the
        water's sections drawn anew.
        """
        import rerun as rr
        import rerun.blueprint as rrb

        if panels:
            self._times += 1
        sections = f"/section/{self._times}" if panels else None
        chunks, views = contents.whole(log, events=False, sections=sections)
        self._send(chunks)
        if panels:
            if following:
                timeline = views.time_panel.timeline
                views.time_panel = rrb.TimePanel(state="collapsed", timeline=timeline, play_state="following")
            rr.send_blueprint(views, recording=self._recording)
            self._flush()

    def check(self) -> None:
        """Raise ConnectionError where the viewer has left."""
        self._flush()

    def close(self) -> None:
        """Leave the viewer with what it has."""
        self._recording.disconnect()

    def _send(self, chunks: list[Chunk]) -> None:
        import rerun as rr

        if chunks:
            rr.send_chunks(chunks, recording=self._recording)
            self._flush()

    def _flush(self) -> None:
        recording: Any = self._recording
        try:
            recording.flush(timeout_sec=LONGEST)
        except (RuntimeError, ValueError):  # all that Rerun tells
            raise ConnectionError("the Rerun viewer left") from None
