"""What does a .eng hold? Rows of depth, attitude and controls, at seconds since the start of the dive."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.log import Event
from glidercli.logio.quantities import channel_of
from glidercli.logio.reader import Part
from glidercli.logio.records import NO_TIME
from glidercli.logio.seaglider.actuators import clear_of_motors
from glidercli.logio.seaglider.columns import DEPTH_CM, ENGINEERING, cells, engineering
from glidercli.logio.seaglider.gathering import Gathering
from glidercli.logio.seaglider.log_text import declination_of, read_log
from glidercli.logio.seaglider.text_file import is_text, read_text

__all__ = ["read_eng"]

TIME = "elaps_t"
COLUMNS = ("depth", "head", *ENGINEERING)
LONGEST = 1e8
"""s; times further from the start of the dive than three years are no times."""


def read_eng(path: Path, data: bytes) -> Part:
    """The Part of a .eng; where the .log of the dive stands beside it, that tells true heading and motor runs."""
    text = read_text(path, data)
    names = [name.strip() for name in text.header.get("columns", "").split(",")]
    if TIME not in names:
        raise InputError(path, f"is damaged: its %columns have no {TIME}")
    gathering = Gathering(text.start_ns, metadata=text.about)
    split = [line.split() for line in text.lines]
    rows = [row for row in split if len(row) == len(names)]
    gathering.records += len(split) - len(rows)
    gathering.drop("", "wrong number of fields", len(split) - len(rows))
    used = (TIME, *COLUMNS)
    table = {name: _numbers([row[i] for row in rows]) for i, name in enumerate(names) if name in used}
    gathering.unread += [
        name for i, name in enumerate(names) if name not in used and any(row[i].lower() != "nan" for row in rows)
    ]
    elapsed = table.pop(TIME)
    sane = np.abs(elapsed) < LONGEST
    since = np.where(sane, np.round(np.where(sane, elapsed, 0.0) * 1e6), 0.0).astype(np.int64) * 1000
    time_ns = np.where(sane, text.start_ns + since, NO_TIME)
    table = cells({name: name for name in table}, table, gathering.warnings)
    good = gathering.usable("", time_ns, table)
    time_ns, table = time_ns[good], {name: values[good] for name, values in table.items()}
    declination, events = _beside(path)
    if declination is not None or events:
        gathering.beside.append(_log_of(path))
    channels = engineering(time_ns, table, {name: name for name in table}, declination, gathering.warnings)
    channels = clear_of_motors(channels, events, gathering.warnings)
    if "depth" in table:
        channels.append(channel_of("depth", time_ns, table["depth"], DEPTH_CM, gathering.warnings))
    if declination is not None:
        gathering.metadata["heading_note"] = (
            f"true: the recorded magnetic heading plus {declination:g} deg of magnetic variation (east), from the .log"
        )
    gathering.metadata["depth_note"] = "depth as the vehicle reckoned it, not corrected for latitude as that of a .nc"
    gathering.keep_rows("", time_ns, channels)
    return gathering.part(path, text.dive, ("eng",))


def _beside(path: Path) -> tuple[float | None, tuple[Event, ...]]:
    """Magnetic variation, deg, or None, and events of the .log of the same name, if it is there and can be read."""
    beside = _log_of(path)
    try:
        data = beside.read_bytes()
        if not is_text(data):
            return None, ()
        return declination_of(read_text(beside, data).lines), read_log(beside, data).log.events
    except (OSError, InputError):
        return None, ()


def _log_of(path: Path) -> Path:
    return path.with_suffix(".log")


def _numbers(texts: list[str]) -> NDArray[np.float64]:
    """Numbers; NaN where a cell says nan, infinite where it is no number."""
    import pandas as pd

    values = pd.to_numeric(pd.Series(texts, dtype=object), errors="coerce").to_numpy(dtype=float, copy=True)
    told = np.array([text.lower() != "nan" for text in texts], dtype=bool)
    values[told & np.isnan(values)] = np.inf
    return values
