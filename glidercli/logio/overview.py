"""What does a recording hold? Its span, each channel's sampling and gaps, its dives, and what is missing of it."""

from __future__ import annotations

import dataclasses
import itertools
import re
from typing import Any

import numpy as np

from glidercli.channels import CHANNELS
from glidercli.dives import LEAST_GAP, cuts, long_gaps, phases
from glidercli.log import Channel, Log
from glidercli.logio.derived.closure import closures_in
from glidercli.logio.reading import Reading
from glidercli.logio.report import FileReport
from glidercli.residuals import usual_gap
from glidercli.utc import iso

__all__ = ["Overview", "Sampling", "Yo", "overview"]

FAR = 86400 * 10**9
"""ns; files further apart than this may not belong together."""
FEW = 5
"""Names that a line tells."""
USUAL = (
    "depth", "pitch", "roll", "heading", "latitude", "temperature", "salinity", "mass_position", "ballast_volume",
)  # fmt: skip
"""Channels that a glider usually records; without one of them something cannot be done."""
INSTEAD = {"ballast_volume": ("net_buoyancy",), "salinity": ("conductivity", "absolute_salinity")}


@dataclasses.dataclass(frozen=True)
class Sampling:
    """How a channel is sampled.

    interval : usual time between samples, s (median), None of a single one. gaps : longer ones, see usual_gap.
    longest : the longest time between samples, s, and after_ns : the sample before it.
    """

    channel: Channel
    interval: float | None
    gaps: int
    longest: float | None
    after_ns: int | None

    def document(self) -> dict[str, Any]:
        """As JSON."""
        spec, values = CHANNELS[self.channel.name], self.channel.values
        ordered = self.channel.name != "phase"  # its codes stand for words
        return {
            "name": spec.column,
            "unit": spec.column_unit,
            "origin": self.channel.origin,
            "samples": len(self.channel),
            "first": iso(self.channel.time_ns[0]),
            "last": iso(self.channel.time_ns[-1]),
            "interval_s": self.interval,
            "gaps": self.gaps,
            "longest_gap_s": self.longest,
            "longest_gap_after": None if self.after_ns is None else iso(self.after_ns),
            "minimum": float(values.min()) * spec.factor + 0.0 if ordered else None,  # no -0.0
            "maximum": float(values.max()) * spec.factor + 0.0 if ordered else None,
        }


@dataclasses.dataclass(frozen=True)
class Yo:
    """A dive and the climb after it; times UTC ns, depth m.

    gap : the longest time within it without a sample of depth, s, where that is a long gap; else None.
    """

    start_ns: int
    end_ns: int
    deepest: float
    gap: float | None

    def document(self) -> dict[str, Any]:
        """As JSON."""
        return {
            "start": iso(self.start_ns),
            "end": iso(self.end_ns),
            "duration_s": (self.end_ns - self.start_ns) * 1e-9,
            "deepest_m": self.deepest,
            "gap_s": self.gap,
        }


@dataclasses.dataclass(frozen=True)
class Overview:
    """What a recording holds.

    missing : what one would look for and not find, a line each. unread : columns with data that are not read.
    silence : begin and end of the longest time without a sample of any channel, UTC ns, if it is more than a day.
    passed_over : files that were not looked at, a line each.
    """

    log: Log
    files: tuple[FileReport, ...]
    channels: tuple[Sampling, ...]
    dives: tuple[Yo, ...]
    missing: tuple[str, ...]
    unread: tuple[str, ...]
    silence: tuple[int, int] | None
    passed_over: tuple[str, ...] = ()

    def document(self) -> dict[str, Any]:
        """As JSON."""
        provenance = {"provenance"}
        return {
            "kind": self.log.kind,
            "platform": self.log.metadata.get("platform") or self.log.metadata.get("vehicle"),
            "instruments": self.log.metadata.get("instruments"),
            "start": iso(self.log.start_ns),
            "end": iso(self.log.end_ns),
            "duration_s": (self.log.end_ns - self.log.start_ns) * 1e-9,
            "silence": None
            if self.silence is None
            else dict(zip(("start", "end"), map(iso, self.silence), strict=True)),
            "files": [report.document() for report in self.files],
            "channels": [channel.document() for channel in self.channels],
            "dives": [dive.document() for dive in self.dives],
            "closures": closures_in(self.log.metadata.get("closures", "[]")),
            "events": [{"name": e.name, "time": iso(e.time_ns), "depth_m": e.depth} for e in self.log.events],
            "missing": list(self.missing),
            "not_read": list(self.unread),
            "passed_over": list(self.passed_over),
            "metadata": {key: text for key, text in self.log.metadata.items() if key not in provenance},
        }


