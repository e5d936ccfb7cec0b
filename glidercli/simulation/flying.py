"""How is a flight flown and logged? As it is, or as the instruments aboard read it; whole, or given away in pieces."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.ocean.ocean import Ocean
from glidercli.simulation.flight import Flight, fly
from glidercli.simulation.task import Task
from glidercli.simulation.to_log import to_log, with_events
from glidercli.vehicle import Vehicle

if TYPE_CHECKING:
    from glidercli.simulation.instruments.suite import Suite

__all__ = ["flown"]


def flown(
    wanted: Task, ocean: Ocean, p: Any, craft: Vehicle, metadata: dict[str, str], *, every: float, rtol: float,
    full: bool, piece: Callable[[Log], None] | None, progress: Any, file: Path | None, suite: Suite | None,
) -> tuple[Flight, Log, Log]:  # fmt: skip
    """The flight, its log and its last sample.

    piece : gets the log in pieces; the one returned is then the last of them. suite : the instruments whose readings
    the log holds; without any it is the flight itself. file : named in errors. Others as of ``fly``.
    """

    def logged(times: Any, samples: Any) -> Log:
        return to_log(
            times, samples, start_ns=wanted.start_ns, place=wanted.place, stratified=ocean.stratified,
            has_temperature=ocean.has_temperature, has_current=ocean.moving, metadata=metadata,
        )  # fmt: skip

    read: list[Log] = []

    def give(times: Any, samples: Any) -> None:
        log = logged(times, samples)
        if suite:
            log = suite.read(times, samples, log)
            if piece:
                read.clear()
            read.append(log)
        if piece:
            piece(log)

    try:
        flight = fly(
            wanted.legs,
            ocean.sea,
            p,
            duration=wanted.duration,
            start=wanted.start,
            controls=wanted.controls,
            drives=wanted.drives,
            bottom=wanted.bottom,
            floats=wanted.floats,
            every=suite.grid.step if suite else every,
            rtol=rtol,
            full=full,
            fitted_angle=craft.hydrodynamics.fitted_angle,
            give=give if piece or suite else None,
            progress=progress,
        )
    except InputError as error:
        raise InputError(file, str(error)) if file else error from None
    log = _joined(read) if suite else logged(flight.times, flight.samples)
    return flight, with_events(log, flight, wanted.start_ns), logged(flight.times[-1:], flight.samples[-1:])


def _joined(pieces: Sequence[Log]) -> Log:
    """Pieces of one log, one after the other, as one."""
    channels = {
        name: Channel(
            name,
            np.concatenate([piece[name].time_ns for piece in pieces]),
            np.concatenate([piece[name].values for piece in pieces]),
            first.origin,
        )
        for name, first in pieces[0].channels.items()
    }
    return dataclasses.replace(pieces[0], channels=channels)
