"""How does a simulation compare with a measured log, or with published values? ``compare`` answers that."""

from __future__ import annotations

import dataclasses
import fnmatch
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from glidercli.channels import CHANNELS, by_column
from glidercli.compare.align import Alignment, Method, align, shifted
from glidercli.compare.by_depth import Band, by_depth
from glidercli.compare.errors import Errors, statistics
from glidercli.compare.events import EventPair, events_of, located, paired
from glidercli.compare.facts import Facts
from glidercli.compare.first import First
from glidercli.compare.outcomes import Outcome, outcomes
from glidercli.compare.ranking import Ranked, ranked
from glidercli.compare.tracks import TrackErrors, tracks
from glidercli.compare.verdicts import FactVerdict, judged
from glidercli.dives import LEGS, Interval, mask, phases
from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.residuals import Residuals, residuals
from glidercli.units import NANOSECOND
from glidercli.utc import to_second

__all__ = ["Comparison", "Run", "Side", "compare", "matching"]

MAX_GAP = 60.0
"""s, longest time between two simulated samples to interpolate across, unless asked otherwise."""


@dataclasses.dataclass(frozen=True)
class Side:
    """What one side of a comparison is.

    origin : "measured", "simulated", "reconstruction", or "published" for facts.
    reconstruction : what the log says about the reconstruction that it is or was made from; "" where there is none.
    """

    name: str
    origin: str
    reconstruction: str = ""

    def __str__(self) -> str:
        return f"{self.name} ({self.kind})"

    @property
    def kind(self) -> str:
        """The origin, with what is said about a reconstruction."""
        if not self.reconstruction:
            return self.origin
        own = self.origin == "reconstruction"
        return f"{self.origin}{'' if own else ', made with a reconstruction'}: {self.reconstruction}"


@dataclasses.dataclass(frozen=True)
class Run:
    """One simulated log against the measured side; what does not apply to facts is empty, and the other way round.

    log : the simulated log on the measured clock.
    channels, by_phase, bands : statistics of each channel, over the whole flight, by phase and by depth of the
        measured log.
    outcomes : figures of both flights. track : errors of the track, None where a log has none.
    notes : what a reader of the errors must know, one line each.
    """

    side: Side
    log: Log
    alignment: Alignment | None = None
    residuals: Mapping[str, Residuals] = dataclasses.field(default_factory=dict)
    channels: Mapping[str, Errors] = dataclasses.field(default_factory=dict)
    by_phase: Mapping[str, Mapping[str, Errors]] = dataclasses.field(default_factory=dict)
    bands: tuple[Band, ...] = ()
    outcomes: tuple[Outcome, ...] = ()
    track: TrackErrors | None = None
    events: tuple[EventPair, ...] = ()
    facts: tuple[FactVerdict, ...] = ()
    notes: tuple[str, ...] = ()


@dataclasses.dataclass(frozen=True)
class Comparison:
    """A measured log or published facts, and one or more simulated logs held against it."""

    measured: Side
    against: Log | Facts
    runs: tuple[Run, ...]
    max_gap: float
    chosen: tuple[str, ...] | None
    """The channels asked for, or None for all."""

    @property
    def origin(self) -> str:
        """Origin of what is made from the comparison: "reconstruction" where one has a part in it, or "simulated"."""
        sides = (self.measured, *(run.side for run in self.runs))
        touched = any(side.reconstruction or side.origin == "reconstruction" for side in sides)
        return "reconstruction" if touched else "simulated"

    @property
    def first(self) -> First:
        """What words call the first side; see first.py."""
        return First(self.measured.origin)

    @property
    def ranking(self) -> tuple[Ranked, ...]:
        """The simulations from the closest on; see ranking.py."""
        return ranked(self.runs, self.chosen)

    def document(self) -> dict[str, Any]:
        """The JSON document of the contract; see document.py for its keys."""
        from glidercli.compare.document import document

        return document(self)

    def text(self) -> str:
        """The comparison as a short text with tables, for people."""
        from glidercli.compare.text import text

        return text(self)


