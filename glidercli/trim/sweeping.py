"""How do trims change with one pin, or two? Every point of a grid of pins, solved; compiled where there are many."""

from __future__ import annotations

import concurrent.futures
import math
import os
from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError, NoSolutionError, UsageError
from glidercli.kernel import kernel, runner
from glidercli.model.parameters import Parameters, symmetric
from glidercli.ocean.water import Water
from glidercli.trim.atlas import atlas, chart
from glidercli.trim.forward import CONTROLS, MOST_FOUND, from_controls
from glidercli.trim.pins import QUANTITIES, Question, allowed, question, spelled
from glidercli.trim.result import LATERAL, ROTATION, ROUNDED
from glidercli.trim.search import search_all
from glidercli.trim.table import HORIZONTAL, columns, linear_models, quantities, ranks, why_no_glide
from glidercli.units import DEGREE
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["MOST_POINTS", "Axis", "TrimMap", "axis", "trims_over"]

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

MOST_POINTS = 1_000_000
"""Points of a map; each takes some 0.1 ms and, as a row of a table, 200 bytes."""

_CHUNK = 2000
_FOLLOWED = 2
"""Trims of the atlas that are followed to a point that no tetrahedron holds; a single question follows more."""


class Axis(NamedTuple):
    """A pin that is swept, and its values, SI and rad."""

    name: str
    values: Array


class TrimMap(NamedTuple):
    """Trims over a grid of pins.

    axes : what was swept. table : a column each of ``Trim.document``, a row each trim; the trims of one point stand
    together, the first-ranked first. point (m,) : the grid point of each row, numbered with the last axis fastest.
    solution (m,) : 1 for the first-ranked of its point. missing : why points have no trim, by number.
    """

    axes: tuple[Axis, ...]
    table: dict[str, NDArray[Any]]
    point: Integers
    solution: Integers
    missing: dict[int, str]
    warnings: list[str]
    """What a reader must know besides the numbers: counts of points without a trim, and of trims to doubt."""
    linear: Array | None
    """(m, 8, 8), the linear model of each where it was asked for: stability.py."""

    @property
    def points(self) -> int:
        """How many points the grid has."""
        return math.prod(len(one.values) for one in self.axes)

    def at(self, number: int) -> dict[str, float]:
        """The swept values of a grid point, in the units of the tables."""
        places = np.unravel_index(number, [len(one.values) for one in self.axes])
        return {
            f"{one.name}_{_suffix(one.name)}": float(one.values[i]) / QUANTITIES[one.name].factor
            for one, i in zip(self.axes, places, strict=True)
        }

    def grid(self, column: str) -> Array:
        """A column at the first-ranked trim of every point, in the shape of the axes; NaN where there is none."""
        filled = np.full(self.points, np.nan)
        first = self.solution == 1
        filled[self.point[first]] = self.table[column][first]
        return filled.reshape([len(one.values) for one in self.axes])


def axis(text: str) -> Axis:
    """NAME=START:STOP:STEP as an axis; the unit is that of the option NAME, and STOP counts where a step meets it.

    Raises UsageError for text of another form, InputError for numbers that make no sweep.
    """
    name, _, numbers = text.partition("=")
    key = name.strip().removeprefix("--").replace("-", "_")
    if key not in QUANTITIES:
        names = ", ".join(spelled(one)[2:] for one in QUANTITIES)
        raise UsageError(f"--sweep {text}: {name.strip() or 'nothing'} is no pin; one of {names}")
    parts = numbers.split(":")
    try:
        start, stop, step = map(float, parts)
    except ValueError:
        raise UsageError(f"--sweep {text}: NAME=START:STOP:STEP is needed, three numbers") from None
    if not all(map(math.isfinite, (start, stop, step))):
        raise InputError(f"--sweep {text}", "finite numbers are needed")
    if step == 0.0:
        raise InputError(f"--sweep {text}", "a step of 0 goes nowhere; another is needed")
    if (stop - start) * step < 0.0:
        raise InputError(f"--sweep {text}", f"is reversed: steps of {step:g} lead away from {stop:g}")
    count = math.floor((stop - start) / step + 1e-9) + 1
    if count > MOST_POINTS:
        raise InputError(f"--sweep {text}", f"has {count:,} points; at most {MOST_POINTS:,} are allowed")
    values = np.round(start + step * np.arange(count), 12)  # 0 where rounding would leave 1e-17
    return Axis(key, values * QUANTITIES[key].factor)


