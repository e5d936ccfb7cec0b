"""How is a Log saved? One writer per ending; every output appears whole or not at all.

All are written piece by piece, so that a long flight needs no more memory than a short one.
"""

from __future__ import annotations

import contextlib
import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from glidercli.errors import OutputError
from glidercli.files import atomic, metadata_path
from glidercli.log import Log
from glidercli.logio.own.csv_log import CsvTable
from glidercli.logio.own.csv_metadata import metadata_of, write_metadata
from glidercli.provenance import provenance_json
from glidercli.residuals import Residuals

__all__ = ["SUFFIXES", "TABLES", "VIEWERS", "Saving", "saving", "write"]

TABLES = (".csv", ".parquet", ".nc")
"""Endings of tables."""
PIECE = 65536
"""Samples of a channel that a table is given at once: some 20 MB of cells."""
VIEWERS = (".mcap", ".rrd")
"""Endings of what viewers open."""
SUFFIXES = (*VIEWERS, *TABLES)
"""Endings that can be written."""


def write(
    log: Log,
    *paths: str | Path,
    force: bool = False,
    attach: Sequence[Path] = (),
    beside: Sequence[Log] = (),
    names: Sequence[str] = (),
    errors: Sequence[Mapping[str, Residuals]] = (),
) -> None:
    """Save a log; the ending picks the writer: .mcap (Foxglove, Lichtblick), .rrd (Rerun), .nc (CF), .parquet, .csv.

    All paths appear, or none. A log without provenance gets that of this process.

    force : replace files that exist; without it that is an OutputError. attach : files that go into every .mcap.
    beside, names : other logs that every .rrd shows beside this one, and what each is called, see ``write_rerun``.
    errors : of each of those by channel, as a comparison found them; every .rrd shows them as they are, and every
    .mcap, which has this log alone without them, has the others and them, too.
    """
    with saving([Path(path) for path in paths], force, attach, beside, names, errors) as outputs:
        outputs.add(log)
        outputs.close(log)


class Saving:
    """Outputs in the making, under other names; see ``saving``."""

    def __init__(
        self,
        parts: Sequence[tuple[str, Path, Path | None]],
        pending: contextlib.ExitStack,
        attach: Sequence[Path],
        beside: Sequence[Log] = (),
        names: Sequence[str] = (),
        errors: Sequence[Mapping[str, Residuals]] = (),
    ) -> None:
        """Begin. parts : ending, file to write to, file of the metadata beside a CSV. Others : as for ``saving``."""
        self._viewers: list[Any] = []
        self._tables: list[tuple[Any, Path, Path | None]] = []
        self._span: tuple[int, int] | None = None
        self._origins: dict[str, Any] = {}
        for suffix, part, metadata in parts:
            if suffix == ".csv":
                table: Any = CsvTable(pending.enter_context(part.open("w", encoding="utf-8", newline="")))
            elif suffix == ".parquet":
                from glidercli.logio.own.parquet_log import ParquetTable

                table = ParquetTable(part)
            elif suffix == ".nc":
                from glidercli.logio.own.netcdf_log import NetcdfTable

                table = NetcdfTable(part)
            elif suffix == ".mcap":
                from glidercli.logio.mcap.writer import McapLog

                stream = pending.enter_context(part.open("wb"))
                together = (beside, names, errors) if errors else ()
                self._viewers.append(McapLog(stream, attach, *together))
                continue
            else:
                from glidercli.logio.rerun.writer import RerunLog

                self._viewers.append(RerunLog(part, beside, names, errors))
                continue
            self._tables.append((table, part, metadata))

    def add(self, log: Log) -> None:
        """Append a piece of the log, or all of it, to every output."""
        for viewer in self._viewers:
            viewer.add(log)
        if not self._tables:
            return
        for piece in log.pieces(PIECE):
            for table, _, _ in self._tables:
                table.add(piece)
        self._origins |= {name: c for name, c in log.channels.items() if len(c)}
        if any(map(len, log.channels.values())):
            self._span = (self._span[0] if self._span else log.start_ns, log.end_ns)

    def close(self, log: Log) -> None:
        """Finish: write what can be told at the end only, events and metadata."""
        if "provenance" not in log.metadata:
            log = log.with_metadata(provenance=provenance_json(origin=log.origin))
        told = metadata_of(dataclasses.replace(log, channels=self._origins), self._span)
        for table, part, metadata in self._tables:
            table.close(told)
            if metadata is not None:
                write_metadata(told, metadata, part)
        for viewer in self._viewers:
            viewer.close(log)


@contextlib.contextmanager
def saving(
    paths: Sequence[Path],
    force: bool,
    attach: Sequence[Path] = (),
    beside: Sequence[Log] = (),
    names: Sequence[str] = (),
    errors: Sequence[Mapping[str, Residuals]] = (),
) -> Iterator[Saving]:
    """Outputs that get a log with ``add``, in pieces or whole, and then ``close``; all appear at the end, or none.

    attach : files that go into every .mcap. beside, names, errors : as for ``write``; the log is then added as a whole.
    """
    with contextlib.ExitStack() as pending:
        parts = []
        for target in paths:
            suffix = target.suffix.lower()
            if suffix not in SUFFIXES:
                raise OutputError(
                    target, f"unknown output {target.suffix or 'without ending'}; allowed: {' '.join(SUFFIXES)}"
                )
            part = pending.enter_context(atomic(target, force))
            metadata = pending.enter_context(atomic(metadata_path(target), force)) if suffix == ".csv" else None
            parts.append((suffix, part, metadata))
        with contextlib.ExitStack() as streams:
            yield Saving(parts, streams, attach, beside, names, errors)
