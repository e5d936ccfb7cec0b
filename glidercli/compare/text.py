"""What does a person read first of a comparison? One sentence on what was compared, then compact tables."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from glidercli.aligned import table
from glidercli.compare.errors import Errors
from glidercli.compare.events import EventPair
from glidercli.compare.facts import FLIGHT, Facts
from glidercli.compare.first import First
from glidercli.compare.tracks import TrackErrors
from glidercli.units import NANOSECOND
from glidercli.utc import to_second

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison, Run

__all__ = ["text"]

_ERRORS = ("channel", "unit", "n", "rmse", "mae", "bias", "std", "max", "correlation", "nrmse", "skipped")
_TOLD = ("deepest", "apogee", "bottom", "surfacing")
"""Events that are told to people; recordings have hundreds of others."""
_MOST_BANDS = 8
"""Bands of depth that a terminal has room for."""
_FACTS = ("fact", "published", "simulated", "unit", "verdict", "place")


def text(comparison: Comparison) -> str:
    """The whole comparison as lines."""
    parts = [_run(comparison, run) for run in comparison.runs]
    if len(parts) > 1:
        parts.append(_ranking(comparison))
    return "\n\n".join("\n".join(part) for part in parts)


def _run(comparison: Comparison, run: Run) -> list[str]:
    if isinstance(comparison.against, Facts):
        return _facts(comparison, comparison.against, run)
    lines = [f"Compared {run.side} with {comparison.measured}; {_clock(run)}."]
    lines.append(f"Errors are {run.side.name} less {comparison.measured.name}.")
    for title, rows in (("flight", run.channels), *run.by_phase.items()):
        if rows:
            lines += ["", f"{title}:", *table(_ERRORS, [_row(name, errors) for name, errors in rows.items()], 2)]
    if len(run.bands) > 1:
        lines += ["", f"rmse by {comparison.first.of('depth')}, m:", *_bands(run)]
    if run.outcomes:
        lines += ["", "both flights, over the time that both cover:", *_outcomes(run, comparison.first)]
    if run.track is not None:
        lines += ["", *_track(run.track)]
    if events := [pair for pair in run.events if pair.name in _TOLD and pair.measured and pair.simulated]:
        lines += ["", "events:", *_events(events, comparison.first)]
    return [*lines, "", *(f"Note: {note}." for note in run.notes)] if run.notes else lines


def _clock(run: Run) -> str:
    """How its clock was laid on the measured one's."""
    if run.alignment is None:
        return ""
    shift = f"clock of {run.side.name} shifted by {run.alignment.shift:z.3f} s (align {run.alignment.method})"
    return f"{shift}, {run.alignment.note}" if run.alignment.note else shift


def _bands(run: Run) -> list[str]:
    """The root mean square error of each channel in each band of depth."""
    shown = run.bands[:_MOST_BANDS]
    head = ("channel", "unit", *(f"{band.top:g}-{band.bottom:g}" for band in shown))
    rows = [
        [name, one.unit, *(_number(band.channels[name].rmse if name in band.channels else None) for band in shown)]
        for name, one in run.channels.items()
        if any(name in band.channels for band in shown)
    ]
    left = len(run.bands) - len(shown)
    return [*table(head, rows, 2), *([f"{left} deeper bands are in the outputs and in --json."] if left else [])]


def _outcomes(run: Run, first: First) -> list[str]:
    rows = [
        [one.name, one.unit, *map(_number, (one.measured, one.simulated, one.difference)), _percent(one.relative)]
        for one in run.outcomes
    ]
    return table(("figure", "unit", first.word, "simulated", "difference", "relative"), rows, 2)


def _track(track: TrackErrors) -> list[str]:
    """The errors of a track in sentences."""
    far, left = track.absolute, track.aligned
    kind = "Level track" if track.level else "Track"
    lines = [
        f"{kind} of {far.n} samples, both {track.origin}: {_number(far.rmse)} m off (rmse; mean {_number(far.mean)}, "
        f"largest {_number(far.max)} m).",
        f"After a turn of {math.degrees(track.turn):z.1f} deg and a shift: {_number(left.rmse)} m.",
    ]
    for one in track.relative:
        of_way = f", {_percent(one.of_way)} of the way" if one.of_way is not None else ""
        lines.append(f"Drift over {one.over:g} s: {_number(one.rmse)} m (rmse of {one.n} pairs){of_way}.")
    return lines


def _events(pairs: list[EventPair], first: First) -> list[str]:
    """Those of all events that say how a dive went."""
    rows = []
    for pair in pairs:
        assert pair.measured is not None
        assert pair.simulated is not None
        later = (pair.simulated.time_ns - pair.measured.time_ns) * NANOSECOND
        depths = pair.measured.depth, pair.simulated.depth
        deeper = None if depths[0] is None or depths[1] is None else depths[1] - depths[0]
        apart = None if pair.apart is None else math.hypot(*pair.apart)
        of_way = None if apart is None or not pair.way else apart / pair.way
        numbers = [*map(_number, (later, *depths, deeper, apart))]
        rows.append([pair.name, to_second(pair.measured.time_ns), *numbers, _percent(of_way)])
    head = ("event", f"{first.word}, UTC", "later, s", "depth, m", "simulated", "deeper, m", "apart, m", "of the way")
    return table(head, rows, 2)


def _ranking(comparison: Comparison) -> list[str]:
    """The simulations from the closest on."""
    if isinstance(comparison.against, Facts):
        meaning = "part of the judged facts that agree, those given to a simulation apart"
    else:
        names = ", ".join(comparison.ranking[0].by).replace("_", " ") or "no channel"
        meaning = f"mean of nrmse over {names}, at the samples that all were compared at"
    rows = [[_number(one.rank), one.name, _number(one.score), str(one.of)] for one in comparison.ranking]
    return [f"The closest first ({meaning}):", *table(("rank", "simulation", "score", "values"), rows, 0, left=(1,))]


def _percent(part: float | None) -> str:
    return "-" if part is None else f"{100.0 * part:z.3g} %"


def _row(name: str, errors: Errors) -> list[str]:
    numbers = [errors.rmse, errors.mae, errors.bias, errors.std, errors.max, errors.correlation, errors.nrmse]
    return [name, errors.unit, str(errors.n), *map(_number, numbers), str(errors.outside + errors.gap)]


def _facts(comparison: Comparison, facts: Facts, run: Run) -> list[str]:
    agree, disagree = (sum(one.verdict == word for one in run.facts) for word in ("agrees", "disagrees"))
    given = sum(one.verdict == "agrees" and one.fact.given for one in run.facts)
    which = f" ({given} of them given to the simulation)" if given else ""
    counted = f"{agree} agree{which}, {disagree} disagree, {len(run.facts) - agree - disagree} not simulated"
    lines = [
        f"Compared {run.side} with published values: {facts.title + ', ' if facts.title else ''}{facts.source}.",
        f"Of {len(run.facts)} facts: {counted}.",
        "",
    ]
    rows, notes = [], []
    for one in run.facts:
        fact = one.fact
        leg = "" if fact.phase == FLIGHT or fact.phase in fact.name.split() else f" ({fact.phase})"
        published = f"{fact.value:.6g} ± {fact.tolerance:.6g}"
        rows.append([fact.name + leg, published, _number(one.simulated), fact.unit, one.verdict, fact.place])
        remark = "; ".join(word for word in (one.reason, fact.note) if word)
        if remark:
            notes.append(f"{fact.name}: {remark}.")
    lines += table(_FACTS, rows, 1, left=(0, 3, 4, 5))
    return [*lines, "", *notes] if notes else lines


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:z.4g}"
