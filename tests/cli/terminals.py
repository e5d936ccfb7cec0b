"""What does a command show on a terminal so wide? One is made for it, as for a person."""

from __future__ import annotations

import contextlib
import os
import pty
import subprocess
import termios

from conftest import GLIDER


def on_a_terminal(columns: int, *arguments: object, told: int | None = None) -> tuple[int, list[str]]:
    """Exit code and lines of the command on a terminal so wide. told : what COLUMNS says instead."""
    ours, theirs = pty.openpty()
    termios.tcsetwinsize(theirs, (40, columns))
    environment = {key: text for key, text in os.environ.items() if key != "COLUMNS"}
    environment |= {} if told is None else {"COLUMNS": str(told)}
    command = [GLIDER, *map(str, arguments)]
    done = subprocess.Popen(command, stdout=theirs, stderr=theirs, env=environment)
    os.close(theirs)
    shown = b""
    with contextlib.suppress(OSError):  # the end of a terminal
        while piece := os.read(ours, 4096):
            shown += piece
    os.close(ours)
    return done.wait(60), shown.decode().splitlines()
