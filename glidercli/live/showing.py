"""How does a log go to its viewers, and when is that over? At once, at a pace, or as its files grow, until Ctrl-C.

Over is it when the user says so, when the last viewer is closed, or when a play that only a WebSocket shows has come
to its end. All of these are normal ends.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator

from glidercli.errors import InputError
from glidercli.live.choices import Choices
from glidercli.live.following import Follower, Step
from glidercli.live.foxglove_viewer import FoxgloveViewer
from glidercli.live.pacing import Pace
from glidercli.live.rerun_viewer import RerunViewer
from glidercli.live.viewer import Viewer
from glidercli.log import Log

__all__ = ["follow", "show"]

Tell = Callable[[str], None]
CHECK = 0.2
"""s between two looks whether viewers are still there."""
SETTLED = 0.5
"""s without a new subscription after which a viewer has all that it asks for at first."""
POLL, SHARE = 1.0, 4.0
"""s between two looks at files, at least, and at least so many times what a look takes."""
GREW, DOUBLED = 1.02, 2.0
"""By how much a log grows until its track is drawn anew, and until cameras are set anew."""


def show(log: Log, choices: Choices, tell: Tell) -> None:
    """Show a log that is known as a whole; returns when that is over, and ends all that it started.

    tell : is told, a line each, where to look and what happens to viewers.
    """
    with contextlib.suppress(KeyboardInterrupt), _viewers(log, choices, tell) as viewers:
        viewers.each(lambda viewer: viewer.begin(log, None))
        viewers.each(lambda viewer: viewer.whole(log, log, panels=True))
        if choices.pace is None:
            viewers.each(lambda viewer: viewer.add(log))
        else:
            viewers.await_first()
            _play(log, choices.pace, viewers)
        viewers.stay()


def follow(follower: Follower, choices: Choices, tell: Tell) -> None:
    """Show what files hold, and what is added to them, until Ctrl-C or until the last window is closed."""
    with contextlib.suppress(KeyboardInterrupt):
        while (step := follower.look()) is None:
            time.sleep(max(POLL, SHARE * follower.took))
        with _viewers(step.log, choices, tell) as viewers:
            tell("following; Ctrl-C ends it")
            drawn = sized = 0
            shown: Log | None = None
            while True:
                if step is not None:
                    drawn, sized = _take(step, shown, drawn, sized, viewers)
                    shown = step.log
                until = time.monotonic() + max(POLL, SHARE * follower.took)
                while time.monotonic() < until:
                    viewers.check()
                    time.sleep(CHECK)
                step = follower.look()


def _take(step: Step, shown: Log | None, drawn: int, sized: int, viewers: _Viewers) -> tuple[int, int]:
    """Show what a look gave. drawn, sized : samples when the track, and the cameras, were last made anew; now."""
    count = sum(map(len, step.log.channels.values()))
    again = step.moved
    if shown is None or step.fresh or again:
        viewers.each(lambda viewer: viewer.begin(step.log, None if again and viewer.starts_over else shown))
    viewers.each(lambda viewer: viewer.add(step.log if again and viewer.starts_over else step.piece))
    anew = shown is None or step.fresh or again or count > DOUBLED * sized
    if anew or count > GREW * drawn:
        viewers.each(lambda viewer: viewer.whole(step.log, step.log, panels=anew))
        drawn = count
    viewers.each(lambda viewer: viewer.clock(step.log.end_ns))
    return drawn, count if anew else sized


class _Viewers:
    """The viewers that are still there."""

    def __init__(self, choices: Choices, tell: Tell) -> None:
        self._choices, self._tell = choices, tell
        self.all: list[Viewer] = []
        self.websocket: FoxgloveViewer | None = None

    def each(self, do: Callable[[Viewer], None]) -> None:
        """Have every viewer do something; one that has left is told and given up; the last ends it all."""
        for viewer in list(self.all):
            try:
                do(viewer)
            except ConnectionError as error:
                self.all.remove(viewer)
                viewer.close(patient=False)
                self._tell(f"{error}; " + ("the others go on" if self.all else "no viewer is left"))
        if not self.all:
            raise _Over

    def show(self, piece: Log, now_ns: int) -> None:
        """Have every viewer show a piece, and let it know the log's time."""
        self.each(lambda viewer: viewer.add(piece))
        self.each(lambda viewer: viewer.clock(now_ns))

    def check(self) -> None:
        """See who is still there."""
        self.each(lambda viewer: viewer.check())

    def await_first(self) -> None:
        """Wait for a viewer of the WebSocket, if there is one."""
        if self.websocket is None:
            return
        server, wait = self.websocket.server, self._choices.wait
        self._tell(f"waiting up to {wait:g} s for a viewer at {server.address}")
        if self._watched(wait):
            return
        if self.all == [self.websocket]:
            raise InputError("--rate", f"no viewer subscribed at {server.address} within {wait:g} s (--wait S)")
        self._tell(f"no viewer at {server.address} within {wait:g} s; the others go on")

    def await_return(self) -> float:
        """Where nobody watches, wait for somebody; how long that took, s."""
        if self.websocket is None or self.all != [self.websocket] or self.websocket.server.watched:
            return 0.0
        begun, wait = time.monotonic(), self._choices.wait
        self._tell(f"nobody watches: the play pauses up to {wait:g} s")
        if not self._watched(wait):
            self._tell(f"nobody came back within {wait:g} s: the play ends before the log does")
            raise _Over
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
        count, since = server.subscriptions, time.monotonic()
        while time.monotonic() - since < SETTLED:
            time.sleep(0.02)
            if server.subscriptions != count:
                count, since = server.subscriptions, time.monotonic()
        return True


class _Over(Exception):
    """Nothing is left to be shown, or nobody to show it to."""


@contextlib.contextmanager
def _viewers(log: Log, choices: Choices, tell: Tell) -> Iterator[_Viewers]:
    """Start the viewers; whatever happens, they are ended when the block is left."""
    viewers = _Viewers(choices, tell)
    patient = False

    def started(viewer: Viewer) -> None:
        ending.callback(lambda: viewer.close(patient))
        viewers.all.append(viewer)

    with contextlib.ExitStack() as ending:
        if choices.websocket:
            port = None if choices.serve else choices.port
            viewers.websocket = FoxgloveViewer(log, port, tell)
            started(viewers.websocket)
            tell(f"Foxglove, Lichtblick: open a connection, Foxglove WebSocket, {viewers.websocket.server.address}")
        following = choices.follow or choices.pace is not None
        for web in [True] * choices.serve + [False] * choices.spawn:
            viewer = RerunViewer(web, choices.port, following)
            started(viewer)
            if web:
                tell(f"Rerun: open {viewer.address} in a browser; Ctrl-C ends it")
        with contextlib.suppress(_Over):
            yield viewers
        patient = True


def _play(log: Log, rate: float, viewers: _Viewers) -> None:
    pace = Pace(log, rate)
    viewers.each(lambda viewer: viewer.clock(pace.start_ns))
    for now_ns, piece in pace.pieces():
        viewers.show(piece, now_ns)
        pace.paused(viewers.await_return())
