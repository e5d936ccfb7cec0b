"""Which files make a log? Files, folders and globs, each read by its content, joined into one Log in time order."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.log import Log
from glidercli.logio.alike import vehicle_of
from glidercli.logio.companions import is_companion
from glidercli.logio.derived import with_derived
from glidercli.logio.finding import found_in, natural
from glidercli.logio.formats import FORMATS, check_format
from glidercli.logio.gauges import doubt_about_gauges
from glidercli.logio.joining import joined
from glidercli.logio.reader import Aids, Part
from glidercli.logio.report import FileReport, all_dropped
from glidercli.logio.spreading import read_all
from glidercli.logio.whereabouts import Whereabouts, joined_whereabouts

__all__ = ["Reading", "read"]


@dataclasses.dataclass(frozen=True)
class Reading:
    """A log, and the account of every file that it came from.

    dives : names of the dives that the files tell. partners : recordings that usually stand beside one that was read
    and are missing, each with that one. unread : names of columns with data that no channel is taken from.
    nameless : names of files that tell no vehicle, where others tell one.
    passed_over : files that were not looked at, a line each.
    """

    log: Log
    files: tuple[FileReport, ...]
    dives: tuple[str, ...] = ()
    partners: tuple[tuple[str, str], ...] = ()
    unread: tuple[str, ...] = ()
    nameless: tuple[str, ...] = ()
    passed_over: tuple[str, ...] = ()

    @property
    def inputs(self) -> list[Path]:
        """The files that the log was made from, each once, with what was read beside them."""
        return list(dict.fromkeys(p for report in self.files if report.kept for p in (report.path, *report.beside)))


def read(
    paths: Sequence[str | Path],
    format: str | None = None,
    progress: Callable[[float, float], None] | None = None,
    *,
    cache: str | Path | None = None,
    columns: str | Path | None = None,
    workers: int = 1,
    reader: Callable[[list[Path], Aids], Iterable[Part | FileReport]] | None = None,
) -> Reading:
    """The Log of files, folders and quoted globs, with what can be derived, and an account of every file.

    format : read every file as this format, whatever it looks like.
    progress : is told the files read and the files to read.
    cache : folder of Slocum caches, asked after those beside a file. columns : TOML that maps the columns of tables.
    workers : processes that many files are spread over; a script that asks for more than one needs the usual guard
    ``if __name__ == "__main__"``.
    reader : gives what each file gives, in their order, in place of reading them here.

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
    files, passed_over = found_in(paths)
    parts: list[Part] = []
    reports: dict[Path, FileReport] = {}
    unread: dict[str, None] = {}
    has_attitude = False
    given = read_all(list(files), format, aids, progress, workers) if reader is None else reader(list(files), aids)
    for found in given:
        report = found.report if isinstance(found, Part) else found
        if report.format is None and files[report.path] and is_companion(report.path):
            continue
        reports[report.path] = report
        if isinstance(found, Part):
            unread |= dict.fromkeys(found.unread)
            has_attitude |= {"pitch", "heading"} <= found.log.channels.keys()
            near = _of_use(found.near, has_attitude)
            found = dataclasses.replace(found, unread=(), near=near)  # thousands of files may name thousands of columns
            parts.append(found)
    parts = _without_outputs(parts, files, reports)
    if not parts:
        raise _nothing(paths, list(reports.values()))
    # the log is the same in whatever order the files come; of two that tell the same the one of a known vehicle counts
    parts.sort(key=lambda part: (not vehicle_of(part), natural(part.report.path)))
    dives = tuple(dict.fromkeys(part.dive for part in parts if part.dive))
    held = {"", *(name for part in parts for name in part.holds)}
    partners = tuple((part.partner, part.report.path.name) for part in parts if part.partner not in held)
    own = all(FORMATS[part.report.format].own for part in parts if part.report.format)
    nameless = tuple(part.report.path.name for part in parts if not vehicle_of(part))
    near = joined_whereabouts([_of_use(part.near, has_attitude) for part in parts])
    of_pressure = next((part.report.path for part in parts if "pressure" in part.log), None)
    log, whole = joined(parts, own)
    reports |= {report.path: report for report in whole}
    if not own:
        if of_pressure is not None and (doubt := doubt_about_gauges(log)):
            told = reports[of_pressure]  # the doubt comes first: a long list is shown in part
            reports[of_pressure] = dataclasses.replace(told, warnings=(doubt, *told.warnings))
        log = with_derived(log, near)
    if "platform" not in log.metadata:
        nameless = ()
    return Reading(log, tuple(reports.values()), dives, partners, tuple(unread), nameless, passed_over)


def _of_use(near: Whereabouts | None, has_attitude: bool) -> Whereabouts | None:
    """Positions that need be no fixes: every one for a track through them, which a log with attitude has no need of."""
    return near.sparse if has_attitude and near is not None else near


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


def _nothing(paths: Sequence[str | Path], reports: list[FileReport]) -> InputError:
    """Why nothing was read. reports : of files that are no companions."""
    if not reports:
        inside = sum(p.is_dir() for path in paths for p in Path(path).iterdir())
        folders = f" ({inside} folders in it are not looked into)" if inside else ""
        return InputError(" ".join(map(str, paths)), f"holds no log{folders}; readable are {', '.join(FORMATS)}")
    more = f" (and {len(reports) - 1} more files)" if len(reports) > 1 else ""
    return InputError(reports[0].path, f"{reports[0].error}{more}")
