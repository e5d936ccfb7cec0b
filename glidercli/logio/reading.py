"""Which files make a log? Files, folders and globs, each read by its content, joined into one Log in time order."""

from __future__ import annotations

import dataclasses
import glob
from collections.abc import Callable, Sequence
from pathlib import Path

from glidercli.errors import GliderError, InputError
from glidercli.log import Log
from glidercli.logio.dead_reckoning import with_track
from glidercli.logio.derived import with_derived
from glidercli.logio.formats import FORMATS, check_format, format_of, read_file
from glidercli.logio.joining import joined
from glidercli.logio.reader import Aids, Part
from glidercli.logio.report import FileReport

__all__ = ["Reading", "read"]


@dataclasses.dataclass(frozen=True)
class Reading:
    """A log, and the account of every file that it came from."""

    log: Log
    files: tuple[FileReport, ...]


COMPANIONS = (
    ".md", ".rst", ".txt", ".toml", ".json", ".py", ".png", ".svg", ".pdf", ".html", ".rrd",
    ".cac", ".ccc", ".mi", ".ma", ".mlg", ".nlg", ".mcg", ".ncg", ".mrg",
)  # fmt: skip
"""Endings of what stands in a folder beside logs: notes, settings, pictures, outputs that are not read back; of a
Slocum its sensor lists, missions and the texts of its consoles."""


def read(
    paths: Sequence[str | Path],
    format: str | None = None,
    progress: Callable[[float, float], None] | None = None,
    *,
    cache: str | Path | None = None,
    columns: str | Path | None = None,
) -> Reading:
    """The Log of files, folders and quoted globs, with what can be derived, and an account of every file.

    format : read every file as this format, whatever it looks like.
    progress : is told the files read and the files to read.
    cache : folder of Slocum caches, asked after those beside a file. columns : TOML that maps the columns of tables.

    Raises
    ------
    InputError
        A path does not exist, or no file could be read; one that could not beside others is in the account.
    UsageError
        No format of this name.
    """
    check_format(format)
    aids = Aids(None if cache is None else Path(cache), None if columns is None else Path(columns))
    files = _files(paths)
    parts: list[Part] = []
    reports = []
    for number, path in enumerate(files):
        if progress is not None:
            progress(number, len(files))
        try:
            part = read_file(path, format, aids)
            report = part.report
            if part.log.channels:
                parts.append(part)
            elif report.error is None:
                why = ", ".join(f"{count} {reason}" for reason, count in report.dropped)
                report = dataclasses.replace(report, error="no usable record" + (f": {why}" if why else ""))
        except GliderError as error:
            report = FileReport(path, None, 0, 0, error=str(error).removeprefix(f"{path}: "))
        reports.append(report)
    if not parts:
        first = reports[0]
        more = f" (and {len(reports) - 1} more files)" if len(reports) > 1 else ""
        raise InputError(first.path, f"{first.error}{more}")
    log, whole = joined(parts)
    counted = {report.path: report for report in whole}
    reports = [counted.get(report.path, report) for report in reports]
    if not all(FORMATS[report.format].own for report in whole if report.format):
        log = with_track(with_derived(log))
    return Reading(log, tuple(reports))


def _files(paths: Sequence[str | Path]) -> list[Path]:
    """Every file that the paths name, each once; folders and globs sorted, companions in folders left out."""
    found: list[Path] = []
    for given in paths:
        path = Path(given)
        if path.is_dir():
            inside = [p for p in sorted(path.iterdir()) if p.is_file() and not p.name.startswith(".")]
            recognised = [p for p in inside if format_of(p)]
            if not recognised:
                raise InputError(path, f"holds no log; readable are {', '.join(FORMATS)}")
            found += [p for p in inside if p in recognised or not _is_companion(p)]
        elif path.exists() or not glob.has_magic(str(given)):
            found.append(path)
        else:
            matches = sorted(Path(match) for match in glob.glob(str(given)))
            if not matches:
                raise InputError(given, "no file matches")
            found += [match for match in matches if match.is_file()]
    return list({path.resolve(): path for path in reversed(found)}.values())[::-1]


def _is_companion(path: Path) -> bool:
    """Whether a file of no known format only goes with the logs of its folder; another one is named as broken."""
    return path.suffix.lower() in COMPANIONS or path.name.upper().startswith(("README", "LICENSE", "LICENCE"))
