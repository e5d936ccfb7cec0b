"""Which files make a log? Files, folders and globs, each read by its content, joined into one Log in time order."""

from __future__ import annotations

import dataclasses
import glob
from collections.abc import Callable, Sequence
from pathlib import Path

from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.logio.derived import with_derived
from glidercli.logio.formats import FORMATS, check_format, format_of
from glidercli.logio.joining import joined
from glidercli.logio.reader import Aids, Part
from glidercli.logio.report import FileReport
from glidercli.logio.spreading import read_all

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


COMPANIONS = (
    ".md", ".rst", ".txt", ".toml", ".json", ".py", ".png", ".svg", ".pdf", ".html", ".rrd", ".m", ".cap", ".asc",
    ".dat",
)  # fmt: skip
"""Endings of what stands in a folder beside logs: notes, settings, pictures, outputs that are not read back."""


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
    aids = Aids(None if cache is None else Path(cache), None if columns is None else Path(columns))
    files = _files(paths)
    parts: list[Part] = []
    reports: dict[Path, FileReport] = {}
    for found in read_all(files, format, aids, progress, workers):
        if isinstance(found, Part):
            reports[found.report.path] = found.report
            parts.append(found)
        else:
            reports[found.path] = found
    if not parts:
        first = reports[files[0]]
        more = f" (and {len(files) - 1} more files)" if len(files) > 1 else ""
        raise InputError(first.path, f"{first.error}{more}")
    dives = tuple(dict.fromkeys(part.dive for part in parts if part.dive))
    held = {"", *(name for part in parts for name in part.holds)}
    partners = tuple((part.partner, part.report.path.name) for part in parts if part.partner not in held)
    log, whole = joined(parts)
    reports |= {report.path: report for report in whole}
    if not all(FORMATS[report.format].own for report in whole if report.format):
        log = with_derived(log)
    return Reading(log, tuple(reports[path] for path in files), dives, partners)


def _files(paths: Sequence[str | Path]) -> list[Path]:
    """Every file that the paths name, each once; folders and globs sorted, companions in folders left out."""
    found: list[Path] = []
    for given in paths:
        path = Path(given)
        if path.is_dir():
            inside = [p for p in sorted(path.iterdir()) if p.is_file() and not p.name.startswith(".")]
            recognised = {p: format_of(p) is not None for p in inside}
            if not any(recognised.values()):
                raise InputError(path, f"holds no log; readable are {', '.join(FORMATS)}")
            found += [p for p in inside if recognised[p] or not _is_companion(p)]
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
