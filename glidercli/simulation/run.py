"""What happens in one simulation? Inputs read and checked, the legs flown, the Log and its warnings made."""

from __future__ import annotations

import contextlib
import dataclasses
import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.errors import InputError
from glidercli.files import check_not_inputs
from glidercli.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from glidercli.log import Log
    from glidercli.simulation.energy import Costs
    from glidercli.simulation.flight import Excursion, Flight
    from glidercli.simulation.instruments.settings import Instruments
    from glidercli.simulation.instruments.suite import Suite
    from glidercli.simulation.mission import Mission
    from glidercli.simulation.task import Task

__all__ = ["Simulation", "simulate"]

RTOL = (1e-13, 1e-3)  # rounding; at 1e-3 an hour's spiral ends 4 cm, the shipped trial 1 cm from the exact one
DEEPEST = 12000.0  # m; the deepest trench has 10,935


@dataclasses.dataclass(frozen=True)
class Simulation:
    """A simulated flight.

    log : every sample, or with instruments what they read; of a flight that was given away in pieces, the last piece,
    with all events. last : the flight's last sample, whatever instruments are aboard. distance : m, over
    ground along the horizontal track. net_buoyancy_in_water : kg, sinking positive, at the end: what was pumped and
    what the hull displaces there. excursions : roll beyond 90 deg, the flow's angles beyond the fitted one. wall : s of
    integration alone. inputs : files that it was made from.
    """

    log: Log
    last: Log
    duration: float
    max_depth: float
    distance: float
    costs: Costs
    net_buoyancy_in_water: float
    excursions: tuple[Excursion, ...]
    wall: float
    warnings: tuple[str, ...]
    inputs: tuple[Path, ...]
    suite: Suite | None = None

    @property
    def seed(self) -> int | None:
        """Of the instruments; None without any."""
        return self.suite.seed if self.suite else None

    def document(self) -> dict[str, Any]:
        """The contract's JSON. All but ``instruments`` is of the flight, not of what instruments read."""
        table = self.last.table(0)
        final = {name: table[name].iloc[-1] for name in table.columns if name != "time_utc"}
        start = next(event.time_ns for event in self.log.events if event.name == "start")
        return {
            "origin": self.log.origin,
            "reconstruction": self.log.metadata.get("reconstruction"),
            "duration_s": self.duration,
            "max_depth_m": self.max_depth,
            "final": {"time_utc": f"{table['time_utc'].iloc[-1].isoformat()}Z", **final, "elapsed_s": self.duration},
            "events": [
                {"name": e.name, "time_s": (e.time_ns - start) / 1e9, "depth_m": e.depth} for e in self.log.events
            ],
            "distance_m": self.distance,
            "energy_j": self.costs.total,
            "energy": self.costs.document(),
            "net_buoyancy_in_water_kg": self.net_buoyancy_in_water,
            "seed": self.seed,
            "instruments": self.suite.document() if self.suite else None,
            "warnings": list(self.warnings),
            "wall_s": self.wall,
            "simulated_seconds_per_second": self.duration / self.wall if self.wall > 0.0 else None,
        }


