"""How do Foxglove and Lichtblick watch? Over a WebSocket of this machine, message by message, nothing dropped.

The protocol is Foxglove's (github.com/foxglove/ws-protocol, docs/spec.md): the server names itself and its channels in
JSON; who subscribes to a channel gets binary frames: 1, subscription (u32), log time (u64, ns), message; and the clock
as 2, time (u64, ns); little-endian. Its first version, foxglove.websocket.v1, and foxglove.sdk.v1 agree in all of this.
"""

from __future__ import annotations

import base64
import dataclasses
import json
import logging
import struct
import threading
import uuid
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from glidercli.live.client import Client
from glidercli.live.ports import HOST, taken
from glidercli.logio.mcap.file import Topic
from glidercli.logio.mcap.messages import schema_bytes

__all__ = ["FoxgloveServer", "Message"]

PORT = 8765
"""Where Foxglove looks if nothing else is said."""
PROTOCOLS = ("foxglove.sdk.v1", "foxglove.websocket.v1")
SLOW = 5.0
"""s without progress after which a viewer is called slow."""
GONE = 30.0
"""s without progress after which a viewer is let go."""
Message = tuple[str, int, bytes]
"""Topic, log time in ns, and the message itself."""


@dataclasses.dataclass
class _Channel:
    """A topic as it is announced, and what of it every viewer gets, whenever it comes."""

    id: int
    topic: str
    schema_name: str
    schema: bytes
    kept: list[tuple[int, bytes]]

    def document(self) -> dict[str, Any]:
        return {
            "id": self.id, "topic": self.topic, "encoding": "protobuf", "schemaName": self.schema_name,
            "schemaEncoding": "protobuf", "schema": base64.b64encode(self.schema).decode(),
        }  # fmt: skip


