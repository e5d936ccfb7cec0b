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

NEAR = ("near_latitude_deg", "near_longitude_deg")
"""Metadata of a log without fixes: roughly where it was."""

FARTHEST = 30 * 86400 * 10**9
"""ns from the nearest fix, beyond which no position is taken: of a clock that is a year off none is known."""


def with_seawater(log: Log, near: Whereabouts | None = None) -> Log:
    """The log with salinity and density where it lacks them and has what they follow from.

    near : positions that are no fixes, used where the log has no fix; the metadata near_latitude_deg and
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
    if "density" not in log and {"salinity", "temperature", "pressure"} <= log.channels.keys():
        times, (s, t, p) = log.together("salinity", "temperature", "pressure")
        density, place = _density(log, near, times, s, t, p)
        log, told = _with(log, "density", times, density)
        if told:
            notes["density_note"] = f"derived: TEOS-10, in situ, {place} (gsw.rho_t_exact)"
    return log.with_metadata(**notes)


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


def _density(log: Log, near: Whereabouts | None, times: Times, s: Array, t: Array, p: Array) -> tuple[Array, str]:
    """In-situ density, kg/m3, and with which salinity."""
    import gsw

    p_dbar = np.maximum(p / DBAR, 0.0)
    fixed, (latitude, longitude) = log.together("latitude", "longitude")
    places = Whereabouts(fixed, latitude, longitude) if len(fixed) else near
    if places is not None:
        latitude, longitude = places.at(times)
        far = _distance(times, places.time_ns) > FARTHEST
        absolute = np.where(far, gsw.SR_from_SP(s), gsw.SA_from_SP(s, p_dbar, np.mod(longitude, 360.0), latitude))
        where = "between the fixes" if len(fixed) else "that are no fixes: interpolated or reckoned by the vehicle"
        told = f"absolute salinity at positions {where}"
        if far.any():
            told += f", reference salinity for {int(far.sum())} samples more than 30 days from any of them"
        return gsw.rho_t_exact(absolute, t, p_dbar), told
    # no place is known, and none is made up
    return gsw.rho_t_exact(gsw.SR_from_SP(s), t, p_dbar), "reference salinity, no position is known"


def _distance(times: Times, fixed: Times) -> Times:
    """From each time to the nearest of others, increasing, ns."""
    after = np.clip(np.searchsorted(fixed, times), 1, max(len(fixed) - 1, 1))
    nearest = np.minimum(after, len(fixed) - 1)
    return np.asarray(np.minimum(np.abs(times - fixed[after - 1]), np.abs(times - fixed[nearest])))
