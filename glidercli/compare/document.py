"""What does the JSON of a comparison hold?

    align     {method, shift_s, offset_s}: the shift was added to the simulated times; null for published facts
    channels  {name: {unit, n, rmse, mae, bias, std, max, max_time_utc, correlation, nrmse, skipped, origins}}
    phases    {dive: {name: the same}, climb: {name: the same}}, by the measured log's phases
    events    [{name, measured, simulated, time_difference_s, depth_difference_m}]; side: {time_utc, depth_m} or null
    facts     [{name, published, simulated, tolerance, verdict, place, unit, difference, given, ...}]
    notes     what a reader of the errors must know, such as channels counted from different zeros
    origins   {measured: {name, origin, reconstruction}, simulated: [the same]}: measured, simulated or reconstruction

With several simulated logs ``simulations`` lists the first six keys for each, with its name; the keys above are then
those of the first, so that a reader of one simulation's form reads it unchanged.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.compare.errors import Errors
from glidercli.compare.events import EventPair
from glidercli.compare.facts import Facts
from glidercli.compare.verdicts import FactVerdict
from glidercli.log import Event, Log
from glidercli.units import NANOSECOND

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison, Run, Side

__all__ = ["document", "utc"]


def document(comparison: Comparison) -> dict[str, Any]:
    """The comparison as plain values."""
    against = comparison.against
    measured = against if isinstance(against, Log) else None
    parts = [_part(run, measured) for run in comparison.runs]
    origins: dict[str, Any] = {
        "measured": _origin(comparison.measured),
        "simulated": [_origin(run.side) for run in comparison.runs],
    }
    if isinstance(against, Facts):
        origins["measured"] |= {"source": against.source, "title": against.title}
    whole = {**parts[0], "origins": origins}
    if len(parts) > 1:
        whole["simulations"] = [
            {"name": run.side.name, **part} for run, part in zip(comparison.runs, parts, strict=True)
        ]
    return whole


def utc(time_ns: int) -> str:
    """A time as ISO 8601 with milliseconds and Z."""
    return f"{np.datetime64(time_ns, 'ns').astype('datetime64[ms]')}Z"


def _origin(side: Side) -> dict[str, Any]:
    return {"name": side.name, "origin": side.origin, "reconstruction": side.reconstruction or None}


def _part(run: Run, measured: Log | None) -> dict[str, Any]:
    origins = {
        name: {"measured": measured[name].origin, "simulated": run.log[name].origin}
        for name in run.channels
        if measured is not None
    }
    clock = run.alignment
    return {
        "align": clock and {"method": clock.method, "shift_s": clock.shift, "offset_s": clock.offset},
        "channels": {name: {**_errors(one), "origins": origins[name]} for name, one in run.channels.items()},
        "phases": {
            leg: {name: _errors(one) for name, one in run.by_phase.get(leg, {}).items()} for leg in ("dive", "climb")
        },
        "events": [_event(pair) for pair in run.events],
        "facts": [_fact(verdict) for verdict in run.facts],
        "notes": list(run.notes),
    }


def _errors(errors: Errors) -> dict[str, Any]:
    return {
        "unit": errors.unit,
        "n": errors.n,
        "rmse": errors.rmse,
        "mae": errors.mae,
        "bias": errors.bias,
        "std": errors.std,
        "max": errors.max,
        "max_time_utc": None if errors.max_time_ns is None else utc(errors.max_time_ns),
        "correlation": errors.correlation,
        "nrmse": errors.nrmse,
        "skipped": {"outside": errors.outside, "gap": errors.gap},
    }


def _event(pair: EventPair) -> dict[str, Any]:
    one, other = pair.measured, pair.simulated
    time = depth = None
    if one is not None and other is not None:
        time = (other.time_ns - one.time_ns) * NANOSECOND
        depth = None if one.depth is None or other.depth is None else other.depth - one.depth
    return {
        "name": pair.name,
        "measured": _side_of_event(one),
        "simulated": _side_of_event(other),
        "time_difference_s": time,
        "depth_difference_m": depth,
    }


def _side_of_event(event: Event | None) -> dict[str, Any] | None:
    if event is None:
        return None
    depth = event.depth if event.depth is not None and math.isfinite(event.depth) else None
    return {"time_utc": utc(event.time_ns), "depth_m": depth}


def _fact(verdict: FactVerdict) -> dict[str, Any]:
    fact = verdict.fact
    return {
        "name": fact.name,
        "published": fact.value,
        "simulated": verdict.simulated,
        "tolerance": fact.tolerance,
        "verdict": verdict.verdict,
        "place": fact.place,
        "unit": fact.unit,
        "difference": verdict.difference,
        "quantity": fact.quantity,
        "channel": fact.channel,
        "phase": fact.phase,
        "tolerance_reason": fact.tolerance_reason,
        "given": fact.given,
        "note": fact.note,
        "reason": verdict.reason,
    }
