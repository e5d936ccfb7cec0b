"""How is a .nc read without trusting it? Variables as arrays of numbers, whatever the library says about a damage."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.logio.seaglider.classic import check_classic
from glidercli.logio.seaglider.text_file import to_number
from glidercli.netcdf_heaps import check_heaps

__all__ = ["LARGEST", "NetcdfFile", "is_netcdf"]

Array = NDArray[np.float64]

CLASSIC, HDF5 = b"CDF", b"\x89HDF\r\n\x1a\n"
LARGEST = 128 * 2**20
"""Bytes of a file, unpacked, and of one variable, at most; those of a dive are a few MB."""
OG1 = b"N_MEASUREMENTS"
"""The dimension of what was made of a dive for OceanGliders 1.0."""
MARKS = (b"sg_data_point", b"gc_event")
"""Dimensions that a basestation's file of a dive has; their names stand in both formats as plain text."""


def is_netcdf(data: bytes) -> bool:
    """Whether bytes are a .nc with the dimensions of a Seaglider's dive."""
    return data.startswith((CLASSIC, HDF5)) and any(mark in data for mark in MARKS) and OG1 not in data


class NetcdfFile:
    """An open .nc; what cannot be read of it is collected in ``damaged``."""

    def __init__(self, path: Path, data: bytes) -> None:
        """Open the bytes of a file. Raises InputError where they cannot be opened."""
        import netCDF4

        self.path, self.damaged, self._read = path, list[str](), set[str]()
        try:
            if data.startswith(CLASSIC):
                check_classic(data)
            else:
                check_heaps(data)
            self._file: Any = netCDF4.Dataset(path.name, memory=data)
            self._file.set_auto_maskandscale(False)
            self.names = frozenset(self._file.variables)
        except (OSError, RuntimeError, ValueError, KeyError, IndexError) as error:  # ValueError: also what is no UTF-8
            raise InputError(path, f"is damaged: {_line(error)}; a whole NetCDF file is needed") from None

    def close(self) -> None:
        """Give the memory back."""
        self._file.close()

    def dimension(self, name: str) -> str:
        """The one dimension of a variable; "" where it has none, or several, or is not there."""
        axes: tuple[str, ...] = self._file.variables[name].dimensions if name in self.names else ()
        return str(axes[0]) if len(axes) == 1 else ""

    def array(self, name: str) -> Array:
        """A variable of numbers, (n,), NaN where it holds its fill value; of no elements where it cannot be read."""
        raw = self._raw(name)
        if raw is None or raw.dtype.kind not in "fiu":
            return np.array([])
        values = raw.astype(float)
        fill = getattr(self._file.variables[name], "_FillValue", np.nan)
        values[(raw == fill) | (np.abs(values) > 9e36)] = np.nan  # the library's own fill value is 9.97e36
        return values

    def unread(self, dimensions: Collection[str]) -> list[str]:
        """The variables along one of these dimensions that were not asked for and hold a number."""
        left = [name for name in self._file.variables if name not in self._read and not name.endswith("_qc")]
        return [name for name in left if self.dimension(name) in dimensions and not np.isnan(self.array(name)).all()]

    def number(self, name: str) -> float | None:
        """A single number, also one that is written as text, or None."""
        raw = self._raw(name)
        if raw is None or raw.size == 0:
            return None
        value = to_number(raw.tobytes().decode("latin-1") if raw.dtype.kind == "S" else str(raw.flat[0]))
        return value if np.isfinite(value) else None

    def fields(self, name: str) -> list[float]:
        """The numbers of a text that is parted by commas, NaN for a field that is none; [] where it is not there."""
        raw = self._raw(name)
        if raw is None or raw.dtype.kind != "S":
            return []
        return [to_number(text) for text in raw.tobytes().decode("latin-1").split(",")]

    def quality(self, name: str) -> NDArray[np.str_]:
        """Quality flags, (n,), one character each; numbers in the oldest files."""
        raw = self._raw(name)
        if raw is None:
            return np.array([], dtype=str)
        if raw.dtype.kind in "fiu":
            raw = np.nan_to_num(raw).astype(int)
            return np.atleast_1d(raw).astype(str)
        return np.frombuffer(raw.tobytes(), dtype="S1").astype(str)

    def attribute(self, name: str) -> Any:
        """A global attribute, or None."""
        try:
            return self._file.getncattr(name)
        except (AttributeError, OSError, RuntimeError, ValueError):
            return None

    def _raw(self, name: str) -> NDArray[Any] | None:
        if name not in self.names:
            return None
        variable = self._file.variables[name]
        self._read.add(name)
        try:
            if np.prod(variable.shape, dtype=float) * variable.dtype.itemsize > LARGEST:
                raise ValueError("larger than any variable of a dive")
            return np.asarray(variable[...])
        except (OSError, RuntimeError, ValueError, AttributeError, TypeError, IndexError):
            if name not in self.damaged:
                self.damaged.append(name)
            return None


def _line(error: Exception) -> str:
    """An error as a part of one line."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return " ".join(text.split())
