"""Comparison: a simulated log against a measured one, or against published values.

``compare`` is the one question of this room, and the room answers to its name: ``glidercli.compare(measured,
simulated)`` calls it.
"""

from __future__ import annotations

import sys
import types
from typing import Any

from glidercli.compare.comparison import Comparison, compare, matching
from glidercli.compare.facts import Fact, Facts, read_facts
from glidercli.compare.output import SUFFIXES, write
from glidercli.compare.overlay import Overlay, overlay

__all__ = [
    "SUFFIXES",
    "Comparison",
    "Fact",
    "Facts",
    "Overlay",
    "compare",
    "matching",
    "overlay",
    "read_facts",
    "write",
]


class _Room(types.ModuleType):
    """The room as a function: an import puts the module itself at ``glidercli.compare``, so it must be callable."""

    def __call__(self, *arguments: Any, **options: Any) -> Comparison:
        return compare(*arguments, **options)


sys.modules[__name__].__class__ = _Room
