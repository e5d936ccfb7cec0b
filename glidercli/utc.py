"""How is a time written? In UTC by ISO 8601, to the millisecond in documents and to the second in notes."""

from __future__ import annotations

import numpy as np

__all__ = ["iso", "to_second"]


def iso(time_ns: int) -> str:
    """A time, UTC ns, to the millisecond."""
    return f"{np.datetime_as_string(np.datetime64(int(time_ns), 'ns'), unit='ms')}Z"


def to_second(time_ns: int) -> str:
    """A time, UTC ns, to the second; what is less is cut off."""
    return f"{np.datetime64(int(time_ns), 'ns').astype('datetime64[s]')}Z"
