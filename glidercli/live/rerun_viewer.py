"""How does a Rerun viewer show a log? A process of its own, a window or a web page, that is fed over a local port."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from glidercli.errors import InputError
from glidercli.live.ports import HOST, alone, listening, taken
from glidercli.log import Log

if TYPE_CHECKING:
    from glidercli.logio.rerun.contents import Contents
    from glidercli.logio.rerun.stream import RerunStream

__all__ = ["RerunViewer", "binary", "quiet_environment"]

WEB_PORT = 9090
PORT = 9876
"""Where Rerun's own viewers listen if nothing else is said."""
LONGEST_START = 30.0
"""s that a viewer may take until it listens."""
QUIET = "notebook=1&hide_welcome_screen=1"
"""So that the page sends no telemetry and asks for no examples and releases; fonts it asks for all the same."""
PR_SET_PDEATHSIG = 1
"""From <linux/prctl.h>: the signal that a process gets when its parent ends."""
LONGEST_END = 3.0
"""s that it may take to end by itself."""


class RerunViewer:
    """The Rerun viewer; it is started at once, and ended by ``close``.

    web : as a page at ``address``, else as a window. port : of that page, None for the usual one or another.
    following : whether its clock goes with what comes. paced : whether the whole is known before it is played; sections
    of the water, which stand in time, are then left out, for they would take the clock to their end.
    Raises InputError where it does not start.
    """

    starts_over = True

    def __init__(self, web: bool, port: int | None, following: bool, paced: bool) -> None:
        self.name = "the Rerun web viewer" if web else "the Rerun viewer"
        self.address = ""
        self._following, self._paced = following, paced
        self._contents: Contents | None = None
        self._stream: RerunStream | None = None
        with alone():
            with taken(None, PORT) as held:
                feed = held.getsockname()[1]
                mine = [feed]
                command = [str(binary()), "--bind", HOST, "--port", str(feed)]
                if web:
                    with taken(port, WEB_PORT) as page:
                        number = page.getsockname()[1]
                        mine.append(number)
                        source = quote(f"rerun+http://{HOST}:{feed}/proxy", safe="")
                        self.address = f"http://{HOST}:{number}/?{QUIET}&url={source}"
                        command += ["--serve-web", "--web-viewer-port", str(number)]
                        command += ["--server-memory-limit", "75%"]
                else:
                    command += ["--hide-welcome-screen", "--expect-data-soon"]
            self._said = tempfile.TemporaryFile()  # noqa: SIM115, it lives as long as the process
            self._process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=self._said,
                env=quiet_environment(),
                start_new_session=True,  # Ctrl-C is for us; we end it
                preexec_fn=_bound_to_us(),
            )  # fmt: skip
            try:
                for number in mine:
                    self._wait_for(number)
            except BaseException:
                self.close(patient=False)
                raise
        self._url = f"rerun+http://{HOST}:{feed}/proxy"

    def begin(self, log: Log, past: Log | None) -> None:
        """Get ready for the channels of a log; a track that moved begins a new recording."""
        from glidercli.logio.rerun.contents import Contents
        from glidercli.logio.rerun.stream import RerunStream

        self.check()
        self._contents = Contents(log.sliced(None, None))
        if self._stream is None or past is None:
            if self._stream is not None:
                self._stream.close()
            self._stream = RerunStream(self._url, self.name, lambda: self._process.poll() is None)
        else:
            for _ in self._contents.samples(past):
                pass
        self._stream.begin(self._contents)

    def add(self, piece: Log) -> None:
        """Show a piece."""
        stream, contents = self._ready()
        stream.samples(contents, piece)

    def whole(self, log: Log, whole: Log, panels: bool) -> None:
        """Show track, notes and metadata."""
        from glidercli.logio.rerun.contents import Contents

        stream, _ = self._ready()
        drawn = Contents(whole.sliced(None, None))
        for _ in drawn.samples(whole):
            pass
        stream.whole(drawn, log, self._following, panels, sections=not self._paced)

    def clock(self, time_ns: int) -> None:
        """Nothing: the viewer's clock follows what comes."""

    def check(self) -> None:
        """See whether it is still there."""
        if self._process.poll() is not None:
            raise ConnectionError(f"{self.name} was closed")

    def close(self, patient: bool) -> None:
        """End the process; only then the connection, for one that hangs would never let go of it."""
        try:
            self._process.terminate()
            self._process.wait(LONGEST_END)
        except BaseException as error:
            self._process.kill()
            self._process.wait()
            if not isinstance(error, subprocess.TimeoutExpired):
                raise
        finally:
            if self._stream is not None:
                self._stream.close()
                self._stream = None
            self._said.close()

    def _ready(self) -> tuple[RerunStream, Contents]:
        self.check()
        assert self._stream is not None
        assert self._contents is not None
        return self._stream, self._contents

    def _wait_for(self, port: int) -> None:
        """Until it listens."""
        until = time.monotonic() + LONGEST_START
        while not listening(port):
            if self._process.poll() is not None:
                raise InputError(self.name, f"did not start: {self._last_words()}")
            if time.monotonic() > until:
                raise InputError(self.name, f"did not listen at port {port} within {LONGEST_START:.0f} s")
            time.sleep(0.05)

    def _last_words(self) -> str:
        self._said.seek(0)
        lines = [line for line in self._said.read(100_000).decode(errors="replace").splitlines() if line.strip()]
        return lines[-1].strip() if lines else f"it ended with code {self._process.returncode}"


def _bound_to_us() -> Callable[[], object] | None:
    """What a process does before it becomes the viewer: on Linux it asks to be ended with us, even if we are killed.

    Nothing but the one call is done there, for between fork and exec no lock may be asked for (prctl(2)).
    """
    if not sys.platform.startswith("linux"):
        return None
    import ctypes

    ask = ctypes.CDLL(None).prctl
    return lambda: ask(PR_SET_PDEATHSIG, int(signal.SIGTERM))


def quiet_environment() -> dict[str, str]:
    """The environment of Rerun's program, in which it sends no telemetry: it sends none where it takes itself to be
    tested (re_analytics, native/config.rs), and has no other switch but the user's own settings."""
    return {**os.environ, "RUST_LOG": "error", "CI": "1"}


def binary() -> Path:
    """Rerun's own program: the script of its name would leave it behind when it is ended."""
    import rerun_cli

    found = Path(str(rerun_cli.__file__)).parent
    for name in ("rerun", "rerun.exe"):
        if (found / name).is_file():
            return found / name
    raise InputError("rerun-sdk", f"{found} holds no program rerun; install rerun-sdk anew")
