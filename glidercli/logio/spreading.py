"""How are many files read? One by one; or, where they are large, spread over processes."""

from __future__ import annotations

import dataclasses
import signal
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from glidercli.errors import GliderError, InputError
from glidercli.files import readable_file
from glidercli.logio.consistent import without_spikes
from glidercli.logio.formats import FORMATS, recognised
from glidercli.logio.reader import Aids, Part
from glidercli.logio.records import OUT_OF_ORDER
from glidercli.logio.report import FileReport

__all__ = ["read_all", "read_one"]

LARGE = 20_000_000
"""Bytes in all from which on it pays to start processes, which takes a second."""


def read_all(
    files: Sequence[Path],
    format: str | None,
    aids: Aids,
    progress: Callable[[float, float], None] | None,
    workers: int,
) -> Iterator[Part | FileReport]:
    """What each file gives, in the order of the files; of one that gives nothing the report that says why.

    progress : is told the files read and the files to read.
    """
    tell = progress or (lambda done, whole: None)
    tell(0, len(files))
    size = sum(path.stat().st_size for path in files if path.is_file())
    if workers < 2 or len(files) < 2 or size < LARGE:
        for done, path in enumerate(files, 1):
            yield read_one(path, format, aids)
            tell(done, len(files))
        return
    from concurrent.futures import ProcessPoolExecutor
    from concurrent.futures.process import BrokenProcessPool
    from multiprocessing import get_context

    # spawn, not fork: the thread of the progress bar may hold a lock at the moment of a fork
    pool = ProcessPoolExecutor(min(workers, len(files)), get_context("spawn"), initializer=_deaf)
    try:
        futures = deque(pool.submit(read_one, path, format, aids) for path in files)
        while futures:
            try:
                found = futures.popleft().result()
            except BrokenProcessPool:
                at = files[len(files) - len(futures) - 1]
                raise InputError(at, "a process that read it or a file after it was killed: is memory short?") from None
            yield found
            del found  # the caller may let go of it
            tell(len(files) - len(futures), len(files))
    finally:
        pool.shutdown(cancel_futures=True)


def _doubted(report: FileReport) -> FileReport:
    """The report, with a line where most records were dropped for their order: sorted another way, or reversed?"""
    gone = sum(count for reason, count in report.dropped if reason in OUT_OF_ORDER)
    if 2 * gone <= report.records:
        return report
    line = f"{gone} of {report.records} records are not in the order of time: is it reversed, or sorted otherwise?"
    return dataclasses.replace(report, warnings=(line, *report.warnings))


def _deaf() -> None:
    """Leave Ctrl-C to the first process, which says how far it came."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def read_one(path: Path, format: str | None, aids: Aids) -> Part | FileReport:
    """What a file gives; where it gives nothing the report, with the format as far as it was recognised."""
    name = format
    try:
        name = recognised(path, format, aids)
        part = FORMATS[name].read(readable_file(path), aids)
    except GliderError as error:
        return FileReport(path, name, 0, 0, error=str(error).removeprefix(f"{path}: "))
    except OSError as error:
        return FileReport(path, name, 0, 0, error=f"cannot be read: {error.strerror or error}")
    if any(map(len, part.log.channels.values())):
        part = part if FORMATS[name].own else without_spikes(part)
        return dataclasses.replace(part, report=_doubted(part.report))
    why = ", ".join(f"{count} {reason}" for reason, count in part.report.dropped)
    return dataclasses.replace(part.report, error=part.report.error or "no usable record" + (f": {why}" if why else ""))
