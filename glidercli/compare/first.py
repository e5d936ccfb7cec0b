"""What do words call the first side of a comparison? Measured where it is that, or published; else the first log."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["First"]


class First(NamedTuple):
    """The first side in words. origin : its own, of a Log or a Side."""

    origin: str

    @property
    def word(self) -> str:
        """As "the measured log" and heads of tables have it."""
        return "first" if self.origin in ("simulated", "reconstruction") else "measured"

    @property
    def noun(self) -> str:
        """As "simulated less measured" has it."""
        return "measured" if self.word == "measured" else "the first log"

    def of(self, what: str) -> str:
        """Something of its: "measured depth", "depth of the first log"."""
        return f"measured {what}" if self.word == "measured" else f"{what} of the first log"
