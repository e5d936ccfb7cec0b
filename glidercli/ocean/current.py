"""How does the water move with depth? Current profiles from ADCP tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean.counting import counted
from glidercli.ocean.profile import wide_gaps
from glidercli.ocean.series import Moment, utc_seconds
from glidercli.ocean.source import left_out, listed, read_text
from glidercli.ocean.table import Table, TooFewError, parse_table

__all__ = [
    "BAD_VELOCITY", "DEEPEST", "EXPECTED_CURRENT", "GREATEST_SPEED", "CurrentProfile", "check_earth",
    "current_of_table", "profile_of", "read_adcp",
]  # fmt: skip

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_EAST, _NORTH, _UP = "current_east_m_s", "current_north_m_s", "current_up_m_s"
EXPECTED_CURRENT = (
    f"a current profile is a table with depth_m, {_EAST}, {_NORTH} and, if measured, {_UP}; or NetCDF, RDI PD0, "
    "Nortek .ad2cp"
)
GREATEST_SPEED = 5.0  # m/s; the strongest tidal streams reach about that
BAD_VELOCITY = -32.768  # m/s: -32768 mm/s, the mark of a bad velocity in RDI and Nortek files
DEEPEST = 12000.0  # m
_FRAMES = ("coord_sys", "coordinate_system")


@dataclass(frozen=True)
class CurrentProfile:
    """Current by depth over ground, in the earth frame.

    depth : (n,), m, positive down, strictly increasing.
    east, north, up : (n,), m/s, where the water goes; up is zero where it was not measured.
    dropped : bins left out, as (reason, count).
    warnings : one line each, without the file's name.
    reconstructed : whether the file says that it is a reconstruction.
    moment : when it holds, of a profile among several; None of a single one, which always holds.
    own_moment : when it was measured, of a single one that tells.
    """

    depth: Array
    east: Array
    north: Array
    up: Array
    source: Path
    dropped: tuple[tuple[str, int], ...]
    warnings: tuple[str, ...]
    reconstructed: bool = False
    moment: Moment | None = None
    own_moment: Moment | None = None

    @property
    def records(self) -> int:
        """Bins in the file: those kept and those dropped."""
        return len(self.depth) + sum(count for _, count in self.dropped)


def read_adcp(path: str | Path) -> CurrentProfile:
    """The current profile of a table with the columns of the contract, one row for each depth bin.

    A bin that lacks a component (empty or NaN), carries the mark -32.768 or exceeds 5 m/s is left out and counted;
    it never becomes zero. Nothing is put in its place here: see profile.py for what holds between the bins kept.

    Raises
    ------
    InputError
        The file or a column cannot be used, a cell is no number, depths do not increase, or no bin is left.
    """
    path = Path(path)
    return current_of_table(parse_table(path, read_text(path, EXPECTED_CURRENT), EXPECTED_CURRENT))


def current_of_table(table: Table) -> CurrentProfile:
    """The profile of a table's rows; TooFewError where fewer than two can be used."""
    path = table.path
    missing = tuple(name for name in ("depth_m", _EAST, _NORTH) if name not in table)
    if missing:
        raise InputError(
            path, f"has no column {listed(missing)}; its columns are {listed(table.columns)}; {EXPECTED_CURRENT}"
        )
    depth = table.increasing("depth_m", 0.0, DEEPEST)
    measured = [table.measured(name) for name in (_EAST, _NORTH, _UP) if name in table]
    east, north = measured[:2]
    up = measured[2] if _UP in table else np.zeros(len(table))
    velocity = np.stack([east, north, up])

    good = np.ones(len(table), dtype=bool)
    dropped = counted(_faults(velocity, "gap (empty or NaN)"), good)
    if not good.any():
        reasons = ", ".join(f"{count} {reason}" for reason, count in dropped)
        raise TooFewError(path, f"has no usable bin among {len(table)}: {reasons}; at least two are needed")
    if good.sum() < 2:
        line = table.lines[int(np.flatnonzero(good)[0])]
        raise TooFewError(path, f"line {line}: is the only usable bin of its profile; at least two are needed")
    unknown = table.unknown((_EAST, _NORTH, _UP, *_FRAMES))
    warnings = left_out(dropped, len(table), "bins")
    if dropped and good.sum() > 1:
        widest = float(np.diff(depth[good]).max())
        warnings += (f"the current is interpolated between the bins kept, over up to {widest:g} m",)
    warnings += wide_gaps(depth[good], "bin")
    if unknown:
        warnings += (f"columns not known and not used: {listed(unknown)}",)
    profile = (depth[good], east[good], north[good], up[good])
    return CurrentProfile(*profile, path, dropped, warnings, table.reconstructed, None, _own_moment(table))


def check_earth(table: Table) -> None:
    """Refuse a table that says its velocities are not in the earth frame."""
    for name in (name for name in _FRAMES if name in table):
        for line, cell in zip(table.lines, table.cells[name], strict=True):
            if cell.lower() not in ("", "earth", "enu"):
                raise InputError(
                    table.path, f"line {line}: {name} = {cell}: the current is not in the earth frame; allowed is earth"
                )


def profile_of(
    path: Path, depth: Array, velocity: Array, inside: Mask, faults: Sequence[tuple[str, Mask]]
) -> CurrentProfile | tuple[tuple[str, int], ...]:
    """The profile of an instrument's bins by increasing depth; only what was left out where it has fewer than two.

    depth : (n,), m. velocity : (2 or 3, n), m/s: east, north and perhaps up. inside : (n,), which bins there are.
    faults : more that is wrong with bins, by reason, each (n,).
    """
    kept = inside.copy()
    with np.errstate(invalid="ignore"):
        outside = (depth < 0.0) | (depth > DEEPEST)
    more = [("above the surface or deeper than any sea", outside)]
    dropped = counted([*faults, *_faults(velocity, "gap"), *more], kept)
    order = np.flatnonzero(kept)
    order = order[np.argsort(depth[order], kind="stable")]
    again = np.concatenate([[False], np.diff(depth[order]) == 0.0]) if len(order) else np.zeros(0, dtype=bool)
    order = order[~again]
    dropped += (("repeated depth", int(again.sum())),) if again.any() else ()
    if len(order) < 2:
        return (*dropped, ("in a profile of a single bin", 1)) if len(order) else dropped
    up = velocity[2, order] if len(velocity) > 2 else np.zeros(len(order))
    return CurrentProfile(depth[order], velocity[0, order], velocity[1, order], up, path, dropped, ())


def _faults(velocity: Array, gap: str) -> list[tuple[str, Mask]]:
    """What is wrong with bins, (2 or 3, n), by reason. gap : what an empty one is called."""
    with np.errstate(invalid="ignore"):
        return [
            (gap, np.isnan(velocity).any(axis=0)),
            (
                f"bad-velocity mark {BAD_VELOCITY}",
                np.isclose(velocity, BAD_VELOCITY, rtol=0.0, atol=5e-4).any(axis=0),
            ),
            (f"faster than {GREATEST_SPEED:g} m/s", np.linalg.norm(velocity, axis=0) > GREATEST_SPEED),
        ]


def _own_moment(table: Table) -> Moment | None:
    """The time of the first row, where it can be read."""
    if "time_utc" not in table:
        return None
    seconds = utc_seconds(table.cells["time_utc"][0])
    return None if seconds is None else Moment(seconds, True)
