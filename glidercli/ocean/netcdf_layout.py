"""How do profiles stand in a NetCDF file? As a grid of profiles by depth in any order of dimensions, or ragged, or one.

Layouts of chapter 9 of the CF conventions: an orthogonal or incomplete array of profiles (a dimension of depth, and at
most one other), a contiguous ragged array (a variable with ``sample_dimension`` counts), an indexed ragged array (a
variable with ``instance_dimension`` tells of each sample its profile, from 0), a single profile.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean.netcdf import MOST_VALUES, NcFile, long_dimensions, opened

__all__ = ["Layout", "has_profiles", "layout_of"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

MAIN = ("temperature", "potential_temperature", "conservative_temperature", "density", "east")
"""Quantities that tell the layout, the first that a file has."""


class Samples(NamedTuple):
    """Of a ragged array. counts : (profiles,), samples of each. order : (samples,), which stands where, by profile."""

    counts: NDArray[np.int64]
    order: NDArray[np.intp] | slice


class Layout(NamedTuple):
    """Where profiles stand.

    axis : "depth" or "pressure". axis_variable : its variable. vertical : the dimension along a profile. across : the
    dimension of profiles, or None of a single one. rows : of a ragged array the samples of each profile, by dimension
    of samples; else empty.
    """

    axis: str
    axis_variable: Any
    vertical: str
    across: str | None
    rows: dict[str, Samples]
    profiles: int

    def table(self, path: Path, variable: Any, values: NDArray[Any], empty: Any = np.nan) -> NDArray[Any]:
        """The values of a variable by profile and sample, (profiles, samples); one along one of them is repeated."""
        if self.rows:
            return self._ragged(path, variable, values, empty)
        long = long_dimensions(variable)
        allowed = (self.vertical,) if self.across is None else (self.across, self.vertical)
        if not set(long) <= set(allowed):
            raise _odd(path, variable, allowed)
        squeezed = values.reshape([size for size in values.shape if size != 1])
        if long == (self.vertical, self.across):
            squeezed = squeezed.T
        elif long == (self.across,):
            squeezed = squeezed[:, np.newaxis]
        samples = self.axis_variable.shape[self.axis_variable.dimensions.index(self.vertical)]
        return np.array(np.broadcast_to(squeezed, (self.profiles, samples)))

    def _ragged(self, path: Path, variable: Any, values: NDArray[Any], empty: Any) -> NDArray[Any]:
        """One row for each profile; a profile in which a quantity was not measured is empty."""
        long = long_dimensions(variable)
        axis, own = self.rows[self.vertical], self.rows.get(long[0]) if len(long) == 1 else None
        if own is None:
            raise _odd(path, variable, tuple(self.rows))
        differ = np.flatnonzero((own.counts != axis.counts) & (own.counts != 0))
        if len(differ):
            i = int(differ[0])
            what = f"profile {i} has {axis.counts[i]} samples of {self.axis} and {own.counts[i]} of {variable.name}"
            raise InputError(path, what)
        out = np.full((self.profiles, int(axis.counts.max(initial=0))), empty, dtype=values.dtype)
        out[np.arange(out.shape[1]) < own.counts[:, np.newaxis]] = values.ravel()[own.order]
        return out


def _odd(path: Path, variable: Any, allowed: tuple[str, ...]) -> InputError:
    sizes = ", ".join(f"{n} {s}" for n, s in zip(variable.dimensions, variable.shape, strict=True)) or "none"
    return InputError(
        path, f"{variable.name} has the dimensions {sizes}; needed are {' and '.join(allowed)}, at one place"
    )


def main_of(file: NcFile, wanted: tuple[str, ...] = MAIN) -> tuple[str, Any] | None:
    """The first of some quantities that a file has beside a depth or pressure, with its variable; else the first."""
    found = [(quantity, variable) for quantity in wanted for variable in file.candidates(quantity)]
    with_axis = [item for item in found if _axis(file, item[1]) is not None]
    return next(iter(with_axis or found), None)


def layout_of(file: NcFile, main: Any) -> Layout:
    """The layout of a file, told by its main variable; InputError where there is none that can be read."""
    layout = _found_layout(file, main)
    if _is_record(file, layout):
        raise InputError(
            file.path, "its depth goes up and down in time: it holds no profiles, and is no log that is known"
        )
    return layout


def _found_layout(file: NcFile, main: Any) -> Layout:
    found = _axis(file, main)
    if found is None:
        raise InputError(file.path, _without_axis(file, main))
    axis, variable = found
    rows = _rows(file, main)
    if variable.ndim == 1 and variable.dimensions[0] in rows:
        return Layout(axis, variable, variable.dimensions[0], None, rows, len(rows[variable.dimensions[0]].counts))
    vertical = _vertical(file, variable, main)
    others = [name for name in long_dimensions(main) if name != vertical]
    if len(others) > 1:
        raise _odd(file.path, main, (vertical, "time"))
    profiles = main.shape[main.dimensions.index(others[0])] if others else 1
    return Layout(axis, variable, vertical, others[0] if others else None, {}, profiles)


def _without_axis(file: NcFile, main: Any) -> str:
    """What is wrong where no depth or pressure lies along the main variable."""
    for axis in ("depth", "pressure"):
        for variable in file.candidates(axis):
            if variable.size == 1:
                return f"{main.name} is at a single {axis} ({variable.name}); a profile needs at least two"
    return f"has no depth or pressure along {' or '.join(main.dimensions) or main.name}; it has {file.names}"


def has_profiles(path: Path) -> bool:
    """Whether a NetCDF file holds profiles by depth, and not a record in time whose depth goes up and down."""
    try:
        with opened(path) as file:
            found = main_of(file)
            if found is None or _axis(file, found[1]) is None:
                return False
            return not _is_record(file, _found_layout(file, found[1]))
    except InputError:
        return True  # the reader says why


def _is_record(file: NcFile, layout: Layout) -> bool:
    """Whether depth goes up and down along a dimension of time."""
    if layout.across is not None or layout.rows:
        return False
    values, _ = file.values(layout.axis_variable, layout.axis)
    steps = np.diff(values[np.isfinite(values)])
    in_time = any(layout.vertical in long_dimensions(v) for v in file.candidates("time"))
    return in_time and not bool((steps > 0.0).all() or (steps < 0.0).all())


def _axis(file: NcFile, main: Any) -> tuple[str, Any] | None:
    """The variable of depth, else of pressure, that lies along a dimension of the main variable."""
    dimensions = long_dimensions(main)
    if main.ndim == 1 and main.dimensions[0] in (rows := _rows(file, main)):
        dimensions += tuple(rows)
    for axis in ("depth", "pressure"):
        for variable in file.candidates(axis):
            own = long_dimensions(variable)
            if own and set(own) <= set(dimensions):
                return axis, variable
    return None


def _vertical(file: NcFile, axis: Any, main: Any) -> str:
    """The dimension along a profile: of a depth with two, the one that no time lies along."""
    own = long_dimensions(axis)
    if len(own) == 1:
        return own[0]
    timed = {name for v in file.candidates("time") if len(long_dimensions(v)) == 1 for name in long_dimensions(v)}
    left = [name for name in own if name not in timed]
    if len(left) == 1:
        return left[0]
    return main.dimensions[-1] if main.dimensions[-1] in own else own[-1]


def _rows(file: NcFile, main: Any) -> dict[str, Samples]:
    """Samples of each profile by dimension of samples, where the file holds ragged arrays."""
    rows: dict[str, Samples] = {}
    for variable in file.variables.values():
        dimension = str(getattr(variable, "sample_dimension", ""))
        if not dimension:
            continue
        counts = np.ma.filled(np.ma.asarray(variable[...], dtype=np.float64), 0.0).ravel().astype(np.int64)
        length = next((v.shape[0] for v in file.variables.values() if v.dimensions == (dimension,)), counts.sum())
        if (counts < 0).any() or counts.sum() != length:
            raise InputError(file.path, f"{variable.name} counts {counts.sum()} samples, {dimension} has {length}")
        rows[dimension] = Samples(counts, slice(None))
    return rows or _indexed(file, main)


def _indexed(file: NcFile, main: Any) -> dict[str, Samples]:
    """The same of an indexed ragged array of profiles; one of trajectories, each sample with its time, is a log."""
    for variable in file.variables.values():
        instances = str(getattr(variable, "instance_dimension", ""))
        if not instances or variable.ndim != 1 or variable.dimensions != main.dimensions:
            continue
        in_time = any(v.dimensions == main.dimensions for v in file.candidates("time"))
        if in_time and "profile" not in str(file.attributes.get("featureType", "")).lower():
            continue
        index = np.ma.filled(np.ma.asarray(file.numbers(variable), dtype=np.float64), -1.0)
        sizes = {n: s for v in file.variables.values() for n, s in zip(v.dimensions, v.shape, strict=True)}
        count = sizes.get(instances, len(index))
        if count > MOST_VALUES:
            raise InputError(file.path, f"announces {count:.2g} profiles, allowed are {MOST_VALUES:.0e}")
        wrong = np.flatnonzero(~((index >= 0.0) & (index < count) & (index == np.floor(index))))
        if len(wrong):
            what = f"{variable.name} of sample {wrong[0]} is {index[wrong[0]]:g}"
            raise InputError(file.path, f"{what}; allowed are the profiles 0 to {count - 1}")
        whole = index.astype(np.int64)
        return {main.dimensions[0]: Samples(np.bincount(whole, minlength=count), np.argsort(whole, kind="stable"))}
    return {}
