"""Which numbers make a vehicle? Masses, actuators, added mass, hydrodynamic coefficients and ballasting.

Names are words; each docstring gives the paper's symbol (Zhang et al. 2013, Tables 1 and 3). All values are SI and
radians. Ranges are physical bounds for gliders and small vehicles, wide on purpose.
"""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import ConfigDict, model_validator
from pydantic.dataclasses import dataclass

from glidercli.units import DBAR, DEGREE
from glidercli.vehicle.quantity import Quantity

__all__ = ["Actuator", "Actuators", "AddedMass", "Ballast", "Energy", "Hull", "Hydrodynamics", "Mass", "Vehicle"]

_CONFIG = ConfigDict(extra="forbid")

Vector = tuple[float, float, float]
Mass_ = Annotated[float, Quantity("kg", 0.01, 1e5)]
Position = Annotated[Vector, Quantity("m", -10.0, 10.0, size=3)]
Inertia = Annotated[Vector, Quantity("kg m2", 1e-6, 1e6, size=3)]


@dataclass(frozen=True, config=_CONFIG)
class Hull:
    """Outer dimensions; the dynamics do not use them, pictures and strip theory do."""

    length: Annotated[float, Quantity("m", 0.1, 20.0)]
    """L_glider, without the tail."""
    diameter: Annotated[float, Quantity("m", 0.01, 5.0)]
    """D_glider."""


def _is_rigid(inertia: Vector) -> bool:
    """Whether a body can have these principal moments: none exceeds the sum of the other two."""
    return 2.0 * max(inertia) <= sum(inertia) * (1.0 + 1e-9)


@dataclass(frozen=True, config=_CONFIG)
class Mass:
    """Masses, where they sit from the centre of buoyancy (body frame), and their inertia about their own centres."""

    static_mass: Mass_
    """m_s."""
    static_position: Position
    """r_s."""
    static_inertia: Inertia
    """I_s, diagonal."""
    movable_mass: Mass_
    """m_r."""
    movable_eccentricity: Annotated[float, Quantity("m", 0.0, 1.0)]
    """R_r: distance of the movable mass from the axis that it turns about."""
    movable_inertia: Inertia
    """I_r0, diagonal, at zero rotation."""
    displaced_mass: Mass_
    """m: mass of the displaced water when neutral."""
    buoyancy_position: Position
    """r_b: where pumped volume acts."""

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        faults = []
        total = self.static_mass + self.movable_mass
        if abs(total - self.displaced_mass) > 1e-3 * self.displaced_mass:
            faults.append(
                f"mass.displaced_mass = {self.displaced_mass:g} kg, allowed static_mass + movable_mass = {total:g} kg "
                "within 0.1 %: zero net buoyancy is neutral"
            )
        faults += [
            f"mass.{name} = {list(inertia)} kg m2, allowed: no moment above the sum of the other two"
            for name, inertia in (("static_inertia", self.static_inertia), ("movable_inertia", self.movable_inertia))
            if not _is_rigid(inertia)
        ]
        if faults:
            raise ValueError("; ".join(faults))
        return self


@dataclass(frozen=True, config=_CONFIG)
class PositionRange:
    """Travel of the movable mass along the body x axis, r_rx."""

    minimum: Annotated[float, Quantity("m", -5.0, 5.0)]
    nominal: Annotated[float, Quantity("m", -5.0, 5.0)]
    maximum: Annotated[float, Quantity("m", -5.0, 5.0)]
    reading: Annotated[float, Quantity("m", -5.0, 5.0)] = 0.0
    """What the vehicle's own log tells as position when the mass is at nominal, forward positive; zero for logs that
    count from there, as a Seaglider's does from C_PITCH."""
    rate: Annotated[float, Quantity("mm/s", 0.01, 1000.0)] = 6e-3
    """Speed of the slide."""
    power: Annotated[float, Quantity("W", 0.0, 1000.0)] = 6.0
    """Of its motor while it runs."""


@dataclass(frozen=True, config=_CONFIG)
class RotationRange:
    """Rotation of the movable mass about the body x axis, gamma."""

    minimum: Annotated[float, Quantity("deg", -180.0, 180.0)]
    nominal: Annotated[float, Quantity("deg", -180.0, 180.0)]
    maximum: Annotated[float, Quantity("deg", -180.0, 180.0)]
    rate: Annotated[float, Quantity("deg/s", 0.01, 360.0)] = 15.0 * DEGREE
    """Speed of the rotation."""
    power: Annotated[float, Quantity("W", 0.0, 1000.0)] = 2.0
    """Of its motor while it runs."""


@dataclass(frozen=True, config=_CONFIG)
class BuoyancyRange:
    """Net buoyancy as excess mass, m_b, positive sinking."""

    minimum: Annotated[float, Quantity("kg", -100.0, 100.0)]
    nominal: Annotated[float, Quantity("kg", -100.0, 100.0)]
    maximum: Annotated[float, Quantity("kg", -100.0, 100.0)]
    pump_rate: Annotated[float, Quantity("cm3/s", 0.01, 1e5)] = 2e-6
    """Oil pumped out at the surface."""
    pump_slowing: Annotated[float, Quantity("1/dbar", 0.0, 0.01)] = 4e-4 / DBAR
    """Share of that rate lost per pressure; a tenth of the rate always remains."""
    pump_efficiency: Annotated[float, Quantity("1", 0.01, 1.0)] = 0.24
    """Work against the sea over electrical energy."""
    return_rate: Annotated[float, Quantity("cm3/s", 0.01, 1e5)] = 7e-6
    """Oil let back in, which costs nothing."""


Actuator = PositionRange | RotationRange | BuoyancyRange


