"""Mission analysis and log replay for underwater gliders.

Every command of ``glider`` is a function here: trim, simulate, replay, compare; those of ``glider coefficients`` are
in coefficients.
"""

from __future__ import annotations

import importlib
from typing import Any

_FUNCTIONS = {"simulate": "glidercli.simulation", "replay": "glidercli.logio"}
_ROOMS = ("trim", "compare", "coefficients")  # calling trim or compare calls the function of that name

__all__ = ["coefficients", "compare", "replay", "simulate", "trim"]


def __getattr__(name: str) -> Any:
    """Import a room only when it is asked for: ``import glidercli`` costs nothing."""
    if name in _ROOMS:
        return importlib.import_module(f"glidercli.{name}")
    if name in _FUNCTIONS:
        return getattr(importlib.import_module(_FUNCTIONS[name]), name)
    raise AttributeError(f"module 'glidercli' has no attribute {name!r}")
