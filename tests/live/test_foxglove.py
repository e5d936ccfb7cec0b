"""Does a viewer get over the WebSocket what an .mcap of the log holds? Message by message, and when it comes late."""

from __future__ import annotations

import json
import socket
from pathlib import Path

import pytest
from conftest import ROOT, Run, one_line_error
from live_clients import Watcher, in_file, running, wait_for

from glidercli.live.foxglove import Message
from glidercli.live.foxglove_viewer import FoxgloveViewer
from glidercli.live.pacing import between
from glidercli.logio import read, write

SEA035 = ROOT / "logs" / "seaexplorer-sea035"
DIVE = SEA035 / "sea035.12.gli.sub.37"
STILL = {
    "/tf_static", "/viz/vehicle", "/viz/track", "/viz/surface", "/viz/fixes", "/viz/current_average", "/map/track", "/log",
}  # fmt: skip
FEW = {"/glider/fix", "/viz/phase"}
"""Topics of so few messages that a viewer may come before the first."""


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[tuple[int, bytes]]]:
    """The messages of the file that the same log makes."""
    path = tmp_path_factory.mktemp("mcap") / "a.mcap"
    write(read([SEA035]).log, path)
    return in_file(path)


@pytest.mark.parametrize(("rate", "protocol"), [("1e9", "foxglove.sdk.v1"), ("20000", "foxglove.websocket.v1")])
def test_every_message_comes_as_in_the_file(
    rate: str, protocol: str, kept: dict[str, list[tuple[int, bytes]]], tmp_path: Path
) -> None:
    with running("replay", SEA035, "--rate", rate, cwd=tmp_path) as run:
        run.wait_for_line("waiting up to 60 s")
        watcher = Watcher(run.url(), protocol)
        watcher.until_closed()
        assert run.wait() == 0, run.said
    assert watcher.messages == kept
    assert watcher.info["capabilities"] == ["time"]
    assert watcher.info["metadata"]["log"] == "MEASURED"
    times = [at for messages in kept.values() for at, _ in messages]
    assert watcher.clocks[0] == min(times)
    assert watcher.clocks[-1] == max(times)
    assert watcher.clocks == sorted(watcher.clocks)
    assert "played to the end" in run.said


