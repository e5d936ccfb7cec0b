"""Which symbol of the paper is which number of the vehicle? The model's parameters, flat and in the paper's letters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from glidercli.errors import InputError
from glidercli.frames import Vector
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["Controls", "Parameters", "changed", "parameters", "symmetric", "without_coupling"]


class Parameters(NamedTuple):
    """A vehicle in symbols; SI. Diagonal matrices are their diagonals. Docs: reference/symbols."""

    ms: float
    rs: Vector
    Is: Vector
    mr: float
    Rr: float
    Ir0: Vector
    rb: Vector
    MA: Vector
    IA: Vector
    Nv: float
    """N_v' = Y_r', row 2 column 3 of C_A."""
    Mw: float
    """M_w' = Z_q', row 3 column 2 of C_A."""
    KD0: float
    KD: float
    Kbeta: float
    KL0: float
    Kalpha: float
    KMR: float
    Kp: float
    KM0: float
    KM: float
    Kq: float
    KMY: float
    Kr: float
    rho_ref: float
    """Density at which coefficients and added mass hold."""
    rho_0: float
    """Density at which zero net buoyancy is neutral."""
    kappa: float
    """Hull compressibility, 1/Pa."""
    chi: float
    """Hull thermal expansion, 1/K."""
    T_0: float
    """Temperature of the neutral volume, degC."""


class Controls(NamedTuple):
    """Where the actuators are and how fast they move."""

    rrx: float
    """Position of the movable mass along x, m."""
    gamma: float
    """Its rotation about x, rad."""
    mb: float
    """Net buoyancy, kg, sinking positive."""
    rrx_rate: float = 0.0
    gamma_rate: float = 0.0


def parameters(vehicle: Vehicle) -> Parameters:
    """The vehicle in the paper's symbols."""
    mass, added, hydro, ballast = vehicle.mass, vehicle.added_mass, vehicle.hydrodynamics, vehicle.ballast
    return Parameters(
        ms=mass.static_mass,
        rs=mass.static_position,
        Is=mass.static_inertia,
        mr=mass.movable_mass,
        Rr=mass.movable_eccentricity,
        Ir0=mass.movable_inertia,
        rb=mass.buoyancy_position,
        MA=added.mass,
        IA=added.inertia,
        Nv=added.yaw_from_sway,
        Mw=added.pitch_from_heave,
        KD0=hydro.drag_zero,
        KD=hydro.drag_attack,
        Kbeta=hydro.side_sideslip,
        KL0=hydro.lift_zero,
        Kalpha=hydro.lift_attack,
        KMR=hydro.roll_sideslip,
        Kp=hydro.roll_rate,
        KM0=hydro.pitch_zero,
        KM=hydro.pitch_attack,
        Kq=hydro.pitch_rate,
        KMY=hydro.yaw_sideslip,
        Kr=hydro.yaw_rate,
        rho_ref=hydro.reference_density,
        rho_0=ballast.neutral_density,
        kappa=ballast.compressibility,
        chi=ballast.thermal_expansion,
        T_0=ballast.reference_temperature,
    )


def changed(p: Parameters, changes: Mapping[str, Any]) -> Parameters:
    """The parameters with others in place of some, by name; three numbers where there were three.

    Raises InputError for a name that is none, or a value of another shape; values are not checked.
    """
    made: dict[str, Any] = {}
    for name, value in changes.items():
        if name not in p._fields:
            raise InputError("changes", f"{name} is no parameter; allowed: {', '.join(p._fields)}")
        numbers = value if isinstance(value, (tuple, list)) else (value,)
        size = 3 if isinstance(getattr(p, name), tuple) else 1
        if len(numbers) != size or (size == 3) != isinstance(value, (tuple, list)):
            raise InputError("changes", f"{name} = {value!r}; allowed: {'three numbers' if size == 3 else 'a number'}")
        made[name] = tuple(float(number) for number in numbers) if size == 3 else float(value)
    return p._replace(**made)


def without_coupling(p: Parameters) -> Parameters:
    """The parameters with C_A = 0, as the paper writes the equilibria, eqs (30), (31)."""
    return p._replace(Nv=0.0, Mw=0.0)


def symmetric(p: Parameters) -> bool:
    """Whether port and starboard are alike, so that a flight mirrored is a flight."""
    return p.rs[1] == 0.0 and p.rb[1] == 0.0
