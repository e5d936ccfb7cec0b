"""How does a Log become an MCAP file? Piece by piece: its samples, what viewers draw of them, and what it is.

Metadata, attachments and provenance come first in the file where they are known by then, so that `pymcap-cli recover`
keeps them when the end is lost.
"""

from __future__ import annotations

import mimetypes
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import IO

from glidercli.errors import OutputError
from glidercli.log import Log
from glidercli.logio.mcap.beside import Beside
from glidercli.logio.mcap.contents import Contents
from glidercli.logio.mcap.file import McapFile
from glidercli.provenance import version
from glidercli.residuals import Residuals
from glidercli.utc import iso

__all__ = ["AT_THE_END", "FORMAT", "FORMATS", "McapLog", "write_mcap"]

FORMAT = "2"
"""Raised when a reader of the earlier layout would misread a file."""
FORMATS = ("1", FORMAT)
"""Layouts that can be read. In 1 a metadata record that came again replaced the one before it."""
AT_THE_END = ", told at the end"
"""Ending of the name of a metadata record with what came to be known while the file was written."""


def write_mcap(log: Log, path: Path, attach: Sequence[Path] = ()) -> None:
    """Write the log to ``path`` as MCAP; `read_mcap` gives it back equal to the last bit.

    attach : files that go with it as attachments, under their names.

    Raises OutputError for a time before 1970, which MCAP cannot hold.
    """
    with path.open("wb") as stream:
        file = McapLog(stream, attach)
        file.add(log)
        file.close(log)


class McapLog:
    """A log as MCAP, piece by piece; the same log in the same pieces gives the same bytes.

    attach : as for ``write_mcap``. beside, names, errors : other logs that go with it, what each is called, and their
    errors against it by channel, see beside.py; the log is then added as a whole, and is what the file is read back as.
    """

    def __init__(
        self,
        stream: IO[bytes],
        attach: Sequence[Path] = (),
        beside: Sequence[Log] = (),
        names: Sequence[str] = (),
        errors: Sequence[Mapping[str, Residuals]] = (),
    ) -> None:
        self._beside = [other.sliced(None, None) for other in beside]  # without channels that are empty
        self._called, self._errors = tuple(names), tuple(errors)
        self._path, self._attach = Path(stream.name), attach
        self._file = McapFile(stream)
        self._told: dict[str, dict[str, str]] = {}
        self._provenance = False
        self._start_ns: int | None = None
        self._contents: Contents | Beside | None = None

    def add(self, log: Log) -> None:
        """Append a piece, or the whole; all have the same channels, and the first has samples of each that comes."""
        self._check(log)
        if self._contents is None:
            self._start_ns = log.start_ns if any(map(len, log.channels.values())) else None
            self._contents = self._begin(log)
        for topics in self._contents.samples(log):
            self._file.add(topics)

    def close(self, log: Log) -> None:
        """Finish the file. log : its last piece, with all events and the final metadata."""
        self._check(log)
        if self._contents is None:
            self._contents = self._begin(log)
        self._tell(log)
        self._file.add(self._contents.whole(log))
        self._file.finish()

    def _begin(self, log: Log) -> Contents | Beside:
        if not self._beside:
            self._tell(log)
            return Contents(log)
        for other in self._beside:
            self._check(other)
        together = Beside(log, self._beside, self._called, self._errors)
        self._tell(log)
        for name, entries in together.told().items():
            self._file.metadata(name, entries)
        return together

    def _check(self, log: Log) -> None:
        times = [int(c.time_ns[0]) for c in log.channels.values() if len(c)] + [event.time_ns for event in log.events]
        if min(times, default=0) < 0:
            raise OutputError(self._path, f"MCAP starts at 1970, the log at {iso(min(times))}; .nc takes it")

    def _tell(self, log: Log) -> None:
        """Write metadata and attachments, those that are not yet there as they are now."""
        if not self._told:
            for path in self._attach:
                kind = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
                self._file.attach(path.name, path, kind, self._start_ns or 0)
        if not self._provenance and "provenance" in log.metadata:
            data = log.metadata["provenance"].encode()
            self._file.attach("provenance.json", data, "application/json", self._start_ns or 0)
            self._provenance = True
        origins = {name: channel.origin for name, channel in log.channels.items()}
        told = {
            "run": dict(log.metadata),
            "origin": {"log": log.origin, "channels": " ".join(log.channels), **origins},
            "version": {"program": f"glidercli {version()}", "format": FORMAT},
        }
        for name, entries in told.items():
            before = self._told.get(name)
            if before is None or not before.keys() <= entries.keys():
                self._file.metadata(name, entries)
            elif before != entries:
                later = {key: text for key, text in entries.items() if before.get(key) != text}
                self._file.metadata(name + AT_THE_END, later)
        self._told = told
