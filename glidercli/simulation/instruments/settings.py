"""What is told of the sensors aboard? The tables [instruments.*] of a mission, every key with its unit and range.

[instruments.compass]           heading, pitch, roll
model = "tcm3"                  a shipped model, whose values the other keys replace; may be left out
period_s = 6.0                  offset_s = 0.0: of the first sample, from the start of the flight
lag_s = 0.5                     first order
noise_heading_deg = 0.3         one standard deviation, white
bias_heading_sigma_deg = 1.0    drawn once a run, from the seed; bias_heading_deg is added to it
resolution_heading_deg = 0.1    rounded to its multiples; 0: not
mount_roll_deg = 1.0            of the sensor in the hull

[instruments.pressure], [instruments.ctd], [instruments.gps]: docs/instruments.md
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Self

from pydantic import BeforeValidator, ConfigDict, field_validator, model_validator
from pydantic.dataclasses import dataclass

from glidercli.simulation.instruments.models import model_values, models
from glidercli.simulation.ranges import number

__all__ = ["MOST_SEED", "Compass", "Ctd", "Gps", "Instrument", "Instruments", "Pressure"]

_CONFIG = ConfigDict(extra="forbid", strict=False)
MOST_SEED = 2**63 - 1

Seconds = Annotated[float, number(0.0, 3600.0)]
Degrees = Annotated[float, number(-360.0, 360.0)]
DegreesSize = Annotated[float, number(0.0, 90.0)]
Dbar = Annotated[float, number(-1000.0, 1000.0)]
DbarSize = Annotated[float, number(0.0, 1000.0)]
Kelvin = Annotated[float, number(-10.0, 10.0)]
KelvinSize = Annotated[float, number(0.0, 10.0)]
Siemens = Annotated[float, number(-5.0, 5.0)]
SiemensSize = Annotated[float, number(0.0, 5.0)]
Metres = Annotated[float, number(-10000.0, 10000.0)]
MetresSize = Annotated[float, number(0.0, 10000.0)]
_Coordinate = Annotated[float, number(-20.0, 20.0)]


def _three(given: Any) -> Any:
    """A place has three numbers."""
    if not isinstance(given, (list, tuple)) or len(given) != 3:
        raise ValueError(f"= {given!r}, allowed three numbers: forward, starboard, down, m")
    return given


Position = Annotated[tuple[_Coordinate, _Coordinate, _Coordinate], BeforeValidator(_three)]


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Instrument:
    """What every sensor has: a model by name, and when it samples."""

    KIND: ClassVar[str] = ""
    model: str | None = None
    period_s: Annotated[float, number(0.01, 86400.0)] = 1.0
    offset_s: Annotated[float, number(0.0, 86400.0)] = 0.0
    """Of the first sample, from the start of the flight."""

    @field_validator("model")
    @classmethod
    def _known(cls, name: str | None) -> str | None:
        if name is not None and name not in models(cls.KIND):
            raise ValueError(f"= {name!r} is no {cls.KIND} that is shipped; shipped: {', '.join(models(cls.KIND))}")
        return name

    @field_validator("period_s", "offset_s")
    @classmethod
    def _in_ms(cls, seconds: float) -> float:
        if abs(seconds * 1e3 - round(seconds * 1e3)) > 1e-6:
            raise ValueError(f"= {seconds:g}, allowed whole milliseconds")
        return round(seconds * 1e3) / 1e3


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Compass(Instrument):
    """Heading, pitch and roll of a tilt-compensated compass."""

    KIND: ClassVar[str] = "compass"
    lag_s: Seconds = 0.0
    noise_heading_deg: DegreesSize = 0.0
    noise_tilt_deg: DegreesSize = 0.0
    """Of pitch and of roll."""
    bias_heading_deg: Degrees = 0.0
    bias_pitch_deg: Degrees = 0.0
    bias_roll_deg: Degrees = 0.0
    bias_heading_sigma_deg: DegreesSize = 0.0
    bias_tilt_sigma_deg: DegreesSize = 0.0
    deviation_sin_deg: Degrees = 0.0
    """B of the deviation B sin(heading) + C cos(heading) that iron in the hull makes."""
    deviation_cos_deg: Degrees = 0.0
    """C of it."""
    resolution_heading_deg: DegreesSize = 0.0
    resolution_tilt_deg: DegreesSize = 0.0
    mount_roll_deg: Degrees = 0.0
    mount_pitch_deg: Annotated[float, number(-90.0, 90.0)] = 0.0
    mount_heading_deg: Degrees = 0.0


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Pressure(Instrument):
    """Pressure, and depth from it."""

    KIND: ClassVar[str] = "pressure"
    lag_s: Seconds = 0.0
    noise_dbar: DbarSize = 0.0
    bias_dbar: Dbar = 0.0
    bias_sigma_dbar: DbarSize = 0.0
    resolution_dbar: DbarSize = 0.0
    position_m: Position = (0.0, 0.0, 0.0)
    """Of the port in the body frame: forward, starboard, down of the centre of buoyancy."""


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Ctd(Instrument):
    """Temperature, conductivity and pressure; salinity and density from the three."""

    KIND: ClassVar[str] = "ctd"
    temperature_lag_s: Seconds = 0.0
    temperature_noise_degC: KelvinSize = 0.0
    temperature_bias_degC: Kelvin = 0.0
    temperature_bias_sigma_degC: KelvinSize = 0.0
    temperature_resolution_degC: KelvinSize = 0.0
    conductivity_lag_s: Seconds = 0.0
    conductivity_noise_S_m: SiemensSize = 0.0
    conductivity_bias_S_m: Siemens = 0.0
    conductivity_bias_sigma_S_m: SiemensSize = 0.0
    conductivity_resolution_S_m: SiemensSize = 0.0
    cell_share: Annotated[float, number(0.0, 1.0)] = 0.0
    """Share of a temperature step that the wall of the conductivity cell gives back at once (Lueck 1990: alpha)."""
    cell_time_s: Seconds = 10.0
    """Time in which that decays (Lueck 1990: tau)."""
    pressure_noise_dbar: DbarSize = 0.0
    pressure_bias_dbar: Dbar = 0.0
    pressure_bias_sigma_dbar: DbarSize = 0.0
    pressure_resolution_dbar: DbarSize = 0.0
    position_m: Position = (0.0, 0.0, 0.0)
    """Of the intake in the body frame."""


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Gps(Instrument):
    """Latitude and longitude, while the antenna is out of the water."""

    KIND: ClassVar[str] = "gps"
    noise_m: MetresSize = 0.0
    """North and east, each."""
    bias_north_m: Metres = 0.0
    bias_east_m: Metres = 0.0
    bias_sigma_m: MetresSize = 0.0
    resolution_deg: Annotated[float, number(0.0, 1.0)] = 0.0
    position_m: Position = (0.0, 0.0, 0.0)
    """Of the antenna in the body frame."""
    antenna_depth_m: Annotated[float, number(-20.0, 20.0)] = 0.0
    """Depth of the antenna down to which it sees the sky."""
    first_fix_s: Seconds = 0.0
    """From then to the first fix."""


def _from_model(kind: str) -> BeforeValidator:
    """What a table gives, over the values of the model that it names."""

    def joined(given: Any) -> Any:
        name = given.get("model") if isinstance(given, dict) else None
        return {**model_values(kind, name), **given} if isinstance(name, str) and name in models(kind) else given

    return BeforeValidator(joined)


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Instruments:
    """The sensors aboard; at least one."""

    compass: Annotated[Compass, _from_model("compass")] | None = None
    pressure: Annotated[Pressure, _from_model("pressure")] | None = None
    ctd: Annotated[Ctd, _from_model("ctd")] | None = None
    gps: Annotated[Gps, _from_model("gps")] | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not self.aboard:
            raise ValueError("is empty; needed is at least one of instruments.compass, .pressure, .ctd, .gps")
        return self

    @property
    def aboard(self) -> dict[str, Instrument]:
        """The sensors by kind."""
        found = {"compass": self.compass, "pressure": self.pressure, "ctd": self.ctd, "gps": self.gps}
        return {kind: sensor for kind, sensor in found.items() if sensor is not None}
