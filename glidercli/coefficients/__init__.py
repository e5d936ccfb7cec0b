"""Where do a vehicle's numbers come from? Added mass, the CFD cases, the fit, estimates: sections 2.5 and 3."""

from __future__ import annotations

import importlib
from typing import Any

_FUNCTIONS = {
    "added_mass": "added.added_mass",
    "cases": "flows.case_table",
    "estimate": "handbook.estimate",
    "fit": "forces.result",
}

__all__ = ["added_mass", "cases", "estimate", "fit"]


def __getattr__(name: str) -> Any:
    """Import a room only when one of its functions is asked for."""
    if name in _FUNCTIONS:
        return getattr(importlib.import_module(f"{__name__}.{_FUNCTIONS[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
