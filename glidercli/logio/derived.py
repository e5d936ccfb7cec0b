"""What follows from recorded channels alone? Vertical speed, salinity and density; each marked as derived."""

from __future__ import annotations

import numpy as np

from glidercli.log import Channel, Log
from glidercli.units import DBAR

__all__ = ["LONGEST_GAP", "with_derived"]

LONGEST_GAP = 300.0
"""s; nothing is derived across a longer gap between samples."""


def with_derived(log: Log) -> Log:
    """The log with vertical speed (from depth) and practical salinity and density (TEOS-10) where they can be had."""
    extra = []
    if "depth" in log and "vertical_speed" not in log:
        extra.append(_vertical_speed(log["depth"]))
    if {"conductivity", "temperature", "pressure"} <= log.channels.keys() and "salinity" not in log:
        extra += _seawater(log)
    return log.with_channels(*(channel for channel in extra if len(channel)))


def _vertical_speed(depth: Channel) -> Channel:
    """Central difference of depth by time, m/s, positive down; left out beside a long gap."""
    time = depth.time_ns * 1e-9
    ahead, behind = np.diff(time)[1:], np.diff(time)[:-1]
    near = (ahead <= LONGEST_GAP) & (behind <= LONGEST_GAP)
    speed = (depth.values[2:] - depth.values[:-2]) / (ahead + behind) if len(depth) > 2 else np.array([])
    return Channel("vertical_speed", depth.time_ns[1:-1][near], speed[near], "derived")


def _seawater(log: Log) -> list[Channel]:
    """Practical salinity and in-situ density at the times that conductivity, temperature and pressure share."""
    import gsw

    conductivity, temperature, pressure = (log[name] for name in ("conductivity", "temperature", "pressure"))
    times = np.intersect1d(np.intersect1d(conductivity.time_ns, temperature.time_ns), pressure.time_ns)
    c, t, p = (
        channel.values[np.searchsorted(channel.time_ns, times)] for channel in (conductivity, temperature, pressure)
    )
    p_dbar = np.maximum(p / DBAR, 0.0)
    salinity = gsw.SP_from_C(c * 10.0, t, p_dbar)  # mS/cm
    if "longitude" in log and "latitude" in log:
        longitude, latitude = (float(np.median(log[name].values)) for name in ("longitude", "latitude"))
        absolute = gsw.SA_from_SP(salinity, p_dbar, longitude, latitude)
    else:
        absolute = gsw.SR_from_SP(salinity)  # reference salinity: no place is known, and none is made up
    density = gsw.rho_t_exact(absolute, t, p_dbar)
    found = []
    for name, values in (("salinity", salinity), ("density", density)):
        good = np.isfinite(values)
        found.append(Channel(name, times[good], values[good], "derived"))
    return found
