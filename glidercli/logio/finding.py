"""Which files that the paths of logs reach are not looked at? Hidden ones, and those that a link reaches again."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from glidercli.errors import InputError
from glidercli.files import identity

__all__ = ["check_given", "passed_over"]

FEW = 5
"""Names that a line tells."""


def check_given(paths: Sequence[str | Path]) -> None:
    """Raise InputError for an empty name, which would be the current folder."""
    if any(not os.fspath(path) for path in paths):
        raise InputError("LOG", "is an empty name (a variable of the shell that is not set?); . is the current folder")


def passed_over(paths: Sequence[str | Path]) -> tuple[str, ...]:
    """A line for each folder with hidden files, and for each further name of a file that a link makes."""
    lines = []
    for folder in dict.fromkeys(Path(path) for path in paths):
        if folder.is_dir():
            hidden = sorted(p.name for p in folder.iterdir() if p.name.startswith(".") and not p.is_dir())
            if hidden:
                lines.append(f"{folder}: {_counted(hidden, 'hidden file')}")
    first: dict[object, Path] = {}
    again: list[tuple[Path, Path]] = []
    for path in sorted(_reached(paths), key=Path.is_symlink):
        one = first.setdefault(identity(path), path)
        if os.path.abspath(one) != os.path.abspath(path):
            again.append((path, one))
    for path, one in again[:FEW]:
        lines.append(f"{path}: the same file as {one}, by a link; read once")
    if len(again) > FEW:
        lines.append(f"{len(again) - FEW} more names of files that were read once")
    return tuple(lines)


def _counted(names: list[str], what: str) -> str:
    more = ", ..." if len(names) > FEW else ""
    return f"{len(names)} {what}{'' if len(names) == 1 else 's'}: {', '.join(names[:FEW])}{more}"


def _reached(paths: Sequence[str | Path]) -> Iterator[Path]:
    """The files that paths, folders and globs name, some perhaps again."""
    for given in paths:
        path = Path(given)
        if path.is_dir():
            yield from sorted(p for p in path.iterdir() if not p.is_dir() and not p.name.startswith("."))
        elif path.exists():
            yield path
        else:
            yield from sorted(Path(match) for match in glob.glob(str(given)) if Path(match).is_file())
