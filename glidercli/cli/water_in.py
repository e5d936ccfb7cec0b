"""Water and current that a command takes as options: each a file, a folder or a quoted glob, of profiles or logs."""

from __future__ import annotations

import dataclasses
import glob
from pathlib import Path
from typing import TYPE_CHECKING

from glidercli.cli.logs_in import LogSource, read_logs
from glidercli.errors import InputError

if TYPE_CHECKING:
    from glidercli.log import Log

__all__ = ["WaterIn", "read_water"]


@dataclasses.dataclass(frozen=True)
class WaterIn:
    """sources : files of profiles, and logs. files : that the logs came from. warnings : of reading, one line each."""

    sources: list[Path | Log]
    files: list[Path]
    warnings: list[str]


def read_water(given: list[Path] | None, source: LogSource) -> WaterIn:
    """What the values of one option name: profiles are left to the simulation, logs are read."""
    found = WaterIn([], [], [])
    for path in given or ():
        files = _files(path)
        profiles = [file for file in files if _is_profiles(file)]
        if profiles:
            found.sources.extend(_all_readable(files, profiles))
        elif len(files) == 1 and not path.is_dir() and not _is_log(files[0]):
            found.sources.append(files[0])  # its reader says what is wrong with it
        else:
            _read_log(path, found, source)
    return found


def _files(path: Path) -> list[Path]:
    """The files of a folder, a glob, or the file itself, sorted."""
    if path.is_dir():
        return [file for file in sorted(path.iterdir()) if file.is_file() and not file.name.startswith(".")]
    if path.exists() or not glob.has_magic(str(path)):
        return [path]
    matches = sorted(Path(match) for match in glob.glob(str(path)))
    if not matches:
        raise InputError(path, "no file matches")
    return [match for match in matches if match.is_file()]


def _is_profiles(file: Path) -> bool:
    from glidercli.ocean.kind import holds_profiles

    try:
        return holds_profiles(file)
    except OSError:
        return False


def _is_log(file: Path) -> bool:
    from glidercli.logio.formats import format_of
    from glidercli.logio.reader import Aids

    return format_of(file, Aids()) is not None


def _all_readable(files: list[Path], profiles: list[Path]) -> list[Path]:
    """Files of profiles; anything else between them is an error, but for notes and pictures."""
    from glidercli.logio.companions import is_companion

    for file in files:
        if file not in profiles and not is_companion(file):
            raise InputError(file, "holds no profiles, and others beside it do; give profiles and logs apart")
    return profiles


def _read_log(path: Path, found: WaterIn, source: LogSource) -> None:
    logs = read_logs({"log": str(path)}, source)
    found.sources.append(logs.read["log"])
    found.files.extend(logs.files)
    found.warnings.extend(logs.warnings)
