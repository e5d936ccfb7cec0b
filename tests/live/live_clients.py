"""Real clients for tests: a WebSocket viewer that subscribes to all, and the program as it runs."""

from __future__ import annotations

import contextlib
import json
import re
import signal
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

GLIDER = Path(sys.executable).with_name("glider")
PATIENCE = 60.0
"""s; much more than anything takes, so that a busy machine is no failure."""


def wait_for(true: Callable[[], bool], what: str) -> None:
    until = time.monotonic() + PATIENCE
    while not true():
        assert time.monotonic() < until, f"waited in vain for {what}"
        time.sleep(0.02)


class Running:
    """A command that runs; what it says on stderr is read as it comes."""

    def __init__(self, arguments: Sequence[object], cwd: Path, env: dict[str, str] | None = None) -> None:
        command = [str(GLIDER), *map(str, arguments)]
        self.process = subprocess.Popen(
            command, cwd=cwd, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.said: list[str] = []
        self.printed: list[str] = []
        self._readers = [
            threading.Thread(target=self._read, args=pair, daemon=True)
            for pair in ((self.process.stderr, self.said), (self.process.stdout, self.printed))
        ]
        for reader in self._readers:
            reader.start()

    def _read(self, stream: Any, lines: list[str]) -> None:
        for line in stream:
            lines.append(line.rstrip("\n"))

    def wait_for_line(self, pattern: str) -> re.Match[str]:
        """The first line on stderr that matches."""
        until = time.monotonic() + PATIENCE
        while True:
            for line in list(self.said):
                if found := re.search(pattern, line):
                    return found
            ended = self.process.poll() is not None
            assert not ended or any(re.search(pattern, line) for line in self.said), (pattern, self.said)
            assert time.monotonic() < until, (pattern, self.said)
            time.sleep(0.02)

    def url(self) -> str:
        return self.wait_for_line(r"ws://127\.0\.0\.1:\d+")[0]

    def end(self, request: int = signal.SIGINT) -> int:
        """Ask it to end; its exit code."""
        self.process.send_signal(request)
        return self.wait()

    def wait(self) -> int:
        code = self.process.wait(PATIENCE)
        for reader in self._readers:
            reader.join(PATIENCE)
        for stream in (self.process.stdout, self.process.stderr):
            if stream is not None:
                stream.close()
        return code


@contextlib.contextmanager
def running(*arguments: object, cwd: Path, env: dict[str, str] | None = None) -> Iterator[Running]:
    run = Running(arguments, cwd, env)
    try:
        yield run
    finally:
        if run.process.poll() is None:
            run.process.kill()
        run.wait()


class Watcher:
    """A viewer that subscribes to every channel, and keeps all that it gets, in a thread of its own.

    messages : by topic, (log time, message). clocks : times of the server's clock.
    """

    def __init__(self, url: str, protocol: str = "foxglove.sdk.v1") -> None:
        self.messages: dict[str, list[tuple[int, bytes]]] = {}
        self.schemas: dict[str, tuple[str, bytes]] = {}
        self.clocks: list[int] = []
        self.info: dict[str, Any] = {}
        self.statuses: list[str] = []
        self._topics: dict[int, str] = {}
        self._open = contextlib.ExitStack()
        options: dict[str, Any] = {"subprotocols": [protocol], "max_size": None, "compression": None}
        self.socket = self._open.enter_context(connect(url, **options))
        assert self.socket.subprotocol == protocol
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def _watch(self) -> None:
        with contextlib.suppress(ConnectionClosed, OSError):
            for data in self.socket:
                if isinstance(data, str):
                    self._hear(json.loads(data))
                elif data[0] == 1:
                    number, at = struct.unpack_from("<IQ", data, 1)
                    self.messages.setdefault(self._topics[number], []).append((at, data[13:]))
                else:
                    assert data[0] == 2, data[0]
                    self.clocks.append(struct.unpack_from("<Q", data, 1)[0])

    def _hear(self, told: dict[str, Any]) -> None:
        import base64

        if told["op"] == "serverInfo":
            self.info = told
        elif told["op"] == "status":
            self.statuses.append(told["message"])
        elif told["op"] == "advertise":
            for channel in told["channels"]:
                assert channel["encoding"] == channel["schemaEncoding"] == "protobuf"
                self.schemas[channel["topic"]] = channel["schemaName"], base64.b64decode(channel["schema"])
                self._topics[channel["id"] + 1000] = channel["topic"]
            ids = [channel["id"] for channel in told["channels"]]
            self.socket.send(
                json.dumps({"op": "subscribe", "subscriptions": [{"id": i + 1000, "channelId": i} for i in ids]})
            )

    @property
    def count(self) -> int:
        return sum(map(len, self.messages.values()))

    def leave(self) -> None:
        self._open.close()
        self._thread.join(PATIENCE)

    def until_closed(self) -> None:
        """Until the server closes the connection."""
        self._thread.join(PATIENCE)
        assert not self._thread.is_alive()
        self._open.close()


def in_file(path: Path) -> dict[str, list[tuple[int, bytes]]]:
    """The messages of an .mcap by topic, read by the mcap library."""
    from mcap.reader import make_reader

    topics: dict[str, list[tuple[int, bytes]]] = {}
    with path.open("rb") as stream:
        for _, channel, message in make_reader(stream).iter_messages():
            topics.setdefault(channel.topic, []).append((message.log_time, message.data))
    return topics
