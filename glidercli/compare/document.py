"""What does the JSON of a comparison hold?

    align     {method, shift_s, offset_s, certainty_s, other_shift_s, note}: the shift was added to the simulated times;
              other_shift_s is one that fits about as well (xcorr); null for published facts
    channels  {name: {unit, n, rmse, mae, bias, std, max, max_time_utc, correlation, nrmse, skipped, origins}}
    phases    {dive: {name: the same}, climb: {name: the same}}, by the measured log's phases
    bands     [{from_m, to_m, channels: {name: the same}}], by the measured depth
    outcomes  [{name, unit, measured, simulated, difference, relative}]: figures of both flights, over the common time
    track     {origin, level, absolute, aligned, relative, closure, ...}: see tracks.py; null where a log has no track
    events    [{name, measured, simulated, time_difference_s, time_relative, depth_difference_m, depth_relative,
              place_difference: {north_m, east_m, distance_m, relative}}]; side: {time_utc, depth_m} or null; relative
              to the time since the first measured sample, to the measured depth, to the measured way until then
    facts     [{name, published, simulated, tolerance, verdict, place, unit, difference, given, ...}]
    ranking   [{rank, name, score, of, by}]: the simulations from the closest on; score is what ranking.py tells
    notes     what a reader of the errors must know, such as channels counted from different zeros
    origins   {measured: {name, origin, reconstruction}, simulated: [the same]}: measured, simulated or reconstruction

With several simulated logs ``simulations`` lists for each, with its name, all keys but ranking and origins; the keys
above are then those of the first, so that a reader of one simulation's form reads it unchanged.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.compare.errors import Errors
from glidercli.compare.events import EventPair
from glidercli.compare.facts import Facts
from glidercli.compare.tracks import Distances, TrackErrors
from glidercli.compare.verdicts import FactVerdict
from glidercli.log import Event, Log
from glidercli.units import NANOSECOND

if TYPE_CHECKING:
    from glidercli.compare.align import Alignment
    from glidercli.compare.comparison import Comparison, Run, Side

__all__ = ["document", "part_of", "utc"]


def document(comparison: Comparison) -> dict[str, Any]:
    """The comparison as plain values."""
    against = comparison.against
    measured = against if isinstance(against, Log) else None
    parts = [part_of(run, measured) for run in comparison.runs]
    origins: dict[str, Any] = {
        "measured": _origin(comparison.measured),
        "simulated": [_origin(run.side) for run in comparison.runs],
    }
    if isinstance(against, Facts):
        origins["measured"] |= {"source": against.source, "title": against.title}
    ranking = [one._asdict() for one in comparison.ranking]
    whole = {**parts[0], "ranking": ranking, "origins": origins}
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


def part_of(run: Run, measured: Log | None) -> dict[str, Any]:
    """What is told of one simulation."""
    origins = {
        name: {"measured": measured[name].origin, "simulated": run.log[name].origin}
        for name in run.channels
        if measured is not None
    }
    clock = run.alignment
    return {
        "align": clock and _align(clock),
        "channels": {name: {**_errors(one), "origins": origins[name]} for name, one in run.channels.items()},
        "phases": {
            leg: {name: _errors(one) for name, one in run.by_phase.get(leg, {}).items()} for leg in ("dive", "climb")
        },
        "bands": [
            {"from_m": band.top, "to_m": band.bottom, "channels": {n: _errors(e) for n, e in band.channels.items()}}
            for band in run.bands
        ],
        "outcomes": [{**one._asdict(), "difference": one.difference, "relative": one.relative} for one in run.outcomes],
        "track": run.track and _track(run.track, run.events),
        "events": [_event(pair, measured) for pair in run.events],
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


def _align(clock: Alignment) -> dict[str, Any]:
    return {
        "method": clock.method,
        "shift_s": clock.shift,
        "offset_s": clock.offset,
        "certainty_s": clock.certainty,
        "other_shift_s": clock.other,
        "note": clock.note,
    }


def _track(track: TrackErrors, events: tuple[EventPair, ...]) -> dict[str, Any]:
    """The errors of a track; closure is where the last surfacing of both was."""
    surfacings = [pair for pair in events if pair.name == "surfacing" and pair.apart is not None]
    return {
        "origin": track.origin,
        "level": track.level,
        "absolute": _distances(track.absolute),
        "aligned": {**_distances(track.aligned), "turn_deg": math.degrees(track.turn)},
        "relative": [
            {"over_s": r.over, "n": r.n, "rmse": r.rmse, "mean": r.mean, "max": r.max, "of_way": r.of_way, "unit": "m"}
            for r in track.relative
        ],
        "way_m": {"measured": track.way, "simulated": track.simulated_way},
        "closure": _apart(surfacings[-1]) if surfacings else None,
        "skipped": {"outside": track.outside, "gap": track.gap},
    }


def _distances(far: Distances) -> dict[str, Any]:
    told = far._asdict()
    worst = told.pop("max_time_ns")
    return {**told, "max_time_utc": utc(worst), "unit": "m"}


def _apart(pair: EventPair) -> dict[str, Any]:
    """How far apart the places of an event are, m, and over the measured way until then."""
    assert pair.apart is not None
    distance = math.hypot(*pair.apart)
    relative = distance / pair.way if pair.way else None
    return {"north_m": pair.apart[0], "east_m": pair.apart[1], "distance_m": distance, "relative": relative}


def _event(pair: EventPair, measured: Log | None) -> dict[str, Any]:
    one, other = pair.measured, pair.simulated
    time = depth = since = None
    if one is not None and other is not None:
        time = (other.time_ns - one.time_ns) * NANOSECOND
        depth = None if one.depth is None or other.depth is None else other.depth - one.depth
        since = None if measured is None else (one.time_ns - measured.start_ns) * NANOSECOND
    return {
        "name": pair.name,
        "measured": _side_of_event(one),
        "simulated": _side_of_event(other),
        "time_difference_s": time,
        "time_relative": _relative(time, since),
        "depth_difference_m": depth,
        "depth_relative": _relative(depth, None if one is None else one.depth),
        "place_difference": None if pair.apart is None else _apart(pair),
    }


def _relative(difference: float | None, measured: float | None) -> float | None:
    return difference / abs(measured) if difference is not None and measured else None


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
