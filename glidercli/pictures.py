"""How do this program's figures look, and how are they written? One style, and the same bytes for the same figure.

The colours are those of Okabe and Ito, told apart by readers of every colour vision and, by line style, in grey print.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["COLOURS", "PICTURES", "WIDTH", "drawing", "save"]

PICTURES = (".png", ".svg", ".pdf")
"""Endings that can be written."""

WIDTH = 7.2
"""inch, the width of a page's text."""

COLOURS = ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")

_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans", "font.size": 7.5, "axes.titlesize": 8, "axes.labelsize": 7.5, "legend.fontsize": 7.5,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.linewidth": 0.6, "xtick.major.width": 0.6,
    "ytick.major.width": 0.6, "axes.grid": True, "grid.color": "#DDDDDD", "grid.linewidth": 0.5, "axes.axisbelow": True,
    "svg.hashsalt": "glidercli", "pdf.fonttype": 42, "axes.formatter.useoffset": False,
    "axes.unicode_minus": True, "path.simplify": True, "hatch.color": "#666666",
    "hatch.linewidth": 0.5,
}  # fmt: skip


@contextlib.contextmanager
def drawing() -> Iterator[None]:
    """Matplotlib's own settings with ours on top, whatever the user's file says; restored afterwards."""
    import matplotlib

    own = {key: value for key, value in matplotlib.rcParamsDefault.items() if not key.startswith(("backend", "date."))}
    settings: Any = {**own, **_STYLE}
    with matplotlib.rc_context(settings):
        yield


def save(draw: Callable[[], Figure], path: Path, description: str) -> None:
    """Draw and write a figure; the ending of ``path`` picks PNG, SVG or PDF; ``description`` is kept in its metadata.

    No dates and no random identifiers: the same figure is the same bytes.
    """
    metadata: dict[str, dict[str, Any]] = {
        ".png": {"Description": description},
        ".svg": {"Description": description, "Date": None},
        ".pdf": {"Subject": description, "CreationDate": None, "ModDate": None},
    }
    kind = path.suffix.lower()
    with drawing():
        draw().savefig(path, format=kind[1:], dpi=200, metadata=metadata[kind])
