"""What does a Slocum file give? Navigation (dbd, mbd, sbd) or science (ebd, nbd, tbd), compressed (dcd ...) or not.

A record is one data cycle. The first cycle of a file tells every sensor's last value, however old, and is dropped; so
is, by a named reason, each cycle that cannot be used: damaged ones, and those whose times cannot be read, repeat, go
back or come from a clock that was not set. Single samples that cannot be used are counted in warnings (channels.py,
where units and signs stand too). Cycles in a damaged stretch cannot be counted: it is one record (scanning.py).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from glidercli.errors import InputError
from glidercli.gzipped import beginning
from glidercli.log import Log
from glidercli.logio.reader import Aids, Part
from glidercli.logio.records import NO_TIME, sampled, usable
from glidercli.logio.report import FileReport
from glidercli.logio.slocum.channels import AT_REST, RECEIVER, RELAYED, USED, Column, channels_of
from glidercli.logio.slocum.cycles import Cycles, Samples
from glidercli.logio.slocum.packing import LABEL, is_packed
from glidercli.logio.slocum.sensors import CLOCKS, clock_of, cycles_of, times_of

__all__ = ["is_slocum", "read_slocum"]

NAVIGATION, SCIENCE = "navigation", "science"
KINDS = {
    "dbd": (NAVIGATION, 3), "mbd": (NAVIGATION, 2), "sbd": (NAVIGATION, 1),
    "ebd": (SCIENCE, 3), "nbd": (SCIENCE, 2), "tbd": (SCIENCE, 1),
}  # fmt: skip
"""Computer and fullness by the ending that the header names, compressed or not."""
BORN = 978307200.0
"""2001-01-01, s since 1970: the year of the format; an earlier time is of a clock that was not set."""
LATEST = 9e9
"""s since 1970, in the year 2255: a later time is none, and would not fit in ns."""
FIRST = "first cycle: the last values of all sensors, however old"
UNSET = "clock not set: before 2001, when the format began"


def is_slocum(path: Path) -> bool:
    """Whether a file begins as a Slocum's does, compressed or not."""
    with path.open("rb") as stream:
        head = beginning(stream.read(4096), 16)
    return head.startswith(LABEL) or is_packed(head, LABEL)


def read_slocum(path: Path, aids: Aids = Aids()) -> Part:
    """One file; raises InputError where nothing of it can be read, such as for want of its cache."""
    cycles, damage, caches = cycles_of(path, aids.cache)
    tags = cycles.header.tags
    kind, fullness = KINDS.get(tags["filename_extension"].lower(), ("", 0))
    if not kind:
        raise InputError(
            path, f"header: filename_extension is {tags['filename_extension']}; {', '.join(KINDS)} are read"
        )
    dropped = Counter(cycles.torn)
    places = {name: place for name, place in cycles.header.listed.places.items() if name in USED}
    samples = cycles.samples([clock_of(path, cycles), *places.values()])
    seconds = times_of(next(samples), len(cycles))
    first = np.arange(len(cycles)) < cycles.stale
    unset = ~first & (seconds < BORN)
    for reason, which in ((FIRST, first), (UNSET, unset)):
        if which.any():
            dropped[reason] += int(which.sum())
    good = ~(first | unset)
    known = np.isfinite(seconds) & (np.abs(seconds) <= LATEST)
    time_ns = np.where(known, np.rint(np.where(known, seconds, 0.0) * 1e9), NO_TIME).astype(np.int64)
    columns, repeated = _columns(cycles, zip(places, samples, strict=True))
    cells = {name: c.sampled[good] for name, c in columns.items() if name not in RECEIVER}
    good[good] = usable(time_ns[good], cells, dropped, AT_REST)
    kept_columns = {name: Column(c.sampled[good], c.fresh[good], c.latest[good]) for name, c in columns.items()}
    channels, notes, warnings = channels_of(time_ns[good], kept_columns)
    kept = sampled(time_ns[good], {channel.name: channel for channel in channels})
    if not kept.all():
        dropped["no usable value"] += int((~kept).sum())
    if repeated:
        warnings.insert(0, f"{repeated} unchanged values left out where the file tells every sensor anew: no samples")
    if cycles.remark:
        warnings.insert(0, cycles.remark)
    report = FileReport(
        path, "slocum", len(cycles) + sum(cycles.torn.values()), int(kept.sum()), tuple(sorted(dropped.items())),
        tuple(warnings), "; ".join(text for text in (damage, cycles.error) if text) or None, caches,
    )  # fmt: skip
    recording = tags["full_filename"].lower()
    platform = f"Slocum {recording.rsplit('-', 4)[0]}"  # name-year-day-mission-segment
    told = {"platform": platform, "title": f"{platform} log", "mission": tags.get("mission_name", "")} | notes
    return Part(
        Log(
            {channel.name: channel for channel in channels},
            "measured",
            {key: text for key, text in told.items() if text},
        ),
        report,
        time_ns[good][kept],
        dive=recording,
        holds=(f"{recording} {kind}",),
        fullness=fullness,
        yields=RELAYED if kind == NAVIGATION else frozenset(),
        partner=f"{recording} {SCIENCE if kind == NAVIGATION else NAVIGATION}",
        unread=tuple(name for name in cycles.told() if name not in (*USED, *CLOCKS)),
    )


def _columns(cycles: Cycles, told: Iterable[tuple[str, Samples]]) -> tuple[dict[str, Column], int]:
    """The sensors that a log needs, by name, and how many unchanged values of dumps are left out."""
    columns, repeated = {}, 0
    for name, samples in told:
        rows, new, values = samples
        good = new | ~cycles.dump[rows]
        repeated += int((~good).sum())
        sampled, fresh = np.full(len(cycles), np.nan), np.zeros(len(cycles), dtype=bool)
        sampled[rows[good]] = np.where(np.isnan(values), np.inf, values)[good]
        fresh[rows[new]] = True
        latest = samples.latest(len(cycles))
        if name in RECEIVER and cycles.resumed is not None:
            behind = np.append(rows[rows >= cycles.resumed], len(cycles))[0]
            latest[cycles.resumed : behind] = np.nan  # it may have changed in what is damaged
        columns[name] = Column(sampled, fresh, latest)
    return columns, repeated
