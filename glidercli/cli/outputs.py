"""The outputs of a command that makes a Log: checked before any work, written whole after it."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from glidercli.cli.printing import say, warn
from glidercli.errors import UsageError
from glidercli.log import Log

if TYPE_CHECKING:
    from glidercli.logio import Saving

__all__ = ["Sink", "check_log_outputs", "log_sink", "write_log"]

_STDOUT = Path("-")
RECOVERY = {
    ".mcap": "`pymcap-cli recover {part} -o FILE.mcap` brings back what stands in whole chunks",
    ".rrd": "`rerun rrd merge {part} -o FILE.rrd` brings back what stands in whole chunks, without panels",
    ".csv": "all but its last line is good",
}
"""What can be done with a part of an output, by its ending; of others nothing."""


def check_log_outputs(paths: Sequence[Path], force: bool, json: bool, quiet: bool, pictures: bool = False) -> None:
    """Refuse outputs that could not be written, and tell of parts that killed runs left of them.

    Standard output holds one document only.

    pictures : whether the command draws figures, too.
    """
    from glidercli.files import check_outputs, leftovers
    from glidercli.logio import SUFFIXES
    from glidercli.pictures import PICTURES

    if json and _STDOUT in paths:
        raise UsageError("-o - and --json both want stdout; leave one out")
    check_outputs(paths, SUFFIXES + PICTURES if pictures else SUFFIXES, force)
    for path in paths:
        for part in leftovers(path) if path != _STDOUT else ():
            how = RECOVERY.get(part.suffix.lower(), "it cannot be read").format(part=part)
            warn([f"{part}: left by a run that was killed; {how}; it may be removed"], quiet)


def write_log(log: Log, paths: Sequence[Path], force: bool, quiet: bool) -> None:
    """Write the log to every path, or to none; "-" is CSV on stdout."""
    from glidercli.logio import write
    from glidercli.logio.own.csv_log import CsvTable

    files = [path for path in paths if path != _STDOUT]
    write(log, *files, force=force)
    if _STDOUT in paths:
        CsvTable(sys.stdout).add(log)
    for path in files:
        say(f"wrote {path}", quiet)


class Sink:
    """Where a flight goes while it is flown, and when it is done; see ``log_sink``."""

    def __init__(self, saving: Saving, pictures: Sequence[Path], files: Sequence[Path], stdout: bool):
        """Begin. pictures : figures, under the names that they have while they are drawn."""
        self._saving, self._pictures, self._files, self._stdout = saving, pictures, files, stdout

    @property
    def piece(self) -> Callable[[Log], None] | None:
        """What takes the log in pieces, if only to forget them; None where something needs the whole of it."""
        if self._pictures or self._stdout:
            return None
        return self._saving.add

    def finish(self, log: Log) -> None:
        """Write what is not yet written. log : the whole, or the last piece where pieces were taken."""
        from glidercli.logio.own.csv_log import CsvTable

        if self.piece is None:
            self._saving.add(log)
        if self._files:
            self._saving.close(log)
        for part in self._pictures:
            from glidercli.pictures import save
            from glidercli.simulation.figure import draw_flight

            save(lambda: draw_flight(log), part, f"{log.kind}: {log.metadata['provenance']}")
        if self._stdout:
            CsvTable(sys.stdout).add(log)

    def say(self, quiet: bool) -> None:
        """Name what was written."""
        for path in self._files:
            say(f"wrote {path}", quiet)


@contextlib.contextmanager
def log_sink(paths: Sequence[Path], force: bool) -> Iterator[Sink]:
    """The outputs of a flight: all appear when the block is left, or none; "-" is CSV on stdout."""
    from glidercli.files import atomic
    from glidercli.logio import saving
    from glidercli.pictures import PICTURES

    files = [path for path in paths if path != _STDOUT]
    drawn = [path for path in files if path.suffix.lower() in PICTURES]
    with contextlib.ExitStack() as pending:
        pictures = [pending.enter_context(atomic(path, force)) for path in drawn]
        tables = pending.enter_context(saving([path for path in files if path not in drawn], force))
        yield Sink(tables, pictures, files, _STDOUT in paths)
