"""What does a basestation's .nc of a dive hold? Samples, CTD, motor events, states, GPS fixes, ADCP: each on its times.

Records are the entries of each series of times that channels are taken from: time, ctd_time (one series with time
where both are the same), gc_st_secs, gc_state_secs, log_gps_time, and the times of a processed glider ADCP. Files of
basestation 2 are NetCDF-3 and have no states and no TEOS-10 quantities; names are the same.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.logio.quantities import channel_of
from glidercli.logio.reader import Part
from glidercli.logio.records import STRAY
from glidercli.logio.seaglider.actuators import clear_of_motors, counts_of_vbd, moves, surface_pump
from glidercli.logio.seaglider.adcp import take_adcp
from glidercli.logio.seaglider.columns import ENGINEERING, SEA, cells, engineering, fixes
from glidercli.logio.seaglider.ctd import CTD, NOTES, ctd_channels, without_bad
from glidercli.logio.seaglider.gathering import Dive, Gathering
from glidercli.logio.seaglider.netcdf_file import NetcdfFile
from glidercli.logio.seaglider.series import nanoseconds, series
from glidercli.logio.seaglider.states import States, phase, take_states

__all__ = ["read_nc"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

ENG = {column: f"eng_{column}" for column in (*ENGINEERING, "head")}
SETTINGS = ("C_PITCH", "PITCH_CNV", "C_ROLL_DIVE", "C_ROLL_CLIMB", "ROLL_CNV", "C_VBD", "VBD_CNV")
EVENT = (
    "end_secs", "depth", "pitch_secs", "roll_secs", "vbd_secs", "pitch_ad_start", "pitch_ad", "roll_ad_start",
    "roll_ad", "vbd_ad_start", "vbd_pot1_ad_start", "vbd_pot2_ad_start", "vbd_ad",
)  # fmt: skip
TIMES = ("time", "ctd_time", "gc_st_secs", "gc_state_secs", "log_gps_time")
SCALARS = {
    "depth_avg_curr_east": "depth_averaged_current_east_m_s",
    "depth_avg_curr_north": "depth_averaged_current_north_m_s",
    "depth_avg_curr_error": "depth_averaged_current_error_m_s",
    "depth_avg_curr_qc": "depth_averaged_current_quality",
    "magnetic_variation": "magnetic_variation_deg",
}
"""Single numbers of a dive that go into the metadata."""


def read_nc(path: Path, data: bytes) -> Part:
    """The Part of a .nc. Raises InputError where it cannot be opened or none of its times can be read."""
    file = NetcdfFile(path, data)
    try:
        gathering = Gathering(_middle(file), metadata=_about(file))
        states = _take_states(file, gathering)
        events_ns = _take_events(file, gathering, states.end_of_dive_ns or _start_of_climb(file))
        rows_ns = _take_samples(file, gathering)
        if len(states.time_ns):
            gathering.channels.append(phase(states, np.union1d(rows_ns, events_ns)))
        if (start_ns := _at(file, 0.0)) is not None:
            gathering.events += surface_pump(file.fields("log_SM_CCo"), start_ns)
        _take_fixes(file, gathering)
        take_adcp(file, gathering)
        gathering.unread += file.unread({file.dimension(time) for time in TIMES} - {""})
        dive = Dive(*(_whole(file, *names) for names in (("glider", "log_glider"), ("mission", "log_mission"),
                                                         ("dive_number", "log_dive"))))  # fmt: skip
    finally:
        file.close()
    error = f"is damaged: {len(file.damaged)} variables cannot be read: {', '.join(file.damaged)}"
    if not gathering.records:
        raise InputError(path, error if file.damaged else f"has none of the times of a dive: {', '.join(TIMES)}")
    return gathering.part(path, dive, ("eng", "log"), fullness=1, error=error if file.damaged else None)


def _take_samples(file: NetcdfFile, gathering: Gathering) -> Times:
    """Take depth, attitude and controls at their times, and the CTD at its own; the former times, (n,) UTC ns."""
    warnings = gathering.warnings
    names = {key: ENG[key] for key in ENG} | {key: key for key in SEA}
    samples = series(file, "time", names)
    ctd = series(file, "ctd_time", CTD)
    gathering.metadata |= {f"{key}_note": note for key, (column, note) in NOTES.items() if column in ctd.table}
    ctd = ctd._replace(table=without_bad(file, ctd.table, warnings))
    one = np.array_equal(samples.time_ns, ctd.time_ns)
    if "vbdCC" in samples.table and "pitchCtl" not in samples.table:
        count = int(np.isfinite(samples.table.pop("vbdCC")).sum())
        warnings.append(f"eng_vbdCC: {count} values left out: the basestation's own interpolation of the motor events")
    table = cells(names, samples.table, warnings)
    beside = cells(CTD, ctd.table, warnings)
    good = gathering.usable(samples.kind, samples.time_ns, table | (beside if one else {}))
    time_ns, table = samples.time_ns[good], {key: values[good] for key, values in table.items()}
    channels = engineering(time_ns, table, names, _declination(file, gathering), warnings)
    channels = clear_of_motors(channels, gathering.events, warnings)
    channels += [channel_of(key, time_ns, table[key], SEA[key], warnings) for key in SEA if key in table]
    if one:
        channels += ctd_channels(time_ns, {key: values[good] for key, values in beside.items()}, _place(file), warnings)
    gathering.keep_rows(samples.kind, time_ns, channels)
    if not one:
        kind = ctd.kind if ctd.kind != samples.kind else "ctd_time"
        good = gathering.usable(kind, ctd.time_ns, beside)
        ctd_ns, beside = ctd.time_ns[good], {key: values[good] for key, values in beside.items()}
        gathering.keep_rows(kind, ctd_ns, ctd_channels(ctd_ns, beside, _place(file), warnings))
    return time_ns


def _place(file: NetcdfFile) -> tuple[float, float] | None:
    """Longitude and latitude of the dive, deg, or None."""
    longitude, latitude = file.number("avg_longitude"), file.number("avg_latitude")
    if longitude is None or latitude is None or abs(longitude) > 360.0 or abs(latitude) > 90.0:
        return None
    return longitude, latitude


def _declination(file: NetcdfFile, gathering: Gathering) -> float | None:
    """Magnetic variation, deg, positive east, or None."""
    told = file.number("magnetic_variation")
    if told is None:
        fixed = file.array("log_gps_magvar")
        fixed = fixed[np.abs(fixed) <= 180.0]
        told = float(fixed[-1]) if len(fixed) else None
    if told is not None:
        gathering.metadata["heading_note"] = (
            f"true: the recorded magnetic heading plus {told:g} deg of magnetic variation (east)"
        )
    return told


def _take_events(file: NetcdfFile, gathering: Gathering, climb_ns: int | None) -> Times:
    """Take the motor events; their starts, (n,) UTC ns."""
    kind, time_ns, table = series(file, "gc_st_secs", {key: f"gc_{key}" for key in EVENT})
    if "end_secs" in table:
        table["end_secs"] = table["end_secs"] - time_ns * 1e-9
    good = gathering.usable(kind, time_ns, table)
    time_ns, table = time_ns[good], {key: values[good] for key, values in table.items()}
    table = counts_of_vbd(table, file.number("log_VBD_LP_IGNORE"))
    told = {name: file.number(f"log_{name}") for name in SETTINGS}
    settings = {name: value for name, value in told.items() if value is not None}
    found = moves(time_ns, table, settings, climb_ns, gathering.warnings)
    gathering.channels += [channel for channel in found.channels if len(channel)]
    gathering.events += found.events
    gathering.keep(kind, found.first_ns, found.gave, "no motor ran, and no position is told")
    return time_ns


def _take_states(file: NetcdfFile, gathering: Gathering) -> States:
    """Take the states; their phases are taken with the samples."""
    kind, time_ns, table = series(file, "gc_state_secs", {"state": "gc_state_state"})
    numbers = table.get("state", np.full(len(time_ns), -1.0))
    return take_states(gathering, kind, time_ns, np.where(np.abs(numbers) < 100.0, numbers, -1.0).astype(np.int64))


def _middle(file: NetcdfFile) -> int | None:
    """A time within the dive, UTC ns, or None."""
    times = nanoseconds(file.array("time"))
    times = times[times > 0]
    return int(np.median(times)) if len(times) else None


def _start_of_climb(file: NetcdfFile) -> int | None:
    """When the climb began, UTC ns, where no states are recorded; or None."""
    since = file.number("start_of_climb_time")
    return None if since is None else _at(file, since)


def _at(file: NetcdfFile, since: float) -> int | None:
    """UTC ns of seconds since the start of the dive, or None where this is not told or of another clock."""
    start, middle = file.number("log_start"), _middle(file)
    if start is None or middle is None or abs(start + since - middle / 1e9) > STRAY / 1e9:
        return None
    return int(nanoseconds(np.array([start + since]))[0])


def _take_fixes(file: NetcdfFile, gathering: Gathering) -> None:
    """Take the GPS fixes before and after the dive."""
    names = {"latitude": "log_gps_lat", "longitude": "log_gps_lon", "hdop": "log_gps_hdop"}
    kind, time_ns, table = series(file, "log_gps_time", names)
    if not {"latitude", "longitude"} <= table.keys():
        return
    table.setdefault("hdop", np.full(len(time_ns), np.nan))
    table |= without_bad(file, {k: table[k] for k in ("latitude", "longitude")}, gathering.warnings, "log_gps_qc")
    good = gathering.usable(kind, time_ns, table)
    found = fixes(time_ns[good], {key: values[good] for key, values in table.items()}, gathering.warnings)
    gathering.keep_rows(kind, time_ns[good], found)


def _about(file: NetcdfFile) -> dict[str, str]:
    """Metadata that the file tells."""
    told = {key: file.number(name) for name, key in SCALARS.items()}
    found = {key: f"{value:.9g}" for key, value in told.items() if value is not None}
    for attribute, key in (("seaglider_software_version", "software_version"), ("base_station_version", "basestation")):
        if (value := file.attribute(attribute)) is not None:
            found[key] = str(value)
    return found


def _whole(file: NetcdfFile, attribute: str, variable: str) -> int | None:
    """A whole number of an attribute, or else of a variable."""
    value = file.attribute(attribute)
    number = float(value) if isinstance(value, (int, float, np.number)) else file.number(variable)
    return int(number) if number is not None and 0 <= number < 1e9 else None