def overview(reading: Reading) -> Overview:
    """What a reading holds."""
    log = reading.log
    channels = tuple(_sampling(channel) for channel in log.channels.values() if len(channel))
    return Overview(
        log,
        reading.files,
        channels,
        _dives(log),
        tuple(_missing(reading)),
        reading.unread,
        _silence(log),
        reading.passed_over,
    )


def _sampling(channel: Channel) -> Sampling:
    steps = np.diff(channel.time_ns) * 1e-9
    if not len(steps):
        return Sampling(channel, None, 0, None, None)
    usual = float(np.median(steps))
    widest = int(steps.argmax())
    gaps = int((steps > usual_gap(channel)).sum())
    return Sampling(channel, usual, gaps, float(steps[widest]), int(channel.time_ns[widest]))


def _dives(log: Log) -> tuple[Yo, ...]:
    """Each descent with the ascent that follows it, or without one where none does before the next cut."""
    if "depth" not in log:
        return ()
    found: list[Yo] = []
    legs = phases(log)
    apart = cuts(log)[:, 0]
    gaps = long_gaps(log["depth"].time_ns)
    for leg, after in itertools.zip_longest(legs, legs[1:]):
        if leg.name != "dive":
            continue
        near = after is not None and np.searchsorted(apart, leg.start_ns) == np.searchsorted(apart, after.start_ns)
        end_ns = after.end_ns if near and after.name == "climb" else leg.end_ns
        depth = log["depth"].sliced(leg.start_ns, end_ns).values
        if len(depth):
            first, last = np.searchsorted(gaps[:, 1], [leg.start_ns, end_ns])
            inside = np.diff(np.clip(gaps[first : last + 1], leg.start_ns, end_ns)) * 1e-9
            longest = float(inside.max(initial=0.0))
            found.append(Yo(leg.start_ns, end_ns, float(depth.max()), longest if longest > LEAST_GAP else None))
    return tuple(found)


def _missing(reading: Reading) -> list[str]:
    """Files that belong to what was read and are not there; usual channels without a sample."""
    lines = [f"{report.path.name}: {report.error}" for report in reading.files if report.error]
    if reading.nameless:
        lines.append(f"the vehicle of {_first_of(reading.nameless)}, joined with {reading.log.metadata['platform']}")
    lines += [f"{name}, which goes with {beside}, is not among the files" for name, beside in reading.partners]
    numbers: dict[str, set[int]] = {}
    for dive in reading.dives:
        if match := re.fullmatch(r"(.*?)(\d+)", dive):
            numbers.setdefault(match[1], set()).add(int(match[2]))
    for series, known in numbers.items():
        if gaps := _gaps(known):
            lines.append(f"dives {gaps} of {series.rstrip('.- ')} are not among the files")
    for name in USUAL:
        if not any(len(reading.log.channels.get(other, ())) for other in (name, *INSTEAD.get(name, ()))):
            lines.append(f"no {name.replace('_', ' ')}")
    return lines


def _first_of(names: tuple[str, ...]) -> str:
    """Names, or the first of many."""
    return ", ".join(names) if len(names) <= FEW else f"{names[0]} and {len(names) - 1} more files"


def _silence(log: Log) -> tuple[int, int] | None:
    """The longest time of more than a day without a sample of any channel, UTC ns; None where there is none."""
    runs: list[tuple[int, int]] = []  # of each channel, those that lie more than a day apart
    for time_ns in {id(channel.time_ns): channel.time_ns for channel in log.channels.values()}.values():
        bounds = np.concatenate([[0], np.flatnonzero(np.diff(time_ns) > FAR) + 1, [len(time_ns)]])
        runs += [(int(time_ns[i]), int(time_ns[j - 1])) for i, j in itertools.pairwise(bounds) if j > i]
    silence, reached = (0, 0), None
    for start, end in sorted(runs):
        if reached is not None and start - reached > max(FAR, silence[1] - silence[0]):
            silence = (reached, start)
        reached = end if reached is None else max(reached, end)
    return silence if silence[1] > silence[0] else None


def _gaps(numbers: set[int]) -> str:
    """What lies between numbers: of 1, 5, 7 "2-4, 6"."""
    runs = [(one + 1, other - 1) for one, other in itertools.pairwise(sorted(numbers)) if other - one > 1]
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)
