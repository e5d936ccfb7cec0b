"""Which files do the paths of logs name, and which of those that they reach are not looked at?"""

from __future__ import annotations

import glob
import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from glidercli.errors import InputError
from glidercli.files import identity

__all__ = ["Found", "found_in", "natural"]

FEW = 5
"""Names that a line tells."""


class Found(NamedTuple):
    """files : each once, those of folders and globs sorted, and whether a folder holds it. passed_over : a line for
    each folder with hidden files, and for each further name of a file that a link makes."""

    files: dict[Path, bool]
    passed_over: tuple[str, ...]


def found_in(paths: Sequence[str | Path]) -> Found:
    """The files of paths, folders and quoted globs.

    Of the names that links give a file its own counts, where it is among them. Raises InputError for an empty name,
    which would be the current folder, a folder that cannot be listed, and a glob that matches nothing.
    """
    if any(not os.fspath(path) for path in paths):
        raise InputError("LOG", "is an empty name (a variable of the shell that is not set?); . is the current folder")
    reached: list[tuple[Path, bool]] = []
    told: dict[str, None] = {}
    for given in paths:
        path = Path(given)
        if path.is_dir():
            if not os.access(path, os.R_OK | os.X_OK):
                raise InputError(path, "cannot be listed: permission denied")
            inside = [p for p in path.iterdir() if not p.is_dir()]
            reached += [(p, True) for p in sorted(inside, key=natural) if not p.name.startswith(".")]
            if hidden := sorted(p.name for p in inside if p.name.startswith(".")):
                told[f"{path}: {_counted(hidden, 'hidden file')}"] = None
        elif path.exists() or not glob.has_magic(str(given)):
            reached.append((path, False))
        else:
            matches = [path for match in glob.glob(str(given)) if (path := Path(match)).is_file()]
            if not matches:
                raise InputError(given, "no file matches")
            reached += [(match, False) for match in sorted(matches, key=natural)]
    first: dict[object, Path] = {}
    again: dict[Path, Path] = {}
    for path, _ in sorted(reached, key=lambda one: one[0].is_symlink()):
        one = first.setdefault(identity(path), path)
        if os.path.abspath(one) != os.path.abspath(path):
            again[path] = one
    chosen = set(first.values())
    files: dict[Path, bool] = {}
    for path, of_folder in reached:
        if path in chosen:
            files.setdefault(path, of_folder)
    links = [f"{path}: the same file as {one}, by a link; read once" for path, one in again.items()]
    more = [f"{len(links) - FEW} more names of files that were read once"] if len(links) > FEW else []
    return Found(files, (*told, *links[:FEW], *more))


def natural(path: Path) -> tuple[list[str | int], str]:
    """Sorts numbers within names by their size: dive 101 before dive 1000."""
    parts = re.split(r"([0-9]+)", str(path))
    return [int(part) if i % 2 else part for i, part in enumerate(parts)], str(path)


def _counted(names: list[str], what: str) -> str:
    more = ", ..." if len(names) > FEW else ""
    return f"{len(names)} {what}{'' if len(names) == 1 else 's'}: {', '.join(names[:FEW])}{more}"