def simulate(
    mission: str | Path | tuple[Mission, Path] | None = None,
    *,
    vehicle: Vehicle | str | None = None,
    changes: Mapping[str, Any] | None = None,
    net_buoyancy: float | None = None,
    mass_position: float | None = None,
    mass_rotation: float | None = None,
    trim: Mapping[str, Any] | None = None,
    controls: Log | None = None,
    initial: Log | None = None,
    ctd: str | Path | Log | Sequence[str | Path | Log] | None = None,
    adcp: str | Path | Log | Sequence[str | Path | Log] | None = None,
    duration: float | None = None,
    start_depth: float | None = None,
    latitude: float | None = None,
    every: float = 1.0,
    rtol: float = 1e-7,
    equations: str = "full",
    instruments: Instruments | str | Path | None = None,
    seed: int | None = None,
    outputs: Collection[Path] = (),
    inputs: Iterable[Path] = (),
    piece: Callable[[Log], None] | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> Simulation:
    """Fly a mission, held controls, a trim or recorded actuators; from rest in the water, level, unless told otherwise.

    Parameters
    ----------
    mission : file, name of a shipped one, or a Mission with the file that its own files stand beside. Without one the
        three controls are held, heading north.
    vehicle : a Vehicle, name or file; default: the mission's, else seawing.
    changes : parameters of the model by their symbols (docs/reference/symbols), SI, in place of the vehicle's and the
        mission's. Their values are not checked: they may be what no vehicle can have.
    net_buoyancy : kg, sinking positive. mass_position : m. mass_rotation : rad.
    trim : a trim in the contract's names: its controls are held, and the flight begins in its motion.
    controls : a log whose actuators are flown. initial : a log whose first depth sample the flight begins at.
    ctd : cast of the water, a file or a log, or several in time; without one the water is uniform at the vehicle's
        neutral density and net buoyancy acts unchanged with depth. adcp : current by depth, likewise. Both default to
        the mission's.
    duration, every : s. start_depth : m. latitude : deg; sets gravity, 9.81 m/s2 without.
    rtol : relative tolerance of the integrator.
    equations : "full", or "paper": eq. (50) without the shear's own term, and the movable mass taken as unmoving.
    instruments : the sensors whose readings the log holds (settings.py), or a file of them; "none" for the flight as it
        is. Default: the mission's.
    seed : of their random numbers; default: the mission's, else 0.
    outputs : files that the caller will write; checked before the flight. inputs : files that trim and logs came from.
    piece : gets the log in pieces while it is flown, so that a long flight needs no more memory than a short one.
    progress : is told the seconds flown and the seconds to fly, the latter infinite if the legs decide.

    Raises
    ------
    OutputError
        An output is an input.
    InputError
        An input that cannot be used, or a vehicle that would only float.
    UsageError
        Nothing sets the controls, or two things do.
    NoSolutionError
        The motion cannot be integrated.
    """
    from glidercli.model.parameters import changed, parameters
    from glidercli.ocean.gathering import gathered_casts, gathered_currents, sources
    from glidercli.ocean.ocean import Ocean
    from glidercli.simulation.flying import flown
    from glidercli.simulation.instruments.aboard import instruments_of, suite_of
    from glidercli.simulation.mission_file import load_mission
    from glidercli.simulation.task import task
    from glidercli.vehicle import load_vehicle

    if equations not in ("full", "paper"):
        raise InputError("equations", f"{equations!r} is not allowed; full or paper")
    plan = load_mission(mission) if isinstance(mission, (str, Path)) else mission
    given_files = list(inputs)
    asked = {} if plan is None else {"vehicle": vehicle is None, "ctd": ctd is None, "adcp": adcp is None}
    if plan:
        beside = plan[1].parent
        ctd = ctd or (beside / plan[0].ctd if plan[0].ctd else None)
        adcp = adcp or (beside / plan[0].adcp if plan[0].adcp else None)
    if vehicle is None:
        vehicle = _vehicle_of(plan)
    with _for_mission(plan, asked, "vehicle"):
        craft = vehicle if isinstance(vehicle, Vehicle) else load_vehicle(vehicle)
    p = parameters(craft)
    if plan and plan[0].neutral_density_kg_m3:
        p = p._replace(rho_0=plan[0].neutral_density_kg_m3)
    p = changed(p, changes or {})
    _check_numbers(duration, start_depth, every, rtol)
    water, flow = sources(ctd), sources(adcp)
    water_files = [item for item in (*water, *flow) if isinstance(item, Path)]
    vehicle_files = [] if isinstance(vehicle, Vehicle) or not Path(vehicle).suffix else [Path(vehicle)]
    sensors = instruments_of(instruments, plan)
    given_files += sensors.files
    check_not_inputs(outputs, [*given_files, *vehicle_files, *water_files, *([plan[1]] if plan else [])])
    held = {"mass_position": mass_position, "mass_rotation": mass_rotation, "net_buoyancy": net_buoyancy}
    wanted = task(
        plan, craft, p, given=held, trim=trim, controls=controls, initial=initial, start_depth=start_depth,
        duration=duration,
    )  # fmt: skip
    check_not_inputs(outputs, wanted.files)
    least = sum(leg.duration for leg in wanted.legs if leg.ends_by_time_alone)
    length = wanted.duration if math.isfinite(wanted.duration) else least
    _check_samples(length, every)
    if latitude is None:
        latitude = plan[0].latitude if plan else wanted.place[0] if wanted.place else None
    with _for_mission(plan, asked, "ctd"):
        longitude = wanted.place[1] if wanted.place else None
        casts = gathered_casts(water, latitude, longitude, wanted.start_ns)
    with _for_mission(plan, asked, "adcp"):
        currents = gathered_currents(flow, latitude, wanted.start_ns)
    ocean = Ocean.build(
        p.rho_0, casts=casts, currents=currents, latitude=latitude, temperature_reference=p.T_0,
        start_ns=wanted.start_ns,
    )  # fmt: skip
    how = "recorded controls" if controls else "controls held"
    remade = list(dict.fromkeys([*ocean.reconstructed, *wanted.reconstructed]))
    metadata = _metadata(plan[0] if plan else None, craft, equations, how, remade)
    if changes:
        metadata["parameters_changed"] = ", ".join(f"{name} = {value}" for name, value in changes.items())
    suite = suite_of(sensors, seed, every=every, ocean=ocean, place=wanted.place, casts=casts)
    if suite:
        metadata |= suite.metadata() | {"title": f"{metadata['title']}, as its instruments would record it"}
        _check_samples(length, suite.grid.step, "instruments' times")
    flight, log, last = flown(
        wanted, ocean, p, craft, metadata, every=every, rtol=rtol, full=equations == "full", piece=piece,
        progress=progress, file=plan[1] if plan else None, suite=suite,
    )  # fmt: skip
    left = ocean.beyond(*flight.depths, float(flight.times[-1]))
    warnings = [*ocean.warnings, *wanted.warnings, *_warnings(flight, craft, wanted), *left]
    warnings += suite.warnings() if suite else ["seed has no effect: no instrument is aboard"] * (seed is not None)
    spent = _costs(flight, craft, wanted)
    if spent.lost_to_water < -1e-3:
        warnings.append(
            f"the water gave the vehicle {-spent.lost_to_water:.3g} J: at angles beyond the fit its forces mean nothing"
        )
    if spent.total > spent.battery:
        warnings.append(
            f"the flight needs {spent.total / 1e6:.3g} MJ, and the battery holds {spent.battery / 1e6:g} MJ"
        )
    if flight.depths[1] > DEEPEST:
        warnings.append(
            f"the flight goes down to {flight.depths[1]:.0f} m, deeper than any sea; bottom_m or a shorter duration "
            "would end it"
        )
    if ocean.stratified and not ocean.has_temperature and p.chi > 0.0:
        warnings.append("the water has no temperature: thermal expansion of the hull is left out")
    return Simulation(
        log=log,
        last=last,
        suite=suite,
        duration=float(flight.times[-1]),
        max_depth=flight.depths[1],
        distance=flight.distance,
        costs=spent,
        net_buoyancy_in_water=flight.excess,
        excursions=flight.excursions,
        wall=flight.wall,
        warnings=tuple(warnings),
        inputs=tuple(dict.fromkeys([*given_files, *vehicle_files, *wanted.files[:1], *water_files, *wanted.files[1:]])),
    )


@contextlib.contextmanager
def _for_mission(plan: tuple[Mission, Path] | None, asked: Mapping[str, bool], key: str) -> Iterator[None]:
    """Name the mission that asks for a file which cannot be used. asked : whether it is the mission that does."""
    try:
        yield
    except InputError as error:
        raise InputError(plan[1], f"{key}: {error}") if plan and asked[key] else error from None


def _check_numbers(duration: float | None, start_depth: float | None, every: float, rtol: float) -> None:
    for name, value, least in (("duration", duration, 1e-3), ("every", every, 1e-3)):
        if value is not None and not (math.isfinite(value) and value >= least):
            raise InputError(name, f"{value} s is not allowed; a finite number of at least {least:g} is needed")
    if not RTOL[0] <= rtol <= RTOL[1]:
        raise InputError("rtol", f"{rtol} is not allowed; {RTOL[0]:g} to {RTOL[1]:g} are")
    if start_depth is not None and not 0.0 <= start_depth <= DEEPEST:
        raise InputError("start depth", f"{start_depth} m is not allowed; 0 to {DEEPEST:g} are")


def _check_samples(length: float, every: float, what: str = "every") -> None:
    from glidercli.simulation.flight import MOST_SAMPLES

    if math.isfinite(length) and length / every > MOST_SAMPLES:
        raise InputError(
            f"duration, {what}",
            f"{length:g} s by {every:g} s is {length / every:.3g} samples, allowed {MOST_SAMPLES:.0e}",
        )


def _vehicle_of(plan: tuple[Mission, Path] | None) -> str:
    if plan is None:
        return "seawing"
    mission, path = plan
    return str(path.parent / mission.vehicle) if mission.vehicle.endswith(".toml") else mission.vehicle


def _metadata(plan: Mission | None, craft: Vehicle, equations: str, how: str, remade: list[Path]) -> dict[str, str]:
    """What a reader of the output should know. how : the controls of a flight without a mission."""
    told = {
        "title": plan.description if plan else f"{craft.name}, {how}",
        "vehicle": craft.name,
        "vehicle_reference": craft.reference,
        "equations": equations,
        "hull_length_m": repr(craft.hull.length),
        "hull_diameter_m": repr(craft.hull.diameter),
        "movable_eccentricity_m": repr(craft.mass.movable_eccentricity),
        "movable_nominal_position_m": repr(craft.actuators.mass_position.nominal),
    }
    if plan and plan.bottom_m is not None:
        told["bottom_depth_m"] = repr(plan.bottom_m)
    if plan and plan.reconstruction:
        told["reconstruction"] = plan.reconstruction
    elif remade:
        told["reconstruction"] = f"{', '.join(path.name for path in remade)} reconstructed, not measured"
    return told


def _costs(flight: Flight, craft: Vehicle, wanted: Task) -> Costs:
    from glidercli.simulation.energy import costs

    return costs(
        flight.tallies,
        craft,
        wanted.drives,
        duration=float(flight.times[-1]),
        distance=flight.distance,
        dives=sum(event.name in ("apogee", "lift-off") for event in flight.events),
        lost=float(flight.column("energy")[-1]),
    )


def _warnings(flight: Flight, craft: Vehicle, wanted: Task) -> list[str]:
    """Where the flight left the range that the model was fitted to, and controls beyond the vehicle's limits."""
    found = [
        f"{e.name} was beyond {'' if e.name == 'roll' else 'the fitted '}{math.degrees(e.limit):g} deg for "
        f"{e.duration:.1f} s, {e.first:.1f} to {e.last:.1f} s, largest {math.degrees(e.largest):.1f} deg"
        for e in flight.excursions
    ]
    tables = {id(leg): leg.extremes for leg in wanted.legs}.values()
    found += flight.skipped
    outside = {name for rows in tables for row in rows for name in craft.actuators.outside(*row)}
    found += [f"{name.replace('_', ' ')} is beyond the limits of {craft.name}" for name in sorted(outside)]
    return found
