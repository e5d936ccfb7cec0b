"""What happens in one simulation? Inputs read and checked, the legs flown, the Log and its warnings made."""

from __future__ import annotations

import dataclasses
import datetime
import math
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.errors import InputError, UsageError
from glidercli.files import check_not_inputs
from glidercli.vehicle.controls import check_controls
from glidercli.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from glidercli.log import Log
    from glidercli.ocean.ocean import Ocean
    from glidercli.simulation.flight import Flight
    from glidercli.simulation.legs import Leg
    from glidercli.simulation.mission import Mission

__all__ = ["Simulation", "simulate"]

DEFAULT_DURATION = 3600.0  # s, of a flight with held controls
RTOL = (1e-13, 1e-3)  # rounding; at 1e-3 an hour's spiral ends 4 cm, the shipped trial 1 cm from the exact one
DEEPEST = 12000.0  # m; the deepest trench has 10,935
MOST_SAMPLES = 10_000_000  # some 5 GB of log


@dataclasses.dataclass(frozen=True)
class Simulation:
    """A simulated flight.

    log : every sample. energy : J, lost to the water. distance : m, over ground along the horizontal track.
    net_buoyancy_in_water : kg, sinking positive, at the end: what was pumped and what the hull displaces there.
    wall : s of integration alone. inputs : files that it was made from.
    """

    log: Log
    duration: float
    max_depth: float
    distance: float
    energy: float
    net_buoyancy_in_water: float
    wall: float
    warnings: tuple[str, ...]
    inputs: tuple[Path, ...]

    def document(self) -> dict[str, Any]:
        """The contract's JSON."""
        table = self.log.table()
        final = {name: table[name].iloc[-1] for name in table.columns if name != "time_utc"}
        start = self.log.start_ns
        return {
            "origin": self.log.origin,
            "reconstruction": self.log.metadata.get("reconstruction"),
            "duration_s": self.duration,
            "max_depth_m": self.max_depth,
            "final": {"time_utc": f"{table['time_utc'].iloc[-1].isoformat()}Z", **final},
            "events": [
                {"name": e.name, "time_s": (e.time_ns - start) / 1e9, "depth_m": e.depth} for e in self.log.events
            ],
            "distance_m": self.distance,
            "energy_j": self.energy,
            "net_buoyancy_in_water_kg": self.net_buoyancy_in_water,
            "warnings": list(self.warnings),
            "wall_s": self.wall,
            "simulated_seconds_per_second": self.duration / self.wall if self.wall > 0.0 else None,
        }


