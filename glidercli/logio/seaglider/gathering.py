"""What does a file of several kinds of records give? Its channels, and one account over all kinds.

A kind of records has its own times: the entries of a dimension of a .nc, the lines of one key of a .log. Each kind goes
through the named rules of records.py by itself; reasons name the kind.
"""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel, Event, Log
from glidercli.logio.reader import Part
from glidercli.logio.records import NO_TIME, STRAY, sampled, usable
from glidercli.logio.report import FileReport
from glidercli.logio.seaglider.columns import NOTES

__all__ = ["Dive", "Gathering"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclasses.dataclass(frozen=True)
class Dive:
    """Which dive a file is of; None where the file does not tell."""

    glider: int | None
    mission: int | None
    dive: int | None

    @property
    def name(self) -> str:
        """Such as sg561.6.3: glider, mission, dive; "" where the file does not tell all three."""
        known = None not in (self.glider, self.mission, self.dive)
        return f"sg{self.glider:03d}.{self.mission}.{self.dive}" if known else ""

    def metadata(self) -> dict[str, str]:
        """As metadata of a log."""
        platform = "Seaglider" if self.glider is None else f"Seaglider sg{self.glider:03d}"
        told = {"platform": "" if self.glider is None else platform, "title": f"{platform} log"}
        told |= {"mission": _text(self.mission), "dive": _text(self.dive)}
        return {key: value for key, value in told.items() if value}


def _text(number: int | None) -> str:
    return "" if number is None else str(number)


@dataclasses.dataclass
class Gathering:
    """What was read of a file so far.

    reference_ns : a time within the dive, UTC ns; what is more than 30 days from it is of another clock.
    """

    reference_ns: int | None = None
    records: int = 0
    dropped: Counter[str] = dataclasses.field(default_factory=Counter)
    warnings: list[str] = dataclasses.field(default_factory=list)
    channels: list[Channel] = dataclasses.field(default_factory=list)
    events: list[Event] = dataclasses.field(default_factory=list)
    metadata: dict[str, str] = dataclasses.field(default_factory=dict)
    kept_ns: list[Times] = dataclasses.field(default_factory=list)
    unread: list[str] = dataclasses.field(default_factory=list)
    beside: list[Path] = dataclasses.field(default_factory=list)

    def drop(self, kind: str, reason: str, count: int) -> None:
        """Count records of a kind as dropped."""
        if count:
            self.dropped[f"{kind}: {reason}" if kind else reason] += count

    def usable(self, kind: str, time_ns: Times, cells: Mapping[str, Array]) -> Mask:
        """Which records of a kind can be used, (n,); the others are counted. Its arguments are those of usable()."""
        self.records += len(time_ns)
        near = np.ones(len(time_ns), dtype=bool)
        if self.reference_ns is not None:
            away = np.abs(time_ns / 1e9 - self.reference_ns / 1e9) > STRAY / 1e9
            near = (time_ns == NO_TIME) | ~away
            self.drop(kind, "clock not set: more than 30 days from the dive", int((~near).sum()))
        reasons: Counter[str] = Counter()
        good = near.copy()
        good[near] = usable(time_ns[near], {name: values[near] for name, values in cells.items()}, reasons)
        for reason, count in reasons.items():
            self.drop(kind, reason, count)
        return good

    def keep(self, kind: str, time_ns: Times, gave: Mask, reason: str = "no usable value") -> None:
        """Count the usable records of a kind: kept where they gave a sample, dropped for a reason elsewhere.

        time_ns : (n,), of the record or of its first sample. gave : (n,).
        """
        self.drop(kind, reason, int((~gave).sum()))
        self.kept_ns.append(time_ns[gave])

    def keep_rows(self, kind: str, time_ns: Times, channels: list[Channel]) -> None:
        """Take the channels of rows that share their times, and count the rows."""
        given = [channel for channel in channels if len(channel)]
        self.keep(kind, time_ns, sampled(time_ns, {channel.name: channel for channel in given}))
        self.channels += given

    def part(self, path: Path, dive: Dive, holds: tuple[str, ...], **more: object) -> Part:
        """The Part. holds : endings of the recordings in it. more : error of the report, fullness and yields."""
        record_ns = np.sort(np.concatenate(self.kept_ns or [np.array([], np.int64)]))
        report = FileReport(
            path,
            "seaglider",
            self.records,
            len(record_ns),
            tuple(sorted(self.dropped.items())),
            tuple(self.warnings),
            more.pop("error", None),  # type: ignore[arg-type]
            tuple(self.beside),
        )
        channels = {name: _merged(name, self.channels) for name in dict.fromkeys(c.name for c in self.channels)}
        events = tuple(sorted(self.events, key=lambda event: event.time_ns))
        log = Log(channels, "measured", dive.metadata() | self.metadata | NOTES, events)
        recordings = tuple(f"{dive.name}.{ending}" for ending in holds) if dive.name else ()
        beside = {"eng": "log", "log": "eng"}.get(holds[0]) if len(holds) == 1 else None
        partner = f"{dive.name}.{beside}" if beside and dive.name and not self.beside else ""
        return Part(
            log, report, record_ns, dive.name, recordings, partner=partner, unread=tuple(self.unread),
            **more,  # type: ignore[arg-type]
        )  # fmt: skip


def _merged(name: str, channels: list[Channel]) -> Channel:
    """One channel of all of this name; of two samples at one time the first is kept."""
    same = [channel for channel in channels if channel.name == name]
    if len(same) == 1:
        return same[0]
    time_ns, first = np.unique(np.concatenate([channel.time_ns for channel in same]), return_index=True)
    return Channel(name, time_ns, np.concatenate([channel.values for channel in same])[first], same[0].origin)
