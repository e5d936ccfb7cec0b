"""The outputs of a command that makes a Log: checked before any work, written whole after it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from glidercli.cli.printing import say
from glidercli.errors import UsageError
from glidercli.log import Log

__all__ = ["check_log_outputs", "write_log"]

_STDOUT = Path("-")


def check_log_outputs(paths: Sequence[Path], force: bool, json: bool) -> None:
    """Refuse outputs that could not be written; standard output holds one document only."""
    from glidercli.files import check_outputs
    from glidercli.logio import SUFFIXES

    if json and _STDOUT in paths:
        raise UsageError("-o - and --json both want stdout; leave one out")
    check_outputs(paths, SUFFIXES, force)


def write_log(log: Log, paths: Sequence[Path], force: bool, quiet: bool) -> None:
    """Write the log to every path, or to none; "-" is CSV on stdout."""
    from glidercli.logio import write
    from glidercli.logio.csv_log import write_csv_stream

    files = [path for path in paths if path != _STDOUT]
    write(log, *files, force=force)
    if _STDOUT in paths:
        write_csv_stream(log, sys.stdout)
    for path in files:
        say(f"wrote {path}", quiet)
