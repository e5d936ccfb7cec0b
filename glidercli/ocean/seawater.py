"""What does seawater weigh? The TEOS-10 standard (IOC, SCOR and IAPSO 2010), by the GSW toolbox.

Symbols of the manual: SP practical salinity (PSS-78, no unit), SA absolute salinity (g/kg), t in-situ temperature
(degC, ITS-90), CT conservative temperature (degC), p sea pressure (dbar: absolute less 10.1325 dbar). All functions
take numbers or arrays and give arrays. Depth is positive down; longitude and latitude are in degrees, east and north
positive. Values outside the fitted range are not clipped; readers check theirs beforehand.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from glidercli.errors import InputError

__all__ = [
    "absolute_salinity",
    "checked_latitude",
    "conductivity",
    "conservative_temperature",
    "density",
    "depth_from_pressure",
    "gravity",
    "practical_of_absolute",
    "practical_salinity",
    "pressure_from_depth",
    "salinity_of_density",
    "t90_from_t68",
    "temperature_from_conservative",
    "temperature_from_potential",
]

Array = NDArray[np.float64]

_STATES_DIFFER = 0.1  # kg/m3
_ROUNDS = 7  # each leaves at most 2 % of the error, of 35 g/kg at first


def practical_salinity(conductivity: ArrayLike, temperature: ArrayLike, pressure_dbar: ArrayLike) -> Array:
    """SP from conductivity in S/m, t and p, by PSS-78, extended below 2 after Hill et al. (1986)."""
    import gsw

    millisiemens_per_centimetre = 10.0 * np.asarray(conductivity, dtype=float)
    return np.asarray(gsw.SP_from_C(millisiemens_per_centimetre, temperature, pressure_dbar), dtype=float)


def absolute_salinity(salinity: ArrayLike, pressure_dbar: ArrayLike, longitude: float | None, latitude: float) -> Array:
    """SA, g/kg, from SP, p and place, by the global anomaly atlas of McDougall et al. (2012).

    Without a longitude, and where the atlas has no value, it is the reference salinity, SP 35.16504 / 35: too small by
    up to 0.025 g/kg (0.02 kg/m3 of density) in the open ocean, 0.07 g/kg in the Baltic.
    """
    import gsw

    reference = np.asarray(gsw.SR_from_SP(salinity), dtype=float)
    if longitude is None:
        return reference
    here = np.asarray(gsw.SA_from_SP(salinity, pressure_dbar, longitude, latitude), dtype=float)
    return np.where(np.isfinite(here), here, reference)


def practical_of_absolute(
    absolute_salinity: ArrayLike, pressure_dbar: ArrayLike, longitude: float | None, latitude: float
) -> Array:
    """SP from SA in g/kg, p and place: the inverse of ``absolute_salinity``, with or without a longitude."""
    import gsw

    reference = np.asarray(gsw.SP_from_SR(absolute_salinity), dtype=float)
    if longitude is None:
        return reference
    here = np.asarray(gsw.SP_from_SA(absolute_salinity, pressure_dbar, longitude, latitude), dtype=float)
    return np.where(np.isfinite(here), here, reference)


def conductivity(salinity: ArrayLike, temperature: ArrayLike, pressure_dbar: ArrayLike) -> Array:
    """Conductivity, S/m, from SP, t and p by PSS-78: the inverse of ``practical_salinity``."""
    import gsw

    return 0.1 * np.asarray(gsw.C_from_SP(salinity, temperature, pressure_dbar), dtype=float)


def salinity_of_density(density: ArrayLike, temperature: ArrayLike, pressure_dbar: ArrayLike) -> Array:
    """SA, g/kg, of water with a density in situ, kg/m3, at t and p: the inverse of ``density``.

    NaN where no salinity gives this density; 0 where fresh water is heavier by no more than 0.1 kg/m3, what equations
    of state differ by. CT, which depends on SA, is improved in turn with it.
    """
    import gsw

    rho, t, p = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in (density, temperature, pressure_dbar)))
    fresh = gsw.rho(np.zeros_like(rho), conservative_temperature(np.zeros_like(rho), t, p), p)
    near_fresh = (rho >= fresh - _STATES_DIFFER) & (rho < fresh + 2.0)  # a first round may come out below zero
    salt = np.full_like(rho, 35.0)
    for _ in range(_ROUNDS):  # so many for all, that a value does not depend on its neighbours
        salt = np.asarray(gsw.SA_from_rho(rho, conservative_temperature(salt, t, p), p), dtype=float)
        salt = np.where(np.isnan(salt) & near_fresh, 0.0, salt)
    return salt


def conservative_temperature(absolute_salinity: ArrayLike, temperature: ArrayLike, pressure_dbar: ArrayLike) -> Array:
    """CT, degC, from SA in g/kg, t and p."""
    import gsw

    return np.asarray(gsw.CT_from_t(absolute_salinity, temperature, pressure_dbar), dtype=float)


def temperature_from_conservative(absolute_salinity: ArrayLike, conservative: ArrayLike, pressure: ArrayLike) -> Array:
    """t, degC, from SA in g/kg, CT in degC and p in dbar."""
    import gsw

    return np.asarray(gsw.t_from_CT(absolute_salinity, conservative, pressure), dtype=float)


def temperature_from_potential(absolute_salinity: ArrayLike, potential: ArrayLike, pressure: ArrayLike) -> Array:
    """t, degC, from SA in g/kg, potential temperature at the surface in degC and p in dbar."""
    import gsw

    conservative = gsw.CT_from_pt(absolute_salinity, potential)
    return temperature_from_conservative(absolute_salinity, conservative, pressure)


def density(absolute_salinity: ArrayLike, temperature: ArrayLike, pressure_dbar: ArrayLike) -> Array:
    """In-situ density, kg/m3, from SA in g/kg, t and p: the 75-term polynomial of Roquet et al. (2015)."""
    import gsw

    conservative = conservative_temperature(absolute_salinity, temperature, pressure_dbar)
    return np.asarray(gsw.rho(absolute_salinity, conservative, pressure_dbar), dtype=float)


def depth_from_pressure(pressure_dbar: ArrayLike, latitude: float) -> Array:
    """Depth, m, positive down, of a pressure, in standard water (SA 35.16504 g/kg, 0 degC) at a latitude."""
    import gsw

    return -np.asarray(gsw.z_from_p(pressure_dbar, latitude), dtype=float)


def pressure_from_depth(depth: ArrayLike, latitude: float) -> Array:
    """Pressure, dbar, at a depth in m, positive down; the inverse of ``depth_from_pressure``."""
    import gsw

    return np.asarray(gsw.p_from_z(-np.asarray(depth, dtype=float), latitude), dtype=float)


def gravity(latitude: float) -> float:
    """Acceleration of gravity at the sea surface, m/s2, by the formula of GRS80 (Moritz 2000)."""
    import gsw

    return float(gsw.grav(checked_latitude(latitude), 0.0))


def checked_latitude(latitude: float) -> float:
    """The latitude, deg, if it lies on the globe; else InputError."""
    if not -90.0 <= latitude <= 90.0:
        raise InputError("latitude", f"{latitude:g} deg, allowed -90 to 90")
    return latitude


def t90_from_t68(temperature_68: ArrayLike) -> Array:
    """Temperature on ITS-90 from that on IPTS-68, degC: t90 = t68 / 1.00024 (Saunders 1990)."""
    return np.asarray(temperature_68, dtype=float) / 1.00024
