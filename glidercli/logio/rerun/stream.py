"""How does a Log reach a Rerun viewer that runs? Over its local connection, the same chunks that a file holds."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from glidercli.log import Log
from glidercli.logio.rerun.contents import Contents

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["RerunStream"]

LONGEST, STEP = 60.0, 1.0
"""s that a viewer may take to accept what was sent, and between two looks whether it is alive."""


class RerunStream:
    """One recording, sent to a viewer.

    url : of the viewer, which must listen already: rerun+http://HOST:PORT/proxy. name : what it is, for people. alive :
    whether it still runs. Every call raises ConnectionError where it does not, or takes nothing.
    """

    def __init__(self, url: str, name: str, alive: Callable[[], bool]) -> None:
        self._name, self._alive = name, alive
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

    def whole(self, contents: Contents, log: Log, following: bool, panels: bool, sections: bool) -> None:
        """Send what shows the whole, but events.

        following : whether the viewer's clock goes with what comes. panels : whether they are arranged anew, and the
        water's sections drawn anew. sections : whether there are any.
        """
        import rerun as rr
        import rerun.blueprint as rrb

        if panels:
            self._times += 1
        entity = f"/section/{self._times}" if panels and sections else None
        chunks, views = contents.whole(log, events=False, sections=entity, grows=following)
        self._send(chunks)
        if panels:
            if following:
                timeline = views.time_panel.timeline
                views.time_panel = rrb.TimePanel(state="collapsed", timeline=timeline, play_state="following")
            rr.send_blueprint(views, recording=self._recording)
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
        """Until the viewer has taken what was sent; in short steps, so that Ctrl-C and its end are seen."""
        recording: Any = self._recording
        until = time.monotonic() + LONGEST
        while True:
            try:
                recording.flush(timeout_sec=STEP)
                return
            except (RuntimeError, ValueError) as error:  # all that Rerun tells
                if "timed out" not in str(error) or not self._alive():
                    raise ConnectionError(f"{self._name} was closed") from None
                if time.monotonic() > until:
                    raise ConnectionError(f"{self._name} took nothing for {LONGEST:.0f} s") from None
