"""How is a Log saved? One writer per ending; every output appears whole or not at all."""

from __future__ import annotations

from pathlib import Path

from glidercli.errors import OutputError
from glidercli.files import atomic
from glidercli.log import Log
from glidercli.logio.csv_log import metadata_path, write_csv, write_metadata
from glidercli.provenance import provenance_json

__all__ = ["SUFFIXES", "write"]

SUFFIXES = (".mcap", ".rrd", ".csv")
"""Endings that can be written."""


def write(log: Log, path: str | Path, force: bool = False) -> None:
    """Save a log; the ending picks the writer: .mcap (Foxglove, Lichtblick), .rrd (Rerun), .csv.

    force : replace a file that exists; without it that is an OutputError. A log without provenance gets that of this
    process.
    """
    target = Path(path)
    if "provenance" not in log.metadata:
        log = log.with_metadata(provenance=provenance_json(origin=log.origin))
    match target.suffix.lower():
        case ".csv":
            with atomic(target, force) as part, atomic(metadata_path(target), force) as beside:
                write_csv(log, part)
                write_metadata(log, beside)
        case ".mcap":
            from glidercli.logio.mcap_writer import write_mcap

            with atomic(target, force) as part:
                write_mcap(log, part)
        case ".rrd":
            from glidercli.logio.rerun_writer import write_rerun

            with atomic(target, force) as part:
                write_rerun(log, part)
        case other:
            raise OutputError(target, f"unknown output {other or 'without ending'}; allowed: {' '.join(SUFFIXES)}")
