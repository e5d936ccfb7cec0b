"""What is peculiar to NetCDF that pyglider made? Vehicle channels at the times of the CTD, and radians called degrees.

Seen in its source (seaexplorer.py, slocum.py: np.interp to the times of the CTD) and in the results that its 0.0.9
comes with: tests/expected/example-slocum has m_pitch, which Slocum records in rad, under units = "degrees" with values
of -0.52 to 0.51.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np

from glidercli.logio.netcdf.trajectory import found_in
from glidercli.logio.netcdf.variables import Values, attributes
from glidercli.logio.netcdf.vocabulary import STANDARD_NAMES
from glidercli.units import DEGREE

__all__ = ["NOTE", "is_pyglider", "read_with_attitude"]

ATTITUDE = ("heading", "pitch", "roll")
NOTE = "heading, pitch and roll were interpolated to the times of the CTD by pyglider"
_SLOCUM = ("m_heading", "m_pitch", "m_roll")


def is_pyglider(file: Any) -> bool:
    """Whether the file has attributes that pyglider takes over from a deployment's YAML."""
    return {"deployment_name", "glider_instrument_name"} <= set(file.ncattrs())


def read_with_attitude(
    file: Any,
    dimension: str,
    names: Mapping[str, Sequence[str]],
    metadata: dict[str, str],
    warnings: list[str],
    besides: Collection[str] = (),
) -> dict[str, Values]:
    """The channels of a file, by ``found_in``; what pyglider made of the attitude is mended and told in metadata."""
    found = found_in(file, dimension, names, STANDARD_NAMES, warnings, besides)
    if is_pyglider(file):
        found = _mended(file, found, warnings)
        if "pitch" in found:
            metadata["attitude_note"] = NOTE
    return found


def _mended(file: Any, found: dict[str, Values], warnings: list[str]) -> dict[str, Values]:
    """The values with attitude as derived, and in radians where the file's degrees can only be radians."""
    angles = {channel: found[channel] for channel in ATTITUDE if channel in found}
    made: dict[str, Values] = {c: v._replace(origin="derived") for c, v in angles.items()}
    told = {channel: attributes(file[values.name]) for channel, values in angles.items()}
    slocum = bool(told) and all(str(item.get("source")) in _SLOCUM for item in told.values())
    largest = max((np.nanmax(np.abs(v.values), initial=0.0) for v in angles.values()), default=0.0) / DEGREE
    if slocum and largest <= 2.0 * math.pi and all("deg" in str(item.get("units")) for item in told.values()):
        names = ", ".join(values.name for values in angles.values())
        warnings.append(f"{names}: called degrees, read as rad: Slocum records rad, and no value exceeds 2 pi")
        made = {channel: values._replace(values=values.values / DEGREE) for channel, values in made.items()}
    return found | made
