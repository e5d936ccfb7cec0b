"""What does a SeaExplorer text file hold? Navigation (gli) and payload (pld) files, sub or raw, gzip or not.

One line is one record. A record is dropped, and counted by its reason, when it cannot be used as a whole; a single cell
outside its range is left out and counted in a warning. 9999, -9999 and blank cells are missing values, as the vehicle
writes them.

Signs and units as brought to channels.py:

    Pitch       nose up positive, as recorded (on dives it is negative).
    LinPos      mm, forward positive: the battery stands further forward on dives. The actuator's own zero is kept.
    AngPos      deg; recorded roll follows it with the same sign. The model's rotation moves the mass to port and gives
                negative roll, so mass_rotation = -AngPos.
    BallastPos  cm3 of oil outside the hull, floating positive.
    Lat, Lon    ddmm.mmm, repeated under water: a fix counts where it changes at the surface (NavState 116).
    Heading     from true north, as recorded; Declination is not added. A file with DeadReckoning = 1 shows in Lat, Lon
                the vehicle's own dead reckoning: in five files of sea063 it runs along Heading to within 0.7 deg,
                where Declination is 6 deg. The fixes of sea035 cannot tell: over five dives the depth-averaged current
                scatters by 0.030 m/s whether its 16 deg are added or not.
    LEGATO_CONDUCTIVITY is in mS/cm, GPCTD_CONDUCTIVITY in S/m.

Practical salinity and density are derived (TEOS-10), where the conductivity cell was surely under water.
"""

from __future__ import annotations

import zlib
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.log import Channel, Log
from glidercli.logio.report import FileReport
from glidercli.units import CM3, DBAR, DEGREE, MILLIMETRE

__all__ = ["is_seaexplorer", "read_seaexplorer"]

Array = NDArray[np.float64]

NAVIGATION, PAYLOAD = "Timestamp", "PLD_REALTIMECLOCK"
AT_SURFACE = 116
SENTINELS = (9999.0, -9999.0)
PIECE = 4096
"""Bytes unpacked at a time, so that what stands before a damage is not lost."""
STRAY = 30 * 86400 * 10**9
"""Times further than this from a file's median come from a clock that was not set, ns."""
SUBMERGED = 0.5
"""Pressure in dbar below which the conductivity cell may be in air."""


class Column(NamedTuple):
    """How a column becomes a channel: value x factor, recorded values from low to high allowed."""

    channel: str
    factor: float
    low: float
    high: float


COLUMNS = {
    "Heading": Column("heading", DEGREE, 0.0, 360.0),
    "Pitch": Column("pitch", DEGREE, -90.0, 90.0),
    "Roll": Column("roll", DEGREE, -180.0, 180.0),
    "Depth": Column("depth", 1.0, -5.0, 1500.0),
    "BallastPos": Column("ballast_volume", CM3, -1000.0, 1000.0),
    "LinPos": Column("mass_position", MILLIMETRE, -200.0, 200.0),
    "AngPos": Column("mass_rotation", -DEGREE, -180.0, 180.0),
    "GPCTD_TEMPERATURE": Column("temperature", 1.0, -3.0, 45.0),
    "GPCTD_CONDUCTIVITY": Column("conductivity", 1.0, 0.0, 7.5),
    "GPCTD_PRESSURE": Column("pressure", DBAR, -2.0, 1500.0),
    "LEGATO_TEMPERATURE": Column("temperature", 1.0, -3.0, 45.0),
    "LEGATO_CONDUCTIVITY": Column("conductivity", 0.1, 0.0, 75.0),
    "LEGATO_PRESSURE": Column("pressure", DBAR, -2.0, 1500.0),
}
_PHASE_OF_STATE = {100: "dive", 117: "climb", 110: "hover", 118: "hover", 115: "surface", 116: "surface"}