def simulate(
    mission: str | Path | None = None,
    *,
    vehicle: Vehicle | str | None = None,
    net_buoyancy: float | None = None,
    mass_position: float | None = None,
    mass_rotation: float | None = None,
    ctd: str | Path | None = None,
    adcp: str | Path | None = None,
    duration: float | None = None,
    start_depth: float | None = None,
    latitude: float | None = None,
    every: float = 1.0,
    rtol: float = 1e-6,
    equations: str = "full",
    outputs: Collection[Path] = (),
) -> Simulation:
    """Fly a mission, or three held controls, from rest in the water, level.

    Parameters
    ----------
    mission : file, or name of a shipped one. Without one the three controls are held, heading north.
    vehicle : a Vehicle, name or file; default: the mission's, else seawing.
    net_buoyancy : kg, sinking positive. mass_position : m. mass_rotation : rad.
    ctd : cast of the water; without one the water is uniform at the vehicle's neutral density and net buoyancy acts
        unchanged with depth. adcp : current by depth. Both default to the mission's.
    duration, every : s. start_depth : m. latitude : deg; sets gravity, 9.81 m/s2 without.
    rtol : relative tolerance of the integrator.
    equations : "full", or "paper": eq. (50) without the shear's own term, and the movable mass taken as unmoving.
    outputs : files that the caller will write; checked before the flight.

    Raises
    ------
    OutputError
        An output is an input.
    InputError
        An input that cannot be used, or a vehicle that would only float.
    UsageError
        Neither a mission nor all three controls, or both.
    NoSolutionError
        The motion cannot be integrated.
    """
    from glidercli.model.parameters import parameters
    from glidercli.ocean.ocean import Ocean
    from glidercli.simulation.flight import fly
    from glidercli.simulation.mission import load_mission
    from glidercli.simulation.to_log import to_log
    from glidercli.vehicle import load_vehicle

    if equations not in ("full", "paper"):
        raise InputError("equations", f"{equations!r} is not allowed; full or paper")
    plan, path = load_mission(mission) if mission is not None else (None, None)
    beside = path.parent if path else Path()
    inputs = [path] if path else []
    if plan and not ctd and plan.ctd:
        ctd = beside / plan.ctd
    if plan and not adcp and plan.adcp:
        adcp = beside / plan.adcp
    if vehicle is None:
        vehicle = _vehicle_of(plan, beside)
    craft = vehicle if isinstance(vehicle, Vehicle) else load_vehicle(vehicle)
    if not isinstance(vehicle, Vehicle) and Path(vehicle).suffix:
        inputs.append(Path(vehicle))
    p = parameters(craft)
    if plan and plan.neutral_density_kg_m3:
        p = p._replace(rho_0=plan.neutral_density_kg_m3)
    place_latitude = latitude if latitude is not None else plan.latitude if plan else None
    ocean = _ocean(Ocean, p.rho_0, p.T_0, ctd, adcp, place_latitude)
    legs, controls_files = _legs(plan, beside, mass_position, mass_rotation, net_buoyancy)
    for leg in legs:
        for row in leg.values:
            check_controls(craft, *row)
    inputs += [Path(item) for item in (ctd, adcp) if item] + controls_files
    check_not_inputs(outputs, inputs)
    remade = [*ocean.reconstructed, *(f for f, leg in zip(controls_files, legs, strict=False) if leg.reconstructed)]
    length = _first(duration, plan.duration_s if plan else None, DEFAULT_DURATION)
    depth = _first(start_depth, plan.start_depth_m if plan else None, 0.0)
    for name, value, least in (("duration", length, 1e-3), ("every", every, 1e-3)):
        if not (math.isfinite(value) and value >= least):
            raise InputError(name, f"{value} s is not allowed; a finite number of at least {least:g} is needed")
    if not RTOL[0] <= rtol <= RTOL[1]:
        raise InputError("rtol", f"{rtol} is not allowed; {RTOL[0]:g} to {RTOL[1]:g} are")
    if length / every > MOST_SAMPLES:
        raise InputError(
            "duration, every",
            f"{length:g} s by {every:g} s is {length / every:.3g} samples, allowed {MOST_SAMPLES:.0e}",
        )
    if not 0.0 <= depth <= DEEPEST:
        raise InputError("start depth", f"{depth} m is not allowed; 0 to {DEEPEST:g} are")
    flight = fly(
        legs,
        ocean.sea,
        p,
        duration=length,
        start_depth=depth,
        heading=math.radians(plan.heading_deg) if plan else 0.0,
        every=every,
        rtol=rtol,
        full=equations == "full",
        fitted_angle=craft.hydrodynamics.fitted_angle,
    )
    place = None
    if plan and plan.latitude is not None and plan.longitude is not None:
        place = (plan.latitude, plan.longitude)
    log = to_log(
        flight,
        start=_utc(plan.start_time) if plan and plan.start_time else None,
        place=place,
        stratified=ocean.stratified,
        has_temperature=ocean.has_temperature,
        has_current=adcp is not None,
        origin="simulated",
        metadata=_metadata(plan, craft, equations, remade),
    )
    warnings = [*ocean.warnings, *_warnings(flight, craft, legs), *ocean.beyond(*flight.depths)]
    if ocean.stratified and not ocean.has_temperature and p.chi > 0.0:
        warnings.append("the water has no temperature: thermal expansion of the hull is left out")
    return Simulation(
        log=log,
        duration=float(flight.times[-1]),
        max_depth=flight.depths[1],
        distance=flight.distance,
        energy=float(flight.column("energy")[-1]),
        net_buoyancy_in_water=flight.excess,
        wall=flight.wall,
        warnings=tuple(warnings),
        inputs=tuple(inputs),
    )


