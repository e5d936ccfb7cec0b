"""What of a comparison do viewers show? The logs on one clock, their names, and the errors as they were found."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import Any, NamedTuple

from glidercli.compare.comparison import Comparison, Run
from glidercli.compare.document import document
from glidercli.compare.facts import Facts
from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.residuals import Residuals

__all__ = ["Overlay", "overlay"]


class Overlay(NamedTuple):
    """What ``glidercli.logio.write`` takes to show several logs together.

    log : the measured one. beside : the simulated ones on its clock. names : of the measured and of each of those.
    errors : of each of those, by channel, simulated less measured at measured times, in the table's unit.
    """

    log: Log
    beside: tuple[Log, ...]
    names: tuple[str, ...]
    errors: tuple[Mapping[str, Residuals], ...]


def overlay(comparison: Comparison, provenance: Mapping[str, Any]) -> Overlay:
    """The logs and errors of a comparison. provenance : record of the whole, which goes with the measured log.

    Metadata of the simulated logs tell how their clocks were shifted (``clock_note``) and how the errors were found
    (``comparison_note``); where these logs come from stands in what they brought along.

    Raises InputError for a comparison with published values: these are no recording.
    """
    if isinstance(comparison.against, Facts):
        raise InputError(comparison.measured.name, "holds published values, which are no recording to overlay")
    record = {**provenance, "origins": document(comparison)["origins"]}
    log = comparison.against.with_metadata(provenance=json.dumps(record, sort_keys=True))
    beside = tuple(_told(run, comparison) for run in comparison.runs)
    names = _short([comparison.measured.name, *(run.side.name for run in comparison.runs)])
    return Overlay(log, beside, names, tuple(run.residuals for run in comparison.runs))


def _short(names: Sequence[str]) -> tuple[str, ...]:
    """Names without the folders that they lie in, where these are enough to tell them apart."""
    last = tuple(PurePath(name).name for name in names)
    return last if all(last) and len(set(last)) == len(last) else tuple(names)


def _told(run: Run, comparison: Comparison) -> Log:
    """A simulated log, with what was done to it."""
    first = comparison.first
    how = (
        f"errors are simulated less {first.noun} at {first.of('times')}, not across gaps of more than "
        f"{comparison.max_gap:g} s"
    )
    told = {"comparison_note": "; ".join((how, *run.notes))}
    if run.alignment is not None and run.alignment.shift:
        certainty = f"; {run.alignment.note}" if run.alignment.note else ""
        told["clock_note"] = f"shifted by {run.alignment.shift:+.3f} s (align {run.alignment.method}){certainty}"
    return run.log.with_metadata(**told)