class FoxgloveServer:
    """A WebSocket server for any number of viewers.

    port : None for the usual one, or another if that is in use. about : texts that viewers are told of the log.
    tell : is told, a line each, who comes, leaves and is too slow.
    """

    def __init__(self, port: int | None, about: Mapping[str, str], tell: Callable[[str], None]) -> None:
        from websockets.sync.server import serve

        quiet = logging.getLogger("glidercli.live.foxglove")
        quiet.addHandler(logging.NullHandler())
        quiet.propagate = False  # a browser that calls by chance is no error of ours
        listener = taken(port, PORT)
        self.port: int = listener.getsockname()[1]
        self.address = f"ws://{HOST}:{self.port}"
        if port is None and self.port != PORT:
            tell(f"port {PORT} is in use; {self.port} is taken instead")
        self._about, self._tell = dict(about), tell
        self._session = uuid.uuid4().hex
        self._channels: dict[int, _Channel] = {}
        self._clients: list[Client] = []
        self._lock = threading.RLock()
        self._subscribed = self._announced = 0
        self._closing = False
        style: dict[str, Any] = {"subprotocols": PROTOCOLS, "compression": None, "server_header": None, "logger": quiet}
        self._server = serve(self._attend, sock=listener, max_size=1 << 20, open_timeout=2, close_timeout=1, **style)
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()

    @property
    def watched(self) -> bool:
        """Whether a viewer has subscribed to anything."""
        with self._lock:
            return any(client.subscriptions for client in self._clients)

    @property
    def subscriptions(self) -> int:
        """How many subscriptions there have been."""
        return self._subscribed

    def announce(self, topics: Sequence[Topic]) -> None:
        """Tell of topics; one of a name that is there with another kind of message takes its place."""
        with self._lock:
            by_topic = {channel.topic: channel for channel in self._channels.values()}
            new, gone = [], []
            for topic in topics:
                kind = topic.descriptor
                schema, old = schema_bytes(kind), by_topic.get(topic.name)
                if old is not None and old.schema == schema:
                    continue
                if old is not None:
                    gone.append(old.id)
                    del self._channels[old.id]
                self._announced = number = self._announced + 1
                by_topic[topic.name] = self._channels[number] = _Channel(number, topic.name, kind.full_name, schema, [])
                new.append(by_topic[topic.name])
            frames = [json.dumps({"op": "unadvertise", "channelIds": gone})] if gone else []
            frames += [_advertise(new)] if new else []
            for client in self._clients:
                for number in gone:
                    client.subscriptions.pop(number, None)
                client.put(frames)

    def send(self, messages: Sequence[Message], keep: bool = False) -> None:
        """Send messages to all who subscribed, after waiting for those that are slow.

        keep : whether viewers that subscribe later get them, too.
        """
        self._wait_for_room()
        with self._lock:
            by_topic = {channel.topic: channel for channel in self._channels.values()}
            if keep:
                for topic, time_ns, data in messages:
                    by_topic[topic].kept.append((time_ns, data))
            for client in self._clients:
                numbers = {t: client.subscriptions.get(channel.id) for t, channel in by_topic.items()}
                client.put(
                    _data(number, time_ns, data)
                    for topic, time_ns, data in messages
                    if (number := numbers[topic]) is not None
                )

    def forget(self, topics: Sequence[str]) -> None:
        """Let later viewers have nothing of what was kept of some topics."""
        with self._lock:
            for channel in self._channels.values():
                if channel.topic in topics:
                    channel.kept.clear()

    def clock(self, time_ns: int) -> None:
        """Tell every viewer the log's time."""
        with self._lock:
            for client in self._clients:
                client.put([struct.pack("<BQ", 2, time_ns)])

    def close(self, patient: bool = True) -> None:
        """Close all connections and free the port. patient : whether viewers get first what still waits for them."""
        self._closing = True
        for client in list(self._clients):
            while patient and not client.empty(0.2) and client.stalled() < GONE:
                pass
            if client.empty(0.0):
                client.end()
                client.socket.close(1001, "the play is over" if patient else "interrupted")
            else:
                client.cut()  # one that takes nothing would not take the word either
        self._server.shutdown()
        self._thread.join(timeout=2.0)

    def _wait_for_room(self) -> None:
        for client in list(self._clients):
            told = False
            while not client.room(0.2):
                stalled = client.stalled()
                if stalled > GONE:
                    self._tell(f"the viewer at {client.name} took nothing for {GONE:.0f} s and was let go")
                    self._remove(client)
                    client.cut()
                    break
                if stalled > SLOW and not told:
                    told = True
                    self._tell(f"the viewer at {client.name} is too slow; the play waits for it")

    def _attend(self, socket: Any) -> None:
        """Serve one viewer until it leaves; runs in a thread of its own."""
        from websockets.exceptions import ConnectionClosed

        client = Client(socket)
        if self._closing:
            return
        info = {
            "op": "serverInfo", "name": "glider", "capabilities": ["time"], "supportedEncodings": ["protobuf"],
            "metadata": self._about, "sessionId": self._session,
        }  # fmt: skip
        with self._lock:
            client.put([json.dumps(info), _advertise(list(self._channels.values()))])
            self._clients.append(client)
        self._tell(f"a viewer came from {client.name}")
        sender = threading.Thread(target=client.send_all, daemon=True)
        sender.start()
        try:
            for text in socket:
                self._hear(client, text)
        except (ConnectionClosed, OSError):
            pass
        finally:
            client.end()
            if self._remove(client) and not self._closing:
                self._tell(f"the viewer at {client.name} left")

    def _remove(self, client: Client) -> bool:
        with self._lock:
            if client not in self._clients:
                return False
            self._clients.remove(client)
            return True

    def _hear(self, client: Client, text: str | bytes) -> None:
        """Do what a viewer asks; what is no such question is answered by a status."""
        try:
            asked = json.loads(text)
            with self._lock:
                if asked["op"] == "subscribe":
                    for entry in asked["subscriptions"]:
                        self._subscribe(client, int(entry["channelId"]), int(entry["id"]))
                elif asked["op"] == "unsubscribe":
                    gone = {int(number) for number in asked["subscriptionIds"]}
                    kept = {c: n for c, n in client.subscriptions.items() if n not in gone}
                    client.subscriptions = kept
                else:
                    raise ValueError(f"{asked['op']} is not offered")
        except (ValueError, KeyError, TypeError) as error:
            client.put([json.dumps({"op": "status", "level": 1, "message": f"not understood: {error}"})])

    def _subscribe(self, client: Client, channel: int, number: int) -> None:
        if channel not in self._channels:
            raise ValueError(f"there is no channel {channel}")
        if not 0 <= number < 1 << 32:
            raise ValueError(f"{number} is no number of a subscription")
        client.subscriptions[channel] = number
        client.put(_data(number, time_ns, data) for time_ns, data in self._channels[channel].kept)
        self._subscribed += 1


def _advertise(channels: Sequence[_Channel]) -> str:
    return json.dumps({"op": "advertise", "channels": [channel.document() for channel in channels]})


def _data(subscription: int, time_ns: int, data: bytes) -> bytes:
    return struct.pack("<BIQ", 1, subscription, time_ns) + data
