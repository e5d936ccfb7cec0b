"""What may a column named origin say of a table's rows? One vocabulary for logs, water, current and controls."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from glidercli.errors import InputError

__all__ = ["BOTH", "WORDS", "column_name", "origins"]

BOTH = "measured and derived"
"""What a row of a measured log is that holds derived channels too."""
WORDS = ("reconstruction", "simulated", "derived", BOTH, "measured")
"""What a row may be, the least first."""


def column_name(head: str) -> str:
    """A column's name without the blanks around it; "origin" however it is capitalised."""
    name = head.strip()
    return "origin" if name.lower() == "origin" else name


def origins(path: Path, cells: Iterable[tuple[int, str]]) -> tuple[str, ...]:
    """The words that the cells of a column origin hold, the least first; capitals and blanks make no difference.

    cells : line of the file and text. Raises InputError, naming the line, for another word and for an empty cell.
    """
    found = set()
    for line, cell in cells:
        word = " ".join(cell.lower().split())
        if word not in WORDS:
            raise InputError(path, f"line {line}: origin = {cell!r}; allowed: {', '.join(WORDS)}")
        found.add(word)
    return tuple(word for word in WORDS if word in found)
