"""How is a NetCDF file opened, so that no damage in it becomes more than one line? NetCDF-3 and NetCDF-4 (HDF5)."""

from __future__ import annotations

import contextlib
import functools
import mmap
import os
import signal
import time
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from glidercli.errors import InputError
from glidercli.netcdf_heaps import check_heaps

__all__ = ["DAMAGED", "dataset", "holds", "is_netcdf", "opened", "rows_of"]

MAGIC = (b"CDF\x01", b"CDF\x02", b"CDF\x05", b"\x89HDF\r\n\x1a\n")
"""How the files start: NetCDF classic, 64-bit offset and data, and HDF5 (NetCDF Users' Guide, file format)."""
DAMAGED = "is NetCDF data that cannot be read: damaged or cut short; a whole file is needed"
LONGEST = 10
"""s; opening takes some ms."""
MOST_PACKED = 10_000
"""No compression that is in use makes times so much shorter; deflate makes at most 1032 of one."""


def is_netcdf(path: Path) -> bool:
    """Whether the file starts as a NetCDF file does."""
    with path.open("rb") as stream:
        return stream.read(8).startswith(MAGIC)


@functools.lru_cache(maxsize=1024)
def _opens(path: Path, changed_ns: int, size: int) -> bool:
    """Whether the library opens a file at all, tried in a process beside this one.

    A single bit turned in an HDF5 file can keep its library busy without end (one of some 600 that were tried), and
    a library in C may take the whole program with it. Where processes cannot fork the file is trusted.
    """
    import netCDF4  # here, so that the other process finds it ready

    if not _has_whole_heaps(path):
        return False
    if not hasattr(os, "fork"):
        return True
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # other threads: the child takes no lock of theirs
        child = os.fork()
    if child == 0:  # pragma: no cover
        code = 1
        try:
            signal.signal(signal.SIGALRM, signal.SIG_DFL)
            signal.alarm(LONGEST)  # ends it even if nobody is there any more to do so
            netCDF4.Dataset(path).close()
            code = 0
        finally:
            os._exit(code)
    until, wait = time.monotonic() + LONGEST, 0.001
    while time.monotonic() < until:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return status == 0
        time.sleep(wait)
        wait = min(2.0 * wait, 0.05)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return False


def _has_whole_heaps(path: Path) -> bool:
    """False where a global heap of an HDF5 file does not add up: the library goes round in some of these for ever."""
    with path.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
        try:
            check_heaps(data)
        except ValueError:
            return False
    return True


def dataset(path: Path) -> Any:
    """The netCDF4.Dataset of a file, to be closed; OSError where the library cannot open it, or never ends to."""
    import netCDF4

    state = path.stat()
    if not _opens(path, state.st_mtime_ns, state.st_size):
        raise OSError("does not open")
    return netCDF4.Dataset(path)


@contextlib.contextmanager
def opened(path: Path) -> Iterator[Any]:
    """The netCDF4.Dataset of a file, its values as stored; InputError for whatever fails while it is open."""
    if not is_netcdf(path):
        raise InputError(path, "is no NetCDF file: it does not start with the bytes of one")
    try:
        with dataset(path) as file:
            file.set_auto_maskandscale(False)
            file.set_auto_chartostring(False)
            yield file
    except (OSError, RuntimeError, ValueError, LookupError, AttributeError, TypeError, MemoryError) as fault:
        raise InputError(path, DAMAGED) from fault


def holds(path: Path, told: Callable[[Any], bool]) -> bool:
    """Whether a file is NetCDF and of a kind, by a look at its dimensions, names and attributes."""
    if not is_netcdf(path):
        return False
    try:
        with opened(path) as file:
            return told(file)
    except InputError:
        return False


def rows_of(path: Path, file: Any, dimension: str) -> int:
    """The length of a dimension; InputError where it is announced longer than the file can hold times for."""
    rows = len(file.dimensions[dimension])
    if rows * 8 > path.stat().st_size * MOST_PACKED:
        raise InputError(path, f"announces {rows} records, more than a file of its size can hold; it is damaged")
    return rows
