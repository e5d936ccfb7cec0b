"""Does a Rerun viewer get the log while it is served? Read back by Rerun's own client, and what becomes of viewers."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import signal
import socket
import subprocess
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, Run, one_line_error
from live_clients import Running, Watcher, running, wait_for

from glidercli.channels import CHANNELS
from glidercli.live.rerun_viewer import binary, quiet_environment
from glidercli.log import Log
from glidercli.logio import read
from glidercli.logio.rerun import colours as look

XVFB = shutil.which("Xvfb")
VULKAN = [
    file for place in ("/usr/share", "/usr/local/share", "/etc") for file in Path(place, "vulkan/icd.d").glob("*.json")
]
"""Drivers, where Vulkan's loader looks for them."""
SEA035 = ROOT / "logs" / "seaexplorer-sea035"
DIVE = SEA035 / "sea035.12.gli.sub.37"


def ports(run: Running) -> tuple[int, int]:
    """Where the page and the data are served."""
    found = run.wait_for_line(r"http://127\.0\.0\.1:(\d+)/\?\S*url=rerun%2Bhttp%3A%2F%2F127\.0\.0\.1%3A(\d+)%2Fproxy")
    return int(found[1]), int(found[2])


def saved(feed: int, path: Path) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """What Rerun's own client saves of what is served, as times and values of each plotted channel."""
    from rerun.chunk import RrdReader

    path.unlink(missing_ok=True)
    command = [
        binary(),
        "--port",
        "auto",
        "--bind",
        "127.0.0.1",
        "--save",
        path,
        f"rerun+http://127.0.0.1:{feed}/proxy",
    ]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as client:
        size = -1
        try:
            for _ in range(100):
                now = path.stat().st_size if path.exists() else 0
                if 0 < now == size:
                    break
                size = now
                with pytest.raises(subprocess.TimeoutExpired):
                    client.wait(0.5)
        finally:
            client.send_signal(signal.SIGINT)
    whole = path.with_name("whole.rrd")  # with the end that an interrupted file lacks
    subprocess.run([binary(), "rrd", "merge", path, "-o", whole], check=True, capture_output=True)
    chunks: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {}
    reader = RrdReader(whole)
    for store in reader.recordings():
        for chunk in reader.stream(store=store):
            if chunk.is_static or chunk.entity_path.startswith("/section/"):
                continue
            if "Scalars:scalars" in (batch := chunk.to_record_batch()).schema.names:
                times = batch.column("utc").to_numpy(zero_copy_only=False).astype("datetime64[ns]").astype(np.int64)
                values = batch.column("Scalars:scalars").values.to_numpy(zero_copy_only=False)
                sampled = ~np.isnan(values)  # NaN breaks a line at a gap
                chunks.setdefault(chunk.entity_path.split("/")[-1], []).append((times[sampled], values[sampled]))
    found = {}
    for name, parts in chunks.items():
        times, values = (np.concatenate(column) for column in zip(*parts, strict=True))
        order = np.argsort(times, kind="stable")
        found[name] = times[order], values[order]
    return found


def holds(found: dict[str, tuple[np.ndarray, np.ndarray]], log: Log) -> bool:
    """Whether every channel stands there, in table units, depth negative down."""
    for name in log.channels.keys() - {"phase"}:
        if name not in found or not np.array_equal(found[name][0], log[name].time_ns):
            return False
        factor = -1.0 if name == "depth" else CHANNELS[name].factor
        assert np.array_equal(found[name][1], log[name].values * factor), name
    return True


@pytest.mark.parametrize("options", [(), ("--rate", "20000")])
def test_its_own_client_reads_the_log_back(options: tuple[str, ...], tmp_path: Path) -> None:
    log = read([SEA035]).log
    with running("replay", SEA035, "--serve", *options, cwd=tmp_path) as run:
        _, feed = ports(run)
        run.wait_for_line("all is sent")
        wait_for(lambda: holds(saved(feed, tmp_path / "back.rrd"), log), "the whole log")
        assert run.end(signal.SIGINT) == 0, run.said


