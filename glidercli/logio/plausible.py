"""Which values of a channel are kept on reading? Those that can be."""

from __future__ import annotations

from glidercli.channels import CHANNELS
from glidercli.limits import limits_of
from glidercli.logio.quantities import Quantity

__all__ = ["quantity_of"]


def quantity_of(channel: str) -> Quantity:
    """The channel in SI with its bounds; a rounding of the conversion at a bound is allowed for."""
    return Quantity(channel, 1.0, *limits_of(channel), CHANNELS[channel].unit)