def _first(*values: float | None) -> float:
    return next(value for value in values if value is not None)


def _utc(moment: datetime.datetime) -> datetime.datetime:
    return moment.astimezone(datetime.UTC) if moment.tzinfo else moment.replace(tzinfo=datetime.UTC)


def _vehicle_of(plan: Mission | None, beside: Path) -> str:
    if plan is None:
        return "seawing"
    return str(beside / plan.vehicle) if plan.vehicle.endswith(".toml") else plan.vehicle


def _ocean(kind: type[Ocean], density: float, temperature: float, ctd: Any, adcp: Any, latitude: float | None) -> Ocean:
    """The water of a flight: uniform without a cast, else TEOS-10 density from it; and the current."""
    from glidercli.ocean.cast import read_ctd
    from glidercli.ocean.current import read_adcp

    cast = read_ctd(Path(ctd), latitude) if ctd else None
    current = read_adcp(Path(adcp)) if adcp else None
    return kind.build(density, cast=cast, current=current, latitude=latitude, temperature_reference=temperature)


def _legs(
    plan: Mission | None, beside: Path, mass_position: float | None, mass_rotation: float | None,
    net_buoyancy: float | None,
) -> tuple[list[Leg], list[Path]]:  # fmt: skip
    """The legs and the files of their controls."""
    from glidercli.simulation.legs import held, read_controls

    given = {"mass position": mass_position, "mass rotation": mass_rotation, "net buoyancy": net_buoyancy}
    if plan:
        extra = [name for name, value in given.items() if value is not None]
        if extra:
            raise UsageError(f"mission {plan.name} sets the controls; {', '.join(extra)} cannot be given beside it")
        files = [beside / leg.controls for leg in plan.leg]
        legs = [read_controls(f, leg.name, leg.until_depth_m) for f, leg in zip(files, plan.leg, strict=True)]
        return legs, files
    if mass_position is None or mass_rotation is None or net_buoyancy is None:
        missing = [name for name, value in given.items() if value is None]
        raise UsageError(f"{', '.join(missing)} missing; give all three controls or a mission")
    return [held(mass_position, mass_rotation, net_buoyancy)], []


def _metadata(plan: Mission | None, craft: Vehicle, equations: str, remade: list[Path]) -> dict[str, str]:
    """What a reader of the output should know."""
    told = {
        "title": plan.description if plan else f"{craft.name}, controls held",
        "vehicle": craft.name,
        "vehicle_reference": craft.reference,
        "equations": equations,
        "hull_length_m": repr(craft.hull.length),
        "hull_diameter_m": repr(craft.hull.diameter),
        "movable_eccentricity_m": repr(craft.mass.movable_eccentricity),
        "movable_nominal_position_m": repr(craft.actuators.mass_position.nominal),
    }
    if plan and plan.reconstruction:
        told["reconstruction"] = plan.reconstruction
    elif remade:
        told["reconstruction"] = f"{', '.join(path.name for path in remade)} reconstructed, not measured"
    return told


def _warnings(flight: Flight, craft: Vehicle, legs: list[Leg]) -> list[str]:
    """Where the flight left the range that the model was fitted to, and controls beyond the vehicle's limits."""
    found = [
        f"{e.name} was beyond {'' if e.name == 'roll' else 'the fitted '}{math.degrees(e.limit):g} deg for "
        f"{e.duration:.1f} s, {e.first:.1f} to {e.last:.1f} s, largest {math.degrees(e.largest):.1f} deg"
        for e in flight.excursions
    ]
    outside = {name for leg in legs for row in leg.values for name in craft.actuators.outside(*row)}
    found += [f"{name.replace('_', ' ')} is beyond the limits of {craft.name}" for name in sorted(outside)]
    return found
