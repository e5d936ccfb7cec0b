"""How do a cast and a current profile become an ocean? Checked, joined, ready for the compiled integrator."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from glidercli.errors import InputError
from glidercli.ocean import seawater
from glidercli.ocean.cast import Cast
from glidercli.ocean.current import CurrentProfile
from glidercli.ocean.profile import Profile, in_time, pchip
from glidercli.ocean.reaching import Knots, completed
from glidercli.ocean.series import no_start
from glidercli.ocean.water import Sea, Water, at_depth
from glidercli.units import DBAR, STANDARD_GRAVITY

__all__ = ["Ocean"]


@dataclass(frozen=True)
class Ocean:
    """Water and current by depth and, if several profiles were given, by time; and gravity; the same everywhere.

    water : profile with the columns density (kg/m3), pressure (Pa), temperature (degC).
    current : profile with the columns north, east, down (m/s).
    gravity : m/s2.
    stratified : whether the water comes from a cast; else it is uniform and has no pressure.
    has_temperature : whether temperature was measured; else its column holds one reference value.
    moving : whether the current comes from a profile; else the water is still.
    warnings : what a reader of results should know, one line each.
    inputs : files that it was made from. reconstructed : those that say they are reconstructions.
    """

    water: Profile
    current: Profile
    gravity: float
    stratified: bool
    has_temperature: bool
    moving: bool
    warnings: tuple[str, ...] = ()
    inputs: tuple[Path, ...] = ()
    reconstructed: tuple[Path, ...] = ()

    @classmethod
    def uniform(
        cls, density: float, gravity: float = STANDARD_GRAVITY, temperature_reference: float = math.nan
    ) -> Ocean:
        """Still water of one density, kg/m3, at every depth.

        temperature_reference : degC, what ``Water.temperature`` then holds; NaN says that it is not known.
        """
        if not (math.isfinite(density) and density > 0.0):
            raise InputError("ocean", f"density = {density:g} kg/m3, a positive number is needed")
        return cls(
            water=pchip([0.0], [[density, 0.0, temperature_reference]]),
            current=pchip([0.0], [[0.0, 0.0, 0.0]]),
            gravity=gravity,
            stratified=False,
            has_temperature=False,
            moving=False,
        )

    @classmethod
    def build(
        cls,
        density_reference: float,
        casts: Cast | Sequence[Cast] = (),
        currents: CurrentProfile | Sequence[CurrentProfile] = (),
        latitude: float | None = None,
        temperature_reference: float = math.nan,
        start_ns: int | None = None,
    ) -> Ocean:
        """The ocean of casts and current profiles: none, one, or several in time.

        Parameters
        ----------
        density_reference : kg/m3, of the uniform water without a cast.
        latitude : degrees north, for gravity at the surface; 9.81 m/s2 without it, whatever the cast's place is.
        temperature_reference : degC, held where the casts have no temperature; NaN says that it is not known.
        start_ns : UTC since 1970, of the flight: where profiles have times in UTC.

        Raises
        ------
        InputError
            Profiles have times in UTC, and the flight has no start.
        """
        gravity = STANDARD_GRAVITY if latitude is None else seawater.gravity(latitude)
        still = cls.uniform(density_reference, gravity, temperature_reference)
        casts = (casts,) if isinstance(casts, Cast) else tuple(casts)
        currents = (currents,) if isinstance(currents, CurrentProfile) else tuple(currents)
        measured = bool(casts) and all(cast.temperature is not None for cast in casts)
        water = [_water(cast, temperature_reference if not measured else None) for cast in casts]
        flow = [(c.depth, np.stack([c.north, c.east, -c.up], axis=1)) for c in currents]
        given: list[Cast | CurrentProfile] = [*casts, *currents]
        return cls(
            water=_in_time(_times(casts, start_ns), water) if casts else still.water,
            current=_in_time(_times(currents, start_ns), flow) if currents else still.current,
            gravity=gravity,
            stratified=bool(casts),
            has_temperature=measured,
            moving=bool(currents),
            warnings=_once(
                (
                    *(f"{item.source}: {line}" for item in given for line in item.warnings),
                    *_short("casts", casts),
                    *_short("current profiles", currents),
                )
            ),
            inputs=tuple(dict.fromkeys(item.source for item in given)),
            reconstructed=tuple(dict.fromkeys(item.source for item in given if item.reconstructed)),
        )

    @property
    def sea(self) -> Sea:
        """The same in the form that kernels read."""
        return Sea(self.water, self.current, self.gravity)

    def at(self, depth: float, time: float = 0.0) -> Water:
        """The water at one depth, m, and time, s."""
        return at_depth(self.sea, depth, time)

    def beyond(self, shallowest: float, deepest: float, duration: float = 0.0) -> list[str]:
        """Warnings where a flight between two depths, m, of a duration, s, leaves the casts or current profiles, whose
        ends are held."""
        warnings = []
        for name, profile, given in (
            ("cast", self.water, self.stratified),
            ("current profile", self.current, self.moving),
        ):
            top = float(profile.depth[profile.first[:-1]].max())
            bottom = float(profile.depth[profile.first[1:] - 1].min())
            began, ended = float(profile.times[0]), float(profile.times[-1])
            if len(profile.times) > 1 and (began > 0.0 or duration > ended):
                warnings.append(
                    f"the flight lasts from 0 to {_span(duration)}, the {name}s from {_span(began)} to {_span(ended)}; "
                    "the first and the last are held beyond"
                )
            if given and (max(shallowest, 0.0) < top or deepest > bottom):
                warnings.append(
                    f"the flight spans {shallowest:z.1f} to {deepest:.1f} m, the {name} {top:.1f} to {bottom:.1f} m; "
                    "its end values are held beyond"
                )
        return warnings


def _span(seconds: float) -> str:
    """A time since the start of the flight, in days where seconds say little."""
    if seconds == 0.0:
        return "0"
    return f"{seconds:.0f} s" if abs(seconds) < 2.0 * 86400.0 else f"{seconds / 86400.0:.1f} d"


def _in_time(times: list[float], profiles: list[Knots]) -> Profile:
    """Profiles of some times, each continued by the others to where they reach."""
    return in_time(times, [pchip(*profile) for profile in completed(times, profiles)])


def _short(what: str, profiles: Sequence[Cast | CurrentProfile]) -> tuple[str, ...]:
    """A line where some of several profiles end far above the others."""
    ends = np.array([profile.depth[-1] for profile in profiles])
    short = int((ends < 0.9 * ends.max(initial=0.0)).sum())
    return (
        (f"{short} of {len(ends)} {what} end above {0.9 * ends.max():.0f} m; below their ends those that reach hold",)
        if short
        else ()
    )


def _water(cast: Cast, reference: float | None) -> Knots:
    """Density, pressure and temperature of a cast; a reference temperature where it is not None."""
    temperature = cast.temperature
    if temperature is None or reference is not None:
        temperature = np.full(len(cast.depth), reference)
    return cast.depth, np.stack([cast.density, cast.pressure_dbar * DBAR, temperature], axis=1)


def _times(profiles: Sequence[Cast | CurrentProfile], start_ns: int | None) -> list[float]:
    """When each profile holds, s since the start of the flight; 0 of a single one."""
    times = []
    for profile in profiles:
        seconds = 0.0 if profile.moment is None else profile.moment.since(start_ns)
        if seconds is None:
            assert profile.moment is not None  # a single profile has 0 s
            raise no_start(profile.source, "profile", profile.moment)
        times.append(seconds)
    return times


def _once(lines: tuple[str, ...], most: int = 8) -> tuple[str, ...]:
    """Each line once, and not more than a screen can hold."""
    told = tuple(dict.fromkeys(lines))
    more = (f"{len(told) - most} more warnings of the water's profiles",) if len(told) > most else ()
    return told[:most] + more
