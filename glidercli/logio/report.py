"""What was read of a file, and what was dropped? One report per file; records = kept + dropped."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

__all__ = ["FileReport", "all_dropped"]


@dataclasses.dataclass(frozen=True)
class FileReport:
    """The account of one file.

    format : name of the format, or None where it was not recognised. records : entries of the file (lines, rows or
    messages). kept : those that gave at least one sample. dropped : the others, as (reason, count). warnings : single
    cells left out, and other remarks. error : why the file, or a part of it, could not be read, or None. beside :
    further files that what was kept depends on, such as a Slocum's cache.
    """

    path: Path
    format: str | None
    records: int
    kept: int
    dropped: tuple[tuple[str, int], ...] = ()
    warnings: tuple[str, ...] = ()
    error: str | None = None
    beside: tuple[Path, ...] = ()

    def document(self) -> dict[str, Any]:
        """The contract's JSON entry; an error stands first among the warnings too."""
        entry: dict[str, Any] = {
            "path": str(self.path),
            "format": self.format,
            "records": self.records,
            "kept": self.kept,
            "dropped": [{"reason": reason, "count": count} for reason, count in self.dropped],
            "warnings": [*([] if self.error is None else [self.error]), *self.warnings],
        }
        return entry if self.error is None else {**entry, "error": self.error}


def all_dropped(report: FileReport, reason: str) -> FileReport:
    """The account of a file of which nothing is used after all."""
    dropped = (*report.dropped, (reason, report.kept)) if report.kept else report.dropped
    return dataclasses.replace(report, kept=0, dropped=dropped)
