"""What do all sensors have in common? Channels, chains of errors, and readings of a piece of the flight."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from glidercli.simulation.instruments.effects import Chain
from glidercli.simulation.instruments.truth import Truth

__all__ = ["Readings", "Sensor"]

Readings = dict[str, tuple[NDArray[np.intp], NDArray[np.float64]]]
"""By channel: the rows of a piece that have a reading (k,), and the readings (k,), SI."""


class Sensor(ABC):
    """A sensor at work; it remembers its lags and its random numbers from piece to piece."""

    channels: tuple[str, ...]
    """Of the log, in the order that it has them."""
    chains: Mapping[str, Chain]
    """By quantity."""

    @abstractmethod
    def read(self, truth: Truth, taken: NDArray[np.intp]) -> Readings:
        """Readings of a piece. taken : rows of it at which the sensor samples, (k,)."""