@pytest.mark.parametrize("minutes", [1, 20, 600])
def test_topics_come_in_the_order_of_time_within_a_step(minutes: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Steps of a play that hold a record each, some dozens of them, and the whole log of 5.8 h."""
    log = read([SEA035]).log
    viewer = FoxgloveViewer(log, None, lambda line: None)
    sent: list[tuple[str, int]] = []
    kept: set[str] = set()

    def send(messages: list[Message], keep: bool = False) -> None:
        sent.extend((topic, time_ns) for topic, time_ns, _ in messages)
        kept.update(topic for topic, _, _ in messages if keep)

    monkeypatch.setattr(viewer.server, "send", send)
    try:
        viewer.begin(log, None)
        viewer.whole(log, log, panels=True)
        viewer.clock(log.start_ns)
        step = minutes * 60 * 10**9
        for start_ns in range(log.start_ns, log.end_ns + 1, step):
            end_ns = min(start_ns + step, log.end_ns + 1)
            viewer.add(between(log, start_ns, end_ns))
            viewer.clock(end_ns - 1)
    finally:
        viewer.close(patient=False)
    times = [time_ns for _, time_ns in sent]
    assert times == sorted(times)
    assert len({topic for topic, _ in sent}) > 10
    assert kept >= {"/tf_static", "/viz/track", "/viz/phase", "/log", "/map/track"}


def test_its_schemas_decode_its_messages(tmp_path: Path) -> None:
    from glidercli.logio.mcap.messages import message_class

    with running("replay", DIVE, "--rate", "1e9", cwd=tmp_path) as run:
        watcher = Watcher(run.url())
        watcher.until_closed()
        assert run.wait() == 0, run.said
    one_dive = STILL - {"/viz/current_average"}  # which takes fixes before and after
    assert {"/glider/navigation", "/glider/attitude", "/tf", *one_dive} <= watcher.messages.keys()
    for topic, messages in watcher.messages.items():
        name, schema = watcher.schemas[topic]
        kind = message_class(schema, name)
        assert len(kind.FromString(messages[-1][1]).ListFields()) > 0


def test_who_comes_late_gets_what_stands_still_and_then_the_rest(
    kept: dict[str, list[tuple[int, bytes]]], tmp_path: Path
) -> None:
    """A log of 5.8 h in some 4 s; the second viewer comes after some of it."""
    with running("replay", SEA035, "--rate", "6000", cwd=tmp_path) as run:
        early = Watcher(run.url())
        wait_for(lambda: early.count > 300, "samples")
        late = Watcher(run.url())
        early.until_closed()
        late.until_closed()
    assert early.messages == kept
    for topic, messages in kept.items():
        got = late.messages[topic]
        assert got == messages if topic in STILL else got == messages[-len(got) :]
        assert topic in STILL or 0 < len(got) < len(messages) or topic in FEW


def test_who_leaves_is_a_line_and_the_others_get_all(kept: dict[str, list[tuple[int, bytes]]], tmp_path: Path) -> None:
    with running("replay", SEA035, "--rate", "6000", cwd=tmp_path) as run:
        stays, leaves = Watcher(run.url()), Watcher(run.url())
        wait_for(lambda: leaves.count > 100, "samples")
        leaves.leave()
        run.wait_for_line("left$")
        stays.until_closed()
        assert run.wait() == 0
    assert stays.messages == kept


def test_the_last_one_may_come_back(kept: dict[str, list[tuple[int, bytes]]], tmp_path: Path) -> None:
    """The play pauses while nobody watches: the two have all between them."""
    with running("replay", SEA035, "--rate", "6000", cwd=tmp_path) as run:
        first = Watcher(run.url())
        wait_for(lambda: first.count > 500, "samples")
        first.leave()
        run.wait_for_line("nobody watches: the play pauses")
        second = Watcher(run.url())
        second.until_closed()
        assert run.wait() == 0
        assert any("the play goes on" in line for line in run.said)
    assert second.messages["/tf"] == kept["/tf"][-len(second.messages["/tf"]) :]
    # what was on its way when the first left is lost with it: a step of the clock, 1200 s of the log, 60 records;
    # on a busy machine a step is longer
    assert len(first.messages["/tf"]) + len(second.messages["/tf"]) > len(kept["/tf"]) - 150


def test_nobody_comes_back_ends_it(tmp_path: Path) -> None:
    with running("replay", SEA035, "--rate", "100", "--wait", "2", cwd=tmp_path) as run:
        watcher = Watcher(run.url())
        wait_for(lambda: watcher.count > 10, "samples")
        watcher.leave()
        assert run.wait() == 0
    assert run.said[-1] == "nobody came back within 2 s: the play ends before the log does"


def test_nobody_comes_at_all(glider: Run) -> None:
    done = glider("replay", DIVE, "--rate", "1", "--wait", "0.5")
    assert done.returncode == 1
    last = done.stderr.splitlines()[-1]
    assert last.startswith("glider: error: --rate: no viewer subscribed at ws://127.0.0.1:")


def test_one_that_does_not_read_is_waited_for_and_told(
    kept: dict[str, list[tuple[int, bytes]]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In this process, so that the limits can be made small; nothing is dropped for a viewer that is slow only."""
    import threading
    import time

    from glidercli.live import client, foxglove

    monkeypatch.setattr(client, "MOST_WAITING", 20_000)
    monkeypatch.setattr(foxglove, "SLOW", 0.2)
    said: list[str] = []
    log = read([SEA035]).log
    viewer = FoxgloveViewer(log, None, said.append)
    viewer.whole(log, log, panels=True)
    slow = Watcher(viewer.server.address)
    wait_for(lambda: viewer.server.subscriptions == len(kept), "subscriptions")
    held = threading.Event()
    sender = next(iter(viewer.server._clients))
    send = sender.socket.send
    monkeypatch.setattr(sender.socket, "send", lambda frame: (held.wait(), send(frame)))
    play = threading.Thread(target=lambda: [viewer.clock(log.start_ns), viewer.add(log), viewer.clock(log.end_ns)])
    play.start()
    wait_for(lambda: any("too slow; the play waits for it" in line for line in said), "the line")
    time.sleep(0.1)
    assert play.is_alive()
    held.set()
    play.join()
    viewer.close(patient=True)
    slow.until_closed()
    assert slow.messages == kept


def test_one_that_takes_nothing_does_not_hold_the_end_up() -> None:
    """A connection whose other side never reads, more waiting than the system buffers take."""
    import struct
    import threading
    import time

    from glidercli.live.foxglove import FoxgloveServer
    from glidercli.logio.mcap.contents import Contents

    server = FoxgloveServer(None, {}, lambda line: None)
    topics = next(iter(Contents(read([DIVE]).log).samples(read([DIVE]).log)))
    server.announce(topics)
    with socket.socket() as stuck:
        stuck.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        stuck.connect(("127.0.0.1", server.port))
        stuck.sendall(
            b"GET / HTTP/1.1\r\nHost: a\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\nSec-WebSocket-Version: 13\r\n"
            b"Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n"
        )
        text = json.dumps({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 1}]}).encode()
        stuck.sendall(struct.pack(">BBH", 0x81, 0x80 | 126, len(text)) + bytes(4) + text)
        wait_for(lambda: server.watched, "the subscription")
        send = threading.Thread(target=lambda: server.send([(topics[0].name, 0, bytes(1 << 20))] * 40), daemon=True)
        send.start()
        send.join()
        (client,) = server._clients
        wait_for(lambda: client.stalled() > 0.5, "the buffers to be full")
        begun = time.monotonic()
        server.close(patient=False)
        # its limits are 1 s to close, 2 s to open and 2 s for its thread; GONE would be 30 s
        assert time.monotonic() - begun < 20.0