def test_a_file_that_grows_is_served(tmp_path: Path) -> None:
    lines = DIVE.read_bytes().splitlines(keepends=True)
    path = tmp_path / DIVE.name
    path.write_bytes(b"".join(lines[:100]) + lines[100][:9])
    with running("replay", path, "--follow", "--serve", cwd=tmp_path) as run:
        _, feed = ports(run)
        run.wait_for_line("following")
        with path.open("ab") as stream:
            stream.write(lines[100][9:] + b"".join(lines[101:]))
        log = read([DIVE]).log
        late = {"phase", "north", "east"}  # shown anew when the log has doubled, or after a minute
        whole = Log({n: c for n, c in log.channels.items() if n not in late}, log.origin)
        wait_for(lambda: holds(saved(feed, tmp_path / "back.rrd"), whole), "the whole log")
        assert run.end(signal.SIGINT) == 0, run.said


def children(process: int) -> list[int]:
    return [int(word) for word in Path(f"/proc/{process}/task/{process}/children").read_text().split()]


def listeners(sockets: list[int]) -> set[str]:
    """The inodes of what listens at some ports of 127.0.0.1."""
    rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    return {row[9] for row in rows if row[3] == "0A" and int(row[1].split(":")[1], 16) in sockets}


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="looks for processes in /proc")
@pytest.mark.parametrize("request_", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize(
    "options", [("--serve",), ("--serve", "--foxglove", "--rate", "1"), ("--follow", "--serve", "--foxglove")]
)
def test_asked_to_end_it_leaves_nothing_behind(request_: int, options: tuple[str, ...], tmp_path: Path) -> None:
    with running("replay", DIVE, *options, cwd=tmp_path) as run:
        page, feed = ports(run)
        sockets = [page, feed]
        if "--foxglove" in options:
            sockets.append(int(run.url().rsplit(":", 1)[1]))
        (viewer,) = children(run.process.pid)
        held = listeners(sockets)
        assert len(held) == len(sockets)
        assert run.end(request_) == 0, run.said
        assert not Path(f"/proc/{viewer}").exists()
        assert not held & listeners(sockets)  # another program may have taken a port since
        assert not any("Traceback" in line for line in run.said)


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="looks for processes in /proc")
def test_killed_it_takes_the_viewer_with_it(tmp_path: Path) -> None:
    with running("replay", DIVE, "--serve", cwd=tmp_path) as run:
        run.wait_for_line("all is sent")
        (viewer,) = children(run.process.pid)
        run.end(signal.SIGKILL)
        wait_for(lambda: not Path(f"/proc/{viewer}").exists() or "Z" in status(viewer), "its end")


def status(process: int) -> str:
    with contextlib.suppress(FileNotFoundError):
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0]
    return "Z"


def test_a_viewer_that_is_closed_ends_it(tmp_path: Path) -> None:
    with running("replay", DIVE, "--serve", cwd=tmp_path) as run:
        run.wait_for_line("all is sent")
        os.kill(children(run.process.pid)[0], signal.SIGKILL)
        assert run.wait() == 0
        assert run.said[-1] == "the Rerun web viewer was closed; no viewer is left"


def test_a_viewer_that_hangs_does_not_hang_us(tmp_path: Path) -> None:
    with running("replay", DIVE, "--serve", "--rate", "500", cwd=tmp_path) as run:
        ports(run)
        (viewer,) = children(run.process.pid)
        os.kill(viewer, signal.SIGSTOP)
        assert run.end(signal.SIGINT) == 0, run.said
        assert not Path(f"/proc/{viewer}").exists()


