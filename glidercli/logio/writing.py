"""How is a Log saved? One writer per ending; every output appears whole or not at all."""

from __future__ import annotations

import contextlib
from pathlib import Path

from glidercli.errors import OutputError
from glidercli.files import atomic, metadata_path
from glidercli.log import Log
from glidercli.logio.csv_log import write_csv
from glidercli.logio.csv_metadata import write_metadata
from glidercli.provenance import provenance_json

__all__ = ["SUFFIXES", "write"]

SUFFIXES = (".mcap", ".rrd", ".csv")
"""Endings that can be written."""


def write(log: Log, *paths: str | Path, force: bool = False) -> None:
    """Save a log; the ending picks the writer: .mcap (Foxglove, Lichtblick), .rrd (Rerun), .csv.

    All paths appear, or none. A log without provenance gets that of this process.

    force : replace files that exist; without it that is an OutputError.
    """
    if "provenance" not in log.metadata:
        log = log.with_metadata(provenance=provenance_json(origin=log.origin))
    with contextlib.ExitStack() as pending:
        for target in map(Path, paths):
            if target.suffix.lower() not in SUFFIXES:
                raise OutputError(
                    target, f"unknown output {target.suffix or 'without ending'}; allowed: {' '.join(SUFFIXES)}"
                )
            part = pending.enter_context(atomic(target, force))
            if target.suffix.lower() == ".csv":
                write_csv(log, part)
                write_metadata(log, pending.enter_context(atomic(metadata_path(target), force)), part)
            elif target.suffix.lower() == ".mcap":
                from glidercli.logio.mcap_writer import write_mcap

                write_mcap(log, part)
            else:
                from glidercli.logio.rerun_writer import write_rerun

                write_rerun(log, part)
