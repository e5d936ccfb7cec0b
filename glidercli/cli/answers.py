"""Where does a command's answer go? To files; to stdout as JSON, CSV or text; checked before any work."""

from __future__ import annotations

import sys
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from glidercli.keeping import Kept

__all__ = ["Wanted", "give", "not_whole", "wanted"]

_STDOUT = Path("-")


class Wanted(NamedTuple):
    """Files to write; whether stdout gets the JSON document, or what -o - asks for."""

    files: list[Path]
    json: bool
    stdout: bool

    @property
    def vehicles(self) -> list[Path]:
        """The vehicle files among them."""
        return [path for path in self.files if path.suffix.lower() == ".toml"]


def wanted(output: Sequence[Path] | None, json: bool, suffixes: Collection[str], force: bool) -> Wanted:
    """The outputs that were asked for, refused if they could not be written in the end; one vehicle file at most."""
    from glidercli.errors import UsageError
    from glidercli.files import check_outputs

    outputs = list(output or [])
    if json and _STDOUT in outputs:
        raise UsageError("-o - and --json both want stdout; leave one out")
    check_outputs(outputs, suffixes, force)
    found = Wanted([path for path in outputs if path != _STDOUT], json, _STDOUT in outputs)
    if len(found.vehicles) > 1:
        raise UsageError(f"-o {found.vehicles[1]}: one vehicle file is made at a time")
    return found


def not_whole(vehicle: Path, lacking: Sequence[str]) -> list[str]:
    """What to say of a vehicle file that was made and cannot fly yet."""
    return [f"{vehicle} is no whole vehicle yet; it lacks {', '.join(lacking)}"] if lacking else []


def give(
    found: Kept, to: Wanted, text: str, *, inputs: Sequence[Path], origin: str, warnings: Sequence[str], force: bool,
    quiet: bool,
) -> None:  # fmt: skip
    """Write every file, or none; tell warnings and files on stderr, and the answer on stdout.

    text : for people. inputs, origin : of the provenance.
    """
    from glidercli.cli.printing import json_text, plain, say, shown, warn
    from glidercli.keeping import keep, write_csv
    from glidercli.provenance import provenance

    keep(found, *to.files, record=provenance(inputs=inputs, origin=origin), force=force)
    warn(warnings, quiet)
    for path in to.files:
        say(f"wrote {path}", quiet)
    if to.json:
        print(json_text(found.document))
    elif to.stdout:
        write_csv(found, sys.stdout)
    else:
        for line in text.split("\n"):
            print(shown(line, sys.stdout) if line.endswith(".") else plain(line))  # rows of tables stay whole
