"""Which legs may a mission have, and what ends and steers each? Dives, climbs, spirals, headings, drift, repeats."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal, Self

from pydantic import ConfigDict, Discriminator, Field, Tag, model_validator
from pydantic.dataclasses import dataclass

from glidercli.simulation.ranges import Buoyancy, Depth, Heading, Seconds, number, positive

__all__ = [
    "KINDS", "MOST_LEGS", "Climb", "ControlsLeg", "Dive", "Drift", "HoldHeading", "MissionLeg", "Repeat", "Spiral",
    "Targets", "Wait", "count", "flat", "places",
]  # fmt: skip

_CONFIG = ConfigDict(extra="forbid", strict=False)
MOST_LEGS = 100_000


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Ends:
    """What ends a leg: the first of these that comes about. Surface and bottom do, too."""

    name: str | None = None
    """In the events; default: the kind."""
    until_depth_m: Depth | None = None
    until_altitude_m: Annotated[float, number(0.0, 12000.0)] | None = None
    """Over bottom_m."""
    duration_s: Seconds | None = None
    turns: Annotated[float, positive(1e6)] | None = None
    """Of heading, either way."""

    def _ends(self) -> list[str]:
        """A fault if nothing ends the leg."""
        others = (self.until_depth_m, self.until_altitude_m, self.duration_s)
        if any(item is not None for item in others):
            return []
        if self.turns is None:
            return ["cannot end; needed is one of until_depth_m, until_altitude_m, duration_s, turns"]
        if not self._turns():
            return ["cannot end: it goes straight; needed is one of until_depth_m, until_altitude_m, duration_s"]
        return []

    def _turns(self) -> bool:
        """Whether the leg turns on and on."""
        return False


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Targets(Ends):
    """What the steering holds on a leg: pitch or a mass position; one way to turn; a net buoyancy."""

    pitch_deg: Annotated[float, number(-80.0, 80.0)] | None = None
    mass_position_m: Annotated[float, number(-5.0, 5.0)] | None = None
    heading_deg: Heading | None = None
    turn_rate_deg_s: Annotated[float, number(-30.0, 30.0)] | None = None
    turning_radius_m: Annotated[float, number(-1e5, 1e5)] | None = None
    """Starboard positive."""
    mass_rotation_deg: Annotated[float, number(-180.0, 180.0)] | None = None
    rotation_on_s: Seconds | None = None
    """The rotation is held so long, returns to zero for rotation_off_s, and so on: the trial's intermittent return."""
    rotation_off_s: Seconds | None = None
    net_buoyancy_kg: Buoyancy | None = None
    """Pumped."""
    net_buoyancy_in_water_kg: Buoyancy | None = None
    """Held in the water around, whose density changes: the pump follows."""

    @model_validator(mode="after")
    def _check(self) -> Self:
        faults = [*self._ends(), *self._targets(), *self._of_kind()]
        if faults:
            raise ValueError("; ".join(faults))
        return self

    def _turns(self) -> bool:
        return bool(self.turn_rate_deg_s or self.turning_radius_m or self.mass_rotation_deg)

    def _targets(self) -> list[str]:
        """Faults of targets that are missing or contradict each other."""
        faults = []
        for what, names in (
            ("pitch", ("pitch_deg", "mass_position_m")),
            ("buoyancy", ("net_buoyancy_kg", "net_buoyancy_in_water_kg")),
        ):
            given = [name for name in names if getattr(self, name) is not None]
            if len(given) != 1:
                has = "has both " + " and ".join(given) if given else f"has no {what}"
                faults.append(f"{has}; needed is one of {', '.join(names)}")
        turns = ("heading_deg", "turn_rate_deg_s", "turning_radius_m", "mass_rotation_deg")
        given = [name for name in turns if getattr(self, name) is not None]
        if len(given) > 1:
            faults.append(f"has {' and '.join(given)}; at most one of them can be held")
        if (self.rotation_on_s is None) != (self.rotation_off_s is None):
            faults.append("rotation_on_s and rotation_off_s go together")
        if self.rotation_on_s is not None and self.mass_rotation_deg is None:
            faults.append("rotation_on_s needs mass_rotation_deg, the rotation that is held meanwhile")
        if self.turning_radius_m == 0.0:
            faults.append("turning_radius_m = 0, allowed any other from -1e5 to 1e5, starboard positive")
        return faults

    def _of_kind(self) -> list[str]:
        """Faults that only this kind of leg can have."""
        return []


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Dive(Targets):
    """Down, straight unless told to turn."""

    kind: Literal["dive"] = "dive"

    def _of_kind(self) -> list[str]:
        return _one_way(self, -1.0)


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Climb(Targets):
    """Up, straight unless told to turn; to the surface with until_depth_m = 0."""

    kind: Literal["climb"] = "climb"

    def _of_kind(self) -> list[str]:
        altitude = self.until_altitude_m is not None
        return [*_one_way(self, 1.0), *(["until_altitude_m is for legs that go down"] if altitude else [])]


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Spiral(Targets):
    """Turning steadily: a turning radius, a turn rate or a mass rotation; down or up as the buoyancy has it."""

    kind: Literal["spiral"] = "spiral"

    def _of_kind(self) -> list[str]:
        if self.heading_deg is not None:
            return ["heading_deg is for legs that go straight; a spiral holds its turn"]
        if not self._turns():
            return ["does not turn; needed is one of turning_radius_m, turn_rate_deg_s, mass_rotation_deg, not 0"]
        return []


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class HoldHeading(Targets):
    """Along a heading, down or up as the buoyancy has it."""

    kind: Literal["hold-heading"] = "hold-heading"

    def _of_kind(self) -> list[str]:
        return [] if self.heading_deg is not None else ["has no heading_deg"]


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Drift:
    """At the surface with the current, pumped as light as the actuators allow; comes up first if it is below."""

    duration_s: Seconds
    kind: Literal["drift"] = "drift"
    name: str | None = None


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Wait:
    """The actuators rest where they are."""

    duration_s: Seconds
    kind: Literal["wait"] = "wait"
    name: str | None = None


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class ControlsLeg:
    """Actuators from a table, without limits or rates: elapsed_s (of the leg), mass_position_m, mass_rotation_deg,
    net_buoyancy_kg; ends at a depth or after a time, else with the table or, as the last leg, with the flight."""

    controls: str
    kind: Literal["controls"] = "controls"
    name: str | None = None
    until_depth_m: Depth | None = None
    duration_s: Seconds | None = None


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Repeat:
    """Legs flown so many times; they may hold repeats themselves."""

    repeat: Annotated[int, Field(ge=1, le=MOST_LEGS, strict=True)]
    leg: tuple[MissionLeg, ...]


