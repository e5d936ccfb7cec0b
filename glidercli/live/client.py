"""What does one WebSocket viewer still have to be sent? Its subscriptions, and a queue that it empties at its pace."""

from __future__ import annotations

import contextlib
import socket
import threading
import time
from collections import deque
from collections.abc import Iterable
from typing import Any

__all__ = ["Client"]

MOST_WAITING = 4_000_000
"""bytes that may wait for a viewer before the play waits for it."""


class Client:
    """A viewer that is connected. name : where it came from, for people. subscriptions : its number of each channel."""

    def __init__(self, connection: Any) -> None:
        host, port = connection.remote_address[:2]
        self.name = f"{host}:{port}"
        self.socket = connection
        self.subscriptions: dict[int, int] = {}
        self.progress = time.monotonic()
        """When it last took something, or had nothing to take."""
        self._waiting: deque[str | bytes] = deque()
        self._size = 0
        self._changed = threading.Condition()
        self._ending = False

    def put(self, frames: Iterable[str | bytes]) -> None:
        """Let it have these, in their order."""
        with self._changed:
            for frame in frames:
                self._waiting.append(frame)
                self._size += len(frame)
            self._changed.notify_all()

    def end(self) -> None:
        """Let the sender end once it has sent what waits."""
        with self._changed:
            self._ending = True
            self._changed.notify_all()

    def cut(self) -> None:
        """Cut the connection; what waits is lost, and a send that hangs ends."""
        with contextlib.suppress(OSError):
            self.socket.socket.shutdown(socket.SHUT_RDWR)
        self._give_up()

    def room(self, seconds: float) -> bool:
        """Whether it can be given more; waits for that so long at most."""
        with self._changed:
            return self._changed.wait_for(lambda: self._ending or self._size < MOST_WAITING, seconds)

    def empty(self, seconds: float) -> bool:
        """Whether it has been sent all; waits for that so long at most."""
        with self._changed:
            return self._changed.wait_for(lambda: not self._size, seconds)

    def send_all(self) -> None:
        """Send what waits, as it comes, until ``end`` or the connection is closed; for a thread of its own."""
        from websockets.exceptions import ConnectionClosed

        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._ending or bool(self._waiting))
                if not self._waiting:
                    return
                frame = self._waiting[0]
            try:
                self.socket.send(frame)
            except (ConnectionClosed, OSError):
                self._give_up()
                return
            with self._changed:
                self._waiting.popleft()
                self._size -= len(frame)
                self.progress = time.monotonic()
                self._changed.notify_all()

    def stalled(self) -> float:
        """For how long it has taken nothing though something waits, s."""
        with self._changed:
            return time.monotonic() - self.progress if self._waiting else 0.0

    def _give_up(self) -> None:
        with self._changed:
            self._waiting.clear()
            self._size, self._ending = 0, True
            self._changed.notify_all()
