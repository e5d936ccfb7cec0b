"""What water did it meet? Practical salinity and in-situ density by TEOS-10, at the times of the CTD."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.log import Channel, Log
from glidercli.units import DBAR

__all__ = ["with_seawater"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]


FARTHEST = 30 * 86400 * 10**9
"""ns from the nearest fix, beyond which no position is taken: of a clock that is a year off none is known."""


def with_seawater(log: Log) -> Log:
    """The log with salinity and density where it lacks them and has what they follow from."""
    notes = {}
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
        density, place = _density(log, times, s, t, p)
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


def _density(log: Log, times: Times, s: Array, t: Array, p: Array) -> tuple[Array, str]:
    """In-situ density, kg/m3, and with which salinity."""
    import gsw

    p_dbar = np.maximum(p / DBAR, 0.0)
    if "longitude" in log and "latitude" in log:
        fixed, latitudes = log["latitude"].time_ns, log["latitude"].values
        longitude = np.interp(times, log["longitude"].time_ns, np.unwrap(log["longitude"].values, period=360.0))
        latitude = np.interp(times, fixed, latitudes)
        far = _distance(times, fixed) > FARTHEST
        absolute = np.where(far, gsw.SR_from_SP(s), gsw.SA_from_SP(s, p_dbar, np.mod(longitude, 360.0), latitude))
        place = "absolute salinity at positions between the fixes"
        if far.any():
            place += f", reference salinity for {int(far.sum())} samples more than 30 days from any fix"
        return gsw.rho_t_exact(absolute, t, p_dbar), place
    # no place is known, and none is made up
    return gsw.rho_t_exact(gsw.SR_from_SP(s), t, p_dbar), "reference salinity, no position is known"


def _distance(times: Times, fixed: Times) -> Times:
    """From each time to the nearest of others, increasing, ns."""
    after = np.clip(np.searchsorted(fixed, times), 1, max(len(fixed) - 1, 1))
    nearest = np.minimum(after, len(fixed) - 1)
    return np.asarray(np.minimum(np.abs(times - fixed[after - 1]), np.abs(times - fixed[nearest])))