@dataclass(frozen=True, config=_CONFIG)
class Actuators:
    """Limits and rates of the three controls; nominal is neutral, straight and level.

    Rates, powers and efficiency may be left out of a file. The values then taken are assumed: they are of the order
    that the motors of a Seaglider show in its log (sg561, dives 2 to 5: docs/missions.md).
    """

    mass_position: PositionRange
    mass_rotation: RotationRange
    net_buoyancy: BuoyancyRange

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        faults = [
            f"actuators.{name}: minimum, nominal and maximum must not decrease"
            for name, item in self.ranges()
            if not item.minimum <= item.nominal <= item.maximum
        ]
        if faults:
            raise ValueError("; ".join(faults))
        return self

    def ranges(self) -> tuple[tuple[str, Actuator], ...]:
        """Name and range of each control."""
        return (
            ("mass_position", self.mass_position),
            ("mass_rotation", self.mass_rotation),
            ("net_buoyancy", self.net_buoyancy),
        )

    def outside(self, mass_position: float, mass_rotation: float, net_buoyancy: float) -> list[str]:
        """Names of the controls that lie beyond the vehicle's limits (SI, rad)."""
        given = (mass_position, mass_rotation, net_buoyancy)
        slack = 1e-9  # a control typed in degrees may round past a limit by one bit
        return [
            name
            for (name, item), value in zip(self.ranges(), given, strict=True)
            if not item.minimum - slack <= value <= item.maximum + slack
        ]


@dataclass(frozen=True, config=_CONFIG)
class AddedMass:
    """Added mass at the reference density, eq. (14)."""

    mass: Annotated[Vector, Quantity("kg", 0.0, 1e6, size=3)]
    """M_A, diagonal."""
    inertia: Annotated[Vector, Quantity("kg m2", 0.0, 1e6, size=3)]
    """I_A, diagonal."""
    yaw_from_sway: Annotated[float, Quantity("kg m", -1e5, 1e5)]
    """N_v' = Y_r': row 2, column 3 of C_A."""
    pitch_from_heave: Annotated[float, Quantity("kg m", -1e5, 1e5)]
    """M_w' = Z_q': row 3, column 2 of C_A."""


@dataclass(frozen=True, config=_CONFIG)
class Hydrodynamics:
    """Coefficients of eq. (20), at the reference density; signs as used, not as printed (see the file's notes)."""

    reference_density: Annotated[float, Quantity("kg/m3", 900.0, 1200.0)]
    """Density at which coefficients and added mass hold."""
    fitted_angle: Annotated[float, Quantity("deg", 0.1, 90.0)]
    """Largest angle of attack and sideslip that the coefficients were fitted to."""
    drag_zero: Annotated[float, Quantity("kg/m", 1e-6, 1e6)]
    """K_D0."""
    drag_attack: Annotated[float, Quantity("kg/m/rad2", 0.0, 1e6)]
    """K_D."""
    side_sideslip: Annotated[float, Quantity("kg/m/rad", -1e6, 1e6)]
    """K_beta."""
    lift_zero: Annotated[float, Quantity("kg/m", -1e6, 1e6)]
    """K_L0."""
    lift_attack: Annotated[float, Quantity("kg/m/rad", -1e6, 1e6)]
    """K_alpha."""
    roll_sideslip: Annotated[float, Quantity("kg/rad", -1e6, 1e6)]
    """K_MR."""
    roll_rate: Annotated[float, Quantity("kg s/rad", -1e6, 0.0)]
    """K_p; damping, so never positive."""
    pitch_zero: Annotated[float, Quantity("kg", -1e6, 1e6)]
    """K_M0."""
    pitch_attack: Annotated[float, Quantity("kg/rad", -1e6, 1e6)]
    """K_M."""
    pitch_rate: Annotated[float, Quantity("kg s/rad", -1e6, 0.0)]
    """K_q; damping."""
    yaw_sideslip: Annotated[float, Quantity("kg/rad", -1e6, 1e6)]
    """K_MY."""
    yaw_rate: Annotated[float, Quantity("kg s/rad", -1e6, 0.0)]
    """K_r; damping."""


@dataclass(frozen=True, config=_CONFIG)
class Ballast:
    """How the displaced volume changes with the water around it; zero net buoyancy is neutral at neutral_density."""

    neutral_density: Annotated[float, Quantity("kg/m3", 900.0, 1200.0)]
    compressibility: Annotated[float, Quantity("1/dbar", 0.0, 1e-4)]
    """Relative loss of hull volume per pressure."""
    thermal_expansion: Annotated[float, Quantity("1/K", 0.0, 1e-3)]
    """Relative gain of hull volume per temperature."""
    reference_temperature: Annotated[float, Quantity("degC", -3.0, 45.0)]
    """Temperature at which the hull has its neutral volume."""


@dataclass(frozen=True, config=_CONFIG)
class Energy:
    """What the vehicle has and what it always spends. Assumed where a file leaves it out."""

    battery: Annotated[float, Quantity("MJ", 0.001, 1e5)] = 10e6
    """Of the order of Seaglider's (Eriksen et al. 2001)."""
    hotel_power: Annotated[float, Quantity("W", 0.0, 1e4)] = 0.5
    """Sensors, computer and all else that runs all the time."""


@dataclass(frozen=True, config=_CONFIG)
class Vehicle:
    """A glider: everything that the model needs to know about it."""

    name: str
    description: str
    reference: str
    hull: Hull
    mass: Mass
    actuators: Actuators
    added_mass: AddedMass
    hydrodynamics: Hydrodynamics
    ballast: Ballast
    energy: Energy = Energy()
