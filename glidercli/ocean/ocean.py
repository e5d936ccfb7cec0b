"""How do a cast and a current profile become an ocean? Checked, joined, ready for the compiled integrator."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from glidercli.errors import InputError
from glidercli.ocean import seawater
from glidercli.ocean.cast import Cast
from glidercli.ocean.current import CurrentProfile
from glidercli.ocean.profile import Profile, pchip
from glidercli.ocean.water import Sea, Water, at_depth
from glidercli.units import DBAR, STANDARD_GRAVITY

__all__ = ["Ocean"]


@dataclass(frozen=True)
class Ocean:
    """Water and current by depth, and gravity; neither varies with time or place.

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
        cast: Cast | None = None,
        current: CurrentProfile | None = None,
        latitude: float | None = None,
        temperature_reference: float = math.nan,
    ) -> Ocean:
        """The ocean of a cast and a current profile, each of which may be missing.

        Parameters
        ----------
        density_reference : kg/m3, of the uniform water without a cast.
        latitude : degrees north, for gravity at the surface; 9.81 m/s2 without it, whatever the cast's place is.
        temperature_reference : degC, held where the cast has no temperature; NaN says that it is not known.
        """
        gravity = STANDARD_GRAVITY if latitude is None else seawater.gravity(latitude)
        still = cls.uniform(density_reference, gravity, temperature_reference)
        water, flow = still.water, still.current
        if cast is not None:
            unknown = np.full(len(cast.depth), temperature_reference)
            temperature = unknown if cast.temperature is None else cast.temperature
            water = pchip(cast.depth, np.stack([cast.density, cast.pressure_dbar * DBAR, temperature], axis=1))
        if current is not None:
            flow = pchip(current.depth, np.stack([current.north, current.east, -current.up], axis=1))
        given = [item for item in (cast, current) if item is not None]
        return cls(
            water=water,
            current=flow,
            gravity=gravity,
            stratified=cast is not None,
            has_temperature=cast is not None and cast.temperature is not None,
            moving=current is not None,
            warnings=tuple(f"{item.source}: {line}" for item in given for line in item.warnings),
            inputs=tuple(item.source for item in given),
            reconstructed=tuple(item.source for item in given if item.reconstructed),
        )

    @property
    def sea(self) -> Sea:
        """The same in the form that kernels read."""
        return Sea(self.water, self.current, self.gravity)

    def at(self, depth: float) -> Water:
        """The water at one depth, m."""
        return at_depth(self.sea, depth)

    def beyond(self, shallowest: float, deepest: float) -> list[str]:
        """Warnings where a flight between two depths, m, leaves the cast or current profile, whose ends are held."""
        warnings = []
        for name, profile, given in (
            ("cast", self.water, self.stratified),
            ("current profile", self.current, self.moving),
        ):
            top, bottom = float(profile.depth[0]), float(profile.depth[-1])
            if given and (shallowest < top or deepest > bottom):
                warnings.append(
                    f"the flight spans {shallowest:z.1f} to {deepest:.1f} m, the {name} {top:.1f} to {bottom:.1f} m; "
                    "its end values are held beyond"
                )
        return warnings
