"""Which port of this machine alone may a server take? The one that was asked for, or the usual one, or any free one."""

from __future__ import annotations

import contextlib
import errno
import os
import socket
import tempfile
from collections.abc import Iterator
from pathlib import Path

from glidercli.errors import InputError

__all__ = ["HOST", "alone", "listening", "taken"]

HOST = "127.0.0.1"
"""Servers are for programs on this machine alone."""


def taken(port: int | None, usual: int) -> socket.socket:
    """A socket bound to a port: the one given, else the usual one, else any that is free.

    Raises InputError where the given one is in use or not allowed.
    """
    for number in (usual, 0) if port is None else (port,):
        found = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            found.bind((HOST, number))
            found.listen()
            return found
        except OSError as error:
            found.close()
            if port is not None:
                in_use = error.errno == errno.EADDRINUSE
                why = "is in use" if in_use else f"cannot be used: {error.strerror}"
                raise InputError("--port", f"port {port} {why}; another from 1024 to 65535 is needed") from None
    raise InputError("--port", f"no port of {HOST} is free")


@contextlib.contextmanager
def alone() -> Iterator[None]:
    """While a program of another maker takes its ports: a second one that starts now waits.

    What such a program is told to take is free until it listens, so that two that start at once would take the same.
    Where there are no such locks, or none can be had, nothing waits.
    """
    try:
        import fcntl

        path = Path(tempfile.gettempdir()) / f"glider-ports-{os.getuid()}.lock"
        lock = os.open(path, os.O_CREAT | os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
    except (ImportError, OSError):
        yield
        return
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield
    finally:
        os.close(lock)


def listening(port: int) -> bool:
    """Whether something accepts connections at a port."""
    try:
        with socket.create_connection((HOST, port), timeout=0.5):
            return True
    except OSError:
        return False
