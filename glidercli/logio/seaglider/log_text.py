"""What does a .log hold? Settings, and among them three kinds of records: GPS fixes, motor events and states.

    $GPS1, $GPS2, $GPS   ddmmyy,hhmmss,ddmm.mmm,dddmm.mmm,seconds to first fix,hdop,seconds to fix,magnetic variation
    $GC                  columns named by $GCHEAD, times in seconds since the start of the dive
    $STATE               seconds,begin or end of a state[,why]

Format: Seaglider File Formats Manual (University of Washington, 66.12). Software before version 65 writes no $GCHEAD;
the columns then are those that the basestation takes (LogFile.py).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.cut_text import CUT
from glidercli.logio.quantities import channel_of, degrees
from glidercli.logio.reader import Part
from glidercli.logio.records import NO_TIME
from glidercli.logio.seaglider.actuators import counts_of_vbd, moves, surface_pump
from glidercli.logio.seaglider.columns import SEA, fixes
from glidercli.logio.seaglider.dive_start import doubts_about_start
from glidercli.logio.seaglider.gathering import Gathering
from glidercli.logio.seaglider.states import States, number_of, phase, take_states
from glidercli.logio.seaglider.text_file import TextFile, read_text, since, to_number, utc_ns

__all__ = ["declination_of", "read_log"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

FIXES = ("$GPS1", "$GPS2", "$GPS")
OLD_HEAD = (
    "st_secs,pitch_ctl,vbd_ctl,ob_vertv,data_pts,end_secs,pitch_secs,roll_secs,vbd_secs,vbd_i,gcphase,pitch_i,roll_i,"
    "pitch_ad,roll_ad,vbd_ad"
)
SETTINGS = ("C_PITCH", "PITCH_CNV", "C_ROLL_DIVE", "C_ROLL_CLIMB", "ROLL_CNV", "C_VBD", "VBD_CNV", "VBD_LP_IGNORE")
LARGEST_SETTING = 1e6
"""Centres are up to 4095 counts, conversions a fraction of a cm, deg or cm3 for each."""
PADDING = [""] * 6
"""Fields that a fix which was cut short may lack."""


def read_log(path: Path, data: bytes) -> Part:
    """The Part of a .log. Its depths, at motor events, give way to those of the .eng of the dive."""
    text = read_text(path, data)
    gathering = Gathering(text.start_ns, metadata=text.about)
    lines = [(key, rest.split(",")) for key, _, rest in (line.partition(",") for line in text.lines)]
    cut = text.open and _lacks_fields(lines)
    if cut:
        lines.pop()
    settings = {key[1:]: to_number(fields[0]) for key, fields in lines if key[1:] in SETTINGS}
    settings = {name: value for name, value in settings.items() if abs(value) < LARGEST_SETTING}
    sampled = (*FIXES, "$GC", "$STATE", "$SM_CCo")
    gathering.records = sum(key not in sampled for key, _ in lines)
    gathering.records += cut
    gathering.drop("", "cut short", int(cut))
    gathering.drop("", "a setting, no sample", sum(key not in sampled and key.startswith("$") for key, _ in lines))
    gathering.drop("", "no line of the form $KEY,value", sum(not key.startswith("$") for key, _ in lines))
    states = _states(text, [fields for key, fields in lines if key == "$STATE"], gathering)
    head = next((fields for key, fields in lines if key == "$GCHEAD"), OLD_HEAD.split(","))
    rows = [fields for key, fields in lines if key == "$GC"]
    events_ns = _events(text, head, rows, settings, states.end_of_dive_ns, gathering)
    if len(states.time_ns):
        gathering.channels.append(phase(states, events_ns))
    pumped = [fields for key, fields in lines if key == "$SM_CCo"]
    gathering.records += len(pumped)
    gathering.drop("$SM_CCo", "the pump's run at the surface, events and no sample", len(pumped))
    for fields in pumped[:1]:
        gathering.events += surface_pump([to_number(field) for field in fields], text.start_ns)
    _fixes([fields for key, fields in lines if key in FIXES], gathering)
    before, after = (max((_fix_ns(f) for key, f in lines if key == name), default=NO_TIME) for name in FIXES[1:])
    last = max([*states.time_ns.tolist(), *events_ns.tolist()], default=NO_TIME)
    gathering.warnings[:0] = doubts_about_start(text.start_ns, before, after, last)  # first: a list is shown in part
    return gathering.part(path, text.dive, ("log",), yields=frozenset({"depth"}), error=CUT if cut else None)


def _lacks_fields(lines: list[tuple[str, list[str]]]) -> bool:
    """Whether the last line ends before others of its key do, or names a state that is none."""
    key, fields = lines[-1]
    kind = FIXES if key in FIXES else (key,)
    others = [len(others) for name, others in lines[:-1] if name in kind]
    if key == "$STATE" and len(fields) > 1 and number_of(fields[1].strip()) < 0:
        return True
    return fields == [""] or not key.startswith("$") or len(fields) < min(others, default=0)


def declination_of(lines: list[str]) -> float | None:
    """Magnetic variation, deg, positive east, as the last fix tells it, or None."""
    found = [line.split(",") for line in lines if line.split(",", 1)[0] in FIXES]
    told = [to_number(fields[8]) for fields in found if len(fields) > 8]
    known = [value for value in told if abs(value) <= 180.0]
    return known[-1] if known else None


def _states(text: TextFile, rows: list[list[str]], gathering: Gathering) -> States:
    """Take the states; their phases are taken with the motor events."""
    time_ns = since(text.start_ns, [to_number(row[0]) for row in rows])
    numbers = np.array([number_of(row[1].strip()) if len(row) > 1 else -1 for row in rows], dtype=np.int64)
    return take_states(gathering, "$STATE", time_ns, numbers)


def _events(
    text: TextFile,
    head: list[str],
    rows: list[list[str]],
    settings: dict[str, float],
    climb_ns: int | None,
    gathering: Gathering,
) -> Times:
    """Take the motor events: depths at their starts, and where the motors stood; the starts, (n,) UTC ns."""
    names = [name.strip() for name in head]
    whole = [row for row in rows if len(row) == len(names)]
    gathering.records += len(rows) - len(whole)
    gathering.drop("$GC", "wrong number of fields", len(rows) - len(whole))
    numbers = np.array([[to_number(cell) for cell in row] for row in whole]).reshape(len(whole), len(names))
    table = {name: numbers[:, i] for i, name in enumerate(names)}
    if "st_secs" not in table:
        gathering.records += len(whole)
        gathering.drop("$GC", "no column st_secs", len(whole))
        return np.array([], np.int64)
    start = table.pop("st_secs")
    if "end_secs" in table:
        table["end_secs"] = table["end_secs"] - start
    time_ns = since(text.start_ns, start)
    good = gathering.usable("$GC", time_ns, table)
    time_ns, table = time_ns[good], {name: values[good] for name, values in table.items()}
    table = counts_of_vbd(table, settings.get("VBD_LP_IGNORE"))
    found = moves(time_ns, table, settings, climb_ns, gathering.warnings)
    channels = list(found.channels)
    if "depth" in table:
        channels.append(channel_of("GC depth", time_ns, table["depth"], SEA["depth"], gathering.warnings))
    gathering.channels += [channel for channel in channels if len(channel)]
    gathering.events += found.events
    depths = np.isin(time_ns, channels[-1].time_ns if "depth" in table else time_ns[:0])
    gathering.keep("$GC", found.first_ns, found.gave | depths, "no depth or position, and no motor ran")
    return time_ns


def _fixes(rows: list[list[str]], gathering: Gathering) -> None:
    """Take the GPS fixes, in the order of their times."""
    fields = [[to_number(field) for field in [*row, *PADDING][:6]] for row in rows]
    time_ns = np.array([_fix_ns(row) for row in rows], dtype=np.int64)
    order = np.argsort(time_ns, kind="stable")
    parsed, time_ns = np.array(fields).reshape(len(rows), 6)[order], time_ns[order]
    table = {"latitude": degrees(parsed[:, 2]), "longitude": degrees(parsed[:, 3]), "hdop": parsed[:, 5]}
    good = gathering.usable("$GPS", time_ns, table)
    found = fixes(time_ns[good], {key: values[good] for key, values in table.items()}, gathering.warnings)
    gathering.keep_rows("$GPS", time_ns[good], found)


def _fix_ns(row: list[str]) -> int:
    """Time of a fix, UTC ns, or NO_TIME."""
    date, clock = ([*row, *PADDING][i].strip()[:6] for i in (0, 1))
    if not (len(date) == len(clock) == 6 and (date + clock).isascii() and (date + clock).isdigit()):
        return NO_TIME
    day, month, year, hour, minute, second = (int(text[i : i + 2]) for text in (date, clock) for i in (0, 2, 4))
    return utc_ns(1900 + year if year > 69 else 2000 + year, month, day, hour, minute, second)