def test_a_viewer_that_dies_while_others_watch(tmp_path: Path) -> None:
    with running("replay", DIVE, "--serve", "--foxglove", "--rate", "2000", cwd=tmp_path) as run:
        watcher = Watcher(run.url())
        wait_for(lambda: watcher.count > 50, "samples")
        os.kill(children(run.process.pid)[0], signal.SIGKILL)
        run.wait_for_line("the Rerun web viewer was closed; the others go on")
        watcher.until_closed()
        assert run.wait() == 0
    assert len(watcher.messages["/glider/attitude"]) == len(read([DIVE]).log["heading"])


def test_the_page_is_there_and_only_for_this_machine(tmp_path: Path) -> None:
    with running("replay", DIVE, "--serve", cwd=tmp_path) as run:
        page, feed = ports(run)
        with urllib.request.urlopen(f"http://127.0.0.1:{page}/") as answer:
            assert b"re_viewer" in answer.read()
        for port in (page, feed):  # an address of this machine that is not the one it is bound to
            with socket.socket() as other, pytest.raises(OSError, match="refused"):
                other.connect(("127.0.0.2", port))


def test_two_at_once_take_other_ports(tmp_path: Path) -> None:
    with (
        running("replay", DIVE, "--serve", cwd=tmp_path) as one,
        running("replay", DIVE, "--serve", cwd=tmp_path) as two,
    ):
        one.wait_for_line("all is sent")
        two.wait_for_line("all is sent")
        assert not {*ports(one)} & {*ports(two)}


def test_a_chosen_port_is_taken_or_refused(glider: Run, tmp_path: Path) -> None:
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        held.listen()
        port = held.getsockname()[1]
        one_line_error(glider("replay", DIVE, "--serve", "--port", port), "--port", str(port), "is in use")
    with running("replay", DIVE, "--serve", "--port", port, cwd=tmp_path) as run:
        assert ports(run)[0] == port


def test_without_a_display_a_window_is_one_line(glider: Run) -> None:
    bare = {name: value for name, value in os.environ.items() if not re.match("DISPLAY|WAYLAND", name)}
    one_line_error(glider("replay", DIVE, "--spawn", env=bare), "--spawn", "no display", "--serve")


def test_a_window_that_does_not_open_is_one_line(glider: Run) -> None:
    """A display that is not there: the viewer ends by itself."""
    bare = {name: value for name, value in os.environ.items() if not re.match("DISPLAY|WAYLAND", name)}
    done = glider("replay", DIVE, "--spawn", env={**bare, "DISPLAY": ":1897"})
    assert done.returncode in (0, 1)  # 0 where it listened for a moment
    assert "Traceback" not in done.stderr
    assert "the Rerun viewer" in done.stderr.splitlines()[-1]


