"""Which sensors are shipped, and where do their figures come from? One TOML file each: value and source by key."""

from __future__ import annotations

import functools
import tomllib
from pathlib import Path
from typing import Any

__all__ = ["model_file", "model_values", "models"]

_DATA = Path(__file__).parent / "models"


@functools.cache
def models(kind: str) -> dict[str, Path]:
    """File of each shipped model of a kind of sensor (compass, pressure, ctd, gps), by name."""
    return {path.stem: path for path in sorted((_DATA / kind).glob("*.toml"))}


@functools.cache
def model_file(kind: str, name: str) -> dict[str, Any]:
    """What the file of a shipped model holds: description, and a table of value and source for each key."""
    return tomllib.loads(models(kind)[name].read_text(encoding="utf-8"))


def model_values(kind: str, name: str) -> dict[str, Any]:
    """Value of each key that a shipped model sets."""
    return {key: entry["value"] for key, entry in model_file(kind, name).items() if isinstance(entry, dict)}
