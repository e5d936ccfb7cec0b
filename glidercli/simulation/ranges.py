"""Which numbers may stand in a mission file? Ranges of its keys, checked by pydantic."""

from __future__ import annotations

from typing import Any

from pydantic import Field

__all__ = ["number", "positive"]


def number(least: float, most: float) -> Any:
    """The range of a number, both ends allowed."""
    return Field(ge=least, le=most, allow_inf_nan=False, strict=True)


def positive(most: float) -> Any:
    """A range that begins above zero."""
    return Field(gt=0.0, le=most, allow_inf_nan=False, strict=True)
