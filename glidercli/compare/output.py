"""How is a comparison kept? As a table (.csv), a document (.json), a figure (.png, .svg, .pdf) or a page (.html)."""

from __future__ import annotations

import contextlib
import csv
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.compare.document import document, part_of
from glidercli.compare.facts import Facts
from glidercli.errors import OutputError
from glidercli.files import atomic, metadata_path
from glidercli.log import Log

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison

__all__ = ["SUFFIXES", "write"]

SUFFIXES = (".csv", ".json", ".png", ".svg", ".pdf", ".html")
"""Endings of the outputs that ``write`` makes."""

_ERRORS = ("unit", "n", "rmse", "mae", "bias", "std", "max", "max_time_utc", "correlation", "nrmse")
_FACTS = (
    "name", "quantity", "channel", "phase", "unit", "published", "tolerance", "simulated", "difference", "verdict",
    "place", "tolerance_reason", "given", "note", "reason",
)  # fmt: skip


def write(comparison: Comparison, *paths: Path, provenance: dict[str, Any], force: bool = False) -> None:
    """Write a comparison to files whose endings pick the kind, see SUFFIXES; all of them appear, or none.

    provenance : record of versions, command and inputs, kept with the output.
    force : replace files that exist.

    Raises OutputError when a file exists and force is not given, cannot be written, or has another ending.
    """
    record = {**provenance, "origins": document(comparison)["origins"]}
    if notes := list(dict.fromkeys(note for run in comparison.runs for note in run.notes)):
        record["notes"] = notes
    with contextlib.ExitStack() as pending:
        for path in paths:
            kind = path.suffix.lower()
            if kind not in SUFFIXES:
                raise OutputError(path, f"unknown output {kind or 'without ending'}; allowed: {' '.join(SUFFIXES)}")
            part = pending.enter_context(atomic(path, force))
            if kind == ".csv":
                beside = pending.enter_context(atomic(metadata_path(path), force))
                beside.write_text(_json(record), encoding="utf-8")
                _write_csv(comparison, part)
            elif kind == ".json":
                part.write_text(_json({**document(comparison), "provenance": provenance}), encoding="utf-8")
            elif kind == ".html":
                from glidercli.compare.page.whole import save as save_page

                save_page(comparison, part, provenance)
            else:
                from glidercli.compare.figure import save

                save(comparison, part, json.dumps(record, sort_keys=True))


def _json(value: Any) -> str:
    return json.dumps(value, indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def _write_csv(comparison: Comparison, path: Path) -> None:
    """One row per simulation, phase or depth band, and channel; for facts one per fact. An empty cell is no value."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        rows = csv.writer(stream, lineterminator="\n")
        measured = comparison.against if isinstance(comparison.against, Log) else None
        runs = [{"name": run.side.name, **part_of(run, measured)} for run in comparison.runs]
        kinds = [run.side.kind for run in comparison.runs]
        if isinstance(comparison.against, Facts):
            rows.writerow(("simulation", "simulated_origin", *_FACTS))
            for run, kind in zip(runs, kinds, strict=True):
                rows.writerows((run["name"], kind, *(one[key] for key in _FACTS)) for one in run["facts"])
            return
        ends = ("skipped_outside", "skipped_gap", "measured_origin", "simulated_origin")
        rows.writerow(("simulation", "phase", "channel", *_ERRORS, *ends))
        for run, kind in zip(runs, kinds, strict=True):
            bands = {f"{band['from_m']:g}-{band['to_m']:g} m": band["channels"] for band in run["bands"]}
            for phase, channels in {"flight": run["channels"], **run["phases"], **bands}.items():
                for name, one in channels.items():
                    skipped = one["skipped"].values()
                    numbers = (one[key] for key in _ERRORS)
                    rows.writerow((run["name"], phase, name, *numbers, *skipped, comparison.measured.kind, kind))
