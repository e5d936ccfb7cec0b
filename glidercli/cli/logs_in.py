"""Logs that a command takes as options: each LOG a file, a folder or a quoted glob."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from glidercli.log import Log
    from glidercli.logio import Reading

__all__ = ["LogSource", "LogsIn", "cores", "read_logs"]


def cores() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class LogSource:
    """Reads the LOGs of a command, each once.

    cache : folder of Slocum caches. columns : TOML that maps the columns of plain tables.
    """

    def __init__(self, cache: Path | None = None, columns: Path | None = None) -> None:
        self._cache, self._columns = cache, columns
        self._readings: dict[str, Reading] = {}

    def reading(self, path: str) -> Reading:
        """What a LOG, a file, a folder or a quoted glob, gives."""
        from glidercli.logio import read

        if path not in self._readings:
            self._readings[path] = read([path], cache=self._cache, columns=self._columns, workers=cores())
        return self._readings[path]

    @property
    def files(self) -> list[Path]:
        """Every file that was looked at, readable or not."""
        return [report.path for reading in self._readings.values() for report in reading.files]


@dataclasses.dataclass(frozen=True)
class LogsIn:
    """read : logs by option. files : all that they were made from. warnings : of reading, one line each."""

    read: dict[str, Log]
    files: list[Path]
    warnings: list[str]


def read_logs(wanted: Mapping[str, str | None], source: LogSource) -> LogsIn:
    """The logs of some options; an option without one has none."""
    given = {option: path for option, path in wanted.items() if path is not None}
    readings = {path: source.reading(path) for path in dict.fromkeys(given.values())}
    reports = [report for reading in readings.values() for report in reading.files]
    warnings = [f"{report.path}: {line}" for report in reports for line in report.warnings]
    warnings += [f"{report.path}: {report.error}" for report in reports if report.error]
    logs = {option: readings[path].log.with_metadata(source=path) for option, path in given.items()}
    files = dict.fromkeys(path for reading in readings.values() for path in reading.inputs)
    return LogsIn(logs, list(files), warnings)