def _text(data: bytes) -> tuple[str, bool]:
    """The text, unpacked where it is gzip as far as that goes, and whether it is whole."""
    text, whole = b"", True
    while whole and data[:2] == b"\x1f\x8b":  # members of a gzip file follow one another
        member, at = zlib.decompressobj(wbits=31), 0
        try:
            while at < len(data) and not member.eof:
                text += member.decompress(data[at : at + PIECE])
                at += PIECE
        except zlib.error:
            whole = False
        whole, data = whole and member.eof, member.unused_data + data[at:]
    return (text if text or not whole else data).decode("latin-1"), whole


def is_seaexplorer(path: Path) -> bool:
    """Whether the first line is that of a SeaExplorer file."""
    with path.open("rb") as stream:
        text, _ = _text(stream.read(16 * PIECE))
    first = text.split("\n", 1)[0].lstrip("\ufeff\xef\xbb\xbf ")
    return first.split(";", 1)[0].strip() in (NAVIGATION, PAYLOAD) and ";" in first


def read_seaexplorer(path: Path) -> tuple[Log, FileReport]:
    """One navigation or payload file: its Log, and what was kept and dropped."""
    text, whole = _text(path.read_bytes())
    lines = text.lstrip("\ufeff\xef\xbb\xbf ").splitlines() or [""]
    names = [name.strip() for name in lines[0].split(";")]
    dropped: Counter[str] = Counter()
    rows: list[list[str]] = []
    records = 0
    for line in lines[1:]:
        if not line.strip():
            continue
        records += 1
        cells = [cell.strip() for cell in line.split(";")]
        if len(cells) == len(names) + 1 and names[-1] and not cells[-1]:
            cells.pop()  # lines may end in a semicolon where the header does not; a cut line lacks what the header has
        if len(cells) != len(names):
            dropped["wrong number of fields"] += 1
        else:
            rows.append(cells)
    time_ns = _times([row[0] for row in rows])
    table = {name: _numbers([row[i] for row in rows]) for i, name in enumerate(names) if i > 0 and name}
    good = _usable(time_ns, table, dropped)
    table = {name: values[good] for name, values in table.items()}
    channels, warnings = _channels(time_ns[good], table)
    log = Log({channel.name: channel for channel in channels if len(channel)}, "measured")
    kept = int(np.isin(time_ns[good], np.concatenate([c.time_ns for c in channels] or [time_ns[:0]])).sum())
    if kept < good.sum():
        dropped["no usable value"] += int(good.sum()) - kept
    error = None if whole else "gzip data cut short or damaged: only what could be unpacked was read"
    report = FileReport(path, "seaexplorer", records, kept, tuple(sorted(dropped.items())), tuple(warnings), error)
    return log, report


def _times(texts: list[str]) -> NDArray[np.int64]:
    """Times in UTC ns; the smallest integer where a text is no time."""
    import pandas as pd

    parsed = pd.to_datetime(pd.Series(texts, dtype=object), format="%d/%m/%Y %H:%M:%S.%f", errors="coerce")
    whole = pd.to_datetime(pd.Series(texts, dtype=object), format="%d/%m/%Y %H:%M:%S", errors="coerce")
    return parsed.fillna(whole).to_numpy().astype("datetime64[ns]").astype(np.int64)


def _numbers(texts: list[str]) -> Array:
    """Numbers; NaN where a cell is blank, a sentinel or no number."""
    import pandas as pd

    values = pd.to_numeric(pd.Series(texts, dtype=object), errors="coerce").to_numpy(dtype=float, copy=True)
    values[np.isin(values, SENTINELS) | ~np.isfinite(values)] = np.nan
    return values


