"""Which colours has a flight in Rerun, and what are they called?"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "BACKGROUND", "BLUE", "BOX", "FINS", "GOLD", "GREEN", "GREY", "HULL", "MASS", "NAMED", "NAMES", "ORANGE",
    "OVERLAID", "PATH", "PHASE_COLOURS", "PLUMB", "RED", "SEA", "SEABED", "SEA_LINES", "TEAL", "TEXT", "VIOLET",
    "Colour", "packed", "scale",
]  # fmt: skip

Colour = tuple[int, int, int]

BLUE, ORANGE, GREEN, RED = (86, 164, 255), (255, 158, 74), (110, 205, 130), (240, 98, 98)
VIOLET, GOLD, GREY, TEAL = (184, 140, 255), (240, 208, 90), (170, 178, 190), (90, 225, 205)
NAMES = {
    BLUE: "blue", ORANGE: "orange", GREEN: "green", RED: "red", VIOLET: "violet", GOLD: "gold", GREY: "grey",
    TEAL: "teal",
}  # fmt: skip
BACKGROUND, TEXT = (22, 26, 34), (200, 205, 215)
SEA, SEA_LINES, SEABED = (60, 140, 210, 16), (110, 180, 230, 60), (150, 120, 80, 90)
BOX, PLUMB, PATH = (120, 130, 150, 80), (200, 200, 200, 130), (110, 120, 140)
HULL, FINS, MASS = (225, 225, 215, 9), (236, 150, 60, 120), (255, 60, 60)

NAMED: dict[str, Any] = {"colors": (255, 255, 255), "show_labels": True, "radii": -0.1}
"""Of points that carry a name and are not seen themselves (a negative radius is in points of the viewer).

A name has its point's colour, on a ground that is (33, 35, 39) in the viewer's dark theme and (123, 125, 129) in its
light one: the contrast of white is 15.7 and 4.1 to 1, that of GREEN 8.0 and 2.1, of RED 5.0 and 1.3.
"""

PHASE_COLOURS: dict[str, Colour] = {
    "surface": GREEN, "dive": BLUE, "climb": ORANGE, "hover": VIOLET, "inflection": GOLD,
}  # fmt: skip

OVERLAID: tuple[Colour, ...] = (BLUE, ORANGE, GREEN, VIOLET, TEAL, GOLD, RED)
"""Of logs side by side, in their order; then again from the first."""


def packed(colours: NDArray[np.uint8]) -> NDArray[np.uint32]:
    """Colours, (n, 3), as Rerun takes them one a row: 0xRRGGBBAA, opaque."""
    red, green, blue = colours.astype(np.uint32).T
    return np.asarray(red << 24 | green << 16 | blue << 8 | 255, dtype=np.uint32)


def scale(name: str, parts: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Colours, (n, 3), of parts, (n,), 0 to 1, of a scale of matplotlib without its darkest end."""
    import matplotlib

    return (255 * matplotlib.colormaps[name](0.12 + 0.88 * parts)[:, :3]).astype(np.uint8)
