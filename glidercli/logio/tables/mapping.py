"""What does a mapping file say? Where a table has its times, its channels and their units; docs/columns.md shows one.

[time]
column = "t"                        or columns = ["date", "time"], joined by a blank
format = "iso"                      unix, unix_ms, matlab, "seconds since 2020-01-01T00:00:00Z", "%d/%m/%Y %H:%M:%S"
utc_offset_h = 0.0                  of the clock, east positive

[columns]                           names of channels, each with its column
depth = { column = "Depth", unit = "m" }
heading = { column = "hdg", unit = "deg", scale = -1.0, offset = 90.0 }     scale x recorded + offset, in the unit
phase = { column = "mode", phases = { D = "dive", C = "climb" } }

[missing]                           cells that hold no value
values = [-9999, 9999]
words = ["NA"]

[file]
separator = ";"                     and skip_lines, decimal, encoding; platform, title, origin
"""

from __future__ import annotations

import datetime
from collections.abc import Mapping as MappingOf
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, ConfigDict, Field, field_validator, model_validator
from pydantic.dataclasses import dataclass

from glidercli.channels import CHANNELS, PHASES
from glidercli.log import Origin
from glidercli.logio.netcdf.times import zero_and_unit
from glidercli.named_units import conversion, units_of

__all__ = ["NUMBERS", "Column", "File", "Mapping", "Missing", "Time", "column_faults", "time_faults"]

_CONFIG = ConfigDict(extra="forbid", strict=False)
_Number = Annotated[float, Field(ge=-1e12, le=1e12, allow_inf_nan=False, strict=True)]


def _not_zero(number: float) -> float:
    if number == 0.0:
        raise ValueError("a number other than 0 is needed: all values would be the offset")
    return number


NUMBERS = ("unix", "unix_ms", "matlab")
"""Formats of times that are numbers, beside "UNIT since DATE"."""


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Time:
    """Where the times are, and how they are written."""

    format: str
    column: str | None = None
    columns: tuple[str, ...] | None = None
    utc_offset_h: Annotated[float, Field(ge=-14.0, le=14.0, strict=True)] = 0.0

    @model_validator(mode="after")
    def _check(self) -> Self:
        if faults := time_faults(vars(self)):
            raise ValueError("; ".join(faults))
        return self

    @field_validator("format")
    @classmethod
    def _known(cls, text: str) -> str:
        if " since " in text:
            zero_and_unit(text)
        elif text not in ("iso", *NUMBERS) and "%" not in text:
            known = ", ".join(("iso", *NUMBERS))
            raise ValueError(f"allowed: {known}, seconds since DATE, or a pattern like %d/%m/%Y %H:%M:%S")
        elif "%" in text:
            try:
                datetime.datetime.strptime("", text)
            except ValueError as error:
                if "does not match" not in str(error):
                    raise ValueError(f"is no pattern of strptime: {error}") from None
        return text

    @property
    def names(self) -> tuple[str, ...]:
        """The columns, one or more."""
        return self.columns or (self.column or "",)


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Column:
    """Where a channel is, and in which unit: value = scale x recorded + offset, in the unit."""

    column: str
    unit: str | None = None
    scale: Annotated[_Number, AfterValidator(_not_zero)] = 1.0
    offset: _Number = 0.0
    phases: dict[str, Literal["surface", "dive", "climb", "hover", "inflection"]] | None = None
    """Words of the table by phase; default: the phases' own."""
    origin: Origin | None = None


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Missing:
    """Cells that hold no value, beside empty ones and NaN."""

    values: tuple[float, ...] = ()
    words: tuple[str, ...] = ()


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class File:
    """How the text is written, and what is to be known of the log."""

    separator: Annotated[str, Field(min_length=1, max_length=1)] = ","
    skip_lines: Annotated[int, Field(ge=0, le=1_000_000, strict=True)] = 0
    """Before the line of column names."""
    decimal: Literal[".", ","] = "."
    encoding: str = "utf-8"
    platform: str | None = None
    title: str | None = None
    origin: Origin | None = None

    @field_validator("encoding")
    @classmethod
    def _known(cls, name: str) -> str:
        try:
            "".encode(name)
        except LookupError:
            raise ValueError("allowed: names of text encodings, as utf-8, latin-1, cp1252") from None
        return name


@dataclass(frozen=True, config=_CONFIG, kw_only=True)
class Mapping:
    """A whole mapping file."""

    time: Time
    columns: dict[str, Column]
    missing: Missing = Missing()
    file: File = File()

    @field_validator("columns")
    @classmethod
    def _check(cls, columns: MappingOf[str, Column]) -> Any:
        if faults := column_faults({channel: vars(column) for channel, column in columns.items()}):
            raise ValueError("; ".join(faults))
        return columns


def time_faults(time: MappingOf[str, Any]) -> list[str]:
    """What is wrong with the keys of [time] together."""
    if (time.get("column") is None) == (time.get("columns") is None):
        return ["needs one of column and columns"]
    return ["columns is an empty list"] if time.get("columns") in ((), []) else []


def column_faults(columns: MappingOf[str, Any]) -> list[str]:
    """What is wrong with channels and their units; what is no table or text is the business of the types."""
    faults = [] if columns else ["holds no channel"]
    for channel, column in columns.items():
        told = column if isinstance(column, dict) else {"unit": 0}
        unit = told.get("unit")
        if channel not in CHANNELS:
            faults.append(f"{channel} is no channel; channels are {', '.join(CHANNELS)}")
        elif channel == "phase":
            faults += [] if unit is None else ["phase has no unit; its cells are words"]
        elif unit is None or (isinstance(unit, str) and conversion(unit, channel) is None):
            said = "has no unit" if unit is None else f"unit = {unit!r}"
            faults.append(f"{channel}: {said}, allowed: {', '.join(units_of(channel))}")
        if told.get("phases") is not None and channel != "phase":
            faults.append(f"{channel}: phases is for the channel phase alone ({', '.join(PHASES)})")
    return faults
