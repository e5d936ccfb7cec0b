"""How does a Log become a Rerun recording (.rrd)? Piece by piece: the flight in three dimensions, channels as plots."""

from __future__ import annotations

import atexit
import ctypes
import errno
import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.errors import InputError, OutputError
from glidercli.log import Log
from glidercli.logio.rerun.beside import Beside
from glidercli.logio.rerun.contents import Contents
from glidercli.logio.rerun.settling import Settled, identified, settle
from glidercli.residuals import Residuals

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["RerunLog", "write_rerun"]

PATIENCE = 30.0
"""s; a piece takes tenths of one. Rerun waits without end for a writer that a full disk ended in the wrong moment."""


def write_rerun(
    log: Log,
    path: Path,
    beside: Sequence[Log] = (),
    names: Sequence[str] = (),
    errors: Sequence[Mapping[str, Residuals]] = (),
) -> None:
    """Write the log to `path` as a Rerun recording with its blueprint; the same log gives the same bytes.

    beside : logs to show in the same panels, each in its colour, with their differences from the first; on its clock
    where they overlap in UTC, else all start together. names : what to call the log and each of those; default: its
    kind, such as MEASURED or SIMULATED. errors : of each of those against the log, by channel, as a comparison found
    them; they are then the differences.

    Timelines are utc and elapsed (from the log's first sample). Each channel keeps its own times and stands under
    /GROUP/NAME in table units (degrees, dbar, cm3), depth negative down; the scene stands under /world in NED, m.
    Raises OutputError for a log without a single sample.
    """
    file = RerunLog(path, beside, names, errors)
    file.add(log)
    file.close(log)


class RerunLog:
    """A log as a Rerun recording, piece by piece; the same log in the same pieces gives the same bytes.

    beside, names, errors : as for ``write_rerun``; the log is then added as a whole.
    """

    def __init__(
        self,
        path: Path,
        beside: Sequence[Log] = (),
        names: Sequence[str] = (),
        errors: Sequence[Mapping[str, Residuals]] = (),
    ) -> None:
        self._path, self._errors = path, tuple(errors)
        self._beside, self._called = [other.sliced(None, None) for other in beside], tuple(names)
        if self._called and len(self._called) != len(self._beside) + 1:
            raise InputError("names", f"{len(self._called)} for {len(self._beside) + 1} logs; one each is needed")
        if self._errors and len(self._errors) != len(self._beside):
            raise InputError("errors", f"{len(self._errors)} for {len(self._beside)} logs beside; one each is needed")
        if not all(other.channels for other in self._beside):
            raise InputError("beside", "a log holds no sample")
        self._hash = hashlib.sha256()
        self._contents: Contents | Beside | None = None
        self._sent = 0

    def add(self, log: Log) -> None:
        """Append a piece, or the whole; all have the same channels, and the first has samples of each that comes."""
        self._digest(log)
        if not any(map(len, log.channels.values())):
            return
        if self._contents is None:
            self._contents = self._begin(log.sliced(None, None))  # without channels that are empty
        for chunks in self._contents.samples(log):
            self._send(chunks, self._key)

    def close(self, log: Log) -> None:
        """Finish the file. log : its last piece, with all events and the final metadata."""
        if self._contents is None:
            raise OutputError(self._path, "not written: the log holds no sample")
        self._tell(log)
        key = self._hash.hexdigest()
        chunks, views = self._contents.whole(log)
        import rerun as rr

        self._send(chunks, key)
        settled: Any = Settled(views, key)
        rr.send_blueprint(settled, recording=self._recording)
        self._flush()
        self._recording.disconnect()
        settle(self._path, self._key[:32], key)

    def _begin(self, log: Log) -> Contents | Beside:
        os.environ.setdefault("RUST_LOG", "off")  # faults are ours to tell
        import rerun as rr

        rr.set_strict_mode(True)
        for other in self._beside:
            self._digest(other)
            self._tell(other)
        self._hash.update(json.dumps(self._called).encode())
        for name, left in ((name, left) for errors in self._errors for name, left in errors.items()):
            times, values = left.with_gaps()
            self._hash.update(f"error {name} ".encode() + times.tobytes() + values.tobytes())
        self._key = self._hash.hexdigest()
        contents = Beside(log, self._beside, self._called, self._errors) if self._beside else Contents(log)
        self._recording = rr.RecordingStream("glider", recording_id=self._key[:32], send_properties=False)
        self._recording.set_log_time_enabled(False)
        self._recording.save(self._path)
        self._send(contents.styles(), self._key)
        return contents

    def _send(self, chunks: list[Chunk], key: str) -> None:
        """Write chunks; their ids come from the key."""
        import rerun as rr

        rr.send_chunks(identified(chunks, key, self._sent), recording=self._recording)
        self._flush()
        self._sent += len(chunks)

    def _flush(self) -> None:
        try:
            self._recording.flush(timeout_sec=PATIENCE)
        except RuntimeError:  # all that Rerun tells
            self._abandon()
            raise OSError(errno.ENOSPC, "the writer of Rerun gave up; is the disk full?") from None

    def _abandon(self) -> None:
        """Never close the recording: that, as Rerun's own end, waits for a writer that is gone, without end."""
        import rerun as rr

        atexit.unregister(rr.rerun_shutdown)
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(self._recording))  # so that nothing deletes it

    def _tell(self, log: Log) -> None:
        """Take what a log tells beside its samples into the hash."""
        told = [log.origin, [*log.metadata.items()], [(e.name, e.time_ns, e.depth) for e in log.events]]
        self._hash.update(json.dumps(told).encode())

    def _digest(self, log: Log) -> None:
        """Take all samples of a piece into the hash; the order of channels does not count."""
        for name, channel in sorted(log.channels.items()):
            if len(channel):
                self._hash.update(f"{name} {channel.origin} {len(channel)} ".encode())
                self._hash.update(channel.time_ns.tobytes() + channel.values.tobytes())
