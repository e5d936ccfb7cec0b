"""What does a comparison come to, in words? Sentences for a page, each a piece of HTML, from the document's numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from glidercli.compare.facts import Facts
from glidercli.compare.first import First
from glidercli.compare.page.html import escaped, number
from glidercli.utc import to_second

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison, Run

__all__ = ["duration", "overview", "run_words"]

_NAMED = 3
"""Channels that are named as the closest and as the farthest."""

_METHODS = {
    "none": "the clocks were left as they were recorded",
    "start": "the simulated clock was shifted so that both logs' first depth samples fall together",
    "gps": "the simulated clock was shifted so that both logs' first positions fall together",
    "dive": "the simulated clock was shifted so that both logs' first dives begin together",
    "xcorr": "the simulated clock was shifted to where the two depth curves lie closest",
}


def overview(comparison: Comparison) -> str:
    """One sentence on what was held against what."""
    runs = comparison.runs
    ours = _listed([f"<b>{escaped(run.side.name)}</b>" for run in runs[:6]])
    more = f" and {len(runs) - 6} more" if len(runs) > 6 else ""
    simulation = "simulation" if len(runs) == 1 else f"{len(runs)} simulations"
    if isinstance(comparison.against, Facts):
        facts = comparison.against
        title = f"{escaped(facts.title)}, " if facts.title else ""
        return (
            f"The {simulation} {ours}{more} {'was' if len(runs) == 1 else 'were'} held against "
            f"{len(facts.facts)} published values: {title}{escaped(facts.source)}."
        )
    return (
        f"The {simulation} {ours}{more} {'was' if len(runs) == 1 else 'were'} held against the log "
        f"<b>{escaped(comparison.measured.name)}</b>. Errors are simulated less {comparison.first.noun}, at the "
        f"times of the {comparison.first.of('samples')}."
    )


def run_words(comparison: Comparison, run: Run, part: Mapping[str, Any]) -> list[str]:
    """Sentences on one simulation. part : its document."""
    if isinstance(comparison.against, Facts):
        return _verdicts(part["facts"])
    first = comparison.first
    return [
        sentence
        for sentence in (_clock(part), _times(run), *_channels(part, first), _events(part, first), _track(part, first))
        if sentence
    ]


def duration(seconds: float) -> str:
    """A time span in the unit that people would use."""
    for unit, size in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if abs(seconds) >= 2.0 * size:
            return f"{number(float(f'{seconds / size:.3g}'))} {unit}"
    return f"{number(float(f'{seconds:.3g}'))} s"


def _listed(items: Sequence[str]) -> str:
    return ", ".join(items[:-1]) + " and " + items[-1] if len(items) > 1 else "".join(items)


def _clock(part: Mapping[str, Any]) -> str:
    clock = part.get("align")
    if not clock:
        return ""
    method = escaped(_METHODS.get(clock["method"], f"the clocks were aligned by {clock['method']}"))
    offset = f", {number(clock['offset_s'])} s of it asked for as offset" if clock["offset_s"] else ""
    moved = "" if clock["method"] == "none" and not clock["shift_s"] else f": {number(clock['shift_s'])} s{offset}"
    note = f" ({escaped(clock['note'])})" if clock.get("note") else ""
    return f"In time {method}{moved}{note}."


def _times(run: Run) -> str:
    times = [one.time_ns for one in run.residuals.values() if len(one.time_ns)]
    if not times:
        return ""
    first, last = min(int(t[0]) for t in times), max(int(t[-1]) for t in times)
    return f"What is compared lies between {to_second(first)} and {to_second(last)}, {duration((last - first) * 1e-9)}."


def _channels(part: Mapping[str, Any], first: First) -> list[str]:
    channels = part["channels"]
    held = {name: one for name, one in channels.items() if one["n"]}
    if not held:
        return []
    said = [
        f"{len(held)} of {len(channels)} common channels could be compared"
        if len(held) < len(channels)
        else f"All {len(held)} common channels were compared"
        if len(held) > 1
        else "One channel was compared"
    ]
    empty = [_named(name) for name in channels if name not in held]
    if empty:
        said[0] += f"; without a sample between simulated ones {'are' if len(empty) > 1 else 'is'} {_listed(empty)}"
    said[0] += "."
    if "depth" in held:
        one = held["depth"]
        way = "deeper" if one["bias"] > 0 else "shallower"
        said.append(
            f"Depth is off by {number(one['rmse'])} m (RMSE): the simulation is {number(abs(one['bias']))} m {way} on "
            f"average, {number(one['max'])} m off at most."
        )
    ranked = sorted((n for n in held if held[n]["nrmse"] is not None), key=lambda name: float(held[name]["nrmse"]))
    if len(ranked) > 1:
        count = min(_NAMED, len(ranked) // 2)
        close = _listed([_share(name, held[name]) for name in ranked[:count]])
        far = _listed([_share(name, held[name]) for name in ranked[: -count - 1 : -1]])
        said.append(f"Closest, by RMSE against the range of the {first.of('values')}: {close}. Farthest: {far}.")
    still = [_named(name) for name in held if held[name]["nrmse"] is None]
    if still:
        constant = "Measured as constant" if first.word == "measured" else "Constant in the first log"
        said.append(f"{constant}, so without a range to hold an error against: {_listed(still)}.")
    return said


def _share(name: str, one: Mapping[str, Any]) -> str:
    unit = "" if one["unit"] == "1" else f" {one['unit']}"
    ratio = one["nrmse"]
    share = f"{100.0 * ratio:.3g} % of" if ratio < 2.0 else f"{number(float(f'{ratio:.3g}'))} times"
    return f"{_named(name)} ({number(one['rmse'])}{escaped(unit)}, {share} the range)"


def _named(name: str) -> str:
    return escaped(name.replace("_", " "))


def _events(part: Mapping[str, Any], first: First) -> str:
    events = part.get("events") or []
    if not events:
        return ""
    both = sum(one["measured"] is not None and one["simulated"] is not None for one in events)
    alone = sum(one["simulated"] is None for one in events)
    return (
        f"{both} of {len(events)} events are in both logs; {alone} were met in the {first.word} one alone, "
        f"{len(events) - both - alone} in the simulated one alone."
    )


def _track(part: Mapping[str, Any], first: First) -> str:
    track = part.get("track")
    whole = (track or {}).get("absolute") or {}
    if whole.get("rmse") is None:
        return ""
    return (
        f"The simulated track lies {number(whole['rmse'])} m (RMSE) from the {first.word} one, "
        f"{number(whole['max'])} m at most."
    )


def _verdicts(facts: Sequence[Mapping[str, Any]]) -> list[str]:
    agree = [one for one in facts if one["verdict"] == "agrees"]
    disagree = [one for one in facts if one["verdict"] == "disagrees"]
    given = sum(bool(one["given"]) for one in agree)
    told = f" ({given} of them were given to the simulation, so that their agreement shows nothing)" if given else ""
    left = len(facts) - len(agree) - len(disagree)
    said = [
        f"Of {len(facts)} published values {len(agree)} agree within their tolerance{told}, {len(disagree)} disagree"
        + (f", {left} were not simulated." if left else ".")
    ]
    if disagree:
        listed = [
            f"{escaped(one['name'])}: published {number(one['published'])} ± {number(one['tolerance'])}, simulated "
            f"{number(one['simulated'])} {escaped(one['unit'])}"
            for one in disagree
        ]
        said.append(f"What disagrees: {'; '.join(listed)}.")
    return said
