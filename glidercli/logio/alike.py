"""Can files be one flight? Of one origin, one vehicle and one place, and at one depth at one time.

Which vehicle it was tells the header of a file or its name (metadata ``platform``). Two that differ are refused. A file
that tells none may be of any vehicle: beside files that tell one it says so, and it is refused where it was at another
depth than they at the same time.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.logio.reader import Part
from glidercli.units import DBAR
from glidercli.utc import to_second

__all__ = ["alike", "vehicle_of", "with_note"]

PLACE = ("origin_latitude_deg", "origin_longitude_deg")
BESIDE = 60 * 10**9
"""Samples of two files that are closer in time than this tell of one vehicle or of two, ns."""
AGREE, OF_DEPTH, FASTEST = 10.0, 0.05, 1.0
"""m, part of the depth, m/s: by so much may depths of one vehicle by two gauges differ (1 m to a dbar is up to 3 % too
much), and by so much for each second between the samples: no glider is as fast up and down."""
LEAST = 3
"""So many depths that contradict are no garbled cells."""


def alike(parts: list[Part]) -> list[Part]:
    """The parts, in their order; those that tell no vehicle, beside others that do, with a note.

    Raises InputError where origins, vehicles or the places of tracks differ, and where one that tells no vehicle was at
    another depth than others at the same time. Each is set against the earliest that tells.
    """
    ordered = sorted(parts, key=lambda part: part.log.start_ns)
    first, known = ordered[0], next(filter(vehicle_of, ordered), None)
    placed = next((part for part in ordered if "north" in part.log), None)
    for part in ordered:
        path = part.report.path
        if part.log.origin != first.log.origin:
            raise InputError(
                path, f"is {part.log.origin}, {first.report.path} is {first.log.origin}; read them one by one"
            )
        if known and vehicle_of(part) and vehicle_of(part) != vehicle_of(known):
            raise InputError(
                path, f"is of {vehicle_of(part)}, {known.report.path} of {vehicle_of(known)}; read them one by one"
            )
        if placed and "north" in part.log and _place(placed.log) != _place(part.log):
            raise InputError(path, "has a track about another origin than the files before; read it by itself")
    if all(map(vehicle_of, parts)) or len(parts) < 2:
        return parts
    _check_depths(ordered)
    if known is None:
        return parts
    note = f"tells no vehicle, in its name or inside; joined with files of {vehicle_of(known)}"
    return [part if vehicle_of(part) else with_note(part, note) for part in parts]


def with_note(part: Part, note: str) -> Part:
    """A part whose account says one thing more."""
    report = dataclasses.replace(part.report, warnings=(*part.report.warnings, note))
    return dataclasses.replace(part, report=report)


def vehicle_of(part: Part) -> str:
    """The vehicle that a file tells, or ""."""
    return part.log.metadata.get("platform", "")


def _place(log: Log) -> list[str | None]:
    return [log.metadata.get(key) for key in PLACE]


def _check_depths(ordered: list[Part]) -> None:
    """Refuse a file that tells no vehicle and was elsewhere in depth than others; ``ordered`` by their first time."""
    spans = _together((part.log.start_ns, part.log.end_ns) for part in ordered if not vehicle_of(part))
    times, depths, files = [], [], []
    for number, part in enumerate(ordered):
        near = np.searchsorted(spans[:, 1], part.log.start_ns)
        if near == len(spans) or part.log.end_ns < spans[near, 0]:
            continue
        time_ns, depth = _depth(part.log)
        times.append(time_ns)
        depths.append(depth)
        files.append(np.full(len(time_ns), number))
    time_ns, depth, file = (np.concatenate(of or [np.array([])]) for of in (times, depths, files))
    order = np.argsort(time_ns, kind="stable")
    time_ns, depth, file = time_ns[order], depth[order], file[order].astype(np.int64)
    nameless = np.array([not vehicle_of(part) for part in ordered])
    gap = np.diff(time_ns)
    pair = np.flatnonzero((file[1:] != file[:-1]) & (nameless[file[1:]] | nameless[file[:-1]]) & (gap <= BESIDE))
    apart = np.abs(depth[pair + 1] - depth[pair])
    allowed = AGREE + OF_DEPTH * np.abs(depth[pair]) + FASTEST * gap[pair] * 1e-9
    against = apart > allowed
    both = np.concatenate([file[pair], file[pair + 1]])
    compared = np.bincount(both, minlength=len(ordered))
    wrong = np.bincount(both[np.tile(against, 2)], minlength=len(ordered))
    for number in np.flatnonzero(nameless & (wrong >= LEAST) & (wrong > 0.5 * compared)).tolist():
        at = int(pair[against & ((file[pair] == number) | (file[pair + 1] == number))][0])
        one, other = (at, at + 1) if file[at] == number else (at + 1, at)
        beside = ordered[file[other]]
        raise InputError(
            ordered[number].report.path,
            f"tells no vehicle, and at {to_second(time_ns[one])} it was at {depth[one]:.0f} m where "
            f"{beside.report.path} was at {depth[other]:.0f} m: of two vehicles, "
            "or a clock is wrong; read them one by one",
        )


def _together(spans: Iterable[tuple[int, int]]) -> NDArray[np.int64]:
    """Spans of time as few that do not meet, in time order, (n, 2), ns; those given in the order of their begins."""
    found: list[list[int]] = []
    for start, end in spans:
        if found and start <= found[-1][1]:
            found[-1][1] = max(found[-1][1], end)
        else:
            found.append([start, end])
    return np.array(found, np.int64).reshape(-1, 2)


def _depth(log: Log) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Times and depths, m: as recorded, or 1 m to a dbar of pressure, which is 1 to 3 % too much."""
    if "depth" in log:
        return log["depth"].time_ns, log["depth"].values
    if "pressure" in log:
        return log["pressure"].time_ns, log["pressure"].values / DBAR
    return np.array([], np.int64), np.array([])