def test_the_viewer_that_a_window_would_show_gets_the_log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The very viewer, drawing without a window, since there is no display here; it needs a driver for Vulkan."""
    from glidercli.errors import InputError
    from glidercli.live import rerun_viewer

    program = tmp_path / "rerun"
    program.write_text(f'#!/bin/sh\nexec "{binary()}" "$@" --headless --window-size 800x600\n')
    program.chmod(0o755)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setattr(rerun_viewer, "binary", lambda: program)
    log = read([DIVE]).log
    try:
        viewer = rerun_viewer.RerunViewer(web=False, port=None, following=False, paced=False)
    except InputError as error:
        pytest.skip(f"it does not start here: {error}")
    try:
        viewer.begin(log, None)
        viewer.whole(log, log, panels=True)
        viewer.add(log)
        feed = int(re.findall(r":(\d+)/", viewer._url)[0])
        wait_for(lambda: holds(saved(feed, tmp_path / "back.rrd"), log), "the whole log")
    except (ConnectionError, pytest.fail.Exception) as error:
        if viewer._process.poll() is None:
            raise
        pytest.skip(f"it does not stay here: {error}")
    finally:
        viewer.close(patient=False)
    assert viewer._process.returncode is not None


@contextlib.contextmanager
def screen(folder: Path) -> Iterator[tuple[dict[str, str], Path]]:
    """A display without a monitor, as an environment and the file of its pixels.

    Without the extension Composite: with it a window has an alpha channel, and Mesa's software Vulkan draws nothing.
    """
    assert XVFB is not None
    read_end, write_end = os.pipe()
    command = [XVFB, "-displayfd", str(write_end), "-screen", "0", "1000x600x24", "-extension", "Composite"]
    command += ["-fbdir", str(folder), "-nolisten", "tcp"]
    with subprocess.Popen(command, pass_fds=[write_end], stderr=subprocess.DEVNULL) as server:
        try:
            os.close(write_end)
            with os.fdopen(read_end) as told:
                number = told.readline().strip()
            bare = {name: value for name, value in os.environ.items() if not re.match("DISPLAY|WAYLAND", name)}
            own = {"DISPLAY": f":{number}", "XDG_RUNTIME_DIR": str(folder)}
            yield {**bare, **own}, folder / "Xvfb_screen0"
        finally:
            server.terminate()


def pixels(path: Path) -> np.ndarray:
    """Red, green and blue, (600, 1000, 3), of a screen: an XWD file (X11/XWDFile.h), its numbers big-endian."""
    data = path.read_bytes()
    header = np.frombuffer(data, ">u4", 25)
    start = int(header[0] + 12 * header[19])  # of a header and ncolors colours of 12 bytes
    width, height, line = (int(header[i]) for i in (4, 5, 12))
    rows = np.frombuffer(data, np.uint8, height * line, start).reshape(height, line)[:, : 4 * width]
    return rows.reshape(height, width, 4)[..., 2::-1]


def painted(path: Path, colour: tuple[int, int, int]) -> int:
    return int((pixels(path) == np.array(colour, np.uint8)).all(axis=-1).sum())


@pytest.mark.skipif(XVFB is None, reason="no display without a monitor (Debian: xvfb)")
@pytest.mark.skipif(not VULKAN, reason="no driver for Vulkan (Debian: mesa-vulkan-drivers)")
def test_a_window_shows_the_log_and_its_end_ends_the_play(tmp_path: Path) -> None:
    """Seen on the screen: lines in the colours of dive and climb. Then the window is closed while a log plays."""
    with screen(tmp_path) as (env, shown):
        with running("replay", DIVE, "--spawn", cwd=tmp_path, env=env) as run:
            run.wait_for_line("all is sent")
            # a line of one pixel across a tenth of the depth panel, at least, in each colour
            wait_for(lambda: min(painted(shown, look.BLUE), painted(shown, look.ORANGE)) > 40, "lines on the screen")
            assert run.end(signal.SIGINT) == 0, run.said
        assert painted(shown, look.BLUE) == 0  # nothing is left on the screen
        with running("replay", DIVE, "--spawn", "--rate", "10", cwd=tmp_path, env=env) as run:
            wait_for(lambda: painted(shown, look.BACKGROUND) > 10_000, "the ground of its scenes")
            (viewer,) = children(run.process.pid)
            os.kill(viewer, signal.SIGTERM)
            assert run.wait() == 0
            assert run.said == ["the Rerun viewer was closed; no viewer is left"]


def test_rerun_sends_no_telemetry_for_us(tmp_path: Path) -> None:
    """By its own words, where the user's settings allow it, as those of somebody who never ran it do."""
    home = {"HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path), "XDG_DATA_HOME": str(tmp_path)}
    command = [binary(), "--serve-web", "--bind", "127.0.0.1", "--port", "0", "--web-viewer-port", "0"]
    words = quiet_environment() | home | {"RUST_LOG": "re_analytics=trace"}
    with subprocess.Popen(command, env=words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        assert process.stdout is not None
        said = next(line for line in process.stdout if "re_analytics" in line)
        process.kill()
    assert "Analytics disabled" in said
