"""How does the water move with depth? Current profiles from ADCP tables."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean.profile import wide_gaps
from glidercli.ocean.series import Moment, parts
from glidercli.ocean.source import left_out, listed, read_text
from glidercli.ocean.table import Table, parse_table

__all__ = ["CurrentProfile", "read_adcp", "read_currents"]

Array = NDArray[np.float64]

_EAST, _NORTH, _UP = "current_east_m_s", "current_north_m_s", "current_up_m_s"
_ALLOWED = f"a current profile is a table with depth_m, {_EAST}, {_NORTH} and, if measured, {_UP}"
_GREATEST_SPEED = 5.0  # m/s; the strongest tidal streams reach about that
_BAD_VELOCITY = -32.768  # m/s: -32768 mm/s, the mark of a bad velocity in RDI and Nortek files
_DEEPEST = 12000.0  # m


@dataclass(frozen=True)
class CurrentProfile:
    """Current by depth over ground, in the earth frame.

    depth : (n,), m, positive down, strictly increasing.
    east, north, up : (n,), m/s, where the water goes; up is zero where it was not measured.
    dropped : bins left out, as (reason, count).
    warnings : one line each, without the file's name.
    reconstructed : whether the file says that it is a reconstruction.
    moment : when it holds, of a profile among several; None of a single one, which always holds.
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

    @property
    def records(self) -> int:
        """Bins in the file: those kept and those dropped."""
        return len(self.depth) + sum(count for _, count in self.dropped)


def read_currents(path: str | Path) -> tuple[CurrentProfile, ...]:
    """The current profiles of a table, one for each time that several rows share; see ``read_adcp`` for each."""
    path = Path(path)
    table = parse_table(path, read_text(path, _ALLOWED), _ALLOWED)
    return tuple(dataclasses.replace(_profile(part), moment=moment) for moment, part in parts(table))


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
    return _profile(parse_table(path, read_text(path, _ALLOWED), _ALLOWED))


def _profile(table: Table) -> CurrentProfile:
    path = table.path
    missing = tuple(name for name in ("depth_m", _EAST, _NORTH) if name not in table)
    if missing:
        raise InputError(path, f"has no column {listed(missing)}; its columns are {listed(table.columns)}; {_ALLOWED}")
    depth = table.increasing("depth_m", 0.0, _DEEPEST)
    measured = [table.measured(name) for name in (_EAST, _NORTH, _UP) if name in table]
    east, north = measured[:2]
    up = measured[2] if _UP in table else np.zeros(len(table))
    velocity = np.stack([east, north, up])

    gap = np.isnan(velocity).any(axis=0)
    marked = np.isclose(velocity, _BAD_VELOCITY, rtol=0.0, atol=5e-4).any(axis=0) & ~gap
    fast = (np.linalg.norm(velocity, axis=0) > _GREATEST_SPEED) & ~gap & ~marked
    faults = (
        ("gap (empty or NaN)", gap),
        (f"bad-velocity mark {_BAD_VELOCITY}", marked),
        (f"faster than {_GREATEST_SPEED:g} m/s", fast),
    )
    dropped = tuple((reason, int(bins.sum())) for reason, bins in faults if bins.any())
    good = ~(gap | marked | fast)
    if not good.any():
        reasons = ", ".join(f"{count} {reason}" for reason, count in dropped)
        raise InputError(path, f"has no usable bin among {len(table)}: {reasons}; at least two are needed")
    if good.sum() < 2:
        line = table.lines[int(np.flatnonzero(good)[0])]
        raise InputError(path, f"line {line}: is the only usable bin of its profile; at least two are needed")
    unknown = table.unknown((_EAST, _NORTH, _UP))
    warnings = left_out(dropped, len(table), "bins")
    if dropped and good.sum() > 1:
        widest = float(np.diff(depth[good]).max())
        warnings += (f"the current is interpolated between the bins kept, over up to {widest:g} m",)
    warnings += wide_gaps(depth[good], "bin")
    if unknown:
        warnings += (f"columns not known and not used: {listed(unknown)}",)
    profile = (depth[good], east[good], north[good], up[good])
    return CurrentProfile(*profile, path, dropped, warnings, table.reconstructed)
