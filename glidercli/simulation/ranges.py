"""Which numbers may stand in a mission file? Ranges of its keys, checked by pydantic."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

__all__ = ["Buoyancy", "Depth", "Heading", "Seconds", "number", "positive"]

_LONGEST = 1e8  # s, three years: more than any battery lasts; times are kept to 1e-8 s up to there


def number(least: float, most: float) -> Any:
    """The range of a number, both ends allowed."""
    return Field(ge=least, le=most, allow_inf_nan=False, strict=True)


def positive(most: float) -> Any:
    """A range that begins above zero."""
    return Field(gt=0.0, le=most, allow_inf_nan=False, strict=True)


Depth = Annotated[float, number(0.0, 12000.0)]
Seconds = Annotated[float, positive(_LONGEST)]
Heading = Annotated[float, number(-360.0, 360.0)]
Buoyancy = Annotated[float, number(-100.0, 100.0)]
