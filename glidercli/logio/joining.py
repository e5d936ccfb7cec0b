"""When do several files make one log? In time order, no record twice, nothing of another origin among them.

Files of one dive (navigation and payload) may interleave; where they share no time, as with a clock a year off, that is
told, and they are placed like files of different dives. Dives follow one another: what is not after the one before is
dropped and counted. Of files that hold the same recording the best is read, and of
the others what stands before and after it.
"""

from __future__ import annotations

import dataclasses
import json
from collections import deque

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel, Event, Log, Origin
from glidercli.logio.alike import alike, with_note
from glidercli.logio.consistent import with_agreeing_fixes
from glidercli.logio.cut_text import CUT
from glidercli.logio.derived.closure import closures_in
from glidercli.logio.derived.motion import with_phase
from glidercli.logio.reader import Part
from glidercli.logio.report import FileReport
from glidercli.utc import to_second

__all__ = ["joined"]

FOREVER = np.iinfo(np.int64).max
FAR = 86400 * 10**9
"""Files further apart in time than this are joined, and it is said, ns."""


def joined(parts: list[Part], own: bool = False) -> tuple[Log, list[FileReport]]:
    """One Log of what several files gave, and their reports with what joining dropped.

    ``parts`` is emptied, so that what has been joined need not be in memory twice. A dive without a recorded phase has
    it from depth beside dives that have one, and fixes that all others rule out are left out (consistent.py); not where
    all files are this program's ``own``.

    Raises InputError where the files cannot be of one flight (alike.py).
    """
    parts[:] = alike(parts)
    reports = {part.report.path: part.report for part in parts}
    dives: dict[str, list[Part]] = {}
    holders: dict[str, list[Part]] = {}
    for part in parts:
        for name in part.holds:
            holders.setdefault(name, []).append(part)
    fullest: dict[tuple[str, ...], Part] = {}
    for number, part in enumerate(parts):
        if part.holds and part.holds not in fullest:
            fullest[part.holds] = _fullest(part.holds, holders[part.holds[0]])
        best = fullest.get(part.holds, part)
        if best is not part:
            part = _beyond(part, best)
            reports[part.report.path] = part.report
        if len(part.record_ns):
            dives.setdefault(part.dive or f"file {number}", []).append(part)
    paths = [part.report.path for part in parts]
    parts.clear()
    holders.clear()
    fullest.clear()
    reached: dict[str, int] = {}
    apart = [group for dive in dives.values() for group in _apart(dive)]
    dives.clear()
    ordered = deque(sorted(apart, key=lambda files: min(part.log.start_ns for part in files)))
    apart.clear()
    left: deque[list[Part]] = deque()
    while ordered:
        dive = [_after(part, reached) for part in _without_yielded(ordered.popleft())]
        for name, end_ns in [(n, int(c.time_ns[-1])) for part in dive for n, c in part.log.channels.items() if len(c)]:
            reached[name] = max(end_ns, reached.get(name, end_ns))
        left.append(dive)
    if not own:
        agreeing = iter(with_agreeing_fixes([part for dive in left for part in dive]))
        left = deque([next(agreeing) for _ in dive] for dive in left)
        del agreeing
    kept: list[Log] = []
    while left:
        dive = left.popleft()
        reports |= {part.report.path: part.report for part in dive}
        log = _interleaved([part.log for part in dive if part.log.channels])
        if log is not None:
            kept.append(log)
    if not own and any("phase" in log for log in kept):
        kept = [with_phase(log) for log in kept]
    return _one(kept), [reports[path] for path in paths]


def _fullest(holds: tuple[str, ...], others: list[Part]) -> Part:
    """The best of the files that hold all of these recordings: whole, full, long, first.

    A text that ends in the middle of a line is as good as a whole one as far as it goes.
    """
    twins = [other for other in others if set(holds) <= set(other.holds)]

    def worth(other: Part) -> tuple[bool, int, int, int]:
        return other.report.error in (None, CUT), other.fullness, len(other.holds), other.report.kept

    return max(twins, key=worth)


def _beyond(part: Part, best: Part) -> Part:
    """What a file has before and after a better one of the same recording; the rest is counted as dropped."""
    shared = [best.log[name].time_ns for name in part.log.channels.keys() & best.log.channels.keys()]
    first, last = min((int(t[0]) for t in shared), default=-FOREVER), max((int(t[-1]) for t in shared), default=FOREVER)
    outside = (part.record_ns < first) | (part.record_ns > last)
    kept = _keeping(part, outside, f"its recording is in {best.report.path.name}")
    channels = {}
    for name, channel in part.log.channels.items():
        there = (channel.time_ns < first) | (channel.time_ns > last)
        if there.any():
            channels[name] = dataclasses.replace(channel, time_ns=channel.time_ns[there], values=channel.values[there])
    events = tuple(event for event in part.log.events if not first <= event.time_ns <= last)
    return dataclasses.replace(kept, log=dataclasses.replace(part.log, channels=channels, events=events))


def _apart(dive: list[Part]) -> list[list[Part]]:
    """The files of a dive in groups that share no time, earlier ones first; all but the first group say so."""
    groups: list[list[Part]] = []
    end_ns = -FOREVER
    for part in sorted(dive, key=lambda part: part.log.start_ns):
        before = groups[-1] if groups else []
        apart, end_ns = part.log.start_ns > end_ns, max(end_ns, part.log.end_ns)
        if not apart:
            before.append(part)
            continue
        if before:
            note = (
                f"{_span([part])}: shares no time with {before[0].report.path.name} of the same dive, {_span(before)}; "
                "both are kept, is a clock wrong?"
            )
            part = with_note(part, note)
        groups.append([part])
    if len(groups) == 1:
        return [dive]  # in the given order: of two samples at one time the first file's is kept
    return groups