def compare(
    measured: Log | Facts,
    simulated: Log | Sequence[Log],
    *,
    align: Method = "none",
    offset: float = 0.0,
    max_gap: float = MAX_GAP,
    channels: Sequence[str] | None = None,
    depth_band: float | None = None,
    names: Sequence[str] | None = None,
) -> Comparison:
    """Compare one or more simulated logs with a measured one, or with published values.

    align : how each simulated clock is laid on the measured one, see align.py.
    offset : s, added to the simulated times after that.
    max_gap : s, positive: simulated samples further apart are not interpolated between.
    channels : names, column names or patterns (mass_*) of the channels to compare; default: all that both sides have.
    depth_band : m, positive: width of the bands of depth that errors are told by; default: one that makes a few.
    names : what to call the measured side and each simulated log; default: "measured" and "simulated";
        "first" where that log is simulated or a reconstruction.

    Raises InputError when nothing can be compared: no common channel, no measured sample within the simulated ones.
    """
    logs = (simulated,) if isinstance(simulated, Log) else tuple(simulated)
    if not logs:
        raise InputError("compare", "no simulated log; at least one is needed")
    first = First("published" if isinstance(measured, Facts) else measured.origin)
    labels = tuple(names) if names else (first.word, *_numbered(len(logs)))
    if len(labels) != len(logs) + 1:
        raise InputError("names", f"{len(labels)} for {len(logs) + 1} logs; one each is needed")
    chosen = matching(channels) if channels else None
    if isinstance(measured, Facts):
        side = Side(labels[0], "published")
        runs = tuple(
            Run(_side(log, name), log, facts=judged(measured, log)) for log, name in zip(logs, labels[1:], strict=True)
        )
        return Comparison(side, measured, runs, max_gap, chosen)
    intervals = phases(measured)
    runs = tuple(
        _run(measured, log, labels[0], name, intervals, (align, offset, max_gap), chosen, depth_band)
        for log, name in zip(logs, labels[1:], strict=True)
    )
    return Comparison(_side(measured, labels[0]), measured, runs, max_gap, chosen)


def _numbered(count: int) -> tuple[str, ...]:
    return ("simulated",) if count == 1 else tuple(f"simulated {number}" for number in range(1, count + 1))


def _side(log: Log, name: str) -> Side:
    return Side(name, log.origin, log.metadata.get("reconstruction", ""))


def matching(patterns: Sequence[str]) -> tuple[str, ...]:
    """Channels that names, column names or patterns stand for, in the order asked.

    Raises InputError for one that stands for none.
    """
    known = [name for name in CHANNELS if name != "phase"]
    found: dict[str, None] = {}
    for pattern in patterns:
        spec = by_column(pattern)
        names = fnmatch.filter(known, spec.name if spec is not None else pattern)
        if not names:
            raise InputError(f"channel {pattern}", f"unknown; allowed: {', '.join(known)}")
        found.update(dict.fromkeys(names))
    return tuple(found)


