"""Outputs appear whole or not at all: written beside their place under another name, then renamed."""

from __future__ import annotations

import codecs
import contextlib
import os
import tomllib
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

from glidercli.errors import InputError, OutputError

__all__ = [
    "atomic", "check_not_inputs", "check_outputs", "cr_alone", "identity", "is_utf16", "leftovers", "metadata_path",
    "read_toml", "readable_file",
]  # fmt: skip

_LONGEST_NAME = 200
"""bytes; file systems take 255, and the name while writing and that of the metadata are longer."""


def readable_file(path: Path) -> Path:
    """The path, after checking that it is a file that can be read and is not empty; else InputError."""
    if not path.exists():
        raise InputError(path, "no such file")
    if path.is_dir():
        raise InputError(path, "is a folder; a file is needed")
    if not path.is_file():
        raise InputError(path, "is no regular file")
    if not os.access(path, os.R_OK):
        raise InputError(path, "cannot be read: permission denied")
    if path.stat().st_size == 0:
        raise InputError(path, "is empty")
    return path


def is_utf16(head: bytes) -> bool:
    """Whether text is in UTF-16 (or UTF-32), by its mark or by a zero beside every letter. head : the first bytes."""
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return True
    pairs = head[: min(len(head), 4096) // 2 * 2]
    one, other = pairs[::2], pairs[1::2]
    return len(pairs) >= 8 and any(not any(a) and b.isascii() and 0 not in b for a, b in ((one, other), (other, one)))


def cr_alone(head: bytes) -> bool:
    """Whether the lines of a text end in CR alone. head : the first bytes."""
    return head.count(b"\r") > 1 and b"\n" not in head and b"\0" not in head


def read_toml(path: Path, what: str) -> dict[str, Any]:
    """The tables of a TOML file; ``what`` says in an error what the file should be, as "a vehicle"."""
    try:
        return tomllib.loads(readable_file(path).read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError:
        raise InputError(path, f"is not a text file; {what} is a TOML file in UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(path, f"is not valid TOML: {error}") from None


def metadata_path(table: Path) -> Path:
    """Where the provenance of a CSV file stands."""
    return table.with_name(table.name + "-metadata.json")


def _written(paths: Collection[Path]) -> list[Path]:
    """The files that outputs come to: themselves, and the metadata beside each table; standard output is none."""
    files = [path for path in paths if str(path) != "-"]
    return [*files, *(metadata_path(path) for path in files if path.suffix.lower() == ".csv")]


def check_outputs(paths: Collection[Path], suffixes: Collection[str], force: bool) -> None:
    """Refuse outputs that could not be written in the end, before any work is done; their metadata too.

    suffixes : allowed endings, lower case with the dot. The path "-" (standard output) always passes.
    """
    if [str(path) for path in paths].count("-") > 1:
        raise OutputError("-", "is named twice as output")
    for path in paths:
        if str(path) == "-":
            continue
        if path.suffix.lower() not in suffixes:
            raise OutputError(path, f"unknown output {path.suffix or 'without ending'}; allowed: {' '.join(suffixes)}")
        if len(os.fsencode(path.name)) > _LONGEST_NAME:
            raise OutputError(path, f"the name is too long; at most {_LONGEST_NAME} bytes are allowed")
    seen = set()
    for path in _written(paths):
        if path.resolve() in seen:
            raise OutputError(path, "is named twice as output")
        seen.add(path.resolve())
        _check_no_folder(path)
        if not path.parent.is_dir():
            raise OutputError(path, f"folder {path.parent} does not exist")
        if not os.access(path.parent, os.W_OK):
            raise OutputError(path, f"folder {path.parent} cannot be written: permission denied")
        if path.exists() and not force:
            raise OutputError(path, "exists; --force replaces it")


def _check_no_folder(path: Path) -> None:
    if path.is_dir():
        raise OutputError(path, "is a folder; a file name is needed")


def check_not_inputs(outputs: Collection[Path], inputs: Collection[Path]) -> None:
    """Refuse to replace an input by what was made from it, whatever --force says."""
    read = {file.resolve() for path in inputs for file in (path, metadata_path(path))}
    for path in _written(outputs):
        if path.resolve() in read:
            raise OutputError(path, "is an input of this very command; another name is needed")


@contextlib.contextmanager
def atomic(path: Path, force: bool) -> Iterator[Path]:
    """A name beside ``path`` to write to; on success it becomes ``path``, on any failure it is removed."""
    _check_no_folder(path)
    if path.exists() and not force:
        raise OutputError(path, "exists; --force replaces it")
    target = path.resolve()  # a link stays, what it points to is replaced
    beside = target.with_name(f".{target.stem}.part-{os.getpid()}{target.suffix}")
    try:
        beside.touch()  # a place that cannot be written shows here, before any writer's own words
        yield beside
        os.replace(beside, target)
    except OutputError as error:
        if error.path != beside:
            raise
        raise OutputError(path, error.what) from None
    except OSError as error:
        raise OutputError(path, f"cannot be written: {error.strerror or error}") from error
    except RuntimeError as error:
        if "HDF" not in str(error):  # the word of the NetCDF library for a disk that is full
            raise
        raise OutputError(path, f"cannot be written: {error}; is the disk full?") from error
    finally:
        beside.unlink(missing_ok=True)


def identity(path: Path) -> object:
    """What a file has in common with its further names, by links of either kind; two others differ."""
    try:
        found = path.stat()
    except OSError:
        return path.resolve()
    return found.st_dev, found.st_ino


def leftovers(path: Path) -> list[Path]:
    """Parts of this output that processes left which were killed while they wrote it, and of a table's metadata."""
    left = []
    for target in (file.resolve() for file in _written([path])):
        start, end = f".{target.stem}.part-", target.suffix
        for file in sorted(target.parent.iterdir()) if target.parent.is_dir() else ():
            number = file.name.removeprefix(start).removesuffix(end)
            if file.name == f"{start}{number}{end}" and number.isdigit() and not _runs(int(number)):
                left.append(file)
    return left


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True