def _usable(time_ns: NDArray[np.int64], table: dict[str, Array], dropped: Counter[str]) -> NDArray[np.bool_]:
    """Which records can be used; the others are counted by their reason."""
    good: NDArray[np.bool_] = time_ns != np.iinfo(np.int64).min
    dropped["time cannot be read"] += int((~good).sum())
    if good.any():
        stray = good & (np.abs(time_ns - np.median(time_ns[good])) > STRAY)
        dropped["clock not set: more than 30 days from the file's median time"] += int(stray.sum())
        good &= ~stray
    numbers = np.array(list(table.values())) if table else np.empty((0, len(time_ns)))
    blank = good & np.isnan(numbers).all(axis=0)
    zero = good & ~blank & (np.nan_to_num(numbers) == 0.0).all(axis=0)
    dropped["no value"] += int(blank.sum())
    dropped["all values zero"] += int(zero.sum())
    good &= ~(blank | zero)
    latest = np.iinfo(np.int64).min
    for i in np.flatnonzero(good):
        if time_ns[i] <= latest:
            dropped["time repeats" if time_ns[i] == latest else "time goes back"] += 1
            good[i] = False
        latest = max(latest, int(time_ns[i]))
    for reason in [reason for reason, count in dropped.items() if count == 0]:
        del dropped[reason]
    return good


def _channels(time_ns: NDArray[np.int64], table: dict[str, Array]) -> tuple[list[Channel], list[str]]:
    """The channels of a table, and a warning for each kind of cell left out."""
    channels: list[Channel] = []
    warnings: list[str] = []
    for name, column in COLUMNS.items():
        if name not in table:
            continue
        values = table[name]
        given = np.isfinite(values)
        inside = given & (values >= column.low) & (values <= column.high)
        if (given & ~inside).any():
            warnings.append(
                f"{name}: {int((given & ~inside).sum())} values outside {column.low:g}..{column.high:g} left out"
            )
        if inside.any():
            channels.append(Channel(column.channel, time_ns[inside], values[inside] * column.factor))
    if "NavState" in table:
        channels += _navigation(time_ns, table, warnings)
    by_name = {channel.name: channel for channel in channels}
    if {"temperature", "conductivity", "pressure"} <= by_name.keys():
        channels = _submerged(channels, by_name["pressure"], warnings)
    return channels, warnings


def _navigation(time_ns: NDArray[np.int64], table: dict[str, Array], warnings: list[str]) -> list[Channel]:
    """Phase from the navigation state, and genuine GPS fixes."""
    found = []
    state = table["NavState"]
    phase = np.array([PHASES.index(_PHASE_OF_STATE[int(s)]) if s in _PHASE_OF_STATE else np.nan for s in state])
    known = np.isfinite(phase)
    if known.any():
        found.append(Channel("phase", time_ns[known], phase[known], "derived"))
    if {"Lat", "Lon"} <= table.keys():
        latitude, longitude = (_degrees(table[name]) for name in ("Lat", "Lon"))
        changed = np.zeros(len(time_ns), dtype=bool)
        changed[1:] = (np.diff(latitude) != 0.0) | (np.diff(longitude) != 0.0)
        fix = changed & (state == AT_SURFACE) & (np.abs(latitude) <= 90.0) & (np.abs(longitude) <= 180.0)
        repeated = int((np.isfinite(latitude) & ~fix).sum())
        if repeated:
            warnings.append(
                f"Lat, Lon: {repeated} values left out that are no new fix at the surface, {int(fix.sum())} kept"
            )
        if fix.any():
            found += [
                Channel("latitude", time_ns[fix], latitude[fix]),
                Channel("longitude", time_ns[fix], longitude[fix]),
            ]
    return found


def _degrees(value: Array) -> Array:
    """Degrees from ddmm.mmm, signed."""
    whole = np.floor(np.abs(value) / 100.0)
    return np.sign(value) * (whole + (np.abs(value) - 100.0 * whole) / 60.0)


def _submerged(channels: list[Channel], pressure: Channel, warnings: list[str]) -> list[Channel]:
    """The channels with conductivity kept only where the cell was surely under water."""
    wet = pressure.time_ns[pressure.values >= SUBMERGED * DBAR]
    kept = []
    for channel in channels:
        if channel.name == "conductivity":
            under = np.isin(channel.time_ns, wet)
            if not under.all():
                warnings.append(
                    f"conductivity: {int((~under).sum())} values at less than {SUBMERGED:g} dbar left out: "
                    "the cell may be in air"
                )
            channel = Channel("conductivity", channel.time_ns[under], channel.values[under])
        if len(channel):
            kept.append(channel)
    return kept
