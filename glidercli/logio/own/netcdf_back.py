"""How does a NetCDF file that glider wrote become the Log again? Equal to the last bit."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast, get_args

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS, PHASES
from glidercli.errors import InputError
from glidercli.log import Channel, Log, Origin
from glidercli.logio.netcdf.times import times_of
from glidercli.logio.own.csv_metadata import events_of, parsed_metadata, texts_of
from glidercli.logio.own.netcdf_log import EXACT_TIME, METADATA_ATTRIBUTE
from glidercli.logio.reader import Aids, Part
from glidercli.logio.records import sampled
from glidercli.logio.report import FileReport
from glidercli.netcdf_opening import DAMAGED, holds, opened, rows_of

__all__ = ["is_own_netcdf", "read_own_netcdf", "read_own_netcdf_log"]


def is_own_netcdf(path: Path) -> bool:
    """Whether the file is NetCDF that glider wrote."""
    return holds(path, lambda file: METADATA_ATTRIBUTE in file.ncattrs() and "time" in file.dimensions)


def read_own_netcdf(path: Path, aids: Aids = Aids()) -> Part:
    """The file's Log, and its account: a record is a time of the file, kept where a channel has a sample."""
    time_ns, log = _read(path)
    kept = sampled(time_ns, log.channels)
    dropped = (("no value", int((~kept).sum())),) if not kept.all() else ()
    return Part(log, FileReport(path, "glider-nc", len(time_ns), int(kept.sum()), dropped), time_ns[kept])


def read_own_netcdf_log(path: Path) -> Log:
    """The Log that was written: channels, origins, metadata, events.

    Files of versions before the integer time had float seconds alone, exact for 48 days. Raises InputError for a file
    that is no NetCDF, was not written by glider, or is cut short or damaged.
    """
    return _read(path)[1]


def _read(path: Path) -> tuple[NDArray[np.int64], Log]:
    """All times of the file, and its Log."""
    with opened(path) as file:
        if METADATA_ATTRIBUTE not in file.ncattrs() or "time" not in file.dimensions:
            raise InputError(path, "is a NetCDF file that glider did not write; one made by -o NAME.nc is needed")
        what = f"its attribute {METADATA_ATTRIBUTE} is not the metadata of a log"
        metadata = parsed_metadata(path, what, str(file.getncattr(METADATA_ATTRIBUTE)))
        rows_of(path, file, "time")
        exact = file.variables.get(EXACT_TIME)
        time_ns = times_of(path, file["time"]) if exact is None else exact[:].astype(np.int64)
        if (np.diff(time_ns) <= 0).any():
            raise InputError(path, f"{DAMAGED}: its times do not increase")
        names = [name for name in file.variables if name in CHANNELS]
        channels = {name: _channel(path, file[name], time_ns, metadata["channels"]) for name in names}
    return time_ns, Log(channels, cast(Origin, metadata["origin"]), texts_of(metadata), events_of(metadata))


def _channel(path: Path, variable: Any, time_ns: NDArray[np.int64], origins: dict[str, str]) -> Channel:
    """One channel; a channel without a sample has its origin in the variable's comment alone."""
    name = variable.name
    if variable.dimensions != ("time",) or variable.dtype.kind not in "if":
        raise InputError(path, f"{name} is not a variable of numbers along time, as glider writes it")
    stored = variable[:]
    fill = variable.getncattr("_FillValue")
    given = ~np.isnan(stored) if np.isnan(fill) else stored != fill
    values = stored[given].astype(np.float64)
    if not np.isfinite(values).all() or (name == "phase" and not np.isin(values, np.arange(len(PHASES))).all()):
        raise InputError(path, f"{DAMAGED}: {name} holds values that no channel has")
    origin = origins.get(name, variable.getncattr("comment"))
    if origin not in get_args(Origin):
        raise InputError(path, f"{name} has the origin {origin!r}; origins are {', '.join(get_args(Origin))}")
    return Channel(name, time_ns[given], values, cast(Origin, origin))