KINDS = ("dive", "climb", "spiral", "hold-heading", "drift", "wait", "controls", "repeat")


def _kind(given: Any) -> Any:
    """The kind of a leg: said, or seen from what only that kind has."""
    if not isinstance(given, dict):
        return getattr(given, "kind", "repeat")
    implied = next((name for name in ("repeat", "controls") if name in given), None)
    return given.get("kind", implied)


MissionLeg = Annotated[
    Annotated[Dive, Tag("dive")] | Annotated[Climb, Tag("climb")] | Annotated[Spiral, Tag("spiral")]
    | Annotated[HoldHeading, Tag("hold-heading")] | Annotated[Drift, Tag("drift")] | Annotated[Wait, Tag("wait")]
    | Annotated[ControlsLeg, Tag("controls")] | Annotated[Repeat, Tag("repeat")],
    Discriminator(_kind),
]  # fmt: skip


def flat(legs: tuple[Any, ...]) -> Iterator[Any]:
    """The legs one after the other, repeats unrolled."""
    for leg in legs:
        if isinstance(leg, Repeat):
            for _ in range(leg.repeat):
                yield from flat(leg.leg)
        else:
            yield leg


def count(legs: tuple[Any, ...]) -> int:
    """How many legs there are with repeats unrolled."""
    return sum(leg.repeat * count(leg.leg) if isinstance(leg, Repeat) else 1 for leg in legs)


def places(legs: tuple[Any, ...], within: str = "") -> Iterator[tuple[str, Any]]:
    """Every leg of a mission once, with its place in the file."""
    for i, leg in enumerate(legs, start=1):
        place = f"{within}leg {i}"
        if isinstance(leg, Repeat):
            yield from places(leg.leg, f"{place}, ")
        else:
            yield f"{place} ({leg.kind})", leg


def _one_way(leg: Targets, sign: float) -> list[str]:
    """Faults of a leg whose pitch or buoyancy takes it the other way. sign : of the pitch, nose up positive."""
    faults, way = [], "down" if sign < 0.0 else "up"
    if leg.pitch_deg is not None and leg.pitch_deg * sign <= 0.0:
        allowed = "-80 to below 0" if sign < 0.0 else "above 0 to 80"
        faults.append(f"pitch_deg = {leg.pitch_deg:g}, allowed {allowed}: the leg goes {way}")
    if leg.net_buoyancy_in_water_kg is not None and leg.net_buoyancy_in_water_kg * sign >= 0.0:
        allowed = "above 0" if sign < 0.0 else "below 0"
        faults.append(
            f"net_buoyancy_in_water_kg = {leg.net_buoyancy_in_water_kg:g}, allowed {allowed} (sinking positive): "
            f"the leg goes {way}"
        )
    return faults