def trims_over(
    axes: tuple[Axis, ...], fixed: Mapping[str, float], craft: Vehicle, equations: str, water: Water, p: Parameters,
    *, linearize: bool = False, progress: Callable[[float, float], None] | None = None,
) -> TrimMap:  # fmt: skip
    """Every trim at every point of a grid. axes and fixed : three pins in all, SI and rad.

    linearize : whether the linear model of each is wanted. progress : is told the points searched and those to search.

    Raises
    ------
    UsageError
        Not three pins, a pin both swept and fixed, dependent or contradictory pins.
    InputError
        Too many points, or values that no vehicle can have.
    NoSolutionError
        No point has a trim.
    """
    twice = [spelled(one.name) for one in axes if one.name in fixed or [o.name for o in axes].count(one.name) > 1]
    if twice:
        raise UsageError(f"contradictory pins: {twice[0]} is swept and given, or swept twice")
    count = math.prod(len(one.values) for one in axes)
    if count > MOST_POINTS:
        shape = " x ".join(f"{len(one.values):,}" for one in axes)
        raise InputError("--sweep", f"{shape} = {count:,} points; at most {MOST_POINTS:,} are allowed")
    found, missing = _solved(axes, fixed, craft, equations == "paper", water, p, progress)
    if not len(found.x):
        reasons = sorted(set(missing.values()))
        raise NoSolutionError(f"none of the {count:,} points of the sweep has a trim: {'; '.join(reasons)}")
    run = runner(len(found.x))
    parts = [
        columns(found.x[i : i + _CHUNK], found.iterations[i : i + _CHUNK], craft, water, p, run, equations=equations)
        for i in range(0, len(found.x), _CHUNK)
    ]
    table = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    order = np.lexsort((ranks(found.x, table, craft.actuators.mass_position.nominal), found.point))
    table = {name: column[order] for name, column in table.items()}
    x, point = found.x[order], found.point[order]
    first = np.concatenate([[True], point[1:] != point[:-1]])
    begin = np.maximum.accumulate(np.where(first, np.arange(len(point)), 0))
    solution = np.arange(len(point)) - begin + 1
    warnings = _warnings(x, table, solution, missing, craft, count)
    linear = run(linear_models, x, water, p) if linearize else None
    return TrimMap(axes, table, point, solution, missing, warnings, linear)


def _warnings(
    x: Array, table: Mapping[str, NDArray[Any]], solution: Integers, missing: Mapping[int, str], craft: Vehicle,
    points: int,
) -> list[str]:  # fmt: skip
    """What a reader of a sweep must know besides its numbers."""
    told = []
    if missing:
        reasons = "; ".join(f"{n} {reason}" for reason, n in Counter(missing.values()).most_common())
        told.append(f"{len(missing)} of {points} points have no trim: {reasons}")
    fitted = craft.hydrodynamics.fitted_angle
    first = solution == 1
    for mask, what in (
        (~table["within_limits"], f"are beyond the limits of {craft.name}"),
        (~table["stable"], "are not stable"),
        (np.abs(x[:, 1]) > fitted, f"have an angle of attack beyond the fitted {fitted / DEGREE:g} deg"),
        (np.abs(x[:, 2]) > fitted, f"have a sideslip beyond the fitted {fitted / DEGREE:g} deg"),
    ):
        if mask[first].any():
            told.append(f"{int(mask[first].sum())} of {int(first.sum())} first-ranked trims {what}")
    if not first.all():
        told.append(f"{int((solution == 2).sum())} points have further trims, ranked behind: solution 2 and above")
    return told


class _Found(NamedTuple):
    """Trims x (m, 9), their iterations and grid points (m,)."""

    x: Array
    iterations: Integers
    point: Integers


def _joined(parts: list[_Found]) -> _Found:
    """All of them as one; of none, one without trims."""
    none = _Found(np.zeros((0, 9)), np.zeros(0, np.int64), np.zeros(0, np.int64))
    columns = zip(*(none, *parts), strict=True)
    x, iterations, point = (np.concatenate(column) for column in columns)
    return _Found(x, iterations, point)


def _solved(
    axes: tuple[Axis, ...], fixed: Mapping[str, float], craft: Vehicle, printed: bool, water: Water, p: Parameters,
    progress: Callable[[float, float], None] | None,
) -> tuple[_Found, dict[int, str]]:  # fmt: skip
    """Every glide at every point, and why other points have none."""
    count = math.prod(len(one.values) for one in axes)
    grids = np.meshgrid(*(one.values for one in axes), indexing="ij")
    pinned = {name: np.full(count, value) for name, value in fixed.items()}
    pinned |= {one.name: grid.ravel() for one, grid in zip(axes, grids, strict=True)}
    if not all(len(one.values) for one in axes):
        raise InputError("--sweep", "an empty sweep has no points")
    reason = _impossible(axes, pinned, craft)
    parts = []
    searched = 0

    def seen(points: int) -> None:
        nonlocal searched
        searched += points
        if progress is not None:
            progress(searched, count)

    for asked, points in _questions(pinned, reason, craft, symmetric(p)):
        values = np.column_stack([_curved(name, pinned[name][points]) for name in asked.names])
        for k, (name, pin) in enumerate(zip(asked.names, asked.pins, strict=True)):
            if pin != QUANTITIES[name].place:
                values[:, k] = 0.0  # a straight glide, asked for by another name
        parts.append(_searched(asked, points, values, craft, printed, water, p, seen))
    found = _joined(parts)
    if symmetric(p):
        straight = (found.x[:, ROTATION] == 0.0) & (np.abs(found.x[:, LATERAL]).max(axis=1, initial=0.0) < ROUNDED)
        found.x[np.ix_(straight, LATERAL)] = 0.0
    run = runner(len(found.x))
    why = why_no_glide(found.x, run(quantities, found.x, printed, water, p)[:, HORIZONTAL], craft)
    for number, one in zip(found.point.tolist(), why.tolist(), strict=True):
        if one:
            reason[number] = f"{one} flight"
    found = _Found(*(column[why == ""] for column in found))
    solved = set(found.point.tolist())
    return found, {i: reason.get(i, "none found") for i in range(count) if i not in solved}


