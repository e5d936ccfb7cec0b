"""Which viewers are still there? They are started together, each may leave, and all are ended together."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator, Sequence

from glidercli.errors import InputError
from glidercli.live.choices import Choices
from glidercli.live.foxglove_viewer import FoxgloveViewer
from glidercli.live.rerun_viewer import RerunViewer
from glidercli.live.viewer import Viewer
from glidercli.log import Log

__all__ = ["CHECK", "Viewers", "opened"]

CHECK = 0.2
"""s between two looks whether viewers are still there."""
SETTLED = 0.5
"""s without a new subscription after which a viewer has all that it asks for at first."""


class Over(Exception):
    """Nothing is left to be shown, or nobody to show it to."""


class Viewers:
    """The viewers that are still there."""

    def __init__(self, choices: Choices, tell: Callable[[str], None]) -> None:
        self._choices, self._tell = choices, tell
        self.all: list[Viewer] = []
        self.websocket: FoxgloveViewer | None = None

    def each(self, do: Callable[[Viewer], None], chosen: Sequence[Viewer] | None = None) -> None:
        """Have every viewer do something; one that has left is told and given up; the last ends it all.

        chosen : the viewers that do it; None for all.
        """
        for viewer in list(self.all if chosen is None else chosen):
            if viewer not in self.all:
                continue
            try:
                do(viewer)
            except ConnectionError as error:
                self.all.remove(viewer)
                viewer.close(patient=False)
                self._tell(f"{error}; " + ("the others go on" if self.all else "no viewer is left"))
        if not self.all:
            raise Over

    def show(self, piece: Log, now_ns: int) -> None:
        """Have every viewer show a piece, and let it know the log's time."""
        self.each(lambda viewer: viewer.add(piece))
        self.each(lambda viewer: viewer.clock(now_ns))

    def check(self) -> None:
        """See who is still there."""
        self.each(lambda viewer: viewer.check())

    def await_first(self, needed: bool) -> None:
        """Wait for a viewer of the WebSocket, if there is one.

        needed : whether it is an InputError that none comes, where there is nothing else to see.
        """
        if self.websocket is None:
            return
        server, wait = self.websocket.server, self._choices.wait
        self._tell(f"waiting up to {wait:g} s for a viewer at {server.address}")
        if self._watched(wait):
            return
        if needed and self.all == [self.websocket]:
            raise InputError("--rate", f"no viewer subscribed at {server.address} within {wait:g} s (--wait S)")
        self._tell(f"no viewer at {server.address} within {wait:g} s; it goes on without")

    def await_return(self) -> float:
        """Where nobody watches, wait for somebody; how long that took, s."""
        if self.websocket is None or self.all != [self.websocket] or self.websocket.server.watched:
            return 0.0
        begun, wait = time.monotonic(), self._choices.wait
        self._tell(f"nobody watches: the play pauses up to {wait:g} s")
        if not self._watched(wait):
            self._tell(f"nobody came back within {wait:g} s: the play ends before the log does")
            raise Over
        self._tell("somebody watches: the play goes on")
        return time.monotonic() - begun

    def stay(self) -> None:
        """Until the last window is closed, or Ctrl-C; where only a WebSocket is left there is nothing more to see."""
        self._tell("all is sent; Ctrl-C ends it" if self.all != [self.websocket] else "played to the end")
        while self.all != [self.websocket]:
            self.check()
            time.sleep(CHECK)

    def _watched(self, seconds: float) -> bool:
        """Whether somebody subscribes within so many s; what else is asked for at once is waited for."""
        assert self.websocket is not None
        server = self.websocket.server
        until = time.monotonic() + seconds
        while not server.watched:
            if time.monotonic() > until:
                return False
            self.check()
            time.sleep(0.02)
        self.settle()
        return True

    def settle(self) -> None:
        """Let viewers of the WebSocket subscribe to what they were told of."""
        if self.websocket is None or not self.websocket.server.watched:
            return
        server = self.websocket.server
        count, since = server.subscriptions, time.monotonic()
        while time.monotonic() - since < SETTLED:
            time.sleep(0.02)
            if server.subscriptions != count:
                count, since = server.subscriptions, time.monotonic()


@contextlib.contextmanager
def opened(log: Log, choices: Choices, tell: Callable[[str], None]) -> Iterator[Viewers]:
    """Start the viewers; whatever happens, they are ended when the block is left."""
    viewers = Viewers(choices, tell)
    patient = False
    with contextlib.ExitStack() as ending:

        def started(viewer: Viewer) -> None:
            ending.callback(lambda: viewer.close(patient))
            viewers.all.append(viewer)

        if choices.websocket:
            viewers.websocket = FoxgloveViewer(log, None if choices.serve else choices.port, tell)
            started(viewers.websocket)
            tell(f"Foxglove, Lichtblick: open a connection, Foxglove WebSocket, {viewers.websocket.server.address}")
        following = choices.follow or choices.pace is not None
        for web in [True] * choices.serve + [False] * choices.spawn:
            viewer = RerunViewer(web, choices.port, following, choices.pace is not None)
            started(viewer)
            if web:
                tell(f"Rerun: open {viewer.address} in a browser; Ctrl-C ends it")
        with contextlib.suppress(Over):
            yield viewers
        patient = True
