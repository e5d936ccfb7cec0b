"""Which colours has a flight in Rerun?"""

from __future__ import annotations

__all__ = [
    "BLUE", "FINS", "GOLD", "GREEN", "GREY", "HULL", "ORANGE", "PHASE_COLOURS", "RED", "SEA", "SEA_LINES", "TEAL",
    "VIOLET", "Colour",
]  # fmt: skip

Colour = tuple[int, int, int]

BLUE, ORANGE, GREEN, RED = (86, 164, 255), (255, 158, 74), (110, 205, 130), (240, 98, 98)
VIOLET, GOLD, GREY, TEAL = (184, 140, 255), (240, 208, 90), (170, 178, 190), (90, 225, 205)
SEA, SEA_LINES, HULL, FINS = (70, 150, 210, 36), (110, 180, 230, 90), (250, 205, 70, 45), (236, 120, 50, 255)

PHASE_COLOURS: dict[str, Colour] = {
    "surface": GREEN, "dive": BLUE, "climb": ORANGE, "hover": VIOLET, "inflection": GOLD,
}  # fmt: skip
