"""Where do trims lie? An atlas: trims over a grid of controls, cut into tetrahedra that can be searched by any pins.

Three controls give a trim; so trims over a grid of (m_b, static pitch, gamma) are a chart of all of them. A tetrahedron
of four neighbours maps to one in any three pinned quantities; where it holds the wanted values, the trim is near, and
its corners say where to start. Every tetrahedron that holds them gives a branch.
"""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import math
import zipfile
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import OutputError
from glidercli.files import atomic
from glidercli.kernel import cache_folder
from glidercli.model.parameters import Parameters, symmetric
from glidercli.ocean.water import Water
from glidercli.trim.forward import CONTROLS, FAR_ROLL, mirrored_start, straight_first
from glidercli.trim.newton import MOST_ITERATIONS, ROUGH, follow, newton, ordinary
from glidercli.trim.steady import SLOWEST, Pins, radius_speed
from glidercli.trim.straight import position_of_pitch
from glidercli.vehicle.vehicle import Actuators

__all__ = ["Atlas", "Chart", "atlas", "chart"]

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

BUOYANCIES = (0.02, 0.06, 0.15, 0.3, 0.5, 0.75, 1.1, 2.0)
"""Shares of the largest net buoyancy of the vehicle; speed goes as the square root."""
STATIC_PITCHES = (1.0, 4.0, 10.0, 18.0, 28.0, 40.0, 53.0, 66.0, 78.0)
"""deg, that gravity alone would hold: they place the movable mass."""
ROTATIONS = (0.0, 12.0, 27.0, 43.0, 59.0, 75.0, 90.0, 108.0)
"""deg, to either side."""
MIRROR = np.array([1.0, 1.0, -1.0, -1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
"""Signs of the unknowns in the port-starboard mirror."""
LEAST_RANGE = 0.05
"""kg. Taken as the largest net buoyancy to a side that a vehicle's own range leaves out."""


class Atlas(NamedTuple):
    """trims (n, 10): the nine unknowns and 1 / R. corners (m, 4): trims at the corners of each tetrahedron. places
    (m, 4): sheet and grid cell of each."""

    trims: Array
    corners: Integers
    places: Integers


class Chart(NamedTuple):
    """An atlas seen from three pins: the pinned values of every trim and the boxes of every tetrahedron."""

    trims: Array
    corners: Integers
    places: Integers
    pinned: Array
    """(n, 3)."""
    low: Array
    """(m, 3)."""
    high: Array
    """(m, 3)."""
    size: Array
    """(3,): spread of each pinned quantity, by which distances are measured."""


def atlas(actuators: Actuators, printed: bool, water: Water, p: Parameters) -> Atlas:
    """The trims of a vehicle over the grid of BUOYANCIES, STATIC_PITCHES and ROTATIONS, diving and climbing.

    Two sheets each: the flights that go on from the straight glides, and those that lie beside them rolled to the other
    side. Holes, where no trim was found, take their tetrahedra with them. An atlas takes a second to make; it is kept
    where compiled code is kept, by everything that it depends on.
    """
    limit = actuators.net_buoyancy
    extremes = (max(limit.maximum, LEAST_RANGE), min(limit.minimum, -LEAST_RANGE))
    kept = _kept(extremes, printed, water, p)
    if kept is not None and kept.exists():
        unusable = contextlib.suppress(OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile)
        with unusable, kept.open("rb") as stream, np.load(stream) as file:
            return Atlas(file["trims"], file["corners"], file["places"])
    made = _made(extremes, printed, water, p)
    if kept is not None:
        with contextlib.suppress(OutputError), atomic(kept, force=True) as part:
            np.savez(part, **made._asdict())
    return made


def _kept(extremes: tuple[float, float], printed: bool, water: Water, p: Parameters) -> Path | None:
    """The file that an atlas is kept in; None where nothing can be kept."""
    folder = cache_folder()
    digest = hashlib.sha256(repr((extremes, printed, water, p)).encode()).hexdigest()[:16]
    return folder / f"atlas-{digest}.npz" if folder else None


def _made(extremes: tuple[float, float], printed: bool, water: Water, p: Parameters) -> Atlas:
    """An atlas between two extremes of the net buoyancy, kg."""
    trims, corners, places, used = [], [], [], 0
    for number, sheet in enumerate(sheet for largest in extremes for sheet in _sheets(largest, water, p)):
        there = np.isfinite(sheet[..., 0])
        index = np.where(there, used + np.cumsum(there).reshape(there.shape) - 1, -1)
        used += int(there.sum())
        x = sheet[there]
        speed = np.array([radius_speed(tuple(row), printed) for row in x.tolist()])
        trims.append(np.column_stack([x, x[:, 3] / np.maximum(speed, SLOWEST)]))
        own, cells = _tetrahedra(index)
        corners.append(own)
        places.append(np.column_stack([np.full(len(own), number), cells]))
    return Atlas(np.concatenate(trims), np.concatenate(corners), np.concatenate(places))


def chart(known: Atlas, pins: Pins) -> Chart:
    """The atlas as seen from three pins."""
    pinned = known.trims[:, list(pins)]
    at_corners = pinned[known.corners]
    return Chart(
        np.ascontiguousarray(known.trims[:, :9]), known.corners, known.places, np.ascontiguousarray(pinned),
        at_corners.min(axis=1), at_corners.max(axis=1), pinned.std(axis=0) + 1e-12,
    )  # fmt: skip


def _sheets(largest: float, water: Water, p: Parameters) -> tuple[Array, Array]:
    """Two arrays (buoyancies, pitches, rotations, 9), NaN where there is no trim; rotations run from port to starboard.

    largest : net buoyancy, kg, with its sign.
    """
    turns = np.radians(ROTATIONS)
    if symmetric(p):
        first, second = _one_side(largest, turns, water, p)
        return _joined(first[:, :, ::-1] * MIRROR, first), _parted(second[:, :, ::-1] * MIRROR, second)
    port, port_beside = _one_side(largest, -turns, water, p)
    starboard, starboard_beside = _one_side(largest, turns, water, p)
    return _joined(port[:, :, ::-1], starboard), _parted(port_beside[:, :, ::-1], starboard_beside)


def _one_side(largest: float, turns: Array, water: Water, p: Parameters) -> tuple[Array, Array]:
    """The two sheets with the mass turned from zero to one side, rad, in the order of ``turns``."""
    shape = (len(BUOYANCIES), len(STATIC_PITCHES), len(turns), 9)
    first, second = np.full(shape, math.nan), np.full(shape, math.nan)
    for i, j in itertools.product(range(shape[0]), range(shape[1])):
        mb = largest * BUOYANCIES[i]
        rrx = position_of_pitch(-math.copysign(math.radians(STATIC_PITCHES[j]), mb), p)
        x, _, found = straight_first(rrx, 0.0, mb, rrx, water, p, ROUGH)
        beside = None
        for k, gamma in enumerate(turns.tolist()):
            if not found:
                break
            goal = (rrx, gamma, mb)
            y, _, found = newton(x, CONTROLS, goal, False, water, p, ROUGH, MOST_ITERATIONS)
            if not (found and ordinary(y)):
                y, _, found = follow(x, CONTROLS, goal, False, water, p, ROUGH)
            if not found:
                break
            x = first[i, j, k] = y
            if abs(y[4]) > FAR_ROLL:
                start = mirrored_start((*y[:6], *goal), -y[4], 1.0) if beside is None else beside
                z, _, there = newton(start, CONTROLS, goal, False, water, p, ROUGH, MOST_ITERATIONS)
                beside = z if there and ordinary(z) and z[4] * y[4] < 0.0 else None
                if beside is not None:
                    second[i, j, k] = beside
    return first, second


def _joined(port: Array, starboard: Array) -> Array:
    """Both sides of a sheet as one, that share the flights with the mass not turned."""
    return np.concatenate([port[:, :, :-1], starboard], axis=2)


def _parted(port: Array, starboard: Array) -> Array:
    """Both sides of a sheet with a gap between them."""
    return np.concatenate([port, np.full_like(port[:, :, :1], math.nan), starboard], axis=2)


def _tetrahedra(index: Integers) -> tuple[Integers, Integers]:
    """Corners (m, 4) and cells (m, 3): every cell of the grid as six tetrahedra along one diagonal; whole ones only."""
    cells = np.stack(np.meshgrid(*(np.arange(n - 1) for n in index.shape), indexing="ij"), axis=-1).reshape(-1, 3)
    corners = []
    for order in itertools.permutations(range(3)):
        steps = np.zeros((4, 3), dtype=int)
        for step, axis in enumerate(order, start=1):
            steps[step:, axis] = 1
        at = cells[:, np.newaxis, :] + steps
        corners.append(index[at[..., 0], at[..., 1], at[..., 2]])
    all_corners, all_cells = np.concatenate(corners), np.tile(cells, (6, 1))
    whole = (all_corners >= 0).all(axis=1)
    return all_corners[whole], all_cells[whole]
