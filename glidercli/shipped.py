"""Where are the recordings and trials that come with the program? Found from any folder, in a clone and in a wheel."""

from __future__ import annotations

from pathlib import Path

__all__ = ["find", "folders"]

_PACKAGE = Path(__file__).parent
_PLACES = (_PACKAGE / "shipped", _PACKAGE.parent / "logs")  # in a wheel; in a clone


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
