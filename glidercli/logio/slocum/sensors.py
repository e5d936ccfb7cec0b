"""What did any one sensor of a Slocum file record? Every sample by name, with its time, as the file has it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.gzipped import unpacked as gunzipped
from glidercli.logio.slocum.caches import cached_list
from glidercli.logio.slocum.cycles import Cycles, Samples
from glidercli.logio.slocum.header import header_of
from glidercli.logio.slocum.packing import LABEL, is_packed, unpacked
from glidercli.logio.slocum.scanning import scan

__all__ = ["CLOCKS", "clock_of", "cycles_of", "sensors", "times_of"]

CLOCKS = ("m_present_time", "sci_m_present_time")
"""Sensors that tell a cycle's time, s since 1970: the navigation's, the science computer's; the first that is there."""


def cycles_of(path: Path, cache: Path | None = None) -> tuple[Cycles, str | None, tuple[Path, ...]]:
    """The cycles of a file; where its compressed data are damaged, or None; and the cache that was used, if any."""
    data, whole = gunzipped(path, readable_file(path).read_bytes())
    damage = None if whole else "gzip data cut short or damaged: only what could be unpacked was read"
    if is_packed(data[:16], LABEL):
        data, at = unpacked(data)
        if at is not None:
            damage = f"compressed data cut short or damaged at byte {at} of the file: only what stands before was read"
    used: list[Path] = []

    def listed(crc: str) -> bytes:
        text, file = cached_list(path, crc, cache)
        used.append(file)
        return text

    header = header_of(path, data, listed)
    return scan(header, data), damage, tuple(used)


def clock_of(path: Path, cycles: Cycles) -> int:
    """The place of the sensor that tells the time of a cycle. Raises InputError where there is none."""
    places = cycles.header.listed.places
    clock = next((places[name] for name in CLOCKS if name in places), None)
    if clock is None:
        raise InputError(path, f"none of its {len(places)} sensors tells the time; {' or '.join(CLOCKS)} is needed")
    return clock


def times_of(clock: Samples, count: int) -> NDArray[np.float64]:
    """The time of each of ``count`` cycles, (count,), s since 1970; NaN where none is known."""
    time_s = np.full(count, np.nan)
    time_s[clock.rows] = clock.values
    return time_s


def sensors(
    path: str | Path, names: Iterable[str] | None = None, cache: str | Path | None = None
) -> dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Times (s since 1970) and values of sensors by name, in the file's own units; None asks for all of them.

    A sample is a cycle that says updated, with a new or the same value, at the cycle's time. The first cycle, which
    tells every sensor's last value, however old, is left out, and so are samples without a number (NaN).
    cache : folder of caches, asked after those beside the file. Raises InputError for a file that cannot be read and
    for a sensor that it does not have.
    """
    path = Path(path)
    cycles, _, _ = cycles_of(path, None if cache is None else Path(cache))
    places = cycles.header.listed.places
    wanted = list(places if names is None else names)
    for name in wanted:
        if name not in places:
            raise InputError(path, f"has no sensor {name}; it has {len(places)}, such as {', '.join(list(places)[:3])}")
    told = cycles.samples([clock_of(path, cycles), *(places[name] for name in wanted)])
    time_s = times_of(next(told), len(cycles))
    found = {}
    for name, (rows, _, values) in zip(wanted, told, strict=True):
        good = (rows >= cycles.stale) & ~np.isnan(values)
        found[name] = time_s[rows[good]], values[good]
    return found
