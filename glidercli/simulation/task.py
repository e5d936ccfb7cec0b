"""What is to be flown, of all that was asked for? A mission, held controls, a trim or recorded actuators, made one."""

from __future__ import annotations

import dataclasses
import datetime
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.errors import InputError, UsageError
from glidercli.simulation.actuators import Drives
from glidercli.simulation.legs import Leg, held
from glidercli.simulation.planning import drives_of, plan
from glidercli.simulation.recorded import controls_of, place_of, source_of, start_of
from glidercli.simulation.settling import settled_controls
from glidercli.simulation.start import Start, from_trim
from glidercli.vehicle.controls import check_controls
from glidercli.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from glidercli.log import Log
    from glidercli.model.parameters import Parameters
    from glidercli.simulation.mission import Mission

__all__ = ["Task", "task"]

DEFAULT_DURATION = 3600.0  # s, of a flight with held controls


@dataclasses.dataclass(frozen=True)
class Task:
    """A flight to be flown.

    controls : of the start (m, rad, kg). floats : whether the surface may hold the vehicle.
    duration : s, infinite where the legs end it. start_ns : UTC since 1970, None for an arbitrary date.
    place : latitude and longitude of the start, deg. bottom : m.
    files : inputs that it was made from; reconstructed : those that say they are reconstructions.
    """

    legs: list[Leg]
    drives: Drives
    start: Start
    controls: tuple[float, float, float]
    floats: bool
    duration: float
    start_ns: int | None
    place: tuple[float, float] | None
    bottom: float
    files: list[Path]
    reconstructed: list[Path]
    warnings: list[str]


def task(
    mission: tuple[Mission, Path] | None,
    craft: Vehicle,
    p: Parameters,
    *,
    given: Mapping[str, float | None],
    trim: Mapping[str, Any] | None = None,
    controls: Log | None = None,
    initial: Log | None = None,
    start_depth: float | None = None,
    duration: float | None = None,
) -> Task:
    """Join what was asked for into one flight.

    given : mass_position (m), mass_rotation (rad), net_buoyancy (kg) that are held, or None.
    Raises UsageError where two things set the same, or nothing sets the controls.
    """
    told = [name.replace("_", " ") for name, value in given.items() if value is not None]
    if mission and (told or controls):
        what = ", ".join([*told, *(["--controls"] if controls else [])])
        raise UsageError(f"mission {mission[0].name} sets the controls; {what} cannot be given beside it")
    if trim and told:
        raise UsageError(f"--trim sets the controls; {', '.join(told)} cannot be given beside it")
    if trim and initial:
        raise UsageError("--trim and --initial both set how the flight begins; leave one out")
    if mission:
        made = _of_mission(*mission, craft, p)
    elif controls:
        made = _of_recording(controls, initial, craft, p, dict(given), duration)
    else:
        made = _of_held(given, trim, craft, duration)
    if trim:
        start = from_trim(trim, made.start.depth, made.start.heading)
        made = dataclasses.replace(made, start=start)
        if made.legs[0].steered:
            made = dataclasses.replace(made, controls=_controls_of(trim))
    if initial:
        made = _begun_as(made, initial, p, start_depth)
    if start_depth is not None:
        made = dataclasses.replace(made, start=dataclasses.replace(made.start, depth=start_depth))
    return dataclasses.replace(made, duration=made.duration if duration is None else duration)


def _of_mission(mission: Mission, path: Path, craft: Vehicle, p: Parameters) -> Task:
    planned = plan(mission, path, craft, p)
    for leg in {id(leg): leg for leg in planned.legs}.values():
        _check_table(leg, craft)
    first = planned.legs[0]
    a = craft.actuators
    nominal = (a.mass_position.nominal, a.mass_rotation.nominal, a.net_buoyancy.nominal)
    has_place = mission.latitude is not None and mission.longitude is not None
    return Task(
        legs=planned.legs,
        drives=planned.drives,
        start=Start(mission.start_depth_m, heading=math.radians(mission.heading_deg)),
        controls=nominal if first.steered else _first_row(first),
        floats=planned.steered,
        duration=math.inf if mission.duration_s is None else mission.duration_s,
        start_ns=None if mission.start_time is None else _since_1970(mission.start_time),
        place=(float(mission.latitude or 0.0), float(mission.longitude or 0.0)) if has_place else None,
        bottom=math.inf if mission.bottom_m is None else mission.bottom_m,
        files=[path, *planned.files],
        reconstructed=planned.reconstructed,
        warnings=[],
    )


