"""What does a person read first of a comparison? One sentence on what was compared, then compact tables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from glidercli.compare.errors import Errors
from glidercli.compare.facts import FLIGHT, Facts

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison, Run

__all__ = ["text"]

_ERRORS = ("channel", "unit", "n", "rmse", "mae", "bias", "std", "max", "correlation", "nrmse", "skipped")
_FACTS = ("fact", "published", "simulated", "unit", "verdict", "place")


def text(comparison: Comparison) -> str:
    """The whole comparison as lines."""
    return "\n\n".join("\n".join(_run(comparison, run)) for run in comparison.runs)


def _run(comparison: Comparison, run: Run) -> list[str]:
    if isinstance(comparison.against, Facts):
        return _facts(comparison, comparison.against, run)
    clock = run.alignment
    shift = f"clock of {run.side.name} shifted by {clock.shift:z.3f} s (align {clock.method})" if clock else ""
    lines = [
        f"Compared {run.side} with {comparison.measured}; {shift}.",
        f"Errors are {run.side.name} less {comparison.measured.name}.",
    ]
    for title, rows in (("flight", run.channels), *run.by_phase.items()):
        if rows:
            lines += ["", f"{title}:", *_table(_ERRORS, [_row(name, errors) for name, errors in rows.items()], 2)]
    return [*lines, "", *(f"Note: {note}." for note in run.notes)] if run.notes else lines


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
    lines += _table(_FACTS, rows, 1, left=(0, 3, 4, 5))
    return [*lines, "", *notes] if notes else lines


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:z.4g}"


def _table(head: Sequence[str], rows: Sequence[Sequence[str]], texts: int, left: Sequence[int] = ()) -> list[str]:
    """Columns as wide as their longest cell, the first ``texts`` and those in ``left`` to the left, others right."""
    widths = [max(len(row[i]) for row in (head, *rows)) for i in range(len(head))]
    return [
        "  ".join(
            cell.ljust(width) if i < texts or i in left else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in (head, *rows)
    ]
