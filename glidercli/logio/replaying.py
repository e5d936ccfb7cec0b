"""What does a recording hold, and where did each record go? The library call behind ``glider replay``."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from glidercli.channels import CHANNELS
from glidercli.errors import InputError, UsageError
from glidercli.files import check_not_inputs, check_outputs
from glidercli.log import Channel, Log
from glidercli.logio.passing_over import passed_over
from glidercli.logio.reading import read
from glidercli.logio.records import NO_TIME, to_ns
from glidercli.logio.report import FileReport
from glidercli.logio.writing import SUFFIXES, write
from glidercli.provenance import provenance_json

__all__ = ["Replay", "replay"]


@dataclasses.dataclass(frozen=True)
class Replay:
    """A log as replayed: its files' accounts, and the outputs written.

    part : first and last moment that were asked for, UTC ns, the last not included, None where an end was left open;
    or None for the whole log. The accounts are of whole files all the same. passed_over : files that were not looked
    at, a line each.
    """

    log: Log
    files: tuple[FileReport, ...]
    outputs: tuple[Path, ...]
    part: tuple[int | None, int | None] | None = None
    passed_over: tuple[str, ...] = ()

    @property
    def broken(self) -> tuple[FileReport, ...]:
        """Files that could not be read, or not as a whole."""
        return tuple(report for report in self.files if report.error is not None)

    def document(self) -> dict[str, Any]:
        """The contract's JSON."""
        return {
            "files": [report.document() for report in self.files],
            "channels": [_channel(channel) for channel in self.log.channels.values() if len(channel)],
            "outputs": [str(path) for path in self.outputs],
            "part": None
            if self.part is None
            else dict(zip(("start", "end"), [None if t is None else iso(t) for t in self.part], strict=True)),
            "passed_over": list(self.passed_over),
        }


def iso(time_ns: int) -> str:
    """A time as ISO 8601 UTC to the millisecond."""
    return f"{np.datetime_as_string(np.datetime64(int(time_ns), 'ns'), unit='ms')}Z"


def _channel(channel: Channel) -> dict[str, Any]:
    """One channel in the table's name and unit."""
    spec = CHANNELS[channel.name]
    values = channel.values * spec.factor
    ordered = channel.name != "phase"  # its codes stand for words
    return {
        "name": spec.column,
        "unit": spec.column_unit,
        "samples": len(channel),
        "first": iso(channel.time_ns[0]),
        "last": iso(channel.time_ns[-1]),
        "minimum": float(values.min()) + 0.0 if ordered else None,  # no -0.0
        "maximum": float(values.max()) + 0.0 if ordered else None,
        "origin": channel.origin,
    }


def replay(
    paths: Sequence[str | Path],
    outputs: Sequence[str | Path] = (),
    *,
    format: str | None = None,
    start: str | None = None,
    end: str | None = None,
    strict: bool = False,
    force: bool = False,
    attach: bool = False,
    cache: str | Path | None = None,
    columns: str | Path | None = None,
    workers: int = 1,
    progress: Callable[[float, float], None] | None = None,
    stage: Callable[[str], None] | None = None,
) -> Replay:
    """Read logs, account for every record, and write the outputs.

    Parameters
    ----------
    paths : files, folders, globs. outputs : files; the ending picks the writer.
    format, cache, columns, workers : as for ``read``.
    start, end : ISO 8601 UTC, or seconds since the log's first sample; the part with start <= time < end is taken.
    The accounts of the files are of all their records, within it or not.
    attach : whether the files that were read go into every .mcap; a UsageError where there is none.
    strict : a file that cannot be read, or not as a whole, is an InputError, and nothing is written.
    progress : is told the files read and the files to read. stage : is told what is done after that.
    """
    targets = [Path(path) for path in outputs]
    if attach and not any(target.suffix.lower() == ".mcap" for target in targets):
        raise UsageError("--attach puts the files into an .mcap; -o NAME.mcap is needed")
    check_outputs(targets, SUFFIXES, force)
    reading = read(paths, format, progress, cache=cache, columns=columns, workers=workers)
    log = reading.log
    broken = [report for report in reading.files if report.error is not None]
    if strict and broken:
        more = f", and {len(broken) - 1} more files" if len(broken) > 1 else ""
        raise InputError(broken[0].path, f"{broken[0].error} (--strict){more}")
    part = None
    if start is not None or end is not None:
        part = (_moment(log, "--start", start), _moment(log, "--end", end))
        log = log.sliced(*part)
        if not log.channels:
            raise InputError(
                "--start, --end",
                f"no sample lies there; the log runs {iso(reading.log.start_ns)} to {iso(reading.log.end_ns)}",
            )
    mappings = [] if columns is None else [Path(columns)]
    check_not_inputs(targets, [*(report.path for report in reading.files), *reading.inputs, *mappings])
    inputs = dict.fromkeys([*reading.inputs, *mappings])
    log = log.with_metadata(provenance=provenance_json(inputs=inputs, origin=log.origin))
    if stage is not None and targets:
        stage("writing")
    write(log, *targets, force=force, attach=list(inputs) if attach else ())
    return Replay(log, reading.files, tuple(targets), part, passed_over(paths))


def _moment(log: Log, option: str, text: str | None) -> int | None:
    """A time of --start or --end as UTC ns."""
    import pandas as pd

    if text is None:
        return None
    try:
        return log.start_ns + round(float(text) * 1e9)
    except (ValueError, OverflowError):
        pass
    moment = pd.to_datetime(text, errors="coerce", format="ISO8601", utc=True)
    (time_ns,) = to_ns(pd.Series([moment]).dt.tz_localize(None))
    if time_ns == NO_TIME:
        raise UsageError(f"{option}: {text!r} is no time; ISO 8601 UTC or seconds since the log's start are allowed")
    return int(time_ns)
