"""Where are the recordings, trials and missions that come with the program? Found from any folder, clone or wheel."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from glidercli.errors import InputError

__all__ = ["file_of", "find", "folders", "missions"]

_PACKAGE = Path(__file__).parent
_PLACES = (_PACKAGE / "shipped", _PACKAGE.parent / "logs")  # in a wheel; in a clone
_MISSIONS = _PACKAGE / "simulation" / "missions"


def folders() -> dict[str, Path]:
    """Folder of each shipped trial (one with a mission.toml), by name."""
    return {
        path.parent.name: path.parent
        for place in reversed(_PLACES)
        if place.is_dir()
        for path in sorted(place.glob("*/mission.toml"))
    }


def find(name: str) -> Path | None:
    """The folder of a shipped trial, or None."""
    return folders().get(name)


def missions() -> dict[str, Path]:
    """File of each shipped mission, by name: those of the trials, then plans."""
    trials = {name: folder / "mission.toml" for name, folder in folders().items()}
    return {**trials, **{path.stem: path for path in sorted(_MISSIONS.glob("*.toml"))}}


def file_of(name_or_path: str | Path, known: Mapping[str, Path], what: str) -> Path:
    """The file of a shipped name, or the path itself.

    known : files by shipped name. what : what they are, as "vehicle". Raises InputError for a name that is neither.
    """
    text = str(name_or_path)
    if text in known:
        return known[text]
    path = Path(text)
    if path.suffix == "" and not path.exists():
        raise InputError(text, f"is no {what}; shipped are {', '.join(known)}, or give a .toml file")
    return path
