"""Which viewers are asked for, and how does the log reach them? The options, checked before any work."""

from __future__ import annotations

import dataclasses
import math
import os
import sys

from glidercli.errors import InputError, UsageError

__all__ = ["Choices", "check_choices"]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Choices:
    """What was asked for.

    spawn : the Rerun viewer. serve : the Rerun web viewer. foxglove : a WebSocket for Foxglove and Lichtblick, which is
    also what a pace or following alone ask for. rate : log time per time of the clock, None for all at once; a
    WebSocket has no "all at once", so it plays at 1. follow : whether the files may grow. port : of the web page, else
    of the WebSocket; None for the usual. wait : s that a play waits for a viewer of the WebSocket.
    """

    spawn: bool = False
    serve: bool = False
    foxglove: bool = False
    rate: float | None = None
    follow: bool = False
    port: int | None = None
    wait: float

    @property
    def live(self) -> bool:
        """Whether anything is to be shown."""
        return self.spawn or self.serve or self.foxglove or self.rate is not None or self.follow

    @property
    def websocket(self) -> bool:
        """Whether there is a WebSocket."""
        return self.foxglove or (self.live and not self.spawn and not self.serve)

    @property
    def pace(self) -> float | None:
        """Log time per time of the clock; None where all is sent as soon as it is there."""
        return 1.0 if self.rate is None and self.websocket and not self.follow else self.rate


def check_choices(choices: Choices) -> None:
    """Raise UsageError for options that do not go together, InputError where there is no display for a window."""
    rate, port, wait = choices.rate, choices.port, choices.wait
    if rate is not None and not 0.0 < rate < math.inf:
        raise UsageError(f"--rate: {rate:g} is no pace; a finite number above 0 is needed, 1 is as it happened")
    if rate is not None and choices.follow:
        raise UsageError("--rate and --follow exclude each other: what is followed is shown when it comes")
    if port is not None and not choices.serve and not choices.websocket:
        raise UsageError("--port is that of --serve or of the WebSocket of --rate, --follow, --foxglove")
    if port is not None and not 1024 <= port <= 65535:
        raise UsageError(f"--port: {port} is not allowed; 1024 to 65535 are")
    if not 0.0 < wait <= 86400.0:
        raise UsageError(f"--wait: {wait:g} s is not allowed; more than 0, at most 86400 s are")
    shown = ("DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET")
    if choices.spawn and sys.platform.startswith("linux") and not any(map(os.environ.get, shown)):
        raise InputError("--spawn", "there is no display (DISPLAY, WAYLAND_DISPLAY) for a window; --serve needs none")
