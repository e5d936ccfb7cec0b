"""How does a Log become a Rerun recording (.rrd)? Piece by piece: the flight in three dimensions, channels as plots."""

from __future__ import annotations

import errno
import hashlib
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.errors import OutputError
from glidercli.log import Log
from glidercli.logio.rerun.contents import Contents
from glidercli.logio.rerun.settling import Settled, identified, settle

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["RerunLog", "write_rerun"]


def write_rerun(log: Log, path: Path) -> None:
    """Write the log to `path` as a Rerun recording with its blueprint; the same log gives the same bytes.

    Timelines are utc and elapsed (from the log's first sample). Each channel keeps its own times and stands under
    /GROUP/NAME in table units (degrees, dbar, cm3), depth negative down; the scene stands under /world in NED, m.
    Raises OutputError for a log without a single sample.
    """
    file = RerunLog(path)
    file.add(log)
    file.close(log)


class RerunLog:
    """A log as a Rerun recording, piece by piece; the same log in the same pieces gives the same bytes."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._hash = hashlib.sha256()
        self._contents: Contents | None = None
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
        told = [log.origin, [*log.metadata.items()], [(e.name, e.time_ns, e.depth) for e in log.events]]
        self._hash.update(json.dumps(told).encode())
        key = self._hash.hexdigest()
        chunks, views = self._contents.whole(log)
        import rerun as rr

        self._send(chunks, key)
        settled: Any = Settled(views, key)
        rr.send_blueprint(settled, recording=self._recording)
        self._flush()
        self._recording.disconnect()
        settle(self._path, self._key[:32], key)

    def _begin(self, log: Log) -> Contents:
        os.environ.setdefault("RUST_LOG", "off")  # faults are ours to tell
        import rerun as rr

        rr.set_strict_mode(True)
        self._key = self._hash.hexdigest()
        contents = Contents(log)
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
            self._recording.flush()
        except RuntimeError:  # all that Rerun tells
            raise OSError(errno.ENOSPC, "the writer of Rerun gave up; is the disk full?") from None

    def _digest(self, log: Log) -> None:
        """Take all samples of a piece into the hash; the order of channels does not count."""
        for name, channel in sorted(log.channels.items()):
            if len(channel):
                self._hash.update(f"{name} {channel.origin} {len(channel)} ".encode())
                self._hash.update(channel.time_ns.tobytes() + channel.values.tobytes())
