"""How does a Log stand in a NetCDF file? By the CF conventions: a trajectory where the track has a place on Earth.

Values are in SI units, angles in rad, as inside the program, so that nothing is lost on the way out; latitude and
longitude are in degrees. Times stand there twice: in seconds from the log's first second, as other programs like them
(exact to the nanosecond for 48 days), and as integers, in nanoseconds, exact for ever. A channel without a sample at a
time holds NaN, which no sample is.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from glidercli.channels import CHANNELS, PHASES
from glidercli.log import Log
from glidercli.origins import BOTH

__all__ = ["EXACT_TIME", "METADATA_ATTRIBUTE", "NetcdfTable"]

EXACT_TIME = "time_ns"
METADATA_ATTRIBUTE = "glidercli"
"""Of the file: the JSON that stands beside a CSV."""

_AXES = {"latitude": ("degrees_north", "Y"), "longitude": ("degrees_east", "X")}
_CHUNK = 16384  # samples
_CACHE = 8 * 8 * _CHUNK  # bytes for a variable; the library's own grow to 64 MB each


class NetcdfTable:
    """A log as NetCDF-4, piece by piece along its unlimited dimension, time."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._file: Any = None
        self._rows, self._zero_ns = 0, 0
        self._bounds: dict[str, tuple[float, float]] = {}

    def add(self, log: Log) -> None:
        """Append a piece; all have the same channels."""
        if self._file is None:
            self._open(log)
        times = [channel.time_ns for channel in log.channels.values() if len(channel)]
        time_ns = np.unique(np.concatenate(times)) if times else np.array([], np.int64)
        rows = slice(self._rows, self._rows + len(time_ns))
        self._file["time"][rows] = (time_ns - self._zero_ns) / 1e9
        self._file[EXACT_TIME][rows] = time_ns
        for name, channel in log.channels.items():
            column = np.full(len(time_ns), np.nan)
            column[np.searchsorted(time_ns, channel.time_ns)] = channel.values
            if name == "phase":
                column = np.where(np.isnan(column), -1, column).astype("i1")
            self._file[name][rows] = column
            if len(channel):
                low, high = self._bounds.get(name, (np.inf, -np.inf))
                self._bounds[name] = (min(low, channel.values.min()), max(high, channel.values.max()))
        self._rows += len(time_ns)

    def close(self, metadata: Mapping[str, Any]) -> None:
        """Finish the file. metadata : what else the log says, as for CSV."""
        span = metadata["span_ns"]
        if span:
            first, last = (f"{np.datetime64(moment, 'ns')}Z" for moment in span)
            self._file.setncatts({"time_coverage_start": first, "time_coverage_end": last})
        for name, (low, high) in self._bounds.items():
            if name in ("latitude", "longitude"):
                short = name[:3]
                self._file.setncatts({f"geospatial_{short}_min": low, f"geospatial_{short}_max": high})
        told = metadata["metadata"]
        statement = told.get("reconstruction")
        self._file.setncatts(
            {
                "title": _plain(told.get("title", "glider flight")),
                "source": _source(metadata) + (f": {_plain(statement)}" if statement else ""),
                "history": _plain("written by " + _program(told)),
                "references": _plain(told.get("vehicle_reference", "https://doi.org/10.1016/j.oceaneng.2012.12.023")),
                "comment": "Angles in rad. The attribute glidercli holds provenance, events and origins, as JSON.",
                METADATA_ATTRIBUTE: json.dumps(metadata),
            }
        )
        self._file.close()

    def _open(self, log: Log) -> None:
        """Declare dimension, coordinates and channels."""
        import netCDF4

        self._file = file = netCDF4.Dataset(self._path, "w", format="NETCDF4")
        has_place = {"latitude", "longitude", "depth"} <= set(log.channels)
        file.setncatts({"Conventions": "CF-1.10", "institution": "not said"})
        file.createDimension("time", None)
        chunks: dict[str, Any] = {"chunksizes": (_CHUNK,), "compression": "zlib", "complevel": 1, "shuffle": True}
        second = log.start_ns // 10**9 if any(map(len, log.channels.values())) else 0
        self._zero_ns = second * 10**9
        time = file.createVariable("time", "f8", ("time",), **chunks)
        time.setncatts(
            {
                "standard_name": "time", "long_name": "time, UTC", "axis": "T", "calendar": "standard",
                "units": f"seconds since {np.datetime64(second, 's')}Z",
            }
        )  # fmt: skip
        time.set_var_chunk_cache(size=_CACHE, nelems=101)
        exact = file.createVariable(EXACT_TIME, "i8", ("time",), **chunks)
        exact.setncatts(
            {
                "standard_name": "time", "long_name": "time, UTC, exact", "calendar": "standard",
                "units": "nanoseconds since 1970-01-01T00:00:00Z",
            }
        )  # fmt: skip
        exact.set_var_chunk_cache(size=_CACHE, nelems=101)
        if has_place:
            file.featureType = "trajectory"
            file.createDimension("name_length", 8)
            which = file.createVariable("trajectory", "S1", ("name_length",))
            which.setncatts({"cf_role": "trajectory_id", "long_name": "the one flight of this file"})
            which[:] = np.frombuffer(b"flight\0\0", "S1")
        for name, channel in log.channels.items():
            spec = CHANNELS[name]
            if name == "phase":
                variable = file.createVariable(name, "i1", ("time",), fill_value=-1, **chunks)
                flags = np.arange(len(PHASES), dtype="i1")
                variable.setncatts({"flag_values": flags, "flag_meanings": " ".join(PHASES)})
            else:
                variable = file.createVariable(name, "f8", ("time",), fill_value=np.nan, **chunks)
                variable.units = _AXES[name][0] if name in _AXES else _units(spec.unit)
            variable.set_var_chunk_cache(size=_CACHE, nelems=101)
            variable.long_name = spec.meaning
            variable.comment = f"{channel.origin}"
            if spec.cf_name:
                variable.standard_name = spec.cf_name
            if name == "depth":
                variable.setncatts({"positive": "down", "axis": "Z"})
            elif name in _AXES:
                variable.axis = _AXES[name][1]
            elif has_place:
                variable.coordinates = "time latitude longitude depth"


def _units(unit: str) -> str:
    """A unit as UDUNITS spells it."""
    return {"degC": "degree_Celsius", "kg/m3": "kg m-3", "m/s": "m s-1", "rad/s": "rad s-1", "S/m": "S m-1",
            "g/kg": "g kg-1"}.get(unit, unit)  # fmt: skip


def _source(metadata: Mapping[str, Any]) -> str:
    """What the file holds, in a word: simulated, measured ..."""
    words = set(metadata["channels"].values())
    return BOTH if metadata["origin"] == "measured" and "derived" in words else str(metadata["origin"])


def _program(told: Mapping[str, Any]) -> str:
    record = told.get("provenance", {})
    if not isinstance(record, dict):
        return "glidercli"
    command = record.get("command", [])
    return " ".join(
        map(str, [record.get("program", "glidercli"), "-", *(command if isinstance(command, list) else [])])
    )


def _plain(text: str) -> str:
    """A text for people: what an attribute cannot hold is replaced; the JSON has it as it is."""
    return text.encode("utf-8", "replace").decode().replace("\0", " ")
