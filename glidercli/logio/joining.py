"""When do several files make one log? In time order, no record twice, nothing of another origin among them."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.logio.report import FileReport

__all__ = ["joined"]

FAR = 86400 * 10**9
"""Files further apart in time than this are joined, and it is said, ns."""
PLACE = ("origin_latitude_deg", "origin_longitude_deg")

Read = tuple[Log, FileReport]


def joined(parts: list[Read]) -> tuple[Log, list[FileReport]]:
    """One Log of the logs of several files, and their reports with what joining dropped.

    A file's records must come after all earlier ones of the channels that it shares: others are dropped and counted.
    Navigation and payload share none. Raises InputError where origins, vehicles or the places of tracks differ.
    """
    ordered = sorted(parts, key=lambda part: part[0].start_ns)
    first, source = ordered[0]
    kept: list[Log] = []
    reports = {}
    reached: dict[str, int] = {}
    for log, report in ordered:
        if log.origin != first.origin:
            raise InputError(report.path, f"is {log.origin}, {source.path} is {first.origin}; read them one by one")
        platforms = [item.metadata.get("platform", "") for item in (first, log)]
        if all(platforms) and platforms[0] != platforms[1]:
            raise InputError(
                report.path, f"is of {platforms[1]}, {source.path} of {platforms[0]}; read them one by one"
            )
        if any("north" in other and "north" in log and _place(other) != _place(log) for other in kept):
            raise InputError(report.path, "has a track about another origin than the files before; read it by itself")
        end = max((reached[name] for name in log.channels if name in reached), default=None)
        if end is not None:
            if log.start_ns - end > FAR:
                days = (log.start_ns - end) / FAR
                note = f"starts {days:.1f} days after the file before it; joined all the same"
                report = dataclasses.replace(report, warnings=(*report.warnings, note))
            log, report = _after(log, report, end)
        reached |= {name: int(channel.time_ns[-1]) for name, channel in log.channels.items()}
        kept.append(log)
        reports[id(report.path)] = report
    return _one(kept), [reports[id(report.path)] for _, report in parts]


def _place(log: Log) -> list[str | None]:
    return [log.metadata.get(key) for key in PLACE]


def _records(log: Log) -> NDArray[np.int64]:
    """Times of the records that gave the log."""
    return np.unique(np.concatenate([channel.time_ns for channel in log.channels.values()]))


def _after(log: Log, report: FileReport, end_ns: int) -> Read:
    """The part of a file after ``end_ns``, the rest counted as dropped."""
    over = int((_records(log) <= end_ns).sum())
    if not over:
        return log, report
    dropped = (*report.dropped, ("time not after the file before it", over))
    report = dataclasses.replace(report, kept=report.kept - over, dropped=dropped)
    if not report.kept:
        report = dataclasses.replace(report, error="no record kept: the files before it hold all its times")
    return log.sliced(end_ns + 1, None), report


def _one(logs: list[Log]) -> Log:
    """One log of several in time order that share no sample time of a channel."""
    channels = {}
    for name in dict.fromkeys(name for log in logs for name in log.channels):
        parts = [log[name] for log in logs if name in log]
        time_ns, values = (np.concatenate([getattr(p, field) for p in parts]) for field in ("time_ns", "values"))
        origins = {part.origin for part in parts}
        channels[name] = Channel(name, time_ns, values, "derived" if origins > {"derived"} else parts[0].origin)
    metadata: dict[str, str] = {}
    for log in logs:
        for key, value in log.metadata.items():
            if key not in metadata:
                metadata[key] = value
            elif key != "provenance" and value not in metadata[key].split(" | "):
                metadata[key] += f" | {value}"
    events = tuple(sorted((e for log in logs for e in log.events), key=lambda event: event.time_ns))
    return Log(channels, logs[0].origin, metadata, events)
