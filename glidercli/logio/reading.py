"""Which files make a log? Files, folders and globs, each read by its content, joined into one Log in time order."""

from __future__ import annotations

import dataclasses
import glob
import os
from collections.abc import Callable, Sequence
from pathlib import Path

from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.log import Log
from glidercli.logio.companions import is_companion
from glidercli.logio.derived import with_derived
from glidercli.logio.formats import FORMATS, check_format
from glidercli.logio.joining import joined
from glidercli.logio.reader import Aids, Part
from glidercli.logio.report import FileReport, all_dropped
from glidercli.logio.spreading import read_all
from glidercli.logio.whereabouts import joined_whereabouts

__all__ = ["Reading", "read"]


@dataclasses.dataclass(frozen=True)
class Reading:
    """A log, and the account of every file that it came from.

    dives : names of the dives that the files tell. partners : recordings that usually stand beside one that was read
    and are missing, each with that one.
    """

    log: Log
    files: tuple[FileReport, ...]
    dives: tuple[str, ...] = ()
    partners: tuple[tuple[str, str], ...] = ()


def read(
    paths: Sequence[str | Path],
    format: str | None = None,
    progress: Callable[[float, float], None] | None = None,
    *,
    cache: str | Path | None = None,
    columns: str | Path | None = None,
    workers: int = 1,
) -> Reading:
    """The Log of files, folders and quoted globs, with what can be derived, and an account of every file.

    format : read every file as this format, whatever it looks like.
    progress : is told the files read and the files to read.
    cache : folder of Slocum caches, asked after those beside a file. columns : TOML that maps the columns of tables.
    workers : processes that many files are spread over; a script that asks for more than one needs the usual guard
    ``if __name__ == "__main__"``.

    Raises
    ------
    InputError
        A path does not exist, or no file could be read; one that could not beside others is in the account.
    UsageError
        No format of this name.
    """
    check_format(format)
    if cache is not None and not Path(cache).is_dir():
        raise InputError("--cache", f"{cache} is no folder; the folder of the .cac files is needed")
    if columns is not None:
        readable_file(Path(columns))
    aids = Aids(None if cache is None else Path(cache), None if columns is None else Path(columns))
    files = _files(paths)
    parts: list[Part] = []
    reports: dict[Path, FileReport] = {}
    for found in read_all(list(files), format, aids, progress, workers):
        report = found.report if isinstance(found, Part) else found
        if report.format is None and files[report.path] and is_companion(report.path):
            continue
        reports[report.path] = report
        if isinstance(found, Part):
            parts.append(found)
    parts = _without_outputs(parts, files, reports)
    if not parts:
        raise _nothing(paths, list(reports.values()))
    dives = tuple(dict.fromkeys(part.dive for part in parts if part.dive))
    held = {"", *(name for part in parts for name in part.holds)}
    partners = tuple((part.partner, part.report.path.name) for part in parts if part.partner not in held)
    near = joined_whereabouts([part.near for part in parts])
    log, whole = joined(parts)
    reports |= {report.path: report for report in whole}
    if not all(FORMATS[report.format].own for report in whole if report.format):
        log = with_derived(log, near)
    return Reading(log, tuple(reports.values()), dives, partners)


def _without_outputs(parts: list[Part], files: dict[Path, bool], reports: dict[Path, FileReport]) -> list[Part]:
    """The parts, without what this program wrote into a folder of recordings; its records are counted as dropped."""
    recorded = any(not FORMATS[part.report.format or ""].own and files[part.report.path] for part in parts)
    left = []
    for part in parts:
        if recorded and FORMATS[part.report.format or ""].own and files[part.report.path]:
            reports[part.report.path] = all_dropped(part.report, "an output of this program beside recordings")
        else:
            left.append(part)
    return left


def _files(paths: Sequence[str | Path]) -> dict[Path, bool]:
    """Every file that the paths name, each once, those of folders and globs sorted; and whether a folder holds it."""
    found: list[tuple[Path, bool]] = []
    for given in paths:
        path = Path(given)
        if path.is_dir():
            if not os.access(path, os.R_OK | os.X_OK):
                raise InputError(path, "cannot be listed: permission denied")
            found += [(p, True) for p in sorted(path.iterdir()) if not p.is_dir() and not p.name.startswith(".")]
        elif path.exists() or not glob.has_magic(str(given)):
            found.append((path, False))
        else:
            matches = sorted(Path(match) for match in glob.glob(str(given)))
            if not matches:
                raise InputError(given, "no file matches")
            found += [(match, False) for match in matches if match.is_file()]
    once = {path.resolve(): (path, of_folder) for path, of_folder in reversed(found)}
    return dict(reversed(once.values()))


def _nothing(paths: Sequence[str | Path], reports: list[FileReport]) -> InputError:
    """Why nothing was read. reports : of files that are no companions."""
    if not reports:
        inside = sum(p.is_dir() for path in paths for p in Path(path).iterdir())
        folders = f" ({inside} folders in it are not looked into)" if inside else ""
        return InputError(" ".join(map(str, paths)), f"holds no log{folders}; readable are {', '.join(FORMATS)}")
    more = f" (and {len(reports) - 1} more files)" if len(reports) > 1 else ""
    return InputError(reports[0].path, f"{reports[0].error}{more}")
