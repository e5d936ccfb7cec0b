"""What water did it meet? Practical salinity and in-situ density by TEOS-10, at the times of the CTD."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel, Log
from glidercli.logio.whereabouts import Whereabouts
from glidercli.units import DBAR

__all__ = ["NEAR", "with_seawater"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]
Mask = NDArray[np.bool_]

NEAR = ("near_latitude_deg", "near_longitude_deg")
"""Metadata of a log without fixes: roughly where it was."""

SALTS = ("salinity", "absolute_salinity")
HEATS = ("temperature", "conservative_temperature")
"""Of each pair the first that the log has makes its density."""
FARTHEST = 30 * 86400 * 10**9
"""ns from the nearest fix, beyond which no position is taken: of a clock that is a year off none is known."""


def with_seawater(log: Log, near: Whereabouts | None = None) -> Log:
    """The log with salinity and density where it lacks them and has what they follow from.

    Where there is no pressure it is taken from depth. The metadata density_note says how density was derived, or why it
    was not. near : positions that are no fixes, used where the log has no fix; the metadata near_latitude_deg and
    near_longitude_deg then tell their middle.
    """
    notes: dict[str, str] = {}
    if near is not None and not {"latitude", "longitude"} <= log.channels.keys():
        notes |= dict(zip(NEAR, (repr(round(degrees, 6)) for degrees in near.middle), strict=True))
    if "salinity" not in log and {"conductivity", "temperature", "pressure"} <= log.channels.keys():
        times, (c, t, p) = log.together("conductivity", "temperature", "pressure")
        salinity = _salinity(c, t, p)
        log, told = _with(log, "salinity", times, salinity)
        if told:
            notes["salinity_note"] = (
                "derived: PSS-78 of conductivity, temperature and pressure at one time (gsw.SP_from_C)"
            )
    if "density" not in log and log.channels.keys() & {"conductivity", *SALTS, *HEATS}:
        log, notes["density_note"] = _with_density(log, near)
    return log.with_metadata(**notes)


def _with_density(log: Log, near: Whereabouts | None) -> tuple[Log, str]:
    """The log with density, and how it was derived; or why it was not."""
    salt, heat, gauge = (
        next((name for name in names if name in log), names[0]) for names in (SALTS, HEATS, ("pressure", "depth"))
    )
    if missing := [name for name in (heat, salt, gauge) if name not in log]:
        words = " and no ".join(missing).replace("pressure", "pressure or depth")
        return log, f"not derived: the log has no {words}"
    times, (s, t, z) = log.together(salt, heat, gauge)
    if not len(times):
        return log, f"not derived: {salt}, {heat} and {gauge} have no sample at one time"
    placed, near_by, where = _places(log, near, times)
    p_dbar, how = (np.maximum(z / DBAR, 0.0), "") if gauge == "pressure" else _pressure(z, placed)
    if salt == "absolute_salinity":
        absolute, where = s, "absolute salinity as recorded"
    else:
        absolute = _absolute(s, p_dbar, placed, near_by)
        if placed is not None and (far := int((~near_by).sum())):
            where += f", reference salinity for {far} samples more than 30 days from any of them"
    log, told = _with(log, "density", times, _density(absolute, t, p_dbar, heat))
    if not told:
        return log, f"not derived: TEOS-10 gives no number for this {salt}, {heat} and {gauge}"
    return log, f"derived: TEOS-10, in situ, {where}{how} ({'gsw.rho_t_exact' if heat == HEATS[0] else 'gsw.rho'})"


def _with(log: Log, name: str, times: Times, values: Array) -> tuple[Log, bool]:
    """The log with a derived channel, and whether any of its values is finite."""
    good = np.isfinite(values)
    if not good.any():
        return log, False
    return log.with_channels(Channel(name, times[good], values[good], "derived")), True


def _salinity(c: Array, t: Array, p: Array) -> Array:
    """Practical salinity of conductivity, S/m, temperature, degC, and pressure, Pa."""
    import gsw

    return np.asarray(gsw.SP_from_C(c * 10.0, t, np.maximum(p / DBAR, 0.0)))  # mS/cm


def _places(log: Log, near: Whereabouts | None, times: Times) -> tuple[tuple[Array, Array] | None, Mask, str]:
    """Latitude and longitude at times, deg, or None where no place is known; where they may be used; and in words."""
    fixed, (latitude, longitude) = log.together("latitude", "longitude")
    places = Whereabouts(fixed, latitude, longitude) if len(fixed) else near
    if places is None:  # none is made up
        return None, np.zeros(len(times), dtype=bool), "reference salinity, no position is known"
    where = "between the fixes" if len(fixed) else "that are no fixes: interpolated or reckoned by the vehicle"
    near_by = _distance(times, places.time_ns) <= FARTHEST
    return places.at(times), near_by, f"absolute salinity at positions {where}"


def _pressure(depth: Array, placed: tuple[Array, Array] | None) -> tuple[Array, str]:
    """Sea pressure, dbar, of depth, m, by TEOS-10, and how."""
    import gsw

    latitude = np.full(len(depth), 45.0) if placed is None else placed[0]
    place = "at latitude 45 deg, none is known" if placed is None else "and latitude"
    p_dbar = gsw.p_from_z(-np.maximum(depth, 0.0), latitude)
    return np.asarray(p_dbar), f"; no pressure is recorded, it is that of depth {place} (gsw.p_from_z)"


def _absolute(s: Array, p_dbar: Array, placed: tuple[Array, Array] | None, near_by: Mask) -> Array:
    """Absolute salinity, g/kg, of practical salinity where a place is known, else reference salinity."""
    import gsw

    absolute = gsw.SR_from_SP(s)
    if placed is not None:
        latitude, longitude = placed
        absolute = np.where(near_by, gsw.SA_from_SP(s, p_dbar, np.mod(longitude, 360.0), latitude), absolute)
    return np.asarray(absolute)


def _density(absolute: Array, t: Array, p_dbar: Array, heat: str) -> Array:
    """In-situ density, kg/m3, of absolute salinity and in-situ or conservative temperature, degC."""
    import gsw

    return np.asarray((gsw.rho_t_exact if heat == HEATS[0] else gsw.rho)(absolute, t, p_dbar))


def _distance(times: Times, fixed: Times) -> Times:
    """From each time to the nearest of others, increasing, ns."""
    after = np.clip(np.searchsorted(fixed, times), 1, max(len(fixed) - 1, 1))
    nearest = np.minimum(after, len(fixed) - 1)
    return np.asarray(np.minimum(np.abs(times - fixed[after - 1]), np.abs(times - fixed[nearest])))
