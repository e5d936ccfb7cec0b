"""What does a .eng hold? Rows of depth, attitude and controls, at seconds since the start of the dive."""

from __future__ import annotations

from pathlib import Path

from glidercli.errors import InputError
from glidercli.gzipped import DAMAGED, unpacked
from glidercli.log import Log
from glidercli.logio.cut_text import CUT
from glidercli.logio.number_cells import numbers
from glidercli.logio.quantities import channel_of
from glidercli.logio.reader import Part
from glidercli.logio.seaglider.actuators import clear_of_motors
from glidercli.logio.seaglider.columns import DEPTH_CM, ENGINEERING, cells, engineering
from glidercli.logio.seaglider.dive_start import other_start
from glidercli.logio.seaglider.gathering import Dive, Gathering
from glidercli.logio.seaglider.log_text import declination_of, read_log
from glidercli.logio.seaglider.states import held
from glidercli.logio.seaglider.text_file import is_text, read_text, since

__all__ = ["read_eng"]

TIME = "elaps_t"
COLUMNS = ("depth", "head", *ENGINEERING)
BESIDE = (".log", ".LOG", ".log.gz")
"""Endings of the .log of a dive."""


def read_eng(path: Path, data: bytes) -> Part:
    """The Part of a .eng; where the .log of the dive is beside it, that tells true heading, states and motor runs."""
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
    table = {name: numbers([row[i] for row in rows]) for i, name in enumerate(names) if name in used}
    gathering.unread += [
        name for i, name in enumerate(names) if name not in used and any(row[i].lower() != "nan" for row in rows)
    ]
    time_ns = since(text.start_ns, table.pop(TIME))
    table = cells({name: name for name in table}, table, gathering.warnings)
    good = gathering.usable("", time_ns, table)
    time_ns, table = time_ns[good], {name: values[good] for name, values in table.items()}
    declination, log = _beside(path, text.dive, text.start_ns, gathering)
    channels = engineering(time_ns, table, {name: name for name in table}, declination, gathering.warnings)
    channels = clear_of_motors(channels, log.events if log else (), gathering.warnings)
    if "depth" in table:
        channels.append(channel_of("depth", time_ns, table["depth"], DEPTH_CM, gathering.warnings))
    if declination is not None:
        gathering.metadata["heading_note"] = (
            f"true: the recorded magnetic heading plus {declination:g} deg of magnetic variation (east), from the .log"
        )
    gathering.metadata["depth_note"] = "depth as the vehicle reckoned it, not corrected for latitude as that of a .nc"
    gathering.keep_rows("", time_ns, channels)
    if log and "phase" in log and len(phase := held(log["phase"], time_ns, log.end_ns)):
        gathering.channels.append(phase)
    error = CUT if text.open and len(split[-1]) < len(names) else None
    return gathering.part(path, text.dive, ("eng",), error=error)


def _beside(path: Path, dive: Dive, start_ns: int, gathering: Gathering) -> tuple[float | None, Log | None]:
    """Magnetic variation, deg, or None, and the .log of this dive that stands beside under the same name, or None.

    start_ns : start of the dive by the .eng, UTC ns.
    """
    stem = Path(path.name.removesuffix(".gz")).stem
    beside = next((file for ending in BESIDE if (file := path.with_name(stem + ending)).is_file()), None)
    if beside is None:
        gathering.warnings.append(
            f"no {stem}.log beside it, which tells the magnetic variation, the states and the motor runs"
        )
        return None, None
    try:
        data, whole = unpacked(beside, beside.read_bytes())
        if not is_text(data):
            raise InputError(beside, "is no .log of a Seaglider")
        text = read_text(beside, data)
        if text.dive != dive:
            raise InputError(beside, f"is of {text.dive.name or 'an unknown dive'}, this is {dive.name or 'unknown'}")
        part = read_log(beside, data)
        gathering.beside.append(beside)
        gathering.warnings[:0] = other_start(start_ns, text.start_ns, beside.name)
        if fault := part.report.error if whole else DAMAGED:
            gathering.warnings.append(f"{beside.name} beside it: {fault}")
        return declination_of(text.lines), part.log
    except (OSError, InputError) as error:
        gathering.warnings.append(f"{beside.name} beside it is not used: it {str(error).removeprefix(f'{beside}: ')}")
        return None, None
