"""Which title has room in a panel? Rerun cuts off what is longer than the panel is wide.

Widths are those of a window of 1400 x 800: a title has 12 px type, its panel's sign at the left and three at the right.
"""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["LEFT", "MIDDLE", "RIGHT", "fitting", "hull_room", "width"]

LEFT, MIDDLE, RIGHT = 361.0, 263.0, 416.0
"""px that a title has in each column of logs side by side; columns are 481, 383 and 536 px wide there."""
SIGNS = 120.0
"""px of a panel's width that its signs take, with 13 px to spare."""
SMALL, CAPITAL, OTHER = 6.1, 8.2, 12.0
"""px of a sign on average, as seen in the viewer (5.9 and 8.0); of one beyond Latin letters at most."""


def width(title: str) -> float:
    """About how wide a title is drawn, px."""
    return sum(CAPITAL if sign.isupper() else SMALL if sign.isascii() else OTHER for sign in title)


def hull_room(abreast: int) -> float:
    """px that a title has in each of so many panels that share the left column."""
    return (LEFT + SIGNS) / abreast - SIGNS


def fitting(room: float, titles: Sequence[str]) -> str:
    """The first of some titles that has room, px; without one the last, cut to it."""
    for title in titles:
        if width(title) <= room:
            return title
    cut = titles[-1]
    while cut and width(cut + "…") > room:
        cut = cut[:-1]
    return cut + "…"
