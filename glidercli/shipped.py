"""Where are the recordings, trials and missions that come with the program? Found from any folder, clone or wheel."""

from __future__ import annotations

from pathlib import Path

__all__ = ["find", "folders", "missions"]

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
