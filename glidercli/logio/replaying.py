"""What does a recording hold, and where did each record go? The library call behind ``glider replay``."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from glidercli.channels import CHANNELS
from glidercli.errors import InputError, UsageError
from glidercli.files import check_not_inputs, check_outputs
from glidercli.log import Channel, Log
from glidercli.logio.reading import Reading, read
from glidercli.logio.records import NO_TIME, to_ns
from glidercli.logio.report import FileReport
from glidercli.logio.rerun.clocks import aligned
from glidercli.logio.writing import SUFFIXES, write
from glidercli.provenance import provenance_json
from glidercli.utc import iso

__all__ = ["Replay", "check_beside", "replay"]


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
    beside: Sequence[str | Path] = (),
    cache: str | Path | None = None,
    columns: str | Path | None = None,
    workers: int = 1,
    progress: Callable[[float, float], None] | None = None,
    stage: Callable[[str], None] | None = None,
    reading: Reading | None = None,
) -> Replay:
    """Read logs, account for every record, and write the outputs.

    Parameters
    ----------
    paths : files, folders, globs. outputs : files; the ending picks the writer.
    format, cache, columns, workers : as for ``read``.
    start, end : ISO 8601 UTC, or seconds since the log's first sample; the part with start <= time < end is taken.
    The accounts of the files are of all their records, within it or not.
    attach : whether the files that were read go into every .mcap; a UsageError where there is none.
    beside : other logs, a file, folder or glob each, that every .rrd shows beside this one; a UsageError where there is
        none. They are put on this log's clock, see rerun/clocks.py, and cut with it by start and end.
    strict : a file that cannot be read, or not as a whole, is an InputError, and nothing is written.
    progress : is told the files read and the files to read. stage : is told what is done after that.
    reading : what the paths gave, where they have been read.
    """
    targets = [Path(path) for path in outputs]
    if attach and not any(target.suffix.lower() == ".mcap" for target in targets):
        raise UsageError("--attach puts the files into an .mcap; -o NAME.mcap is needed")
    check_beside(beside, targets)
    check_outputs(targets, SUFFIXES, force)
    if reading is None:
        reading = read(paths, format, progress, cache=cache, columns=columns, workers=workers)
    log = reading.log
    others = [read([path], cache=cache, columns=columns, workers=workers) for path in beside]
    files = [report for one in (reading, *others) for report in one.files]
    broken = [report for report in files if report.error is not None]
    if strict and broken:
        more = f", and {len(broken) - 1} more files" if len(broken) > 1 else ""
        raise InputError(broken[0].path, f"{broken[0].error} (--strict){more}")
    together = [aligned(log, other.log) for other in others]
    part = None
    if start is not None or end is not None:
        part = (_moment(log, "--start", start), _moment(log, "--end", end))
        log, *together = (one.sliced(*part) for one in (log, *together))
        if not log.channels:
            raise InputError(
                "--start, --end",
                f"no sample lies there; the log runs {iso(reading.log.start_ns)} to {iso(reading.log.end_ns)}",
            )
        for path, other in zip(beside, together, strict=True):
            if not other.channels:
                raise InputError(path, "no sample lies between --start and --end")
    mappings = [] if columns is None else [Path(columns)]
    sources = [list(dict.fromkeys([*one.inputs, *mappings])) for one in (reading, *others)]
    check_not_inputs(targets, [*(report.path for report in files), *(path for one in sources for path in one)])
    log, *together = (
        one.with_metadata(provenance=provenance_json(inputs=inputs, origin=one.origin))
        for one, inputs in zip((log, *together), sources, strict=True)
    )
    passed_over = tuple(dict.fromkeys(line for one in (reading, *others) for line in one.passed_over))
    if stage is not None and targets:
        stage("writing")
    more = f" and {len(paths) - 1} more" if len(paths) > 1 else ""
    names = [_name(paths[0]) + more, *map(_name, beside)] if beside else []
    write(log, *targets, force=force, attach=sources[0] if attach else (), beside=together, names=names)
    return Replay(log, tuple(files), tuple(targets), part, passed_over)


def check_beside(beside: Sequence[str | Path], outputs: Sequence[Path]) -> None:
    """A UsageError where logs are to be shown beside another and no output shows them."""
    if beside and not any(path.suffix.lower() == ".rrd" for path in outputs):
        raise UsageError("--with shows logs side by side in Rerun; -o NAME.rrd is needed")


def _name(path: str | Path) -> str:
    """What a log is called beside others."""
    return Path(path).name or str(path)


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