def test_nonsense_is_answered_and_harms_nobody(tmp_path: Path) -> None:
    from websockets.sync.client import connect

    with running("replay", DIVE, "--rate", "1e9", cwd=tmp_path) as run:
        url = run.url()
        with socket.create_connection(("127.0.0.1", int(url.rsplit(":", 1)[1]))) as raw:
            raw.sendall(b"GET / HTTP/1.1\r\nHost: a\r\n\r\n")
            assert b"426" in raw.recv(1000).split(b"\r\n")[0]
        with connect(url, subprotocols=["foxglove.sdk.v1"]) as odd:  # type: ignore[list-item]
            odd.recv()
            for text in (
                "{",
                "[]",
                '{"op": "fly"}',
                b"\x01binary",
                '{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 999}]}',
            ):
                odd.send(text)
                while (op := json.loads(odd.recv(20))["op"]) == "advertise":
                    pass
                assert op == "status", text
        watcher = Watcher(url)
        watcher.until_closed()
        assert run.wait() == 0
        assert watcher.count > 100
        assert not any("Traceback" in line for line in run.said)


def test_a_port_in_use_is_one_line(glider: Run) -> None:
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        held.listen()
        port = held.getsockname()[1]
        one_line_error(glider("replay", DIVE, "--rate", "1", "--port", port), "--port", str(port), "is in use")


@pytest.mark.parametrize("rate", ["0", "-1", "nan", "inf"])
def test_a_pace_that_is_none(rate: str, glider: Run) -> None:
    one_line_error(glider("replay", DIVE, f"--rate={rate}"), "--rate", "above 0", code=2)


@pytest.mark.parametrize(
    "options",
    [
        ("--rate", 1, "--follow"),
        ("--port", 9000),
        ("--rate", 1, "--port", 80),
        ("--rate", 1, "--wait", 0),
        ("--follow", "--start", 3),
    ],
)
def test_options_that_do_not_go_together(options: tuple[object, ...], glider: Run) -> None:
    one_line_error(glider("replay", DIVE, *options), code=2)
