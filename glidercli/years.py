"""Which times may be told? Those of years that nanoseconds of 64 bits hold (1678 to 2261), and no others."""

from __future__ import annotations

import datetime

__all__ = ["FIRST_SECOND", "FIRST_YEAR", "LAST_SECOND", "LAST_YEAR"]

FIRST_YEAR, LAST_YEAR = 1700, 2200
"""From the beginning of the one to the beginning of the other."""
FIRST_SECOND, LAST_SECOND = (
    datetime.datetime(year, 1, 1, tzinfo=datetime.UTC).timestamp() for year in (FIRST_YEAR, LAST_YEAR)
)
"""The same, s since 1970."""