def _span(parts: list[Part]) -> str:
    """From when to when files go."""
    ends = (min(part.log.start_ns for part in parts), max(part.log.end_ns for part in parts))
    return " to ".join(map(to_second, ends))


def _long(time_ns: int) -> str:
    """A time of more than a day, ns, in words: 36 days; 2 years and 34 days."""
    days = round(time_ns / FAR)
    years, rest = divmod(days, 365)
    told = [f"{count} {word}{'' if count == 1 else 's'}" for count, word in ((years, "year"), (rest, "day")) if count]
    return " and ".join(told)


def _without_yielded(dive: list[Part]) -> list[Part]:
    """The files of a dive, without the channels that one gives up since another has them."""
    left = []
    other = {name for file in dive for name in file.log.channels.keys() - file.yields}
    for part in dive:
        given = sorted(part.yields & other & part.log.channels.keys())
        if given:
            channels = {name: c for name, c in part.log.channels.items() if name not in given}
            count = sum(len(part.log[name]) for name in given)
            note = f"{', '.join(given)}: {count} values left out, another file of the dive gives them"
            times = np.unique(np.concatenate([c.time_ns for c in channels.values()] or [part.record_ns[:0]]))
            part = with_note(dataclasses.replace(part, log=dataclasses.replace(part.log, channels=channels)), note)
            part = _keeping(part, np.isin(part.record_ns, times), "no other value than those left out")
        left.append(part)
    return left


def _keeping(part: Part, kept: NDArray[np.bool_], reason: str) -> Part:
    """A file with some of its records only, (n,); the others are counted."""
    gone = int((~kept).sum())
    if not gone:
        return part
    report = dataclasses.replace(
        part.report, kept=part.report.kept - gone, dropped=(*part.report.dropped, (reason, gone))
    )
    return dataclasses.replace(part, report=report, record_ns=part.record_ns[kept])


def _after(part: Part, reached: dict[str, int]) -> Part:
    """The part of a file after all that earlier dives told of its channels; the rest is counted as dropped."""
    end = max((reached[name] for name in part.log.channels if name in reached), default=None)
    if end is None:
        return part
    if part.log.start_ns - end > FAR:
        note = f"starts {_long(part.log.start_ns - end)} after the end of the files before it; joined all the same"
        part = with_note(part, note)
    if part.log.start_ns > end:
        return part
    part = _keeping(part, part.record_ns > end, "time not after the file before it")
    if not part.report.kept:
        error = "no record kept: the files before it hold all its times"
        part = dataclasses.replace(part, report=dataclasses.replace(part.report, error=error))
    return dataclasses.replace(part, log=part.log.sliced(end + 1, None))


def _interleaved(logs: list[Log]) -> Log | None:
    """One log of the files of a dive; of two samples of a channel at one time the first file's is kept."""
    if len(logs) < 2:
        return logs[0] if logs else None
    channels = {}
    for name in dict.fromkeys(name for log in logs for name in log.channels):
        parts = [log[name] for log in logs if name in log]
        if len(parts) == 1:
            channels[name] = parts[0]
            continue
        time_ns, first = np.unique(np.concatenate([part.time_ns for part in parts]), return_index=True)
        values = np.concatenate([part.values for part in parts])[first]
        channels[name] = Channel(name, time_ns, values, _origin(parts))
    return Log(channels, logs[0].origin, _metadata(logs), _events(logs))


def _one(logs: list[Log]) -> Log:
    """One log of several in time order that share no sample time of a channel; ``logs`` is emptied."""
    if len(logs) == 1:
        return logs[0]
    whole = Log({}, logs[0].origin, _metadata(logs), _events(logs))
    left = [dict(log.channels) for log in logs]
    logs.clear()
    channels = {}
    shared: dict[tuple[int, ...], NDArray[np.int64]] = {}  # channels that share their times go on to do so
    for name in dict.fromkeys(name for log in left for name in log):
        parts = [log.pop(name) for log in left if name in log]
        same = tuple(id(part.time_ns) for part in parts)
        if same not in shared:
            shared[same] = np.concatenate([part.time_ns for part in parts])
        values = np.concatenate([part.values for part in parts])
        channels[name] = Channel(name, shared[same], values, _origin(parts))
    return dataclasses.replace(whole, channels=channels)


def _origin(parts: list[Channel]) -> Origin:
    return "derived" if {part.origin for part in parts} > {"derived"} else parts[0].origin


def _metadata(logs: list[Log]) -> dict[str, str]:
    """The metadata of all; entries that differ stand one after the other, lists of closures as one; provenance is the
    first's."""
    entries: dict[str, list[str]] = {}
    for log in logs:
        for key, value in log.metadata.items():
            entries.setdefault(key, []).append(value)
    one = {key: values[0] for key, values in entries.items()}
    told = {key: " | ".join(dict.fromkeys(values)) for key, values in entries.items() if key != "provenance"}
    if "closures" in entries:
        each = [closure for text in dict.fromkeys(entries["closures"]) for closure in closures_in(text)]
        once = {json.dumps(closure, sort_keys=True): closure for closure in reversed(each)}
        told["closures"] = json.dumps(list(reversed(once.values())))
    return one | told


def _events(logs: list[Log]) -> tuple[Event, ...]:
    """The events of all, each once: two files of a dive may tell the same one."""
    every = dict.fromkeys(event for log in logs for event in log.events)
    return tuple(sorted(every, key=lambda event: event.time_ns))
