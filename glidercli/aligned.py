"""How do rows become lines for a terminal? Columns as wide as their longest cell."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["table"]


def table(head: Sequence[str], rows: Sequence[Sequence[str]], texts: int, left: Sequence[int] = ()) -> list[str]:
    """Columns as wide as their longest cell, the first ``texts`` and those in ``left`` to the left, others right."""
    widths = [max(len(row[i]) for row in (head, *rows)) for i in range(len(head))]
    return [
        "  ".join(
            cell.ljust(width) if i < texts or i in left else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in (head, *rows)
    ]
