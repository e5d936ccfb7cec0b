"""Which files make a log? Files, folders and globs, each read by its content, joined into one Log in time order."""

from __future__ import annotations

import dataclasses
import glob
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from glidercli.errors import GliderError, InputError, UsageError
from glidercli.files import readable_file
from glidercli.log import Log
from glidercli.logio.csv_log import is_csv, read_csv
from glidercli.logio.dead_reckoning import with_track
from glidercli.logio.derived import with_derived
from glidercli.logio.joining import joined
from glidercli.logio.report import FileReport
from glidercli.logio.seaexplorer import is_seaexplorer, read_seaexplorer

__all__ = ["FORMATS", "Reading", "read"]

Reader = Callable[[Path], tuple[Log, FileReport]]


@dataclasses.dataclass(frozen=True)
class Reading:
    """A log, and the account of every file that it came from."""

    log: Log
    files: tuple[FileReport, ...]


def _is_mcap(path: Path) -> bool:
    from glidercli.logio.mcap_reader import is_mcap

    return is_mcap(path)


def _read_mcap(path: Path) -> tuple[Log, FileReport]:
    from glidercli.logio.mcap_reader import read_mcap

    log = read_mcap(path)
    times = [channel.time_ns for channel in log.channels.values()]
    records = len(np.unique(np.concatenate(times))) if times else 0
    return log, FileReport(path, "glider-mcap", records, records)


FORMATS: dict[str, tuple[Callable[[Path], bool], Reader]] = {
    "glider-mcap": (_is_mcap, _read_mcap),
    "seaexplorer": (is_seaexplorer, read_seaexplorer),
    "glider-csv": (is_csv, read_csv),
}
"""Formats by name: whether a file is one, and its reader; asked in this order."""
COMPANIONS = (".md", ".rst", ".txt", ".toml", ".json", ".py", ".png", ".svg", ".pdf", ".html", ".rrd")
"""Endings of what stands in a folder beside logs: notes, settings, pictures, outputs that are not read back."""


def read(
    paths: Sequence[str | Path],
    format: str | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> Reading:
    """The Log of files, folders and quoted globs, with what can be derived, and an account of every file.

    format : read every file as this format, whatever it looks like.
    progress : is told the files read and the files to read.

    Raises
    ------
    InputError
        A path does not exist, or no file could be read; one that could not beside others is in the account.
    UsageError
        No format of this name.
    """
    if format is not None and format not in FORMATS:
        raise UsageError(f"--format: {format} is no format; allowed: {', '.join(FORMATS)}")
    files = _files(paths)
    parts: list[tuple[Log, FileReport]] = []
    reports = []
    for number, path in enumerate(files):
        if progress is not None:
            progress(number, len(files))
        try:
            log, report = _read_one(path, format)
            if log.channels:
                parts.append((log, report))
            else:
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
    if any(report.format == "seaexplorer" for report in reports):
        log = with_track(with_derived(log)).with_metadata(
            title=f"{log.metadata.get('platform', 'SeaExplorer')} log",
            mass_position_zero="the actuator's own zero (LinPos), not the model's",
            mass_rotation_note="mass_rotation = -AngPos: recorded roll follows AngPos, the model's rotation opposes it",
            heading_note="taken as recorded, from true north; Declination is not added: where a file shows the "
            "vehicle's own dead reckoning (sea063) it runs along the recorded heading to within 0.7 deg, Declination "
            "being 6 deg; the GPS fixes of sea035 cannot tell",
            phase_note="from the recorded NavState",
        )
    return Reading(log, tuple(reports))


def _files(paths: Sequence[str | Path]) -> list[Path]:
    """Every file that the paths name, each once; folders and globs sorted, companions in folders left out."""
    found: list[Path] = []
    for given in paths:
        path = Path(given)
        if path.is_dir():
            inside = [p for p in sorted(path.iterdir()) if p.is_file() and not p.name.startswith(".")]
            recognised = [p for p in inside if _format_of(p)]
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


def _format_of(path: Path) -> str | None:
    try:
        return next((name for name, (recognises, _) in FORMATS.items() if recognises(path)), None)
    except OSError:
        return None


def _read_one(path: Path, format: str | None) -> tuple[Log, FileReport]:
    readable_file(path)
    name = format or _format_of(path)
    if name is None:
        with path.open("rb") as stream:
            packed = stream.read(2) == b"\x1f\x8b"
        what = "is gzip data that unpack to no log: damaged, or not one" if packed else "is not a log that can be read"
        raise InputError(path, f"{what}; readable are {', '.join(FORMATS)}")
    return FORMATS[name][1](path)
