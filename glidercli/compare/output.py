"""How is a comparison kept? As a table (.csv), a document (.json) or a figure (.png, .svg, .pdf)."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.compare.document import document
from glidercli.compare.facts import Facts
from glidercli.errors import OutputError
from glidercli.files import atomic

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison

__all__ = ["SUFFIXES", "metadata_path", "write"]

SUFFIXES = (".csv", ".json", ".png", ".svg", ".pdf")
"""Endings of the outputs that ``write`` makes."""

_ERRORS = ("unit", "n", "rmse", "mae", "bias", "std", "max", "max_time_utc", "correlation", "nrmse")
_FACTS = (
    "name", "quantity", "channel", "phase", "unit", "published", "tolerance", "simulated", "difference", "verdict",
    "place", "tolerance_reason", "note", "reason",
)  # fmt: skip


def metadata_path(table: Path) -> Path:
    """Where the provenance of a CSV stands."""
    return table.with_name(table.name + "-metadata.json")


def write(comparison: Comparison, path: Path, provenance: dict[str, Any], force: bool = False) -> None:
    """Write a comparison to a file whose ending picks the kind; see SUFFIXES.

    provenance : record of versions, command and inputs, kept with the output.
    force : replace files that exist.

    Raises OutputError when the file exists and force is not given, cannot be written, or has another ending.
    """
    kind = path.suffix.lower()
    record = {**provenance, "origins": document(comparison)["origins"]}
    if kind == ".csv":
        with atomic(metadata_path(path), force) as beside, atomic(path, force) as table:
            beside.write_text(_json(record), encoding="utf-8")
            _write_csv(comparison, table)
    elif kind == ".json":
        with atomic(path, force) as whole:
            whole.write_text(_json({**document(comparison), "provenance": provenance}), encoding="utf-8")
    elif kind in SUFFIXES:
        from glidercli.compare.figure import save

        with atomic(path, force) as picture:
            save(comparison, picture, json.dumps(record, sort_keys=True))
    else:
        raise OutputError(path, f"unknown output {kind or 'without ending'}; allowed: {' '.join(SUFFIXES)}")


def _json(value: Any) -> str:
    return json.dumps(value, indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def _write_csv(comparison: Comparison, path: Path) -> None:
    """One row per simulation, phase and channel; for facts one per simulation and fact; an empty cell is no value."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        rows = csv.writer(stream, lineterminator="\n")
        parts = document(comparison)
        runs = parts.get("simulations") or [{"name": comparison.runs[0].side.name, **parts}]
        kinds = [run.side.kind for run in comparison.runs]
        if isinstance(comparison.against, Facts):
            rows.writerow(("simulation", "simulated_origin", *_FACTS))
            for run, kind in zip(runs, kinds, strict=True):
                rows.writerows((run["name"], kind, *(one[key] for key in _FACTS)) for one in run["facts"])
            return
        ends = ("skipped_outside", "skipped_gap", "measured_origin", "simulated_origin")
        rows.writerow(("simulation", "phase", "channel", *_ERRORS, *ends))
        for run, kind in zip(runs, kinds, strict=True):
            for phase, channels in {"flight": run["channels"], **run["phases"]}.items():
                for name, one in channels.items():
                    skipped = one["skipped"].values()
                    numbers = (one[key] for key in _ERRORS)
                    rows.writerow((run["name"], phase, name, *numbers, *skipped, comparison.measured.kind, kind))
