"""What does a file that grows hold by now? Its whole records; a half line at its end is left for the next look.

Text is read up to its last end of line. A Slocum's uncompressed file is read as it is: its reader leaves out a cycle
that is cut. All others are written as a whole: they count once they can be read to their end.
"""

from __future__ import annotations

import dataclasses
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from glidercli.errors import InputError
from glidercli.logio.reader import Aids, Part
from glidercli.logio.report import FileReport
from glidercli.logio.spreading import read_one
from glidercli.logio.strangers import NOT_PACKED

__all__ = ["GrowingFiles", "check_followable"]

HEAD = 4096
BEGINS = 65536
"""bytes; a file that is no log up to here will not become one."""
BLOCK = 1 << 20
SLOCUM = b"dbd_label"
WHOLE = {**NOT_PACKED, b"\x1f\x8b": "gzip"}
"""How files begin that are written as a whole, and what they are."""
NOT_WHOLE = "is not whole yet"


class _State(NamedTuple):
    """What tells one state of a file from another."""

    inode: int
    size: int
    mtime_ns: int


def check_followable(path: Path) -> None:
    """Raise InputError for a file of a kind that is written as a whole."""
    kind = _kind(path)
    if kind not in ("lines", "cycles"):
        raise InputError(
            path,
            f"cannot be followed: {kind} appears whole, it does not grow; text of lines (SeaExplorer, .eng, .csv) and "
            "uncompressed Slocum files can be followed, or a folder that gets new files",
        )


class GrowingFiles:
    """Files as they are at each look; what has not changed is not read again.

    format : as for ``read``. tell : is told, a line each, what became of a file. folder : for copies of what is whole.
    """

    def __init__(self, format: str | None, tell: Callable[[str], None], folder: Path) -> None:
        self._format, self._tell, self._folder = format, tell, folder
        self._known: dict[Path, tuple[_State | None, Part | FileReport]] = {}
        self.waiting = ""
        """Why one of the files gives nothing yet, or ""."""

    def changed(self, files: Sequence[Path]) -> bool:
        """Whether any of the files is not as it was at the last look, or another is gone."""
        return set(files) != set(self._known) or any(_state(p) != self._known[p][0] for p in files)

    def parts(self, files: Sequence[Path], aids: Aids) -> Iterator[Part | FileReport]:
        """What each file gives by now, in their order."""
        self.waiting = ""
        for gone in set(self._known) - set(files):
            self._tell(f"{gone}: is gone; what was shown of it stays{_account(_report(self._known.pop(gone)[1]))}")
        for path in files:
            state = _state(path)
            before = self._known.get(path)
            if before is not None and before[0] == state:
                found = before[1]
            else:
                found = self._read(path, aids)
                if before is not None:
                    became = _became(before[0], state)
                    self._say_left_out(path, _report(before[1]), _report(found), became)
                self._known[path] = state, found
            if isinstance(found, FileReport) and (
                found.format is not None or found.error == NOT_WHOLE or (state is not None and state.size < BEGINS)
            ):
                self.waiting = f"{path}: {found.error}"
            yield found

    def _say_left_out(self, path: Path, before: FileReport, now: FileReport, became: str) -> None:
        """Tell what of the new records of a file was left out; of one that is another now, what of its former ones."""
        if became:
            account = _account(before, now.warnings)
            self._tell(f"{path}: {became}; it is read anew, newer samples are shown{account}")
            return
        known = dict(before.dropped)
        dropped = {reason: count - known.get(reason, 0) for reason, count in now.dropped}
        words = [f"{count} {reason}" for reason, count in dropped.items() if count > 0]
        told = [f"new records left out: {', '.join(words)}"] if words else []
        told += [warning for warning in now.warnings if warning not in before.warnings]
        if told and now.error is None and before.error is None:
            self._tell(f"{path}: {'; '.join(told)}")

    def _read(self, path: Path, aids: Aids) -> Part | FileReport:
        if path.stat().st_size == 0:
            return FileReport(path, None, 0, 0, error=NOT_WHOLE)
        kind = _kind(path)
        if kind == "lines":
            return self._read_lines(path, aids)
        found = read_one(path, self._format, aids)
        report = _report(found)
        if kind != "cycles" and report.error is not None and report.format is not None:
            return dataclasses.replace(report, records=0, kept=0, dropped=(), error=NOT_WHOLE)
        return found

    def _read_lines(self, path: Path, aids: Aids) -> Part | FileReport:
        """What the lines of a text file give that have an end; a copy of them is read, with the same neighbours."""
        place = Path(tempfile.mkdtemp(dir=self._folder))
        try:
            copy = place / path.name
            if not _copy_lines(path, copy):
                return FileReport(path, None, 0, 0, error=NOT_WHOLE)
            stem = path.name.split(".", 1)[0]
            for beside in path.parent.iterdir():
                if beside.name != path.name and (beside.name.startswith(stem) or beside.suffix == ".toml"):
                    (place / beside.name).symlink_to(beside.resolve())
            found = read_one(copy, self._format, aids)
            report = _report(found)
            beside_it = tuple(path.parent / p.name if p.parent == place else p for p in report.beside)
            report = dataclasses.replace(report, path=path, beside=beside_it)
            return dataclasses.replace(found, report=report) if isinstance(found, Part) else report
        finally:
            shutil.rmtree(place, ignore_errors=True)


def _report(found: Part | FileReport) -> FileReport:
    return found.report if isinstance(found, Part) else found


def _became(before: _State | None, now: _State | None) -> str:
    """What became of a file that is another one now, or ""."""
    if before is None or now is None:
        return ""
    if now.size < before.size:
        return f"shrank from {before.size} to {now.size} bytes"
    return "was replaced" if now.inode != before.inode else ""


def _account(report: FileReport, known: Sequence[str] = ()) -> str:
    """What of a file's records had been left out, for the end of a line; "" where nothing was.

    known : warnings that need not be told.
    """
    told = [f"{count} {reason}" for reason, count in report.dropped]
    told += [warning for warning in report.warnings if warning not in known]
    return f"; of its {report.records} records {report.kept} had been kept: {', '.join(told)}" if told else ""


def _copy_lines(path: Path, copy: Path) -> int:
    """Copy a file up to its last end of line; how many bytes these are."""
    whole = size = 0
    with path.open("rb") as stream, copy.open("wb") as out:
        while block := stream.read(BLOCK):
            out.write(block)
            if (end := block.rfind(b"\n")) >= 0:
                whole = size + end + 1
            size += len(block)
        out.truncate(whole)
    return whole


def _state(path: Path) -> _State | None:
    try:
        told = path.stat()
    except OSError:
        return None
    return _State(told.st_ino, told.st_size, told.st_mtime_ns)


def _kind(path: Path) -> str:
    """How a file is written: "lines", "cycles", or the name of what is written as a whole."""
    with path.open("rb") as stream:
        head = stream.read(HEAD)
    if head.startswith(SLOCUM):
        return "cycles"
    for start, name in WHOLE.items():
        if head.startswith(start):
            return name
    return "a compressed or unknown binary file" if b"\0" in head else "lines"
