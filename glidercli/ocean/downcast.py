"""Which samples of a lowered CTD make a profile? The last descent, less what cannot be true, counted by reason."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["CONDUCTIVITY", "DEEPEST_DBAR", "DENSITY", "IN_AIR", "SALINITY", "TEMPERATURE", "Samples", "downcast"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

DEEPEST_DBAR = 12000.0
"""Greatest sea pressure allowed, dbar; the deepest trench has 11,250."""
SALINITY = (0.0, 45.0)
"""Practical or absolute salinity allowed; PSS-78 ends at 42."""
TEMPERATURE = (-3.0, 45.0)
"""In-situ temperature allowed, degC."""
CONDUCTIVITY = (0.0, 10.0)
"""Conductivity allowed, S/m; the saltiest warm sea has 7."""
DENSITY = (990.0, 1100.0)
"""In-situ density allowed, kg/m3: fresh water at 45 degC to brine in the deepest trench."""

IN_AIR = 1e-3
"""S/m; a cell in air reads 3e-4, mountain streams are above 2e-3."""
_FILLING = 1.05  # ratio from sample to sample while water enters the cell
_SPIKE_REACH = 5  # samples to either side that a pressure is held against
_SPIKE_STEPS = 10.0  # deviation, in ordinary steps, that no winch makes
_SPIKE_LEAST = 5.0  # dbar; swell and sensor noise stay below
_PAIR_TEMPERATURE = 0.5  # degC; two good sensors differ by less, even in a thermocline
_PAIR_SALINITY = 0.2  # 0.15 kg/m3 of density


@dataclass(frozen=True)
class Samples:
    """What a CTD recorded, in time order; arrays (n,) with NaN where there is no value.

    flagged : marked bad by the processing software.
    conductivity : S/m, or None; tells air from water.
    second_temperature, second_salinity : of the second pair of sensors, or None.
    """

    pressure_dbar: Array
    temperature: Array
    salinity: Array
    flagged: Mask
    conductivity: Array | None
    second_temperature: Array | None
    second_salinity: Array | None


class _Sieve:
    """Samples still in, and how many were taken out for which reason; each counts under its first reason."""

    def __init__(self, count: int) -> None:
        self.inside: Mask = np.ones(count, dtype=bool)
        self.dropped: list[tuple[str, int]] = []

    def drop(self, reason: str, samples: Mask) -> None:
        count = int((self.inside & samples).sum())
        if count:
            self.dropped.append((reason, count))
            self.inside &= ~samples


def downcast(samples: Samples) -> tuple[NDArray[np.intp], tuple[tuple[str, int], ...], tuple[str, ...]]:
    """Indices of the samples that make the profile, what was dropped as (reason, count), and warnings.

    The profile is the descent to the greatest pressure. Of the samples before it one is kept if all later ones are
    deeper, so that a soak near the surface and the loops of a heaving ship leave only the last passage of each depth.
    Pressures of the indices are strictly increasing.
    """
    p, t, s = samples.pressure_dbar, samples.temperature, samples.salinity
    sieve = _Sieve(len(p))
    sieve.drop("bad flag", samples.flagged)
    sieve.drop("missing value", ~(np.isfinite(p) & np.isfinite(t) & np.isfinite(s)))
    sieve.drop(f"pressure outside 0..{DEEPEST_DBAR:g} dbar", _outside(p, (0.0, DEEPEST_DBAR)))
    sieve.drop("pressure spike", _spikes(p, sieve.inside))
    if samples.conductivity is not None:
        sieve.drop("in air, or the cell filling", _in_air(samples.conductivity))
    sieve.drop(f"temperature outside {TEMPERATURE[0]:g}..{TEMPERATURE[1]:g} degC", _outside(t, TEMPERATURE))
    sieve.drop(f"salinity outside {SALINITY[0]:g}..{SALINITY[1]:g}", _outside(s, SALINITY))
    warnings = _drop_disagreeing(samples, sieve)

    index = np.flatnonzero(sieve.inside)
    if len(index):
        deepest = index[np.argmax(p[index])]
        order = np.arange(len(p))
        sieve.drop("upcast", order > deepest)
        index = np.flatnonzero(sieve.inside)
        later = np.minimum.accumulate(p[index][::-1])[::-1]  # least pressure from each sample on
        reversal = np.zeros(len(p), dtype=bool)
        reversal[index] = p[index] > later
        sieve.drop("pressure reversal", reversal)
        index = np.flatnonzero(sieve.inside)
        duplicate = np.zeros(len(p), dtype=bool)
        duplicate[index[:-1]] = np.diff(p[index]) == 0.0
        sieve.drop("duplicate pressure", duplicate)
    return np.flatnonzero(sieve.inside), tuple(sieve.dropped), warnings


def _outside(values: Array, allowed: tuple[float, float]) -> Mask:
    """Where values are outside a range."""
    return (values < allowed[0]) | (values > allowed[1])


def _spikes(pressure: Array, inside: Mask) -> Mask:
    """Where pressure leaves the median of its neighbours by more than an instrument on a wire can.

    A steady descent lies on its running median however wide its steps are, and at a turn it leaves it by a few steps;
    allowed are ten ordinary steps (the upper quartile of the file's) and never less than 5 dbar.
    """
    spikes = np.zeros(len(pressure), dtype=bool)
    p = pressure[inside]
    if len(p) <= 2:
        return spikes
    padded = np.pad(p, _SPIKE_REACH, constant_values=np.nan)
    around = np.nanmedian(np.lib.stride_tricks.sliding_window_view(padded, 2 * _SPIKE_REACH + 1), axis=1)
    step = float(np.quantile(np.abs(np.diff(p)), 0.75))
    spikes[inside] = np.abs(p - around) > max(_SPIKE_LEAST, _SPIKE_STEPS * step)
    return spikes


def _in_air(conductivity: Array) -> Mask:
    """Where the cell holds air, or is still filling just after it did."""
    out = conductivity < IN_AIR
    for last in np.flatnonzero(out[:-1] & ~out[1:]):
        i = last + 1
        while i + 1 < len(out) and conductivity[i + 1] > _FILLING * conductivity[i]:
            out[i] = True
            i += 1
    return out


def _drop_disagreeing(samples: Samples, sieve: _Sieve) -> tuple[str, ...]:
    """Drop where the two pairs of sensors contradict each other; if that is most of the cast, warn instead."""
    apart = np.zeros(len(samples.pressure_dbar), dtype=bool)
    if samples.second_temperature is not None:
        apart |= np.abs(samples.temperature - samples.second_temperature) > _PAIR_TEMPERATURE
    if samples.second_salinity is not None:
        apart |= np.abs(samples.salinity - samples.second_salinity) > _PAIR_SALINITY
    limits = f"more than {_PAIR_TEMPERATURE:g} degC or {_PAIR_SALINITY:g} in salinity"
    count, total = int((apart & sieve.inside).sum()), int(sieve.inside.sum())
    if 2 * count > total:
        return (f"the two pairs of sensors differ by {limits} in {count} of {total} samples; the first pair is used",)
    sieve.drop(f"the two pairs of sensors differ by {limits}", apart)
    return ()
