"""How does a NetCDF file that glider wrote become the Log again? Equal to the last bit, as long as nothing is amiss."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any, cast, get_args

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.log import Log, Origin
from glidercli.logio.netcdf.times import FIRST, LAST, times_of
from glidercli.logio.own.csv_metadata import events_of, parsed_metadata, texts_of
from glidercli.logio.own.netcdf_log import EXACT_TIME, METADATA_ATTRIBUTE
from glidercli.logio.own.rules import channels_of, unusable
from glidercli.logio.reader import Aids, Part
from glidercli.logio.records import NO_TIME
from glidercli.logio.report import FileReport
from glidercli.netcdf_opening import holds, opened, rows_of

__all__ = ["is_own_netcdf", "read_own_netcdf"]


def is_own_netcdf(path: Path) -> bool:
    """Whether the file is NetCDF that glider wrote."""
    return holds(path, lambda file: METADATA_ATTRIBUTE in file.ncattrs() and "time" in file.dimensions)


def read_own_netcdf(path: Path, aids: Aids = Aids()) -> Part:
    """The file's Log, and its account: a record is a time of the file.

    Records and values that cannot be used are dropped, left out and counted by the rules of ``rules.py``; what glider
    wrote comes back equal to the last bit. Files of versions before the integer time had float seconds alone, exact for
    48 days. Raises InputError for a file that is no NetCDF, was not written by glider, or is cut short or damaged.
    """
    with opened(path) as file:
        if METADATA_ATTRIBUTE not in file.ncattrs() or "time" not in file.dimensions:
            raise InputError(path, "is a NetCDF file that glider did not write; one made by -o NAME.nc is needed")
        what = f"its attribute {METADATA_ATTRIBUTE} is not the metadata of a log"
        metadata = parsed_metadata(path, what, str(file.getncattr(METADATA_ATTRIBUTE)))
        rows_of(path, file, "time")
        exact = file.variables.get(EXACT_TIME)
        time_ns = times_of(path, file["time"]) if exact is None else exact[:].astype(np.int64)
        variables = [file[name] for name in file.variables if name in CHANNELS]
        columns = {variable.name: _values(path, variable) for variable in variables}
        origins = {variable.name: _origin(path, variable, metadata["channels"]) for variable in variables}
    time_ns = np.where((time_ns > FIRST) & (time_ns < LAST), time_ns, NO_TIME)
    dropped: Counter[str] = Counter()
    warnings: list[str] = []
    channels, kept_ns = channels_of(time_ns, columns, origins, dropped, warnings)
    log = Log(channels, cast(Origin, metadata["origin"]), texts_of(metadata), events_of(metadata))
    error = None if len(kept_ns) or not len(time_ns) else unusable(dropped, warnings)
    reasons = tuple(sorted(dropped.items()))
    report = FileReport(path, "glider-nc", len(time_ns), len(kept_ns), reasons, tuple(warnings), error)
    return Part(log, report, kept_ns)


def _values(path: Path, variable: Any) -> NDArray[np.float64]:
    """The values of a channel, NaN where there is no sample."""
    if variable.dimensions != ("time",) or variable.dtype.kind not in "if":
        raise InputError(path, f"{variable.name} is not a variable of numbers along time, as glider writes it")
    stored = variable[:]
    fill = variable.getncattr("_FillValue")
    return np.where(np.isnan(stored) if np.isnan(fill) else stored == fill, np.nan, stored.astype(np.float64))


def _origin(path: Path, variable: Any, origins: dict[str, str]) -> Origin:
    """The origin of a channel; that of one without a sample stands in the variable's comment alone."""
    origin = origins.get(variable.name, variable.getncattr("comment"))
    if origin not in get_args(Origin):
        raise InputError(path, f"{variable.name} has the origin {origin!r}; origins are {', '.join(get_args(Origin))}")
    return cast(Origin, origin)