def _of_held(
    given: Mapping[str, float | None], trim: Mapping[str, Any] | None, craft: Vehicle, duration: float | None
) -> Task:
    if trim:
        row = _controls_of(trim)
    else:
        missing = [name.replace("_", " ") for name, value in given.items() if value is None]
        if missing:
            raise UsageError(f"{', '.join(missing)} missing; give all three controls, a mission, --trim or --controls")
        row = (_known(given["mass_position"]), _known(given["mass_rotation"]), _known(given["net_buoyancy"]))
    check_controls(craft, *row)
    return Task(
        legs=[held(*row)], drives=drives_of(craft), start=Start(), controls=row, floats=False,
        duration=DEFAULT_DURATION, start_ns=None, place=None, bottom=math.inf, files=[], reconstructed=[],
        warnings=[],
    )  # fmt: skip


def _of_recording(
    controls: Log,
    initial: Log | None,
    craft: Vehicle,
    p: Parameters,
    given: dict[str, float | None],
    duration: float | None,
) -> Task:
    if initial is not None and ("time_note" in controls.metadata) != ("time_note" in initial.metadata):
        without, other = sorted((controls, initial), key=lambda log: "time_note" not in log.metadata)
        raise InputError(
            source_of(without), f"has times since its start only, and {source_of(other)} has dates; needed are logs on "
            "the same clock"
        )  # fmt: skip
    zero = int(initial["depth"].time_ns[0]) if initial is not None and "depth" in initial else None
    leg, zero, warnings = controls_of(controls, zero, craft, p, given)
    _check_table(leg, craft)
    lasts = float(leg.times[-1])
    if lasts <= 0.0 and duration is None:
        raise InputError(
            source_of(controls), f"its last control sample stands at {lasts:.1f} s of the flight, which begins at 0 s; "
            "--duration says how long to fly"
        )  # fmt: skip
    dated = "time_note" not in controls.metadata
    return Task(
        legs=[leg], drives=drives_of(craft), start=Start(), controls=_row_at_start(leg), floats=True, duration=lasts,
        start_ns=zero if dated else None, place=None, bottom=math.inf, files=[],
        reconstructed=_remade(controls), warnings=warnings,
    )  # fmt: skip


def _begun_as(made: Task, initial: Log, p: Parameters, depth: float | None) -> Task:
    """The task, begun as a recording shows it at its first depth sample."""
    start, warnings = start_of(initial, depth, settled_controls(made.controls, p))
    dated = "time_note" not in initial.metadata
    return dataclasses.replace(
        made,
        start=start,
        floats=True,
        legs=[dataclasses.replace(leg, surface_ends=False) if not leg.steered else leg for leg in made.legs],
        start_ns=int(initial["depth"].time_ns[0]) if dated else made.start_ns,
        place=place_of(initial) or made.place,
        reconstructed=[*made.reconstructed, *_remade(initial)],
        warnings=[*made.warnings, *warnings],
    )


def _check_table(leg: Leg, craft: Vehicle) -> None:
    """Refuse a table of controls that no vehicle can have."""
    for row in leg.extremes:
        check_controls(craft, *row)


def _remade(log: Log | None) -> list[Path]:
    """The file of a log that is, or was made from, a reconstruction."""
    if log is None or not (log.origin == "reconstruction" or "reconstruction" in log.metadata):
        return []
    return [Path(source_of(log))]


def _controls_of(trim: Mapping[str, Any]) -> tuple[float, float, float]:
    return float(trim["mass_position_m"]), math.radians(trim["mass_rotation_deg"]), float(trim["net_buoyancy_kg"])


def _first_row(leg: Leg) -> tuple[float, float, float]:
    position, rotation, buoyancy = leg.values[0].tolist()
    return position, rotation, buoyancy


def _row_at_start(leg: Leg) -> tuple[float, float, float]:
    """The recorded controls at zero."""
    position, rotation, buoyancy = (float(np.interp(0.0, leg.times, column)) for column in leg.values.T)
    return position, rotation, buoyancy


def _known(value: float | None) -> float:
    assert value is not None
    return value


def _since_1970(moment: datetime.datetime) -> int:
    """ns; a time without a zone is UTC."""
    utc = moment.astimezone(datetime.UTC) if moment.tzinfo else moment.replace(tzinfo=datetime.UTC)
    return int((utc - datetime.datetime(1970, 1, 1, tzinfo=datetime.UTC)) / datetime.timedelta(microseconds=1)) * 1000
