"""How many samples does each fault take? A sample counts under its first fault."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["counted"]

Mask = NDArray[np.bool_]


def counted(faults: Sequence[tuple[str, Mask]], kept: Mask) -> tuple[tuple[str, int], ...]:
    """How many of the kept samples each fault takes, (n,) each; ``kept`` loses them."""
    dropped = []
    for reason, fault in faults:
        if count := int((kept & fault).sum()):
            dropped.append((reason, count))
            kept &= ~fault
    return tuple(dropped)
