"""Logs that a command takes as options: each LOG a file, a folder or a quoted glob."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Mapping
from pathlib import Path

from glidercli.log import Log

__all__ = ["LogsIn", "cores", "read_logs"]


def cores() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@dataclasses.dataclass(frozen=True)
class LogsIn:
    """read : logs by option. files : all that they came from. warnings : of reading, one line each."""

    read: dict[str, Log]
    files: list[Path]
    warnings: list[str]


def read_logs(wanted: Mapping[str, str | None]) -> LogsIn:
    """Read the logs of some options, each path once; an option without one has none."""
    given = {option: path for option, path in wanted.items() if path is not None}
    if not given:
        return LogsIn({}, [], [])
    from glidercli.logio import read

    readings = {path: read([path], workers=cores()) for path in dict.fromkeys(given.values())}
    reports = [report for reading in readings.values() for report in reading.files]
    warnings = [f"{report.path}: {line}" for report in reports for line in report.warnings]
    warnings += [f"{report.path}: {report.error}" for report in reports if report.error]
    logs = {option: readings[path].log.with_metadata(source=path) for option, path in given.items()}
    return LogsIn(logs, [report.path for report in reports if not report.error], warnings)
