"""Which files of a folder only go with its logs? Any other that cannot be read is named as broken."""

from __future__ import annotations

from pathlib import Path

__all__ = ["is_companion"]

ENDINGS = (
    ".md", ".rst", ".txt", ".toml", ".json", ".py",
    ".png", ".svg", ".pdf", ".html", ".rrd",
    ".m", ".cap", ".asc", ".dat",  # Seaglider: constants, captures, archives
    ".cac", ".ccc", ".mi", ".ma", ".mlg", ".nlg", ".mcg", ".ncg", ".mrg",  # Slocum: sensor lists, missions, consoles
)  # fmt: skip
"""Notes, settings, pictures, outputs that are not read back; and what vehicles write beside their logs."""


def is_companion(path: Path) -> bool:
    """Whether a file of no known format goes with the logs of its folder."""
    return path.suffix.lower() in ENDINGS or path.name.upper().startswith(("README", "LICENSE", "LICENCE"))
