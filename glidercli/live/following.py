"""What is new in a log since the last look? Of each channel the samples after those that were shown.

Recorded samples do not change as a file grows. Derived ones may: the phase of a leg shows at its end, and a track is
closed when the next fix comes. Channels of which what was shown is told otherwise since are named.
"""

from __future__ import annotations

import contextlib
import dataclasses
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from glidercli.errors import InputError
from glidercli.live.growing import GrowingFiles, check_followable
from glidercli.log import Channel, Event, Log
from glidercli.logio.finding import found_in
from glidercli.logio.reading import Reading, read

__all__ = ["Follower", "Step", "following", "newer"]

_BEFORE_ALL = np.iinfo(np.int64).min

MOVED = 1.0
"""m; a track that was shown and moved by more is drawn anew."""


@dataclasses.dataclass(frozen=True)
class Step:
    """What one look gave.

    log : all that is known. piece : what is new in it, with every channel that has come so far. fresh : whether there
    are channels that were not there before. moved : whether the track that was shown lies elsewhere now, or recorded
    samples came among those that were shown. revised : whether anything that was shown is told otherwise now.
    """

    log: Log
    piece: Log
    fresh: bool
    moved: bool
    revised: bool

    @classmethod
    def without_news(cls, log: Log) -> Step:
        """A step that adds nothing to a log."""
        nothing = {name: channel.sliced(None, _BEFORE_ALL) for name, channel in log.channels.items()}
        return cls(log, dataclasses.replace(log, channels=nothing, events=()), False, False, False)


class Follower:
    """Looks at files that grow; see ``following``."""

    def __init__(
        self, paths: Sequence[str | Path], format: str | None, cache: Path | None, columns: Path | None,
        tell: Callable[[str], None], folder: Path,
    ) -> None:  # fmt: skip
        for path in found_in(paths).files:
            if not path.exists():
                raise InputError(path, "no such file")
            if any(Path(given) == path for given in paths) and path.is_file() and path.stat().st_size:
                check_followable(path)
        self._patient = not all(Path(given).is_file() for given in paths)
        self._paths, self._format, self._cache, self._columns = paths, format, cache, columns
        self._tell = tell
        self._files = GrowingFiles(format, tell, folder)
        self._shown: dict[str, Channel] = {}
        self._events: set[Event] = set()
        self._told: set[str] = set()
        self.reading: Reading | None = None
        """What the last look gave, or None before there was a record."""
        self.took = 0.0
        """s that the last look took."""

    def look(self) -> Step | None:
        """What is new, or None. Raises InputError where the files can be no log from the start."""
        try:
            files = list(found_in(self._paths).files)
        except InputError as error:
            self._once(str(error))
            return None
        if files and not self._files.changed(files):
            return None
        begun = time.monotonic()
        try:
            reading = read(
                self._paths, self._format, cache=self._cache, columns=self._columns, reader=self._files.parts
            )
        except (InputError, FileNotFoundError) as error:
            if self.reading is None and not self._files.waiting and not self._patient:
                raise
            self._once(self._files.waiting or str(error))
            return None
        finally:
            self.took = time.monotonic() - begun
        self.reading = reading
        return self._step(reading.log)

    def _step(self, log: Log) -> Step | None:
        fresh = any(len(c) and name not in self._shown for name, c in log.channels.items())
        piece, revised, moved = newer(self._shown, log)
        events = tuple(event for event in log.events if event not in self._events)
        if names := [name.replace("_", " ") for name in revised if name not in self._told]:
            self._told |= set(revised)
            self._tell(f"{', '.join(names)}: more is known now, and some of what was shown is told otherwise")
        for name, channel in log.channels.items():
            old = self._shown.get(name)
            if len(channel) and (old is None or channel.time_ns[-1] >= old.time_ns[-1]):
                self._shown[name] = channel
        self._events |= set(events)
        if not events and not any(map(len, piece.channels.values())) and not moved:
            return None
        return Step(log, dataclasses.replace(piece, events=events), fresh, moved, bool(revised))

    def _once(self, text: str) -> None:
        if text not in self._told:
            self._told.add(text)
            self._tell(f"nothing to show yet: {text}")


@contextlib.contextmanager
def following(
    paths: Sequence[str | Path], format: str | None, cache: Path | None, columns: Path | None,
    tell: Callable[[str], None],
) -> Iterator[Follower]:  # fmt: skip
    """A follower of files, folders and globs; its own files are removed when the block is left."""
    with tempfile.TemporaryDirectory(prefix="glider-follow-") as folder:
        yield Follower(paths, format, cache, columns, tell, Path(folder))


def newer(shown: dict[str, Channel], log: Log) -> tuple[Log, list[str], bool]:
    """The samples after those shown, the channels whose shown samples are told otherwise, and whether the track moved
    or recorded samples came among those shown.

    shown : channels as they were shown. The piece has all their names, too, and no events.
    """
    channels: dict[str, Channel] = {}
    revised: list[str] = []
    moved = False
    for name in dict.fromkeys([*log.channels, *shown]):
        old, new = shown.get(name), log.channels.get(name)
        if new is None or not len(new):
            assert old is not None or new is not None
            channels[name] = (new if new is not None else shown[name]).sliced(None, _BEFORE_ALL)
            continue
        if old is None or not len(old):
            channels[name] = new
            continue
        cut = int(np.searchsorted(new.time_ns, old.time_ns[-1], side="right"))
        channels[name] = dataclasses.replace(new, time_ns=new.time_ns[cut:], values=new.values[cut:])
        _, at, there = np.intersect1d(old.time_ns, new.time_ns[:cut], assume_unique=True, return_indices=True)
        off = np.abs(old.values[at] - new.values[there])
        if len(at) < max(len(old), cut) or (off > 0.0).any():
            revised.append(name)
            moved |= new.origin != "derived"
        moved |= name in ("north", "east") and bool((off > MOVED).any())
    return dataclasses.replace(log, channels=channels, events=()), revised, moved
