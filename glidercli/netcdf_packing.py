"""How is a packed NetCDF variable unpacked? value = stored x scale_factor + add_offset (CF 1.10, section 8.1).

Both must be numbers. Some writers put them down as text: one that is a plain number can be meant in one way only, so it
is taken, and said; any other text tells nothing, and the stored numbers alone would be wrong by a factor nobody sees.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

__all__ = ["Packing", "packing_of"]

_UNPACKED = {"scale_factor": 1.0, "add_offset": 0.0}


class Packing(NamedTuple):
    """value = factor x stored + offset. notes : what to say of attributes that are text."""

    factor: float
    offset: float
    notes: tuple[str, ...]


def packing_of(told: Mapping[str, Any]) -> Packing:
    """The packing that the attributes of a variable tell.

    Raises ValueError, saying which attribute is what, where one is no single finite number.
    """
    numbers, notes = [], []
    for key, without in _UNPACKED.items():
        given = np.atleast_1d(told.get(key, without))
        text = given.dtype.kind in "OSU"
        try:
            number = float(given[0]) if len(given) == 1 else math.nan
        except (TypeError, ValueError):
            number = math.nan
        if not math.isfinite(number):
            shown = repr(str(given[0])[:40]) if text and len(given) == 1 else f"{given.tolist()}"[:60]
            raise ValueError(f"its {key} is {'the text ' * text}{shown}; a single finite number is needed")
        if text:
            notes.append(f"its {key} is the text {str(given[0])!r}, taken as the number that it spells")
        numbers.append(number)
    return Packing(numbers[0], numbers[1], tuple(notes))