def _run(
    measured: Log,
    simulated: Log,
    measured_name: str,
    name: str,
    intervals: tuple[Interval, ...],
    clock: tuple[Method, float, float],
    chosen: tuple[str, ...] | None,
    depth_band: float | None,
) -> Run:
    method, offset, max_gap = clock
    alignment = align(measured, simulated, method, offset, max_gap)
    log = shifted(simulated, alignment.shift)
    errors = {
        channel: residuals(measured[channel], log[channel], max_gap)
        for channel in _common(measured, log, (measured_name, name), chosen)
    }
    if not any(len(error.error) for error in errors.values()):
        raise InputError(name, _nothing(measured, log, errors, alignment.shift, max_gap, measured_name))
    parts = {leg: {channel: _part(error, intervals, leg) for channel, error in errors.items()} for leg in LEGS}
    bands, without_depth = by_depth(measured, errors, depth_band, max_gap)
    both = tracks(measured, log)
    track = both and both.errors(max_gap)
    half = 0.5 * min(one.end_ns - one.start_ns for one in (measured, log)) * NANOSECOND
    pairs = paired(events_of(measured, intervals), events_of(log, phases(log)), half)
    return Run(
        _side(simulated, name),
        log,
        alignment,
        errors,
        {channel: statistics(error) for channel, error in errors.items()},
        {leg: {c: s for c, s in found.items() if s.n or s.outside or s.gap} for leg, found in parts.items()},
        bands,
        outcomes(measured, log, track),
        track,
        located(pairs, both, max_gap),
        notes=(
            *_not_measured(measured, measured_name),
            *_other_zeros(measured, simulated, errors),
            *_no_depth(without_depth, First(measured.origin)),
        ),
    )


def _not_measured(measured: Log, name: str) -> Iterator[str]:
    """What the errors are against where the first log is no recording."""
    if measured.origin in ("simulated", "reconstruction"):
        what = "is simulated" if measured.origin == "simulated" else "is a reconstruction"
        yield f"{name} {what}; the errors are against it, not against a recording"


def _other_zeros(measured: Log, simulated: Log, channels: Iterable[str]) -> Iterator[str]:
    """Channels that the two logs count from different zeros: what lies between these is in every error."""
    for channel in channels:
        zeros = [log.metadata.get(f"{channel}_zero", "") for log in (measured, simulated)]
        if zeros[0] != zeros[1]:
            told = "; ".join(
                f"{side}: {zero}"
                for side, zero in zip((First(measured.origin).word, "simulated"), zeros, strict=True)
                if zero
            )
            named = channel.replace("_", " ")
            yield f"{named} is counted from different zeros ({told}): its errors hold what lies between them"


def _no_depth(counts: Mapping[str, int], first: First) -> Iterator[str]:
    """Samples that are in no band of depth."""
    if counts:
        told = ", ".join(f"{count} of {name.replace('_', ' ')}" for name, count in counts.items())
        yield f"samples without a {first.of('depth')} at their time are in no band of depth: {told}"


def _part(error: Residuals, intervals: tuple[Interval, ...], leg: str) -> Errors:
    """Statistics of the measured samples on one kind of leg."""
    return statistics(error.where(mask(error.time_ns, intervals, leg), mask(error.skipped_ns, intervals, leg)))


def _common(measured: Log, simulated: Log, names: tuple[str, str], chosen: tuple[str, ...] | None) -> list[str]:
    """Channels that both logs have samples of, in the order of the channel table; the phase is a word, not a number."""
    held = [[n for n in CHANNELS if n != "phase" and n in log and len(log[n])] for log in (measured, simulated)]
    common = [name for name in held[0] if name in held[1] and (chosen is None or name in chosen)]
    if not common:
        asked = f" of {', '.join(chosen)}" if chosen else ""
        has = [", ".join(channels) or "none" for channels in held]
        raise InputError(
            names[1], f"no channel{asked} in common with {names[0]}: it has {has[1]}; {names[0]} has {has[0]}"
        )
    return common


def _nothing(
    measured: Log, simulated: Log, errors: Mapping[str, Residuals], shift: float, max_gap: float, name: str
) -> str:
    """Why no sample could be compared, and what could help."""
    first, last = (f"{to_second(log.start_ns)} to {to_second(log.end_ns)}" for log in (simulated, measured))
    if any(error.gap for error in errors.values()):
        sample = First(measured.origin).of("sample")
        return f"every {sample} lies outside or in a gap of more than {max_gap:g} s; try a longer --max-gap"
    return (
        f"does not overlap in time: {first} UTC after a shift of {shift:g} s, {name} has {last} UTC; "
        "try --align start, --align xcorr or --offset"
    )
