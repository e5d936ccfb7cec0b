"""How sure is an estimated number? A value and the interval of its formula's own assumptions, added up term by term."""

from __future__ import annotations

import dataclasses

__all__ = ["Bounds", "exactly"]


@dataclasses.dataclass(frozen=True)
class Bounds:
    """A value with an interval around it, all in one unit.

    The ends are what the formula gives under the assumptions named beside it, no statistics: of a sum they are the sums
    of the ends, as if all assumptions failed together.
    """

    value: float = 0.0
    lower: float = 0.0
    upper: float = 0.0

    def __add__(self, other: Bounds) -> Bounds:
        """The sum, end by end."""
        return Bounds(self.value + other.value, self.lower + other.lower, self.upper + other.upper)

    def times(self, factor: float) -> Bounds:
        """Multiplied by an exact number; a negative one turns the interval over."""
        ends = sorted((self.lower * factor, self.upper * factor))
        return Bounds(self.value * factor, *ends)

    def at(self, arm: float, shift: float) -> Bounds:
        """Multiplied by an arm that may be off by a shift to either side."""
        ends = [end * (arm + way) for end in (self.lower, self.upper) for way in (-shift, shift)]
        return Bounds(self.value * arm, min(ends), max(ends))

    def holds(self, value: float) -> bool:
        """Whether a number lies in the interval."""
        return self.lower <= value <= self.upper


def exactly(value: float) -> Bounds:
    """A number without an interval."""
    return Bounds(value, value, value)