def _curved(name: str, values: Array) -> Array:
    """Pinned values as the solver takes them: a turning radius as its curvature."""
    return 1.0 / values if name == "turning_radius" else values


def _impossible(axes: tuple[Axis, ...], pinned: Mapping[str, Array], craft: Vehicle) -> dict[int, str]:
    """Points whose swept values are no glide's: vertical, stalled, neutral. InputError for values of no vehicle."""
    reason: dict[int, str] = {}
    for one in axes:
        for value in one.values.tolist():
            try:
                allowed(one.name, value, craft)
            except NoSolutionError as error:
                reason |= dict.fromkeys(np.flatnonzero(pinned[one.name] == value).tolist(), str(error))
    return reason


def _questions(
    pinned: Mapping[str, Array], reason: dict[int, str], craft: Vehicle, alike: bool
) -> list[tuple[Question, Integers]]:
    """Questions with the points that ask them: one, or more where swept pins pass through straight flight or contradict
    one another.

    Points whose pins contradict or depend on one another get that as their reason; if all do, it is raised.
    """
    count = len(next(iter(pinned.values())))
    open_points = np.array([i not in reason for i in range(count)])
    straight = np.zeros(count, dtype=int)
    for bit, (name, values) in enumerate(pinned.items()):
        if alike and QUANTITIES[name].lateral:
            straight |= (np.isinf(values) if name == "turning_radius" else values == 0.0).astype(int) << bit
    straight |= _turns_wrongly(pinned).astype(int) << len(pinned)
    asked: list[tuple[Question, Integers]] = []
    refused: UsageError | None = None
    for kind in np.unique(straight[open_points]).tolist():
        points = np.flatnonzero(open_points & (straight == kind))
        try:
            one = question({name: float(values[points[0]]) for name, values in pinned.items()}, craft, alike)
        except UsageError as error:
            refused = error
            reason |= dict.fromkeys(points.tolist(), str(error))
        else:
            asked.append((one, points))
    if refused is not None and not asked:
        raise refused
    return asked


def _turns_wrongly(pinned: Mapping[str, Array]) -> NDArray[np.bool_]:
    """Where a yaw rate and a turning radius turn to different sides, or faster than the speed allows."""
    rate, radius = pinned.get("yaw_rate"), pinned.get("turning_radius")
    if rate is None or radius is None:
        return np.zeros(len(next(iter(pinned.values()))), dtype=bool)
    return (rate * radius <= 0.0) | (rate * radius > pinned.get("speed", np.inf))


def _searched(
    asked: Question, points: Integers, values: Array, craft: Vehicle, printed: bool, water: Water, p: Parameters,
    told: Callable[[int], None],
) -> _Found:  # fmt: skip
    """Every trim at the points of one question, chunk by chunk on all cores. told : how many points each chunk had."""
    nominal = craft.actuators.mass_position.nominal
    seen = None if asked.pins == CONTROLS else chart(atlas(craft.actuators, printed, water, p), asked.pins)
    run = runner(len(points))

    def chunk(begin: int) -> Any:
        some = values[begin : begin + _CHUNK]
        if seen is None:
            return run(forward_all, some, nominal, water, p)
        return run(search_all, some, asked.pins, seen, _FOLLOWED, False, printed, water, p)

    chunks = [chunk(0)]  # compiles, where need be, in one thread
    told(len(chunks[0][2]))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        try:
            for done in pool.map(chunk, range(_CHUNK, len(points), _CHUNK)):
                chunks.append(done)
                told(len(done[2]))
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            raise
    x, iterations, counts = map(np.concatenate, zip(*chunks, strict=True))
    there = np.arange(MOST_FOUND) < counts[:, np.newaxis]
    return _Found(x[there], iterations[there], np.repeat(points, counts))


@kernel
def forward_all(controls: Array, nominal: float, water: Water, p: Parameters) -> tuple[Array, Integers, Integers]:
    """``from_controls`` at every row r_rx, gamma, m_b: trims (n, MOST_FOUND, 9), iterations, counts (n,)."""
    n = len(controls)
    found, iterations = np.zeros((n, MOST_FOUND, 9)), np.zeros((n, MOST_FOUND), np.int64)
    counts = np.zeros(n, np.int64)
    for i in range(n):
        rrx, gamma, mb = float(controls[i, 0]), float(controls[i, 1]), float(controls[i, 2])
        found[i], iterations[i], counts[i], _ = from_controls(rrx, gamma, mb, nominal, water, p)
    return found, iterations, counts


def _suffix(name: str) -> str:
    """The unit of a quantity as the columns of tables spell it."""
    return QUANTITIES[name].unit.replace("/", "_")
